// The fold itself, on random stacks: from the front, from the back, and from both ends joined.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/fold/over.h"
#include "core/fold/over_block.h"

namespace copeel::fold {
namespace {

using Stack = std::vector<vec4>;   // front to back
const vec3 kBackground(255, 255, 229);

Stack randomStack() {
  const auto fragment = rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 256), rc::gen::inRange(0, 256), rc::gen::inRange(0, 256), rc::gen::inRange(0, 21)),
                                     [](const auto& t) { return vec4(std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t) / 20.0f); });
  return *rc::gen::container<Stack>(fragment);
}

OverState forward(Stack::const_iterator begin, Stack::const_iterator end) {
  OverState state;
  overBegin(state);
  for (; begin != end; ++begin) overFragment(state, *begin);
  return state;
}

OverState backward(Stack::const_iterator begin, Stack::const_iterator end) {
  OverState state;
  overBegin(state);
  while (end != begin) overBehind(state, *--end);
  return state;
}

RC_GTEST_PROP(Over, aStackFromBothEndsShowsTheSameLevels, ()) {
  const Stack stack = randomStack();
  const auto middle = stack.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(stack.size()) + 1);
  const uvec3 whole = overLevels(overResult(forward(stack.begin(), stack.end()), kBackground));
  RC_ASSERT(overLevels(overResult(backward(stack.begin(), stack.end()), kBackground)) == whole);
  RC_ASSERT(overLevels(overResult(overJoin(forward(stack.begin(), middle), backward(middle, stack.end())), kBackground)) == whole);
}

RC_GTEST_PROP(Over, enoughMeansThatNothingBehindMatters, ()) {
  Stack stack = randomStack();
  stack.push_back(vec4(10, 20, 30, 1));
  const OverState opaque = forward(stack.begin(), stack.end());
  RC_ASSERT(overEnough(opaque));
  stack.push_back(vec4(200, 100, 0, 0.5f));
  RC_ASSERT(overResult(forward(stack.begin(), stack.end()), kBackground) == overResult(opaque, vec3(0)));
}

TEST(Over, anEmptyStackShowsTheBackgroundAndHalvesGoUp) {
  OverState state;
  overBegin(state);
  EXPECT_FALSE(overEnough(state));
  EXPECT_EQ(overLevels(overResult(state, kBackground)), uvec3(255, 255, 229));
  overFragment(state, vec4(0, 254, 0, 0.5f));
  EXPECT_EQ(overLevels(overResult(state, kBackground)), uvec3(128, 255, 115));   // 127.5, 254.5, 114.5
  EXPECT_EQ(overLevels(dvec3(-3, 300, 12.49999)), uvec3(0, 255, 12));
}

TEST(Over, lightBrighterThanWhiteStopsAtEachChannelsLimit) {
  EXPECT_EQ(overShade(vec4(250, 100, 10, 0.25f), 1.5f), vec4(255, 150, 15, 0.25f));
}

// Classes lie in groups of eight.
TEST(Over, shadesAreThoseOfEachPlanesNormal) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  View view;
  for (const unsigned count : {0u, 1u, 7u, 8u, 9u, 30u}) {
    auto mesh = std::make_shared<Mesh>();
    for (unsigned i = 0; i < 3 * count; ++i) mesh->vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (unsigned i = 0; i < count; ++i) mesh->triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    const Scene scene({{mesh}});
    const PlaneClasses planes(scene, 0);
    ASSERT_EQ(planes.classes().size(), count);
    for (const std::vector<Light>& lights : {std::vector<Light>{}, {{{0, 0, 1}, 0.5}}, {{{0, 0, 1}, 0.5}, {{3, 0, 4}, 0.25}, {{0, -2, 0}, 1}}}) {
      const Shades shades = shadesOf(planes, view, true, lights);
      ASSERT_EQ(shades.size(), count);
      for (unsigned i = 0; i < count; ++i) {
        double expected = 0.2;
        const dvec3 n = planes.classes()[i].normal;
        for (const Light& light : lights) {
          const dvec3 l = light.toward / glm::length(light.toward);
          const dvec3 world = l.x * view.right - l.y * view.down - l.z * view.forward;
          expected += light.strength * std::abs(glm::dot(n, world));
        }
        EXPECT_NEAR(shades[i], expected, 1e-6);
      }
    }
    for (const float shade : shadesOf(planes, view, false)) EXPECT_EQ(shade, 1);
  }
}

// Two objects of a tile: one of a single colour, one with a colour a triangle.
TEST(Over, slotsOfATileAreShadedAlikeOnAnySimdTarget) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> level(0, 255), alpha(0, 1), light(0, 3);
  std::vector<vec4> bases(101);
  for (vec4& base : bases) base = vec4(level(random), level(random), level(random), alpha(random));
  std::vector<float> shades(60);
  for (float& shade : shades) shade = light(random);
  constexpr std::uint32_t kFirstOfSecond = 1000;   // primitive
  const PrimitiveRange ranges[] = {{0, 0}, {1 - kFirstOfSecond, 1}};
  std::vector<cpu::TileSlot> slots;
  std::vector<vec4> expected;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const std::uint32_t object = i / 100, planeClass = static_cast<std::uint32_t>(random() % shades.size());
    slots.push_back({object ? kFirstOfSecond + i - 100 : i, planeClass, object, 1});
    expected.push_back(overShade(bases[object ? 1 + i - 100 : 0], shades[planeClass]));
  }
  for (const char* target : {"scalar", "sse4", "avx2", "best"}) {
    cpu::chooseSimd(target);
    std::vector<vec4> colors(slots.size());
    shadeSlots({bases.data(), shades.data(), ranges}, slots, colors.data());
    EXPECT_EQ(colors, expected) << target;
  }
  cpu::chooseSimd("best");
}

}  // namespace
}  // namespace copeel::fold
