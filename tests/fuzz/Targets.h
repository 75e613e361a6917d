// SPDX-License-Identifier: Zlib
#pragma once

// What is fuzzed, one function for each reader of bytes from outside; by libFuzzer (./dev fuzz), and with the kept
// seeds by the tests.

#include "command/ccd/QueryFile.h"
#include "command/cli/Errors.h"
#include "command/measured/MeasuredTable.h"
#include "command/run/Checkpoint.h"
#include "command/scene/ObjReader.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SkeletonMotion.h"
#include "tests/fuzz/Input.h"
#include "tests/fuzz/SmallWorld.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace fuzz {

inline void requireNumber(double number) {
  if (!std::isfinite(number)) throw std::logic_error("taken for a number");
}

inline void requireNumbers(const btVector3& vector) {
  for (int axis = 0; axis < 3; ++axis) requireNumber(vector[axis]);
}

/// As if it were among the seeds, whose files it may name.
inline void scene(const std::string& bytes) {
  const Input input(bytes);
  const std::string place = WETCLOTH_SOURCE_DIR "/tests/fuzz/seeds/scene/input.json";
  takesOrRefuses<command::InputError>([&] { command::readScene(command::loadJson(input.path()), place); });
}

inline void obj(const std::string& bytes) {
  const Input input(bytes);
  takesOrRefuses<std::invalid_argument>([&] { command::readObj(input.path()); });
}

/// A BVH file; or after a byte 0 a glTF file. What is taken is finite, and each joint has a place at each time.
inline void motion(const std::string& bytes) {
  const bool isGltf = !bytes.empty() && bytes[0] == '\0';
  const NamedInput input(isGltf ? bytes.substr(1) : bytes, isGltf ? ".gltf" : ".bvh");
  takesOrRefuses<std::invalid_argument>([&] {
    const command::SkeletonMotion motion = command::readSkeletonMotion(input.path(), {});
    for (const double time : motion.times) requireNumber(time);
    for (const command::SkeletonMotion::Joint& joint : motion.joints) {
      if (joint.places.size() != motion.times.size()) throw std::logic_error("a joint lacks places: " + joint.name);
      for (const btTransform& place : joint.places) {
        requireNumbers(place.getOrigin());
        for (int row = 0; row < 3; ++row) requireNumbers(place.getBasis()[row]);
      }
      for (const btVector3& end : joint.ends) requireNumbers(end);
      for (const btVector3& vertex : joint.skin) requireNumbers(vertex);
    }
  });
}

inline void ccd(const std::string& bytes) {
  const Input input(bytes);
  takesOrRefuses<command::InputError>([&] { command::readQueries(input.path()); });
}

/// All that is asked of a table of measurements, of each of its columns; a number that is taken is one.
inline void measured(const std::string& bytes) {
  const Input input(bytes);
  takesOrRefuses<command::InputError>([&] {
    const command::MeasuredTable table(input.path());
    table.requireRows(1, "to have a cell");
    for (const std::string& column : table.columns()) {
      table.where(column, table.distinct(column).front()).requireRows(1, "of its word");
    }
    for (const std::string& column : table.columns()) {
      takesOrRefuses<command::InputError>([&] {
        for (const double number : table.numbers(column)) {
          requireNumber(number * number);
        }
      });
      takesOrRefuses<command::InputError>([&] { table.sortedBy(column).increasing(column); });
    }
    table.words("");
  });
}

/// An odd first byte, and the rest is a whole file; an even one, and it is what a file holds whose hash is right.
inline void checkpoint(const std::string& bytes) {
  if (bytes.empty()) return;
  const std::string content = bytes.substr(1);
  const Input input(bytes[0] % 2 != 0 ? content : command::checkpointFile(content));
  takesOrRefuses<command::InputError>([&] {
    const command::Checkpoint read = command::readCheckpoint(input.path(), {{"steps", 60}});
    if (read.run.at("steps") != 60) throw std::logic_error("taken for this run");
  });
}

/// The first byte chooses. Odd, and the rest is a whole stream; even, and it is the state within a stream whose
/// envelope is right, so that the hash does not keep everything out. With its second bit, ClothSolver and its guard
/// move the world. Whatever came of it, the world can be brought back to what it was.
inline void state(const std::string& bytes) {
  if (bytes.empty()) return;
  static SmallWorld plain(SmallWorld::MovedBy::bullet), guarded(SmallWorld::MovedBy::guardedSolver);
  SmallWorld& world = (bytes[0] & 2) != 0 ? guarded : plain;
  const bool isStream = (bytes[0] & 1) != 0;
  const std::string stream = isStream ? bytes.substr(1) : world.wrapped(bytes.substr(1));
  takesOrRefuses<wetcloth::StateError>([&] { world.restore(stream); });
  world.restore(world.start());
  if (world.saved() != world.start()) throw std::logic_error("the world is not what it was");
}

}  // namespace fuzz
