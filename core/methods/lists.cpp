#include "core/methods/lists.h"

#include <algorithm>

#include "core/error.h"
#include "core/gl/layout.h"
#include "core/methods/arrays.h"
#include "core/methods/occupancy.h"

namespace copeel {
namespace {

constexpr std::size_t kNodeBytes = 12;
constexpr std::size_t kFirstNodesPerPixel = 4;
constexpr std::size_t kCounterWords = 16;       // from one counter to the next: a cache line
constexpr std::uint32_t kMost = 20'000;         // LIST_MOST

// Delivers pixels of few fragments, then, where there are some, those of up to kShortArray. `deep`: the first would be in vain. Returns the fragments of the
// deepest that is left, 0: none is.
std::uint32_t deliverShortLists(gl::Frame& frame, const char* file, const gl::Defines& deliver, bool deep) {
  const gl::Buffer& putOff = frame.buffer("longest", 3, 4);
  const auto pass = [&](std::uint32_t most, const char* more) {
    gl::Defines defines = shortDefine(most);
    defines.insert(defines.end(), deliver.begin(), deliver.end());
    if (more) defines.emplace_back(more, "1");
    putOff.clear(0);
    frame.drawPixels(frame.pixelProgram(file, "RESOLVE", defines));
    return putOff.read<std::uint32_t>(1)[0];
  };
  if (!deep && pass(kFewFragments, "MORE_ROOM_FOLLOWS") == 0) return 0;
  return pass(kShortArray, deep ? nullptr : "PUT_OFF_BEFORE");
}

void deliverLists(gl::Frame& frame, const char* file, const gl::Defines& defines, bool deep) {
  gl::Defines deliver = frame.wholeDefines();
  deliver.insert(deliver.end(), defines.begin(), defines.end());
  const std::uint32_t longest = deliverShortLists(frame, file, deliver, deep);
  if (longest == 0) return;
  if (longest > kMost) failMachine("gl: more than {} fragments in a pixel are too many for linked lists", kMost);
  const gl::Program& merge = frame.pixelProgram(file, "MERGE", defines);
  for (std::uint32_t run = 1; run < longest; run *= 2) {
    merge.set("run", run);
    frame.drawPixels(merge);
  }
  frame.drawPixels(frame.pixelProgram(file, "LONG", deliver));
}

}  // namespace

MethodCounts drawLists(gl::Frame& frame, const MethodOptions& options, const char* file, std::uint32_t lists, std::uint32_t parts) {
  const gl::Defines defines = {{"LISTS", fmt::format("{}", lists)}, {"PARTS", fmt::format("{}", parts)}};
  const std::uint32_t memories = lists * parts;
  gl::Defines gatherDefines = drawOccupancy(frame, options);
  gatherDefines.insert(gatherDefines.end(), defines.begin(), defines.end());
  const gl::Program& gather = frame.geometryProgram(file, "GATHER", gatherDefines);
  const gl::Buffer& heads = frame.pixelWords("heads", 0, lists);
  const gl::Buffer& counters = frame.buffer("wanted", 2, memories * kCounterWords * 4);
  // One node of each memory is one place.
  const std::size_t placeBytes = kNodeBytes * memories;
  const std::size_t most = roomFor(options.memoryBytes, heads.bytes() + counters.bytes() + 4, kNodeBytes) / placeBytes;
  const std::size_t start = (frame.pixelCount() * kFirstNodesPerPixel + memories - 1) / memories;
  std::size_t capacity = std::min(std::max(frame.keptBytes("nodes") / placeBytes, start), most);
  MethodCounts counts{.iterations = 1};
  std::size_t fragments = 0;
  for (;; ++counts.repeats) {
    frame.buffer("nodes", 1, capacity * placeBytes);
    heads.clear(0);
    counters.clear(0);
    gather.set("capacity", static_cast<GLuint>(capacity));
    frame.drawGeometry(gather);
    const std::vector<std::uint32_t> words = counters.read<std::uint32_t>(memories * kCounterWords);
    std::size_t wanted = 0;
    fragments = 0;
    counts.overflow = 0;
    for (std::size_t memory = 0; memory < memories; ++memory) {
      const std::size_t nodes = words[memory * kCounterWords];
      wanted = std::max(wanted, nodes);
      fragments += nodes;
      counts.overflow += nodes > capacity ? nodes - capacity : 0;
    }
    if (counts.overflow == 0 || capacity >= most) break;
    capacity = std::min(wanted, most);
  }
  if (counts.overflow > 0 && options.allOrNothing) return counts;
  frame.texels(heads, COPEEL_TEXTURE_METHOD, GL_R32UI);
  frame.texels(frame.buffer("nodes", 1, capacity * placeBytes), COPEEL_TEXTURE_METHOD + 1, GL_RGB32UI);
  deliverLists(frame, file, defines, fragments > kFewFragments * frame.pixelCount());
  return counts;
}

}  // namespace copeel
