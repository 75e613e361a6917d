// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WaterDrag.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/numerics/FluidResistance.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kHeldWaterDensity = 1000;  // [kg/m^3]

void requireValid(const WaterDrag::Parameters& parameters) {
  if (parameters.surface) requireValid("WaterDrag.surface", *parameters.surface);
  requireNotNegative("WaterDrag.dragCoefficient", parameters.dragCoefficient);
  requireNotNegative("WaterDrag.skinFriction", parameters.skinFriction);
  requirePositive("WaterDrag.fibreDensity", parameters.fibreDensity);
}

// What the force depends on besides the water.
auto lawOf(const WaterDrag::Parameters& parameters) {
  return std::make_tuple(parameters.dragCoefficient, parameters.skinFriction, parameters.fibreDensity);
}

btVector3 centreOf(const btSoftBody& body) { return (body.m_bounds[0] + body.m_bounds[1]) / 2; }
btVector3 sizeOf(const btSoftBody& body) { return body.m_bounds[1] - body.m_bounds[0]; }

// Of the bounding box's lowest corner [m], negative when all of it is above the water.
double greatestDepth(const WaterSurface& surface, const btSoftBody& body) {
  return surface.depth(centreOf(body)) + static_cast<double>(surface.normal.absolute().dot(sizeOf(body))) / 2;
}

// Bullet's box is one step old, and positions written by hand are not in it at all: only a body that is above the water
// by more than its own size can be left alone without a look at its nodes.
bool isWellAbove(const WaterSurface& surface, const btSoftBody& body) {
  return greatestDepth(surface, body) < -static_cast<double>(sizeOf(body).length());
}

bool isReached(const std::optional<WaterSurface>& surface, const btSoftBody& body) {
  return surface && greatestDepth(*surface, body) > 0;
}

bool differs(const WaterSurface& now, const WaterSurface& before, const btSoftBody& body) {
  const btVector3 centre = centreOf(body);
  const double size = static_cast<double>(sizeOf(body).length());
  const double current = static_cast<double>(before.velocity.length());
  return std::fabs(now.depth(centre) - before.depth(centre)) > 1e-3 * size ||
         (now.normal - before.normal).length() > btScalar(1e-3) ||
         static_cast<double>((now.velocity - before.velocity).length()) > std::max(0.01, 0.1 * current) ||
         std::fabs(now.density - before.density) > 0.01 * before.density;
}

btVector3 placeOf(const PackedNodes& nodes, std::size_t node) {
  const std::size_t slot = nodes.slot(node);
  return nodes.origin() + btVector3(nodes.position[0][slot], nodes.position[1][slot], nodes.position[2][slot]);
}

}  // namespace

double displacedVolume(double dryMass, double fibreDensity, double held) {
  return dryMass / fibreDensity + held / kHeldWaterDensity;
}

double sinkingSpeed(double arealDensity, double fibreDensity, double waterDensity, double dragCoefficient,
                    double gravity) {
  const double weight = arealDensity * (1 - waterDensity / fibreDensity) * gravity;
  return std::copysign(std::sqrt(2 * std::fabs(weight) / (waterDensity * dragCoefficient)), weight);
}

WaterDrag::WaterDrag(Parameters parameters) { setParameters(parameters); }

void WaterDrag::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (lawOf(parameters) != lawOf(m_parameters)) m_surface.reset();  // as if the cloth had felt no water so far
  m_parameters = parameters;
}

void WaterDrag::attach(WetCloth& cloth) {
  requireFaces("WaterDrag", cloth.body());
  const bool firstTime = m_mesh == nullptr;  // later, the application may have let the water out
  if (firstTime) requireSurface("WaterDrag.surface", m_parameters.surface, cloth.body());
  m_mesh = &cloth.restMesh();
  m_triangles.clear();
  for (const RestMesh::Triangle& triangle : m_mesh->triangles()) {
    if (!triangle.isDoubled) m_triangles.push_back(triangle.nodes);
  }
  cloth.packedNodes().fit();
  m_nodes.resize(cloth.water().size());
  m_isImmersed.assign(m_nodes.size(), 0);
}

void WaterDrag::apply(WetCloth& cloth, const Step& step) {
  m_totalForce.setZero();
  m_surface = surfaceFor(m_parameters.surface, cloth.body());
  if (!m_surface || isWellAbove(*m_surface, cloth.body())) return;
  PackedNodes& nodes = cloth.packedNodes();
  nodes.read();
  if (!findImmersed(nodes)) return;
  look(cloth, nodes, step);
  accumulate(nodes, step);
  push(nodes, step);
}

bool WaterDrag::wakes(const WetCloth& cloth, const Step& step) const {
  static_cast<void>(step);
  const std::optional<WaterSurface> now = surfaceFor(m_parameters.surface, cloth.body());
  const bool isReachedNow = isReached(now, cloth.body());
  if (isReachedNow != isReached(m_surface, cloth.body())) return true;
  return isReachedNow && differs(*now, *m_surface, cloth.body());
}

bool WaterDrag::findImmersed(const PackedNodes& nodes) {
  const WaterSurface& surface = *m_surface;
  bool isAny = false;
  for (std::size_t i = 0; i < m_isImmersed.size(); ++i) {
    m_isImmersed[i] = surface.depth(placeOf(nodes, i)) > 0;
    isAny = isAny || m_isImmersed[i];
  }
  m_nodesVisited += static_cast<long long>(m_nodes.size());
  return isAny;
}

// Bullet adds gravity right after us. Resistance that looks at the velocity with gravity and buoyancy in it balances
// them exactly at the terminal speed.
void WaterDrag::look(const WetCloth& cloth, const PackedNodes& nodes, const Step& step) {
  const Water& water = cloth.water();
  const std::vector<double>& areas = m_mesh->nodeAreas();
  const btScalar dt = static_cast<btScalar>(step.dt);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    if (!m_isImmersed[i]) continue;
    NodeState& state = m_nodes[i];
    const std::size_t slot = nodes.slot(i);
    const btScalar inverseMass = nodes.inverseMass[slot];
    const btVector3 velocity(nodes.velocity[0][slot], nodes.velocity[1][slot], nodes.velocity[2][slot]);
    const double volume = displacedVolume(water.dryMass(i), m_parameters.fibreDensity, water.held(i));
    state.lift = step.gravity * static_cast<btScalar>(-m_surface->density * volume);
    const btVector3 fall = (step.gravity * static_cast<btScalar>(step.fallShare) + state.lift * inverseMass) * dt;
    state.relative = m_surface->velocity - velocity - (inverseMass > 0 ? fall : btVector3(0, 0, 0));
    state.specificArea = static_cast<btScalar>(areas[i]) * inverseMass;
    state.resistance.setZero();
    state.drag = 0;
  }
}

void WaterDrag::accumulate(const PackedNodes& nodes, const Step& step) {
  const FluidResistance resistance = {0, static_cast<btScalar>(m_surface->density * m_parameters.dragCoefficient / 2),
                                      static_cast<btScalar>(m_surface->density * m_parameters.skinFriction / 2),
                                      static_cast<btScalar>(step.dt)};
  const auto isImmersed = [this](int node) { return m_isImmersed[static_cast<std::size_t>(node)]; };
  const auto position = [&](int node) { return placeOf(nodes, static_cast<std::size_t>(node)); };
  for (const Triangle& corners : m_triangles) {
    const auto [a, b, c] = corners;
    if (!(isImmersed(a) | isImmersed(b) | isImmersed(c))) continue;
    resist(corners, flatTriangle(position(a), position(b), position(c)), resistance);
  }
  m_trianglesVisited += static_cast<long long>(m_triangles.size());
}

// Each corner takes its third by its own relative velocity: then the water can only bring a node closer to its own.
void WaterDrag::resist(const Triangle& triangle, const FlatTriangle& shape, const FluidResistance& resistance) {
  NodeState* immersed[3] = {};
  std::size_t count = 0;
  btVector3 mean(0, 0, 0);
  btScalar specificArea = 0;
  for (const int corner : triangle) {
    NodeState& node = m_nodes[static_cast<std::size_t>(corner)];
    if (!m_isImmersed[static_cast<std::size_t>(corner)]) continue;
    immersed[count++] = &node;
    mean += node.relative;
    specificArea += node.specificArea;
  }
  const btScalar share = 1 / static_cast<btScalar>(count);
  const btScalar meanAcross = shape.normal.dot(mean) * share;
  const btScalar meanAlong = (mean * share - shape.normal * meanAcross).length();
  const btScalar third = shape.area / 3;
  const btScalar normal = third * resistance.normal(std::fabs(meanAcross), specificArea * share);
  const btScalar tangent = third * resistance.tangent(meanAlong, specificArea * share);
  for (std::size_t k = 0; k < count; ++k) {
    NodeState& node = *immersed[k];
    const btVector3 across = shape.normal * shape.normal.dot(node.relative);
    node.resistance += across * normal + (node.relative - across) * tangent;
    node.drag += std::max(normal, tangent);
  }
}

// With s >= the largest eigenvalue of the node's drag tensor, (I - dt D / (m + dt s)) never lengthens the velocity
// relative to the water, for any mass and step; on a flat sheet it is backward Euler.
void WaterDrag::push(PackedNodes& nodes, const Step& step) {
  const btScalar dt = static_cast<btScalar>(step.dt);
  double total[3] = {0, 0, 0};
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    if (!m_isImmersed[i]) continue;
    const NodeState& state = m_nodes[i];
    const std::size_t slot = nodes.slot(i);
    const btScalar inverseMass = nodes.inverseMass[slot];
    const btVector3 force = state.lift + state.resistance / (1 + dt * state.drag * inverseMass);
    const btScalar size = force.x() + force.y() + force.z();
    if (!(size - size == 0)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      total[axis] += static_cast<double>(force[axis]);
      nodes.velocity[axis][slot] += force[axis] * (dt * inverseMass);
    }
  }
  nodes.velocitiesChanged();
  m_totalForce.setValue(static_cast<btScalar>(total[0]), static_cast<btScalar>(total[1]),
                        static_cast<btScalar>(total[2]));
}

void WaterDrag::transferState(StateArchive& archive) {
  archive.optional(m_surface, [&](WaterSurface& surface) { surface.transferState(archive); });
  archive.value(m_totalForce, m_nodesVisited, m_trianglesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
