// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace wetcloth_test::command_bad_input_test {
namespace {

using namespace cli;

struct BadScene {
  std::string name;
  std::function<void(Json&)> spoil;
  std::vector<std::string> words;  ///< that the complaint must have: pointer, value, what is allowed
};

std::ostream& operator<<(std::ostream& stream, const BadScene& bad) { return stream << bad.name; }

Json& cloth(Json& scene) { return scene["cloths"][0]; }
Json& fabric(Json& scene) { return cloth(scene)["fabric"]; }
Json& effects(Json& scene) { return cloth(scene)["effects"]; }

/// A value put at a pointer; the complaint must name both.
BadScene at(const std::string& name, const std::string& pointer, const Json& value, std::vector<std::string> words) {
  words.push_back(pointer);
  words.push_back(value.dump());
  return {name, [=](Json& scene) { scene[Json::json_pointer(pointer)] = value; }, words};
}

/// Bullet's solver would stop, and leave the cloth hanging in the air.
BadScene besideASpring(const std::string& key) {
  return {"MassesLostBeside_" + key,
          [key](Json& scene) {
            scene["world"] = "deformable";
            effects(scene).erase("hooke_springs");
            cloth(scene)[key] = 1e19;
          },
          {"/cloths/0", "\"" + key + "\" = 1e+19", "mass", "hooke_springs"}};
}

std::vector<BadScene> badScenes() {
  return {
      at("KeyWithATypo", "/duraton_s", 5, {"unknown key", "\"duration_s\""}),
      at("GravityInCentimetres", "/gravity_cm_s2", {0, -981, 0}, {"unknown key", "\"gravity_m_s2\""}),
      at("StepInMilliseconds", "/step_ms", 16, {"unknown key", "\"step_s\""}),
      at("DensityInGrams", "/cloths/0/fabric/areal_density_g_m2", 150, {"\"areal_density_kg_m2\""}),
      at("EffectWithATypo", "/cloths/0/effects/absorbtion", Json::object(), {"\"absorption\""}),
      at("KeyWithASlash", "/a~1b", 1, {"unknown key"}),
      at("NumberAsText", "/step_s", "0.01", {"must be a number"}),
      at("ObjectAsNumber", "/cloths/0/patch", 5, {"must be an object"}),
      at("ListAsObject", "/cloths", Json::object(), {"must be an array"}),
      at("NoCloth", "/cloths", Json::array(), {"at least one cloth"}),
      at("VectorOfTwo", "/gravity_m_s2", {0, -9.81}, {"array of three numbers"}),
      at("NumberThatFloat32CannotHold", "/gravity_m_s2/1", 1e300, {"[-1e8, 1e8]"}),
      at("WindFasterThanAnyIs", "/cloths/0/effects/wind/velocity_m_s/0", 1e15, {"[-1e6, 1e6]"}),
      {"PatchFartherThanBulletBears",
       [](Json& scene) {
         cloth(scene)["patch"]["origin_m"] = {0, 9e7, 9e7};
         cloth(scene)["patch"]["edge_u_m"] = {1e4, 0, 0};  // which numbers there can tell apart
         cloth(scene)["patch"]["edge_v_m"] = {0, 0, 1e4};
       },
       {"/cloths/0", "within 1e8 m of 0"}},

      at("StepOfZero", "/step_s", 0, {"(0, 1]"}),
      at("StepNegative", "/step_s", -0.01, {"(0, 1]"}),
      at("StepOfTenSeconds", "/step_s", 10, {"(0, 1]"}),
      at("NoSubsteps", "/substeps", 0, {"whole number"}),
      at("HalfASubstep", "/substeps", 1.5, {"whole number"}),
      at("NoIterations", "/iterations", 0, {"whole number"}),
      at("NoDuration", "/duration_s", 0, {"> 0"}),
      at("UnknownWorld", "/world", "soft_ridig", {"\"soft_rigid\"", "soft_multibody", "deformable"}),
      at("UnknownPrecision", "/precision", "float16", {"float32", "float64"}),
      at("ImplicitOutsideTheDeformableWorld", "/implicit", true, {"deformable"}),
      at("ImplicitAsNumber", "/implicit", 1, {"true or false"}),
      at("UnknownSolver", "/solver", "wetcloht", {"\"wetcloth\"", "bullet"}),
      at("SolverAsNumber", "/solver", 10, {"\"bullet\"", "\"wetcloth\"", "object"}),
      at("SolverAsList", "/solver", {"wetcloth"}, {"\"bullet\"", "\"wetcloth\"", "object"}),
      at("SolverOfNull", "/solver", nullptr, {"\"bullet\"", "\"wetcloth\"", "object"}),
      at("SolverWithATypo", "/solver/smal_steps", 5, {"unknown key", "\"small_steps\""}),
      at("NoSmallSteps", "/solver/small_steps", 0, {"whole number", "1 to 1000"}),
      at("TooManySmallSteps", "/solver/small_steps", 1001, {"whole number", "1 to 1000"}),
      at("HalfASmallStep", "/solver/small_steps", 2.5, {"whole number"}),
      at("SolverStiffnessZero", "/solver/stiffness_n_m", 0, {"> 0"}),
      at("SolverStiffnessNegative", "/solver/stiffness_n_m", -5, {"> 0"}),
      at("SolverStiffnessAsText", "/solver/stiffness_n_m", "hard", {"must be a number"}),
      {"SolverInTheDeformableWorld",
       [](Json& scene) {
         scene["world"] = "deformable";
         scene["solver"] = "wetcloth";
       },
       {"/solver = \"wetcloth\"", "\"bullet\"", "deformable"}},
      {"SolverWithNumbersInTheDeformableWorld",
       [](Json& scene) {
         scene["world"] = "deformable";
         scene["solver"] = {{"small_steps", 5}};
       },
       {"/solver = {\"small_steps\":5}", "\"bullet\"", "deformable"}},
      at("DensityZero", "/cloths/0/fabric/areal_density_kg_m2", 0, {"> 0"}),
      at("DensityNegative", "/cloths/0/fabric/areal_density_kg_m2", -0.15, {"> 0"}),
      at("CapacityZero", "/cloths/0/fabric/capacity_kg_per_kg", 0, {"> 0"}),
      at("CapacityNegative", "/cloths/0/fabric/capacity_kg_per_kg", -1, {"> 0"}),
      at("TimeConstantZero", "/cloths/0/fabric/time_constant_s", 0, {"> 0"}),
      at("TimeConstantNegative", "/cloths/0/fabric/time_constant_s", -8.8, {"> 0"}),
      {"ColourInBytes",
       [](Json& scene) {
         fabric(scene)["colour"] = {0.1, 0.1, 255};
       },
       {"/cloths/0/fabric/colour/2 = 255", "[0, 1]"}},
      at("UnknownPreset", "/cloths/0/fabric", "coton", {"\"cotton\"", "coarse_wool"}),
      at("SaturationAboveOne", "/cloths/0/initial_saturation", 1.5, {"[0, 1]"}),
      at("ExposureAboveOne", "/cloths/0/effects/absorption/exposure", 1.5, {"[0, 1]"}),
      at("ExposureNegative", "/cloths/0/effects/absorption/exposure", -0.5, {"[0, 1]"}),
      at("ExposureOfTwoNodes", "/cloths/0/effects/absorption/exposure", {0, 1}, {"one value per node", "20"}),
      at("UnknownLaw", "/cloths/0/effects/wind/law", "cubic", {"quadratic", "linear", "paper"}),
      at("UnknownMode", "/cloths/0/effects/wind/mode", "papre", {"\"paper\""}),
      at("AirNegative", "/cloths/0/effects/wind/air_density_kg_m3", -1.2, {">= 0"}),
      at("SpringsZero", "/cloths/0/effects/hooke_springs/stiffness_n_m", 0, {"> 0"}),
      at("OneColumn", "/cloths/0/patch/columns", 1, {"whole number"}),
      at("ParallelEdges", "/cloths/0/patch/edge_v_m", {2, 0, 0}, {"parallel"}),
      at("UnknownCorner", "/cloths/0/pins/corners/0", "top_lefft", {"\"top_left\""}),
      at("PinnedNodeTooHigh", "/cloths/0/pins/nodes/0", 20, {"0 to 19"}),
      at("SpringsOutsideTheDeformableWorld", "/cloths/0/spring_stiffness_n_m", 10, {"deformable"}),
      besideASpring("spring_stiffness_n_m"),
      besideASpring("bending_stiffness_n_m"),
      besideASpring("spring_damping_n_s_m"),
      at("RadiusZero", "/colliders/0/sphere/radius_m", 0, {"> 0"}),
      at("ColliderWithoutKind", "/colliders/0", Json::object(), {"plane, box, sphere"}),
      {"ColliderLargerThanAnythingIs",
       [](Json& scene) { scene["colliders"][0]["sphere"]["radius_m"] = 1e10; },
       {"/colliders/0 = ", "within 1e8 m"}},
      {"ColliderThatFliesFarAway",
       [](Json& scene) {
         scene["colliders"][0]["motion"] = {{"times_s", {0, 1}}, {"offsets_m", {{0, 0, 0}, {9e7, 9e7, 0}}}};
       },
       {"/colliders/0 = ", "within 1e8 m"}},
      at("NormalOfLengthZero", "/colliders/1/plane/normal", {0, 0, 0}, {"of a length in"}),
      {"NoWorld", [](Json& scene) { scene.erase("world"); }, {"\"world\" is missing"}},
      {"NoFabric", [](Json& scene) { cloth(scene).erase("fabric"); }, {"/cloths/0", "\"fabric\" is missing"}},
      {"NoCapacity", [](Json& scene) { fabric(scene).erase("capacity_kg_per_kg"); }, {"capacity_kg_per_kg"}},
      {"NeitherPatchNorMesh", [](Json& scene) { cloth(scene).erase("patch"); }, {"/cloths/0", "patch, obj", "none"}},
      {"PatchAndMesh", [](Json& scene) { cloth(scene)["obj"] = "a.obj"; }, {"/cloths/0", "exactly one"}},
      {"WindAndGust",
       [](Json& scene) { effects(scene)["wind"]["gust"] = Json::object(); },
       {"/cloths/0/effects/wind", "exactly one", "velocity_m_s, gust"}},
      {"GustWithoutPeriod",
       [](Json& scene) {
         effects(scene)["wind"] = {{"gust", {{"mean_m_s", {1, 0, 0}}, {"amplitude_m_s", {0, 0, 1}}}}};
       },
       {"/cloths/0/effects/wind/gust", "\"period_s\" is missing"}},
  };
}

using BadSceneTest = testing::TestWithParam<BadScene>;

struct BadMesh {
  std::string name;
  std::string text;
  std::vector<std::string> words;
};

const char* const square = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n";

std::vector<BadMesh> badMeshes() {
  return {{"missing", "", {"no such file"}},
          {"empty", " \n", {"is empty"}},
          {"no vertices", "# nothing\n", {"no vertices"}},
          {"no faces", square, {"no faces"}},
          {"index too high", std::string(square) + "f 1 2 9\n", {"line 5", "\"9\"", "1 to 4"}},
          {"index zero", std::string(square) + "f 0 1 2\n", {"line 5", "\"0\"", "1 to 4"}},
          {"index too negative", std::string(square) + "f -5 1 2\n", {"line 5", "\"-5\""}},
          {"index not a number", std::string(square) + "f a 1 2\n", {"line 5", "\"a\""}},
          {"two corners", std::string(square) + "f 1 2\n", {"line 5", "3 corners"}},
          {"corner twice", std::string(square) + "f 1 2 2\n", {"line 5", "same corner"}},
          {"vertex not a number", "v 0 zero 0\n", {"line 1", "\"zero\""}},
          {"vertex not finite", "v 0 nan 0\n", {"line 1", "\"nan\""}},
          {"vertex without a face", std::string(square) + "f 1 2 3\n", {"vertex 4", "face"}},
          {"faces without area", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", {"area"}}};
}

TEST_P(BadSceneTest, IsRefusedInOneLine) {
  Json scene = smallScene();
  GetParam().spoil(scene);
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  std::vector<std::string> words = GetParam().words;
  words.push_back(file);
  expectRefusal(runWetcloth({"validate", file}), words);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BadSceneTest, testing::ValuesIn(badScenes()),
                         [](const auto& tested) { return tested.param.name; });

TEST(CommandBadInput, TheSceneItselfIsGood) {
  const TemporaryDirectory directory;
  EXPECT_EQ(runWetcloth({"validate", directory.write("scene.json", smallScene().dump())}).status, 0);
}

TEST(CommandBadInput, FilesThatAreNoScenes) {
  const TemporaryDirectory directory;
  for (const char* command : {"run", "validate"}) {
    expectRefusal(runWetcloth({command, directory.path("none.json")}), {directory.path("none.json"), "no such file"});
    expectRefusal(runWetcloth({command, directory.path("")}), {directory.path(""), "directory"});
    const std::string empty = directory.write("empty.json", "");
    expectRefusal(runWetcloth({command, empty}), {empty, "is empty"});
    const std::string broken = directory.write("broken.json", "{\n  \"world\": soft_rigid\n}\n");
    expectRefusal(runWetcloth({command, broken}), {broken, "not JSON", "line 2, column 12"});
    const std::string nan = directory.write("nan.json", "{\"step_s\": NaN}");
    expectRefusal(runWetcloth({command, nan}), {nan, "not JSON", "line 1, column 12"});
    const std::string huge = directory.write("huge.json", "{\"step_s\": 1e999}");
    expectRefusal(runWetcloth({command, huge}), {huge, "1e999", "finite"});
    const std::string twice = directory.write("twice.json", "{\"step_s\": 0.01, \"step_s\": 0.02}");
    expectRefusal(runWetcloth({command, twice}), {twice, "\"step_s\"", "twice"});
    const std::string list = directory.write("list.json", "[]");
    expectRefusal(runWetcloth({command, list}), {list, "must be an object"});
  }
}

TEST(CommandBadInput, MeshesThatAreNoCloth) {
  for (const BadMesh& mesh : badMeshes()) {
    SCOPED_TRACE(mesh.name);
    const TemporaryDirectory directory;
    if (mesh.name != "missing") directory.write("mesh.obj", mesh.text);
    Json scene = smallScene();
    cloth(scene).erase("patch");
    cloth(scene)["obj"] = "mesh.obj";
    const std::string file = directory.write("scene.json", scene.dump());
    std::vector<std::string> words = mesh.words;
    words.insert(words.end(), {file, "/cloths/0/obj", "\"mesh.obj\""});
    expectRefusal(runWetcloth({"validate", file}), words);
  }
}

TEST(CommandBadInput, TargetsThatCannotBeWritten) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  expectRefusal(runWetcloth({"run", file, "--json", "/dev/null/result.json"}), {"--json", "/dev/null/result.json"});
  expectRefusal(runWetcloth({"run", file, "--json", directory.path("")}), {"--json", directory.path("")});
  expectRefusal(runWetcloth({"run", file, "--frames", "/dev/null/frames"}), {"--frames", "/dev/null/frames"});
  expectRefusal(runWetcloth({"fall", "--height", "0.01", "--json", "/dev/null/result.json"}), {"--json"});
}

TEST(CommandBadInput, Usage) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", smallScene().dump());
  expectRefusal(runWetcloth({}), {"run", "fall", "validate"});
  expectRefusal(runWetcloth({"rum", file}), {"\"rum\"", "\"run\""});
  expectRefusal(runWetcloth({"run"}), {"scene"});
  expectRefusal(runWetcloth({"run", file, "--no-such-option"}), {"--no-such-option"});
  expectRefusal(runWetcloth({"run", file, "--quality", "acurate"}), {"--quality", "\"acurate\"", "\"accurate\""});
  expectRefusal(runWetcloth({"run", file, "--duration", "-1"}), {"--duration", "-1"});
  expectRefusal(runWetcloth({"run", file, "--duration", "nan"}), {"--duration", "nan"});
  expectRefusal(runWetcloth({"run", file, "--frames", directory.path("f"), "--frame-count", "0"}),
                {"--frame-count", "0"});
  expectRefusal(runWetcloth({"run", file, "--frame-count", "5"}), {"--frame-count", "--frames"});
  for (const char* typo : {"--qualty", "--qualty=draft"}) {
    expectRefusal(runWetcloth({"run", file, typo}), {"unknown option \"--qualty\"", "\"--quality\""});
  }
  expectRefusal(runWetcloth({"validate", file, "--json", "-"}), {"unknown option \"--json\""});
  expectRefusal(runWetcloth({"fall", "--mode", "vacuum"}), {"--mode", "\"vacuum\"", "paper, physical"});
  expectRefusal(runWetcloth({"fall", "--world", "flat"}), {"--world", "\"flat\"", "deformable"});
  for (const char* height : {"0", "-1", "nan", "inf", "1e9", "high"}) {
    expectRefusal(runWetcloth({"fall", "--height", height}), {"--height"});
  }
}

}  // namespace
}  // namespace wetcloth_test::command_bad_input_test
