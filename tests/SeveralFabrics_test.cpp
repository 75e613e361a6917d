// SPDX-License-Identifier: Zlib
// A cloth that is sewn of several fabrics: each node soaks, holds and looks as its own does, and a cut keeps that.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/water/DryMass.h"
#include "tests/support/BodyScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::several_fabrics_test {

namespace {

using wetcloth::Fabric;

constexpr double kStep = 1.0 / 256;
// Sums of a few hundred terms in double, each rounded to 1e-16 of the whole.
constexpr double kSums = 1e-12;

std::vector<Fabric> cottonAndTerry() { return {Fabric::cotton(), Fabric::highAbsorption()}; }

// The seam runs along z at this x; what is left of it is of the first fabric.
std::vector<int> sewnAt(const btSoftBody& body, double seam) {
  std::vector<int> fabricOfNode;
  for (int i = 0; i < body.m_nodes.size(); ++i) fabricOfNode.push_back(double(body.m_nodes[i].m_x.x()) < seam ? 0 : 1);
  return fabricOfNode;
}

std::vector<std::pair<int, int>> linksOf(const btSoftBody& body) {
  std::vector<std::pair<int, int>> links;
  for (int k = 0; k < body.m_links.size(); ++k) {
    links.emplace_back(int(body.m_links[k].m_n[0] - &body.m_nodes[0]), int(body.m_links[k].m_n[1] - &body.m_nodes[0]));
  }
  return links;
}

// Two panels in a world without gravity, whose water moves in every step that the test makes.
struct Sewn {
  explicit Sewn(WorldKind kind, std::vector<Fabric> fabrics = cottonAndTerry(), double seam = 0.3,
                const wetcloth::ClothPatch& patch = squarePatch(6))
      : scene(kind, patch, btVector3(0, 0, 0)),
        wet(scene.world(), wetcloth::Hook::manual),
        cloth(wet.add(scene.body(), std::move(fabrics), sewnAt(scene.body(), seam))) {
    wet.setLog({});
    cloth.setPace(wetcloth::WaterPace::exact());
  }

  void step(int count, double dt = kStep) {
    for (int i = 0; i < count; ++i) wet.preTick(btScalar(dt));
  }
  std::string saved() const {
    std::ostringstream stream;
    wet.save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    wet.restore(stream);
  }
  std::vector<double> held() const {
    std::vector<double> water;
    for (int i = 0; i < cloth.nodeCount(); ++i) water.push_back(cloth.held(i));
    return water;
  }

  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
};

double imbalanceOf(const wetcloth::WetCloth& cloth) { return std::fabs(cloth.ledger().imbalance()); }

// Q(t) = alpha m (1 - exp(-t / theta)), with the alpha and theta of the node's own fabric.
void expectOwnLaw(const Sewn& sewn) {
  for (int i = 0; i < sewn.cloth.nodeCount(); ++i) {
    const Fabric fabric = i % 6 < 2 ? Fabric::cotton() : Fabric::highAbsorption();
    const double capacity = fabric.capacity * sewn.cloth.dryMass(i);
    EXPECT_NEAR(sewn.cloth.capacity(i), capacity, kSums * capacity);
    EXPECT_NEAR(sewn.cloth.held(i), -capacity * std::expm1(-sewn.wet.time() / fabric.timeConstant), kSums * capacity)
        << i;
  }
  EXPECT_LE(imbalanceOf(sewn.cloth), kSums * sewn.cloth.ledger().held);
}

TEST_IN_EVERY_WORLD(SeveralFabrics, SoakEachByItsOwnClosedForm) {
  const wetcloth::Exposure exposures[] = {1.0, std::vector<double>(36, 1.0),
                                          [](const btVector3&, const btVector3&) { return 1.0; }};
  for (const wetcloth::Exposure& exposure : exposures) {
    Sewn sewn(GetParam());
    wetcloth::Absorption::Parameters parameters;
    parameters.exposure = exposure;
    sewn.cloth.add<wetcloth::Absorption>(parameters);
    sewn.step(200);
    expectOwnLaw(sewn);
  }
}

TEST_IN_EVERY_WORLD(SeveralFabrics, SoakSoUnderWater) {
  Sewn sewn(GetParam());
  wetcloth::Immersion::Parameters pool;
  pool.surface = wetcloth::WaterSurface{btVector3(0, 1, 0), -1};
  sewn.cloth.add<wetcloth::Immersion>(pool);
  sewn.step(200);
  expectOwnLaw(sewn);
}

// Water flows by differences of saturation, so it rests where that is the same in both, s: all water over all capacity.
// Terry then holds 2.492 / 0.84 times as much per dry mass as cotton, wherever the water came from.
TEST(SeveralFabrics, AreEquallySaturatedWhenWaterHasSpread) {
  for (const int wetFabric : {0, 1}) {
    Sewn sewn(WorldKind::softRigid);
    std::vector<double> held;
    double water = 0;
    double capacity = 0;
    for (int i = 0; i < 36; ++i) {
      held.push_back(sewn.cloth.water().fabric(std::size_t(i)) == std::size_t(wetFabric) ? sewn.cloth.capacity(i) : 0);
      water += held.back();
      capacity += sewn.cloth.capacity(i);
    }
    sewn.cloth.setHeld(held);
    wetcloth::Diffusion::Parameters even;
    even.warpDiffusivity = even.weftDiffusivity = 0.1;
    even.exponent = 0;
    sewn.cloth.add<wetcloth::Diffusion>(even);
    // 1 m / pi squared over 0.1 m^2/s is 1 s, the slowest wave's time constant: exp(-40) of it is left.
    sewn.step(400, 0.1);
    for (int i = 0; i < 36; ++i) {
      // It comes to rest where less than 1e-9 of the capacity moves in a second, which this is far above.
      EXPECT_NEAR(sewn.cloth.saturation(i), water / capacity, 1e-7) << i;
    }
    EXPECT_NEAR(sewn.cloth.meanSaturation(), water / capacity, kSums);
    EXPECT_NEAR(sewn.cloth.ledger().held, water, kSums * water);
    EXPECT_LE(imbalanceOf(sewn.cloth), kSums * water);
  }
}

TEST_IN_EVERY_WORLD(SeveralFabrics, AreFilledEachToItsCapacity) {
  Sewn sewn(GetParam());
  sewn.cloth.setSaturation(0.5);
  for (int i = 0; i < 36; ++i) {
    const double ratio = i % 6 < 2 ? 0.84 : 2.492;
    EXPECT_NEAR(sewn.cloth.held(i), 0.5 * ratio * sewn.cloth.dryMass(i), kSums * sewn.cloth.held(i)) << i;
  }
  EXPECT_NEAR(sewn.cloth.meanSaturation(), 0.5, kSums);
}

TEST_IN_EVERY_WORLD(SeveralFabrics, FollowMassesThatTheApplicationSets) {
  Sewn sewn(GetParam());
  for (const int node : {0, 5}) sewn.scene.body().setMass(node, btScalar(0.125));
  sewn.step(1);
  EXPECT_EQ(sewn.cloth.capacity(0), 0.84 * 0.125);
  EXPECT_EQ(sewn.cloth.capacity(5), 2.492 * 0.125);
  double capacity = 0;
  for (int i = 0; i < 36; ++i) capacity += sewn.cloth.capacity(i);
  EXPECT_NEAR(sewn.cloth.water().totalCapacity(), capacity, kSums * capacity);
}

// Which of two names the same fabric has makes no difference, to the last bit.
TEST(SeveralFabrics, OfOneKindAreOne) {
  const auto run = [](double seam) {
    Sewn sewn(WorldKind::softRigid, {Fabric::cotton(), Fabric::cotton()}, seam);
    sewn.cloth.add<wetcloth::Absorption>({[](const btVector3& x, const btVector3&) { return double(x.x()); }});
    sewn.cloth.add<wetcloth::Diffusion>();
    sewn.cloth.add<wetcloth::Dripping>();
    sewn.cloth.add<wetcloth::Drying>();
    sewn.step(50);
    return sewn.held();
  };
  EXPECT_EQ(run(2), run(0.3));
}

// Bullet keeps no mass for them: each has the areal density of the free nodes of its own panel.
TEST(SeveralFabrics, GivePinnedNodesTheirOwnDensity) {
  BodyScene scene(WorldKind::softRigid, hangingPatch(6));
  const std::vector<int> fabricOfNode = sewnAt(scene.body(), 0.3);
  for (int i = 0; i < 36; ++i) {
    if (fabricOfNode[std::size_t(i)] == 1) scene.node(i).m_im /= 3;
  }
  wetcloth::WetClothWorld wet(scene.world());
  const wetcloth::WetCloth& cloth = wet.add(scene.body(), cottonAndTerry(), fabricOfNode);
  const std::vector<double> areas = wetcloth::nodeAreas(scene.body());
  for (int i = 0; i < 36; ++i) {
    if (scene.node(i).m_im > 0) continue;
    const double density = fabricOfNode[std::size_t(i)] == 1 ? 0.45 : 0.15;
    EXPECT_NEAR(cloth.dryMass(i) / areas[std::size_t(i)], density, 1e-5 * density) << i;  // masses round to btScalar
  }
}

TEST(SeveralFabrics, LookEachAsItsOwn) {
  std::vector<Fabric> fabrics = cottonAndTerry();
  fabrics[1].dryRoughness = 0.5;
  Sewn sewn(WorldKind::softRigid, fabrics);
  for (const double saturation : {0.0, 0.6}) {
    sewn.cloth.setSaturation(saturation);
    std::vector<float> vertices(std::size_t(4) * 36);
    wetcloth::fillVertexBuffer(sewn.cloth, {vertices.data(), 36, {}, {}, {0, 4}, {3, 4}});
    for (int i = 0; i < 36; ++i) {
      const Fabric& fabric = fabrics[i % 6 < 2 ? 0 : 1];
      const wetcloth::Colour dry{fabric.dryColour[0], fabric.dryColour[1], fabric.dryColour[2]};
      const wetcloth::Colour colour = wetcloth::wetColour(dry, saturation);
      const double roughness = wetcloth::wetRoughness(fabric.dryRoughness, saturation);
      // setSaturation() rounds the water, and a float has 24 bits.
      EXPECT_NEAR(sewn.cloth.colour(i).r, colour.r, kSums);
      EXPECT_NEAR(sewn.cloth.roughness(i), roughness, kSums);
      const float* const vertex = &vertices[std::size_t(4) * std::size_t(i)];
      EXPECT_NEAR(double(vertex[0]), colour.r, 1e-6) << i;
      EXPECT_NEAR(double(vertex[2]), colour.b, 1e-6) << i;
      EXPECT_NEAR(double(vertex[3]), roughness, 1e-6) << i;
      EXPECT_EQ(sewn.cloth.fabric(i).name, fabric.name);
    }
  }
  EXPECT_EQ(sewn.cloth.fabric().name, "cotton");
  EXPECT_EQ(sewn.cloth.fabrics().size(), 2u);
  EXPECT_THROW(sewn.cloth.fabric(36), std::out_of_range);
}

// Which fabric a node is of is part of the state: a world in which the panels were given the other way round goes on as
// the saved one.
TEST_IN_EVERY_WORLD(SeveralFabrics, AreSavedAndRestored) {
  Sewn whole(GetParam());
  Sewn swapped(GetParam(), cottonAndTerry(), 0.7);
  for (Sewn* sewn : {&whole, &swapped}) {
    sewn->cloth.add<wetcloth::Absorption>();
    sewn->cloth.add<wetcloth::Diffusion>();
  }
  whole.step(20);
  swapped.restore(whole.saved());
  for (Sewn* sewn : {&whole, &swapped}) sewn->step(20);
  EXPECT_EQ(swapped.held(), whole.held());
  EXPECT_EQ(swapped.cloth.capacity(2), whole.cloth.capacity(2));
  EXPECT_EQ(swapped.cloth.fabric(2).name, "high_absorption");
  EXPECT_EQ(swapped.saved(), whole.saved());
}

TEST(SeveralFabrics, AreNotRestoredIntoAClothOfOne) {
  const std::string state = Sewn(WorldKind::softRigid).saved();
  Sewn one(WorldKind::softRigid, {Fabric::cotton()}, 2);
  const std::string before = one.saved();
  EXPECT_THROW(one.restore(state), wetcloth::StateError);
  EXPECT_EQ(one.saved(), before);
}

class Plane : public btSoftBody::ImplicitFn {
 public:
  btScalar Eval(const btVector3& x) override { return x.x() - btScalar(0.37); }
};

void refine(btSoftBody& body) {
  Plane plane;
  body.refine(&plane, btScalar(0.001), false);
}
void cutAlongAPlane(btSoftBody& body) {
  Plane plane;
  body.refine(&plane, btScalar(0.001), true);
}
// Between the nodes at x = 0.2 and x = 0.4.
void cutOneLink(btSoftBody& body) { ASSERT_TRUE(body.cutLink(1, 2, btScalar(0.85))); }

// The cut runs through one panel, whose fabric its new nodes get.
TEST_IN_EVERY_WORLD(SeveralFabrics, AreKeptByACutInAPanel) {
  for (void (*const cut)(btSoftBody&) : {refine, cutAlongAPlane, cutOneLink}) {
    for (const double seam : {0.5, 0.1}) {
      Sewn sewn(GetParam(), cottonAndTerry(), seam);
      sewn.cloth.setSaturation(1);
      const double water = sewn.cloth.ledger().held;
      cut(sewn.scene.body());
      ASSERT_GT(sewn.cloth.nodeCount(), 36);
      for (int i = 0; i < sewn.cloth.nodeCount(); ++i) {
        const Fabric fabric = double(sewn.scene.node(i).m_x.x()) < seam ? Fabric::cotton() : Fabric::highAbsorption();
        EXPECT_EQ(sewn.cloth.fabric(i).name, fabric.name) << i << ", seam at " << seam;
        const double capacity = fabric.capacity * sewn.cloth.dryMass(i);
        EXPECT_NEAR(sewn.cloth.capacity(i), capacity, kSums * capacity);
        EXPECT_LE(sewn.cloth.saturation(i), 1 + 1e-5) << "Bullet rounds the masses that it shares out";
      }
      EXPECT_NEAR(sewn.cloth.ledger().held, water, kSums * water);
      EXPECT_LE(imbalanceOf(sewn.cloth), kSums * water);
      sewn.cloth.setSaturation(0);
      sewn.cloth.add<wetcloth::Absorption>();
      sewn.step(10);
      const double share = -std::expm1(-10 * kStep / Fabric::highAbsorption().timeConstant);
      EXPECT_NEAR(sewn.cloth.saturation(5), share, kSums) << "and goes on by its own law";
    }
  }
}

// Each side of a cut along the seam stays what it was; a node that refines it is of what is nearer to it, terry. Of the
// water that terry gave to new nodes cotton ones hold more than they would soak: no mass comes of that.
TEST_IN_EVERY_WORLD(SeveralFabrics, AreKeptByACutAlongTheSeam) {
  for (void (*const cut)(btSoftBody&) : {refine, cutAlongAPlane, cutOneLink}) {
    Sewn sewn(GetParam());
    sewn.cloth.setSaturation(1);
    const double water = sewn.cloth.ledger().held;
    const double mass = sewn.cloth.totalMass();
    cut(sewn.scene.body());
    ASSERT_GT(sewn.cloth.nodeCount(), 36);
    EXPECT_NEAR(sewn.cloth.ledger().held, water, kSums * water);
    if (cut != cutOneLink) {  // which makes nodes of 1 kg
      EXPECT_NEAR(sewn.cloth.totalMass(), mass, 1e-5 * mass) << "Bullet's masses round";
    }
    if (cut == refine) {
      for (int i = 36; i < sewn.cloth.nodeCount(); ++i) EXPECT_EQ(sewn.cloth.fabric(i).name, "high_absorption") << i;
    } else if (cut == cutOneLink) {
      EXPECT_EQ(sewn.cloth.fabric(36).name, "cotton");
      EXPECT_EQ(sewn.cloth.fabric(37).name, "high_absorption");
    } else {
      for (const auto& [a, b] : linksOf(sewn.scene.body())) {
        EXPECT_EQ(sewn.cloth.fabric(a).name, sewn.cloth.fabric(b).name) << a << " and " << b;
      }
    }
  }
}

TEST(SeveralFabrics, BadOnesAreRefusedByName) {
  BodyScene scene(WorldKind::softRigid, squarePatch(3));
  wetcloth::WetClothWorld wet(scene.world());
  const auto refusal = [&](std::vector<Fabric> fabrics, std::vector<int> fabricOfNode) {
    std::string message = rejection([&] { wet.add(scene.body(), std::move(fabrics), std::move(fabricOfNode)); });
    EXPECT_TRUE(wet.cloths().empty());
    return message;
  };
  const std::vector<int> zeros(9, 0);
  EXPECT_EQ(refusal({}, zeros), "fabrics.size() = 0: must be at least 1");
  EXPECT_EQ(refusal({Fabric::cotton(), fabricOf(-2, 1)}, zeros).find("fabrics[1].capacity = -2: "), 0u);
  EXPECT_EQ(refusal(cottonAndTerry(), std::vector<int>(8, 0)),
            "fabricOfNode.size() = 8: must be the number of nodes, 9");
  for (const int bad : {-1, 2, std::numeric_limits<int>::max()}) {
    std::vector<int> fabricOfNode = zeros;
    fabricOfNode[7] = bad;
    EXPECT_EQ(refusal(cottonAndTerry(), fabricOfNode),
              "fabricOfNode[7] = " + std::to_string(bad) + ": must be in [0, 2)");
  }
  btSoftBody* const none = nullptr;
  EXPECT_EQ(rejection([&] { wet.add(none, cottonAndTerry(), zeros); }), "body: must not be null");
  wet.add(&scene.body(), cottonAndTerry(), zeros);
  EXPECT_EQ(rejection([&] { wet.add(scene.body(), cottonAndTerry(), zeros); }), "body: was added already");
}

}  // namespace
}  // namespace wetcloth_test::several_fabrics_test
