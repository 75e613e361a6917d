// SPDX-License-Identifier: Zlib
// The area by which a node touches what it lies on.

#include "bullet_wetcloth/numerics/ContactArea.h"

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"

#include <gtest/gtest.h>

namespace wetcloth_test::contact_area_test {

namespace {

double areaOf(wetcloth::WetCloth& cloth, std::size_t node) {
  return wetcloth::contactArea(cloth.restMesh(), cloth.water(), cloth.fabric().arealDensity, node);
}

TEST(ContactArea, IsAThirdOfTheTrianglesOrTheMassOverTheArealDensity) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, Lying().builder(WorldKind::softRigid));
  EXPECT_NEAR(areaOf(scene.cloth(), 5), 0.01, 1e-8);  // an inner node of 0.1 m x 0.1 m
  ClothScene rope(WorldKind::softRigid, kEarthGravity, hangingRope(3, 0.1, 0.003));
  EXPECT_NEAR(areaOf(rope.cloth(), 2), 0.003 / 0.150, 1e-8);
}

}  // namespace
}  // namespace wetcloth_test::contact_area_test
