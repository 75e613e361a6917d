// SPDX-License-Identifier: Zlib
// What an application may leave out: RTTI, and the library's headers where names will do. And what it may ask: which
// version it has.

#include "bullet_wetcloth/Version.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/fwd.h"
#include "tests/consumer/WithoutRtti.h"
#include "tests/support/BodyScene.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace wetcloth_test::consumer_test {

namespace {

TEST(Consumer, FindsEffectsWithoutRtti) {
  BodyScene scene(WorldKind::softRigid);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.setPace(wetcloth::WaterPace::exact());
  EXPECT_EQ(consumer::stepsOfSponge(cloth), -1);
  consumer::addSponge(cloth);
  scene.bullet().step(3);
  EXPECT_EQ(consumer::stepsOfSponge(cloth), 3);
}

TEST(Consumer, AndThisPartOfTheProgramTellTheSameEffectsApart) {
  BodyScene scene(WorldKind::softRigid);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  consumer::addRain(cloth);
  EXPECT_NE(cloth.find<wetcloth::Rain>(), nullptr);
  const consumer::Towel towel(cloth);
  EXPECT_EQ(towel.wind(), nullptr);
  wetcloth::Wind::Parameters parameters;
  parameters.velocity = btVector3(1, 0, 0);
  const wetcloth::Wind& wind = cloth.add<wetcloth::Wind>(parameters);
  EXPECT_EQ(towel.wind(), &wind);
  EXPECT_TRUE(towel.runsAt(wetcloth::Stage::forces));
  EXPECT_FALSE(towel.runsAt(wetcloth::Stage::contact));
}

template <class... Classes>
constexpr bool areDefined() {
  return ((sizeof(Classes) > 0) && ...);
}

// A name that only fwd.h knows would be an incomplete class here.
TEST(Forward, NamesClassesThatThereAre) {
  using namespace wetcloth;
  static_assert(areDefined<WetClothWorld, WetCloth, Effect, Fabric, Step, Hook, Stage>());
  static_assert(areDefined<Absorption, Cling, CollisionAudit, ContactWetting, Diffusion, Dripping, Drying>());
  static_assert(areDefined<HookeSprings, Immersion, Rain, Seepage, Splash, Swelling, WaterDrag, WetFriction>());
  static_assert(areDefined<WetStiffness, Wind, Exposure, WindField, WaterSurface, AuditTotals, Drip, Passage>());
  static_assert(areDefined<Water, NodeMasses, LinkConstants, Ledger, RestMesh, ClothPatch>());
  static_assert(areDefined<Colour, VertexAttribute, VertexBuffer, StateArchive, StateError>());
}

TEST(Version, OfHeadersAndLibraryIsOne) {
  const std::string parts = std::to_string(WETCLOTH_VERSION_MAJOR) + "." + std::to_string(WETCLOTH_VERSION_MINOR) +
                            "." + std::to_string(WETCLOTH_VERSION_PATCH);
  EXPECT_EQ(parts, WETCLOTH_VERSION_STRING);
  EXPECT_STREQ(wetcloth::libraryVersion(), WETCLOTH_VERSION_STRING);
}

}  // namespace
}  // namespace wetcloth_test::consumer_test
