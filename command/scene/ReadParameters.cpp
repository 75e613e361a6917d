// SPDX-License-Identifier: Zlib
#include "command/scene/ReadParameters.h"

#include <cmath>

namespace command {
namespace {

/// Gusts that travel with the mean wind, as turbulence does that passes faster than it changes (Taylor 1938):
/// mean + amplitude sin(2 pi (t - x . mean / |mean|^2) / period).
wetcloth::WindField readGust(JsonCursor cursor) {
  cursor.expectObject(keys::gust);
  const btVector3 mean = readVector(cursor.at("mean_m_s"), Range::velocity());
  const btVector3 amplitude = readVector(cursor.at("amplitude_m_s"), Range::velocity());
  const double period = cursor.at("period_s").number(Range::positive());
  const btScalar speed2 = mean.length2();
  const btVector3 delay = speed2 > 0 ? btVector3(mean / speed2) : btVector3(0, 0, 0);
  return [=](const btVector3& position, double time) {
    const double turns = (time - static_cast<double>(position.dot(delay))) / period;
    return btVector3(mean + amplitude * btScalar(std::sin(SIMD_2_PI * turns)));
  };
}

}  // namespace

btVector3 readDirection(const JsonCursor& cursor) {
  const btVector3 direction = readVector(cursor);
  // Shorter or longer ones have a square that float32 cannot hold.
  if (!(direction.length() > btScalar(1e-9)) || !(direction.length() < btScalar(1e9))) {
    cursor.reject("a direction, of a length in [1e-9, 1e9]");
  }
  return direction;
}

wetcloth::Exposure readExposure(JsonCursor cursor, int nodes) {
  if (cursor.isArray()) {
    std::vector<double> perNode;
    for (const JsonCursor& element : cursor.elements()) perNode.push_back(element.number(Range::fraction()));
    if (perNode.size() != static_cast<std::size_t>(nodes)) {
      cursor.reject("one value per node, " + std::to_string(nodes) + " here; it has " + std::to_string(perNode.size()));
    }
    return perNode;
  }
  if (!cursor.isObject()) return cursor.number(Range::fraction());
  cursor.expectObject(keys::exposureBelow);
  const double surface = cursor.at("below_m").number(Range::finite());
  return [surface](const btVector3& position, const btVector3&) {
    return static_cast<double>(position.y()) < surface ? 1.0 : 0.0;
  };
}

wetcloth::WindField readWindField(const JsonCursor& effect) {
  if (effect.exactlyOneOf({"velocity_m_s", "gust"}) == "gust") return readGust(effect.at("gust"));
  return readVector(effect.at("velocity_m_s"), Range::velocity());
}

std::vector<double> readTimes(const JsonCursor& cursor) {
  std::vector<double> times;
  for (const JsonCursor& time : cursor.elements()) {
    if (!times.empty() && !(time.number(Range::notNegative()) > times.back())) {
      time.complain("must be later than the time before it");
    }
    times.push_back(time.number(Range::notNegative()));
  }
  if (times.empty()) cursor.reject("an array with at least one time");
  return times;
}

std::vector<btVector3> readForEachTime(const JsonCursor& cursor, std::size_t times) {
  std::vector<btVector3> vectors;
  for (const JsonCursor& element : cursor.elements()) vectors.push_back(readVector(element));
  if (vectors.size() != times) {
    cursor.complain("must have one element for each of times_s, " + std::to_string(times));
  }
  return vectors;
}

}  // namespace command
