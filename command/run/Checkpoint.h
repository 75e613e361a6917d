// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <nlohmann/json.hpp>

#include <string>

namespace command {

/// A run that was left before its end, in a file: whose run it is, how far it is, and the state of its world.
struct Checkpoint {
  nlohmann::ordered_json run;       ///< what must be the same to go on: scene, precision, quality, number of steps
  nlohmann::ordered_json progress;  ///< of the run; "steps" is how many were made
  std::string state;                ///< of the world, as SceneWorld::save() writes it
};

/// What tells one run from another, as a checkpoint names it.
/// @param steps  of the whole run
nlohmann::ordered_json runIdentity(const Scene& scene, int steps);

/// What a checkpoint's file holds, of what comes after its first line: its hash is right.
std::string checkpointFile(const std::string& content);
/// Throws InputError when no file can be written there.
void requireCheckpointPlace(const std::string& path);
/// Writes beside the file and then puts that in its place, so that whenever the program is killed a whole checkpoint is
/// there, the last one or the one before. Throws RunError when that fails.
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);
/// Throws InputError that names the file when it is no checkpoint, was damaged, or is one of another run.
Checkpoint readCheckpoint(const std::string& path, const nlohmann::ordered_json& run);

}  // namespace command
