#include "core/gl/objects.h"

#include <algorithm>

#include "core/error.h"
#include "core/gl/context.h"

namespace copeel::gl {
namespace {

Handle<deleteBuffer> newBuffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return Handle<deleteBuffer>(name);
}

struct Unmapping {
  GLuint name;
  ~Unmapping() { glUnmapNamedBuffer(name); }
};

}  // namespace

Buffer::Buffer(std::size_t bytes, const void* data) : bytes_(std::max<std::size_t>(bytes, 16)) {
  const std::uint64_t largest = DeviceMemory::largestBuffer();
  if (bytes_ > largest) failMachine("gl: a buffer of {} MB is wanted, and {} MB is the most that shaders can address", bytes_ >> 20, largest >> 20);
  share_ = DeviceMemory(bytes_);
  name_ = newBuffer();
  // A buffer of nothing is not allowed, and an empty scene is: the data fill what there is of them.
  const GLbitfield use = GL_DYNAMIC_STORAGE_BIT | (isSoftwareRenderer() ? GL_MAP_READ_BIT : 0);
  glNamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes_), bytes == bytes_ ? data : nullptr, use);
  if (bytes > 0 && bytes < bytes_ && data) write(data, bytes);
  // What is drawn without its memory would look right here and there.
  checkErrors("making a buffer");
}

// llvmpipe has a fast way for single words: four at once take three times as long.
void Buffer::clear(GLuint word) const { glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word); }

// A GPU's driver moves a buffer that the host reads to the host's memory, for good (NVIDIA's says so), and atomics on it then cross the bus: what is read is
// copied first. llvmpipe has one memory, and shows the buffer itself; there little is copied too, so that both ways are tested.
void Buffer::visit(std::size_t offset, std::size_t count, const std::function<void(const void*)>& visitor) const {
  if (count == 0) return;
  constexpr std::size_t kLittle = 65536;
  const bool copies = count <= kLittle || !isSoftwareRenderer();
  const auto size = static_cast<GLsizeiptr>(count);
  if (copies) {
    if (readBackBytes_ < count) {
      readBackBytes_ = 0;
      readBack_ = newBuffer();
      glNamedBufferStorage(readBack_, size, nullptr, GL_CLIENT_STORAGE_BIT | GL_MAP_READ_BIT);
      checkErrors("reading a buffer");
      readBackBytes_ = count;
    }
    glCopyNamedBufferSubData(name_, readBack_, static_cast<GLintptr>(offset), 0, size);
  }
  const GLuint name = copies ? readBack_ : name_;
  const void* const bytes = glMapNamedBufferRange(name, copies ? 0 : static_cast<GLintptr>(offset), size, GL_MAP_READ_BIT);
  if (!bytes) failMachine("gl: {} bytes of a buffer cannot be read", count);
  const Unmapping unmapping{name};
  visitor(bytes);
}

}  // namespace copeel::gl
