// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet/Versions.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Test.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace wetcloth_test {

inline WorldKind worldOfTheTest = WorldKind::softRigid;

/// The world of the test that runs; in tests with other parameters GoogleTest's own takes its place.
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

/// Where contacts of two cloths can be looked at: the deformable worlds have them from Bullet 3.22 on.
inline constexpr std::initializer_list<WorldKind> kWorldsWithFaceContacts =
    wetcloth::keepsFaceContacts() ? kEveryWorld : kPositionBasedWorlds;

}  // namespace wetcloth_test

// Tests in some of Bullet's worlds, named as those of TEST_P are: Suite.Name/softRigid. GoogleTest's own makes a class
// and two factories of each, 25 functions, and 171 of each fixture.
#define WETCLOTH_TEST_IN(worlds, suite, name)                                                   \
  static void suite##_##name##_Test();                                                          \
  [[maybe_unused]] static const bool suite##_##name##_added = ::wetcloth_test::addTestInWorlds( \
      ::wetcloth_test::worlds, #suite, #name, __FILE__, __LINE__, suite##_##name##_Test);       \
  static void suite##_##name##_Test()

#define TEST_IN_EVERY_WORLD(suite, name) WETCLOTH_TEST_IN(kEveryWorld, suite, name)
#define TEST_IN_WORLDS_WITH_FACE_CONTACTS(suite, name) WETCLOTH_TEST_IN(kWorldsWithFaceContacts, suite, name)
#define TEST_IN_POSITION_BASED_WORLDS(suite, name) WETCLOTH_TEST_IN(kPositionBasedWorlds, suite, name)
#define TEST_IN_DEFORMABLE_WORLDS(suite, name) WETCLOTH_TEST_IN(kDeformableWorlds, suite, name)

// The same with a fixture: any class, whose members are the test's. It is made when the test begins.
#define WETCLOTH_TEST_F_IN(worlds, fixture, name)                        \
  struct fixture##_##name : fixture {                                    \
    void test();                                                         \
  };                                                                     \
  WETCLOTH_TEST_IN(worlds, fixture, name) { fixture##_##name().test(); } \
  void fixture##_##name::test()

#define TEST_F_IN_EVERY_WORLD(fixture, name) WETCLOTH_TEST_F_IN(kEveryWorld, fixture, name)
#define TEST_F_IN_WORLDS_WITH_FACE_CONTACTS(fixture, name) WETCLOTH_TEST_F_IN(kWorldsWithFaceContacts, fixture, name)
#define TEST_F_IN_DEFORMABLE_WORLDS(fixture, name) WETCLOTH_TEST_F_IN(kDeformableWorlds, fixture, name)
