// SPDX-License-Identifier: Zlib
// What pictures are given between two steps, and of bodies that move.

#include "command/render/SampleRun.h"
#include "command/pictures/PosedSolid.h"
#include "command/scene/SceneReader.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace wetcloth_test::sample_run_test {
namespace {

using namespace cli;

/// A box with its middle at (2, 0, 0) that turns about y by 90 degrees and rises by 1 m, both in 1 s.
Json turningBox() {
  Json scene = smallScene();
  scene["precision"] = testedPrecision();
  scene["duration_s"] = 0.25;
  scene["colliders"] = {
      {{"box", {{"centre_m", {2, 0, 0}}, {"half_extents_m", {1, 0.5, 0.5}}}},
       {"motion",
        {{"times_s", {0, 1}}, {"offsets_m", {{0, 0, 0}, {0, 1, 0}}}, {"rotations_deg", {{0, 0, 0}, {0, 90, 0}}}}}}};
  return scene;
}

// Its middle rises steadily; a corner turns about it. Between two steps of 1/60 s the straight line between both places
// is short of the arc by 1e-4 of the corner's distance from the middle.
TEST(SampleRun, BodiesThatMoveAreWhereTheyAreBetweenTwoStepsToo) {
  const TemporaryDirectory directory;
  const command::Scene scene = command::readScene(directory.write("scene.json", turningBox().dump()));
  const double step = scene.step;
  const std::vector<double> times{0.4 * step, 3 * step, 7.25 * step};
  const pictures::FrameSequence run = command::sampleRun(scene, times);
  ASSERT_EQ(run.frames.size(), times.size());
  const pictures::Solid& atRest = run.scenery.solids.at(0);
  for (std::size_t f = 0; f < times.size(); ++f) {
    ASSERT_EQ(run.frames[f].poses.size(), 1u);
    const pictures::Solid solid = pictures::posedSolid(run.scenery, run.frames[f], 0);
    const double angle = 1.5707963267948966 * times[f];
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
      const double x = double(atRest.vertices[v][0]) - 2, z = double(atRest.vertices[v][2]);
      EXPECT_NEAR(double(solid.vertices[v][0]), 2 + x * std::cos(angle) + z * std::sin(angle), 2e-4) << times[f];
      EXPECT_NEAR(double(solid.vertices[v][1]), double(atRest.vertices[v][1]) + times[f], 2e-4) << times[f];
      EXPECT_NEAR(double(solid.vertices[v][2]), -x * std::sin(angle) + z * std::cos(angle), 2e-4) << times[f];
    }
  }
}

TEST(SampleRun, WhereNothingMovesThereAreNoPoses) {
  const TemporaryDirectory directory;
  const command::Scene scene = command::readScene(directory.write("scene.json", [] {
    Json json = smallScene();
    json["precision"] = testedPrecision();
    return json.dump();
  }()));
  EXPECT_TRUE(command::sampleRun(scene, {0, scene.step}).frames[1].poses.empty());
}

}  // namespace
}  // namespace wetcloth_test::sample_run_test
