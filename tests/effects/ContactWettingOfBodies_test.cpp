// SPDX-License-Identifier: Zlib
// Water taken from a wet body does not depend on how that body is built.

#include "tests/support/Bodies.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

namespace wetcloth_test::contact_wetting_of_bodies_test {
namespace {

using wetcloth::ContactWetting;
using Flags = btSoftBody::fCollision;

constexpr double kRate = 0.0142;
constexpr double kSeconds = 3;

/// Mean saturation of a cloth of which every node touches all the time: 1 - exp(-rate t / capacity per area).
double most() { return 1 - std::exp(-kRate * kSeconds / (0.84 * 0.150)); }

ContactWetting& wet(OnBody& cloth) {
  ContactWetting::Parameters parameters;
  parameters.wetBodies = {{&cloth.body.body()}};
  parameters.rate = kRate;
  return cloth.scene.cloth().add<ContactWetting>(parameters);
}

double saturationAfter(OnBody& cloth) {
  cloth.scene.step(int(kSeconds / kSubstep));
  return cloth.scene.cloth().meanSaturation();
}

TEST_IN_EVERY_WORLD(ContactWettingOfBodies, OverlappingPartsCountOnce) {
  for (const int count : {1, 2, 4, 8}) {
    OnBody cloth(GetParam(), overlappingBoxes(count));
    wet(cloth);
    const double saturation = saturationAfter(cloth);
    EXPECT_LE(saturation, most()) << count;
    EXPECT_GT(saturation, 0.9 * most()) << count;
  }
}

TEST_IN_EVERY_WORLD(ContactWettingOfBodies, NoShapeGivesMoreThanItsArea) {
  for (const BodyShape shape : kBodyShapes) {
    OnBody cloth(GetParam(), shape);
    wet(cloth);
    EXPECT_LE(saturationAfter(cloth), most()) << nameOf(shape);
  }
}

// The middle of the cloth lies on a corner of six triangles.
TEST_IN_EVERY_WORLD(ContactWettingOfBodies, TrianglesNearANodeShareIt) {
  for (const int cells : {2, 4, 20}) {
    for (const double voxel : {0.25, 0.02}) {
      OnBody cloth(GetParam(), meshSquare(cells));
      cloth.scene.bullet().info().m_sparsesdf.setDefaultVoxelsz(btScalar(voxel));
      cloth.scene.bullet().info().m_sparsesdf.Reset();
      wet(cloth);
      EXPECT_LE(saturationAfter(cloth), most()) << cells << ' ' << voxel;
    }
  }
}

TEST_IN_EVERY_WORLD(ContactWettingOfBodies, SeveralBodiesAtANodeShareIt) {
  OnBody cloth(GetParam(), BodyShape::box);
  Body second(cloth.scene.bullet(), BodyShape::box);
  wet(cloth).setFilm(second.body(), HUGE_VAL);
  EXPECT_LE(saturationAfter(cloth), most());
  EXPECT_GT(cloth.scene.cloth().meanSaturation(), 0.9 * most());
}

TEST_IN_EVERY_WORLD(ContactWettingOfBodies, ADryBodyTakesNoShare) {
  OnBody cloth(GetParam(), BodyShape::box);
  Body second(cloth.scene.bullet(), BodyShape::box);
  wet(cloth).setFilm(second.body(), 0);
  EXPECT_GT(saturationAfter(cloth), 0.9 * most());
}

// A body whose triangles collide, not its nodes.
TEST(ContactWettingOfBodiesByTriangles, OverlappingPartsCountOnce) {
  const auto saturation = [](int count) {
    ClothScene scene(WorldKind::deformable, kEarthGravity, [](btSoftBodyWorldInfo& info) {
      auto body = Lying().builder(WorldKind::deformable)(info);
      body->m_cfg.collisions = Flags::SDF_RD | Flags::SDF_RDF;
      return body;
    });
    scene.addBulletSpringsForStep();
    Body body(scene.bullet(), overlappingBoxes(count));
    ContactWetting::Parameters parameters;
    parameters.wetBodies = {{&body.body()}};
    parameters.rate = kRate;
    scene.cloth().add<ContactWetting>(parameters);
    scene.step(int(kSeconds / kSubstep));
    return scene.cloth().meanSaturation();
  };
  const double one = saturation(1);
  EXPECT_LE(one, most());
  EXPECT_NEAR(saturation(8), one, 0.1 * one);
}

}  // namespace
}  // namespace wetcloth_test::contact_wetting_of_bodies_test
