// SPDX-License-Identifier: Zlib
// Splash in each of Bullet's worlds, and what it refuses.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/effects/Splash.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <limits>
#include <string>

namespace wetcloth_test::splash_in_world_test {

namespace {

using wetcloth::Splash;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal(const Splash::Parameters& parameters) {
  try {
    Splash effect(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

template <class Shape>
std::string refusalOf(const Shape& shape) {
  Splash::Parameters parameters;
  parameters.region = shape;
  return refusal(parameters);
}

bool names(const std::string& message, const char* field) { return message.find(field) != std::string::npos; }

TEST(SplashBadInput, NamesTheField) {
  for (const double bad : {-1.0, 0.0, kNaN, kInfinity}) {
    EXPECT_TRUE(names(refusalOf(Splash::Sphere{btVector3(0, 0, 0), bad}), "Splash.region.radius = ")) << bad;
    EXPECT_TRUE(names(refusalOf(Splash::Cone{btVector3(0, 0, 0), bad, 1}), "Splash.region.halfAngle = ")) << bad;
    EXPECT_TRUE(names(refusalOf(Splash::Cone{btVector3(0, 0, 0), 0.1, bad}), "Splash.region.reach = ")) << bad;
  }
  EXPECT_TRUE(names(refusalOf(Splash::Cone{btVector3(0, 0, 0), 1.571, 1}), "in (0, pi/2)"));
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    const btVector3 vector(0, btScalar(bad), 0);
    EXPECT_TRUE(names(refusalOf(Splash::Sphere{vector, 1}), "Splash.region.centre.y"));
    EXPECT_TRUE(names(refusalOf(Splash::Cone{vector, 0.1, 1}), "Splash.region.apex.y"));
    Splash::Parameters parameters;
    parameters.velocity = vector;
    EXPECT_TRUE(names(refusal(parameters), "Splash.velocity.y"));
  }
  Splash::Parameters still;
  still.velocity = btVector3(0, 0, 0);
  EXPECT_TRUE(names(refusal(still), "Splash.velocity"));
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    Splash::Parameters parameters;
    parameters.flux = bad;
    EXPECT_TRUE(names(refusal(parameters), "Splash.flux = "));
  }
  EXPECT_EQ(refusal(Splash::Parameters()), "");
}

TEST(SplashBadInput, ASetterThatThrowsChangesNothing) {
  Splash effect{Splash::Parameters()};
  EXPECT_THROW(adjust(effect,
                      [](auto& p) {
                        p.region = Splash::Sphere{btVector3(0, 0, 0), -1};
                      }),
               std::invalid_argument);
  EXPECT_THROW(adjust(effect,
                      [](auto& p) {
                        p.region = Splash::Cone{btVector3(0, 0, 0), 2, 1};
                      }),
               std::invalid_argument);
  EXPECT_THROW(adjust(effect, [](auto& p) { p.velocity = btVector3(0, 0, 0); }), std::invalid_argument);
  EXPECT_THROW(adjust(effect, [](auto& p) { p.flux = -1; }), std::invalid_argument);
  EXPECT_EQ(std::get<Splash::Sphere>(effect.parameters().region).radius, 0.1);
  EXPECT_EQ(effect.parameters().velocity.y(), -5);
  EXPECT_EQ(effect.parameters().flux, 1);
}

class SplashInWorld {
 protected:
  static Splash::Parameters onEverything(double flux) {
    Splash::Parameters parameters;
    parameters.region = Splash::Sphere{btVector3(0, 0, 0), 100};
    parameters.flux = flux;
    return parameters;
  }
};

TEST_F_IN_EVERY_WORLD(SplashInWorld, ARopeCatchesNone) {
  BodyScene scene(GetParam(), [](btSoftBodyWorldInfo& info) {
    return std::unique_ptr<btSoftBody>(
        btSoftBodyHelpers::CreateRope(info, btVector3(0, 0, 0), btVector3(1, 0, 0), 3, 0));
  });
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  try {
    cloth.add<Splash>();
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(names(error.what(), "Splash: body.m_faces.size() = 0")) << error.what();
  }
  EXPECT_TRUE(cloth.effects().empty());
}

TEST_F_IN_EVERY_WORLD(SplashInWorld, PushesAFreeClothByItsMomentum) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  scene.body().setActivationState(DISABLE_DEACTIVATION);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(0.1, 1)));
  cloth.add<Splash>(onEverything(0.02));
  const double dry = cloth.totalMass();
  scene.bullet().step(128, btScalar(1) / 256);
  // 0.01 kg in half a second, of which 0.015 kg would go in: see RainInWorld for the tolerances.
  const double absorbed = cloth.ledger().absorbed;
  EXPECT_NEAR(absorbed, 0.02 * 0.5, 1e-7);
  EXPECT_NEAR(double(meanVelocity(scene.body()).y()), -5 * absorbed / (dry + absorbed), kIsDouble ? 1e-7 : 1e-3);
}

TEST_F_IN_EVERY_WORLD(SplashInWorld, WetsPinnedNodesGoesOnWhenTheBodyIsCutAndClosesTheLedger) {
  BodyScene scene(GetParam(), hangingPatch(5));
  scene.addBulletSprings(20, 0.1, SpringDamping::everyDirection);
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog([](const std::string&) {});
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Splash::Parameters parameters;
  parameters.region = Splash::Cone{btVector3(btScalar(0.5), btScalar(0.5), 3), 0.3, 5};
  parameters.velocity = btVector3(0, 0, -3);
  parameters.flux = 0.05;
  Splash& splash = cloth.add<Splash>(parameters);
  scene.bullet().step(20);
  ASSERT_TRUE(scene.body().cutLink(scene.body().m_faces[0].m_n[0], scene.body().m_faces[0].m_n[1], btScalar(0.5)));
  scene.bullet().step(20);
  EXPECT_EQ(cloth.nodeCount(), 27);
  EXPECT_GT(splash.caught(), 0);
  EXPECT_TRUE(isFinite(scene.body()));
  for (int i = 20; i < 25; ++i) {
    EXPECT_GT(cloth.held(i), 0) << i;
    EXPECT_EQ(scene.body().m_nodes[i].m_im, 0);
    EXPECT_EQ(scene.body().m_nodes[i].m_x.y(), 1);
  }
  EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * cloth.ledger().held);
}

TEST_F_IN_EVERY_WORLD(SplashInWorld, KeepsABodyAwakeThatItsDropsWouldCarryOff) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.setSaturation(1);
  Splash& splash = cloth.add<Splash>(onEverything(0.01));
  scene.body().setActivationState(ISLAND_SLEEPING);
  scene.bullet().step(1);
  EXPECT_TRUE(scene.body().isActive());
  adjust(splash, [](auto& p) { p.region = Splash::Sphere{btVector3(50, 0, 0), 1}; });
  scene.body().setActivationState(ISLAND_SLEEPING);
  wet.preTick(btScalar(0.01));
  EXPECT_FALSE(scene.body().isActive());
}

TEST_F_IN_EVERY_WORLD(SplashInWorld, WritesNoNumberThatIsNone) {
  for (const bool isCone : {false, true}) {
    for (const double dt : {1e-6, 1e3}) {
      BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
      wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
      wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
      Splash::Parameters parameters = onEverything(10);
      if (isCone) parameters.region = Splash::Cone{btVector3(btScalar(0.5), 2, btScalar(0.5)), 0.8, 10};
      cloth.add<Splash>(parameters);
      scene.body().m_nodes[5].m_x.setX(std::numeric_limits<btScalar>::quiet_NaN());
      scene.body().m_nodes[0].m_x.setX(std::numeric_limits<btScalar>::infinity());
      for (int i = 0; i < 3; ++i) wet.preTick(btScalar(dt));
      for (int i = 0; i < 16; ++i) {
        EXPECT_TRUE(std::isfinite(cloth.held(i)) && cloth.held(i) >= 0) << i;
        EXPECT_LE(cloth.saturation(i), 1 + 1e-15) << i;
        EXPECT_TRUE(std::isfinite(scene.body().m_nodes[i].m_v.length())) << i;
      }
      EXPECT_GT(cloth.held(15), 0) << "the others go on";
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::splash_in_world_test
