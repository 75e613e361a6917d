// SPDX-License-Identifier: Zlib
#include "command/accuracy/MassSpringReference.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace accuracy {
namespace {

using Vector = MassSpringReference::Vector;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double lengthOf(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

void addScaled(Vector& sum, const Vector& term, double factor) {
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += factor * term[axis];
}

}  // namespace

MassSpringReference::MassSpringReference(std::vector<Point> points, std::vector<Spring> springs, double gravity)
    : m_points(std::move(points)), m_springs(std::move(springs)), m_gravity(gravity) {
  accelerate();
}

void MassSpringReference::accelerate() {
  for (Point& point : m_points) point.acceleration = {0, -m_gravity, 0};
  for (const Spring& spring : m_springs) {
    Point& a = m_points[static_cast<std::size_t>(spring.a)];
    Point& b = m_points[static_cast<std::size_t>(spring.b)];
    const Vector along = difference(b.position, a.position);
    const double length = lengthOf(along);
    if (length == 0) continue;
    const double pull = spring.stiffness * (length - spring.restLength) / length;
    addScaled(a.acceleration, along, pull / a.mass);
    addScaled(b.acceleration, along, -pull / b.mass);
  }
  for (Point& point : m_points) {
    if (point.isFixed) point.acceleration = {0, 0, 0};
  }
}

void MassSpringReference::step(double dt) {
  for (Point& point : m_points) {
    addScaled(point.velocity, point.acceleration, dt / 2);
    addScaled(point.position, point.velocity, dt);
  }
  accelerate();
  for (Point& point : m_points) addScaled(point.velocity, point.acceleration, dt / 2);
}

MassSpringReference::Vector MassSpringReference::centreOfMass() const {
  Vector moment = {0, 0, 0};
  double mass = 0;
  for (const Point& point : m_points) {
    addScaled(moment, point.position, point.mass);
    mass += point.mass;
  }
  return {moment[0] / mass, moment[1] / mass, moment[2] / mass};
}

double MassSpringReference::kineticEnergy() const {
  double energy = 0;
  for (const Point& point : m_points) {
    const double speed = lengthOf(point.velocity);
    energy += point.mass * speed * speed / 2;
  }
  return energy;
}

double MassSpringReference::gravityEnergy() const {
  double energy = 0;
  for (const Point& point : m_points) energy += point.mass * m_gravity * point.position[1];
  return energy;
}

double MassSpringReference::springEnergy() const {
  double energy = 0;
  for (const Spring& spring : m_springs) {
    const double length = lengthOf(difference(m_points[static_cast<std::size_t>(spring.b)].position,
                                              m_points[static_cast<std::size_t>(spring.a)].position));
    energy += spring.stiffness * (length - spring.restLength) * (length - spring.restLength) / 2;
  }
  return energy;
}

}  // namespace accuracy
