#include "core/gl/context.h"

#include <array>
#include <cstring>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "core/error.h"

namespace copeel::gl {
namespace {

EGLDisplay initialized(EGLDisplay display) {
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) ? display : EGL_NO_DISPLAY;
}

// Devices first: a GPU's own driver answers there. Mesa's surfaceless platform is what is left without one.
EGLDisplay openDisplay() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = eglQueryDeviceStringEXT(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
      if (extensions && std::strstr(extensions, "EGL_MESA_device_software")) continue;
      const EGLDisplay display =
          initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
      if (display != EGL_NO_DISPLAY) return display;
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  }
  return EGL_NO_DISPLAY;
}

bool isSoftwareRenderer(const std::string& name) {
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos || name.find("SWR") != std::string::npos;
}

}  // namespace

Context::Context() {
  display_ = openDisplay();
  if (display_ == EGL_NO_DISPLAY) failMachine("gl: no EGL display without a window (Debian package libegl-mesa0)");
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  if (eglBindAPI(EGL_OPENGL_API)) context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (!context_ || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    eglTerminate(display_);
    failMachine("gl: no OpenGL 4.5 core context here");
  }
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  software_ = isSoftwareRenderer(renderer_);
}

Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void checkErrors(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {}
  if (error == GL_OUT_OF_MEMORY) failMachine("gl: out of memory, {}", doing);
  failMachine("gl: error 0x{:04x}, {}", error, doing);
}

}  // namespace copeel::gl
