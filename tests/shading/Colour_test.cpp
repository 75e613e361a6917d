// SPDX-License-Identifier: Zlib
// Why wet cloth is darker (Lekner & Dorf 1988), the paper's four stages, and roughness.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth_test::colour_test {
namespace {

using wetcloth::Colour;
using wetcloth::Fabric;
using wetcloth::paperColour;
using wetcloth::paperStage;
using wetcloth::wetAlbedo;
using wetcloth::wetColour;
using wetcloth::wetRoughness;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Colour kDry = {0.8, 0.6, 0.3};

TEST(Colour, WetAlbedoIsLeknerAndDorfs) {
  // A = (1 - R) a / (1 - p (1 - a)), a = 1 - 0.6, R = 0.02
  EXPECT_NEAR(wetAlbedo(0.6), 1 - 0.98 * 0.4 / (1 - 0.472 * 0.6), 1e-14);
  EXPECT_NEAR(wetAlbedo(0.6, 0.435), 1 - 0.98 * 0.4 / (1 - 0.435 * 0.6), 1e-14);
}

TEST(Colour, WetOverDryAlbedoIsThePaperPagesTable) {
  EXPECT_NEAR(wetAlbedo(0.8) / 0.8, 0.86, 0.005);  // the page's two digits
  EXPECT_NEAR(wetAlbedo(0.6) / 0.6, 0.76, 0.005);
  EXPECT_NEAR(wetAlbedo(0.3) / 0.3, 0.67, 0.005);
}

TEST(Colour, AngstromsFormUsesWatersRefractiveIndex) {
  const double angstrom = 1 - 1 / (1.33 * 1.33);
  EXPECT_NEAR(angstrom, 0.435, 0.0005);
  EXPECT_GT(wetAlbedo(0.5, angstrom), wetAlbedo(0.5, 0.472));  // less light kept inside: brighter
}

TEST(Colour, WhatReflectsAllStillDoesAndBlackOnlyGlints) {
  EXPECT_NEAR(wetAlbedo(1), 1, 1e-14);
  EXPECT_NEAR(wetAlbedo(0), 0.02, 1e-14);
}

TEST(Colour, WetAlbedoStaysInRangeAndGrowsWithTheDry) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const double wet = wetAlbedo(i / 100.0);
    EXPECT_GT(wet, before);
    EXPECT_GE(wet, 0);
    EXPECT_LE(wet, 1);
    // Below 4 % the water's own glint is brighter than the cloth.
    if (i >= 5) {
      EXPECT_LE(wet, i / 100.0);
    }
    before = wet;
  }
}

TEST(Colour, DarkensSteadilyToSaturationAndThenStays) {
  Colour before = wetColour(kDry, 0);
  EXPECT_EQ(before.r, kDry.r);
  EXPECT_EQ(before.g, kDry.g);
  EXPECT_EQ(before.b, kDry.b);
  for (int i = 1; i <= 50; ++i) {
    const Colour colour = wetColour(kDry, i / 50.0);
    EXPECT_LT(colour.r, before.r);
    EXPECT_LT(colour.g, before.g);
    EXPECT_LT(colour.b, before.b);
    before = colour;
  }
  EXPECT_NEAR(before.r, wetAlbedo(0.8), 1e-14);
  EXPECT_NEAR(before.g, wetAlbedo(0.6), 1e-14);
  EXPECT_NEAR(before.b, wetAlbedo(0.3), 1e-14);
  EXPECT_EQ(wetColour(kDry, 3).r, before.r);
  EXPECT_EQ(wetColour(kDry, -1).r, kDry.r);
}

TEST(Colour, IsLinearInTheSaturation) {
  EXPECT_NEAR(wetColour(kDry, 0.25).g, 0.75 * 0.6 + 0.25 * wetAlbedo(0.6), 1e-14);
}

/// Saturation of a node of the paper's Table II whose total mass is `grams`.
double saturationAt(double grams) { return (grams - 0.01) / 0.83; }

TEST(Colour, ThePapersFourStagesBeginAtItsFourMasses) {
  EXPECT_EQ(paperStage(0), 0);
  EXPECT_EQ(paperStage(saturationAt(0.092)), 0);
  EXPECT_EQ(paperStage(saturationAt(0.0931)), 1);
  EXPECT_EQ(paperStage(saturationAt(0.341)), 1);
  EXPECT_EQ(paperStage(saturationAt(0.3421)), 2);
  EXPECT_EQ(paperStage(saturationAt(0.590)), 2);
  EXPECT_EQ(paperStage(saturationAt(0.5911)), 3);
  EXPECT_EQ(paperStage(saturationAt(0.839)), 3);
  EXPECT_EQ(paperStage(1), 4);
  EXPECT_EQ(paperStage(2), 4);
}

TEST(Colour, ThePapersStagesHoldAtTheMassesThemselvesDespiteRounding) {
  // 0.01 + 3 x 0.083 and the like are not exact in binary.
  EXPECT_EQ(paperStage(saturationAt(0.093)), 1);
  EXPECT_EQ(paperStage(saturationAt(0.342)), 2);
  EXPECT_EQ(paperStage(saturationAt(0.591)), 3);
  EXPECT_EQ(paperStage(saturationAt(0.84)), 4);
  int stage = 0;
  for (double threshold : {0.1, 0.4, 0.7, 1.0}) EXPECT_EQ(paperStage(std::nextafter(threshold, 0)), ++stage);
}

TEST(Colour, ThePapersColourTakesFourEqualStepsToTheDarkest) {
  const Colour darkest = wetColour(kDry, 1);
  for (int stage = 0; stage <= 4; ++stage) {
    const double saturation = stage == 0 ? 0.05 : std::min(1.0, 0.1 + 0.3 * (stage - 1) + 1e-6);
    EXPECT_NEAR(paperColour(kDry, saturation).g, kDry.g + (darkest.g - kDry.g) * stage / 4, 1e-12) << stage;
  }
  EXPECT_EQ(paperColour(kDry, 1).r, darkest.r);
  EXPECT_EQ(paperColour(kDry, 5).r, darkest.r);
}

TEST(Colour, RoughnessFallsLinearlyTo35Percent) {
  EXPECT_EQ(wetRoughness(0.9, 0), 0.9);
  EXPECT_NEAR(wetRoughness(0.9, 1), 0.35 * 0.9, 1e-14);
  EXPECT_NEAR(wetRoughness(0.9, 0.5), 0.9 * (1 + 0.35) / 2, 1e-14);
  EXPECT_EQ(wetRoughness(0.9, 7), wetRoughness(0.9, 1));
  EXPECT_EQ(wetRoughness(0.9, -7), 0.9);
}

TEST(Colour, OfAClothComesFromItsFabricAndItsWater) {
  Fabric fabric = Fabric::cotton();
  fabric.dryColour = {0.8, 0.6, 0.3};
  fabric.dryRoughness = 0.8;
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), fabric, wetcloth::Hook::manual);
  EXPECT_EQ(scene.cloth().colour(4).g, 0.6);
  scene.cloth().setSaturation(0.5);
  EXPECT_NEAR(scene.cloth().colour(4).g, wetColour(kDry, 0.5).g, 1e-14);
  EXPECT_NEAR(scene.cloth().roughness(4), wetRoughness(0.8, 0.5), 1e-14);
  EXPECT_THROW(scene.cloth().colour(9), std::out_of_range);
  EXPECT_THROW(scene.cloth().roughness(-1), std::out_of_range);
}

TEST(Colour, BadInputIsRefused) {
  for (double bad : {-0.01, 1.01, kNaN, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(wetAlbedo(bad), std::invalid_argument) << bad;
    EXPECT_THROW(wetAlbedo(0.5, bad), std::invalid_argument) << bad;
    EXPECT_THROW(wetColour({0.5, bad, 0.5}, 0.5), std::invalid_argument) << bad;
    EXPECT_THROW(paperColour({0.5, 0.5, bad}, 0.5), std::invalid_argument) << bad;
    EXPECT_THROW(wetRoughness(bad, 0.5), std::invalid_argument) << bad;
  }
}

TEST(Colour, NanSaturationGivesAColourAllTheSame) {
  const Colour colour = wetColour(kDry, kNaN);
  EXPECT_GE(colour.r, wetAlbedo(0.8));
  EXPECT_LE(colour.r, 0.8);
  EXPECT_GE(paperStage(kNaN), 0);
  EXPECT_LE(paperStage(kNaN), 4);
}

}  // namespace
}  // namespace wetcloth_test::colour_test
