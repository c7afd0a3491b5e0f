// Linked into every program of the presets asan and tsan: what others' libraries do there is not for us to mend.
#if defined(__SANITIZE_ADDRESS__)
// Mesa's software driver loses 240 bytes a context (valgrind's "definitely lost", every frame in swrast_dri.so). LeakSanitizer can be told whose
// they are as long as the driver is loaded, so nothing is unloaded.
extern "C" int dlclose(void*) { return 0; }
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so\n"; }
#elif defined(__SANITIZE_THREAD__)
// Neither oneTBB nor Mesa is built with the sanitizer, which does not see how their threads wait for each other. A report is passed over only if
// one of the two accesses happened inside them.
extern "C" const char* __tsan_default_suppressions() { return "race:libtbb.so\nrace:swrast_dri.so\n"; }
#endif
