// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test {

/// A test that runs in each of Bullet's worlds: `class MyTest : public InEveryWorld {}; TEST_P(MyTest, ...)`, and
/// WETCLOTH_IN_EVERY_WORLD(MyTest) once.
class InEveryWorld : public testing::TestWithParam<WorldKind> {};

#define WETCLOTH_IN_EVERY_WORLD(Suite)                                                                            \
  INSTANTIATE_TEST_SUITE_P(, Suite,                                                                               \
                           testing::Values(WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable, \
                                           WorldKind::deformableImplicit),                                        \
                           [](const auto& test) { return std::string(nameOf(test.param)); })

}  // namespace wetcloth_test
