// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/Scene.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace command {

inline btVector3 readVector(const JsonCursor& cursor, const Range& range = Range::coordinate()) {
  const std::array<double, 3> xyz = cursor.triple(range);
  return btVector3(btScalar(xyz[0]), btScalar(xyz[1]), btScalar(xyz[2]));
}

/// Overwrites a default when the key is there.
inline void readNumber(const JsonCursor& object, const char* key, const Range& range, double& value) {
  if (const auto found = object.find(key)) value = found->number(range);
}
inline void readVector(const JsonCursor& object, const char* key, btVector3& value,
                       const Range& range = Range::coordinate()) {
  if (const auto found = object.find(key)) value = readVector(*found, range);
}

/// A vector that tells where to.
btVector3 readDirection(const JsonCursor& cursor);
inline void readDirection(const JsonCursor& object, const char* key, btVector3& value) {
  if (const auto found = object.find(key)) value = readDirection(*found);
}

/// "times_s": each later than the one before, at least one.
std::vector<double> readTimes(const JsonCursor& cursor);
/// One vector for each of so many times.
std::vector<btVector3> readForEachTime(const JsonCursor& cursor, std::size_t times);

enum class Mode { physical, paper };

/// The defaults of an effect: the library's own, or the paper's letter by letter.
inline Mode readMode(const JsonCursor& cursor) {
  static const std::vector<std::pair<std::string, Mode>> modes{{"physical", Mode::physical}, {"paper", Mode::paper}};
  const auto mode = cursor.find("mode");
  return mode ? mode->choice(modes) : Mode::physical;
}

/// One value for each node, one for all, or `{"below_m": y}`. @param nodes of the cloth
wetcloth::Exposure readExposure(JsonCursor cursor, int nodes);

/// "velocity_m_s", the same everywhere, or "gust" of an effect; one of the two must be there.
wetcloth::WindField readWindField(const JsonCursor& effect);

/// Adds an effect of class E with these parameters; one that the cloth has already gets them, and keeps what it
/// remembers.
template <class E>
wetcloth::Effect& putEffect(wetcloth::WetCloth& cloth, const typename E::Parameters& parameters) {
  E* const there = cloth.find<E>();
  if (there == nullptr) return cloth.add<E>(parameters);
  there->setParameters(parameters);
  return *there;
}

/// The same with the parameters of a scene.
template <class E>
AddEffect addEffect(typename E::Parameters parameters) {
  return [parameters = std::move(parameters)](wetcloth::WetCloth& cloth, const Colliders&) -> wetcloth::Effect& {
    return putEffect<E>(cloth, parameters);
  };
}

}  // namespace command
