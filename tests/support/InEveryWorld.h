// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test {

/// A test that runs in each of Bullet's worlds: `using MyTest = InEveryWorld; TEST_P(MyTest, ...)`, and
/// WETCLOTH_IN_EVERY_WORLD(MyTest) once. A name and no class where nothing is added: GoogleTest makes some ninety
/// functions of each class.
using InEveryWorld = testing::TestWithParam<WorldKind>;

inline const auto everyWorld = testing::Values(WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                               WorldKind::deformableImplicit);

inline std::string nameOfWorld(const testing::TestParamInfo<WorldKind>& test) { return nameOf(test.param); }

#define WETCLOTH_IN_EVERY_WORLD(Suite) \
  INSTANTIATE_TEST_SUITE_P(, Suite, ::wetcloth_test::everyWorld, ::wetcloth_test::nameOfWorld)

}  // namespace wetcloth_test
