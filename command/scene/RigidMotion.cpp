// SPDX-License-Identifier: Zlib
#include "command/scene/RigidMotion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace command {
namespace {

/// The shorter way round.
btQuaternion between(const btQuaternion& from, const btQuaternion& to, double share) {
  const btQuaternion near = from.dot(to) < 0 ? -to : to;
  return from.slerp(near, btScalar(share)).normalized();
}

}  // namespace

btTransform RigidMotion::at(double time) const {
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  const std::size_t to = std::min(next, times.size() - 1);
  const std::size_t from = next == 0 ? 0 : next - 1;
  const double share = from == to ? 0 : (time - times[from]) / (times[to] - times[from]);
  const btTransform turn(between(turns[from], turns[to], share));
  return btTransform(turn.getBasis(),
                     places[from] + (places[to] - places[from]) * btScalar(share) - turn.getBasis() * pivot);
}

double RigidMotion::fastest(double reach) const {
  double speed = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double way = static_cast<double>((places[i] - places[i - 1]).length());
    const double alike = std::min(1.0, std::fabs(static_cast<double>(turns[i].dot(turns[i - 1]))));
    speed = std::max(speed, (way + 2 * std::acos(alike) * reach) / (times[i] - times[i - 1]));
  }
  return speed;
}

RigidMotion chained(const RigidMotion& inner, const RigidMotion& outer) {
  RigidMotion both;
  both.pivot = inner.pivot;
  std::merge(inner.times.begin(), inner.times.end(), outer.times.begin(), outer.times.end(),
             std::back_inserter(both.times));
  both.times.erase(std::unique(both.times.begin(), both.times.end()), both.times.end());
  for (const double time : both.times) {
    const btTransform place = outer.at(time) * inner.at(time);
    both.places.push_back(place * inner.pivot);
    both.turns.push_back(place.getRotation());
  }
  return both;
}

}  // namespace command
