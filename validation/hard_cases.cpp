#include "validation/hard_cases.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

const glm::dvec3 kHalfPart(20, 20, 10), kHalfCutter(10, 10, 10);

std::string part() { return box(-kHalfPart, kHalfPart); }
std::string cutter(double below = 0, double above = 0) {
  return box(-kHalfCutter - glm::dvec3(0, 0, below), kHalfCutter + glm::dvec3(0, 0, above));
}
std::string coplanar() { return join("difference", {part(), cutter()}); }

}  // namespace

std::string box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 size = high - low;
  return fmt::format("multmatrix([[1, 0, 0, {}], [0, 1, 0, {}], [0, 0, 1, {}], [0, 0, 0, 1]]) cube(size = [{}, {}, {}], center = false);\n", low.x, low.y,
                     low.z, size.x, size.y, size.z);
}

std::string moved(const std::string& text, const glm::dmat4& motion) { return matrixText(motion) + "{\n" + text + "}\n"; }

std::string join(const std::string& operation, const std::vector<std::string>& operands) {
  std::string text = operation + "() {\n";
  for (const std::string& operand : operands) text += operand;
  return text + "}\n";
}

std::string polyhedron(const std::vector<glm::dvec3>& points, const std::vector<std::vector<int>>& faces) {
  std::string pointText, faceText;
  for (const glm::dvec3& p : points) pointText += fmt::format("{}[{}, {}, {}]", pointText.empty() ? "" : ", ", p.x, p.y, p.z);
  for (const std::vector<int>& face : faces) {
    // OpenSCAD's faces run clockwise seen from outside.
    const std::vector<int> reversed(face.rbegin(), face.rend());
    faceText += fmt::format("{}[{}]", faceText.empty() ? "" : ", ", fmt::join(reversed, ", "));
  }
  return fmt::format("polyhedron(points = [{}], faces = [{}], convexity = 1);\n", pointText, faceText);
}

std::string prism(const std::vector<glm::dvec2>& outline, const std::vector<std::vector<int>>& caps, double low, double high) {
  const int count = int(outline.size());
  std::vector<glm::dvec3> points;
  for (const glm::dvec2& p : outline) points.push_back({p.x, p.y, low});
  for (const glm::dvec2& p : outline) points.push_back({p.x, p.y, high});
  std::vector<std::vector<int>> faces;
  for (const std::vector<int>& cap : caps) {
    faces.emplace_back(cap.rbegin(), cap.rend());
    faces.emplace_back(cap);
    for (int& i : faces.back()) i += count;
  }
  for (int i = 0; i < count; ++i) {
    const int j = (i + 1) % count;
    faces.push_back({i, j, count + j, count + i});
  }
  return polyhedron(points, faces);
}

std::string prism(const std::vector<glm::dvec2>& outline, double low, double high) {
  std::vector<int> cap;
  for (int i = 0; i < int(outline.size()); ++i) cap.push_back(i);
  return prism(outline, {cap}, low, high);
}

std::vector<Look> usualLooks(double size, const glm::dmat4& motion) {
  std::vector<Look> looks{
      {{1.7 * size, -2.3 * size, 2.9 * size}, {0, 0, 0}, {0, 0, 1}, true},
      {{-1.1 * size, 2.3 * size, -3.1 * size}, {0, 0, 0}, {0, 0, 1}, true},
      {{0, 0, 4 * size}, {0, 0, 0}, {0, 1, 0}, false},
      {{0, 0, 4 * size}, {0, 0, 0}, {0, 1, 0}, true},
  };
  for (Look& look : looks) {
    look = moved(look, motion);
    look.width = 200;
    look.height = 150;
  }
  return looks;
}

HardCase coplanarDifference(double scale) {
  glm::dmat4 motion(scale);
  motion[3].w = 1;
  return {moved(coplanar(), motion), coplanar(), motion, usualLooks(40 * scale)};
}

HardCase coplanarTurnedWhole() {
  const glm::dmat4 motion = turn(10, 20, 30);
  return {moved(coplanar(), motion), coplanar(), motion, usualLooks(40, motion)};
}

HardCase coplanarTurnedLeafByLeaf() {
  // The part by one matrix, the cutter by three turns in a row: the faces agree to rounding only.
  const glm::dmat4 motion = turn(10, 20, 30);
  const std::string turnedCutter = moved(moved(moved(cutter(), turn(10, 0, 0)), turn(0, 20, 0)), turn(0, 0, 30));
  return {join("difference", {moved(part(), motion), turnedCutter}), coplanar(), motion, usualLooks(40, motion)};
}

HardCase cutterTooLong() {
  const std::string text = join("difference", {part(), cutter(1e-6, 1e-6)});
  return {text, text, glm::dmat4(1.0), usualLooks()};
}

HardCase filmThatStays() {
  const std::string text = join("difference", {part(), cutter(0, -1e-6)});
  return {text, text, glm::dmat4(1.0), usualLooks()};
}

HardCase movedFar() {
  const glm::dmat4 motion = translation({1e6, -1e6, 1e6});
  return {moved(coplanar(), motion), coplanar(), motion, usualLooks(40, motion)};
}

HardCase selfIntersecting() {
  // The bow tie's outline crosses itself in its middle: winding +1 on one side, -1 on the other. Its caps are the four-cornered outline, cut in two
  // triangles that overlap nowhere but lie on different sides.
  const std::vector<glm::dvec2> tie{{-10, -10}, {10, 10}, {10, -10}, {-10, 10}};
  const std::string crossing = prism(tie, {{0, 1, 2}, {0, 2, 3}}, -5, 10);
  const std::string left = prism({{-10, -10}, {0, 0}, {-10, 10}}, -5, 10), right = prism({{10, 10}, {0, 0}, {10, -10}}, -5, 10);
  return {join("difference", {part(), crossing}), join("difference", {part(), left, right}), glm::dmat4(1.0), usualLooks()};
}

HardCase insideOut() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 10 : -10});
  // The faces of a box, seen from within.
  const std::string reversed =
      polyhedron(points, {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
  return {join("difference", {part(), reversed}), coplanar(), glm::dmat4(1.0), usualLooks()};
}

HardCase starPrism() {
  // A pentagram of whole coordinates, one outline that goes round twice; it means the union of the triangles over its five chords.
  const std::vector<glm::dvec2> tips{{18, 0}, {6, 17}, {-15, 11}, {-15, -11}, {6, -17}};
  std::vector<glm::dvec2> outline;
  std::vector<std::string> triangles;
  for (int i = 0; i < 5; ++i) outline.push_back(tips[2 * i % 5]);
  for (int i = 0; i < 5; ++i) triangles.push_back(prism({{0, 0}, outline[i], outline[(i + 1) % 5]}, -10, 10));
  const std::string star = prism(outline, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, -10, 10);
  return {join("difference", {part(), star}), join("difference", {part(), join("union", triangles)}), glm::dmat4(1.0), usualLooks()};
}

HardCase faceMissing() {
  // A box without its bottom, beside a whole one, from above: nothing of what is missing can be seen.
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 10 : -10});
  const std::string open = polyhedron(points, {{4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  const std::string beside = box({10, -10, -10}, {20, 10, 10});
  HardCase hard{join("union", {open, beside}), join("union", {cutter(), beside}), glm::dmat4(1.0), usualLooks()};
  std::erase_if(hard.looks, [](const Look& look) { return look.eye.z < 0; });
  return hard;
}

HardCase torus() {
  // 24 × 12 corners, cut by a box that ends in its middle plane.
  constexpr int kAround = 24, kTube = 12;
  std::vector<glm::dvec3> points;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kTube; ++j) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * j / kTube, r = 14 + 5 * std::cos(b);
      points.push_back({r * std::cos(a), r * std::sin(a), 5 * std::sin(b)});
      const int i1 = (i + 1) % kAround, j1 = (j + 1) % kTube;
      faces.push_back({i * kTube + j, i1 * kTube + j, i1 * kTube + j1});
      faces.push_back({i * kTube + j, i1 * kTube + j1, i * kTube + j1});
    }
  }
  const std::string text = join("difference", {polyhedron(points, faces), box({0, -20, -10}, {20, 0, 10})});
  HardCase hard{text, text, glm::dmat4(1.0), usualLooks()};
  Look low{{70, -50, 12}, {0, 0, 0}, {0, 0, 1}, true, 200, 150};   // the ring's near and far side in line
  hard.looks.push_back(low);
  return hard;
}

HardCase eyeInsideCutter() {
  HardCase hard{coplanar(), coplanar(), glm::dmat4(1.0), {}};
  for (const glm::dvec3& center : {glm::dvec3(20, 3, 1), glm::dvec3(-3, 20, -8), glm::dvec3(8, 8, -20)})
    hard.looks.push_back({{2, -3, 1}, center, {0, 0, 1}, true, 200, 150});
  return hard;
}

HardCase film(double thickness, double tilt) {
  // The cutter is as high as the film leaves it; both reach the tilted place by roundings of their own.
  const glm::dmat4 motion = turn(tilt, tilt, 0);
  const std::string text = join("difference", {moved(part(), motion), moved(moved(cutter(1, -thickness), turn(tilt, 0, 0)), turn(0, tilt, 0))});
  return {text, "", motion, usualLooks(40, motion)};
}

}  // namespace copeel::validation
