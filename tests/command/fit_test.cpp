// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace wetcloth_test::fit_test {
namespace {

using namespace cli;

/// Soaks as 1.2 (1 - exp(-t / 6)), to three digits.
std::string soaking() {
  std::ostringstream text;
  text.precision(3);
  text << "time_s,water_kg_kg\n";
  for (int t = 0; t <= 30; t += 3) text << t << "," << 1.2 * -std::expm1(-t / 6.) << "\n";
  return text.str();
}

Json fitOf(const std::string& data, const std::string& of) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"fit", directory.write("data.csv", data), "--of", of, "--json", "-"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

/// The small scene with that cloth's fabric and effects.
Json sceneWith(const Json& cloth) {
  Json scene = smallScene();
  Json& target = scene["cloths"][0];
  for (const auto& [key, value] : cloth.items()) target[key] = value;
  return scene;
}

TEST(Fit, TellsParametersResidualsAndPlots) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", soaking());
  const Outcome outcome = runWetcloth({"fit", file, "--of", "absorption", "--out", directory.path("out")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"capacity_kg_per_kg", "time_constant_s", "+-", "residuals", "\"preset\": \"cotton\""}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in " << outcome.out;
  }
  for (const char* name : {"/fit_absorption.csv", "/fit_absorption_residuals.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(directory.path("out") + name)) << name;
  }
}

// Cloth that only gets drier does not soak; and times since 1970 are no time of a soaking.
TEST(Fit, WarnsWhereTheLawDoesNotDescribeTheReadings) {
  const std::string drier = "time_s,water_kg_kg\n1,1.2\n2,0.9\n3,0.5\n4,0.3\n5,0.1\n";
  EXPECT_NE(fitOf(drier, "absorption").at("warnings").at(0).get<std::string>().find("time_s, water_kg_kg"),
            std::string::npos);
  std::ostringstream since1970;
  since1970 << "time_s,water_kg_kg\n";
  for (int t = 0; t <= 30; t += 3) since1970 << 1700000000 + t << "," << 1.2 * -std::expm1(-t / 6.) << "\n";
  EXPECT_FALSE(fitOf(since1970.str(), "absorption").at("warnings").empty());
}

TEST(Fit, WarnsOfUnitsInTextAndJson) {
  const std::string millimetres = "time_s,height_m\n10,23.6\n60,42.7\n180,59.7\n600,84.9\n";
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", millimetres);
  const Outcome outcome = runWetcloth({"fit", file, "--of", "wicking", "--json", directory.path("fit.json")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\n  warning: height_m reaches 84.9"), std::string::npos) << outcome.out;
  const Json warnings = readJson(directory.path("fit.json")).at("warnings");
  EXPECT_NE(warnings.at(0).get<std::string>().find("height_m reaches 84.9"), std::string::npos) << warnings;
}

// An hour passes between the second reading and the third: whatever happens in it fits.
TEST(Fit, ThatDoesNotConvergeEndsWithWhatToDo) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", "time_s,water_kg_kg\n1,0\n2,0\n3600,1\n3601,1\n");
  const Outcome outcome = runWetcloth({"fit", file, "--of", "absorption", "--json", directory.path("fit.json")});
  EXPECT_EQ(outcome.status, 1);
  for (const char* word : {"data.csv: ", "did not converge", "readings", "--out"}) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
  }
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1);
  EXPECT_NE(outcome.out.find("warning: the search did not converge"), std::string::npos) << outcome.out;
  EXPECT_EQ(readJson(directory.path("fit.json")).at("converged"), false);
}

// Not on its way to numbers that a computer cannot have.
TEST(Fit, RefusesAReadingThatNobodyMeasures) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", "time_s,water_kg_kg\n0,0\n3,1e308\n6,0.7\n9,1e308\n");
  expectRefusal(runWetcloth({"fit", file, "--of", "absorption"}), {"line 3, column 2 (water_kg_kg)", "1e308"});
}

TEST(Fit, WhereTheModelFailsTellsWhichUnitsMayBeWrong) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", "time_s,height_m\n1,1e19\n2,2e19\n3,1e20\n");
  const Outcome outcome = runWetcloth({"fit", file, "--of", "wicking"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err.rfind(file + ": ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("height_m reaches 1e+20"), std::string::npos) << outcome.err;
}

TEST(Fit, OfAbsorptionSoaksAsMeasuredInAScene) {
  const Json fit = fitOf(soaking(), "absorption");
  // Three digits of the readings.
  EXPECT_NEAR(fit.at("cloth").at("fabric").at("capacity_kg_per_kg").get<double>(), 1.2, 0.01);
  EXPECT_NEAR(fit.at("cloth").at("fabric").at("time_constant_s").get<double>(), 6, 0.1);
  EXPECT_TRUE(fit.at("warnings").empty());
  EXPECT_EQ(fit.at("converged"), true);
  Json scene = sceneWith(fit.at("cloth"));
  scene["cloths"][0]["effects"] = {{"absorption", Json::object()}};
  scene["duration_s"] = 6;
  const Json result = runScene(scene);
  EXPECT_NEAR(result.at("saturation").at("mean").get<double>(), 1 - std::exp(-1), 0.01) << result;
}

TEST(Fit, OfDryingAndStretchAndWickingRunInAScene) {
  const Json drying =
      fitOf("time_s,water_kg_kg\n0,0.7\n1000,0.5\n2000,0.3\n3000,0.12\n4000,0.04\n5000,0.015\n", "drying");
  EXPECT_TRUE(runScene(sceneWith(drying.at("cloth"))).is_object());
  const Json stretch = fitOf("load_n_m,strain,saturation\n10,0.01,0\n20,0.02,0\n20,0.03,1\n40,0.06,1\n", "stretch");
  EXPECT_NEAR(stretch.at("cloth").at("effects").at("wet_stiffness").at("wet_stretch").get<double>(), 2. / 3, 0.01);
  EXPECT_TRUE(runScene(sceneWith(stretch.at("cloth"))).is_object());
  const Json wicking = {{"effects",
                         {{"diffusion", {{"warp_diffusivity_m2_s", 1e-5}, {"weft_diffusivity_m2_s", 1e-5}}},
                          {"seepage", {{"speed_m_s", 5e-5}}}}}};
  EXPECT_TRUE(runScene(sceneWith(wicking)).is_object()) << "what `fit --of wicking` says";
}

/// A strip of 0.16 x 0.48 m that hangs and has come to rest.
Json hangingStrip() {
  return {{"name", "hanging strip"},
          {"world", "soft_rigid"},
          {"step_s", 1. / 60},
          {"substeps", 4},
          {"duration_s", 2},
          {"cloths",
           {{{"patch",
              {{"columns", 9},
               {"rows", 25},
               {"origin_m", {0, -0.48, 0}},
               {"edge_u_m", {0.16, 0, 0}},
               {"edge_v_m", {0, 0.48, 0}}}},
             {"damping", 0.05},
             {"pins", {{"edges", {"top"}}}}}}}};
}

TEST(Fit, OfStretchHangsAsLowAsMeasuredInAScene) {
  const Json fit = fitOf("load_n_m,strain\n10,0.0667\n20,0.1333\n40,0.2667\n", "stretch");
  Json scene = hangingStrip();
  for (const auto& [key, value] : fit.at("cloth").items()) scene["cloths"][0][key] = value;
  const double middle = runScene(scene).at("centre_of_mass")[1].get<double>();
  // Under its own weight the middle of mass sinks by sigma g L^2 / (3 Y), Y = 150 N/m. A strip of 8 squares has 9 links
  // across, and its pinned edge cannot grow narrow: 10 to 15 % stiffer.
  const double sinks = 0.150 * 9.81 * 0.48 * 0.48 / (3 * 150);
  EXPECT_LT(-0.24 - middle, sinks);
  EXPECT_GT(-0.24 - middle, 0.85 * sinks);
}

TEST(Fit, SaysWhatTheDataCannotTell) {
  const Json fit = fitOf("time_s,water_kg_kg\n0,0.7\n500,0.601\n1000,0.499\n1500,0.4\n2000,0.302\n", "drying");
  const Json& critical = fit.at("parameters")[2];
  EXPECT_EQ(critical.at("is_told"), false);
  EXPECT_FALSE(critical.contains("standard_error"));
  EXPECT_NE(critical.at("remark").get<std::string>().find("cannot tell"), std::string::npos);
}

TEST(Fit, TellsNoShareOfARangeThatIsNone) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", "load_n_m,strain\n10,0.01\n10,0.01\n");
  const Outcome outcome = runWetcloth({"fit", file, "--of", "stretch"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("root mean square 0\n"), std::string::npos) << outcome.out;
}

TEST(Fit, RefusesBadUsageAndBadData) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("data.csv", "time_s,water_kg_kg\n0,0\n1,wet\n2,1\n");
  expectRefusal(runWetcloth({"fit", file, "--of", "absorption"}), {"line 3, column 2 (water_kg_kg)", "\"wet\""});
  expectRefusal(runWetcloth({"fit", file, "--of", "absorbtion"}), {"--of", "\"absorption\""});
  expectRefusal(runWetcloth({"fit", file}), {"--of"});
  expectRefusal(runWetcloth({"fit", "--of", "drying"}), {"DATA.csv"});
  expectRefusal(runWetcloth({"fit", file, "--of", "drying", "--fabric", "coton"}), {"--fabric", "\"cotton\""});
  expectRefusal(runWetcloth({"fit", "/nowhere.csv", "--of", "drying"}), {"/nowhere.csv", "no such file"});
  const std::string good = directory.write("good.csv", soaking());
  expectRefusal(runWetcloth({"fit", good, "--of", "absorption", "--out", good}), {"--out", "must be a directory"});
}

}  // namespace
}  // namespace wetcloth_test::fit_test
