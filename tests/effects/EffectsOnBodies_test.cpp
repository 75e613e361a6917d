// SPDX-License-Identifier: Zlib
// Every effect that touches bodies, on every kind of body, through all that may happen to it; and the table of
// docs/bodies.md.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/Bodies.h"
#include "tests/support/BodyState.h"
#include "tests/support/CallEffect.h"
#include "tests/support/DocumentedTable.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"

#include <sstream>

namespace wetcloth_test::effects_on_bodies_test {
namespace {

constexpr double kRate = 0.0142;
constexpr double kGravity = 9.81;
constexpr double kArealCapacity = 0.84 * 0.150;
/// Weight of a cloth of saturation 0.5 per area [Pa].
constexpr double kWeight = (0.150 + 0.5 * kArealCapacity) * kGravity;
constexpr WorldKind kWorlds[] = {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                 WorldKind::deformableImplicit};

wetcloth::ContactWetting::Parameters wetBody(const btCollisionObject& body) {
  wetcloth::ContactWetting::Parameters parameters;
  parameters.wetBodies = {{&body}};
  parameters.rate = kRate;
  return parameters;
}

/// What no kind of body may change: 1 - s falls no faster than by rate / capacity.
double most(double before, double seconds) { return 1 - (1 - before) * std::exp(-kRate * seconds / kArealCapacity); }

TEST_IN_EVERY_WORLD(EffectsOnBodies, AllOfThemThroughAllThatMayHappen) {
  for (const BodyShape shape : kBodyShapes) {
    for (const BodyMotion motion : kBodyMotions) {
      for (const BodyEvent event : kBodyEvents) {
        if (!canBe(shape, motion)) continue;
        SCOPED_TRACE(std::string(nameOf(shape)) + ", " + nameOf(motion) + ", " + nameOf(event));
        OnBody cloth(GetParam(), shape, motion);
        wetcloth::WetCloth& wet = cloth.scene.cloth();
        wet.setSaturation(0.2);
        wet.add<wetcloth::ContactWetting>(wetBody(cloth.body.body()));
        wet.add<wetcloth::Cling>();
        wet.add<wetcloth::WetFriction>();
        wetcloth::CollisionAudit& audit = wet.add<wetcloth::CollisionAudit>();
        cloth.scene.step(45);
        cloth.body.undergo(event);
        cloth.scene.step(45);
        audit.look();
        ASSERT_TRUE(isFinite(cloth.scene.body()));
        EXPECT_LE(wet.meanSaturation(), most(0.2, 90 * kSubstep) + 1e-9);
        EXPECT_LE(std::fabs(wet.ledger().imbalance()), 1e-12 * wet.ledger().held);
        EXPECT_EQ(audit.totals().incompleteSubsteps, 0);
      }
    }
  }
}

// On a body of many parts Bullet applies friction part by part. WetFriction changes the coefficient and nothing else.
TEST_IN_EVERY_WORLD(EffectsOnBodies, WetFrictionIsThatOfABodyWithTheProduct) {
  const auto slidden = [](double coefficient, double wetFactor) {
    OnBody cloth(GetParam(), overlappingBoxes(4));
    cloth.body.body().setFriction(1);
    cloth.scene.body().m_cfg.kDF = btScalar(coefficient);
    cloth.scene.cloth().setSaturation(0.5);
    cloth.scene.cloth().add<wetcloth::WetFriction>({wetFactor, 0.5, wetFactor});
    cloth.scene.step(60);
    setVelocity(cloth.scene.body(), btVector3(btScalar(0.5), 0, 0));
    cloth.scene.step(60);
    return centreOfMass(cloth.scene.body())[0];
  };
  EXPECT_NEAR(slidden(0.1, 2), slidden(0.2, 1), 1e-4);
  EXPECT_LT(slidden(0.2, 1), slidden(0.1, 1));
}

// --- docs/bodies.md -------------------------------------------------------------------------------------------------

const char* amount(double share) { return share > 0.9 ? "all" : share > 0.02 ? "part" : "none"; }

std::string lies(WorldKind world, BodyShape shape) {
  OnBody cloth(world, shape);
  cloth.scene.step(240);
  const double height = centreOfMass(cloth.scene.body())[1];
  return height > -0.06 ? "lies" : height > -0.6 ? "sinks" : "falls";
}

std::string water(WorldKind world, BodyShape shape) {
  OnBody cloth(world, shape);
  cloth.scene.cloth().add<wetcloth::ContactWetting>(wetBody(cloth.body.body()));
  cloth.scene.step(240);
  return amount(cloth.scene.cloth().meanSaturation() / most(0, 1));
}

/// Pressed to the body by its weight, then pulled off by as much.
std::string clings(WorldKind world, BodyShape shape) {
  OnBody cloth(world, shape);
  bool lifts = false;
  addCall(cloth.scene.cloth(), [&](wetcloth::WetCloth& wet, const wetcloth::Step& step) {
    const btVector3 change(0, btScalar(2 * kGravity * step.dt), 0);
    for (int i = 0; lifts && i < wet.body().m_nodes.size(); ++i) wet.push(wet.body().m_nodes[i], change);
  });
  cloth.scene.cloth().setSaturation(0.5);
  wetcloth::Cling::Parameters parameters;
  parameters.adhesion = 10 * kWeight;
  const wetcloth::Cling& cling = cloth.scene.cloth().add<wetcloth::Cling>(parameters);
  cloth.scene.step(120);
  lifts = true;
  cloth.scene.step(120);
  return amount(cling.bonds() / 16.0);
}

std::string tableOfBodies() {
  std::ostringstream table;
  table << "| body |";
  for (const WorldKind world : kWorlds) table << ' ' << nameOf(world) << " |";
  table << "\n|---|---|---|---|---|\n";
  for (const BodyShape shape : kBodyShapes) {
    table << "| " << nameOf(shape) << " |";
    for (const WorldKind world : kWorlds) {
      table << ' ' << lies(world, shape) << ", " << water(world, shape) << ", " << clings(world, shape) << " |";
    }
    table << '\n';
  }
  return table.str();
}

TEST(TableOfBodies, IsThatOfTheDocumentation) { expectDocumented("bodies.md", "bodies", tableOfBodies()); }

}  // namespace
}  // namespace wetcloth_test::effects_on_bodies_test
