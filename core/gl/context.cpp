#include "core/gl/context.h"

#include <array>
#include <cstring>
#include <mutex>
#include <vector>

#include <dlfcn.h>
#include <sys/resource.h>

#include "core/error.h"
#include "core/gl/functions.h"

namespace copeel::gl {
namespace {

std::mutex contextsMutex;
int contexts = 0;   // to terminate a display ends all that are on it

// Devices first: a GPU's own driver answers there. Mesa's surfaceless platform is what is left without one.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> found;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = eglQueryDeviceStringEXT(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
      if (extensions && std::strstr(extensions, "EGL_MESA_device_software")) continue;
      found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  }
  return found;
}

// A context that is current, or null.
EGLContext openContext(EGLDisplay display) {
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglBindAPI(EGL_OPENGL_API) ? eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted) : EGL_NO_CONTEXT;
  return context && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) ? context : EGL_NO_CONTEXT;
}

// libepoxy ends the program where there is no such library.
bool hasEglLibrary() {
  void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (library) dlclose(library);
  return library != nullptr;
}

// --memory limits the data of the process, and drivers that are denied memory end it. From here on DeviceMemory keeps to the limit.
void liftDataLimit() {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace

bool hasExtension(const char* name) { return epoxy_has_gl_extension(name); }

bool isSoftwareRenderer() {
  const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos || name.find("SWR") != std::string::npos;
}

Context::Context() {
  const std::scoped_lock lock(contextsMutex);
  liftDataLimit();
  if (!hasEglLibrary()) failMachine("gl: no libEGL.so.1 (Debian package libegl1)");
  loadFunctions();
  // A device whose driver is too old leaves the picture to the next one.
  bool any = false;
  for (const EGLDisplay display : displays()) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
    any = true;
    display_ = display;
    context_ = openContext(display);
    if (context_) break;
    if (contexts == 0) eglTerminate(display);
  }
  if (!any) failMachine("gl: no EGL display without a window (Debian package libegl-mesa0)");
  if (!context_) failMachine("gl: no OpenGL 4.5 core context here");
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  software_ = isSoftwareRenderer();
  ++contexts;
}

Context::~Context() {
  const std::scoped_lock lock(contextsMutex);
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  if (--contexts == 0) eglTerminate(display_);
}

bool Context::tryMakeCurrent() const noexcept {
  return eglGetCurrentContext() == context_ || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

void Context::makeCurrent() const {
  if (!tryMakeCurrent()) failMachine("gl: a context is in use by another thread");
}

void checkErrors(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {}
  if (error == GL_OUT_OF_MEMORY) failMachine("gl: out of memory, {}", doing);
  failMachine("gl: error 0x{:04x}, {}", error, doing);
}

}  // namespace copeel::gl
