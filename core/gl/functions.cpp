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
  static void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (!library) failMachine("gl: no {} (Debian package libepoxy0)", kLibrary);
#define COPEEL_GL_LOAD(name) load(library, "epoxy_" #name, epoxy_##name);
  COPEEL_GL_FUNCTIONS(COPEEL_GL_LOAD)
#undef COPEEL_GL_LOAD
}

}  // namespace copeel::gl
