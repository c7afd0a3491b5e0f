#include "core/gl/functions.h"

#include <dlfcn.h>

#include "core/error.h"

namespace copeel::gl {
namespace {

constexpr const char* kLibrary = "libepoxy.so.0";

template <class F>
void load(void* library, const char* name, F& function) {
  void* const symbol = dlsym(library, name);
  if (!symbol) failMachine("gl: {} has no {}", kLibrary, name);
  function.set(symbol);
}

}  // namespace

void loadFunctions() {
  static void* library = nullptr;
  if (library) return;
  void* const opened = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (!opened) failMachine("gl: no {} (Debian package libepoxy0): {}", kLibrary, dlerror());
#define COPEEL_GL_LOAD(name) load(opened, "epoxy_" #name, epoxy_##name);
  COPEEL_GL_FUNCTIONS(COPEEL_GL_LOAD)
#undef COPEEL_GL_LOAD
  library = opened;
}

}  // namespace copeel::gl
