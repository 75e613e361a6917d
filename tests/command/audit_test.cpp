// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test::audit_test {
namespace {

using namespace cli;

/// A sheet that is wrung, small and short.
Json wrungSheet() {
  Json scene = readJson(sceneFile("audit_twist"));
  scene["duration_s"] = 1;
  scene["cloths"][0]["patch"]["columns"] = 9;
  scene["cloths"][0]["patch"]["rows"] = 11;
  scene["cloths"][0]["twist"]["turns_per_s"] = 2;
  return scene;
}

std::string refusal(const Json& scene) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"validate", directory.write("scene.json", scene.dump())});
  EXPECT_EQ(outcome.status, 2);
  return outcome.err;
}

TEST(Audit, CountsWhatPassesAndChangesNothing) {
  Json scene = wrungSheet();
  const Json audited = runScene(scene);
  const Json& audit = audited.at("audit");
  EXPECT_GT(audit.at("edge_edge"), 0);
  EXPECT_NEAR(audit.at("per_second").get<double>(),
              audit.at("vertex_face").get<double>() + audit.at("edge_edge").get<double>(), 0.1);
  scene["cloths"][0]["effects"].erase("collision_audit");
  const Json plain = runScene(scene);
  EXPECT_FALSE(plain.contains("audit"));
  EXPECT_EQ(plain.at("state_hash"), audited.at("state_hash"));
}

// Bullet's position-based worlds have no self-collision of vertices and faces, and the flag of that of clusters hides
// itself behind its own mask.
TEST(Audit, NeitherFlagOfThePositionBasedWorldsStopsASelfPassage) {
  Json scene = wrungSheet();
  const Json without = runScene(scene);
  scene["cloths"][0]["collisions"] = {"SDF_RS", "VF_SS"};
  EXPECT_EQ(runScene(scene).at("state_hash"), without.at("state_hash"));
  scene["cloths"][0]["collisions"] = {"SDF_RS", "CL_SS", "CL_SELF"};
  scene["cloths"][0]["clusters"] = 16;
  EXPECT_EQ(runScene(scene).at("state_hash"), without.at("state_hash"));
}

TEST(Audit, ASummaryHasALineOfIt) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", wrungSheet().dump());
  const Outcome outcome = runWetcloth({"run", file});
  EXPECT_NE(outcome.out.find("vertices through faces"), std::string::npos);
}

TEST(Audit, OfAGuardedSheetCountsNothing) {
  Json scene = wrungSheet();
  scene["solver"] = {{"guard", Json::object()}};
  const Json audit = runScene(scene).at("audit");
  EXPECT_EQ(audit.at("vertex_face"), 0);
  EXPECT_EQ(audit.at("edge_edge"), 0);
  EXPECT_EQ(audit.at("incomplete_substeps"), 0);
}

TEST(Audit, OnlyAPinnedEdgeCanBeTwisted) {
  Json scene = wrungSheet();
  scene["cloths"][0]["twist"]["edge"] = "left";
  EXPECT_NE(refusal(scene).find("/cloths/0/twist/edge"), std::string::npos);
}

TEST(Audit, ATwistedEdgeMustNotReachTheOppositeOne) {
  for (const double approach : {-0.1, 1.7}) {
    Json scene = wrungSheet();
    scene["cloths"][0]["twist"]["approach_m"] = approach;
    EXPECT_NE(refusal(scene).find("/cloths/0/twist/approach_m"), std::string::npos) << approach;
  }
}

TEST(Audit, AFlagThatBulletDoesNotHaveIsRefused) {
  Json scene = wrungSheet();
  scene["cloths"][0]["collisions"] = {"VF_SELF"};
  EXPECT_NE(refusal(scene).find("VF_SELF"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::audit_test
