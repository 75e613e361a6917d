// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"
#include "tests/support/Test.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace wetcloth_test {

inline WorldKind worldOfTheTest = WorldKind::softRigid;

/// The world of the test that runs: as GoogleTest's own, which takes its place in the fixtures that have it.
inline WorldKind GetParam() { return worldOfTheTest; }

/// A test that is a function and runs in one of Bullet's worlds
class TestInWorld : public FunctionTest {
 public:
  TestInWorld(void (*body)(), WorldKind world) : FunctionTest(body), m_world(world) {}

 private:
  void SetUp() override { worldOfTheTest = m_world; }

  WorldKind m_world;
};

inline bool addTestInWorlds(std::initializer_list<WorldKind> worlds, const char* suite, const char* name,
                            const char* file, int line, void (*body)()) {
  for (const WorldKind world : worlds) {
    const std::string nameInWorld = std::string(name) + "/" + nameOf(world);
    testing::RegisterTest(suite, nameInWorld.c_str(), nullptr, nameOf(world), file, line,
                          [body, world]() -> testing::Test* { return new TestInWorld(body, world); });
  }
  return true;
}

inline constexpr std::initializer_list<WorldKind> kPositionBasedWorlds = {WorldKind::softRigid,
                                                                          WorldKind::softMultiBody};
inline constexpr std::initializer_list<WorldKind> kDeformableWorlds = {WorldKind::deformable,
                                                                       WorldKind::deformableImplicit};
inline constexpr std::initializer_list<WorldKind> kEveryWorld = {WorldKind::softRigid, WorldKind::softMultiBody,
                                                                 WorldKind::deformable, WorldKind::deformableImplicit};

/// A fixture for tests that run in each of Bullet's worlds and share more than functions: `TEST_P(MyTest, ...)`, and
/// WETCLOTH_IN_EVERY_WORLD(MyTest) once
using InEveryWorld = testing::TestWithParam<WorldKind>;

inline std::string nameOfWorld(const testing::TestParamInfo<WorldKind>& test) { return nameOf(test.param); }

}  // namespace wetcloth_test

#define WETCLOTH_IN_EVERY_WORLD(Suite) \
  INSTANTIATE_TEST_SUITE_P(, Suite, testing::ValuesIn(::wetcloth_test::kEveryWorld), ::wetcloth_test::nameOfWorld)

// Tests without a fixture, in some of Bullet's worlds, named as those of TEST_P are: Suite.Name/softRigid. GoogleTest's
// own makes a class and two factories of each, 25 functions.
#define WETCLOTH_TEST_IN(worlds, suite, name)                                                   \
  static void suite##_##name##_Test();                                                          \
  [[maybe_unused]] static const bool suite##_##name##_added = ::wetcloth_test::addTestInWorlds( \
      ::wetcloth_test::worlds, #suite, #name, __FILE__, __LINE__, suite##_##name##_Test);       \
  static void suite##_##name##_Test()

#define TEST_IN_EVERY_WORLD(suite, name) WETCLOTH_TEST_IN(kEveryWorld, suite, name)
#define TEST_IN_POSITION_BASED_WORLDS(suite, name) WETCLOTH_TEST_IN(kPositionBasedWorlds, suite, name)
#define TEST_IN_DEFORMABLE_WORLDS(suite, name) WETCLOTH_TEST_IN(kDeformableWorlds, suite, name)
