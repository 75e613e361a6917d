// SPDX-License-Identifier: Zlib
#include "tests/command/MadeUpEffect.h"
#include "tests/command/viewer/ViewerScene.h"

#include "command/run/StateHash.h"
#include "command/scene/SceneReader.h"

#include <cmath>
#include <set>
#include <string>

namespace wetcloth_test::effect_switches_test {
namespace {

using namespace viewer_scene;
using viewer::LiveScene;

using EffectSwitchesIn = InEachWorld;
INSTANTIATE_TEST_SUITE_P(EachWorld, EffectSwitchesIn, allWorlds, worldName);

void expectLedgerClosed(const LiveScene& live) {
  for (const wetcloth::WetCloth* cloth : live.world().cloths()) {
    const wetcloth::Ledger ledger = cloth->ledger();
    const double turnover = std::fabs(ledger.initial) + ledger.absorbed + ledger.dripped + ledger.evaporated;
    EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * turnover);
  }
}

std::size_t effectCount(const LiveScene& live) { return live.world().cloths()[0]->effects().size(); }

TEST_P(EffectSwitchesIn, EveryEffectGoesOnAndOffInTheMiddleOfARun) {
  command::Scene scene = soakingTowel(GetParam());
  scene.colliders = {command::Plane{btVector3(0, 1, 0), 0}};
  scene.water = command::WaterScene{1.3, 1000};
  LiveScene live(scene);
  const std::size_t usual = effectCount(live);
  std::set<std::string> taken;
  for (std::size_t i = 0; i < live.effects().list().size(); ++i) {
    const auto& effect = live.effects().list()[i];
    const bool wasOn = effect.isOn;
    live.turnEffect(i, !wasOn);
    run(live, 4);
    if (effect.isOn != wasOn) taken.insert(effect.key);
    EXPECT_EQ(effect.isOn == wasOn, !effect.refusal.empty()) << effect.key;
    live.turnEffect(i, wasOn);
    run(live, 2);
    EXPECT_EQ(effect.isOn, wasOn) << effect.key;
    expectLedgerClosed(live);
  }
  EXPECT_EQ(effectCount(live), usual);
  EXPECT_EQ(live.failure(), "");
  for (const char* key : {"absorption", "immersion", "rain", "diffusion", "seepage", "dripping", "drying", "swelling",
                          "wind", "water_drag", "hooke_springs"}) {
    EXPECT_TRUE(taken.count(key)) << key << ": " << switchOf(live, key).refusal;
  }
}

TEST_P(EffectSwitchesIn, AllThatIsTakenRunsTogetherAndAgainAfterAReset) {
  LiveScene live(soakingTowel(GetParam()));
  for (std::size_t i = 0; i < live.effects().list().size(); ++i) live.turnEffect(i, true);
  run(live, 20);
  expectLedgerClosed(live);
  live.reset();
  run(live, 20);
  expectLedgerClosed(live);
  EXPECT_EQ(live.failure(), "");
  EXPECT_EQ(live.notice(), "");
}

TEST(EffectSwitches, TheLibraryTellsWhyItRefuses) {
  LiveScene live(hangingTowel());  // no water
  const std::size_t immersion = indexOf(live, "immersion");
  const std::size_t before = effectCount(live);
  live.turnEffect(immersion, true);
  EXPECT_FALSE(live.effects().list()[immersion].isOn);
  EXPECT_NE(live.effects().list()[immersion].refusal.find("Immersion"), std::string::npos);
  EXPECT_EQ(effectCount(live), before);
  live.turnEffect(immersion, false);
  EXPECT_EQ(live.effects().list()[immersion].refusal, "");
}

TEST(EffectSwitches, OffAndOnAgainBeforeTheStartChangesNothing) {
  LiveScene live(soakingTowel());
  live.turnEffect(indexOf(live, "wind"), false);
  live.turnEffect(indexOf(live, "wind"), true);
  run(live, 10);
  LiveScene fresh(soakingTowel());
  run(fresh, 10);
  EXPECT_EQ(command::stateHash(live.world()), command::stateHash(fresh.world()));
}

TEST(EffectSwitches, AnEffectOfTheSceneStaysWithItsCloth) {
  command::Scene scene = soakingTowel();
  scene.cloths.push_back(hangingTowel().cloths[0]);
  LiveScene live(scene);
  live.turnEffect(indexOf(live, "absorption"), false);
  live.turnEffect(indexOf(live, "absorption"), true);
  live.turnEffect(indexOf(live, "drying"), true);
  run(live, 5);
  EXPECT_GT(live.world().cloths()[0]->meanSaturation(), 0);
  EXPECT_EQ(live.world().cloths()[1]->meanSaturation(), 0);
  EXPECT_EQ(live.world().cloths()[0]->effects().size(), 3u + 3 * 2u);
  EXPECT_EQ(live.world().cloths()[1]->effects().size(), 3u + 1 * 2u);
}

TEST(EffectSwitches, EachEffectThatIsOnTakesTimeAndTheyAreNoLongerThanTheStep) {
  LiveScene live(soakingTowel());
  live.turnEffect(indexOf(live, "wet_friction"), true);  // at a stage of its own, after Bullet's collision detection
  run(live, 20);
  for (std::size_t i = 0; i < live.effects().list().size(); ++i) {
    const auto& effect = live.effects().list()[i];
    EXPECT_EQ(live.effects().microseconds(i) > 0, effect.isOn) << effect.key;
  }
  EXPECT_GT(live.bulletMicroseconds(), 0);
  EXPECT_NEAR(live.libraryMicroseconds() + live.bulletMicroseconds(), live.effects().clock().stepMicroseconds(),
              1e-6 * live.effects().clock().stepMicroseconds());
}

TEST(EffectSwitches, InTheDeformableWorldSpringsOfOursWaitForAReset) {
  LiveScene live(hangingTowel(command::WorldKind::deformable));
  const std::size_t hooke = indexOf(live, "hooke_springs");
  live.turnEffect(hooke, true);
  EXPECT_TRUE(live.effects().list()[hooke].waitsForReset);
  EXPECT_TRUE(live.waitsForReset());
  live.reset();
  EXPECT_FALSE(live.waitsForReset());
  run(live, 5);
  EXPECT_GT(live.effects().microseconds(hooke), 0);
}

TEST(EffectSwitches, ScenesOfTheExamplesBeginWithTheirOwnEffects) {
  const command::Scene scene = command::readScene(WETCLOTH_SOURCE_DIR "/tests/scenes/water_cycle.json");
  LiveScene live(scene);
  for (const auto& effect : live.effects().list()) {
    EXPECT_EQ(effect.isOn, effect.isInScene) << effect.key;
    EXPECT_EQ(effect.isInScene, scene.cloths[0].hasEffect(effect.key)) << effect.key;
  }
  run(live, 3);
  EXPECT_EQ(live.failure(), "");
}

TEST(EffectSwitches, AnEffectThatIsInTheCatalogueAloneIsOffered) {
  command::Scene scene = hangingTowel();
  LiveScene live(scene, command::catalogueWithDew());
  const std::size_t dew = indexOf(live, "dew");
  EXPECT_FALSE(live.effects().list()[dew].isOn);
  live.turnEffect(dew, true);
  run(live, 2);
  EXPECT_GT(live.waterHeld(), 0);
  live.turnEffect(dew, false);
  const double held = live.waterHeld();
  run(live, 2);
  EXPECT_EQ(live.waterHeld(), held);
}

}  // namespace
}  // namespace wetcloth_test::effect_switches_test
