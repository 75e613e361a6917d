// SPDX-License-Identifier: Zlib
// Several cloths in a world, several worlds in a process, several threads: nobody notices the others.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <thread>

namespace wetcloth_test::wet_cloth_world_test {

namespace {

// Everything at once, with numbers that depend on `seed`.
std::vector<btScalar> run(WorldKind kind, int seed, int steps) {
  BodyScene scene(kind, hangingPatch(6));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(0.5 + 0.1 * seed, 1));
  cloth.add<wetcloth::Absorption>({0.1 * (1 + seed % 9)});
  cloth.add<wetcloth::Wind>({btVector3(1, 0, btScalar(1 + seed))});
  if (seed % 2 == 1) cloth.add<wetcloth::HookeSprings>();
  scene.bullet().step(steps);
  std::vector<btScalar> result = stateOf(scene.body());
  for (int i = 0; i < cloth.nodeCount(); ++i) result.push_back(btScalar(cloth.held(i)));
  return result;
}

TEST_IN_EVERY_WORLD(WorldsAndThreads, SameRunTwiceSameBytes) {
  EXPECT_TRUE(sameBits(run(GetParam(), 1, 200), run(GetParam(), 1, 200)));
  EXPECT_FALSE(sameBits(run(GetParam(), 1, 200), run(GetParam(), 3, 200)));
}

// Worlds come and go in each thread all the time, so that attaching and detaching meet as well.
TEST_IN_EVERY_WORLD(WorldsAndThreads, EachThreadGetsTheResultOfASingleOne) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 6;
  std::vector<std::vector<btScalar>> expected;
  for (int seed = 0; seed < kThreads; ++seed) expected.push_back(run(GetParam(), seed, 40));
  bool same[kThreads] = {};
  std::vector<std::thread> threads;
  for (int seed = 0; seed < kThreads; ++seed) {
    threads.emplace_back([&, seed] {
      bool all = true;
      for (int round = 0; round < kRounds; ++round) {
        all = all && sameBits(run(GetParam(), seed, 40), expected[std::size_t(seed)]);
      }
      same[seed] = all;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int seed = 0; seed < kThreads; ++seed) EXPECT_TRUE(same[seed]) << seed;
}

TEST_IN_EVERY_WORLD(WorldsAndThreads, TwoWorldsInOneThreadTakeTurns) {
  BodyScene one(GetParam(), squarePatch(3));
  BodyScene two(GetParam(), squarePatch(3));
  wetcloth::WetClothWorld wetOne(one.world());
  wetcloth::WetClothWorld wetTwo(two.world());
  int calls[2] = {0, 0};
  addCall(wetOne.add(one.body()), [&](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls[0]; });
  addCall(wetTwo.add(two.body()), [&](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls[1]; });
  one.bullet().step(3);
  two.bullet().step(5);
  EXPECT_EQ(calls[0], 3);
  EXPECT_EQ(calls[1], 5);
}

class SeveralCloths {
 protected:
  static std::unique_ptr<btSoftBody> place(BulletWorld& bullet, double x) {
    wetcloth::ClothPatch patch = hangingPatch(4);
    patch.origin = btVector3(btScalar(x), 0, 0);
    std::unique_ptr<btSoftBody> body = patch.build(bullet.info());
    bullet.add(*body);
    return body;
  }
};

// A wet, windy neighbour far away changes nothing: the dry one runs as if alone with its like.
TEST_F_IN_EVERY_WORLD(SeveralCloths, DoNotFeelEachOther) {
  std::vector<btScalar> results[2];
  for (const bool withNeighbour : {false, true}) {
    BulletWorld bullet(GetParam());
    std::unique_ptr<btSoftBody> mine = place(bullet, 0);
    std::unique_ptr<btSoftBody> neighbour = place(bullet, 100);
    {
      wetcloth::WetClothWorld wet(bullet.world());
      wet.add(*mine).add<wetcloth::Wind>({btVector3(0, 0, 1)});
      if (withNeighbour) {
        wetcloth::WetCloth& other = wet.add(*neighbour, wetcloth::Fabric::highAbsorption());
        other.add<wetcloth::Absorption>();
        other.add<wetcloth::Wind>({btVector3(0, 0, 9)});
      }
      bullet.step(60);
      results[withNeighbour] = stateOf(*mine);
      EXPECT_EQ(wet.find(*mine)->ledger().held, 0);
    }
    bullet.remove(*mine);
    bullet.remove(*neighbour);
  }
  // The deformable world solves both bodies in one system to a relative residual, so it may stop elsewhere.
  EXPECT_LT(largestDifference(results[0], results[1]), BulletWorld(GetParam()).isDeformable() ? 1e-4 : 1e-12);
}

TEST_F_IN_EVERY_WORLD(SeveralCloths, AreFoundRemovedAndAddedAgain) {
  BulletWorld bullet(GetParam());
  std::unique_ptr<btSoftBody> one = place(bullet, 0);
  std::unique_ptr<btSoftBody> two = place(bullet, 100);
  {
    wetcloth::WetClothWorld wet(bullet.world());
    wetcloth::WetCloth& first = wet.add(*one);
    wetcloth::WetCloth& second = wet.add(two.get());
    EXPECT_EQ(wet.cloths().size(), 2u);
    EXPECT_EQ(wet.find(*one), &first);
    EXPECT_EQ(wet.find(*two), &second);
    EXPECT_EQ(&second.body(), two.get());
    second.setSaturation(1);
    const btScalar wetInverseMass = two->m_nodes[0].m_im;
    wet.remove(*two);
    EXPECT_EQ(wet.find(*two), nullptr);
    EXPECT_EQ(two->m_nodes[0].m_im, wetInverseMass) << "it keeps its present masses";
    EXPECT_EQ(wet.find(*one), &first);
    bullet.step(2);
    wetcloth::WetCloth& again = wet.add(*two);
    EXPECT_EQ(again.ledger().held, 0);
    EXPECT_NEAR(again.dryMass(0), 1 / double(wetInverseMass), 1e-6 / double(wetInverseMass));
    bullet.step(2);
  }
  bullet.remove(*one);
  bullet.remove(*two);
}

}  // namespace
}  // namespace wetcloth_test::wet_cloth_world_test
