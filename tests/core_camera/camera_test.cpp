// The camera's numbers: each form, what --viewall and --autocenter change, exact quarter turns, and what is refused.
#include "core/scene/camera.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"

namespace copeel {
namespace {

const Box kBox{{10, 20, 30}, {40, 60, 90}};
constexpr double kTolerance = 1e-12;   // relative to numbers around 1; the formulas are a few roundings long

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = kTolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "coordinate " << i;
}

CameraOptions with(std::vector<double> camera) {
  CameraOptions options;
  options.camera = std::move(camera);
  return options;
}

ExitCode codeOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::Done;
}

TEST(Camera, QuarterTurnsAreExact) {
  const View top = viewOf(with({1, 2, 3, 0, 0, 0, 100}), kBox);
  EXPECT_EQ(top.forward, glm::dvec3(0, 0, -1));
  EXPECT_EQ(top.eye, glm::dvec3(1, 2, 103));
  EXPECT_EQ(glm::normalize(top.right), glm::dvec3(1, 0, 0));
  EXPECT_EQ(glm::normalize(top.down), glm::dvec3(0, -1, 0));
  const View front = viewOf(with({0, 0, 0, 90, 0, 0, 100}), kBox);
  EXPECT_EQ(front.forward, glm::dvec3(0, 1, 0));
  const View right = viewOf(with({0, 0, 0, 90, 0, 90, 100}), kBox);
  EXPECT_EQ(right.forward, glm::dvec3(-1, 0, 0));
  const View back = viewOf(with({0, 0, 0, 450, 360, -180, 100}), kBox);
  EXPECT_EQ(back.forward, glm::dvec3(0, -1, 0));
}

TEST(Camera, VectorFormLooksFromEyeToCentre) {
  const View view = viewOf(with({0, -30, 40, 0, 0, 0}), kBox);
  expectNear(view.eye, {0, -30, 40});
  expectNear(view.forward, {0, 0.6, -0.8});
  expectNear(glm::normalize(view.right), {1, 0, 0});
  expectNear(glm::normalize(view.down), {0, -0.8, -0.6});
}

TEST(Camera, StraightDownAndUpHaveYUp) {
  const View down = viewOf(with({5, 5, 50, 5, 5, 0}), kBox);
  EXPECT_EQ(glm::normalize(down.right), glm::dvec3(1, 0, 0));
  EXPECT_EQ(glm::normalize(down.down), glm::dvec3(0, -1, 0));
  const View up = viewOf(with({5, 5, -50, 5, 5, 0}), kBox);
  EXPECT_EQ(glm::normalize(up.right), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(glm::normalize(up.down), glm::dvec3(0, -1, 0));
}

TEST(Camera, WithoutNumbersTheWholeModelIsShown) {
  const View view = viewOf(with({}), kBox);
  const double distance = kBox.diagonal() / 2 / std::sin(11.25 * std::acos(-1.0) / 180);
  expectNear(view.eye + distance * view.forward, kBox.center(), 1e-10);
  CameraOptions asked = with({0, 0, 0, 55, 0, 25, 1});
  asked.viewAll = asked.autoCenter = true;
  expectNear(viewOf(asked, kBox).eye, view.eye);
}

TEST(Camera, AutocenterAloneChangesNothing) {
  CameraOptions options = with({1, 2, 3, 55, 0, 25, 140});
  const View plain = viewOf(options, kBox);
  options.autoCenter = true;
  EXPECT_EQ(viewOf(options, kBox).eye, plain.eye);
}

TEST(Camera, ViewallKeepsCentreAndDirection) {
  CameraOptions options = with({0, 0, 0, 90, 0, 0, 1});
  options.viewAll = true;
  const View view = viewOf(options, kBox);
  EXPECT_EQ(view.eye.x, 0);
  EXPECT_EQ(view.eye.z, 0);
  const double radius = glm::length(kBox.center()) + kBox.diagonal() / 2;
  EXPECT_NEAR(-view.eye.y, radius / std::sin(11.25 * std::acos(-1.0) / 180), 1e-9);
}

TEST(Camera, OrthographicShowsWhatPerspectiveShowsAtTheCentre) {
  CameraOptions options = with({0, 0, 0, 90, 0, 0, 100});
  options.width = 640;
  options.height = 480;
  const View perspective = viewOf(options, kBox);
  options.perspective = false;
  const View orthographic = viewOf(options, kBox);
  expectNear(orthographic.right, 100.0 * perspective.right);
  expectNear(orthographic.down, 100.0 * perspective.down);
}

TEST(Camera, EmptyModelAndPointHaveAView) {
  EXPECT_TRUE(std::isfinite(viewOf(with({}), Box{}).eye.x));
  EXPECT_TRUE(std::isfinite(viewOf(with({}), Box{{1, 1, 1}, {1, 1, 1}}).eye.x));
}

TEST(Camera, RefusesWhatMakesNoPicture) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& camera : std::vector<std::vector<double>>{{1, 2, 3}, {0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, -5}, {1, 2, 3, 1, 2, 3},
                                                             {0, 0, 0, inf, 0, 0, 1}, {std::nan(""), 0, 0, 1, 1, 1}}) {
    EXPECT_EQ(codeOf([&] { viewOf(with(camera), kBox); }), ExitCode::Usage);
  }
  for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {-1, 10}, {16385, 10}, {10, 16385}}) {
    CameraOptions options;
    options.width = width;
    options.height = height;
    EXPECT_EQ(codeOf([&] { viewOf(options, kBox); }), ExitCode::Usage) << width << "x" << height;
  }
  EXPECT_EQ(codeOf([&] { viewOf(with({}), Box{{-1e308, 0, 0}, {1e308, 0, 0}}); }), ExitCode::Input);
}

TEST(Camera, BothFormsAreOneCamera) {
  for (const std::vector<double>& camera : std::vector<std::vector<double>>{
           {60, -70, 80, 10, 15, 5}, {-40, 90, -30, 8, 12, 2}, {5, 5, 50, 5, 5, 0}, {5, 5, -50, 5, 5, 0}, {-7, -3, 4, 1, -3, 4}}) {
    const View vector = viewOf(with(camera), kBox), gimbal = viewOf(with(gimbalNumbers(camera)), kBox);
    expectNear(gimbal.eye, vector.eye, 1e-12 * 200);
    expectNear(gimbal.forward, vector.forward);
    expectNear(gimbal.right, vector.right);
    expectNear(gimbal.down, vector.down);
  }
}

TEST(Camera, EyeOnCentreIsSavedByViewall) {
  CameraOptions options = with({1, 2, 3, 1, 2, 3});
  options.viewAll = true;
  EXPECT_EQ(viewOf(options, kBox).forward, glm::dvec3(0, -1, 0));
}

}  // namespace
}  // namespace copeel
