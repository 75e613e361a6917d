// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include "command/scene/EffectCatalogue.h"
#include "command/scene/SceneKeys.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace wetcloth_test::schema_test {
namespace {

using namespace cli;

const char* const schemaFile = WETCLOTH_SOURCE_DIR "/examples/scenes/scene.schema.json";

const char* const check = R"(
import json, sys
from jsonschema import Draft202012Validator
schema = json.load(open(sys.argv[1]))
Draft202012Validator.check_schema(schema)
for name in sys.argv[2:]:
    for error in Draft202012Validator(schema).iter_errors(json.load(open(name))):
        print(name, error.message.replace("\n", " "))
)";

bool hasJsonSchema() {
  return runProgram({"python3", "-c", "from jsonschema import Draft202012Validator"}).status == 0;
}

/// What the schema has against the files: one line each, nothing when they are right.
std::string complaints(const std::vector<std::string>& files) {
  std::vector<std::string> words{"python3", "-c", check, schemaFile};
  words.insert(words.end(), files.begin(), files.end());
  const Outcome outcome = runProgram(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

/// A start of Python takes longer than a file, so all files are given at once.
void expectComplaintAboutEach(const std::vector<std::string>& files) {
  const std::string lines = "\n" + complaints(files);
  for (const std::string& file : files) {
    EXPECT_NE(lines.find("\n" + file + " "), std::string::npos) << readJson(file) << lines;
  }
}

/// One for each kind of object that a scene has.
std::vector<command::KeyTable> keyTables() {
  std::vector<command::KeyTable> tables;
  for (const command::KeyTable* table : command::keys::all) tables.push_back(*table);
  tables.push_back(command::effectKeys(command::effectCatalogue()));
  for (const command::EffectEntry& entry : command::effectCatalogue()) {
    tables.push_back(entry.keys);
    tables.insert(tables.end(), entry.parts.begin(), entry.parts.end());
  }
  return tables;
}

void expectClosedObjects(const Json& schema, const std::string& where) {
  if (schema.is_object() && schema.contains("properties")) {
    EXPECT_EQ(schema.value("additionalProperties", Json(true)), false) << where;
  }
  if (!schema.is_structured()) return;
  for (const auto& [key, value] : schema.items()) {
    std::string below = where;
    expectClosedObjects(value, below.append("/").append(key));
  }
}

TEST(Schema, HasTheKeysThatTheReaderKnowsAndNoOthers) {
  const Json schema = readJson(schemaFile);
  std::set<std::string> tables;
  for (const command::KeyTable& table : keyTables()) {
    const Json& object = table.name == "scene" ? schema : schema.at("$defs").at(table.name);
    std::set<std::string> inSchema;
    for (const auto& [key, value] : object.at("properties").items()) inSchema.insert(key);
    EXPECT_EQ(inSchema, std::set<std::string>(table.keys.begin(), table.keys.end())) << table.name;
    tables.insert(table.name);
  }
  for (const auto& [name, definition] : schema.at("$defs").items()) {
    EXPECT_EQ(tables.count(name), definition.count("properties")) << name;
  }
}

TEST(Schema, AllowsNoOtherKeysAnywhere) { expectClosedObjects(readJson(schemaFile), ""); }

TEST(Schema, AcceptsEveryScene) {
  if (!hasJsonSchema()) GTEST_SKIP() << "python3 has no jsonschema (Debian: python3-jsonschema)";
  std::vector<std::string> files = sceneFiles();
  files.emplace_back(WETCLOTH_SOURCE_DIR "/tests/scenes/small.json");
  files.emplace_back(WETCLOTH_SOURCE_DIR "/tests/scenes/water_cycle.json");
  files.emplace_back(WETCLOTH_SOURCE_DIR "/examples/scenes/figures/shirt_walking_in_rain.json");
  EXPECT_EQ(complaints(files), "");
}

TEST(Schema, AcceptsEachKindOfSolver) {
  if (!hasJsonSchema()) GTEST_SKIP() << "python3 has no jsonschema (Debian: python3-jsonschema)";
  const TemporaryDirectory directory;
  const auto filesWith = [&](const std::string& name, const std::vector<Json>& solvers) {
    std::vector<std::string> files;
    for (const Json& solver : solvers) {
      Json scene = smallScene();
      scene["solver"] = solver;
      files.push_back(directory.write(name + std::to_string(files.size()) + ".json", scene.dump()));
    }
    return files;
  };
  const Json numbers = {{"small_steps", 10}, {"stiffness_n_m", 1000}};
  EXPECT_EQ(complaints(filesWith("right", {Json("bullet"), Json("wetcloth"), Json::object(), numbers})), "");
  expectComplaintAboutEach(
      filesWith("wrong", {Json("bulet"), Json(5), Json({{"small_steps", 0}}), Json({{"stiffness_n_m", 0}})}));
}

TEST(Schema, RefusesATypoAtEachDepth) {
  if (!hasJsonSchema()) GTEST_SKIP() << "python3 has no jsonschema (Debian: python3-jsonschema)";
  const TemporaryDirectory directory;
  std::vector<std::string> files;
  for (const char* pointer :
       {"/duraton_s", "/solver/smal_steps", "/cloths/0/fabrik", "/cloths/0/patch/colums", "/cloths/0/fabric/color",
        "/cloths/0/effects/absorbtion", "/cloths/0/effects/wind/velocity_km_h", "/colliders/0/sphere/radius_cm"}) {
    Json scene = smallScene();
    scene[Json::json_pointer(pointer)] = 1;
    files.push_back(directory.write("scene" + std::to_string(files.size()) + ".json", scene.dump()));
  }
  expectComplaintAboutEach(files);
}

}  // namespace
}  // namespace wetcloth_test::schema_test
