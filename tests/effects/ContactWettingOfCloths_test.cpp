// SPDX-License-Identifier: Zlib
// Water between two cloths that touch: what one gives the other takes, until they are equally wet.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/RigidBody.h"

namespace wetcloth_test::contact_wetting_of_cloths_test {
namespace {

using wetcloth::ContactWetting;

/// Two sheets on a floor, one over the other, both WetCloths; the lower one is added first.
class TwoTowels {
 public:
  explicit TwoTowels(WorldKind kind)
      : scene(kind, kEarthGravity, Lying().builder(kind)), m_floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0}) {
    Lying above;
    above.height = 2.8 * kMargin;
    m_upper = above.builder(kind)(scene.bullet().info());
    m_upper->setActivationState(DISABLE_DEACTIVATION);
    scene.bullet().add(*m_upper);
    if (scene.bullet().isDeformable()) {
      scene.bullet().addForce(*m_upper, bulletSprings(5));
    }
    scene.addBulletSprings(5);
    upperCloth = &exactly(scene.wet().add(*m_upper));
  }
  ~TwoTowels() {
    if (m_upper) removeUpper();
  }
  TwoTowels(const TwoTowels&) = delete;
  TwoTowels& operator=(const TwoTowels&) = delete;

  wetcloth::WetCloth& lower() { return scene.cloth(); }
  wetcloth::WetCloth& upper() { return *upperCloth; }
  btSoftBody& upperBody() { return *m_upper; }
  /// Of the two with each other, now listed.
  int contacts() { return scene.body().m_scontacts.size() + scene.body().m_faceNodeContacts.size(); }
  double held() { return lower().ledger().held + upper().ledger().held; }
  /// Deleted without a word to the WetClothWorld.
  void removeUpper() {
    scene.bullet().remove(*m_upper);
    m_upper.reset();
  }

  ClothScene scene;
  wetcloth::WetCloth* upperCloth = nullptr;

 private:
  RigidBody m_floor;
  std::unique_ptr<btSoftBody> m_upper;
};

ContactWetting::Parameters atRate(double rate) {
  ContactWetting::Parameters parameters;
  parameters.cloths = true;
  parameters.rate = rate;
  return parameters;
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, TwoTowelsPressedTogetherBecomeEquallyWet) {
  TwoTowels towels(GetParam());
  towels.lower().add<ContactWetting>(atRate(1));
  towels.upper().setSaturation(0.6);
  const double all = towels.held();
  towels.scene.step(480);
  EXPECT_NEAR(towels.lower().meanSaturation(), 0.3, 0.01);
  EXPECT_NEAR(towels.upper().meanSaturation(), 0.3, 0.01);
  EXPECT_NEAR(towels.held(), all, 1e-14 * all);
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, WhatOneDripsTheOtherAbsorbs) {
  TwoTowels towels(GetParam());
  towels.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  towels.upper().setSaturation(0.6);
  for (int i = 0; i < 120; ++i) {
    towels.scene.step(1);
    const wetcloth::Ledger lower = towels.lower().ledger();
    const wetcloth::Ledger upper = towels.upper().ledger();
    // Sums of 1e4 portions, each rounded against some 1e-3 kg.
    ASSERT_NEAR(lower.absorbed, upper.dripped, 1e-16);
    ASSERT_NEAR(upper.absorbed, lower.dripped, 1e-16);
    ASSERT_LE(std::fabs(lower.imbalance()), 1e-17);
    ASSERT_LE(std::fabs(upper.imbalance()), 1e-17);
  }
  EXPECT_GT(towels.lower().ledger().absorbed, 0);
  EXPECT_GT(towels.upper().ledger().dripped, 0);
}

// At the rate k, two sheets that touch all over lose their difference with the time C / (2 k), C their capacity per
// area; contacts that come and go make it longer.
TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, TheRateIsPerAreaOfContactOnce) {
  TwoTowels towels(GetParam());
  towels.scene.step(120);
  const double rate = 0.05;
  towels.lower().add<ContactWetting>(atRate(rate));
  towels.upper().setSaturation(0.6);
  int touching = 0;
  for (int i = 0; i < 120; ++i) {
    const double before = towels.lower().ledger().held;
    towels.scene.step(1);
    touching += towels.lower().ledger().held > before ? 1 : 0;
  }
  ASSERT_GT(touching, 30);
  const double fastest = 0.6 * std::exp(-2 * rate * touching * kSubstep / (0.84 * 0.150));
  const double difference = towels.upper().meanSaturation() - towels.lower().meanSaturation();
  EXPECT_GT(difference, 0.99 * fastest);
  EXPECT_LT(difference, 0.6 - 0.3 * (0.6 - fastest));
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, APairWithTheEffectOnBothIsSeenToOnce) {
  TwoTowels once(GetParam());
  TwoTowels twice(GetParam());
  once.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  twice.upper().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  twice.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  for (TwoTowels* towels : {&once, &twice}) {
    towels->upper().setSaturation(0.6);
    towels->scene.step(120);
  }
  EXPECT_GT(once.lower().ledger().held, 0);
  // The deformable world's motion is not the same twice: it shuffles contacts of cloths by a random number that goes on
  // from world to world.
  const double tolerance = once.scene.bullet().isDeformable() ? 1e-4 : 0;
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(once.lower().saturation(i), twice.lower().saturation(i), tolerance);
    EXPECT_NEAR(once.upper().saturation(i), twice.upper().saturation(i), tolerance);
  }
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, EitherOfTheTwoMayHaveTheEffect) {
  TwoTowels towels(GetParam());
  towels.upper().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  towels.upper().setSaturation(0.6);
  towels.scene.step(120);
  EXPECT_GT(towels.lower().ledger().absorbed, 0);
  EXPECT_NEAR(towels.lower().ledger().absorbed, towels.upper().ledger().dripped, 1e-16);
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, DryTowelsAreAsIfItWereNotThere) {
  TwoTowels with(GetParam());
  TwoTowels without(GetParam());
  ContactWetting& wetting = with.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  with.scene.step(60);
  without.scene.step(60);
  EXPECT_EQ(wetting.nodesVisited(), 0);
  if (with.scene.bullet().isDeformable()) return;  // no two runs are alike there, see above
  EXPECT_TRUE(sameBits(stateOf(with.scene.body()), stateOf(without.scene.body())));
  EXPECT_TRUE(sameBits(stateOf(with.upperBody()), stateOf(without.upperBody())));
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, EquallyWetTowelsIdle) {
  TwoTowels towels(GetParam());
  ContactWetting& wetting = towels.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  towels.lower().setSaturation(1);
  towels.upper().setSaturation(1);
  towels.scene.step(60);
  EXPECT_EQ(wetting.nodesVisited(), 0);
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, NoStepIsTooLong) {
  TwoTowels towels(GetParam());
  towels.scene.step(120);
  towels.lower().add<ContactWetting>(atRate(10));
  std::vector<double> uneven;
  for (int i = 0; i < 16; ++i) uneven.push_back(towels.upper().capacity(i) * (i % 3) / 2);
  towels.upper().setHeld(uneven);
  const double all = towels.held();
  for (const double dt : {1e-6, 1e-3, 1.0, 1e3}) {
    towels.scene.preTick(dt);
    for (wetcloth::WetCloth* cloth : {&towels.lower(), &towels.upper()}) {
      for (int i = 0; i < 16; ++i) {
        EXPECT_GE(cloth->held(i), 0);
        EXPECT_LE(cloth->saturation(i), 1);
      }
    }
    EXPECT_NEAR(towels.held(), all, 1e-14 * all);
  }
}

// What leaves one cloth takes its nodes' velocity along, what arrives brings it.
TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, MomentumIsKept) {
  TwoTowels towels(GetParam());
  towels.scene.step(120);
  for (int i = 0; i < 100 && towels.contacts() < 16; ++i) towels.scene.step(1);
  ASSERT_GE(towels.contacts(), 16);
  towels.upper().add<ContactWetting>(atRate(5));
  towels.upper().setSaturation(0.6);
  setVelocity(towels.upperBody(), {btScalar(0.5), 0, 0});
  const auto total = [&] { return momentum(towels.scene.body())[0] + momentum(towels.upperBody())[0]; };
  const double before = total();
  const double lowerBefore = momentum(towels.scene.body())[0];
  towels.scene.preTick(kSubstep);
  EXPECT_GT(momentum(towels.scene.body())[0] - lowerBefore, 1e-4 * before);
  EXPECT_NEAR(total(), before, (kIsDouble ? 1e-12 : 1e-5) * before);
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, ATowelThatIsDeletedIsNotLookedAt) {
  TwoTowels towels(GetParam());
  towels.scene.wet().setLog({});
  towels.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  towels.upper().setSaturation(0.6);
  towels.scene.step(60);
  const double held = towels.lower().ledger().held;
  ASSERT_GT(held, 0);
  towels.removeUpper();
  towels.scene.step(1);
  EXPECT_EQ(towels.lower().ledger().held, held);
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfCloths, GoesOnAfterACut) {
  TwoTowels towels(GetParam());
  towels.scene.wet().setLog({});
  towels.lower().add<ContactWetting>(atRate(ContactWetting::Parameters().rate));
  towels.upper().setSaturation(0.6);
  towels.scene.step(60);
  const double all = towels.held();
  for (btSoftBody* body : {&towels.upperBody(), &towels.scene.body()}) {
    ASSERT_TRUE(body->cutLink(body->m_faces[0].m_n[0], body->m_faces[0].m_n[1], btScalar(0.5)));
    towels.scene.step(30);
  }
  EXPECT_NEAR(towels.held(), all, 1e-13 * all);
}

}  // namespace
}  // namespace wetcloth_test::contact_wetting_of_cloths_test
