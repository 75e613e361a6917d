// SPDX-License-Identifier: Zlib
// WetCloth::find() and forEach(): by the class that an effect was added as, the library's and an application's own.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace wetcloth_test::effect_find_test {

namespace {

using wetcloth::Absorption;
using wetcloth::Effect;
using wetcloth::WetCloth;
using wetcloth::Wind;

/// An application's own, with parameters.
class Sponge : public Effect {
 public:
  struct Parameters {
    double rate = 0.5;
  };
  explicit Sponge(Parameters parameters) : m_rate(parameters.rate) {}
  const char* name() const override { return "Sponge"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(WetCloth&, const wetcloth::Step&) override {}
  double rate() const { return m_rate; }

 private:
  double m_rate;
};

/// Another one of the same name and stage, without parameters.
class OtherSponge : public Effect {
 public:
  const char* name() const override { return "Sponge"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(WetCloth&, const wetcloth::Step&) override {}
};

class FinerSponge : public Sponge {
 public:
  using Sponge::Sponge;
};

class EffectFind : public testing::Test {
 protected:
  EffectFind() : scene(WorldKind::softRigid), wet(scene.world()), cloth(wet.add(scene.body())) {}
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  WetCloth& cloth;
};

TEST_F(EffectFind, GivesNullWhereThereIsNone) {
  EXPECT_EQ(cloth.find<Wind>(), nullptr);
  cloth.add<Absorption>();
  EXPECT_EQ(cloth.find<Wind>(), nullptr);
  EXPECT_EQ(std::as_const(cloth).find<Sponge>(), nullptr);
}

TEST_F(EffectFind, GivesTheLibrarysOwn) {
  const Absorption& absorption = cloth.add<Absorption>();
  const Wind& wind = cloth.add<Wind>({btVector3(1, 0, 0)});
  EXPECT_EQ(cloth.find<Absorption>(), &absorption);
  EXPECT_EQ(cloth.find<Wind>(), &wind);
  EXPECT_EQ(std::as_const(cloth).find<Wind>(), &wind);
}

TEST_F(EffectFind, GivesAnApplicationsOwn) {
  const Sponge& sponge = cloth.add<Sponge>({0.25});
  const OtherSponge& other = cloth.add(std::make_unique<OtherSponge>());
  ASSERT_EQ(cloth.find<Sponge>(), &sponge);
  EXPECT_EQ(cloth.find<Sponge>()->rate(), 0.25);
  EXPECT_EQ(cloth.find<OtherSponge>(), &other) << "the same name and stage, another class";
}

TEST_F(EffectFind, GivesTheFirstOfSeveralAndForEachAllOfThem) {
  std::vector<const Wind*> winds;
  for (const double speed : {1.0, 2.0, 3.0}) winds.push_back(&cloth.add<Wind>({btVector3(btScalar(speed), 0, 0)}));
  cloth.add<Absorption>();
  EXPECT_EQ(cloth.find<Wind>(), winds[0]);
  std::vector<const Wind*> seen;
  cloth.forEach<Wind>([&](Wind& wind) { seen.push_back(&wind); });
  EXPECT_EQ(seen, winds);
  seen.clear();
  std::as_const(cloth).forEach<Wind>([&](const Wind& wind) { seen.push_back(&wind); });
  EXPECT_EQ(seen, winds);
}

TEST_F(EffectFind, FollowsWhatIsRemoved) {
  Wind& first = cloth.add<Wind>({btVector3(1, 0, 0)});
  const Wind& second = cloth.add<Wind>({btVector3(2, 0, 0)});
  cloth.remove(first);
  EXPECT_EQ(cloth.find<Wind>(), &second);
  cloth.remove(*cloth.find<Wind>());
  EXPECT_EQ(cloth.find<Wind>(), nullptr);
}

TEST_F(EffectFind, GoesByTheClassThatAnEffectWasAddedAs) {
  cloth.add<FinerSponge>({0.1});
  EXPECT_EQ(cloth.find<Sponge>(), nullptr);
  const Sponge& asSponge = cloth.add(std::unique_ptr<Sponge>(std::make_unique<FinerSponge>(Sponge::Parameters{0.2})));
  EXPECT_EQ(cloth.find<Sponge>(), &asSponge);
  cloth.remove(*cloth.find<Sponge>());
  const Effect& unknown = cloth.add(std::unique_ptr<Effect>(std::make_unique<Sponge>(Sponge::Parameters())));
  EXPECT_EQ(&cloth.effects().back(), &unknown);
  EXPECT_EQ(cloth.find<Sponge>(), nullptr);
  EXPECT_EQ(cloth.find<Effect>(), nullptr);
}

TEST_F(EffectFind, AConstClothAndWorldGiveConstOnly) {
  const WetCloth& constCloth = cloth;
  const wetcloth::WetClothWorld& constWet = wet;
  static_assert(std::is_same_v<decltype(constCloth.find<Wind>()), const Wind*>);
  static_assert(std::is_same_v<decltype(cloth.find<Wind>()), Wind*>);
  static_assert(std::is_same_v<decltype(constWet.find(scene.body())), const WetCloth*>);
  static_assert(std::is_same_v<decltype(wet.find(scene.body())), WetCloth*>);
  static_assert(std::is_same_v<decltype(*constCloth.effects().begin()), const Effect&>);
  static_assert(std::is_same_v<decltype(*cloth.effects().begin()), Effect&>);
  static_assert(std::is_same_v<decltype(constCloth.effects()[0]), const Effect&>);
  static_assert(std::is_same_v<decltype(constWet.cloths()[0]), const WetCloth&>);
  static_assert(std::is_same_v<decltype(wet.cloths()[0]), WetCloth&>);
  EXPECT_EQ(constWet.find(scene.body()), &cloth);
}

TEST_F(EffectFind, RangesAreThoseOfAStandardContainer) {
  const Wind& wind = cloth.add<Wind>({btVector3(1, 0, 0)});
  const Absorption& absorption = cloth.add<Absorption>();
  const auto effects = std::as_const(cloth).effects();
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_FALSE(effects.empty());
  EXPECT_EQ(&effects.front(), &absorption) << "sources come before forces";
  EXPECT_EQ(&effects.back(), &wind);
  EXPECT_EQ(std::distance(effects.begin(), effects.end()), 2);
  EXPECT_TRUE(std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) { return &effect == &wind; }));
  std::vector<const WetCloth*> cloths;
  for (WetCloth& each : wet.cloths()) cloths.push_back(&each);
  EXPECT_EQ(cloths, std::vector<const WetCloth*>{&cloth});
}

}  // namespace
}  // namespace wetcloth_test::effect_find_test
