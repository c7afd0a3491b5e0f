// An OpenGL 4.5 core context without a window: EGL on a surfaceless platform (Mesa, llvmpipe where there is no GPU) or on a device (NVIDIA).
#pragma once

#include <string>

namespace copeel::gl {

class Context {
 public:
  Context();    // throws Error{Machine}: what is missing, in one line
  ~Context();
  Context(const Context&) = delete;

  void makeCurrent() const;               // on the calling thread, as a new one is; throws Error{Machine} where another thread has it
  bool tryMakeCurrent() const noexcept;   // false: another thread has it
  const std::string& renderer() const { return renderer_; }   // the driver's name of itself
  bool isSoftware() const { return software_; }               // llvmpipe or the like

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_;
  bool software_ = false;
};

// Of the current context.
bool hasExtension(const char* name);
bool isSoftwareRenderer();   // by the driver's name of itself

// Throws Error{Machine} if the driver has found fault with anything since the last call; `doing` says in what.
void checkErrors(const char* doing);

}  // namespace copeel::gl
