// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Wind.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Layers.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/numerics/FluidResistance.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/DryMass.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

// Vectors in the packed states have their axes in the order z, x, y.
btVector3 vectorOf(const btScalar (&turned)[4]) { return btVector3(turned[1], turned[2], turned[0]); }
void addTo(btScalar (&turned)[4], const btVector3& v) {
  turned[0] += v.z();
  turned[1] += v.x();
  turned[2] += v.y();
}
btVector3 positionOf(const btScalar (&position)[4]) { return btVector3(position[0], position[1], position[2]); }

using Four = Eigen::Matrix<btScalar, 4, 1>;
Four load(const btScalar (&from)[4]) { return Eigen::Map<const Four, Eigen::Aligned16>(from); }
void store(btScalar (&to)[4], const Four& from) {
  Eigen::Map<Four, Eigen::Aligned16> target(to);
  target = from;
}

void set(btScalar (&to)[4], btScalar v0, btScalar v1, btScalar v2, btScalar v3) {
  to[0] = v0;
  to[1] = v1;
  to[2] = v2;
  to[3] = v3;
}

constexpr btScalar kThird = btScalar(1) / 3;
constexpr btScalar kSixth = btScalar(1) / 6;

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
  m_nodes.resize(static_cast<std::size_t>(body.m_nodes.size()));
  m_drag.resize(m_nodes.size());
  m_triangles = layersOf(body);
  const std::vector<double> areas = nodeAreas(body);
  m_nodeAreas.assign(areas.begin(), areas.end());
}

void Wind::apply(WetCloth& cloth, const Step& step) {
  m_windAtCentre = windAtCentre(cloth, step);
  gather(cloth, step);
  if (m_parameters.law == Law::paper) {
    accumulatePaper(step);
  } else {
    accumulate(step);
    if (m_parameters.law == Law::quadratic && m_parameters.skinFriction > 0) accumulateFriction(step);
  }
  scatter(cloth, step);
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
void Wind::gather(const WetCloth& cloth, const Step& step) {
  const bool isImplicit = m_parameters.integration == Integration::semiImplicit;
  const btVector3 fall = isImplicit ? step.gravity * static_cast<btScalar>(step.dt) : btVector3(0, 0, 0);
  const btVector3 uniform = m_parameters.velocity.constant();  // zero when it is a function
  const btSoftBody::Node* node = &cloth.body().m_nodes[0];
  for (std::size_t i = 0; i < m_nodes.size(); ++i, ++node) {
    NodeState& state = m_nodes[i];
    const btVector3 relative = uniform - node->m_v - (node->m_im > 0 ? fall : btVector3(0, 0, 0));
    set(state.position, node->m_x.x(), node->m_x.y(), node->m_x.z(), m_nodeAreas[i] * node->m_im);
    set(state.turnedPosition, node->m_x.y(), node->m_x.z(), node->m_x.x(), 0);
    set(state.relative, relative.z(), relative.x(), relative.y(), 0);
    set(state.force, 0, 0, 0, 0);
  }
  std::fill(m_drag.begin(), m_drag.end(), btScalar(0));
}

// Triangles go through three short loops in blocks that stay in the first cache: the middle one, with its roots and
// divisions, then works on plain arrays, several triangles in one instruction.
struct Wind::Block {
  static constexpr std::size_t kSize = 16;
  struct alignas(4 * sizeof(btScalar)) Products {
    btScalar normal[4];      // N, twice the area along the normal
    btScalar squared[4];     // N N, and the other products component by component
    btScalar towards[3][4];  // N u of each corner
  };
  Products products[kSize];
  btScalar specificArea[kSize];
  btScalar towards[3][kSize];
  btScalar push[kSize];  // R / (6 |N|)
  btScalar drag[kSize];  // R |N| / 6

  void resist(const FluidResistance& resistance);
};

void Wind::accumulate(const Step& step) {
  Block block = {};
  for (std::size_t first = 0; first < m_triangles.size(); first += Block::kSize) {
    accumulate(block, step, first, std::min(Block::kSize, m_triangles.size() - first));
  }
}

// Each corner is pushed by its own relative velocity: then the air can only bring a node closer to its own velocity.
// With N the normal times twice the area and resistance R, the force on a corner is R (N . u) N / (6 |N|).
void Wind::accumulate(Block& block, const Step& step, std::size_t first, std::size_t count) {
  const WindField& field = m_parameters.velocity;
  for (std::size_t f = 0; f < count; ++f) {
    const std::array<int, 3>& corners = m_triangles[first + f];
    const NodeState& a = m_nodes[static_cast<std::size_t>(corners[0])];
    const NodeState& b = m_nodes[static_cast<std::size_t>(corners[1])];
    const NodeState& c = m_nodes[static_cast<std::size_t>(corners[2])];
    const Four ab = load(b.position) - load(a.position);
    const Four ac = load(c.position) - load(a.position);
    const Four turnedAb = load(b.turnedPosition) - load(a.turnedPosition);
    const Four turnedAc = load(c.turnedPosition) - load(a.turnedPosition);
    const Four normal = ab.cwiseProduct(turnedAc) - turnedAb.cwiseProduct(ac);
    Four wind = Four::Zero();
    if (field.isFunction()) {
      const btVector3 centre = (positionOf(a.position) + positionOf(b.position) + positionOf(c.position)) * kThird;
      const btVector3 there = field.at(centre, step.time);
      wind = Four(there.z(), there.x(), there.y(), 0);
    }
    Block::Products& products = block.products[f];
    store(products.normal, normal);
    store(products.squared, normal.cwiseProduct(normal));
    store(products.towards[0], normal.cwiseProduct(load(a.relative) + wind));
    store(products.towards[1], normal.cwiseProduct(load(b.relative) + wind));
    store(products.towards[2], normal.cwiseProduct(load(c.relative) + wind));
    block.specificArea[f] = (a.position[3] + b.position[3] + c.position[3]) * kThird;
  }
  block.resist(resistanceOf(m_parameters, step));
  for (std::size_t f = 0; f < count; ++f) {
    const Four normal = load(block.products[f].normal) * block.push[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = static_cast<std::size_t>(m_triangles[first + f][k]);
      store(m_nodes[node].force, load(m_nodes[node].force) + normal * block.towards[k][f]);
      m_drag[node] += block.drag[f];
    }
  }
}

void Wind::Block::resist(const FluidResistance& resistance) {
  btScalar squared[kSize];
  for (std::size_t f = 0; f < kSize; ++f) {
    const auto sum = [](const btScalar(&v)[4]) { return v[0] + v[1] + v[2]; };
    squared[f] = sum(products[f].squared);
    for (std::size_t k = 0; k < 3; ++k) towards[k][f] = sum(products[f].towards[k]);
  }
  for (std::size_t f = 0; f < kSize; ++f) {
    const btScalar length = std::sqrt(squared[f]);
    const btScalar inverse = length > 0 ? 1 / length : 0;  // a triangle without area feels nothing
    const btScalar speed = std::fabs(towards[0][f] + towards[1][f] + towards[2][f]) * inverse * kThird;
    const btScalar sixth = resistance.normal(speed, specificArea[f]) * kSixth;
    push[f] = sixth * inverse;
    drag[f] = sixth * length;
  }
}

// A pass of its own, since few scenes ask for it.
void Wind::accumulateFriction(const Step& step) {
  const FluidResistance resistance = resistanceOf(m_parameters, step);
  const WindField& field = m_parameters.velocity;
  for (const std::array<int, 3>& corners : m_triangles) {
    NodeState* nodes[3];
    btVector3 x[3];
    btScalar specificArea = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k] = &m_nodes[static_cast<std::size_t>(corners[k])];
      x[k] = positionOf(nodes[k]->position);
      specificArea += nodes[k]->position[3] * kThird;
    }
    const FlatTriangle triangle = flatTriangle(x[0], x[1], x[2]);
    const btVector3 wind = field.isFunction() ? field.at((x[0] + x[1] + x[2]) * kThird, step.time) : btVector3(0, 0, 0);
    btVector3 along[3];
    for (int k = 0; k < 3; ++k) {
      const btVector3 relative = vectorOf(nodes[k]->relative) + wind;
      along[k] = relative - triangle.normal * triangle.normal.dot(relative);
    }
    const btScalar speed = (along[0] + along[1] + along[2]).length() * kThird;
    const btScalar third = resistance.tangent(speed, specificArea) * triangle.area * kThird;
    for (int k = 0; k < 3; ++k) {
      addTo(nodes[k]->force, along[k] * third);
      m_drag[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])] += third;
    }
  }
}

void Wind::accumulatePaper(const Step& step) {
  const WindField& field = m_parameters.velocity;
  const btScalar unit = static_cast<btScalar>(m_parameters.paperForce);
  for (const std::array<int, 3>& corners : m_triangles) {
    btVector3 x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = positionOf(m_nodes[static_cast<std::size_t>(corners[k])].position);
    const btVector3 wind = field.at((x[0] + x[1] + x[2]) * kThird, step.time);
    const btVector3 force = paperWindForce(x[0], x[1], x[2], wind) * unit;
    for (const int corner : corners) addTo(m_nodes[static_cast<std::size_t>(corner)].force, force);
  }
}

// With s >= the largest eigenvalue of the node's drag tensor D, v' - w = (I - dt D / (m + dt s)) (v - w) never
// lengthens the difference to the wind, for any mass and step; on a flat sheet it is backward Euler.
void Wind::scatter(WetCloth& cloth, const Step& step) {
  const btScalar dt = static_cast<btScalar>(step.dt);
  const btScalar implicitDt = m_parameters.integration == Integration::semiImplicit ? dt : 0;
  double total[3] = {0, 0, 0};
  btSoftBody::Node* node = &cloth.body().m_nodes[0];
  for (std::size_t i = 0; i < m_nodes.size(); ++i, ++node) {
    const btVector3 force = vectorOf(m_nodes[i].force) / (1 + implicitDt * m_drag[i] * node->m_im);
    for (int axis = 0; axis < 3; ++axis) total[axis] += static_cast<double>(force[axis]);
    cloth.push(*node, force * (dt * node->m_im));
  }
  m_totalForce.setValue(static_cast<btScalar>(total[0]), static_cast<btScalar>(total[1]),
                        static_cast<btScalar>(total[2]));
}

void Wind::transferState(StateArchive& archive) {
  archive.array(m_nodeAreas);
  archive.value(m_totalForce, m_windAtCentre);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
