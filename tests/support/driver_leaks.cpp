// Linked into every program of the asan preset. Mesa's software driver loses 240 bytes a context (valgrind's "definitely lost", every frame in
// swrast_dri.so). LeakSanitizer can be told whose they are as long as the driver is loaded, so nothing is unloaded.
extern "C" int dlclose(void*) { return 0; }
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so\n"; }
