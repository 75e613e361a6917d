// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Wind.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Layers.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/numerics/FluidResistance.h"
#include "bullet_wetcloth/numerics/TriangleDrag.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/DryMass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const Wind::Parameters& parameters) {
  parameters.velocity.requireValid("Wind.velocity");
  requireNotNegative("Wind.airDensity", parameters.airDensity);
  requireNotNegative("Wind.dragCoefficient", parameters.dragCoefficient);
  requireNotNegative("Wind.skinFriction", parameters.skinFriction);
  requireNotNegative("Wind.linearDrag", parameters.linearDrag);
  requireNotNegative("Wind.paperForce", parameters.paperForce);
}

// What the force depends on besides the wind.
auto lawOf(const Wind::Parameters& p) {
  return std::make_tuple(p.law, p.airDensity, p.dragCoefficient, p.skinFriction, p.linearDrag, p.paperForce,
                         p.integration);
}

btVector3 vectorOf(const PackedNodes::Lane (&lanes)[3], int slot) {
  const std::size_t i = static_cast<std::size_t>(slot);
  return btVector3(lanes[0][i], lanes[1][i], lanes[2][i]);
}
void addTo(PackedNodes::Lane (&lanes)[3], int slot, const btVector3& v) {
  for (int axis = 0; axis < 3; ++axis) lanes[axis][static_cast<std::size_t>(slot)] += v[axis];
}

// With the nodes' slots in place of their numbers.
std::vector<TriangleBlocks::Triangle> trianglesOf(const btSoftBody& body, const PackedNodes& nodes) {
  std::vector<TriangleBlocks::Triangle> triangles = layersOf(body);
  for (TriangleBlocks::Triangle& corners : triangles) {
    for (int& corner : corners) corner = static_cast<int>(nodes.slot(static_cast<std::size_t>(corner)));
  }
  return triangles;
}

constexpr btScalar kThird = btScalar(1) / 3;

btVector3 forceOnTriangle(const FlatTriangle& triangle, const btVector3& relative, const FluidResistance& resistance) {
  const btVector3 across = triangle.normal * triangle.normal.dot(relative);
  const btVector3 along = relative - across;
  return (across * resistance.normal(across.length(), 0) + along * resistance.tangent(along.length(), 0)) *
         triangle.area;
}

FluidResistance resistanceOf(const Wind::Parameters& parameters, const Step& step) {
  const bool isImplicit = parameters.integration == Wind::Integration::semiImplicit;
  const btScalar dt = isImplicit ? static_cast<btScalar>(step.dt) : 0;
  if (parameters.law == Wind::Law::linear) return {static_cast<btScalar>(parameters.linearDrag), 0, 0, dt};
  return {0, static_cast<btScalar>(parameters.airDensity * parameters.dragCoefficient / 2),
          static_cast<btScalar>(parameters.airDensity * parameters.skinFriction / 2), dt};
}

}  // namespace

btVector3 paperWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& wind) {
  const btVector3 normal = flatTriangle(a, b, c).normal;
  return normal * normal.dot(wind);
}

btVector3 quadraticWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& velocity,
                             const btVector3& wind, double airDensity, double dragCoefficient, double skinFriction) {
  const FluidResistance resistance = {0, static_cast<btScalar>(airDensity * dragCoefficient / 2),
                                      static_cast<btScalar>(airDensity * skinFriction / 2), 0};
  return forceOnTriangle(flatTriangle(a, b, c), wind - velocity, resistance);
}

btVector3 linearWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& velocity,
                          const btVector3& wind, double linearDrag) {
  return forceOnTriangle(flatTriangle(a, b, c), wind - velocity, {static_cast<btScalar>(linearDrag), 0, 0, 0});
}

Wind::Wind(Parameters parameters) { setParameters(std::move(parameters)); }

void Wind::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (lawOf(parameters) != lawOf(m_parameters)) m_windAtCentre.setZero();  // as if the cloth had felt no wind so far
  m_parameters = std::move(parameters);
}

void Wind::attach(WetCloth& cloth) {
  const btSoftBody& body = cloth.body();
  requireFaces("Wind", body);
  PackedNodes& nodes = cloth.packedNodes();
  nodes.fit();
  const std::size_t padded = nodes.size() + PackedNodes::kPadding;
  for (int axis = 0; axis < 3; ++axis) {
    m_relative[axis].assign(padded, 0);
    m_force[axis].assign(padded, 0);
  }
  m_specificArea.assign(padded, 0);
  m_drag.assign(padded, 0);
  m_triangles.reset(trianglesOf(body, nodes));
  const std::vector<double> areas = nodeAreas(body);
  m_nodeAreas.assign(areas.begin(), areas.end());
  m_areaInSlot.assign(padded, 0);
  m_areasAreStale = true;
}

void Wind::spreadAreas(const PackedNodes& nodes) {
  for (std::size_t i = 0; i < m_nodeAreas.size(); ++i) m_areaInSlot[nodes.slot(i)] = m_nodeAreas[i];
  m_areasAreStale = false;
}

void Wind::apply(WetCloth& cloth, const Step& step) {
  m_windAtCentre = windAtCentre(cloth, step);
  PackedNodes& nodes = cloth.packedNodes();
  nodes.read();
  if (m_areasAreStale) spreadAreas(nodes);
  look(nodes, step);
  if (m_parameters.law == Law::paper) {
    accumulatePaper(nodes, step);
  } else {
    accumulate(nodes, step);
    if (m_parameters.law == Law::quadratic && m_parameters.skinFriction > 0) accumulateFriction(nodes, step);
  }
  push(nodes, step);
}

btVector3 Wind::windAtCentre(const WetCloth& cloth, const Step& step) const {
  const btSoftBody& body = cloth.body();
  return m_parameters.velocity.at((body.m_bounds[0] + body.m_bounds[1]) / 2, step.time);
}

btVector3 Wind::traction(const btSoftBody::Face& face, double time) const {
  const btSoftBody::Node& a = *face.m_n[0];
  const btSoftBody::Node& b = *face.m_n[1];
  const btSoftBody::Node& c = *face.m_n[2];
  const FlatTriangle triangle = flatTriangle(a.m_x, b.m_x, c.m_x);
  if (triangle.area == 0) return btVector3(0, 0, 0);
  const btVector3 wind = m_parameters.velocity.at((a.m_x + b.m_x + c.m_x) * kThird, time);
  if (m_parameters.law == Law::paper) {
    const btScalar corners = 3;
    return paperWindForce(a.m_x, b.m_x, c.m_x, wind) *
           (corners * static_cast<btScalar>(m_parameters.paperForce) / triangle.area);
  }
  const btVector3 relative = wind - (a.m_v + b.m_v + c.m_v) * kThird;
  const Step instant = {0, time, btVector3(0, 0, 0)};
  return forceOnTriangle(triangle, relative, resistanceOf(m_parameters, instant)) / triangle.area;
}

bool Wind::wakes(const WetCloth& cloth, const Step& step) const {
  const btScalar change = (windAtCentre(cloth, step) - m_windAtCentre).length();
  return change > btScalar(0.1) * (1 + m_windAtCentre.length());
}

// Bullet adds gravity right after us. Drag that looks at the velocity with gravity in it balances it exactly at the
// terminal speed.
void Wind::look(const PackedNodes& nodes, const Step& step) {
  const bool isImplicit = m_parameters.integration == Integration::semiImplicit;
  const btVector3 fall =
      isImplicit ? step.gravity * static_cast<btScalar>(step.dt * step.fallShare) : btVector3(0, 0, 0);
  const btVector3 uniform = m_parameters.velocity.constant();  // zero when it is a function
  const std::size_t count = nodes.size();
  const btScalar* const inverseMass = nodes.inverseMass.data();
  for (int axis = 0; axis < 3; ++axis) {
    const btScalar air = uniform[axis];
    const btScalar falling = air - fall[axis];
    const btScalar* const velocity = nodes.velocity[axis].data();
    btScalar* const relative = m_relative[axis].data();
    for (std::size_t i = 0; i < count; ++i) relative[i] = (inverseMass[i] > 0 ? falling : air) - velocity[i];
  }
  for (std::size_t i = 0; i < count; ++i) m_specificArea[i] = m_areaInSlot[i] * inverseMass[i];
  for (Lane& axis : m_force) std::fill(axis.begin(), axis.end(), btScalar(0));
  std::fill(m_drag.begin(), m_drag.end(), btScalar(0));
}

template <class Action>
void Wind::forEachTriangle(Action action) const {
  for (const TriangleBlocks::Block& block : m_triangles.blocks()) {
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      if (m_triangles.isTaken(block)[lane] > 0) action(m_triangles.corners(block, lane));
    }
  }
}

TriangleDrag::Nodes Wind::lanesOf(const PackedNodes& nodes) {
  TriangleDrag::Nodes lanes = {};
  for (int axis = 0; axis < 3; ++axis) {
    lanes.position[axis] = nodes.position[axis].data();
    lanes.relative[axis] = m_relative[axis].data();
    lanes.force[axis] = m_force[axis].data();
  }
  lanes.specificArea = m_specificArea.data();
  lanes.drag = m_drag.data();
  return lanes;
}

void Wind::accumulate(const PackedNodes& nodes, const Step& step) {
  const FluidResistance resistance = resistanceOf(m_parameters, step);
  const WindField& field = m_parameters.velocity;
  const TriangleDrag::Nodes lanes = lanesOf(nodes);
  TriangleDrag::Flow flow = {};
  for (const TriangleBlocks::Block& block : m_triangles.blocks()) {
    for (std::size_t lane = 0; field.isFunction() && lane < block.lanes; ++lane) {
      if (!(m_triangles.isTaken(block)[lane] > 0)) continue;
      const auto [a, b, c] = m_triangles.corners(block, lane);
      const auto x = [&](int slot) { return vectorOf(nodes.position, slot); };
      const btVector3 wind = field.at((x(a) + x(b) + x(c)) * kThird + nodes.origin(), step.time);
      for (int axis = 0; axis < 3; ++axis) flow[axis][lane] = wind[axis];
    }
    TriangleDrag::add(m_triangles, block, resistance, field.isFunction() ? &flow : nullptr, lanes);
  }
}

// A pass of its own, since few scenes ask for it.
void Wind::accumulateFriction(const PackedNodes& nodes, const Step& step) {
  const FluidResistance resistance = resistanceOf(m_parameters, step);
  const WindField& field = m_parameters.velocity;
  forEachTriangle([&](const TriangleBlocks::Triangle& corners) {
    btVector3 x[3];
    btScalar specificArea = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = vectorOf(nodes.position, corners[k]);
      specificArea += m_specificArea[static_cast<std::size_t>(corners[k])] * kThird;
    }
    const FlatTriangle triangle = flatTriangle(x[0], x[1], x[2]);
    const btVector3 centre = (x[0] + x[1] + x[2]) * kThird + nodes.origin();
    const btVector3 wind = field.isFunction() ? field.at(centre, step.time) : btVector3(0, 0, 0);
    btVector3 along[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const btVector3 relative = vectorOf(m_relative, corners[k]) + wind;
      along[k] = relative - triangle.normal * triangle.normal.dot(relative);
    }
    const btScalar speed = (along[0] + along[1] + along[2]).length() * kThird;
    const btScalar third = resistance.tangent(speed, specificArea) * triangle.area * kThird;
    for (std::size_t k = 0; k < 3; ++k) {
      addTo(m_force, corners[k], along[k] * third);
      m_drag[static_cast<std::size_t>(corners[k])] += third;
    }
  });
}

void Wind::accumulatePaper(const PackedNodes& nodes, const Step& step) {
  const WindField& field = m_parameters.velocity;
  const btScalar unit = static_cast<btScalar>(m_parameters.paperForce);
  forEachTriangle([&](const TriangleBlocks::Triangle& corners) {
    btVector3 x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = vectorOf(nodes.position, corners[k]);
    const btVector3 wind = field.at((x[0] + x[1] + x[2]) * kThird + nodes.origin(), step.time);
    const btVector3 force = paperWindForce(x[0], x[1], x[2], wind) * unit;
    for (const int corner : corners) addTo(m_force, corner, force);
  });
}

void Wind::push(PackedNodes& nodes, const Step& step) {
  const btScalar dt = static_cast<btScalar>(step.dt);
  const btScalar implicitDt = m_parameters.integration == Integration::semiImplicit ? dt : 0;
  m_totalForce = TriangleDrag::push(lanesOf(nodes), nodes, {dt, implicitDt});
  nodes.velocitiesChanged();
}

void Wind::transferState(StateArchive& archive) {
  archive.array(m_nodeAreas);
  archive.value(m_totalForce, m_windAtCentre);
  if (archive.isRestoring()) m_areasAreStale = true;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
