#include "core/gl/objects.h"

#include <algorithm>

#include "core/error.h"
#include "core/gl/context.h"

namespace copeel::gl {

Buffer::Buffer(std::size_t bytes, const void* data) : bytes_(std::max<std::size_t>(bytes, 16)) {
  const std::uint64_t largest = DeviceMemory::largestBuffer();
  if (bytes_ > largest) failMachine("gl: a buffer of {} MB is wanted, and {} MB is the most that shaders can address", bytes_ >> 20, largest >> 20);
  share_ = DeviceMemory(bytes_);
  GLuint name = 0;
  glCreateBuffers(1, &name);
  name_ = Handle<deleteBuffer>(name);
  // A buffer of nothing is not allowed, and an empty scene is: the data fill what there is of them.
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes_), bytes == bytes_ ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (bytes > 0 && bytes < bytes_ && data) write(data, bytes);
  // What is drawn without its memory would look right here and there.
  checkErrors("making a buffer");
}

// llvmpipe has a fast way for single words: four at once take three times as long.
void Buffer::clear(GLuint word) const { glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word); }

}  // namespace copeel::gl
