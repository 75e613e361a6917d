#include "bullet_wetcloth/effects/Wind.h"

#include "bullet_wetcloth/DryMass.h"
#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btVector3 vectorOf(const btScalar (&components)[3]) {
  return btVector3(components[0], components[1], components[2]);
}

// A triangle's unit normal and area; area 0 and normal 0 for one that has none (or is not finite).
struct Triangle {
  btVector3 normal;
  btScalar area;
};

Triangle triangleOf(const btVector3& a, const btVector3& b, const btVector3& c) {
  const btVector3 twice = (b - a).cross(c - a);
  const btScalar length = twice.length();
  if (!(length > 0 && std::isfinite(length))) return {btVector3(0, 0, 0), 0};
  return {twice / length, length / 2};
}

// How a triangle resists relative motion, per corner: along its normal and along its surface [kg/s].
struct Resistance {
  btScalar normal;
  btScalar tangent;
};

// Speed at the end of a step of du/dt = -a |u| u by backward Euler, from speed u: the root of v + a v^2 = u. With it
// as the lagged coefficient, a falling sheet reaches its terminal speed exactly, whatever the step.
btScalar dampedSpeed(btScalar u, btScalar a) { return 2 * u / (1 + std::sqrt(1 + 4 * a * u)); }

struct QuadraticLaw {
  btScalar normalFactor;   // 1/2 rho C_d
  btScalar tangentFactor;  // 1/2 rho C_f
  btScalar implicitDt;     // 0: explicit

  Resistance operator()(btScalar thirdOfArea, btScalar specificArea, btScalar normalSpeed,
                        btScalar tangentSpeed) const {
    const btScalar reach = implicitDt * specificArea;
    const btScalar normal = normalFactor * dampedSpeed(normalSpeed, reach * normalFactor);
    const btScalar tangent = tangentFactor * dampedSpeed(tangentSpeed, reach * tangentFactor);
    return {thirdOfArea * normal, thirdOfArea * tangent};
  }
};

struct LinearLaw {
  btScalar linearDrag;
  static constexpr btScalar tangentFactor = 0;
  Resistance operator()(btScalar thirdOfArea, btScalar, btScalar, btScalar) const {
    return {thirdOfArea * linearDrag, 0};
  }
};

btVector3 splitForce(const Resistance& resistance, const btVector3& normal, const btVector3& relative) {
  const btVector3 across = normal * normal.dot(relative);
  return across * resistance.normal + (relative - across) * resistance.tangent;
}

template <class TriangleLaw>
btVector3 forceOnTriangle(const Triangle& triangle, const btVector3& relative, const TriangleLaw& law) {
  const btScalar normalSpeed = triangle.normal.dot(relative);
  const btScalar tangentSpeed = (relative - triangle.normal * normalSpeed).length();
  const Resistance each = law(triangle.area / 3, 0, std::fabs(normalSpeed), tangentSpeed);
  return splitForce(each, triangle.normal, relative) * 3;
}

}  // namespace

btVector3 paperWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& wind) {
  const btVector3 normal = triangleOf(a, b, c).normal;
  return normal * normal.dot(wind);
}

btVector3 quadraticWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& velocity,
                             const btVector3& wind, double airDensity, double dragCoefficient,
                             double skinFriction) {
  const QuadraticLaw law = {static_cast<btScalar>(airDensity * dragCoefficient / 2),
                            static_cast<btScalar>(airDensity * skinFriction / 2), 0};
  return forceOnTriangle(triangleOf(a, b, c), wind - velocity, law);
}

btVector3 linearWindForce(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& velocity,
                          const btVector3& wind, double linearDrag) {
  return forceOnTriangle(triangleOf(a, b, c), wind - velocity, LinearLaw{static_cast<btScalar>(linearDrag)});
}

Wind::Wind(Parameters parameters) : m_parameters(std::move(parameters)) {
  m_parameters.velocity.requireValid("Wind.velocity");
  requireNotNegative("Wind.airDensity", m_parameters.airDensity);
  requireNotNegative("Wind.dragCoefficient", m_parameters.dragCoefficient);
  requireNotNegative("Wind.skinFriction", m_parameters.skinFriction);
  requireNotNegative("Wind.linearDrag", m_parameters.linearDrag);
  requireNotNegative("Wind.paperForce", m_parameters.paperForce);
}

void Wind::setVelocity(WindField velocity) {
  velocity.requireValid("Wind.velocity");
  m_parameters.velocity = std::move(velocity);
}

void Wind::attach(WetCloth& cloth) {
  const btSoftBody& body = cloth.body();
  if (body.m_faces.size() == 0) {
    rejectValue("Wind: body.m_faces.size()", 0, "at least 1: wind pushes on triangles, and a rope has none");
  }
  m_nodes.resize(static_cast<std::size_t>(body.m_nodes.size()));
  m_triangles.resize(static_cast<std::size_t>(body.m_faces.size()));
  for (std::size_t f = 0; f < m_triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      m_triangles[f][k] = static_cast<int>(body.m_faces[static_cast<int>(f)].m_n[k] - &body.m_nodes[0]);
    }
  }
  const std::vector<double> areas = nodeAreas(body);
  m_nodeAreas.assign(areas.begin(), areas.end());
}

void Wind::apply(WetCloth& cloth, const Step& step) {
  gather(cloth, step);
  switch (m_parameters.law) {
    case Law::paper: accumulatePaper(step); break;
    case Law::linear: accumulate(step, LinearLaw{static_cast<btScalar>(m_parameters.linearDrag)}); break;
    case Law::quadratic: {
      const bool isImplicit = m_parameters.integration == Integration::semiImplicit;
      const double half = m_parameters.airDensity / 2;
      accumulate(step, QuadraticLaw{static_cast<btScalar>(half * m_parameters.dragCoefficient),
                                    static_cast<btScalar>(half * m_parameters.skinFriction),
                                    isImplicit ? static_cast<btScalar>(step.dt) : 0});
      break;
    }
  }
  scatter(cloth, step);
}

// Bullet adds gravity right after us. Drag that looks at the velocity with gravity in it balances it exactly at the
// terminal speed.
void Wind::gather(const WetCloth& cloth, const Step& step) {
  const bool isExplicit =
      m_parameters.integration == Integration::explicitEuler || m_parameters.law == Law::paper;
  const btVector3 fall = isExplicit ? btVector3(0, 0, 0) : step.gravity * static_cast<btScalar>(step.dt);
  const btSoftBody::Node* node = &cloth.body().m_nodes[0];
  for (std::size_t i = 0; i < m_nodes.size(); ++i, ++node) {
    NodeState& state = m_nodes[i];
    const bool isFree = node->m_im > 0;
    for (int axis = 0; axis < 3; ++axis) {
      state.position[axis] = node->m_x[axis];
      state.velocity[axis] = node->m_v[axis] + (isFree ? fall[axis] : 0);
      state.force[axis] = 0;
    }
    state.drag = 0;
    state.inverseMass = node->m_im;
    state.specificArea = m_nodeAreas[i] * node->m_im;
  }
}

template <class TriangleLaw>
void Wind::accumulate(const Step& step, const TriangleLaw& law) {
  const WindField& field = m_parameters.velocity;
  btVector3 wind = field.constant();
  for (const std::array<int, 3>& corners : m_triangles) {
    NodeState* const nodes[3] = {&m_nodes[static_cast<std::size_t>(corners[0])],
                                 &m_nodes[static_cast<std::size_t>(corners[1])],
                                 &m_nodes[static_cast<std::size_t>(corners[2])]};
    const btVector3 a = vectorOf(nodes[0]->position);
    const btVector3 b = vectorOf(nodes[1]->position);
    const btVector3 c = vectorOf(nodes[2]->position);
    const Triangle triangle = triangleOf(a, b, c);
    if (field.isFunction()) wind = field.at((a + b + c) / 3, step.time);

    btVector3 relative[3];
    for (int k = 0; k < 3; ++k) relative[k] = wind - vectorOf(nodes[k]->velocity);
    const btVector3 mean = (relative[0] + relative[1] + relative[2]) / 3;
    const btScalar normalSpeed = triangle.normal.dot(mean);
    const btScalar tangentSpeed =
        law.tangentFactor == 0 ? 0 : (mean - triangle.normal * normalSpeed).length();
    const btScalar specificArea =
        (nodes[0]->specificArea + nodes[1]->specificArea + nodes[2]->specificArea) / 3;
    const Resistance each = law(triangle.area / 3, specificArea, std::fabs(normalSpeed), tangentSpeed);

    // Each corner by its own relative velocity: then the air can only bring a node closer to its own velocity.
    for (int k = 0; k < 3; ++k) {
      const btVector3 force = splitForce(each, triangle.normal, relative[k]);
      for (int axis = 0; axis < 3; ++axis) nodes[k]->force[axis] += force[axis];
      nodes[k]->drag += std::max(each.normal, each.tangent);
    }
  }
}

void Wind::accumulatePaper(const Step& step) {
  const WindField& field = m_parameters.velocity;
  btVector3 wind = field.constant();
  for (const std::array<int, 3>& corners : m_triangles) {
    btVector3 x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = vectorOf(m_nodes[static_cast<std::size_t>(corners[k])].position);
    if (field.isFunction()) wind = field.at((x[0] + x[1] + x[2]) / 3, step.time);
    const btVector3 force = paperWindForce(x[0], x[1], x[2], wind) * static_cast<btScalar>(m_parameters.paperForce);
    for (const int corner : corners) {
      for (int axis = 0; axis < 3; ++axis) m_nodes[static_cast<std::size_t>(corner)].force[axis] += force[axis];
    }
  }
}

// With s >= the largest eigenvalue of the node's drag tensor, v' - w = (I - dt D / (m + dt s)) (v - w) never
// lengthens the difference to the wind, for any mass and step; on a flat sheet it is backward Euler.
void Wind::scatter(WetCloth& cloth, const Step& step) {
  const btScalar dt = static_cast<btScalar>(step.dt);
  const bool isImplicit = m_parameters.integration == Integration::semiImplicit;
  CompensatedSum total[3];
  btSoftBody::Node* node = &cloth.body().m_nodes[0];
  for (const NodeState& state : m_nodes) {
    const btScalar damping = isImplicit ? 1 / (1 + dt * state.drag * state.inverseMass) : 1;
    const btVector3 force = vectorOf(state.force) * damping;
    for (int axis = 0; axis < 3; ++axis) total[axis].add(static_cast<double>(force[axis]));
    cloth.push(*node, force * (dt * state.inverseMass));
    ++node;
  }
  m_totalForce.setValue(static_cast<btScalar>(total[0].value()), static_cast<btScalar>(total[1].value()),
                        static_cast<btScalar>(total[2].value()));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
