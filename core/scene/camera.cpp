// The camera of OpenSCAD 2021.01, from its numbers to the rays of a picture.
//
// Based on: the observed behaviour of openscad 2021.01's PNG export, checked against the program itself in tests/core_camera.
// A camera is a centre, a turn and a distance; both forms of --camera are brought to that, as openscad does:
//   7 numbers  centre, turn about x, y, z in degrees, distance. 0,0,0 looks down the z axis with y up.
//   6 numbers  eye, centre. z is up; looking straight down or up, y is.
//   none       turn 55, 0, 25, and --viewall --autocenter.
// --viewall sets the distance so that the sphere about the centre that holds the model's box touches the sides of the view cone;
// --autocenter moves the centre to the box's, but only together with --viewall: alone it does nothing, in openscad as here.
// Changed: openscad clips at 0.1 and 100 distances and works in float32; here nothing is clipped, and quarter turns are exact, so
// that a face seen edge-on is seen exactly edge-on.
#include "core/scene/camera.h"

#include <cmath>

#include <glm/mat3x3.hpp>

#include "core/error.h"

namespace copeel {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalfFieldOfView = 22.5 / 2;   // degrees, vertical
constexpr double kDefaultDistance = 140;        // model units; where the model gives none
constexpr int kMaxImageSide = 16384;            // pixels

// Where the camera stands: right, up and forward are orthogonal unit vectors in world units.
struct Pose {
  glm::dvec3 center{0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 forward{0, 1, 0};
  double distance = kDefaultDistance;
};

// Exact at quarter turns, where pi in double would leave 1e-16 and tilt a face that is seen edge-on.
double sinDegrees(double degrees) {
  const double turned = std::remainder(degrees, 360.0);
  if (turned == 0 || std::abs(turned) == 180) return 0;
  if (std::abs(turned) == 90) return turned > 0 ? 1 : -1;
  return std::sin(turned * kPi / 180);
}

// The remainder first: an angle of 1e300 has no digits left to add 90 to.
double cosDegrees(double degrees) { return sinDegrees(std::remainder(degrees, 360.0) + 90); }

glm::dmat3 turnX(double degrees) {
  const double s = sinDegrees(degrees), c = cosDegrees(degrees);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
glm::dmat3 turnY(double degrees) {
  const double s = sinDegrees(degrees), c = cosDegrees(degrees);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}
glm::dmat3 turnZ(double degrees) {
  const double s = sinDegrees(degrees), c = cosDegrees(degrees);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

// The turns are the model's, seen from a viewer who looks along -z: the camera turns the other way round.
Pose gimbalPose(const glm::dvec3& center, const glm::dvec3& turn, double distance) {
  const glm::dmat3 worldFromView = turnZ(turn.z) * turnY(turn.y) * turnX(turn.x);
  return {center, worldFromView[0], -worldFromView[2], distance};
}

Pose vectorPose(const glm::dvec3& eye, const glm::dvec3& center) {
  const glm::dvec3 view = center - eye;
  const double distance = std::hypot(view.x, view.y, view.z);
  const double level = std::hypot(view.x, view.y);
  Pose pose{center, {}, {}, distance};
  // Without a direction openscad's formulas leave the view along -y; only --viewall can make a picture of it.
  if (distance == 0) return {center, {-1, 0, 0}, {0, -1, 0}, 0};
  pose.forward = view / distance;
  if (level > 0) {
    pose.right = {view.y / level, -view.x / level, 0};
  } else {
    pose.right = {view.z < 0 ? 1.0 : -1.0, 0, 0};
  }
  return pose;
}

Pose poseOf(const std::vector<double>& camera) {
  const auto three = [&](std::size_t i) { return glm::dvec3(camera[i], camera[i + 1], camera[i + 2]); };
  switch (camera.size()) {
    case 0: return gimbalPose({0, 0, 0}, {55, 0, 25}, kDefaultDistance);
    case 6: return vectorPose(three(0), three(3));
    case 7: return gimbalPose(three(0), three(3), camera[6]);
    default: failUsage("--camera takes 7 numbers (translate, rotate, distance) or 6 (eye, centre), not {}", camera.size());
  }
}

void fitModel(Pose& pose, bool autoCenter, const Box& bounds) {
  if (autoCenter) pose.center = bounds.center();
  const double radius = glm::length(bounds.center() - pose.center) + bounds.diagonal() / 2;
  pose.distance = radius > 0 ? radius / sinDegrees(kHalfFieldOfView) : kDefaultDistance;
  if (!std::isfinite(pose.distance)) failInput("the model is too large to be fitted into a view");
}

void checkOptions(const CameraOptions& options) {
  for (const int side : {options.width, options.height}) {
    if (side < 1 || side > kMaxImageSide) {
      failUsage("the image size must be 1 to {} pixels a side, not {},{}", kMaxImageSide, options.width, options.height);
    }
  }
  for (const double number : options.camera) {
    if (!std::isfinite(number)) failUsage("--camera takes finite numbers only");
  }
}

}  // namespace

View viewOf(const CameraOptions& options, const Box& modelBounds) {
  checkOptions(options);
  Pose pose = poseOf(options.camera);
  const bool isDefault = options.camera.empty();
  if (isDefault || options.viewAll) fitModel(pose, isDefault || options.autoCenter, modelBounds);
  if (!(pose.distance > 0 && std::isfinite(pose.distance))) {
    failUsage("the camera's eye must be at a positive distance from its centre");
  }

  // The half height of the picture is tan(fov/2) at unit distance; an orthographic picture shows what the perspective one shows
  // at the centre's distance. Pixels are square.
  const double pixelAtUnitDistance = 2 * std::tan(kHalfFieldOfView * kPi / 180) / options.height;
  const double pixel = options.perspective ? pixelAtUnitDistance : pixelAtUnitDistance * pose.distance;
  View view;
  view.width = options.width;
  view.height = options.height;
  view.perspective = options.perspective;
  view.eye = pose.center - pose.distance * pose.forward;
  view.forward = pose.forward;
  view.right = pixel * pose.right;
  view.down = pixel * glm::cross(pose.forward, pose.right);
  return view;
}

std::vector<double> gimbalNumbers(const std::vector<double>& camera) {
  if (camera.empty()) return {0, 0, 0, 55, 0, 25, kDefaultDistance};
  if (camera.size() != 6) return camera;
  const glm::dvec3 view(camera[3] - camera[0], camera[4] - camera[1], camera[5] - camera[2]);
  const double level = std::hypot(view.x, view.y);
  const double up = std::atan2(view.z, level) * 180 / kPi;
  const double around = level > 0 ? std::atan2(view.y, view.x) * 180 / kPi - 90 : (view.z < 0 ? 0 : -180);
  return {camera[3], camera[4], camera[5], 90 + up, 0, around, std::hypot(level, view.z)};
}

}  // namespace copeel
