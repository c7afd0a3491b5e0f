// Colours and alpha (hard case 16): the renderer's unlit colours against the rule of translucency, on scenes whose answer is plain and on random ones.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/color_oracle.h"
#include "validation/compare.h"
#include "validation/hard_cases.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

constexpr int kLevels = 1;   // of 255: rounding of the sum

csg::Frame drawUnlit(const csg::Model& model, const View& view) {
  csg::RenderOptions options;
  options.lit = false;
  options.threads = 1;
  return csg::Renderer(model, options).draw(view);
}

bool equal(const Rgb8& a, const glm::dvec3& b) {
  return std::abs(a.r - b.r) <= kLevels && std::abs(a.g - b.g) <= kLevels && std::abs(a.b - b.b) <= kLevels;
}

bool onEdge(const ColorOracle& oracle, const Ray& ray) {
  const glm::dvec3 here = oracle.color(ray);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (oracle.color({ray.u + dx * kSubPixelStep, ray.v + dy * kSubPixelStep}) != here) return true;
  return oracle.whole().caster().nearEdge(ray, kSubPixelStep);
}

// How many off-edge pixels have another colour than the rule says.
int wrongColors(const csg::Model& model, const View& view) {
  const ColorOracle oracle(model, view);
  const csg::Frame frame = drawUnlit(model, view);
  int wrong = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Ray ray = oracle.whole().caster().rayOf(x, y);
      const glm::dvec3 expected = oracle.color(ray);
      if (equal(frame.color.at(x, y), expected) || onEdge(oracle, ray)) continue;
      if (++wrong <= 3)
        ADD_FAILURE() << fmt::format("({}, {}): {} {} {}, expected {:.1f} {:.1f} {:.1f}", x, y, frame.color.at(x, y).r, frame.color.at(x, y).g,
                                     frame.color.at(x, y).b, expected.x, expected.y, expected.z);
    }
  }
  return wrong;
}

// Straight down on a part about the origin, in the middle of the picture.
glm::dvec3 middle(const std::string& text) {
  const csg::Model model = modelOf(text);
  const View view = viewOf({{0.3, 0.2, 100}, {0.3, 0.2, 0}, {0, 1, 0}, true, 33, 25});
  EXPECT_EQ(wrongColors(model, view), 0) << text;
  const Rgb8 c = drawUnlit(model, view).color.at(16, 12);
  return {c.r, c.g, c.b};
}

std::string colored(double r, double g, double b, double a, const std::string& text) {
  return fmt::format("color([{}, {}, {}, {}]) {{{}}}\n", r, g, b, a, text);
}

const std::string kBlock = box({-10, -10, -5}, {10, 10, 5}), kInner = box({-5, -5, -2}, {5, 5, 2});
const glm::dvec3 kBackground(255, 255, 229);

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], kLevels) << i;
}

TEST(Translucency, Alpha_one_hides_and_alpha_zero_is_not_seen) {
  expectNear(middle(colored(1, 0, 0, 1, kBlock)), {255, 0, 0});
  expectNear(middle(colored(1, 0, 0, 0, kBlock)), kBackground);
}

TEST(Translucency, A_solid_blends_once_and_shows_the_background) {
  expectNear(middle(colored(1, 0, 0, 0.5, kBlock)), glm::dvec3(255, 0, 0) * 0.5 + kBackground * 0.5);
}

TEST(Translucency, The_face_cut_by_a_translucent_tool_is_translucent) {
  // A pit from the top: its floor is the tool's face.
  const std::string pit = join("difference", {colored(1, 0, 0, 1, kBlock), colored(0, 0, 1, 0.5, box({-4, -4, 0}, {4, 4, 9}))});
  expectNear(middle(pit), glm::dvec3(0, 0, 255) * 0.5 + kBackground * 0.5);
}

TEST(Translucency, The_wall_within_a_union_does_not_show) {
  const std::string stacked = join("union", {colored(1, 0, 0, 0.5, box({-5, -5, -5}, {5, 5, 0})), colored(0, 1, 0, 0.5, box({-5, -5, 0}, {5, 5, 5}))});
  expectNear(middle(stacked), glm::dvec3(0, 255, 0) * 0.5 + kBackground * 0.5);
}

TEST(Translucency, An_opaque_solid_shows_inside_a_translucent_one) {
  const std::string text = join("union", {colored(1, 0, 0, 0.5, kBlock), colored(0, 0, 1, 1, kInner)});
  expectNear(middle(text), glm::dvec3(255, 0, 0) * 0.5 + glm::dvec3(0, 0, 255) * 0.5);
}

TEST(Translucency, On_a_shared_face_the_later_operand_lies_in_front) {
  const std::string red = colored(1, 0, 0, 0.5, kBlock), blue = colored(0, 0, 1, 1, box({-5, -5, -5}, {5, 5, 5}));
  expectNear(middle(join("union", {blue, red})), glm::dvec3(255, 0, 0) * 0.5 + glm::dvec3(0, 0, 255) * 0.5);
  expectNear(middle(join("union", {red, blue})), {0, 0, 255});
}

TEST(Translucency, Random_scenes_have_the_colours_of_the_rule) {
  static constexpr double kAlphas[] = {1, 1, 0.5, 0.25, 0};
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomScene scene = randomScene(seed);
    const Placement placement = kPlacements[seed % 4];
    csg::Model model = modelOf(scene.text(placement));
    Random random(seed);
    for (csg::Leaf& leaf : model.leaves)
      if (random.below(4)) leaf.color = glm::dvec4(random.below(5) / 4.0, random.below(5) / 4.0, random.below(5) / 4.0, kAlphas[random.below(5)]);
    for (const View& view : scene.views(placement, 64, 48)) {
      EXPECT_EQ(wrongColors(model, view), 0) << "seed " << seed << ", " << nameOf(placement);
      for (const Rgb8& c : drawUnlit(model, view).color.pixels) covered += !(c == Rgb8{255, 255, 229});
    }
  }
  EXPECT_GT(covered, 20000);
}

}  // namespace
}  // namespace copeel::validation
