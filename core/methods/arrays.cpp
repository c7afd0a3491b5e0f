#include "core/methods/arrays.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/gl/layout.h"

namespace copeel {
namespace {

constexpr std::uint32_t kRound = 1024;   // ARRAY_ROUND of sort_array.glsl

}  // namespace

gl::Defines shortDefine(std::size_t most) { return {{"SORT_SHORT", fmt::format("{}", most <= kFewFragments ? kFewFragments : kShortArray)}}; }

void deliverArrays(gl::Frame& frame, const std::string& file, const gl::Buffer& fragments, std::size_t most,
                   const Uniforms& uniforms, const gl::Defines& defines) {
  const auto program = [&](const char* pass, const gl::Defines& more) -> const gl::Program& {
    gl::Defines all = shortDefine(most);
    all.insert(all.end(), defines.begin(), defines.end());
    all.insert(all.end(), more.begin(), more.end());
    const gl::Program& found = frame.pixelProgram(file, pass, all);
    for (const auto& [name, value] : uniforms) found.set(name, value);
    return found;
  };
  const auto drawRounds = [&](const gl::Program& rounds, std::uint32_t steps) {
    for (std::uint32_t round = 0; round * kRound < steps; ++round) {
      rounds.set("arrayRound", round);
      frame.drawPixels(rounds);
    }
  };
  const gl::Buffer& putOff = frame.buffer("longest", 7, 4);
  putOff.clear(0);
  frame.texels(fragments, COPEEL_TEXTURE_METHOD, GL_RG32UI);
  frame.drawPixels(program("RESOLVE", frame.wholeDefines()));
  // To ask means to wait for the pass.
  const std::uint32_t longest = most > kShortArray ? putOff.read<std::uint32_t>(1)[0] : 0;
  if (longest == 0) return;
  frame.makeStates();
  if (!frame.usesStates()) frame.drawPixels(program("BEGIN", {}));
  drawRounds(program("HEAP", {}), longest / 2);
  drawRounds(program("POP", {}), longest);
  if (!frame.usesStates()) frame.drawPixels(program("FINISH", {}));
}

std::size_t roomFor(std::uint64_t memoryBytes, std::size_t others, std::size_t texelBytes) {
  const std::size_t most = std::min(gl::DeviceMemory::largestBuffer(), gl::DeviceMemory::mostTexels() * texelBytes);
  if (memoryBytes == 0) return most;
  return std::min<std::size_t>(most, memoryBytes > others ? memoryBytes - others : 0);
}

}  // namespace copeel
