// OpenGL objects that free themselves. Each belongs to the context that was current when it was made.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/gl/device_memory.h"
#include "core/gl/functions.h"
#include "core/uninitialized.h"

namespace copeel::gl {

// The name of an object; `Delete` frees it.
template <auto Delete>
class Handle {
 public:
  explicit Handle(GLuint name = 0) : name_(name) {}
  ~Handle() { if (name_) Delete(name_); }
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept { std::swap(name_, other.name_); return *this; }
  operator GLuint() const { return name_; }

 private:
  GLuint name_;
};

inline void deleteBuffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void deleteTexture(GLuint name) { glDeleteTextures(1, &name); }
inline void deleteFramebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void deleteVertexArray(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void deleteQuery(GLuint name) { glDeleteQueries(1, &name); }

using Texture = Handle<deleteTexture>;
using Framebuffer = Handle<deleteFramebuffer>;
using VertexArray = Handle<deleteVertexArray>;
using Query = Handle<deleteQuery>;

// Memory on the device, of a fixed size (bytes). Throws Error{Machine}: more than --memory leaves or than the device can address.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t bytes, const void* data = nullptr);
  template <class T>
  explicit Buffer(const std::vector<T>& data) : Buffer(data.size() * sizeof(T), data.data()) {}
  template <class T>
  explicit Buffer(const UninitializedVector<T>& data) : Buffer(data.size() * sizeof(T), data.data()) {}

  std::size_t bytes() const { return bytes_; }
  GLuint name() const { return name_; }
  void bindStorage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_); }
  void bindUniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, name_); }
  void clear(GLuint word) const;                 // every 32-bit word of it
  void write(const void* data, std::size_t bytes) const { glNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes), data); }
  template <class T>
  std::vector<T> read(std::size_t count) const {
    std::vector<T> data(count);
    visit(0, count * sizeof(T), [&](const void* bytes) { std::memcpy(data.data(), bytes, count * sizeof(T)); });
    return data;
  }
  // The bytes [offset, offset + count), where the host reads them as long as the call lasts.
  void visit(std::size_t offset, std::size_t count, const std::function<void(const void*)>& visitor) const;

 private:
  Handle<deleteBuffer> name_;
  std::size_t bytes_ = 0;
  mutable Handle<deleteBuffer> readBack_;        // what a GPU is to show the host is copied there; of so many bytes
  mutable std::size_t readBackBytes_ = 0;
  DeviceMemory share_;
};

}  // namespace copeel::gl
