// SPDX-License-Identifier: Zlib
// The table of `wetcloth stability`: every case in every world at one step, and what the naive methods come to. The
// other steps are the command's business.

#include "command/stability/StabilityTable.h"
#include "bullet_wetcloth/bullet/Versions.h"
#include "command/cli/Errors.h"
#include "command/stability/CaseRun.h"
#include "command/stability/CaseScene.h"
#include "command/stability/SceneMeter.h"
#include "command/stability/StabilityRun.h"
#include "command/stability/StoredOutcomes.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace wetcloth_test::stability_table_test {
namespace {

constexpr double kStabilityStep = 1. / 60;

const stability::HardCase& hardCaseNamed(const std::string& name) {
  for (const stability::HardCase& hardCase : stability::stabilityTable()) {
    if (hardCase.name == name) return hardCase;
  }
  throw std::logic_error("no case " + name);
}

using StabilityTable = testing::TestWithParam<std::string>;

const stability::StoredOutcomes& storedOutcomes() {
  static const stability::StoredOutcomes outcomes = stability::StoredOutcomes::read(
      WETCLOTH_SOURCE_DIR "/tests/hard_cases/outcomes_" + command::nameOf(command::ownPrecision) + ".txt");
  return outcomes;
}

// Where a bound does not hold, Bullet alone must fail it, too; and what is known to hold must hold.
TEST_P(StabilityTable, NoBoundFailsThatPlainBulletHoldsOrThatIsKnownToHold) {
  const stability::HardCase& hardCase = hardCaseNamed(GetParam());
  for (const stability::World world : hardCase.worlds) {
    // Other than the deformable ones, the two differ in their solver of rigid bodies alone.
    if (world == stability::World::softMultiBody && hardCase.group != "contacts") continue;
    const stability::CaseResult result = stability::tryCase(hardCase, world, kStabilityStep, stability::Effort::quick,
                                                            stability::Comparisons::whereNeeded);
    EXPECT_NE(result.verdict(), stability::CaseResult::Verdict::fails)
        << nameOf(world) << ": " << result.ours.nearest().bound << " " << result.ours.nearest().ratio;
    EXPECT_EQ(storedOutcomes().complaintAbout(result), "");
  }
}

std::vector<std::string> casesOfTheTest() {
  std::vector<std::string> names = stability::caseNames();
  // Its time scales and steps are those of the hour, which has a test of its own.
  names.erase(std::remove(names.begin(), names.end(), "laundry_2_minutes"), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(, StabilityTable, testing::ValuesIn(casesOfTheTest()), [](const auto& test) {
  std::string name = test.param;
  for (char& character : name) {
    if (std::isalnum(static_cast<unsigned char>(character)) == 0) character = '_';
  }
  return name;
});

TEST(StabilityCases, AllThatWasAskedForIsThere) {
  const std::vector<std::string> names = stability::caseNames();
  const std::set<std::string> present(names.begin(), names.end());
  EXPECT_EQ(present.size(), names.size()) << "names are unique";
  for (const char* const name : {"mass_1e-6_kg",
                                 "mass_10_kg",
                                 "neighbours_1e4",
                                 "one_wet_node",
                                 "wet_in_one_step",
                                 "dry_in_one_step",
                                 "dries_to_its_dry_mass",
                                 "cycles_1e4",
                                 "wind_0",
                                 "wind_200",
                                 "wind_reversing",
                                 "wind_along_the_plane",
                                 "wind_edge_on",
                                 "wind_on_crumpled_cloth",
                                 "zero_area_and_needles",
                                 "duplicate_nodes",
                                 "lone_triangle",
                                 "strip_one_cell_wide",
                                 "non_manifold_edges",
                                 "obtuse_mesh",
                                 "flipped_faces",
                                 "cloth_1_mm",
                                 "cloth_100_m",
                                 "pinned_everywhere",
                                 "pinned_nowhere",
                                 "pinned_at_one_node",
                                 "moving_pins",
                                 "spinning_sphere",
                                 "through_a_gap",
                                 "pinched",
                                 "under_50_times_its_weight",
                                 "cloth_on_cloth",
                                 "steps_that_vary",
                                 "pauses",
                                 "hitches_of_10_s",
                                 "time_scale_changes",
                                 "time_scale_0",
                                 "gravity_off_and_reversed",
                                 "effects_added_and_removed",
                                 "body_removed_and_put_back",
                                 "worlds_in_any_order",
                                 "cubic_coplanar",
                                 "cubic_double_roots",
                                 "cubic_roots_at_0_and_1",
                                 "cubic_tiny_coordinates",
                                 "cubic_huge_coordinates",
                                 "wrung_two_turns",
                                 "corner_through_a_loop",
                                 "layers_at_rest",
                                 "thrown_at_itself_30_m_s",
                                 "dropped_on_its_edge",
                                 "thickness_0",
                                 "thickness_above_an_edge",
                                 "laundry_1_hour"}) {
    EXPECT_EQ(present.count(name), 1U) << name;
  }
  EXPECT_EQ(stability::combinationsOf({"wind_50", "", {}, {}, stability::Effort::full}).size(), 5U * 5U)
      << "every world, every step";
}

// An hour of it at 1/60 s in one world; the command runs all of them.
TEST(StabilityCases, AnHourOfLaundry) {
  const stability::CaseMeter meter = stability::runCase(hardCaseNamed("laundry_1_hour"), stability::World::softRigid,
                                                        stability::Way::ours, kStabilityStep);
  EXPECT_TRUE(meter.holds()) << meter.nearest().bound << " " << meter.nearest().ratio;
  EXPECT_GT(meter.marginOf("speed"), 0.01) << "it did move";
  EXPECT_GT(meter.marginOf("ledger"), 0) << "and got wet";
}

// --- the naive methods -----------------------------------------------------------------------------------------

struct NaiveMethod {
  const char* hardCase;
  const char* name;
  const char* bound;  ///< that it fails; empty: any
};

using StabilityOfNaiveMethods = testing::TestWithParam<NaiveMethod>;

TEST_P(StabilityOfNaiveMethods, FailsWhereOursHolds) {
  const stability::HardCase& hardCase = hardCaseNamed(GetParam().hardCase);
  const stability::World world = hardCase.worlds.front();
  EXPECT_EQ(hardCase.naiveMethod, GetParam().name);
  EXPECT_TRUE(stability::runCase(hardCase, world, stability::Way::ours, kStabilityStep).holds());
  const stability::CaseMeter naive = stability::runCase(hardCase, world, stability::Way::naive, kStabilityStep);
  EXPECT_FALSE(naive.holds());
  if (GetParam().bound[0] != '\0') {
    EXPECT_GT(naive.marginOf(GetParam().bound), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(, StabilityOfNaiveMethods,
                         testing::Values(NaiveMethod{"wet_in_one_step", "setMass in each step", "final stretch"},
                                         // No number in float32, too much energy in float64.
                                         NaiveMethod{"dry_in_one_step", "stale link constants", ""},
                                         NaiveMethod{"soaks_in_flight", "mass without momentum", "momentum"},
                                         NaiveMethod{"wind_50", "explicit wind", "speed"},
                                         NaiveMethod{"corner_through_a_loop", "no guard", "passages"}),
                         [](const auto& test) { return std::string(test.param.hardCase); });

TEST(StabilityCases, TheTextbooksCubicMissesContacts) {
  const stability::HardCase& hardCase = hardCaseNamed("cubic_coplanar");
  const stability::CaseMeter textbook = stability::runCase(hardCase, stability::World::none, stability::Way::naive, 0);
  EXPECT_EQ(textbook.marginOf("missed contacts"), HUGE_VAL);
}

// --- what is stored of it -----------------------------------------------------------------------------------------

TEST(StoredOutcomes, AreThereForTheWholeTable) {
  if (!wetcloth::keepsFaceContacts()) GTEST_SKIP() << "this Bullet cannot have them all";
  stability::Selection everything;
  for (const stability::Combination& one : stability::combinationsOf(everything)) {
    stability::CaseResult holds{one.hardCase, one.world, one.step, {}, {}, {}};
    EXPECT_EQ(storedOutcomes().complaintAbout(holds), "");
  }
  EXPECT_EQ(storedOutcomes().count(), stability::combinationsOf(everything).size());
}

TEST(StoredOutcomes, TellWhatIsWorseThanBefore) {
  const stability::HardCase& hardCase = hardCaseNamed("wind_50");
  const auto world = stability::World::softRigid;
  const stability::CaseMeter holds;
  stability::CaseMeter fails;
  fails.compare("speed", 2, 1);
  const stability::CaseResult good{&hardCase, world, kStabilityStep, holds, holds, {}};
  const stability::CaseResult bad{&hardCase, world, kStabilityStep, fails, holds, {}};
  const stability::CaseResult bullets{&hardCase, world, kStabilityStep, fails, fails, {}};
  const cli::TemporaryDirectory directory;
  const auto complaint = [&](const stability::CaseResult& before, const stability::CaseResult& now) {
    const std::string file = directory.write("outcomes.txt", stability::StoredOutcomes({before}).text());
    return stability::StoredOutcomes::read(file).complaintAbout(now);
  };
  EXPECT_EQ(complaint(good, good), "");
  EXPECT_EQ(complaint(good, bullets), "wind_50 in soft_rigid at 1/60 s: bullet_fails, stored: holds");
  EXPECT_EQ(complaint(bullets, bad), "wind_50 in soft_rigid at 1/60 s: fails, stored: bullet_fails");
  EXPECT_EQ(complaint(bullets, bullets), "");
  EXPECT_EQ(complaint(bullets, good), "") << "better is no complaint";
  const stability::CaseResult other{&hardCase, world, 1. / 30, holds, holds, {}};
  EXPECT_EQ(complaint(good, other), "wind_50 in soft_rigid at 1/30 s: not stored");
}

TEST(StoredOutcomes, AFileThatIsNoneIsRefused) {
  const cli::TemporaryDirectory directory;
  for (const char* const text : {"wind_50 soft_rigid 1/60 hold\n", "wind_50 soft_rigid 1/60\n", "wind_50\n",
                                 "wind_50 soft_rigid 1/60 holds 1/60 holds\n"}) {
    const std::string file = directory.write("outcomes.txt", text);
    EXPECT_THROW(stability::StoredOutcomes::read(file), command::InputError) << text;
  }
  EXPECT_THROW(stability::StoredOutcomes::read(directory.path("none.txt")), command::InputError);
}

// --- the table's own measure ------------------------------------------------------------------------------------

/// A free sheet, weightless, whose first node gets a velocity [m/s]; ours and plain Bullet's may differ.
stability::HardCase kicked(double ours, double plain) {
  stability::HardCase hardCase;
  hardCase.worlds = {stability::World::softRigid};
  hardCase.isWeightless = true;
  hardCase.build = [=](stability::CaseScene& scene) {
    wetcloth::ClothPatch patch;
    patch.columns = patch.rows = 4;
    btSoftBody& body = scene.add(patch, 1000);
    scene.wet(body);
    scene.limits.source = 1;
    body.m_nodes[0].m_v.setX(btScalar(scene.isOurs() ? ours : plain));
    return stability::Script{};
  };
  return hardCase;
}

stability::CaseResult::Verdict verdictOf(double ours, double plain) {
  return stability::tryCase(kicked(ours, plain), stability::World::softRigid, kStabilityStep).verdict();
}

TEST(StabilityMeasure, TellsWhoseFaultItIs) {
  using Verdict = stability::CaseResult::Verdict;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdictOf(1, 1), Verdict::holds);
  EXPECT_EQ(verdictOf(1, 1000), Verdict::holds);
  EXPECT_EQ(verdictOf(1000, 1), Verdict::fails);
  EXPECT_EQ(verdictOf(1000, 1000), Verdict::bulletFails);
  EXPECT_EQ(verdictOf(nan, 1), Verdict::fails);
  EXPECT_EQ(verdictOf(nan, 1000), Verdict::fails) << "fast is not the same as not a number";
  EXPECT_EQ(verdictOf(nan, nan), Verdict::bulletFails);
}

TEST(StabilityMeasure, KeepsTheWorstOfEachBound) {
  stability::CaseMeter meter;
  EXPECT_TRUE(meter.holds());
  meter.compare("speed", 1, 4);
  meter.compare("speed", 3, 4);
  meter.compare("energy", 1, 2);
  EXPECT_DOUBLE_EQ(meter.marginOf("speed"), 0.75);
  EXPECT_EQ(meter.nearest().bound, "speed");
  meter.compare("drift", 0, 0);
  EXPECT_TRUE(meter.holds()) << "nothing is allowed, and there is nothing";
  meter.compare("drift", 1e-300, 0);
  EXPECT_EQ(meter.marginOf("drift"), HUGE_VAL);
  meter.compare("energy", std::numeric_limits<double>::quiet_NaN(), 1);
  EXPECT_EQ(meter.marginOf("energy"), HUGE_VAL) << "what is not a number holds no bound";
}

TEST(StabilityMeasure, SeesStretch) {
  stability::HardCase hardCase = kicked(0, 0);
  hardCase.build = [](stability::CaseScene& scene) {
    wetcloth::ClothPatch patch;
    patch.columns = patch.rows = 3;
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
    btSoftBody& body = scene.add(patch, 1000);
    scene.limits.source = 3;
    stability::Script script;
    script.before = [&scene, &body] {
      // Apart by 3 m in each second; the limits know of the speed alone.
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        if (body.m_nodes[i].m_im == 0 && body.m_nodes[i].m_x.x() > 0.5)
          body.m_nodes[i].m_x.setX(1 + 3 * btScalar(scene.time()));
      }
    };
    return script;
  };
  const stability::CaseMeter meter =
      stability::runCase(hardCase, stability::World::softRigid, stability::Way::ours, kStabilityStep);
  EXPECT_GT(meter.marginOf("stretch"), 5) << "4.5 m for links of half a metre, of which half is allowed";
}

}  // namespace
}  // namespace wetcloth_test::stability_table_test
