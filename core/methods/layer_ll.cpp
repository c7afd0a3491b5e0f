// Peeling layer by layer, all fragments of a layer in per-pixel linked lists: f2b-ll from the front, dual-ll from both ends, whose nodes come
// from opposite ends of one buffer by a counter each.
//
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, sections 3.1.1 (Algorithm 2) and 3.1.3.
// Changed: nodes hold an id in place of a colour, and a list is sorted by id, since groups are delivered so. A buffer that is too short is
// counted on, grown to what was asked for, and the pass repeated.
// Passes: 2 D and one that finds nothing, dual 2 ⌈D / 2⌉ and one; and those repeated.
// Bytes: 12 a pixel + 8 a fragment of the largest layer of the image (at least one a pixel) + 8, dual 24 a pixel. The papers: 2 C + 4 and 2 C + 6
// words a pixel, C the largest layer of the pixel. Loses: nothing, unless --memory does not let the buffer grow: then `overflow` fragments.
#include <algorithm>
#include <array>

#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::size_t kNodeBytes = 8;
const std::string kFile = "core/methods/layer_ll.glsl";

class Lists {
 public:
  Lists(gl::Frame& frame, const Layers& layers, const MethodOptions& options)
      : frame_(frame), gather_(layers.gatherProgram(kFile, "GATHER")), resolve_(layers.resolveProgram(kFile, "RESOLVE")),
        heads_(frame.pixelWords("layerHeads", 1, layers.sides())), counters_(frame.buffer("layerCounters", 3, sizeof(Wanted))) {
    const std::size_t fixed = sizeof(Wanted) + frame.pixelCount() * (layers.sides() == 1 ? 12 : 24);
    if (options.memoryBytes) most_ = std::max(options.memoryBytes, fixed + kNodeBytes * 128) - fixed;
    bytes_ = std::min(std::max(frame.keptBytes("layerNodes"), frame.pixelCount() * kNodeBytes), most_);
    heads_.clear(0);
  }

  void gatherLayer(MethodCounts& counts);
  void resolve() { frame_.drawPixels(resolve_); }

 private:
  using Wanted = std::array<std::uint32_t, 2>;   // nodes, per side
  Wanted gather(std::size_t capacity, std::size_t frontCapacity);

  gl::Frame& frame_;
  const gl::Program& gather_;
  const gl::Program& resolve_;
  const gl::Buffer& heads_;
  const gl::Buffer& counters_;
  std::size_t most_ = ~std::size_t{0}, bytes_ = 0;
};

Lists::Wanted Lists::gather(std::size_t capacity, std::size_t frontCapacity) {
  frame_.buffer("layerNodes", 2, bytes_);
  counters_.clear(0);
  gather_.set("capacity", static_cast<GLuint>(capacity));
  gather_.set("frontCapacity", static_cast<GLuint>(frontCapacity));
  gather_.set("backCapacity", static_cast<GLuint>(frontCapacity == capacity ? capacity : capacity - frontCapacity));
  frame_.drawGeometry(gather_);
  const std::vector<std::uint32_t> wanted = counters_.read<std::uint32_t>(2);
  return {wanted[0], wanted[1]};
}

void Lists::gatherLayer(MethodCounts& counts) {
  std::size_t capacity = bytes_ / kNodeBytes;
  const Wanted wanted = gather(capacity, capacity);
  const std::size_t total = std::size_t{wanted[0]} + wanted[1];
  if (total <= capacity) return;
  // Both ends may have met in the middle: with more memory they do not, and where there is no more each gets its share.
  bytes_ = std::min(total * kNodeBytes, most_);
  capacity = bytes_ / kNodeBytes;
  heads_.clear(0);
  gather(capacity, capacity < total ? capacity * wanted[0] / total : capacity);
  ++counts.repeats;
  counts.overflow += total - std::min(total, capacity);
}

MethodCounts peelLists(gl::Frame& frame, const MethodOptions& options, Ends ends) {
  Layers layers(frame, ends, options);
  Lists lists(frame, layers, options);
  MethodCounts counts;
  for (; layers.next(); ++counts.iterations) {
    lists.gatherLayer(counts);
    lists.resolve();
  }
  return counts;
}

}  // namespace

MethodCounts drawF2bLl(gl::Frame& frame, const MethodOptions& options) { return peelLists(frame, options, Ends::Front); }
MethodCounts drawDualLl(gl::Frame& frame, const MethodOptions& options) { return peelLists(frame, options, Ends::Both); }

}  // namespace copeel
