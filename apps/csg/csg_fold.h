// CSG on the ordered fragments of a pixel: winding numbers per leaf, gates above them, surfaces where a result turns from outside to inside.
//
// All fragments of a coplanar group are applied before the results are asked, so coincident faces behave as regularised Booleans do. Among
// the faces of a group that bring the change about, the one of the later leaf shows, and within a leaf the later triangle (DESIGN.md, CSG).
//
// Translucency. Each entry into a solid blends once, with the alpha of the face that shows; leaving it does not. The surface is that of the
// CSG result: walls between two solids of one union do not show. The opaque share of the solid (its tree with the translucent leaves
// that add taken as empty) shows behind, even inside a translucent leaf of the same union. Alpha 0 is not seen at all.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/csg/eye_winding.h"
#include "apps/csg/gates.h"
#include "apps/csg/render_csg.h"
#include "core/fold/fold.h"

namespace copeel::csg {

struct Surface {
  std::uint32_t primitive;
  std::uint32_t planeClass;
  std::uint32_t leaf;
  std::uint32_t part;
};

// Where a fold leaves its pixels. `surfaces` are front to back; the last may be opaque.
class PixelSink {
 public:
  virtual ~PixelSink() = default;
  virtual void pixel(int x, int y, const std::vector<Surface>& surfaces) = 0;
};

class CsgFold {
 public:
  // `alpha`: opacity of a face of the leaf shown for the part; 1 ends the pixel, 0 is passed over.
  using Alpha = double (*)(const void* context, std::uint32_t leaf, std::uint32_t part);

  CsgFold(const GateForest& forest, const EyeWinding& eye, InsideRule rule, Alpha alpha, const void* context, PixelSink& sink)
      : forest_(forest), eye_(eye), rule_(rule), alpha_(alpha), context_(context), sink_(sink) {}

  bool beginTile(cpu::Tile& tile);
  bool needsWholeStack() const { return tileNeedsStack_; }
  void beginPixel(const PixelStack& stack);
  void fragment(std::uint32_t slot) { group_.push_back(slot); }
  bool closeGroup();
  bool enough() const { return enough_; }
  void endPixel(int x, int y) { sink_.pixel(x, y, surfaces_); }

 private:
  bool inside(std::int32_t winding) const {
    return rule_ == InsideRule::NonZero ? winding != 0 : rule_ == InsideRule::Positive ? winding > 0 : (winding & 1) != 0;
  }
  bool nodeTrue(std::uint32_t node) const { return counts_[node] >= nodes_[node].threshold; }
  void addWinding(std::uint32_t local, std::int32_t change);
  void toggle(std::uint32_t local, bool nowInside);
  void showSurface(std::uint32_t output);
  std::uint32_t showingFace(std::uint32_t output);
  bool bringsChange(std::uint32_t local, std::uint32_t output) const;

  const GateForest& forest_;
  const EyeWinding& eye_;
  InsideRule rule_;
  Alpha alpha_;
  const void* context_;
  PixelSink& sink_;

  // Of the tile.
  PrunedForest pruned_;
  std::span<const PrunedForest::Node> nodes_;
  const cpu::TileSlot* slots_ = nullptr;
  std::vector<std::uint32_t> leaves_;          // local to scene
  std::vector<std::uint32_t> localOfObject_;   // of the tile's objects, which are fewer when an open leaf around the eye has no triangle here
  std::vector<std::uint32_t> topOfOutput_;     // node, or kNone
  std::vector<std::int32_t> initialCounts_;
  std::vector<std::int32_t> initialWinding_;
  bool tileNeedsStack_ = false;

  // Of the pixel.
  std::vector<std::int32_t> winding_, counts_;
  std::vector<std::uint32_t> group_;           // slots
  std::vector<std::int32_t> before_;           // counts before a group of several fragments
  std::vector<std::int32_t> change_;           // of each leaf's winding in the group, only while a face is sought
  std::vector<std::uint32_t> risen_;           // outputs that became true in the group
  std::vector<Surface> surfaces_;
  bool enough_ = false;
};

}  // namespace copeel::csg
