// SPDX-License-Identifier: Zlib
#include "command/run/Checkpoint.h"

#include "command/cli/Errors.h"
#include "command/cli/StagedOutput.h"
#include "command/cli/TextFile.h"
#include "command/scene/Quality.h"

#include "command/pictures/OutputFile.h"

#include "bullet_wetcloth/state/StateHash.h"

#include <cstdio>
#include <stdexcept>

namespace command {
namespace {

// Then follow a hash of all that comes after the line, and its length.
const char* const mark = "wetcloth-checkpoint-1 ";

std::string hexadecimal(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::string hashOf(const std::string& bytes) {
  wetcloth::StateHash hash;
  hash.add(bytes.data(), bytes.size());
  return hexadecimal(hash.value());
}

// Of the file's text, and of the meshes that it names.
std::string hashOf(const Scene& scene) {
  wetcloth::StateHash hash;
  const std::string text = readTextFile(scene.file);
  hash.add(text.data(), text.size());
  for (const ClothScene& cloth : scene.cloths) {
    const auto* mesh = std::get_if<TriangleMesh>(&cloth.shape);
    if (!mesh) continue;
    for (const btVector3& vertex : mesh->vertices) hash.add(&vertex, 3 * sizeof(btScalar));
    hash.add(mesh->triangles.data(), mesh->triangles.size() * sizeof mesh->triangles[0]);
  }
  return hexadecimal(hash.value());
}

std::string optionFor(const char* option, const std::string& path) {
  return std::string("wetcloth: ") + option + " = \"" + path + "\"";
}

[[noreturn]] void reject(const std::string& path, const std::string& why) {
  throw InputError(onOneLine(optionFor("--resume", path) + ": " + why));
}

void requireSameRun(const std::string& path, const nlohmann::ordered_json& found,
                    const nlohmann::ordered_json& wanted) {
  for (const auto& [key, value] : wanted.items()) {
    const nlohmann::ordered_json there = found.value(key, nlohmann::ordered_json());
    if (there == value) continue;
    if (key == "scene") reject(path, "is a checkpoint of another scene, or the scene has changed since");
    reject(path, "is a checkpoint of a run with " + key + " " + there.dump() + "; this one has " + value.dump());
  }
}

// What follows may be counted by it.
void requireStepOf(const nlohmann::ordered_json& run, const nlohmann::ordered_json& steps) {
  if (steps.is_number_integer() && steps >= 0 && steps <= run.at("steps")) return;
  throw std::invalid_argument("is after " + steps.dump() + " of " + run.at("steps").dump() + " steps");
}

// The bytes after the first line. Throws std::invalid_argument.
std::string contentOf(const std::string& file) {
  const std::size_t end = file.find('\n');
  if (file.rfind(mark, 0) != 0 || end == std::string::npos) throw std::invalid_argument("is no checkpoint of a run");
  std::string content = file.substr(end + 1);
  if (file != checkpointFile(content)) throw std::invalid_argument("is damaged: it was cut off or changed");
  return content;
}

}  // namespace

nlohmann::ordered_json runIdentity(const Scene& scene, int steps) {
  return {{"precision", nameOf(ownPrecision)},
          {"quality", qualityOf(scene)},
          {"substeps", scene.substeps},
          {"iterations", scene.iterations},
          {"solver", nameOf(scene.solver())},
          {"steps", steps},
          {"scene", hashOf(scene)}};
}

std::string checkpointFile(const std::string& content) {
  return mark + hashOf(content) + " " + std::to_string(content.size()) + "\n" + content;
}

void requireCheckpointPlace(const std::string& path) {
  const StagedOutput probe(optionFor("--checkpoint", path), path, StagedOutput::Kind::file);
}

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint) {
  const nlohmann::ordered_json header = {{"run", checkpoint.run}, {"progress", checkpoint.progress}};
  const std::string option = optionFor("--checkpoint", path);
  try {
    StagedOutput output(option, path, StagedOutput::Kind::file);
    pictures::writeFile(output.path(), checkpointFile(header.dump() + "\n" + checkpoint.state));
    output.commit();
  } catch (const RunError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw RunError(onOneLine(option + ": " + error.what()));
  }
}

Checkpoint readCheckpoint(const std::string& path, const nlohmann::ordered_json& run) {
  try {
    const std::string content = contentOf(readTextFile(path));
    const std::size_t end = content.find('\n');
    if (end == std::string::npos) throw std::invalid_argument("is no checkpoint of a run");
    const auto header = nlohmann::ordered_json::parse(content.substr(0, end));
    Checkpoint checkpoint = {header.at("run"), header.at("progress"), content.substr(end + 1)};
    requireSameRun(path, checkpoint.run, run);
    requireStepOf(run, checkpoint.progress.at("steps"));
    return checkpoint;
  } catch (const nlohmann::json::exception&) {
    reject(path, "is no checkpoint of this version of wetcloth");
  } catch (const std::invalid_argument& error) {
    reject(path, error.what());
  }
}

}  // namespace command
