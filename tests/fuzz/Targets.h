// SPDX-License-Identifier: Zlib
#pragma once

// What is fuzzed, one function for each reader of bytes from outside; by libFuzzer (./dev fuzz), and with the kept
// seeds by the tests.

#include "command/ccd/QueryFile.h"
#include "command/cli/Errors.h"
#include "command/measured/MeasuredTable.h"
#include "command/scene/ObjReader.h"
#include "command/scene/SceneReader.h"
#include "tests/fuzz/Input.h"
#include "tests/fuzz/SmallWorld.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace fuzz {

inline void scene(const std::string& bytes) {
  const Input input(bytes);
  takesOrRefuses<command::InputError>([&] { command::readScene(input.path()); });
}

inline void obj(const std::string& bytes) {
  const Input input(bytes);
  takesOrRefuses<std::invalid_argument>([&] { command::readObj(input.path()); });
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
          if (!std::isfinite(number * number)) throw std::logic_error("taken for a number");
        }
      });
      takesOrRefuses<command::InputError>([&] { table.sortedBy(column).increasing(column); });
    }
    table.words("");
  });
}

/// The first byte chooses: an odd one, and the rest is a whole stream; an even one, and it is the state within a
/// stream whose envelope is right, so that the hash does not keep everything out. Whatever came of it, the world can
/// be brought back to what it was.
inline void state(const std::string& bytes) {
  if (bytes.empty()) return;
  static SmallWorld world;
  const bool isStream = bytes[0] % 2 != 0;
  const std::string stream = isStream ? bytes.substr(1) : world.wrapped(bytes.substr(1));
  takesOrRefuses<wetcloth::StateError>([&] { world.restore(stream); });
  world.restore(world.start());
  if (world.saved() != world.start()) throw std::logic_error("the world is not what it was");
}

}  // namespace fuzz
