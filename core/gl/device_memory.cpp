#include "core/gl/device_memory.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/gl/context.h"
#include "core/gl/functions.h"

namespace copeel::gl {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

// Shaders address a buffer by 32-bit offsets of bytes, in some drivers signed ones: llvmpipe ends in a fault past this.
constexpr std::uint64_t kLargestBuffer = std::uint64_t{1} << 31;

std::atomic<std::uint64_t> used{0}, most{kNone};

// Mesa's software renderers name limits far below what they can do.
bool named(GLenum what, std::uint64_t& value) {
  GLint64 number = 0;
  glGetInteger64v(what, &number);
  value = static_cast<std::uint64_t>(std::max<GLint64>(number, 0));
  return number > 0 && !isSoftwareRenderer();
}

}  // namespace

DeviceMemory::DeviceMemory(std::uint64_t bytes) {
  if (bytes > left()) failMachine("gl: --memory is not enough: of it {} bytes are left, {} are wanted", left(), bytes);
  used += bytes;
  bytes_ = bytes;
}

DeviceMemory::~DeviceMemory() { used -= bytes_; }
DeviceMemory::DeviceMemory(DeviceMemory&& other) noexcept : bytes_(std::exchange(other.bytes_, 0)) {}

DeviceMemory& DeviceMemory::operator=(DeviceMemory&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

void DeviceMemory::limit(std::uint64_t bytes) { most = bytes == 0 ? kNone : bytes; }

std::uint64_t DeviceMemory::left() {
  const std::uint64_t limit = most, taken = used;
  return limit == kNone ? kNone : limit - std::min(limit, taken);
}

std::uint64_t DeviceMemory::largestBuffer() {
  std::uint64_t bytes = 0;
  return named(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, bytes) ? std::min(bytes, kLargestBuffer) : kLargestBuffer;
}

std::uint64_t DeviceMemory::mostTexels() {
  std::uint64_t texels = 0;
  return named(GL_MAX_TEXTURE_BUFFER_SIZE, texels) ? texels : kLargestBuffer;
}

}  // namespace copeel::gl
