#include "validation/random_scene.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/scene/scene.h"

namespace copeel::validation {
namespace {

constexpr int kGrid = 8;                     // the scene's size, about
constexpr int kPlaces = 5;                   // leaves begin at whole coordinates 0 … kPlaces - 1, few enough that they meet
constexpr double kTurnX = 10, kTurnY = 20, kTurnZ = 30;   // degrees, HARD_CASES.md 1
constexpr double kFar = 1e6;

// The six ways along which an axis may point, as exact turns of the z axis.
glm::dmat4 quarterTurn(int which) {
  glm::dmat4 m(0.0);
  m[3].w = 1;
  const int axis = which % 3;
  const double sign = which < 3 ? 1 : -1;
  // Even permutations of the axes, two of them reversed for the lower three: the determinant stays one.
  m[0][(axis + 1) % 3] = sign;
  m[1][(axis + 2) % 3] = 1;
  m[2][axis] = sign;
  return m;
}

std::string pointText(const glm::dvec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }

SceneLeaf randomBox(Random& random) {
  const glm::dvec3 size(random.between(1, 6), random.between(1, 6), random.between(1, 6));
  SceneLeaf leaf{fmt::format("cube(size = {}, center = false);", pointText(size)), glm::dmat4(1.0), {}};
  for (int i = 0; i < 8; ++i) leaf.corners.push_back({i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0});
  return leaf;
}

SceneLeaf randomCylinder(Random& random) {
  static constexpr int kFacets[] = {4, 6, 8, 12};
  const int facets = kFacets[random.below(4)], height = random.between(2, 6), radius = random.between(1, 3);
  const int top = random.below(4) == 0 ? random.below(3) : radius;
  const char* center = random.below(4) == 0 ? "true" : "false";
  return {fmt::format("cylinder($fn = {}, $fa = 12, $fs = 2, h = {}, r1 = {}, r2 = {}, center = {});", facets, height, radius, top, center),
          quarterTurn(random.below(6)), {}};
}

SceneLeaf randomSphere(Random& random) {
  const int facets = random.between(3, 6) * 2;
  return {fmt::format("sphere($fn = {}, $fa = 12, $fs = 2, r = {});", facets, random.between(1, 3)), quarterTurn(random.below(6)), {}};
}

SceneLeaf randomLeaf(Random& random) {
  const int kind = random.below(10);
  SceneLeaf leaf = kind < 5 ? randomBox(random) : kind < 9 ? randomCylinder(random) : randomSphere(random);
  const glm::dvec3 at(random.below(kPlaces), random.below(kPlaces), random.below(kPlaces));
  leaf.worldFromObject[3] = glm::dvec4(at, 1);
  return leaf;
}

// A closed surface of the combinatorics of a double pyramid, its corners anywhere on the grid.
SceneLeaf randomCrossingLeaf(Random& random) {
  const int around = random.between(3, 6);
  std::string points, faces;
  for (int i = 0; i < around + 2; ++i) {
    const glm::dvec3 p(random.below(kGrid + 1), random.below(kGrid + 1), random.below(kGrid + 1));
    points += (i ? ", " : "") + pointText(p);
  }
  const int missing = random.below(5) == 0 ? random.below(2 * around) : -1;
  for (int i = 0; i < 2 * around; ++i) {
    const int a = i / 2, b = (a + 1) % around;
    if (i == missing) continue;
    faces += fmt::format("{}[{}, {}, {}]", faces.empty() ? "" : ", ", i % 2 ? a : b, i % 2 ? b : a, around + i % 2);
  }
  return {fmt::format("polyhedron(points = [{}], faces = [{}], convexity = 1);", points, faces), glm::dmat4(1.0), {}};
}

// A tree over leaves first … last - 1, cut at random places.
std::string randomTree(Random& random, int first, int last) {
  if (last - first == 1) return fmt::format("@{};", first);
  static constexpr const char* kNames[] = {"union", "difference", "difference", "intersection", "difference", "union"};
  std::string text = fmt::format("{}() {{\n", kNames[random.below(6)]);
  while (first < last) {
    const int cut = random.between(first + 1, first == 0 ? std::max(1, last - 1) : last);
    text += randomTree(random, first, cut) + "\n";
    first = cut;
  }
  return text + "}";
}

glm::dvec3 randomDirection(Random& random) {
  for (;;) {
    const glm::dvec3 d(random.unit() * 2 - 1, random.unit() * 2 - 1, random.unit() * 2 - 1);
    if (const double length = glm::length(d); length > 0.1 && length < 1) return d / length;
  }
}

// Any direction in perspective; along an axis, orthographic; along an axis in perspective, or from within the model.
std::vector<Look> randomLooks(Random& random) {
  const glm::dvec3 center(kGrid / 2, kGrid / 2, kGrid / 2);
  const double distance = 4 * kGrid;
  std::vector<Look> looks(3);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 away = randomDirection(random);
    if (i > 0) {
      away = glm::dvec3(0);
      away[random.below(3)] = random.below(2) ? 1 : -1;
    }
    looks[i].center = center;
    looks[i].eye = center + away * distance;
    looks[i].up = std::abs(away.z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    looks[i].perspective = i != 1;
  }
  if (random.below(4) == 0) looks[2].eye = glm::dvec3(random.unit(), random.unit(), random.unit()) * double(kGrid);
  return looks;
}

// A box as a polyhedron whose corners have been moved one by one.
std::string movedBoxText(const SceneLeaf& leaf, const glm::dmat4& motion) {
  std::string points;
  for (const glm::dvec3& corner : leaf.corners)
    points += (points.empty() ? "" : ", ") + pointText(transformPoint(motion, transformPoint(leaf.worldFromObject, corner)));
  // OpenSCAD wants faces clockwise seen from outside.
  return fmt::format("polyhedron(points = [{}], faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], convexity = 1);",
                     points);
}

}  // namespace

std::uint64_t Random::next() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::string nameOf(Placement placement) {
  switch (placement) {
    case Placement::Plain: return "plain";
    case Placement::TurnedWhole: return "turned as a whole";
    case Placement::TurnedLeafByLeaf: return "turned leaf by leaf";
    case Placement::Moved: return "moved by 1e6";
  }
  return "";
}

std::string matrixText(const glm::dmat4& m) {
  std::string rows;
  for (int r = 0; r < 4; ++r) rows += fmt::format("{}[{}, {}, {}, {}]", r ? ", " : "", m[0][r], m[1][r], m[2][r], m[3][r]);
  return "multmatrix([" + rows + "]) ";
}

glm::dmat4 translation(const glm::dvec3& by) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(by, 1);
  return m;
}

glm::dmat4 turn(double x, double y, double z) {
  const auto about = [](int axis, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    glm::dmat4 m(1.0);
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    m[p][p] = c, m[p][q] = s, m[q][p] = -s, m[q][q] = c;
    return m;
  };
  return about(2, z) * about(1, y) * about(0, x);
}

Look moved(const Look& look, const glm::dmat4& motion) {
  Look out = look;
  out.eye = transformPoint(motion, look.eye);
  out.center = transformPoint(motion, look.center);
  out.up = glm::dmat3(motion) * look.up;
  return out;
}

glm::dmat4 RandomScene::motion(Placement placement) const {
  if (placement == Placement::Plain) return glm::dmat4(1.0);
  if (placement == Placement::Moved) return translation({kFar, -kFar, kFar});
  return turn(kTurnX, kTurnY, kTurnZ);
}

std::string RandomScene::text(Placement placement) const {
  const glm::dmat4 whole = motion(placement);
  const bool one = placement == Placement::TurnedLeafByLeaf;
  std::string body = tree;
  for (std::size_t i = leaves.size(); i-- > 0;) {
    // Leaf by leaf, neighbours reach their place by different roundings: one product, three turns in a row, or corners moved one by one.
    const SceneLeaf& leaf = leaves[i];
    std::string text = matrixText(leaf.worldFromObject) + leaf.shape;
    if (one && i % 3 == 0) text = matrixText(whole * leaf.worldFromObject) + leaf.shape;
    if (one && i % 3 == 1) text = matrixText(turn(0, 0, kTurnZ)) + matrixText(turn(0, kTurnY, 0)) + matrixText(turn(kTurnX, 0, 0)) + text;
    if (one && i % 3 == 2) text = leaf.corners.empty() ? matrixText(turn(0, kTurnY, kTurnZ)) + matrixText(turn(kTurnX, 0, 0) * leaf.worldFromObject) + leaf.shape
                                                       : movedBoxText(leaf, whole);
    const std::string mark = fmt::format("@{};", i);
    body.replace(body.find(mark), mark.size(), text);
  }
  if (placement == Placement::TurnedWhole || placement == Placement::Moved) return matrixText(whole) + "{\n" + body + "\n}\n";
  return body + "\n";
}

std::vector<View> RandomScene::views(Placement placement, int width, int height) const {
  std::vector<View> views;
  for (Look look : looks) {
    look.width = width;
    look.height = height;
    views.push_back(viewOf(moved(look, motion(placement))));
  }
  return views;
}

namespace {

RandomScene sceneOf(std::uint64_t seed, int maxLeafCount, SceneLeaf (*leaf)(Random&)) {
  Random random(seed);
  RandomScene scene;
  scene.seed = seed;
  const int count = random.between(2, maxLeafCount);
  for (int i = 0; i < count; ++i) scene.leaves.push_back(leaf(random));
  scene.tree = randomTree(random, 0, count);
  scene.looks = randomLooks(random);
  return scene;
}

}  // namespace

RandomScene randomScene(std::uint64_t seed, int maxLeafCount) { return sceneOf(seed, maxLeafCount, randomLeaf); }

RandomScene randomCrossingScene(std::uint64_t seed, int maxLeafCount) { return sceneOf(seed, maxLeafCount, randomCrossingLeaf); }

}  // namespace copeel::validation
