// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ClothSolver.h"

#include "tests/solver/SolverScene.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth_test::cloth_solver_test {
namespace {

struct Stretch {
  double largest = 0;
  double mean = 0;
};

Stretch stretchOf(const btSoftBody& body) {
  Stretch stretch;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const double ratio = double((link.m_n[0]->m_x - link.m_n[1]->m_x).length() / link.m_rl);
    stretch.largest = std::max(stretch.largest, ratio);
    stretch.mean += ratio / body.m_links.size();
  }
  return stretch;
}

btSoftBody& addSheet(SolverScene& scene, int n, double height = 0) {
  wetcloth::ClothPatch patch = levelPatch(n, 1);
  patch.origin.setY(btScalar(height));
  btSoftBody& body = scene.add(patch);
  body.getCollisionShape()->setMargin(btScalar(0.01));
  return body;
}

// A quarter of Bullet's stretch is what small steps are for; half leaves room for the moment at which it is looked at.
TEST_IN_POSITION_BASED_WORLDS(InPositionBasedWorlds, AHangingClothStretchesLessThanInBulletsSolver) {
  const wetcloth::ClothPatch patch = hangingPatch(24);
  BodyScene bullets(GetParam(), patch);
  SolverScene scene(GetParam());
  btSoftBody& body = scene.add(patch);
  bullets.bullet().step(120, btScalar(1) / 60);
  scene.step(120);
  EXPECT_EQ(scene.solver().reasonNotTaken(body), "");
  EXPECT_LT(stretchOf(body).largest - 1, (stretchOf(bullets.body()).largest - 1) / 2);
  EXPECT_LT(stretchOf(body).mean - 1, (stretchOf(bullets.body()).mean - 1) / 2);
}

TEST_IN_POSITION_BASED_WORLDS(InPositionBasedWorlds, FallsAsTheClosedFormSays) {
  SolverScene scene(GetParam());
  btSoftBody& body = addSheet(scene, 9);
  scene.step(60);
  const double way = 9.81 / 2;
  const double oneStep = 9.81 / 60;  // that the cloth moves in a step at its end, at most
  EXPECT_NEAR(centreOfMass(body)[1], -way, oneStep);
  EXPECT_NEAR(double(meanVelocity(body).y()), -9.81, 1e-4);
}

// Newton's third law: links are inner forces.
TEST(ClothSolver, LinksKeepMomentum) {
  SolverScene scene(WorldKind::softRigid, kNoGravity);
  btSoftBody& body = addSheet(scene, 12);
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    body.m_nodes[k].m_v = btVector3(btScalar(std::sin(k)), btScalar(std::cos(3 * k)), btScalar(1));
    body.m_nodes[k].m_im *= btScalar(1 + k % 3);
  }
  const auto before = momentum(body);
  const double scale = freeMass(body);
  scene.step(60);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(momentum(body)[axis] / scale, before[axis] / scale, 1e-3) << "600 roundings of 3e-5 m/s each";
  }
}

// n links of stiffness k: link i carries the m g of all nodes below it.
double hangingLength(int links, double linkLength, double mass, double stiffness) {
  return links * linkLength + mass * 9.81 / stiffness * links * (links + 1) / 2;
}

TEST(ClothSolver, AHangingRopeStretchesAsItsStiffnessSaysDryAndWet) {
  constexpr int kLinks = 20;
  constexpr double kMass = 0.002;
  constexpr double kLength = 0.05;
  const double stiffness = kMass * 9.81 * kLinks / (0.2 * kLength);  // 20 % in the first link
  for (const double wetness : {1.0, 1.84}) {
    SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(10, stiffness));
    btSoftBody& rope = scene.add(hangingRope(kLinks, kLength, kMass));
    rope.m_cfg.kDP = btScalar(0.05);
    for (int k = 0; k < rope.m_nodes.size(); ++k) rope.m_nodes[k].m_im /= btScalar(wetness);
    scene.step(1200);
    const double length = -double(rope.m_nodes[kLinks].m_x.y());
    const double expected = hangingLength(kLinks, kLength, kMass * wetness, stiffness);
    EXPECT_NEAR(length - kLinks * kLength, expected - kLinks * kLength, 0.05 * (expected - kLinks * kLength))
        << wetness;
    EXPECT_LE(scene.solver().smallStepsFor(rope), 10);
    EXPECT_TRUE(scene.messages().empty());
  }
}

TEST(ClothSolver, ABodyThatItDoesNotTakeMovesAsInPlainBullet) {
  using Change = std::function<void(btSoftBody&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
      {"air", [](btSoftBody& body) { body.m_cfg.kDG = btScalar(0.1); }},
      {"soft", [](btSoftBody& body) { body.m_cfg.collisions |= btSoftBody::fCollision::VF_SS; }},
      {"velocity", [](btSoftBody& body) { body.m_cfg.viterations = 2; }},
      {"drift", [](btSoftBody& body) { body.m_cfg.diterations = 1; }},
      {"position", [](btSoftBody& body) { body.m_cfg.piterations = 0; }},
      {"pressure", [](btSoftBody& body) { body.m_cfg.kPR = 1; }},
      {"volume",
       [](btSoftBody& body) {
         body.setPose(true, false);
         body.m_cfg.kVC = btScalar(0.1);
       }},
      {"pose",
       [](btSoftBody& body) {
         body.setPose(false, true);
         body.m_cfg.kMT = btScalar(0.1);
       }},
      {"clusters",
       [](btSoftBody& body) {
         body.generateClusters(4);
         body.m_cfg.collisions = btSoftBody::fCollision::CL_RS;
       }},
      {"sequence", [](btSoftBody& body) { body.setSolver(btSoftBody::eSolverPresets::Velocities); }},
  };
  for (const auto& [word, change] : changes) {
    const wetcloth::ClothPatch patch = hangingPatch(7);
    BodyScene bullets(WorldKind::softRigid, patch);
    SolverScene scene;
    btSoftBody& body = scene.add(patch);
    change(bullets.body());
    change(body);
    bullets.bullet().step(30, btScalar(1) / 60);
    scene.step(30);
    EXPECT_NE(scene.solver().reasonNotTaken(body).find(word), std::string::npos) << scene.solver().reasonNotTaken(body);
    EXPECT_TRUE(sameBits(stateOf(body), stateOf(bullets.body()))) << word;
  }
}

TEST(ClothSolver, ABodyChangesSidesBetweenSteps) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(7));
  scene.step(10);
  EXPECT_EQ(scene.solver().reasonNotTaken(body), "");
  body.m_cfg.viterations = 1;
  scene.step(10);
  EXPECT_NE(scene.solver().reasonNotTaken(body), "");
  body.m_cfg.viterations = 0;
  scene.step(10);
  EXPECT_EQ(scene.solver().reasonNotTaken(body), "");
  EXPECT_LT(largestSpeed(body), 5);
}

TEST_IN_POSITION_BASED_WORLDS(InPositionBasedWorlds, ASheetComesToRestOnABox) {
  SolverScene scene(GetParam());
  btSoftBody& body = addSheet(scene, 9, 0.3);
  RigidBody ground(scene.bullet(), box(2, 0.5, 2), 0, btVector3(0, btScalar(-0.5), 0));
  scene.step(180);
  EXPECT_LT(largestSpeed(body), 0.02);
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    EXPECT_NEAR(double(body.m_nodes[k].m_x.y()), 0.01, 0.01) << k;  // its margin, and what the soft contact gives way
  }
}

// The rigid body takes what the cloth loses.
TEST_IN_POSITION_BASED_WORLDS(InPositionBasedWorlds, AFlyingSheetAndABoxKeepTheirMomentum) {
  SolverScene scene(GetParam(), kNoGravity);
  btSoftBody& body = addSheet(scene, 9, 0.3);
  RigidBody target(scene.bullet(), box(0.2, 0.1, 0.2), btScalar(0.3), btVector3(0, 0, 0));
  body.setVelocity(btVector3(0, -2, 0));
  const double before = momentum(body)[1];
  scene.step(60);
  const double ofBox = double(target.body().getLinearVelocity().y()) * 0.3;
  EXPECT_LT(ofBox, -0.02);
  EXPECT_NEAR(momentum(body)[1] + ofBox, before, 0.002 * std::fabs(before));
}

TEST(ClothSolver, FrictionHoldsAClothOnASlope) {
  const auto slide = [](double friction) {
    SolverScene scene(WorldKind::softRigid, btVector3(btScalar(1.5), btScalar(-9.7), 0));
    btSoftBody& body = addSheet(scene, 7, 0.012);
    body.m_cfg.kDF = btScalar(friction);
    RigidBody ground(scene.bullet(), box(5, 0.5, 5), 0, btVector3(0, btScalar(-0.5), 0));
    ground.body().setFriction(1);
    scene.step(60);
    return centreOfMass(body)[0];
  };
  EXPECT_GT(slide(0), 0.6);  // g t^2 / 2 = 0.75 m
  EXPECT_LT(slide(1), 0.02);
}

TEST_IN_POSITION_BASED_WORLDS(InPositionBasedWorlds, AnAnchoredClothPullsItsBody) {
  SolverScene scene(GetParam(), kNoGravity);
  btSoftBody& body = addSheet(scene, 7);
  RigidBody hook(scene.bullet(), box(0.05, 0.05, 0.05), btScalar(0.2), body.m_nodes[0].m_x);
  body.appendAnchor(0, &hook.body(), true);
  body.setVelocity(btVector3(0, 1, 0));
  const double before = momentum(body)[1];
  scene.step(120);
  const double ofHook = double(hook.body().getLinearVelocity().y()) * 0.2;
  EXPECT_GT(ofHook, 0.02);
  EXPECT_NEAR(momentum(body)[1] + ofHook, before, 0.01 * before);
  const btVector3 point = hook.body().getWorldTransform() * body.m_anchors[0].m_local;
  EXPECT_LT(double((body.m_nodes[0].m_x - point).length()), 0.02);
}

TEST(ClothSolver, PinsGoWhereTheApplicationPutsThem) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(7));
  std::vector<int> pins;
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    if (body.m_nodes[k].m_im == 0) pins.push_back(k);
  }
  scene.step(30);
  for (int s = 0; s < 60; ++s) {
    for (const int pin : pins) body.m_nodes[pin].m_x += btVector3(btScalar(0.01), 0, 0);
    const btVector3 put = body.m_nodes[pins[0]].m_x;
    scene.step(1);
    EXPECT_TRUE(body.m_nodes[pins[0]].m_x == put);
  }
  EXPECT_NEAR(double(meanPosition(body).x()), 0.5 + 0.6, 0.15) << "the cloth came along";
}

TEST(ClothSolver, LeavesBehindWhatBulletLeavesBehind) {
  const wetcloth::ClothPatch patch = levelPatch(8, 1);
  BodyScene bullets(WorldKind::softRigid, patch);
  SolverScene scene;
  btSoftBody& body = scene.add(patch);
  const auto bend = [](btSoftBody& cloth) {
    for (int k = 0; k < cloth.m_nodes.size(); ++k) cloth.m_nodes[k].m_x.setY(btScalar(0.01 * std::sin(k)));
  };
  bullets.bullet().step(1, btScalar(1) / 60);
  scene.step(1);
  bend(bullets.body());
  bend(body);
  std::vector<btVector3> before;
  for (int k = 0; k < body.m_nodes.size(); ++k) before.push_back(body.m_nodes[k].m_x);
  bullets.bullet().step(1, btScalar(1) / 60);
  scene.step(1);
  // Bounds are of the prediction, which is the same for both.
  EXPECT_LT(double((body.m_bounds[0] - bullets.body().m_bounds[0]).length()), 1e-4);
  EXPECT_LT(double((body.m_bounds[1] - bullets.body().m_bounds[1]).length()), 1e-4);
  const btVector3 boxed = body.getBroadphaseHandle()->m_aabbMin;
  EXPECT_LT(double((boxed - bullets.body().getBroadphaseHandle()->m_aabbMin).length()), 1e-4);
  EXPECT_EQ(body.m_sst.sdt, bullets.body().m_sst.sdt);
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    EXPECT_TRUE(body.m_nodes[k].m_q == before[std::size_t(k)]);
    EXPECT_TRUE(body.m_nodes[k].m_f == btVector3(0, 0, 0));
  }
  std::vector<btVector3> normals;
  for (int k = 0; k < body.m_nodes.size(); ++k) normals.push_back(body.m_nodes[k].m_n);
  const btVector3 faceNormal = body.m_faces[3].m_normal;
  body.updateNormals();
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    EXPECT_LT(double((body.m_nodes[k].m_n - normals[std::size_t(k)]).length()), 1e-5) << k;
  }
  EXPECT_LT(double((body.m_faces[3].m_normal - faceNormal).length()), 1e-5);
}

TEST(ClothSolver, ForcesAreFeltForOneStep) {
  SolverScene scene(WorldKind::softRigid, kNoGravity);
  btSoftBody& body = addSheet(scene, 5);
  scene.step(1);
  const double mass = freeMass(body);
  body.addForce(btVector3(0, btScalar(1), 0));  // on each node
  scene.step(2);
  EXPECT_NEAR(momentum(body)[1], body.m_nodes.size() / 60.0, 0.001 * body.m_nodes.size() / 60.0) << mass;
}

// A place 100 km away is known to 8 mm in float32. Kept places are not rounded so.
TEST(ClothSolver, AClothSwingsAlikeFarFromTheOrigin) {
  const auto lowest = [](double away) {
    SolverScene scene;
    wetcloth::ClothPatch patch = levelPatch(7, 1);
    patch.origin = btVector3(btScalar(away), 0, 0);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
    btSoftBody& body = scene.add([&](btSoftBodyWorldInfo& info) {
      auto made = patch.build(info);
      for (int k = 0; k < made->m_links.size(); ++k)
        made->m_links[k].m_rl = btScalar(std::round(double(made->m_links[k].m_rl) * 1e3) / 1e3);
      return made;
    });
    scene.step(30);
    return centreOfMass(body)[1];
  };
  const double near = lowest(0);
  EXPECT_LT(near, -0.2);
  EXPECT_NEAR(lowest(131072), near, 0.02 * -near);  // 2^17 m: the patch's places there are multiples of 1/64 m
}

// Where there is no link in a run of them, places differ by all of the way.
TEST(ClothSolver, AClothIsPutFarAwayAndThrown) {
  SolverScene scene;
  btSoftBody& body = scene.add(levelPatch(5, 1));
  scene.step(3);
  for (int k = 0; k < body.m_nodes.size(); ++k) body.m_nodes[k].m_x += btVector3(btScalar(1e5), 0, 0);
  scene.step(5);
  EXPECT_TRUE(isFinite(body));
  EXPECT_EQ(scene.solver().reasonNotTaken(body), "");
  body.addVelocity(btVector3(0, btScalar(3e6), 0));
  scene.step(5);
  EXPECT_TRUE(isFinite(body));
}

TEST(ClothSolver, ALinkWithoutLengthIsPulledToAnyLength) {
  SolverScene scene;
  btSoftBody& body = scene.add(levelPatch(5, 1));
  body.m_links[0].m_rl = 0;
  scene.step(3);
  body.m_links[0].m_n[0]->m_x += btVector3(0, btScalar(1e6), 0);
  scene.step(5);
  EXPECT_TRUE(isFinite(body));
}

TEST(ClothSolver, AClothThatIsNotFiniteIsToldAndLeftAlone) {
  SolverScene scene;
  btSoftBody& bad = scene.add(hangingPatch(5));
  btSoftBody& good = scene.add(hangingPatch(5));
  scene.step(5);
  const btVector3 place = bad.m_nodes[3].m_x;
  bad.m_nodes[3].m_v.setX(std::numeric_limits<btScalar>::quiet_NaN());
  good.addVelocity(btVector3(0, 0, 1));
  const btVector3 goodBefore = good.m_nodes[12].m_x;
  scene.step(5);
  EXPECT_EQ(scene.solver().reasonNotTaken(bad), "node 3 is not finite");
  ASSERT_EQ(scene.messages().size(), 1u);
  EXPECT_TRUE(bad.m_nodes[3].m_x == place);
  EXPECT_FALSE(good.m_nodes[12].m_x == goodBefore);
  EXPECT_TRUE(std::isfinite(largestSpeed(good)));
  bad.m_nodes[3].m_v.setZero();
  scene.step(5);
  EXPECT_EQ(scene.solver().reasonNotTaken(bad), "");
  EXPECT_TRUE(std::isfinite(largestSpeed(bad)));
}

TEST(ClothSolver, FollowsACutAndNewLinksAndLengths) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(7));
  scene.step(10);
  body.m_links.resize(body.m_links.size() - 40);
  scene.step(10);
  body.appendLink(0, 48, body.m_materials[0]);
  scene.step(10);
  EXPECT_FALSE(body.m_bUpdateRtCst);
  EXPECT_TRUE(std::isfinite(largestSpeed(body)));
  // All links half as long: the cloth pulls itself together, as it would in Bullet.
  for (int k = 0; k < body.m_links.size(); ++k) body.m_links[k].m_rl /= 2;
  const double before = totalLength(body);
  scene.step(60);
  EXPECT_LT(totalLength(body), 0.7 * before);
}

TEST(ClothSolver, BodiesComeAndGo) {
  SolverScene scene;
  btSoftBody& first = scene.add(hangingPatch(5));
  for (int round = 0; round < 5; ++round) {
    scene.add(hangingPatch(4 + round));
    scene.step(3);
    scene.removeLast();
    scene.step(1);
  }
  EXPECT_TRUE(std::isfinite(largestSpeed(first)));
}

TEST(ClothSolver, ASleepingBodyStays) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(5));
  scene.step(5);
  body.forceActivationState(DISABLE_SIMULATION);
  const btVector3 place = body.m_nodes[2].m_x;
  scene.step(5);
  EXPECT_TRUE(body.m_nodes[2].m_x == place);
  body.forceActivationState(ACTIVE_TAG);
  scene.step(5);
  EXPECT_FALSE(body.m_nodes[2].m_x == place);
}

// Links pull by the last digits of places: what that displaces must not add up to a velocity.
TEST(ClothSolver, ASheetThatNothingMovesRests) {
  for (const double dt : {1.0 / 1000, 1.0 / 60, 1.0 / 10}) {
    SolverScene scene(WorldKind::softRigid, btVector3(0, 0, 0));
    const btSoftBody& sheet = scene.add(sailPatch(16));
    scene.step(500, dt);
    for (int k = 0; k < sheet.m_nodes.size(); ++k) EXPECT_EQ(sheet.m_nodes[k].m_v.length(), 0) << dt;
  }
}

TEST(ClothSolver, StepsOfAnyLength) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(7));
  for (const double dt : {0.1, 1e-4, 0.1, 1.0 / 60}) scene.step(3, dt);
  EXPECT_TRUE(std::isfinite(largestSpeed(body)));
  EXPECT_LT(stretchOf(body).largest, 2);
  body.m_cfg.timescale = btScalar(1e-25);  // its square is 0 in float32
  scene.step(3);
  EXPECT_TRUE(isFinite(body));
  body.m_cfg.timescale = 0;
  const btVector3 place = body.m_nodes[2].m_x;
  scene.step(3);
  EXPECT_TRUE(body.m_nodes[2].m_x == place);
}

TEST(ClothSolver, LinksWithoutHardnessAndTooMuchDampingWriteNoNaN) {
  SolverScene scene;
  btSoftBody& body = scene.add(hangingPatch(5));
  for (int k = 0; k < body.m_links.size(); ++k) body.m_links[k].m_material->m_kLST = 0;
  scene.step(10);
  EXPECT_TRUE(std::isfinite(largestSpeed(body)));
  EXPECT_GT(largestSpeed(body), 1) << "nothing holds it";
  body.m_cfg.kDP = btScalar(1.5);
  scene.step(2);
  EXPECT_LT(largestSpeed(body), 1);
}

TEST(ClothSolver, RefusesBadParameters) {
  wetcloth::ClothSolver::Parameters tethered;
  tethered.tethers = 9;
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver solver(tethered); }).find("ClothSolver.tethers = 9"),
            std::string::npos);
  tethered.tethers = 1;
  tethered.tetherScale = 0.9;
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver solver(tethered); }).find("ClothSolver.tetherScale = 0.9"),
            std::string::npos);
  for (const double endless : {std::numeric_limits<double>::infinity(), 1e300}) {
    if (std::isfinite(btScalar(endless))) continue;
    tethered.tetherScale = endless;
    EXPECT_NE(rejection([&] { wetcloth::ClothSolver solver(tethered); }).find("ClothSolver.tetherScale = "),
              std::string::npos);
  }
  EXPECT_NE(
      rejection([&] { static_cast<void>(wetcloth::ClothSolver(smallSteps(0))); }).find("ClothSolver.smallSteps = 0"),
      std::string::npos);
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver(smallSteps(1001)); }).find("ClothSolver.smallSteps = 1001"),
            std::string::npos);
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver(smallSteps(10, 0)); }).find("ClothSolver.stiffness = 0"),
            std::string::npos);
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver(smallSteps(10, -1)); }).find("ClothSolver.stiffness = -1"),
            std::string::npos);
  EXPECT_NE(rejection([&] { wetcloth::ClothSolver(smallSteps(10, std::nan(""))); }).find("ClothSolver.stiffness = nan"),
            std::string::npos);
  wetcloth::ClothSolver solver(smallSteps(12));
  EXPECT_NE(rejection([&] { solver.setParameters(smallSteps(0)); }).find("ClothSolver.smallSteps = 0"),
            std::string::npos);
  EXPECT_EQ(solver.parameters().smallSteps, 12);
}

}  // namespace
}  // namespace wetcloth_test::cloth_solver_test
