// The whole pixel stacks of a scene as a method of the gl back end delivers them, in the form of tests/support/stacks.h.
#pragma once

#include <algorithm>
#include <optional>

#include "core/gl/layout.h"
#include "core/gl/renderer.h"
#include "tests/support/stacks.h"

namespace copeel::test {

struct GlStacks {
  Stacks stacks;
  gl::FrameCounts counts;
  std::uint64_t delivered = 0;
};

constexpr std::uint32_t kBehind = 0x80000000;   // of core/fold/record.glsl

// A group is delivered inwards from its ends: ids descend from the front and ascend from the rear, and no front one lies behind one from the rear.
struct GroupEnds {
  std::uint32_t lastFront = ~std::uint32_t{0}, lastBehind = 0;
  bool anyBehind = false;
  void take(std::uint32_t primitive, bool behind) {
    COPEEL_CHECK(behind ? !anyBehind || primitive > lastBehind : primitive < lastFront, "primitive {} out of order", primitive);
    (behind ? lastBehind : lastFront) = primitive;
    anyBehind |= behind;
    COPEEL_CHECK(!anyBehind || lastBehind < lastFront, "primitive {} met from both ends", primitive);
  }
};

// Groups of one side, in the order they were delivered; within a group by primitive.
inline std::vector<Group> groupsOf(const std::uint32_t* entries, std::uint32_t count, int step) {
  std::vector<Group> groups;
  std::uint32_t open = ~std::uint32_t{0};
  GroupEnds ends;
  for (std::uint32_t i = 0; i < count; ++i, entries += step * 2) {
    const std::uint32_t group = entries[1] & ~kBehind, primitive = entries[0] & COPEEL_ID_PRIMITIVE;
    if (groups.empty() || group != open) groups.emplace_back(), ends = {};
    open = group;
    ends.take(primitive, entries[1] & kBehind);
    groups.back().push_back({primitive, entries[0] & COPEEL_ID_BACK ? -1 : 1});
  }
  for (Group& group : groups) std::sort(group.begin(), group.end(), [](const Crossing& a, const Crossing& b) { return a.primitive < b.primitive; });
  return groups;
}

// `capacity`: fragments that can be recorded of a pixel; a method that delivers more fails the test. `enough`: groups after which a side wants no others; 0: all.
inline GlStacks glStacksOf(gl::Renderer& renderer, const View& view, DrawMethod method, const MethodOptions& options, std::uint32_t capacity,
                           std::uint32_t enough = 0) {
  renderer.setView(view);
  gl::FoldSource fold;
  fold.defines = {{"FOLD", "core/fold/record.glsl"}, {"FOLD_RECORD_CAPACITY", fmt::format("{}", capacity)}};
  if (enough > 0) fold.defines.emplace_back("FOLD_RECORD_GROUPS", fmt::format("{}", enough));
  fold.stateWords = 2;
  fold.resultWords = 2 + 2 * capacity;
  renderer.setFold(fold);
  GlStacks result{{view.width, view.height, {}, {}, {}}, renderer.draw(method, options), 0};
  const std::vector<std::uint32_t> words = renderer.result();
  for (std::size_t pixel = 0; pixel * fold.resultWords < words.size(); ++pixel) {
    const std::uint32_t* record = words.data() + pixel * fold.resultWords;
    COPEEL_CHECK(record[0] + record[1] <= capacity, "pixel {}: {} + {} fragments", pixel, record[0], record[1]);
    std::vector<Group> groups = groupsOf(record + 2, record[0], 1);
    std::vector<Group> back = groupsOf(record + 2 + 2 * (capacity - 1), record[1], -1);
    groups.insert(groups.end(), back.rbegin(), back.rend());
    result.delivered += record[0] + record[1];
    result.stacks.pixels.push_back(std::move(groups));
  }
  return result;
}

}  // namespace copeel::test
