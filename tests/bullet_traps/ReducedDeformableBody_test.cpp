// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace wetcloth_test::reduced_deformable_body_test {

namespace {

// Its nodes follow its modes: an effect would do nothing, and nobody would know.
TEST(ReducedDeformableBody, IsRefused) {
  BodyScene scene(WorldKind::deformable);
  scene.body().m_reducedModel = true;
  wetcloth::WetClothWorld wet(scene.world());
  EXPECT_THROW(wet.add(scene.body()), std::invalid_argument);
  scene.body().m_reducedModel = false;
  EXPECT_NO_THROW(wet.add(scene.body()));
}

}  // namespace
}  // namespace wetcloth_test::reduced_deformable_body_test
