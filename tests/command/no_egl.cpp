// Preloaded, this hides libEGL from the program: a machine without it.
#include <cstring>

#include <dlfcn.h>

extern "C" void* dlopen(const char* name, int flags) {
  using Open = void* (*)(const char*, int);
  static const Open open = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  return open(name && std::strstr(name, "libEGL") ? "no such library" : name, flags);
}
