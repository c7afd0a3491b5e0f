// CSG on the ordered fragments of a pixel: winding numbers per leaf, gates above them, surfaces where a result turns from outside to inside.
//
// All fragments of a coplanar group are applied before the results are asked, so coincident faces behave as regularised Booleans do. Among
// the faces of a group that bring the change about, the one of the later leaf shows, and within a leaf the later triangle (DESIGN.md, CSG).
// The cap of a section belongs to the part that it cuts: the later one where parts overlap.
//
// Translucency. Each entry into a solid blends once, with the alpha of the face that shows; leaving it does not. The surface is that of the
// CSG result: walls between two solids of one union do not show. The opaque share of the solid (its tree with the translucent leaves
// that add taken as empty) shows behind, even inside a translucent leaf of the same union. Alpha 0 is not seen at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/csg/eye_winding.h"
#include "apps/csg/gates.h"
#include "apps/csg/render_csg.h"
#include "core/fold/fold.h"
#include "core/image/image.h"

namespace copeel::csg {

struct Surface {
  std::uint32_t primitive;
  std::uint32_t planeClass;
  std::uint32_t leaf;
  std::uint32_t part;
};

// The colour of some surfaces over the background, as the sink wants it: as levels, or as what it adds to the background.
struct PixelColor {
  Rgb8 levels;
  glm::vec3 added{0};
};

// Where a fold leaves its pixels. `surfaces` are front to back; the last may be opaque. Their colour is asked for once where neighbouring pixels show the same.
class PixelSink {
 public:
  virtual ~PixelSink() = default;
  virtual PixelColor color(std::span<const Surface> surfaces) const = 0;
  virtual void pixels(const PixelRect& rect, std::span<const Surface> surfaces, const PixelColor& color) = 0;
};

class CsgFold {
 public:
  // `closed`: per leaf, whether its mesh is known to be closed: behind its last crossing in a tile it is left for good.
  // `alpha`: opacity of a face of the leaf shown for the part; 1 ends the pixel, 0 is passed over.
  using Alpha = double (*)(const void* context, std::uint32_t leaf, std::uint32_t part);

  CsgFold(const GateForest& forest, const EyeWinding& eye, const std::vector<std::uint8_t>& closed, InsideRule rule, Alpha alpha, const void* context, PixelSink& sink)
      : forest_(forest), eye_(eye), closed_(closed), rule_(rule), alpha_(alpha), context_(context), sink_(sink) {}

  bool beginTile(cpu::Tile& tile);
  double narrowTile(cpu::Tile& tile);
  bool mayShow(std::span<const cpu::DepthRange> ranges);
  cpu::DepthRange window(const PixelStack& stack);
  bool needsWholeStack() const { return tileNeedsStack_; }
  double leastFragments() const { return pruned_.leastEntries(); }
  void beginPixel(const PixelStack& stack);
  void fragment(std::uint32_t slot) {
    if (groupCount_ == group_.size()) group_.resize(group_.size() * 2);
    group_[groupCount_++] = slot;
  }
  bool closeGroup();
  void endPixels(const PixelRect& rect) {
    if (surfaces_.empty()) return;   // images start as background
    if (!hasColor_) color_ = sink_.color(surfaces_);
    hasColor_ = true;
    sink_.pixels(rect, surfaces_, color_);
  }

 private:
  // A gate of the tile while a pixel is walked.
  struct Gate {
    std::int32_t lacking;      // true inputs to come before it is true; not positive: it is
    std::uint32_t parent;
    std::uint32_t output;
    bool negated;              // seen by the parent
    bool isTrue() const { return lacking <= 0; }
  };
  // A leaf, with its first use at hand: nearly all leaves have just one.
  struct LeafState {
    std::int32_t winding;
    std::uint32_t gate;        // kNone: the leaf does not matter
    bool negated;
    bool hasMoreUses;
  };

  bool inside(std::int32_t winding) const {
    return rule_ == InsideRule::NonZero ? winding != 0 : rule_ == InsideRule::Positive ? winding > 0 : (winding & 1) != 0;
  }
  void listLeaves(const cpu::Tile& tile);
  void setInitialWindows();
  cpu::DepthRange windowOf(std::uint32_t leaf, const cpu::DepthRange& range) const;
  void feed(std::uint32_t gate, const cpu::DepthRange& input);
  void feedUses(std::uint32_t leaf, const cpu::DepthRange& window);
  cpu::DepthRange findWindows();
  void setInitialState();
  void startInsideStack(const PixelStack& stack);
  void addWinding(std::uint32_t leaf, std::int32_t change);
  void climb(std::uint32_t gate, bool value);
  void noteToggle(std::uint32_t output, bool rises);
  void showRisen();
  void showSurface(std::uint32_t output, std::uint32_t slot);
  std::uint32_t showingFace(std::uint32_t output);
  bool bringsChange(std::uint32_t leaf, std::uint32_t output) const;
  std::uint32_t partBehindCap(std::uint32_t output, std::uint32_t section) const;
  bool fills(std::uint32_t leaf, std::uint32_t output) const;

  const GateForest& forest_;
  const EyeWinding& eye_;
  const std::vector<std::uint8_t>& closed_;    // per leaf: known to be
  InsideRule rule_;
  Alpha alpha_;
  const void* context_;
  PixelSink& sink_;

  // Of the tile. Leaves are numbered as the tile's objects, then come the open leaves around the eye that have no triangle here.
  PrunedForest pruned_;
  const cpu::TileSlot* slots_ = nullptr;
  std::vector<std::uint32_t> leaves_;
  std::vector<std::uint32_t> topOfOutput_;     // gate, or kNone
  struct GateWindow {
    cpu::DepthRange range;                     // where it can be true, then where that matters
    std::int32_t lacking;                      // positive inputs that have not been met
    bool all;                                  // needs all of them, not any
  };
  std::vector<GateWindow> initialWindows_, windows_;   // per gate
  std::vector<Gate> initialGates_;
  std::vector<LeafState> initialStates_;
  bool tileNeedsStack_ = false;

  // Of the pixel.
  bool dirty_ = true;                          // the state differs from the initial one
  std::vector<LeafState> states_;              // per leaf
  std::vector<Gate> gates_;
  std::vector<std::uint32_t> group_ = std::vector<std::uint32_t>(64);   // slots
  std::size_t groupCount_ = 0;
  std::vector<Gate> before_;                   // gates before a group of several fragments
  std::vector<std::int32_t> change_;           // of each leaf's winding in the group, only while a face is sought
  std::vector<std::uint32_t> risen_, fallen_;  // outputs by the first change that the group brought them
  std::vector<Surface> surfaces_;
  PixelColor color_;                           // of the surfaces, once it has been asked for
  bool hasColor_ = false;
  bool enough_ = false;
};

}  // namespace copeel::csg
