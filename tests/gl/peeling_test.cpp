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
constexpr std::uint64_t kManyLayers = 100;        // scenes with so many take hundreds of passes a method
constexpr std::uint64_t kPassThatFindsNothing = 1;   // the papers count passes that find fragments

DrawMethod drawOf(std::string_view name) {
  const MethodInfo* method = findMethod(name, "gl");
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

// One fragment by the pass that finds a layer, two by each of the others it takes.
std::uint64_t hybridIterations(const Pixel& pixel) {
  std::uint64_t sum = 0;
  for (const Group& group : pixel) sum += 1 + group.size() / 2;
  return sum;
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
  explicit Peeled(const NamedScene& named, gl::DepthSource source = gl::DepthSource::Planes)
      : named_(named), planes_(named.scene, 0), renderer_(named.scene, planes_, source), truth_(draw("ll").stacks) {
    // Few capacities, since each makes shaders of its own.
    capacity_ = mostOf(truth_, [](const Pixel& p) { return idIterations(p, 1); }) <= 64 ? 64 : kMostFragments;
  }

  const Stacks& truth() const { return truth_; }
  std::uint64_t pixels() const { return truth_.pixels.size(); }
  std::uint64_t fragments() const { return truth_.fragments(); }
  gl::Renderer& renderer() { return renderer_; }
  // Fragments, groups and the largest group of each pixel, as the device counts them.
  std::vector<std::uint32_t> count(std::string_view name) {
    renderer_.setView(named_.view);
    renderer_.setFold({.defines = {{"FOLD", "core/fold/count.glsl"}}, .stateWords = 4, .resultWords = 3, .tables = {}});
    renderer_.draw(drawOf(name), {});
    return renderer_.result();
  }
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

TEST_P(Peeling, onDemand) {
  const Stacks& truth = peeled_.truth();
  const GlStacks hybrid = peeled_.draw("hybrid");
  EXPECT_EQ(differing(hybrid.stacks, truth), 0u);
  expectCost(hybrid, mostOf(truth, hybridIterations) + kPassThatFindsNothing, 28 * peeled_.pixels());
  EXPECT_LE(hybrid.counts.passes, passesOf3p(truth));
  // Where nothing is coplanar it is f2b; of three fragments it takes no more passes than f2b2 of one.
  const std::uint64_t largest = mostOf(truth, [](const Pixel& p) {
    std::size_t most = 0;
    for (const Group& group : p) most = std::max(most, group.size());
    return most;
  });
  if (largest <= 1) {
    EXPECT_EQ(hybrid.counts.passes, depths() + 1);
  }
  if (largest <= 3) {
    EXPECT_LE(hybrid.counts.passes, 2 * depths() + 1);
  }
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
  for (const std::uint32_t k : depths() < kManyLayers ? std::vector<std::uint32_t>{1, 2, 8, 32} : std::vector<std::uint32_t>{8}) {
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
  for (const std::string name : {"f2b-zf", "f2b-2p", "f2b-3p", "hybrid", "f2b-ll", "f2b-fab", "f2b-kb", "f2b-kb-zf", "dual-2p", "dual-ll", "dual-fab", "dual-kb"}) {
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

TEST_P(Peeling, foldsThatCount) {
  std::vector<std::uint32_t> expected;
  for (const Pixel& pixel : peeled_.truth().pixels) {
    std::size_t fragments = 0, largest = 0;
    for (const Group& group : pixel) fragments += group.size(), largest = std::max(largest, group.size());
    for (const std::size_t word : {fragments, pixel.size(), largest}) expected.push_back(static_cast<std::uint32_t>(word));
  }
  for (const std::string name : {"f2b-zf", "f2b-2p", "f2b-3p", "hybrid", "f2b-ll", "dual-2p", "dual-ll"}) {
    EXPECT_EQ(peeled_.count(name), expected) << name;
  }
}

// Objects passed over when they are wholly peeled change nothing but what is drawn.
TEST_P(Peeling, cullingChangesNothing) {
  if (depths() >= kManyLayers) GTEST_SKIP() << "one object";
  for (const std::string name : {"f2b", "f2b-3p", "hybrid", "f2b-fab", "dual", "dual-2p", "dual-kb"}) {
    SCOPED_TRACE(name);
    const GlStacks plain = peeled_.draw(name, {.k = 2}), culled = peeled_.draw(name, {.k = 2, .cull = true});
    EXPECT_EQ(culled.delivered, plain.delivered);
    EXPECT_EQ(culled.counts.passes, plain.counts.passes);
    EXPECT_EQ(culled.counts.methodBytes, plain.counts.methodBytes);
    // Which fragments come first to a buffer that is too short is the device's affair.
    if (culled.counts.method.overflow == 0) {
      EXPECT_EQ(differing(plain.stacks, culled.stacks), 0u);
    }
    for (std::size_t i = 0; i < culled.counts.objectsDrawn.size(); ++i) EXPECT_LE(culled.counts.objectsDrawn[i], plain.counts.objectsDrawn[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Peeling, testing::Range<std::size_t>(0, coplanarScenes().size()), [](const auto& scene) {
  std::string name = coplanarScenes()[scene.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

// Three objects of two layers each, one behind another; none lies in a plane of another's, which would let its depths run to the other's.
std::vector<std::uint32_t> drawnOfThree(const Mesh& mesh, std::string_view method, const glm::dmat4& turn = glm::dmat4(1.0)) {
  const MeshPointer shared = share(mesh);
  const Scene scene({{shared, translation({0, 0, 4}) * turn}, {shared, scaling({0.9, 0.9, 1})}, {shared, translation({0, 0, -4}) * scaling({0.8, 0.8, 1})}});
  const NamedScene row{"row", scene, lookAt({0, 0, 10}, {0, 0, 0}, 32, 24, 0.1, false)};
  return Peeled(row).draw(method, {.cull = true}).counts.objectsDrawn;
}

// A cube is at an end with its second layer; at a sphere's silhouette nothing says so before the next layer is found behind it.
TEST(PeelingCulls, finishedObjects) {
  const Mesh cube = box({-1, -1, -1}, {1, 1, 1}), ball = sphere(1, 16, 8);
  using Drawn = std::vector<std::uint32_t>;
  EXPECT_EQ(drawnOfThree(cube, "f2b"), (Drawn{3, 3, 2, 2, 1, 1, 0}));
  EXPECT_EQ(drawnOfThree(ball, "f2b"), (Drawn{3, 3, 3, 2, 2, 1, 1}));
  // The box of a turned mesh sticks out of the scene's.
  EXPECT_EQ(drawnOfThree(ball, "f2b", rotation({0, 0, 45})), (Drawn{3, 3, 3, 2, 2, 1, 1}));
  EXPECT_EQ(drawnOfThree(cube, "hybrid"), (Drawn{3, 3, 2, 2, 1, 1, 0}));
  // Two passes an iteration, then the one that finds nothing.
  EXPECT_EQ(drawnOfThree(cube, "f2b-2p"), (Drawn{3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0}));
  // From both ends the object in the middle is left, and the room between its layers at last.
  EXPECT_EQ(drawnOfThree(cube, "dual-fab"), (Drawn{3, 3, 3, 3, 1, 1, 1}));
  EXPECT_EQ(drawnOfThree(cube, "dual"), (Drawn{3, 3, 3, 1}));
}

// 2011, Table 1. Coincident copies of a closed mesh, eight layers of it in the deepest pixels.
struct Row {
  std::string method;
  std::uint64_t peeled[4], perMille[4], passes[4];
  std::uint64_t more;   // passes that find nothing, which the table leaves out
};

TEST(PeelingTables, vasilakisFudos2011) {
  const std::size_t copyCounts[4] = {1, 4, 8, 12};
  const Row rows[] = {{"f2b", {8, 8, 8, 8}, {1000, 250, 125, 83}, {8, 8, 8, 8}, kPassThatFindsNothing},
                      // Its last pass fetches the last fragment in the paper; here it finds no next layer.
                      {"f2b-zf", {8, 32, 64, 96}, {1000, 1000, 1000, 1000}, {17, 65, 129, 193}, 0},
                      {"f2b-kb-zf", {8, 32, 64, 64}, {1000, 1000, 1000, 666}, {16, 16, 16, 16}, kPassThatFindsNothing}};
  const MeshPointer shells =
      share(joined(joined(sphere(1, 17, 9), flipped(sphere(0.8, 17, 9))), joined(sphere(0.6, 17, 9), flipped(sphere(0.4, 17, 9)))));
  for (int i = 0; i < 4; ++i) {
    const NamedScene scene{"copies", copies(shells, copyCounts[i]), lookAt({3, 2, 4}, {0, 0, 0}, 24, 18, 0.03)};
    Peeled peeled(scene);
    for (const Row& row : rows) {
      SCOPED_TRACE(fmt::format("{} of {}", row.method, copyCounts[i]));
      const GlStacks drawn = peeled.draw(row.method, {.k = 8});
      const std::uint64_t most = mostOf(drawn.stacks, [](const Pixel& p) { return idIterations(p, 1); });
      EXPECT_EQ(most, row.peeled[i]);
      EXPECT_EQ(1000 * drawn.delivered / peeled.fragments(), row.perMille[i]);
      EXPECT_EQ(drawn.counts.passes - row.more, row.passes[i]);
      std::printf("%-10s %2zu copies: %2d fragments, %5.1f %%, %3d passes\n", row.method.c_str(), copyCounts[i], int(most),
                  100.0 * double(drawn.delivered) / double(peeled.fragments()), int(drawn.counts.passes - row.more));
    }
  }
}

// The passes of 1, 4 and 12 coincident copies of those shells: two kinds of work in one pass make it cheaper than any method it stands between.
TEST(PeelingTables, hybridOfCopies) {
  const MeshPointer shells =
      share(joined(joined(sphere(1, 17, 9), flipped(sphere(0.8, 17, 9))), joined(sphere(0.6, 17, 9), flipped(sphere(0.4, 17, 9)))));
  const std::pair<std::size_t, std::uint64_t> passes[] = {{1, 8 * 1}, {4, 8 * 3}, {12, 8 * 7}};
  for (const auto& [count, expected] : passes) {
    const NamedScene scene{"copies", copies(shells, count), lookAt({3, 2, 4}, {0, 0, 0}, 24, 18, 0.03)};
    Peeled peeled(scene);
    const GlStacks drawn = peeled.draw("hybrid"), again = peeled.draw("hybrid"), three = peeled.draw("f2b-3p");
    EXPECT_EQ(differing(drawn.stacks, peeled.truth()), 0u);
    EXPECT_EQ(drawn.counts.passes, expected + kPassThatFindsNothing);
    EXPECT_LT(drawn.counts.passes, three.counts.passes);
    EXPECT_EQ(again.counts.passes, drawn.counts.passes);
    EXPECT_EQ(again.counts.methodBytes, drawn.counts.methodBytes);
    EXPECT_EQ(peeled.count("hybrid"), peeled.count("ll"));
  }
}

// Buffers that --memory holds short: what was captured and what was not are all.
TEST(PeelingMemory, isKept) {
  const NamedScene scene{"copies", copies(share(sphere(1, 13, 7)), 9), lookAt({3, 2, 4}, {0, 0, 0}, 32, 24, 0.03)};
  Peeled peeled(scene);
  const std::uint64_t pixels = peeled.pixels();
  for (const std::string name : {"f2b-ll", "dual-ll", "f2b-fab", "f2b-kb", "dual-fab", "dual-kb"}) {
    SCOPED_TRACE(name);
    // Room for a hundred nodes, or arrays of three or four.
    const std::uint64_t sides = name.starts_with("dual") ? 2 : 1, limit = name.ends_with("ll") ? pixels * 12 * sides + 1032 : pixels * 24 * sides;
    const GlStacks drawn = peeled.draw(name, {.k = 32, .memoryBytes = limit});
    EXPECT_LE(drawn.counts.methodBytes, limit);
    EXPECT_GT(drawn.counts.method.overflow, 0u);
    EXPECT_GT(drawn.delivered, 0u);
    EXPECT_EQ(drawn.delivered + drawn.counts.method.overflow, peeled.fragments());
  }
}

// The same objects in the opposite order: the same stacks, with the ids that primitives have there.
TEST(PeelingOrder, ofObjectsDoesNotMatter) {
  const NamedScene forward = coplanarScenes()[4];
  const std::vector<Object>& objects = forward.scene.objects();
  const NamedScene backward{"backward", Scene({objects.rbegin(), objects.rend()}), forward.view};
  Stacks expected = Peeled(forward).truth();
  const auto last = static_cast<std::uint32_t>(objects.size() - 1);
  for (Pixel& pixel : expected.pixels) {
    for (Group& group : pixel) {
      for (Crossing& c : group) {
        const std::uint32_t object = forward.scene.objectOf(c.primitive);
        c.primitive += backward.scene.firstPrimitive(last - object) - forward.scene.firstPrimitive(object);
      }
      std::sort(group.begin(), group.end(), [](const Crossing& a, const Crossing& b) { return a.primitive < b.primitive; });
    }
  }
  Peeled reversed(backward);
  for (const std::string name : {"f2b-zf", "f2b-2p", "f2b-3p", "hybrid", "f2b-ll", "dual-2p", "dual-ll"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(differing(reversed.draw(name).stacks, expected), 0u);
  }
}

// The rasterizer's own depth, as in the papers: other groups, and the same from every robust method.
TEST(PeelingDepth, ofTheRasterizer) {
  const NamedScene city = coplanarScenes()[4];
  Peeled peeled(city, gl::DepthSource::Hardware);
  for (const std::string name : {"f2b-zf", "f2b-2p", "f2b-3p", "hybrid", "f2b-ll", "dual-2p", "dual-ll"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(differing(peeled.draw(name, {.cull = true}).stacks, peeled.truth()), 0u);
  }
}

}  // namespace
}  // namespace copeel::test
