// SPDX-License-Identifier: Zlib
// An application that changes a cloth's shape at rest, by scale() or in the links themselves, gets a cloth that dries
// and wicks by its new size. What Swelling does to rest lengths is no new shape.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/ClothScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wetcloth_test::rest_shape_changed_test {

namespace {

constexpr double kRounding = kIsDouble ? 1e-9 : 1e-4;

struct Sheet {
  explicit Sheet(double side, double arealDensity)
      : scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(9, side, arealDensity), wetcloth::Fabric::cotton(),
              wetcloth::Hook::manual) {}
  void run(int steps, double dt = 0.1) {
    for (int i = 0; i < steps; ++i) scene.preTick(dt);
  }
  wetcloth::WetCloth& cloth() { return scene.cloth(); }
  ClothScene scene;
};

// As large as `small` is once it is scaled by 2, and as heavy.
struct SmallAndLarge {
  Sheet small{0.5, 0.16};
  Sheet large{1, 0.04};
};

void scaleByTwo(btSoftBody& body) { body.scale(btVector3(2, 2, 2)); }

void lengthenLinks(btSoftBody& body) {
  for (int k = 0; k < body.m_links.size(); ++k) {
    body.m_links[k].m_rl *= 2;
    body.m_links[k].m_c1 *= 4;
  }
}

using RestShapeChanged = testing::TestWithParam<void (*)(btSoftBody&)>;

TEST_P(RestShapeChanged, DriesByItsNewSize) {
  SmallAndLarge sheets;
  std::vector<double> left;
  for (Sheet* sheet : {&sheets.small, &sheets.large}) {
    sheet->cloth().add<wetcloth::Drying>();
    sheet->cloth().setSaturation(1);
    sheet->run(3);
  }
  GetParam()(sheets.small.scene.body());
  for (Sheet* sheet : {&sheets.small, &sheets.large}) {
    const double before = sheet->cloth().ledger().evaporated;
    sheet->run(20);
    left.push_back(sheet->cloth().ledger().evaporated - before);
  }
  EXPECT_NEAR(left[0], left[1], kRounding * left[1]);
}

TEST_P(RestShapeChanged, WicksByItsNewSize) {
  SmallAndLarge sheets;
  std::vector<double> spread;
  for (Sheet* sheet : {&sheets.small, &sheets.large}) {
    wetcloth::WetCloth& cloth = sheet->cloth();
    cloth.add<wetcloth::Diffusion>();
    sheet->run(3);
    if (sheet == &sheets.small) GetParam()(sheet->scene.body());
    std::vector<double> held(81, 0);
    held[40] = cloth.capacity(40);
    cloth.setHeld(held);
    sheet->run(50);
    spread.push_back(held[40] - cloth.held(40));
  }
  EXPECT_NEAR(spread[0], spread[1], kRounding * spread[1]);
}

INSTANTIATE_TEST_SUITE_P(, RestShapeChanged, testing::Values(scaleByTwo, lengthenLinks),
                         [](const auto& test) { return test.index == 0 ? "scale" : "links"; });

TEST(RestShape, BeforeTheFirstStepCounts) {
  SmallAndLarge sheets;
  sheets.small.cloth().add<wetcloth::Drying>();
  scaleByTwo(sheets.small.scene.body());
  sheets.small.cloth().setSaturation(1);
  sheets.large.cloth().add<wetcloth::Drying>();
  sheets.large.cloth().setSaturation(1);
  sheets.small.run(1);
  sheets.large.run(1);
  const double evaporated = sheets.large.cloth().ledger().evaporated;
  EXPECT_NEAR(sheets.small.cloth().ledger().evaporated, evaporated, kRounding * evaporated);
}

TEST(RestShape, WhileNoEffectWasThereCounts) {
  SmallAndLarge sheets;
  wetcloth::Effect& first = sheets.small.cloth().add<wetcloth::Drying>();
  sheets.small.cloth().remove(first);
  scaleByTwo(sheets.small.scene.body());
  EXPECT_EQ(sheets.small.cloth().effects().empty(), true);
  sheets.small.cloth().add<wetcloth::Drying>();
  const double area = sheets.large.cloth().restMesh().nodeAreas()[40];
  EXPECT_NEAR(sheets.small.cloth().restMesh().nodeAreas()[40], area, kRounding * area);
}

// Counts how often it is attached.
class Attached : public wetcloth::Effect {
 public:
  explicit Attached(int& times) : m_times(times) {}
  const char* name() const override { return "Attached"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::losses; }
  void attach(wetcloth::WetCloth&) override { ++m_times; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override {}

 private:
  int& m_times;
};

TEST(RestShapeUnchanged, ByBulletsFirstStepAndByMotion) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, levelPatch(9, 0.5));
  int times = 0;
  scene.cloth().add(std::make_unique<Attached>(times));
  scene.step(200);
  EXPECT_EQ(times, 1);
}

TEST(RestShapeUnchanged, BySwelling) {
  Sheet sheet(0.5, 0.16);
  int times = 0;
  const double area = wetcloth::RestMesh(sheet.scene.body()).nodeAreas()[40];
  sheet.cloth().add<wetcloth::Swelling>({-0.05});
  sheet.cloth().add(std::make_unique<Attached>(times));
  for (const double saturation : {1.0, 0.3, 0.8}) {
    sheet.cloth().setSaturation(saturation);
    sheet.run(40);
  }
  EXPECT_EQ(times, 1);
  EXPECT_NEAR(sheet.cloth().restMesh().nodeAreas()[40], area, kRounding * area) << "of the cloth by itself";
}

// An application that transforms a running body in every step, by which Bullet resets rest lengths, pays now and then.
TEST(RestShape, InEveryStepIsFollowedOnceIn32) {
  Sheet sheet(0.5, 0.16);
  int times = 0;
  sheet.cloth().add(std::make_unique<Attached>(times));
  for (int i = 0; i < 320; ++i) {
    for (int k = 0; k < sheet.scene.body().m_links.size(); ++k) sheet.scene.body().m_links[k].m_rl *= btScalar(1.001);
    sheet.run(1);
  }
  EXPECT_GE(times, 9);
  EXPECT_LE(times, 12);
}

}  // namespace
}  // namespace wetcloth_test::rest_shape_changed_test
