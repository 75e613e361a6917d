// SPDX-License-Identifier: Zlib
#include "tests/command/viewer/ViewerScene.h"

#include "command/run/StateHash.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::live_scene_test {
namespace {

using namespace viewer_scene;
using command::stateHash;
using command::WorldKind;
using viewer::LiveScene;
using viewer::Side;

const double notANumber = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

using LiveSceneIn = InEachWorld;
INSTANTIATE_TEST_SUITE_P(EachWorld, LiveSceneIn, allWorlds, worldName);

TEST_P(LiveSceneIn, RunsAsTheSceneDoesWithoutIt) {
  const command::Scene scene = soakingTowel(GetParam());
  command::SceneWorld plainRun(scene);
  LiveScene live(scene);
  for (int i = 0; i < 30; ++i) plainRun.step();
  run(live, 30);
  EXPECT_EQ(stateHash(live.world()), stateHash(plainRun));
  EXPECT_DOUBLE_EQ(live.time(), 30 * scene.step);
}

TEST_P(LiveSceneIn, ResetIsAFreshStart) {
  LiveScene fresh(soakingTowel(GetParam()));
  run(fresh, 20);
  LiveScene live(soakingTowel(GetParam()));
  run(live, 7);
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.3)));
  live.dragTo(btVector3(0, 3, 1));
  run(live, 7);
  live.reset();
  EXPECT_EQ(live.grip(), nullptr);
  EXPECT_EQ(live.time(), 0);
  run(live, 20);
  EXPECT_EQ(stateHash(live.world()), stateHash(fresh.world()));
}

TEST_P(LiveSceneIn, ResetKeepsWhatWasSet) {
  const auto set = [](LiveScene& live) {
    live.setWind(btVector3(0, 0, 6));
    live.setExposure(0.25);
    live.setSubsteps(2);
    live.setIterations(5);
    live.turnEffect(indexOf(live, "drying"), true);
  };
  LiveScene early(soakingTowel(GetParam()));
  set(early);
  early.reset();
  run(early, 20);
  LiveScene late(soakingTowel(GetParam()));
  run(late, 9);
  set(late);
  late.reset();
  run(late, 20);
  EXPECT_EQ(stateHash(late.world()), stateHash(early.world()));
  EXPECT_TRUE(switchOf(late, "drying").isOn);
  late.restore();
  run(late, 20);
  LiveScene fresh(soakingTowel(GetParam()));
  run(fresh, 20);
  EXPECT_EQ(stateHash(late.world()), stateHash(fresh.world()));
  EXPECT_FALSE(switchOf(late, "drying").isOn);
}

TEST(LiveScene, PausedNothingMovesUntilItIsStepped) {
  LiveScene live(soakingTowel());
  run(live, 3);
  const std::string before = stateHash(live.world());
  live.setPaused(true);
  for (int i = 0; i < 10; ++i) live.advance(0.05);
  EXPECT_EQ(stateHash(live.world()), before);
  live.setPaused(false);
  live.advance(1e-6);  // the pause left no time to catch up with
  EXPECT_EQ(stateHash(live.world()), before);
  live.setPaused(true);
  live.step();
  EXPECT_NE(stateHash(live.world()), before);
  EXPECT_EQ(live.steps(), 4);
}

TEST(LiveScene, TheClockMakesSteps) {
  LiveScene live(hangingTowel());
  const double step = live.scene().step;
  live.advance(0.4 * step);
  EXPECT_EQ(live.steps(), 0);
  live.advance(0.7 * step);
  EXPECT_EQ(live.steps(), 1);
  live.setTimeScale(0.25);
  for (int i = 0; i < 8; ++i) live.advance(step);
  EXPECT_EQ(live.steps(), 3);
  for (const double odd : {notANumber, infinity, -1.0, 0.0}) live.advance(odd);
  EXPECT_EQ(live.steps(), 3);
}

TEST(LiveScene, MoreSubstepsInTheMiddleOfARunKeepTheTime) {
  LiveScene live(hangingTowel());
  run(live, 3);
  live.setSubsteps(9);
  run(live, 3);
  EXPECT_DOUBLE_EQ(live.time(), 6 * live.scene().step);
  EXPECT_EQ(live.substeps(), 9);
}

TEST(LiveScene, WhatIsOutOfRangeIsRefusedAndNothingChanges) {
  LiveScene live(soakingTowel());
  live.turnEffect(indexOf(live, "rain"), true);
  live.setWind(btVector3(1, 2, 3));
  live.setExposure(0.5);
  live.setRainFlux(0.01);
  live.setRainDirection(btVector3(1, -1, 0));
  const auto vector = [](double x) { return btVector3(0, btScalar(x), 0); };
  for (const double bad : {notANumber, infinity, -infinity}) {
    EXPECT_THROW(live.setWind(vector(bad)), std::invalid_argument);
    EXPECT_THROW(live.setRainDirection(vector(bad)), std::invalid_argument);
    EXPECT_THROW(live.setExposure(bad), std::invalid_argument);
    EXPECT_THROW(live.setRainFlux(bad), std::invalid_argument);
    EXPECT_THROW(live.setTimeScale(bad), std::invalid_argument);
  }
  EXPECT_THROW(live.setRainDirection(vector(0)), std::invalid_argument);
  for (const double bad : {-0.1, 1.1}) EXPECT_THROW(live.setExposure(bad), std::invalid_argument);
  EXPECT_THROW(live.setRainFlux(-1), std::invalid_argument);
  for (const double bad : {-1.0, 0.0, 5.0}) EXPECT_THROW(live.setTimeScale(bad), std::invalid_argument);
  for (const int bad : {-1, 0, 1001}) EXPECT_THROW(live.setSubsteps(bad), std::invalid_argument);
  for (const int bad : {-1, 0, 10001}) EXPECT_THROW(live.setIterations(bad), std::invalid_argument);
  EXPECT_THROW(live.setFabric("silk"), std::invalid_argument);
  EXPECT_EQ(live.wind(), btVector3(1, 2, 3));
  EXPECT_EQ(live.exposure(), 0.5);
  EXPECT_EQ(live.rainFlux(), 0.01);
  EXPECT_EQ(live.rainDirection(), btVector3(1, -1, 0));
  EXPECT_EQ(live.timeScale(), 1);
  EXPECT_EQ(live.substeps(), 4);
  EXPECT_EQ(live.iterations(), 10);
  EXPECT_EQ(live.fabric(), "");
  run(live, 2);
  EXPECT_EQ(live.failure(), "");
}

TEST(LiveScene, LeversReachTheEffectsAlsoThoseThatComeLater) {
  LiveScene live(hangingTowel());
  live.setRainFlux(0.5);
  live.setExposure(0);
  live.turnEffect(indexOf(live, "rain"), true);
  live.turnEffect(indexOf(live, "absorption"), true);
  EXPECT_EQ(live.rainFlux(), 0.5);
  run(live, 5);
  EXPECT_LT(live.waterHeld(), 1e-9);  // the towel hangs along the rain
  live.setRainDirection(btVector3(0, 0, -1));
  run(live, 5);
  EXPECT_NEAR(live.waterHeld(), 5 * live.scene().step * 0.5, 0.1 * 5 * live.scene().step * 0.5);
}

TEST(LiveScene, ASolverWaitsForTheReset) {
  using command::SolverKind;
  for (const WorldKind world : {WorldKind::softRigid, WorldKind::softMultiBody}) {
    const command::Scene onBullets = soakingTowel(world);
    command::Scene onOurs = onBullets;
    onOurs.clothSolver.emplace().smallSteps = 7;
    for (const auto& [scene, chosen] : {std::pair{onBullets, SolverKind::wetcloth}, {onOurs, SolverKind::bullet}}) {
      LiveScene live(scene);
      EXPECT_FALSE(live.waitsForReset());
      live.setSolver(chosen);
      EXPECT_EQ(live.solver(), chosen);
      EXPECT_TRUE(live.waitsForReset());
      run(live, 5);
      LiveScene same(scene);
      run(same, 5);
      EXPECT_EQ(stateHash(live.world()), stateHash(same.world())) << "not yet";
      live.reset();
      EXPECT_FALSE(live.waitsForReset());
      run(live, 20);
      command::Scene other = scene;
      other.clothSolver.reset();
      if (chosen == SolverKind::wetcloth) other.clothSolver.emplace();
      LiveScene fresh(other);
      run(fresh, 20);
      EXPECT_EQ(stateHash(live.world()), stateHash(fresh.world()));
      live.restore();
      EXPECT_EQ(live.solver(), scene.solver());
      run(live, 5);
      EXPECT_EQ(stateHash(live.world()), stateHash(same.world()));
    }
    LiveScene live(onOurs);
    live.setSolver(SolverKind::bullet);
    live.reset();
    live.setSolver(SolverKind::wetcloth);
    live.reset();
    ASSERT_NE(live.world().clothSolver(), nullptr);
    EXPECT_EQ(live.world().clothSolver()->parameters().smallSteps, 7) << "the scene's numbers stay";
  }
}

TEST(LiveScene, TheDeformableWorldHasBulletsSolverAlone) {
  LiveScene live(soakingTowel(WorldKind::deformable));
  EXPECT_THROW(live.setSolver(command::SolverKind::wetcloth), std::invalid_argument);
  EXPECT_FALSE(live.waitsForReset());
  live.setSolver(command::SolverKind::bullet);
}

TEST(LiveScene, AFabricWaitsForTheReset) {
  LiveScene live(soakingTowel());
  const double cotton = live.world().cloths()[0]->totalMass();
  live.setFabric("high_absorption");
  run(live, 1);
  EXPECT_EQ(live.world().cloths()[0]->fabric().name, live.scene().cloths[0].fabric.name);
  EXPECT_TRUE(live.waitsForReset());
  live.reset();
  EXPECT_FALSE(live.waitsForReset());
  EXPECT_NEAR(live.world().cloths()[0]->totalMass(), cotton * 0.400 / 0.150, 1e-6);
  EXPECT_EQ(live.world().cloths()[0]->fabric().dryColour, soakingTowel().cloths[0].fabric.dryColour);
}

TEST(LiveScene, TheHistoriesTellOfTheWater) {
  LiveScene live(soakingTowel());
  EXPECT_EQ(live.waterHistory().size(), 1u);
  EXPECT_EQ(live.waterHistory().latest(), 0);
  run(live, 600);
  EXPECT_EQ(live.waterHistory().size(), 480u);
  EXPECT_FLOAT_EQ(live.waterHistory().latest(), static_cast<float>(live.waterHeld()));
  EXPECT_FLOAT_EQ(live.saturationHistory().latest(), static_cast<float>(live.meanSaturation()));
  for (std::size_t age = 1; age < 480; ++age) {
    EXPECT_GE(live.waterHistory().at(age), live.waterHistory().at(age - 1));
  }
  live.reset();
  EXPECT_EQ(live.waterHistory().size(), 1u);
}

TEST_P(LiveSceneIn, PlainBulletGoesOnFromWhereTheWetClothIs) {
  LiveScene live(soakingTowel(GetParam()));
  run(live, 15);
  live.setCompared(true);
  const pictures::Frame wet = live.frame(Side::wet);
  const pictures::Frame plain = live.frame(Side::plainBullet);
  EXPECT_EQ(wet.cloths[0].positions, plain.cloths[0].positions);
  EXPECT_EQ(wet.time, plain.time);
  EXPECT_GT(wet.cloths[0].saturation[5], 0);
  EXPECT_EQ(plain.cloths[0].saturation[5], 0);
  LiveScene alone(soakingTowel(GetParam()));
  run(alone, 30);
  run(live, 15);
  EXPECT_EQ(stateHash(live.world()), stateHash(alone.world()));  // the other world is another world
  EXPECT_NE(live.frame(Side::wet).cloths[0].positions, live.frame(Side::plainBullet).cloths[0].positions);
  live.reset();
  EXPECT_TRUE(live.isCompared());
  EXPECT_EQ(live.frame(Side::wet).cloths[0].positions, live.frame(Side::plainBullet).cloths[0].positions);
}

TEST(LiveScene, AStateThatIsNotFiniteEndsTheRunAndAResetBeginsAnother) {
  LiveScene live(soakingTowel());
  run(live, 1);
  live.world().bodies()[0]->m_nodes[40].m_v = btVector3(0, btScalar(notANumber), 0);
  run(live, 3);
  EXPECT_NE(live.failure().find("non-finite"), std::string::npos);
  EXPECT_EQ(live.steps(), 2);
  live.reset();
  EXPECT_EQ(live.failure(), "");
  run(live, 3);
  EXPECT_EQ(live.steps(), 3);
}

TEST(LiveScene, AClothThatBlowsUpEndsTheRun) {
  command::Scene scene = hangingTowel(WorldKind::deformable);
  scene.cloths[0].springs.stiffness = 2000;
  LiveScene live(scene);
  run(live, 120);
  EXPECT_EQ(live.failure().rfind("the cloth blew up in step ", 0), 0u) << live.failure();
  for (const char* word : {"t = ", "/cloths/0: node ", "substeps", "spring_stiffness_n_m", "reset"}) {
    EXPECT_NE(live.failure().find(word), std::string::npos) << word << ": " << live.failure();
  }
  EXPECT_LT(live.steps(), 120);
  live.reset();
  EXPECT_EQ(live.failure(), "");
}

// Neither is in the scene: what pushes is the wind that was set, and the hand.
TEST(LiveScene, AClothThatIsBlownOrPulledHardHasNotBlownUp) {
  LiveScene live(soakingTowel());
  live.setWind(btVector3(0, 0, 1000));
  run(live, 60);
  EXPECT_EQ(live.failure(), "");
  live.restore();
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.3)));
  for (int i = 0; i < 60; ++i) {
    live.dragTo(btVector3(0, btScalar(i % 2 == 0 ? 50 : -50), 0));
    live.step();
  }
  EXPECT_EQ(live.failure(), "");
}

}  // namespace
}  // namespace wetcloth_test::live_scene_test
