// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/Spouts.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/drops/DropPath.h"
#include "bullet_wetcloth/numerics/DropFlight.h"
#include "bullet_wetcloth/numerics/TiltedGlass.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
const btVector3 kUp(0, 1, 0);

// The n-th point of Roberts' quasi-random sequence in four dimensions, along one of them: [0, 1). So drops spread
// evenly without a random number that a restore would have to know of.
double spread(long long n, std::size_t axis) {
  constexpr double steps[4] = {0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
  const double value = 0.5 + static_cast<double>(n) * steps[axis];
  return value - std::floor(value);
}

btVector3 across(const btVector3& direction) {
  btVector3 one, other;
  btPlaneSpace1(direction, one, other);
  return one;
}

btVector3 turned(const btVector3& axis, const btVector3& side, double angle) {
  return side * static_cast<btScalar>(std::cos(angle)) + axis.cross(side) * static_cast<btScalar>(std::sin(angle));
}

btVector3 horizontal(const btVector3& v, const btVector3& down) { return v - down * v.dot(down); }

// What is due in drops of this mass, or, where these would be more than anybody tells apart, of a larger one.
struct Portions {
  static constexpr int kMost = 10000;
  Portions(double due, double drop) {
    const double drops = std::floor(due / drop);
    count = static_cast<int>(std::min<double>(drops, kMost));
    mass = drops > kMost ? due / kMost : drop;
  }
  int count;
  double mass;  // of each [kg]
};

bool isValid(const Pour& pour) {
  try {
    requireValid("pour", pour);
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

bool isFinitePose(const btTransform& pose) {
  const btMatrix3x3& basis = pose.getBasis();
  return std::isfinite(pose.getOrigin().length2() + basis[0].length2() + basis[1].length2() + basis[2].length2());
}

void transferAmount(StateArchive& archive, double& water) {
  double amount = water;
  archive.local(amount);
  if (archive.isChecking() && !(amount >= 0 && std::isfinite(amount))) archive.fail("a spout's water is no amount");
  if (archive.isRestoring()) water = amount;
}

// Where the n-th drop leaves a spout, and with which velocity.
void begin(const Pour& pour, long long n, btVector3& place, btVector3& velocity) {
  const btScalar speed = pour.velocity.length();
  const btVector3 axis = speed > 0 ? pour.velocity / speed : -kUp;
  const btVector3 side = across(axis);
  const double radius = pour.mouthRadius * std::sqrt(spread(n, 0));
  place = pour.position + turned(axis, side, 2 * kHalfTurn * spread(n, 1)) * static_cast<btScalar>(radius);
  const double cosine = 1 - spread(n, 2) * (1 - std::cos(pour.halfAngle));
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const btVector3 astray = turned(axis, side, 2 * kHalfTurn * spread(n, 3));
  velocity = (axis * static_cast<btScalar>(cosine) + astray * static_cast<btScalar>(sine)) * speed;
}

}  // namespace

std::size_t Spouts::add(Pour pour) {
  requireValid("pours[" + std::to_string(m_pours.size()) + "]", pour);
  m_pours.push_back({std::move(pour), 0, 0});
  return m_pours.size() - 1;
}

std::size_t Spouts::add(Glass glass) {
  requireValid("glasses[" + std::to_string(m_glasses.size()) + "]", glass);
  RunningGlass running;
  running.water = glass.water;
  running.glass = std::move(glass);
  m_glasses.push_back(std::move(running));
  return m_glasses.size() - 1;
}

bool Spouts::mayPour(double begin, double end) const {
  const auto flows = [&](const RunningPour& running) {
    const Pour& pour = running.pour;
    return (pour.flow > 0 || pour.move) && pour.start < end && pour.stop > begin;
  };
  const auto isFull = [](const RunningGlass& running) { return running.water > 0; };
  return std::any_of(m_pours.begin(), m_pours.end(), flows) || std::any_of(m_glasses.begin(), m_glasses.end(), isFull);
}

std::string Spouts::pour(const Substep& substep, const Give& give) {
  std::string failure;
  for (RunningPour& running : m_pours) {
    try {
      run(running, substep, give);
    } catch (...) {
      running.pour.stop = running.pour.start;
      failure = currentMessage();
    }
  }
  for (RunningGlass& running : m_glasses) {
    try {
      run(running, substep, give);
    } catch (...) {
      running.glass.pose = {};
      failure = currentMessage();
    }
  }
  return failure;
}

void Spouts::run(RunningPour& running, const Substep& substep, const Give& give) {
  Pour& pour = running.pour;
  const double begin = std::max(substep.end - substep.dt, pour.start);
  const double end = std::min(substep.end, pour.stop);
  if (!(end > begin)) return;
  if (pour.move) {
    pour.move(pour, (begin + end) / 2);
    if (!isValid(pour)) return;
  }
  if (!(pour.flow > 0)) return;
  const double before = running.due;
  running.due += pour.flow * (end - begin);
  const Portions portions(running.due, dropMass(pour.dropDiameter, substep.waterDensity));
  const double mass = portions.mass;
  for (int k = 1; k <= portions.count; ++k) {
    running.due = std::max(0.0, running.due - mass);
    const double leaves = begin + std::max(0.0, (k * mass - before) / pour.flow);
    btVector3 place, velocity;
    wetcloth::begin(pour, running.drops++, place, velocity);
    give(asDouble(place), asDouble(velocity), mass, std::max(0.0, substep.end - leaves));
  }
}

void Spouts::run(RunningGlass& running, const Substep& substep, const Give& give) {
  const Glass& glass = running.glass;
  const btScalar gravity = substep.gravity.length();
  btTransform pose = glass.pose ? glass.pose(substep.end) : running.last;
  if (!isFinitePose(pose)) pose = running.last;
  const btTransform last = running.hasPose ? running.last : pose;
  running.last = pose;
  running.hasPose = true;
  if (!(running.water > 0 && gravity > 0)) return;

  const btVector3 down = substep.gravity / gravity;
  const btVector3 axis = pose.getBasis() * kUp;
  const double cosine = -static_cast<double>(axis.dot(down));
  const double stays = substep.waterDensity * heldInTiltedGlass(glass.radius, glass.height, cosine);
  const double above = running.water - stays;
  if (above > 0) {
    const double leaves = above * -std::expm1(-substep.dt / glass.timeConstant);
    running.water -= leaves;
    running.due += leaves;
  }
  const Portions portions(running.due, dropMass(glass.dropDiameter, substep.waterDensity));
  const double mass = portions.mass;
  const int count = portions.count;
  if (count == 0) return;

  const btVector3 fall = down - axis * axis.dot(down);
  const bool isUpright = fall.length2() < btScalar(1e-10);
  const btVector3 outwards = isUpright ? pose.getBasis().getColumn(0) : fall.normalized();
  const btVector3 way = horizontal(outwards, down) + horizontal(axis, down);
  const btVector3 ahead = way.length2() > btScalar(1e-10) ? way.normalized() : axis;
  const btVector3 lip = kUp * static_cast<btScalar>(glass.height);
  const btVector3 rim = outwards * static_cast<btScalar>(glass.radius);
  const btVector3 motion = (pose * lip - last * lip) / static_cast<btScalar>(substep.dt);
  const double surface = kHalfTurn * glass.radius * glass.radius / std::max(cosine, 0.2);
  const double head = std::max(0.0, above) / (substep.waterDensity * surface);
  const btVector3 velocity = motion + ahead * static_cast<btScalar>(std::sqrt(2 * static_cast<double>(gravity) * head));
  const btVector3 sideways = ahead.cross(down) * static_cast<btScalar>(0.4 * glass.radius);
  for (int k = 0; k < count; ++k) {
    running.due = std::max(0.0, running.due - mass);
    const btScalar side = static_cast<btScalar>(2 * spread(running.drops, 0) - 1);
    const btScalar forward = static_cast<btScalar>(glass.dropDiameter * (0.5 + spread(running.drops, 1)));
    ++running.drops;
    const btVector3 place = pose * lip + rim + sideways * side + ahead * forward;
    give(asDouble(place), asDouble(velocity), mass, substep.dt * (count - k - 0.5) / count);
  }
}

void Spouts::transferState(StateArchive& archive) {
  archive.expect(m_pours.size(), "the number of spouts");
  archive.expect(m_glasses.size(), "the number of glasses");
  for (RunningPour& running : m_pours) {
    transferAmount(archive, running.due);
    archive.value(running.drops);
  }
  for (RunningGlass& running : m_glasses) {
    transferAmount(archive, running.water);
    transferAmount(archive, running.due);
    archive.value(running.drops);
    archive.value(running.last);
    archive.value(running.hasPose);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
