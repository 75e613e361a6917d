// SPDX-License-Identifier: Zlib
#include "command/viewer/OrbitCamera.h"

#include "command/viewer/PlainVector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::orbit_camera_test {
namespace {

using viewer::bulletVector;
using viewer::OrbitCamera;

constexpr double tolerance = 1e-4;

pictures::View someView() { return {{1, 2, 5}, {0.5F, 1, 0}, {0, 1, 0}, 40}; }

double distance(const pictures::Vector3& a, const pictures::Vector3& b) {
  return static_cast<double>((bulletVector(a) - bulletVector(b)).length());
}

TEST(OrbitCamera, BeginsWithTheViewItWasGiven) {
  for (const pictures::Vector3& up : {pictures::Vector3{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}}) {
    pictures::View view = someView();
    view.up = up;
    const pictures::View seen = OrbitCamera(view).view();
    EXPECT_LT(distance(seen.eye, view.eye), tolerance);
    EXPECT_LT(distance(seen.target, view.target), tolerance);
    EXPECT_FLOAT_EQ(seen.fieldOfView, view.fieldOfView);
  }
}

TEST(OrbitCamera, OrbitKeepsTheDistanceAndNeverGoesOverTheTop) {
  OrbitCamera camera(someView());
  const double before = distance(someView().eye, someView().target);
  for (int i = 0; i < 40; ++i) {
    camera.orbit(0.3, 0.2);
    EXPECT_NEAR(distance(camera.view().eye, camera.view().target), before, tolerance);
  }
  EXPECT_GT(camera.view().eye[1], camera.view().target[1] + 0.99 * before);
  camera.orbit(0, -100);
  EXPECT_LT(camera.view().eye[1], camera.view().target[1] - 0.99 * before);
}

TEST(OrbitCamera, StaysAboveTheFloor) {
  OrbitCamera camera(someView());
  camera.stayAbove(0);
  camera.orbit(0, -2);
  EXPECT_GT(camera.view().eye[1], 0);
  camera.zoom(10);
  EXPECT_GT(camera.view().eye[1], 0);
  camera.pan(0, -0.01);
  EXPECT_GT(camera.view().eye[1], 0);
}

TEST(OrbitCamera, ZoomGoesTowardsTheTargetAndNotThroughIt) {
  OrbitCamera camera(someView());
  const double before = distance(someView().eye, someView().target);
  camera.zoom(0.5);
  EXPECT_NEAR(distance(camera.view().eye, camera.view().target), 0.5 * before, tolerance);
  camera.zoom(1e-9);
  EXPECT_GT(distance(camera.view().eye, camera.view().target), 0.01);
}

TEST(OrbitCamera, PanMovesWhatIsAtTheTargetByTheSameShareOfThePicture) {
  OrbitCamera camera(someView());
  const btVector3 target = bulletVector(someView().target);
  camera.pan(0.25, -0.1);
  const auto place = camera.project(target, 2);
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place)[0], -2 * 0.25 / 2, tolerance);
  EXPECT_NEAR((*place)[1], 2 * 0.1, tolerance);
}

TEST(OrbitCamera, ARayGoesThroughWhatIsSeenThere) {
  const OrbitCamera camera(someView());
  for (const btVector3& point : {btVector3(0, 0, 0), btVector3(1, btScalar(1.5), -1), btVector3(-1, 2, 1)}) {
    const auto place = camera.project(point, 1.6);
    ASSERT_TRUE(place);
    const viewer::Ray ray = camera.rayThrough((*place)[0], (*place)[1], 1.6);
    const btScalar along = ray.direction.dot(point - ray.origin);
    EXPECT_LT(static_cast<double>((ray.origin + ray.direction * along - point).length()), tolerance);
    EXPECT_GT(along, camera.depthOf(point) - btScalar(tolerance));
  }
  EXPECT_FALSE(camera.project(btVector3(2, 4, 20), 1.6));  // behind the eye
}

}  // namespace
}  // namespace wetcloth_test::orbit_camera_test
