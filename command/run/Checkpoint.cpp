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

class SceneHash {
 public:
  void add(const std::string& text) { m_hash.add(text.data(), text.size()); }
  void add(const std::vector<btVector3>& places) {
    for (const btVector3& place : places) m_hash.add(&place, 3 * sizeof(btScalar));
  }
  void add(const TriangleMesh& mesh) {
    add(mesh.vertices);
    m_hash.add(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
  }
  void add(const RigidMotion& motion) {
    m_hash.add(motion.times.data(), motion.times.size() * sizeof motion.times[0]);
    add(motion.places);
    for (const btQuaternion& turn : motion.turns) m_hash.add(&turn, 4 * sizeof(btScalar));
  }
  std::string value() const { return hexadecimal(m_hash.value()); }

 private:
  wetcloth::StateHash m_hash;
};

// Of the file's text, and of what the files that it names hold: meshes, hulls and motions.
std::string hashOf(const Scene& scene) {
  SceneHash hash;
  hash.add(readTextFile(scene.file));
  for (const ClothScene& cloth : scene.cloths) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&cloth.shape)) hash.add(*mesh);
  }
  for (const Collider& collider : scene.colliders) {
    if (const auto* mesh = collider.as<TriangleMesh>()) hash.add(*mesh);
    if (const auto* hull = collider.as<Hull>()) hash.add(hull->points);
    if (collider.motion) hash.add(*collider.motion);
  }
  return hash.value();
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

// What is nested deeper is none of ours, and would take the stack of what goes through it.
bool isFlat(int depth, nlohmann::ordered_json::parse_event_t /*event*/, const nlohmann::ordered_json& /*parsed*/) {
  if (depth > 20) throw std::invalid_argument("is no checkpoint of a run");
  return true;
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
    const auto header = nlohmann::ordered_json::parse(content.substr(0, end), isFlat);
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
