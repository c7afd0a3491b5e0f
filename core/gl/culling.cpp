#include "core/gl/culling.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

#include "core/gl/layout.h"

namespace copeel::gl {
namespace {

constexpr int kMarginPx = 1;   // what rounding and the rasterizer's sub-pixel grid may add to a projected box is far below it

// The range of a plane's order value over the box's pixels. Every rounding step of the sum is monotonic in u and in v, so the corners bound it.
std::pair<double, double> orderRange(const DepthPlane& plane, const PixelRect& box, const View& view) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int corner = 0; corner < 4; ++corner) {
    const double u = double(corner & 1 ? box.x + box.width - 1 : box.x) - (0.5 * view.width - 0.5 - view.offset.x);
    const double v = double(corner & 2 ? box.y + box.height - 1 : box.y) - (0.5 * view.height - 0.5 - view.offset.y);
    const double s = std::clamp(plane.a * u + (plane.b * v + plane.c), double(plane.lo), double(plane.hi));
    least = std::min(least, s);
    most = std::max(most, s);
  }
  return {least, most};
}

}  // namespace

PixelRect windowBox(const Box& box, const glm::dmat4& worldFromObject, const View& view, double nearest) {
  glm::dvec2 lo(HUGE_VAL), hi(-HUGE_VAL);
  const glm::dvec2 center = 0.5 * glm::dvec2(view.width, view.height) - 0.5 - view.offset;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z);
    const glm::dvec3 p = transformPoint(worldFromObject, point) - view.eye;
    const double t = view.perspective ? glm::dot(view.forward, p) : 1.0;
    if (view.perspective && t < nearest) return {0, 0, view.width, view.height};
    const glm::dvec2 at = center + glm::dvec2(glm::dot(view.right, p) / (glm::dot(view.right, view.right) * t),
                                              glm::dot(view.down, p) / (glm::dot(view.down, view.down) * t));
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  // Clamped before they are whole numbers, which would not hold them all.
  const glm::dvec2 size(view.width, view.height);
  lo = glm::clamp(glm::floor(lo) - double(kMarginPx), glm::dvec2(0), size);
  hi = glm::clamp(glm::ceil(hi) + double(kMarginPx) + 1.0, glm::dvec2(0), size);
  if (box.empty() || lo.x >= hi.x || lo.y >= hi.y) return {};
  return {int(lo.x), int(lo.y), int(hi.x - lo.x), int(hi.y - lo.y)};
}

std::vector<ObjectBox> objectBoxes(const Scene& scene, const PlaneClasses& planes, const View& view, const DepthPlanes& depths,
                                   bool hardwareDepth) {
  const DepthScale scale = depthScale(depths, view.perspective);
  const double nearest = nearDistance(scene, view);
  // A turned mesh's box may stick out of the scene's, where pixels have nothing that could be asked.
  const PixelRect sceneBox = windowBox(scene.bounds(), glm::dmat4(1.0), view, nearest);
  std::map<const Mesh*, Box> meshBoxes;
  std::vector<std::uint32_t> seenBy(depths.size(), ~std::uint32_t{0});   // the last object with the class
  std::vector<ObjectBox> boxes;
  for (std::uint32_t object = 0; object < scene.objects().size(); ++object) {
    const Object& placed = scene.objects()[object];
    const auto [meshBox, isNew] = meshBoxes.try_emplace(placed.mesh.get());
    if (isNew) meshBox->second = boundingBox(*placed.mesh);
    ObjectBox box{intersection(windowBox(meshBox->second, placed.worldFromObject, view, nearest), sceneBox)};
    box.leastKey = hardwareDepth ? COPEEL_KEY_LEAST : COPEEL_KEY_NONE;
    box.greatestKey = hardwareDepth ? COPEEL_KEY_NONE : 0;
    const std::size_t facets = hardwareDepth || box.pixels.empty() ? 0 : placed.mesh->facetCount();
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
      const std::uint32_t planeClass = planes.classOf(object, facet);
      if (seenBy[planeClass] == object) continue;
      seenBy[planeClass] = object;
      const auto [least, most] = orderRange(depths[planeClass], box.pixels, view);
      box.leastKey = std::min(box.leastKey, keyOf(scale, least));
      box.greatestKey = std::max(box.greatestKey, keyOf(scale, most));
    }
    boxes.push_back(box);
  }
  return boxes;
}

Culling::Culling(std::vector<ObjectBox> boxes) : boxes_(std::move(boxes)) {
  std::vector<GLuint> names(boxes_.size());
  if (!names.empty()) glCreateQueries(GL_ANY_SAMPLES_PASSED, static_cast<GLsizei>(names.size()), names.data());
  for (const GLuint name : names) queries_.emplace_back(name);
  restart();
}

void Culling::restart() {
  drawn_.assign(boxes_.size(), true);
  asked_ = false;
}

void Culling::ask(const Program& box, const std::function<void(const PixelRect&)>& drawBox) {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!drawn_[i]) continue;
    box.set("leastKey", boxes_[i].leastKey);
    box.set("greatestKey", boxes_[i].greatestKey);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, queries_[i]);
    drawBox(boxes_[i].pixels);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
  }
  asked_ = true;
}

std::uint32_t Culling::draw(std::uint32_t begin, std::uint32_t end, const std::function<void(std::uint32_t, std::uint32_t)>& drawRun) {
  // The device decides before the answers are here; they are read once the pass is on its way.
  for (std::uint32_t i = begin; asked_ && i < end; ++i) {
    if (!drawn_[i]) continue;
    glBeginConditionalRender(queries_[i], GL_QUERY_WAIT);
    drawRun(i, i + 1);
    glEndConditionalRender();
  }
  const bool done = asked_;
  settle();
  // Later passes of the iteration know: objects side by side are drawn together.
  std::uint32_t count = 0;
  for (std::uint32_t i = begin, first; i < end; ++i) {
    for (first = i; i < end && drawn_[i];) ++i;
    count += i - first;
    if (!done && i > first) drawRun(first, i);
  }
  return count;
}

void Culling::settle() {
  for (std::size_t i = 0; asked_ && i < boxes_.size(); ++i) {
    if (!drawn_[i]) continue;
    GLuint any = 0;
    glGetQueryObjectuiv(queries_[i], GL_QUERY_RESULT, &any);
    drawn_[i] = any != 0;
  }
  asked_ = false;
}

}  // namespace copeel::gl
