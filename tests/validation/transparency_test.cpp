// `copeel oit` against the exact blend of exact fragments, on scenes where renderers lose or misorder fragments: off edges, no 8-bit colour and
// no count is wrong, unlit floats agree to 1e-6, and lit ones to 90 dB.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "tests/support/parts.h"
#include "tests/support/views.h"
#include "validation/blend_oracle.h"
#include "validation/compare.h"

namespace copeel::validation {
namespace {

using namespace copeel::test;
using Parts = std::vector<oit::Part>;

constexpr double kFloatError = 1e-6;   // of full scale; a float has 6e-8
constexpr double kLitPsnr = 90;        // decibels
const glm::vec4 kRed(230, 40, 20, 0.5), kGreen(20, 200, 60, 0.3), kBlue(30, 60, 250, 0.7), kGlass(180, 220, 230, 0.15), kSolid(240, 200, 40, 1);

const View kOblique = lookAt({7, -9, 6}, {0, 0, 0}, 64, 48, 0.0125);
const View kParallel = lookAt({7, -9, 6}, {0, 0, 0}, 64, 48, 0.15, false);
const View kAbove = lookAt({0.51, 0.52, 10}, {0.51, 0.52, 0}, 48, 36, 0.004);

void expectExact(const Parts& parts, const View& view, oit::RenderOptions options = {}) {
  for (const bool lit : {false, true}) {
    options.lit = lit;
    options.threads = 2;
    const oit::Frame frame = drawParts(parts, view, options).frame;
    const BlendOracle oracle(parts, view, options);
    const BlendComparison result = compareBlend(frame, oracle);
    SCOPED_TRACE(fmt::format("{}, {} pixels, {} covered, {} edge, {} wrong on edges, greatest error {:.2g}", lit ? "lit" : "unlit", result.pixels,
                             result.covered, result.edge, result.wrongOnEdge, result.greatestError));
    EXPECT_GT(result.covered, 100u);
    EXPECT_LT(result.edge, result.pixels / 2);
    EXPECT_EQ(result.wrongCountsOffEdge, 0u);
    if (lit) {
      EXPECT_GE(result.psnr(), kLitPsnr);
      continue;
    }
    EXPECT_EQ(result.wrongOffEdge, 0u);
    EXPECT_LE(result.greatestError, kFloatError);
    const Comparison nearest = compareDepth(frame.depth, oracle, oracle.caster(), &frame.ids);
    EXPECT_EQ(nearest.wrongOffEdge + nearest.wrongLeafOffEdge, 0u) << nearest.summary();
  }
}

Parts copies(const Mesh& mesh, unsigned count, bool shuffle) {
  const glm::vec4 colors[] = {kRed, kGreen, kBlue, kGlass};
  Parts parts;
  for (unsigned i = 0; i < count; ++i) parts.push_back(part(shuffle ? shuffled(mesh, i) : mesh, colors[i % 4]));
  return parts;
}

TEST(Transparency, Coincident_copies_all_blend) {
  for (const unsigned count : {1u, 4u, 8u, 12u}) {
    SCOPED_TRACE(count);
    expectExact(copies(bumpySphere(2, 30, 16), count, false), kOblique);
    if (count == 8) expectExact(copies(torusKnot(0.9, 60, 8), count, false), kParallel);
  }
}

TEST(Transparency, Two_lights) {
  oit::RenderOptions options;
  options.lights = {{{3, -1, 2}, 0.6}, {{-1, 0, 0.25}, 0.5}};
  expectExact(copies(bumpySphere(2, 30, 16), 4, false), kOblique, options);
  expectExact(copies(torusKnot(0.9, 60, 8), 2, false), kParallel, options);
}

TEST(Transparency, Copies_with_their_triangles_in_another_order_and_turned) {
  for (const unsigned count : {4u, 12u}) expectExact(copies(bumpySphere(2, 30, 16), count, true), kOblique);
}

// 1e-15 of rounding in every vertex: no two planes are equal any more, all are one class.
TEST(Transparency, A_copy_turned_and_turned_back) {
  const Mesh sphere = bumpySphere(2, 30, 16);
  Mesh turned = sphere;
  const glm::dmat4 there = rotation({17, 29, 43}), back = glm::transpose(there);
  for (glm::dvec3& p : turned.vertices) p = transformPoint(back, transformPoint(there, p));
  expectExact({part(sphere, kRed), part(turned, kGreen), part(sphere, kBlue)}, kOblique);
  expectExact({part(sphere, kRed, there), part(sphere, kGreen, there), part(turned, kBlue, there)}, kParallel);
}

TEST(Transparency, One_plane_in_two_tessellations) {
  const Mesh square = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), fan = fanSquare(0, 500);
  for (const glm::dmat4& place : {glm::dmat4(1), translation({0.3, 0.2, 0.1}) * rotation({31, 17, 11})}) {
    expectExact({part(square, kRed, place), part(fan, kGreen, place)}, kAbove);
    expectExact({part(fan, kRed, place), part(square, kGreen, place), part(fan, kBlue, place)}, kAbove);
  }
}

TEST(Transparency, Sheets_that_touch_and_cross) {
  const auto sheet = [](double a, double b) { return quad({-3, -3, a}, {3, -3, -a}, {3, 3, b}, {-3, 3, -b}, false); };
  expectExact({part(sheet(0, 0), kRed), part(sheet(1, -1), kGreen), part(sheet(-1, 1), kBlue), part(sheet(0, 0), kGlass)}, kOblique);
}

// Planes through one line: on it all are at one depth.
TEST(Transparency, A_pencil_of_planes) {
  Parts parts;
  for (int i = 0; i < 12; ++i) {
    const glm::dmat4 turn = rotation({0, 15.0 * i, 0});
    parts.push_back(part(quad({-2, -3, 0}, {2, -3, 0}, {2, 3, 0}, {-2, 3, 0}), i % 2 ? kRed : kGreen, turn));
  }
  expectExact(parts, kOblique);
  expectExact(parts, lookAt({0.5, -12, 0.3}, {0, 0, 0}, 61, 45, 0.011));
}

TEST(Transparency, Opaque_among_translucent_and_what_is_wholly_transparent) {
  const glm::vec4 nothing(255, 0, 255, 0);
  expectExact({part(sphere(2, 24, 12), nothing), part(sphere(1.5, 24, 12), kRed), part(box({-1, -1, -1}, {1, 1, 1}), kSolid),
               part(sphere(1.2, 24, 12), kBlue), part(box({-1, -1, -1}, {1, 1, 1}), kGreen), part(box({-1, -1, -1}, {1, 1, 1}), nothing)},
              kOblique);
}

TEST(Transparency, The_eye_inside_and_open_meshes) {
  const View inside = lookAt({0.3, 0.2, 0.1}, {5, 4, 1}, 64, 48, 0.025);
  expectExact({part(bumpySphere(2, 30, 16), kRed), part(torusKnot(0.9, 60, 8), kGreen), part(bumpySphere(2, 30, 16), kBlue)}, inside);
  Mesh open = bumpySphere(2, 30, 16);
  open.triangles.resize(open.triangles.size() / 2);
  expectExact({part(open, kRed), part(open, kGreen), part(shuffled(open, 3), kBlue)}, kOblique);
}

TEST(Transparency, Three_hundred_coplanar_fragments) {
  Parts parts;
  for (int i = 0; i < 300; ++i) {
    parts.push_back(part(quad({0, 0, 0}, {1, 0, 0.25}, {1, 1, 0.5}, {0, 1, 0.25}, i % 2), glm::vec4(i % 7 * 40, i % 11 * 25, i % 13 * 20, 0.02f)));
  }
  expectExact(parts, kAbove);
}

TEST(Transparency, Colours_of_faces) {
  Mesh mesh = bumpySphere(2, 30, 16);
  std::vector<glm::vec4> colors;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) colors.emplace_back(t * 37 % 256, t * 91 % 256, t * 53 % 256, t % 5 * 0.25);
  oit::Part colored = part(mesh, kRed);
  colored.faceColors = colors;
  expectExact({part(mesh, kGlass), colored, part(mesh, kGreen)}, kOblique);
}

// The walker's other way through a pixel gives the same pixels.
TEST(Transparency, Decided_exactly_everywhere) {
  oit::RenderOptions options;
  options.decideAllExactly = true;
  expectExact(copies(bumpySphere(2, 20, 10), 4, true), kOblique, options);
}

}  // namespace
}  // namespace copeel::validation
