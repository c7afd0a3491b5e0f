// Pictures by hand: what lies in front of what, what is counted, and what may not change a pixel.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/cpu/kernels.h"
#include "tests/support/parts.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

const View kAbove = lookAt({0.521, 0.532, 20}, {0.521, 0.532, 0}, 21, 21, 0.001);
const View kOblique = lookAt({7, -9, 6}, {0, 0, 0}, 200, 150, 0.004);
const glm::vec4 kRed(200, 0, 0, 0.5), kGreen(0, 200, 0, 0.5), kBlue(0, 0, 200, 0.5), kSolidBlue(0, 0, 200, 1), kNothing(255, 255, 255, 0);

Mesh square(double z) { return quad({0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}); }

struct Middle {
  Rgb8 color;
  float depth;
  int id, layers, coplanar;
};
Middle middle(const std::vector<oit::Part>& parts) {
  const oit::Frame frame = drawParts(parts, kAbove).frame;
  return {frame.color.at(10, 10), frame.depth.at(10, 10), frame.ids.at(10, 10), frame.layers.at(10, 10), frame.coplanar.at(10, 10)};
}

bool sameBytes(const oit::Frame& a, const oit::Frame& b) {
  return a.color.pixels == b.color.pixels && a.floats.pixels == b.floats.pixels && a.depth.pixels == b.depth.pixels && a.ids.pixels == b.ids.pixels &&
         a.layers.pixels == b.layers.pixels && a.coplanar.pixels == b.coplanar.pixels;
}

TEST(Oit, theNearerFragmentLiesInFrontWhateverTheOrderOfParts) {
  EXPECT_EQ(middle({part(square(2), kRed), part(square(1), kGreen)}).color, (Rgb8{100, 50, 0}));
  EXPECT_EQ(middle({part(square(1), kGreen), part(square(2), kRed)}).color, (Rgb8{100, 50, 0}));
}

TEST(Oit, ofCoplanarPartsTheLaterLiesInFront) {
  EXPECT_EQ(middle({part(square(1), kRed), part(square(1), kGreen)}).color, (Rgb8{50, 100, 0}));
  EXPECT_EQ(middle({part(square(1), kGreen), part(square(1), kRed)}).color, (Rgb8{100, 50, 0}));
  EXPECT_EQ(middle({part(square(1), kGreen), part(flipped(square(1)), kRed), part(fanSquare(1, 20), kBlue)}).color, (Rgb8{50, 25, 100}));
}

TEST(Oit, withinAPartTheLaterTriangleLiesInFront) {
  oit::Part twice = part(joined(square(1), square(1)), kRed);
  twice.faceColors = {kRed, kRed, kGreen, kGreen};
  EXPECT_EQ(middle({twice}).color, (Rgb8{50, 100, 0}));
}

TEST(Oit, opaqueHidesAndAlphaZeroIsNotSeenButCounts) {
  const Middle seen = middle({part(square(3), kNothing), part(square(2), kRed), part(square(1), kSolidBlue), part(square(0), kGreen), part(square(0), kRed)});
  EXPECT_EQ(seen.color, (Rgb8{100, 0, 100}));
  EXPECT_EQ(seen.depth, 18);
  EXPECT_EQ(seen.id, 2);
  EXPECT_EQ(seen.layers, 5);
  EXPECT_EQ(seen.coplanar, 2);
}

TEST(Oit, nothingIsTheBackground) {
  const oit::Frame frame = drawParts({part(square(1), kRed)}, lookAt({0.5, 0.5, 20}, {0.5, 0.5, 40}, 21, 21, 0.001)).frame;
  EXPECT_EQ(frame.color.at(10, 10), Rgb8{});
  EXPECT_TRUE(std::isinf(frame.depth.at(10, 10)));
  EXPECT_EQ(frame.ids.at(10, 10) + frame.layers.at(10, 10) + frame.coplanar.at(10, 10), 0);
}

TEST(Oit, theOrderOfEqualPartsAndOfTrianglesChangesNothing) {
  std::vector<oit::Part> parts;
  for (unsigned i = 0; i < 6; ++i) parts.push_back(part(shuffled(bumpySphere(1.5 + 0.2 * (i / 2), 40, 20), i), kRed));
  const oit::Frame first = drawParts(parts, kOblique).frame;
  std::reverse(parts.begin(), parts.end());
  const oit::Frame second = drawParts(parts, kOblique).frame;
  EXPECT_EQ(first.color.pixels, second.color.pixels);
  EXPECT_EQ(first.floats.pixels, second.floats.pixels);
  EXPECT_EQ(first.depth.pixels, second.depth.pixels);
  EXPECT_EQ(first.layers.pixels, second.layers.pixels);
  EXPECT_EQ(first.coplanar.pixels, second.coplanar.pixels);
}

TEST(Oit, threadsChangeNothing) {
  std::vector<oit::Part> parts;
  for (const glm::vec4& color : {kRed, kGreen, kSolidBlue, kBlue}) parts.push_back(part(torusKnot(0.8, 80, 8), color));
  oit::RenderOptions one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_TRUE(sameBytes(drawParts(parts, kOblique, one).frame, drawParts(parts, kOblique, two).frame));
}

std::vector<std::vector<oit::Part>> assortment() {
  std::vector<oit::Part> copies, planes;
  for (unsigned i = 0; i < 7; ++i) copies.push_back(part(shuffled(bumpySphere(1.5 + 0.2 * (i / 3), 90, 50), i), {40 * i, 200, 90, 0.15 * i}));
  for (const glm::vec4& color : {kRed, kNothing, kGreen, kBlue}) planes.push_back(part(square(1), color, rotation({0, 80, 0}) * scaling({5, 5, 5})));
  planes.push_back(part(fanSquare(1, 20), kNothing, scaling({3, 3, 3})));
  planes.push_back(part(square(-1), kSolidBlue, scaling({6, 6, 6})));
  return {{part(bumpySphere(2, 40, 20), kRed), part(sphere(1.5, 40, 20), kSolidBlue), part(torusKnot(0.8, 80, 8), kGreen)}, copies, planes};
}

// Wanting the counts makes the fold look behind opaque surfaces and take pixels one by one; otherwise whole blocks are blended at once.
TEST(Oit, countingChangesNoColourOnAnySimdTarget) {
  for (const std::vector<oit::Part>& parts : assortment()) {
    const OitDrawing counted = drawParts(parts, kOblique);
    for (const char* target : {"scalar", "sse4", "avx2", "best"}) {
      cpu::chooseSimd(target);
      for (const bool colorOnly : {true, false}) {
        oit::RenderOptions options = unlit();
        options.wantFloats = options.wantDepth = options.wantIds = !colorOnly;
        oit::Renderer renderer(parts, options);
        const oit::Frame frame = renderer.draw(kOblique);
        EXPECT_EQ(frame.color.pixels, counted.frame.color.pixels) << target;
        // What opaque faces hide is counted only where counts are wanted.
        const bool hides = std::any_of(parts.begin(), parts.end(), [](const oit::Part& p) { return p.color.a >= 1; });
        if (!hides) {
          EXPECT_EQ(renderer.stats().coplanarPixels, counted.stats.coplanarPixels) << target;
        }
        if (colorOnly) continue;
        EXPECT_EQ(frame.floats.pixels, counted.frame.floats.pixels) << target;
        EXPECT_EQ(frame.depth.pixels, counted.frame.depth.pixels) << target;
        EXPECT_EQ(frame.ids.pixels, counted.frame.ids.pixels) << target;
      }
    }
    cpu::chooseSimd("best");
  }
}

// One mesh placed several times in one place is projected once; a mesh of its own for each is not.
TEST(Oit, aMeshPlacedTwiceIsAsTwoMeshes) {
  const Mesh body = bumpySphere(2, 40, 20);
  const oit::Part shared = part(body, kRed);
  const View inside = lookAt({0.1, 0.2, 0.1}, {3, 1, 0}, 60, 50, 0.02);
  for (const View& view : {kOblique, inside}) {
    oit::Part moved = shared;
    moved.worldFromObject = translation({0.5, 0, 0});
    const oit::Frame once = drawParts({shared, shared, moved, moved, shared}, view).frame;
    const oit::Frame each = drawParts({part(body, kRed), part(body, kRed), part(body, kRed, moved.worldFromObject), part(body, kRed, moved.worldFromObject), part(body, kRed)}, view).frame;
    EXPECT_TRUE(sameBytes(once, each));
  }
}

TEST(Oit, samplesAreTheMeanOfPicturesAndDepthIsTheCentres) {
  const std::vector<oit::Part> parts = {part(bumpySphere(2, 40, 20), kRed), part(torusKnot(0.8, 80, 8), kGreen)};
  oit::RenderOptions smooth = unlit();
  smooth.samples = 16;
  const OitDrawing once = drawParts(parts, kOblique), often = drawParts(parts, kOblique, smooth);
  EXPECT_EQ(once.frame.depth.pixels, often.frame.depth.pixels);
  EXPECT_EQ(once.frame.layers.pixels, often.frame.layers.pixels);
  EXPECT_EQ(once.stats.fragments, often.stats.fragments);
  double difference = 0, greatest = 0;
  for (std::size_t i = 0; i < once.frame.floats.pixels.size(); ++i) {
    const double d = once.frame.floats.pixels[i].g - often.frame.floats.pixels[i].g;
    difference += d;
    greatest = std::max(greatest, std::abs(d));
  }
  EXPECT_LT(std::abs(difference) / double(once.frame.floats.pixels.size()), 0.2);
  EXPECT_GT(greatest, 10);   // edges were smoothed
}

// Coplanar fragments that an opaque one hides are not met: blocks count pixels as a walk through each does.
TEST(Oit, blocksMeetCoplanarFragmentsWhereAWalkDoes) {
  const View view = lookAt({0.4, 0.3, 20}, {0.4, 0.3, 0}, 45, 29, 0.003);   // some blocks are cut off
  const glm::vec4 kSolidRed(200, 0, 0, 1);
  const std::vector<std::vector<oit::Part>> cases = {
      {part(square(2), kSolidBlue), part(square(1), kRed), part(square(1), kGreen)},   // hidden
      {part(square(1), kSolidBlue), part(square(1), kRed), part(square(0), kGreen)},   // the last of a pair ends no pixel
      {part(square(1), kRed), part(square(1), kSolidRed), part(square(0), kGreen)},    // the first of a pair ends it
      {part(square(2), kRed), part(square(1), kGreen), part(square(1), kRed), part(square(0), kSolidBlue)},
  };
  const std::uint64_t expectedPixels[] = {0, 1, 1, 1};
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    oit::RenderOptions options = unlit();
    options.wantDepth = options.wantIds = options.wantLayers = options.wantCoplanar = false;
    oit::Renderer blocks(cases[i], options);
    const oit::Frame frame = blocks.draw(view);
    options.decideAllExactly = true;
    oit::Renderer walks(cases[i], options);
    EXPECT_EQ(walks.draw(view).color.pixels, frame.color.pixels) << "case " << i;
    EXPECT_EQ(blocks.stats().coplanarPixels, walks.stats().coplanarPixels) << "case " << i;
    EXPECT_EQ(blocks.stats().coplanarPixels > 0, expectedPixels[i] > 0) << "case " << i;
  }
}

TEST(Oit, theZBufferKeepsTheNearestAlone) {
  oit::RenderOptions options = unlit();
  options.method = findMethod("zbuffer");
  const oit::Frame frame = drawParts({part(square(2), kRed), part(square(1), kGreen)}, kAbove, options).frame;
  EXPECT_EQ(frame.color.at(10, 10), (Rgb8{100, 0, 0}));
  EXPECT_EQ(frame.ids.at(10, 10), 1);
}

TEST(Oit, theZBufferShowsTheLaterOfCoplanarParts) {
  oit::RenderOptions options = unlit();
  options.method = findMethod("zbuffer");
  const oit::Frame frame = drawParts({part(square(1), kRed), part(flipped(square(1)), kGreen), part(square(0), kBlue)}, kAbove, options).frame;
  EXPECT_EQ(frame.color.at(10, 10), (Rgb8{0, 100, 0}));
  EXPECT_EQ(frame.ids.at(10, 10), 2);
}

// Depths of such faces are so uncertain that keys tell no order, but of one fragment there is none to tell.
TEST(Oit, theZBufferShowsFacesSeenEdgeOnToo) {
  const std::vector<oit::Part> plate{part(box({0, 0, 0}, {1, 1e4, 1}), glm::vec4(200, 100, 50, 1))};
  for (const bool perspective : {false, true}) {
    for (const double above : {5e-4, 1e-9, 0.0}) {
      const View view = lookAt({0.5, -5, 1 + above}, {0.5, 0, 1}, 64, 48, perspective ? 0.01 : 0.04, perspective);
      const oit::Frame tile = drawParts(plate, view, unlit()).frame;
      oit::RenderOptions options = unlit();
      options.method = findMethod("zbuffer");
      const oit::Frame nearest = drawParts(plate, view, options).frame;
      EXPECT_EQ(nearest.color.pixels, tile.color.pixels) << perspective << ", " << above;
      EXPECT_EQ(nearest.ids.pixels, tile.ids.pixels) << perspective << ", " << above;
      EXPECT_GT(std::count(tile.ids.pixels.begin(), tile.ids.pixels.end(), 1), 200) << perspective << ", " << above;
    }
  }
}

oit::RenderOptions kBuffer(std::string_view method, std::uint32_t k) {
  oit::RenderOptions options = unlit();
  options.method = findMethod(method, "cpu");
  options.methodOptions.k = k;
  return options;
}

TEST(Oit, kBuffersBlendTheKNearest) {
  const std::vector<oit::Part> parts{part(square(1), kRed), part(square(1), kGreen), part(square(2), kNothing), part(square(0), kBlue)};
  const Rgb8 expected[] = {{0, 0, 0}, {0, 100, 0}, {50, 100, 0}, {50, 100, 25}, {50, 100, 25}};
  for (const char* method : {"kb", "k-plus"}) {
    for (std::uint32_t k = 1; k <= 5; ++k) {
      const OitDrawing drawing = drawParts(parts, kAbove, kBuffer(method, k));
      EXPECT_EQ(drawing.frame.color.at(10, 10), expected[k - 1]) << method << ", K " << k;
      EXPECT_EQ(drawing.frame.layers.at(10, 10), std::min(k, 4u)) << method << ", K " << k;
    }
  }
}

TEST(Oit, kBuffersCountWhatTheyLose) {
  std::vector<oit::Part> parts;
  for (int i = 0; i < 4; ++i) parts.push_back(part(torusKnot(0.8, 200, 8), glm::vec4(60 * i, 200 - 50 * i, 90, i == 3 ? 1 : 0.3), rotation({30.0 * (i / 2), 0, 0})));
  oit::RenderOptions whole = unlit();
  const std::vector<oit::Part> seeThrough(parts.begin(), parts.end() - 1);
  const OitDrawing tile = drawParts(seeThrough, kOblique, whole);
  ASSERT_GT(tile.stats.depthComplexityMax, 12u);
  for (const std::uint32_t k : {1u, 2u, 8u, 32u, 1024u}) {
    std::uint64_t captured = 0;
    for (const std::uint16_t n : tile.frame.layers.pixels) captured += std::min<std::uint64_t>(k, n);
    const OitDrawing one = drawParts(seeThrough, kOblique, kBuffer("k-plus", k));
    EXPECT_EQ(one.stats.fragments, tile.stats.fragments);
    EXPECT_EQ(one.stats.fragmentsCaptured, captured);
    EXPECT_EQ(one.stats.overflow, tile.stats.fragments - captured);
    for (const char* method : {"kb", "k-plus"}) {
      for (const int threads : {1, 2}) {
        oit::RenderOptions options = kBuffer(method, k);
        options.threads = threads;
        const OitDrawing again = drawParts(seeThrough, kOblique, options);
        EXPECT_TRUE(sameBytes(again.frame, one.frame)) << method << ", " << threads << " threads";
        EXPECT_EQ(again.stats.overflow, one.stats.overflow);
      }
    }
    if (k >= tile.stats.depthComplexityMax) {
      EXPECT_TRUE(sameBytes(one.frame, tile.frame));
    }
    // Behind what is opaque nothing is drawn, and all is counted.
    const OitDrawing opaque = drawParts(parts, kOblique, kBuffer("k-plus", k));
    EXPECT_GT(opaque.stats.fragments, tile.stats.fragments);
    EXPECT_EQ(opaque.stats.fragmentsCaptured + opaque.stats.overflow, opaque.stats.fragments);
  }
}

// More fragments in one pixel than 16 bits count, in one plane: none is lost, and the pictures that count saturate.
TEST(Oit, sixtyFiveThousandCoplanarFragments) {
  constexpr unsigned kCount = 65537;
  constexpr float kAlpha = 2e-5f;
  Mesh stack;
  stack.vertices = square(1).vertices;
  stack.triangles.assign(kCount, {0, 1, 2});
  const View view = lookAt({0.71, 0.32, 20}, {0.71, 0.32, 0}, 3, 3, 0.001);
  const OitDrawing drawing = drawParts({part(stack, glm::vec4(200, 100, 50, kAlpha))}, view);
  EXPECT_EQ(drawing.stats.depthComplexityMax, kCount);
  EXPECT_EQ(drawing.stats.fragmentsCaptured, 9u * kCount);
  EXPECT_EQ(drawing.frame.layers.at(1, 1), 65535);
  EXPECT_EQ(drawing.frame.coplanar.at(1, 1), 65535);
  EXPECT_NEAR(drawing.frame.floats.at(1, 1).r, 200 * (1 - std::pow(1 - double(kAlpha), kCount)), 1e-4);
}

}  // namespace
}  // namespace copeel::test
