// Preloaded, this hides the library that HIDDEN_LIBRARY names from the program: a machine without it.
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

extern "C" void* dlopen(const char* name, int flags) {
  using Open = void* (*)(const char*, int);
  static const Open open = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  const char* const hidden = std::getenv("HIDDEN_LIBRARY");
  return open(name && hidden && std::strstr(name, hidden) ? "no such library" : name, flags);
}
