// SPDX-License-Identifier: Zlib
// `wetcloth plot`: the numbers in the tables, the pictures, and what is refused.

#include "tests/command/Command.h"
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace wetcloth_test::plot_test {
namespace {

using namespace cli;
namespace fs = std::filesystem;

std::string contents(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

using Curve = std::vector<std::pair<double, double>>;

struct Table {
  std::string head;
  std::map<std::string, Curve> curves;
};

Table readTable(const std::string& file) {
  Table table;
  std::ifstream stream(file);
  std::getline(stream, table.head);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    std::string name, x, y;
    std::getline(fields, name, ';');
    std::getline(fields, x, ';');
    std::getline(fields, y, ';');
    table.curves[name].emplace_back(std::stod(x), std::stod(y));
  }
  return table;
}

double at(const Curve& curve, double x) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].first < x) continue;
    const auto& [x0, y0] = curve[i - 1];
    const auto& [x1, y1] = curve[i];
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
  }
  return curve.back().second;
}

bool hasGnuplot() { return runProgram({"gnuplot", "--version"}).status == 0; }

/// With a PATH of one directory, that has a program named gnuplot in it or none.
Outcome runWithGnuplot(const std::string& script, const std::vector<std::string>& arguments) {
  const TemporaryDirectory tools;
  if (!script.empty()) {
    fs::permissions(tools.write("gnuplot", "#!/bin/sh\n" + script + "\n"), fs::perms::owner_all);
  }
  const ChangedVariable path("PATH", tools.path(""));
  return runWetcloth(arguments);
}

std::vector<std::string> filesIn(const std::string& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Table tableOf(const std::string& plot, const std::string& file) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWithGnuplot("", {"plot", plot, "--out", directory.path("plots")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return readTable(directory.path("plots/" + file + ".csv"));
}

TEST(Plot, MassIsTableIIInPaperModeAndEquation2InPhysicalMode) {
  const Table table = tableOf("mass", "mass");
  EXPECT_EQ(table.head, "series;time_s;mass_g");
  const Curve& paper = table.curves.at("Table II");
  const double printed[] = {0.01, 0.093, 0.176, 0.259, 0.342, 0.425, 0.508, 0.591, 0.674, 0.757, 0.84};
  ASSERT_EQ(paper.size(), std::size(printed));
  for (int second = 0; second <= 10; ++second) {
    EXPECT_NEAR(paper[std::size_t(second)].second, printed[second], 1e-12);
    EXPECT_NEAR(at(table.curves.at("ours, paper mode"), second), printed[second], 1e-5) << second;
  }
  EXPECT_NEAR(table.curves.at("ours, paper mode").back().second, 0.84, 1e-5);
  for (const char* const name : {"ours, physical mode", "Eq. 2"}) {
    for (const auto& [time, grams] : table.curves.at(name)) {
      EXPECT_NEAR(grams, 0.01 * (1 + 0.84 * (1 - std::exp(-time / 8.844))), 1e-7) << name << ' ' << time;
    }
  }
}

TEST(Plot, FallsFollowTheirClosedForms) {
  const TemporaryDirectory directory;
  ASSERT_EQ(runWithGnuplot("", {"plot", "fall", "--out", directory.path("p")}).status, 0);
  const Table paper = readTable(directory.path("p/fall_paper.csv"));
  const Table physical = readTable(directory.path("p/fall_physical.csv"));
  EXPECT_EQ(paper.head, "series;time_s;height_m");
  const double g = 9.81;
  for (const auto& [table, height] : {std::pair(&paper, 19.62), std::pair(&physical, 5.5)}) {
    for (const auto& [time, left] : table->curves.at("bullet")) {
      // Bullet's symplectic Euler falls g t dt / 2 further.
      EXPECT_NEAR(left, height - g * time * time / 2, g * time / 480 + 1e-3) << time;
    }
    for (const auto& [name, curve] : table->curves) {
      EXPECT_NEAR(curve.front().second, height, 1e-6) << name;
      if (name.rfind("closed form", 0) == 0) {
        EXPECT_NEAR(curve.back().second, 0, 1e-6) << name;
        continue;
      }
      for (const auto& [time, left] : curve) {
        EXPECT_NEAR(left, at(table->curves.at("closed form, " + name), time), 0.05) << name << ' ' << time;
      }
    }
  }
  EXPECT_NEAR(paper.curves.at("closed form, dry").back().first, 4.00, 0.01);
  EXPECT_NEAR(paper.curves.at("closed form, saturated").back().first, 2.01, 0.01);
  EXPECT_NEAR(physical.curves.at("closed form, saturated").back().first, 3.00, 0.01);
  const double tau = 0.585;
  EXPECT_NEAR(at(paper.curves.at("closed form, dry"), 2), 19.62 - g * tau * (2 - tau * (1 - std::exp(-2 / tau))), 1e-3);
}

TEST(Plot, FramesPerSecondOfTheDryAndTheFourWetFalls) {
  const Table table = tableOf("fps", "fps");
  EXPECT_EQ(table.head, "series;time_s;frames_per_s");
  ASSERT_EQ(table.curves.size(), 5u);
  for (const char* const name : {"dry", "0.093 g", "0.342 g", "0.591 g", "0.84 g"}) {
    const Curve& curve = table.curves.at(name);
    EXPECT_GE(curve.size(), 5u) << name;
    for (const auto& [time, fps] : curve) EXPECT_GT(fps, 0) << name << ' ' << time;
    testing::Test::RecordProperty(std::string("fps ") + name, std::to_string(at(curve, 1)));
  }
  EXPECT_NEAR(table.curves.at("dry").back().first, 4, 0.3);
  EXPECT_NEAR(table.curves.at("0.84 g").back().first, 2, 0.3);
}

TEST(Plot, TheStripWicksToItsEquilibriumAndItsFrontAsTheSquareRootOfTime) {
  const TemporaryDirectory directory;
  ASSERT_EQ(runWithGnuplot("", {"plot", "wicking", "--out", directory.path("p")}).status, 0);
  const Table profile = readTable(directory.path("p/wicking.csv"));
  EXPECT_EQ(profile.head, "series;height_mm;saturation");
  const Curve& late = profile.curves.at("28800 s");
  for (const auto& [height, saturation] : late) {
    if (height < 0 || height > 100) continue;                          // higher up, eight hours are too few
    EXPECT_NEAR(saturation, std::exp(-height / 100), 0.02) << height;  // D / v = 0.1 m
  }
  for (const double height : {20.0, 80.0, 150.0}) {
    double before = 0;
    for (const char* const time : {"60 s", "300 s", "1200 s", "5400 s", "28800 s"}) {
      const double now = at(profile.curves.at(time), height);
      EXPECT_GE(now, before) << time << ' ' << height;
      before = now;
    }
  }
  const Table front = readTable(directory.path("p/wicking_front.csv"));
  const Curve& free = front.curves.at("without gravity");
  // The end must soak first, so the front is late and makes up for it.
  EXPECT_NEAR(at(free, 4000) / at(free, 1000), 2, 0.15);
  EXPECT_NEAR(at(free, 5000) / at(front.curves.at("Washburn"), 5000), 1, 0.06);
  EXPECT_LT(at(front.curves.at("upright"), 4000), at(free, 4000));
}

TEST(Plot, SpringsAreThePapersOfItsThreeKinds) {
  const TemporaryDirectory directory;
  ASSERT_EQ(runWithGnuplot("", {"plot", "springs", "--out", directory.path("p")}).status, 0);
  const Table table = readTable(directory.path("p/springs.csv"));
  const auto gaps = [&](const char* name) {
    const Curve& curve = table.curves.at(name);
    return std::count_if(curve.begin(), curve.end(), [](const auto& point) { return std::isnan(point.first); });
  };
  EXPECT_EQ(gaps("mechanical"), 2 * 6 * 7);
  EXPECT_EQ(gaps("shear"), 2 * 6 * 6);
  EXPECT_EQ(gaps("flexion"), 2 * 5 * 7);
  EXPECT_EQ(table.curves.at("masses").size(), 49u);
}

TEST(Plot, DrawsSvgAndPngWithAxesUnitsAndLegend) {
  if (!hasGnuplot()) GTEST_SKIP() << "there is no gnuplot (Debian: gnuplot-nox)";
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"plot", "mass", "--out", directory.path("new/plots"), "--json", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(filesIn(directory.path("new/plots")), (std::vector<std::string>{"mass.csv", "mass.png", "mass.svg"}));
  const Json result = Json::parse(outcome.out);
  EXPECT_TRUE(result.at("pictures").get<bool>());
  EXPECT_EQ(result.at("plots").at(0).at("files").size(), 3u);
  EXPECT_EQ(contents(directory.path("new/plots/mass.png")).substr(1, 3), "PNG");
  const std::string svg = contents(directory.path("new/plots/mass.svg"));
  for (const char* const text : {"time [s]", "mass of a node [g]", "Table II", "Eq. 2", "ours, paper mode", "</svg>"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(Plot, WithoutGnuplotThereAreTablesAndOneLineSaysWhy) {
  // By its status 127 a system may say at its end only that a program was never there (POSIX, posix_spawn).
  for (const char* const script : {"", "exit 127"}) {
    const TemporaryDirectory directory;
    const Outcome outcome = runWithGnuplot(script, {"plot", "mass", "--out", directory.path("p"), "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << script;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("gnuplot-nox"), std::string::npos) << outcome.err;
    EXPECT_EQ(filesIn(directory.path("p")), std::vector<std::string>{"mass.csv"}) << script;
    EXPECT_FALSE(Json::parse(outcome.out).at("pictures").get<bool>());
  }
}

#ifndef _WIN32  // where no gnuplot is started
TEST(Plot, AGnuplotThatFailsIsOneLineAndLeavesNoPicture) {
  for (const char* const script :
       {"echo 'line 3: no such terminal' >&2; exit 3", "echo half >$0.svg; kill -9 $$", "exit 0"}) {
    const TemporaryDirectory directory;
    const Outcome outcome = runWithGnuplot(script, {"plot", "mass", "--out", directory.path("p")});
    EXPECT_EQ(outcome.status, 1) << script;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(filesIn(directory.path("p")), std::vector<std::string>{"mass.csv"}) << script;
  }
  const TemporaryDirectory directory;
  const Outcome outcome =
      runWithGnuplot("echo 'line 3: no such terminal' >&2; exit 3", {"plot", "mass", "--out", directory.path("p")});
  EXPECT_NE(outcome.err.find("line 3: no such terminal"), std::string::npos) << outcome.err;
}

TEST(Plot, AnOldPictureOutlivesAGnuplotThatFails) {
  const TemporaryDirectory directory;
  directory.write("mass.svg", "old");
  EXPECT_EQ(runWithGnuplot("exit 1", {"plot", "mass", "--out", directory.path("")}).status, 1);
  EXPECT_EQ(contents(directory.path("mass.svg")), "old");
}
#endif

TEST(Plot, UnknownNamesAreAnsweredWithTheNearest) {
  const TemporaryDirectory directory;
  expectRefusal(runWetcloth({"plot", "wiking", "--out", directory.path("p")}),
                {"NAME = \"wiking\"", "did you mean \"wicking\"?", "mass, fall, fps, wicking, springs, all"});
  expectRefusal(runWetcloth({"plot", "mass"}), {"--out", "required"});
}

TEST(Plot, FoldersThatCannotBeWrittenAreRefused) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("file", "text");
  expectRefusal(runWetcloth({"plot", "mass", "--out", file}), {"--out = \"" + file + "\"", "directory"});
  expectRefusal(runWetcloth({"plot", "mass", "--out", file + "/below"}), {"--out", "directory"});
  expectRefusal(runWetcloth({"plot", "mass", "--out", "/proc/plots"}), {"--out = \"/proc/plots\"", "directory"});
}

TEST(Plot, AFolderInTheWayOfATableIsARunThatFailed) {
  const TemporaryDirectory directory;
  fs::create_directories(directory.path("p/mass.csv/below"));
  const Outcome outcome = runWithGnuplot("", {"plot", "mass", "--out", directory.path("p")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("mass.csv\": could not be written"), std::string::npos) << outcome.err;
  EXPECT_EQ(filesIn(directory.path("p")), std::vector<std::string>{"mass.csv"});
}

}  // namespace
}  // namespace wetcloth_test::plot_test
