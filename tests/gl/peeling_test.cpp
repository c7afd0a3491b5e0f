// The multi-pass peeling methods: whole pixel stacks against those of per-pixel linked lists; passes, bytes and losses against their formulas.
#include <cstdio>
#include <numeric>

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/coplanar_scenes.h"
#include "tests/support/gl_stacks.h"

namespace copeel::test {
namespace {

using Pixel = std::vector<Group>;

constexpr std::uint32_t kMostFragments = 320;   // in a pixel of any scene here
constexpr std::uint64_t kPassThatFindsNothing = 1;   // the papers count passes that find fragments

DrawMethod drawOf(std::string_view name) {
  const MethodInfo* method = findMethod(name);
  COPEEL_CHECK(method && method->draw, "method {}", name);
  return method->draw;
}

// What is true of a scene's stacks and what methods have to make of them.
template <class Value>
std::uint64_t mostOf(const Stacks& stacks, Value value) {
  std::uint64_t most = 0;
  for (const Pixel& pixel : stacks.pixels) most = std::max<std::uint64_t>(most, value(pixel));
  return most;
}

std::uint64_t depthsOf(const Pixel& pixel) { return pixel.size(); }

std::uint64_t idIterations(const Pixel& pixel, std::uint64_t atOnce) {
  std::uint64_t sum = 0;
  for (const Group& group : pixel) sum += (group.size() + atOnce - 1) / atOnce;
  return sum;
}

// Two fragments at each end and iteration; the layer in the middle belongs to the end that comes first, the front if both do at once.
std::uint64_t dualIdIterations(const Pixel& pixel) {
  std::vector<std::uint64_t> rest;
  for (const Group& group : pixel) rest.push_back((group.size() + 1) / 2);
  std::size_t front = 0, end = rest.size();
  std::uint64_t iterations = 0;
  bool backWithin = false;
  for (; front < end; ++iterations) {
    const bool alone = front + 1 == end, back = !alone || backWithin, fore = !alone || !backWithin;
    if (back) backWithin = --rest[end - 1] > 0;
    if (fore && --rest[front] == 0) ++front;
    if (back && !backWithin) --end;
  }
  return iterations;
}

// Depth passes are left out after iterations in which every pixel stays at its layer.
std::uint64_t passesOf3p(const Stacks& stacks) {
  std::vector<bool> leaves(mostOf(stacks, [](const Pixel& p) { return idIterations(p, 2); }) + 1);
  for (const Pixel& pixel : stacks.pixels) {
    std::uint64_t at = 0;
    for (const Group& group : pixel) leaves[at += (group.size() + 1) / 2] = true;
  }
  return 1 + 2 * (leaves.size() - 1) + static_cast<std::uint64_t>(std::count(leaves.begin(), leaves.end(), true));
}

// Of the layers taken in each iteration: the fragments in all pixels.
std::vector<std::uint64_t> layerSizes(const Stacks& stacks, bool dual) {
  std::vector<std::uint64_t> sizes;
  for (const Pixel& pixel : stacks.pixels) {
    for (std::size_t i = 0; i < pixel.size(); ++i) {
      const std::size_t at = dual ? std::min(i, pixel.size() - 1 - i) : i;
      sizes.resize(std::max(sizes.size(), at + 1));
      sizes[at] += pixel[i].size();
    }
  }
  return sizes;
}

// How often a buffer that starts with a node a pixel has to grow, and to how many nodes.
std::pair<std::uint64_t, std::uint64_t> growth(const Stacks& stacks, bool dual) {
  std::uint64_t repeats = 0, nodes = stacks.fragments() > 0 ? stacks.pixels.size() : 0;
  for (const std::uint64_t size : layerSizes(stacks, dual)) {
    if (size <= nodes) continue;
    nodes = size;
    ++repeats;
  }
  return {repeats, nodes};
}

// What is left of each group when `keep` says of a group which.
template <class Keep>
Stacks reduced(const Stacks& stacks, Keep keep) {
  Stacks result{stacks.width, stacks.height, stacks.pixels, {}, {}};
  for (Pixel& pixel : result.pixels) {
    for (Group& group : pixel) group = keep(group);
  }
  return result;
}

Group firstOf(const Group& group) { return {group.front()}; }
Group lastOf(const Group& group) { return {group.back()}; }

std::size_t differing(const Stacks& a, const Stacks& b) {
  std::size_t count = a.pixels.size() != b.pixels.size();
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
  return count;
}

// Pixels in which groups are not of min(k, C(Z)) fragments of the same group.
std::size_t wrongSubsets(const Stacks& all, const Stacks& some, std::uint32_t k) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    bool good = all.pixels[i].size() == some.pixels[i].size();
    for (std::size_t z = 0; good && z < all.pixels[i].size(); ++z) {
      const Group &group = all.pixels[i][z], &part = some.pixels[i][z];
      good = part.size() == std::min<std::size_t>(k, group.size());
      const auto isOfGroup = [&](const Crossing& c) { return std::find(group.begin(), group.end(), c) != group.end(); };
      good = good && std::all_of(part.begin(), part.end(), isOfGroup);
      for (std::size_t a = 1; a < part.size(); ++a) good = good && part[a - 1].primitive < part[a].primitive;
    }
    wrong += !good;
  }
  return wrong;
}

// A scene with its true stacks.
class Peeled {
 public:
  explicit Peeled(const NamedScene& named)
      : named_(named), planes_(named.scene, 0), renderer_(named.scene, planes_), truth_(draw("ll").stacks) {
    // Few capacities, since each makes shaders of its own.
    capacity_ = mostOf(truth_, [](const Pixel& p) { return idIterations(p, 1); }) <= 64 ? 64 : kMostFragments;
  }

  const Stacks& truth() const { return truth_; }
  std::uint64_t pixels() const { return truth_.pixels.size(); }
  std::uint64_t fragments() const { return truth_.fragments(); }
  gl::Renderer& renderer() { return renderer_; }
  GlStacks draw(std::string_view name, const MethodOptions& options = {}, std::uint32_t groups = 0) {
    return glStacksOf(renderer_, named_.view, drawOf(name), options, capacity_, groups);
  }

 private:
  const NamedScene& named_;
  PlaneClasses planes_;
  gl::Renderer renderer_;
  std::uint32_t capacity_ = kMostFragments;   // in a pixel
  Stacks truth_;
};

class Peeling : public testing::TestWithParam<std::size_t> {
 protected:
  static const std::vector<NamedScene>& scenes() {
    static const std::vector<NamedScene> all = coplanarScenes();
    return all;
  }
  Peeling() : peeled_(scenes()[GetParam()]) {}
  std::uint64_t depths() const { return mostOf(peeled_.truth(), depthsOf); }
  void expectCost(const GlStacks& drawn, std::uint64_t passes, std::uint64_t bytes) {
    EXPECT_EQ(drawn.counts.passes, passes);
    EXPECT_EQ(drawn.counts.methodBytes, bytes);
  }
  Peeled peeled_;
  std::uint64_t listNodes_ = 0;
};

TEST_P(Peeling, onePerDepth) {
  const Stacks& truth = peeled_.truth();
  const GlStacks f2b = peeled_.draw("f2b"), f2b2 = peeled_.draw("f2b2"), dual = peeled_.draw("dual");
  // The depth test keeps the first drawn, shading at equal depth the last.
  EXPECT_EQ(differing(f2b.stacks, reduced(truth, firstOf)), 0u);
  EXPECT_EQ(differing(f2b2.stacks, reduced(truth, lastOf)), 0u);
  EXPECT_EQ(differing(dual.stacks, reduced(truth, lastOf)), 0u);
  expectCost(f2b, depths() + kPassThatFindsNothing, 12 * peeled_.pixels());
  expectCost(f2b2, 2 * depths() + kPassThatFindsNothing, 12 * peeled_.pixels());
  expectCost(dual, (depths() + 1) / 2 + 1, 24 * peeled_.pixels());
}

TEST_P(Peeling, everyFragmentById) {
  const Stacks& truth = peeled_.truth();
  const std::uint64_t pairs = mostOf(truth, [](const Pixel& p) { return idIterations(p, 2); });
  const std::uint64_t most = mostOf(truth, [](const Pixel& p) { return idIterations(p, 1); });
  const GlStacks zf = peeled_.draw("f2b-zf"), two = peeled_.draw("f2b-2p"), three = peeled_.draw("f2b-3p"), dual = peeled_.draw("dual-2p");
  EXPECT_EQ(differing(zf.stacks, truth), 0u);
  EXPECT_EQ(differing(two.stacks, truth), 0u);
  EXPECT_EQ(differing(three.stacks, truth), 0u);
  EXPECT_EQ(differing(dual.stacks, truth), 0u);
  expectCost(zf, 2 * most + 1, 28 * peeled_.pixels());
  expectCost(two, 2 * pairs + 1, 28 * peeled_.pixels());
  expectCost(three, passesOf3p(truth), 36 * peeled_.pixels() + 4);
  EXPECT_LE(three.counts.passes, 3 * pairs + 1);
  expectCost(dual, 2 * mostOf(truth, dualIdIterations) + 1, 56 * peeled_.pixels());
}

TEST_P(Peeling, everyFragmentByLists) {
  for (const bool dual : {false, true}) {
    const GlStacks lists = peeled_.draw(dual ? "dual-ll" : "f2b-ll");
    const auto [repeats, nodes] = growth(peeled_.truth(), dual);
    const std::uint64_t passes = 2 * (dual ? (depths() + 1) / 2 : depths()) + kPassThatFindsNothing;
    EXPECT_EQ(differing(lists.stacks, peeled_.truth()), 0u);
    expectCost(lists, passes + lists.counts.method.repeats, (dual ? 24 : 12) * peeled_.pixels() + 8 * std::max(nodes, listNodes_) + 8);
    // What an earlier method's lists have grown to is kept.
    if (listNodes_ == 0) {
      EXPECT_EQ(lists.counts.method.repeats, repeats);
    }
    listNodes_ = std::max(nodes, listNodes_);
    const GlStacks again = peeled_.draw(dual ? "dual-ll" : "f2b-ll");
    EXPECT_EQ(differing(again.stacks, peeled_.truth()), 0u);
    expectCost(again, passes, lists.counts.methodBytes);
  }
}

TEST_P(Peeling, arraysOfK) {
  const Stacks& truth = peeled_.truth();
  // Many layers take many passes: there one length is enough.
  for (const std::uint32_t k : depths() < 100 ? std::vector<std::uint32_t>{1, 2, 8, 32} : std::vector<std::uint32_t>{8}) {
    const auto lastK = [&](const Group& group) { return Group(group.end() - std::min<std::ptrdiff_t>(k, std::ssize(group)), group.end()); };
    for (const std::string name : {"f2b-fab", "f2b-kb", "f2b-kb-zf", "dual-fab", "dual-kb"}) {
      SCOPED_TRACE(name + " of " + std::to_string(k));
      const bool dual = name.starts_with("dual"), counted = name.ends_with("fab");
      const GlStacks drawn = peeled_.draw(name, {.k = k});
      EXPECT_EQ(wrongSubsets(truth, drawn.stacks, k), 0u);
      EXPECT_EQ(drawn.delivered + drawn.counts.method.overflow, peeled_.fragments());
      if (name == "f2b-kb-zf") {
        EXPECT_EQ(differing(drawn.stacks, reduced(truth, lastK)), 0u);
      }
      expectCost(drawn, 2 * (dual ? (depths() + 1) / 2 : depths()) + kPassThatFindsNothing,
                 (dual ? 2 : 1) * (8 + 4 * (k + counted)) * peeled_.pixels() + 4);
    }
  }
}

// A pixel that has enough after its first groups gets no others, whatever is left in those beside it.
TEST_P(Peeling, endsWhenThereIsEnough) {
  for (const std::string name : {"f2b-zf", "f2b-2p", "f2b-3p", "f2b-ll", "f2b-fab", "f2b-kb", "f2b-kb-zf", "dual-2p", "dual-ll", "dual-fab", "dual-kb"}) {
    SCOPED_TRACE(name);
    const std::uint32_t enough = 2;
    const GlStacks drawn = peeled_.draw(name, {.k = kMostFragments}, enough);
    for (std::size_t i = 0; i < drawn.stacks.pixels.size(); ++i) {
      const Pixel &all = peeled_.truth().pixels[i], &some = drawn.stacks.pixels[i];
      const std::size_t wanted = std::min<std::size_t>(enough, all.size());
      ASSERT_GE(some.size(), wanted);
      ASSERT_LE(some.size(), name.starts_with("dual") ? 2 * wanted : wanted);
      ASSERT_TRUE(std::equal(all.begin(), all.begin() + std::ptrdiff_t(wanted), some.begin()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Peeling, testing::Range<std::size_t>(0, coplanarScenes().size()), [](const auto& scene) {
  std::string name = coplanarScenes()[scene.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

}  // namespace
}  // namespace copeel::test
