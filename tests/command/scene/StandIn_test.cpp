// SPDX-License-Identifier: Zlib
// What `wetcloth validate` builds instead of a large cloth.

#include "command/scene/StandIn.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wetcloth_test::stand_in_test {
namespace {

using namespace cli;

Json largeScene(int side) {
  Json scene = smallScene();
  scene["cloths"][0]["patch"]["columns"] = side;
  scene["cloths"][0]["patch"]["rows"] = side;
  return scene;
}

command::Scene read(const Json& scene) {
  const TemporaryDirectory directory;
  return command::readScene(directory.write("scene.json", scene.dump()));
}

double lightest(const btSoftBody& body) {
  btScalar most = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) most = btMax(most, body.m_nodes[i].m_im);
  return 1 / static_cast<double>(most);
}

TEST(StandIn, IsOfFewNodesAsHeavyAndAsFarApart) {
  const command::Scene scene = read(largeScene(100));
  const command::Scene small = command::standIn(scene);
  const command::SceneWorld large(scene), world(small);
  const btSoftBody& body = *large.bodies()[0];
  const btSoftBody& few = *world.bodies()[0];
  EXPECT_LE(few.m_nodes.size(), 16);
  EXPECT_NEAR(lightest(few), lightest(body), 1e-4 * lightest(body));
  EXPECT_NEAR(double(few.m_links[0].m_rl), double(body.m_links[0].m_rl), 1e-4 * double(body.m_links[0].m_rl));
  EXPECT_EQ(small.cloths[0].effects.size(), scene.cloths[0].effects.size());
}

TEST(ValidateLargeCloth, TakesAnArrayWithANumberForEachNode) {
  const TemporaryDirectory directory;
  Json scene = largeScene(20);
  scene["cloths"][0]["effects"]["absorption"] = {{"exposure", std::vector<double>(400, 0.5)}};
  const Outcome outcome = runWetcloth({"validate", directory.write("scene.json", scene.dump())});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(ValidateLargeCloth, NamesWhatTheLibraryRefusesOfALargeCloth) {
  const TemporaryDirectory directory;
  Json scene = largeScene(100);
  scene["cloths"][0]["collisions"] = {"CL_RS"};
  scene["cloths"][0]["clusters"] = 4;
  scene["cloths"][0]["effects"]["wet_friction"] = Json::object();
  const std::string file = directory.write("scene.json", scene.dump());
  expectRefusal(runWetcloth({"validate", file}), {file + ": /cloths/0/effects/wet_friction: ", "CL_RS"});
}

}  // namespace
}  // namespace wetcloth_test::stand_in_test
