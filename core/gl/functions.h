// The functions of OpenGL, EGL and libepoxy that the gl back end calls, by their own names within copeel::gl. libepoxy is opened with the first
// context, not with the program: to link its 3,500 function pointers took a fifth of the start of every command (0.7 ms).
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

// Names as libepoxy has them after `epoxy_`. One that is missing here is an undefined symbol at link time.
#define COPEEL_GL_FUNCTIONS(F) \
  F(has_egl_extension) F(has_gl_extension) \
  F(eglBindAPI) F(eglCreateContext) F(eglDestroyContext) F(eglGetCurrentContext) F(eglGetPlatformDisplayEXT) F(eglInitialize) F(eglMakeCurrent) F(eglQueryDeviceStringEXT) \
  F(eglQueryDevicesEXT) F(eglTerminate) \
  F(glAttachShader) F(glBeginConditionalRender) F(glBeginQuery) F(glBindBuffer) F(glBindBufferBase) F(glBindFramebuffer) F(glBindTextureUnit) \
  F(glBindVertexArray) F(glCheckNamedFramebufferStatus) F(glClearNamedBufferData) F(glClearNamedFramebufferfv) F(glClearNamedFramebufferuiv) \
  F(glCompileShader) F(glCopyNamedBufferSubData) F(glCreateBuffers) F(glCreateFramebuffers) F(glCreateProgram) F(glCreateQueries) F(glCreateShader) F(glCreateTextures) \
  F(glCreateVertexArrays) F(glDeleteBuffers) F(glDeleteFramebuffers) F(glDeleteProgram) F(glDeleteQueries) F(glDeleteShader) F(glDeleteTextures) \
  F(glDeleteVertexArrays) F(glDepthFunc) F(glDepthMask) F(glDisable) F(glDispatchCompute) F(glDrawArrays) F(glEnable) F(glEnableVertexArrayAttrib) \
  F(glEndConditionalRender) F(glEndQuery) F(glFinish) F(glFrontFace) F(glGetError) F(glGetInteger64v) \
  F(glGetProgramInfoLog) F(glGetProgramiv) F(glGetQueryObjectuiv) F(glGetShaderInfoLog) F(glGetShaderiv) F(glGetString) F(glGetUniformLocation) \
  F(glLinkProgram) F(glMapNamedBufferRange) F(glMemoryBarrier) F(glMultiDrawElementsIndirect) F(glNamedBufferStorage) F(glNamedBufferSubData) F(glNamedFramebufferDrawBuffer) \
  F(glNamedFramebufferDrawBuffers) F(glNamedFramebufferParameteri) F(glNamedFramebufferTexture) F(glProgramUniform1i) F(glProgramUniform1ui) \
  F(glScissor) F(glShaderSource) F(glTextureBuffer) F(glTextureParameteri) F(glTextureStorage2D) F(glUnmapNamedBuffer) F(glUseProgram) F(glVertexArrayAttribBinding) \
  F(glVertexArrayAttribFormat) F(glVertexArrayAttribIFormat) F(glVertexArrayBindingDivisor) F(glVertexArrayElementBuffer) \
  F(glVertexArrayVertexBuffer) F(glViewport)

namespace copeel::gl {

// A function of libepoxy's, or a pointer of its: to the driver's function, from the first call on.
template <class F>
class Function;

template <class R, class... P>
class Function<R(P...)> {
 public:
  R operator()(P... arguments) const { return function_(arguments...); }
  void set(void* symbol) { function_ = reinterpret_cast<R (*)(P...)>(symbol); }

 private:
  R (*function_)(P...) = nullptr;
};

template <class R, class... P>
class Function<R (*)(P...)> {
 public:
  R operator()(P... arguments) const { return (*pointer_)(arguments...); }
  void set(void* symbol) { pointer_ = static_cast<R (**)(P...)>(symbol); }

 private:
  R (**pointer_)(P...) = nullptr;
};

// libepoxy's header makes glEnable a macro for epoxy_glEnable: here that is a Function, which hides the library's.
#define COPEEL_GL_FUNCTION(name) inline Function<decltype(::epoxy_##name)> epoxy_##name;
COPEEL_GL_FUNCTIONS(COPEEL_GL_FUNCTION)
#undef COPEEL_GL_FUNCTION

void loadFunctions();   // once, by one thread at a time; throws Error{Machine}: no libepoxy

}  // namespace copeel::gl
