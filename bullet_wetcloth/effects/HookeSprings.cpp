// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/HookeSprings.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/SpringSolver.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Bullet scales a link's correction by its material's stiffness. This little leaves a link in place but powerless;
// exactly zero would make Bullet divide by it.
constexpr btScalar kPowerless = btScalar(1e-12);

// Times m / dt^2 of the heaviest node, a spring does not give way: the weight of n such nodes makes it longer by
// n g dt^2 / 1e10. Beside a much stiffer one a mass is lost to rounding.
constexpr double kRigid = 1e10;

void requireValid(const HookeSprings::Parameters& parameters) {
  requirePositive("HookeSprings.stiffness", parameters.stiffness);
  requireNotNegative("HookeSprings.bendingStiffness", parameters.bendingStiffness);
  for (std::size_t k = 0; k < parameters.perLink.size(); ++k) {
    requireNotNegative("HookeSprings.perLink[" + std::to_string(k) + "]", parameters.perLink[k]);
  }
  if (parameters.iterations < 1) rejectValue("HookeSprings.iterations", parameters.iterations, ">= 1");
}

void requireSize(const HookeSprings::Parameters& parameters, std::size_t links) {
  if (parameters.perLink.empty() || parameters.perLink.size() == links) return;
  rejectValue("HookeSprings.perLink.size()", parameters.perLink.size(),
              "the number of the body's links, " + std::to_string(links));
}

auto stiffnesses(const HookeSprings::Parameters& parameters) {
  return std::tie(parameters.stiffness, parameters.bendingStiffness, parameters.perLink);
}

}  // namespace

btVector3 hookeForce(const btVector3& a, const btVector3& b, double restLength, double stiffness) {
  const btVector3 along = b - a;
  const double length = static_cast<double>(along.length());
  if (!(length > 0)) return btVector3(0, 0, 0);
  return along * static_cast<btScalar>(stiffness * (length - restLength) / length);
}

HookeSprings::HookeSprings(Parameters parameters) : m_solver(std::make_unique<SpringSolver>()) {
  setParameters(std::move(parameters));
}

void HookeSprings::setParameters(Parameters parameters) {
  requireValid(parameters);
  // As many values as before are right after a cut, too.
  const bool isAttached = !m_springs.empty();
  if (isAttached && parameters.perLink.size() != m_parameters.perLink.size()) requireSize(parameters, m_springs.size());
  const bool isOtherStiffness = stiffnesses(parameters) != stiffnesses(m_parameters);
  m_parameters = std::move(parameters);
  if (isAttached && isOtherStiffness) m_stiffnessRevision = kUnscaled;
}

HookeSprings::~HookeSprings() = default;

long long HookeSprings::factorizations() const { return m_solver->factorizations(); }

void HookeSprings::attach(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  const std::size_t links = static_cast<std::size_t>(body.m_links.size());
  if (links == 0) rejectValue("HookeSprings: body.m_links.size()", 0, "at least 1: the springs are the body's links");
  // A second one would take the first one's powerless links for the body's own.
  if (cloth.has(name(), this)) reject("HookeSprings", "the cloth has them already");
  const bool isFirst = !m_powerless;
  if (isFirst) requireSize(m_parameters, links);
  disableLinks(cloth);
  m_springs.resize(links);
  for (std::size_t k = 0; k < links; ++k) {
    const btSoftBody::Link& link = body.m_links[static_cast<int>(k)];
    m_springs[k].a = nodeIndex(body, link.m_n[0]);
    m_springs[k].b = nodeIndex(body, link.m_n[1]);
  }
  m_stiffnessRevision = kUnscaled;
  m_limitedSprings = m_springs;
  m_nodes.resize(static_cast<std::size_t>(body.m_nodes.size()));
  m_solver->reset(m_nodes.size(), m_springs.size());
}

double HookeSprings::stiffnessOf(const btSoftBody::Link& link, std::size_t index) const {
  if (index < m_parameters.perLink.size()) return m_parameters.perLink[index];
  return link.m_bbending ? m_parameters.bendingStiffness : m_parameters.stiffness;
}

void HookeSprings::scaleStiffness(WetCloth& cloth) {
  const LinkConstants& links = cloth.linkConstants();
  if (links.stiffnessRevision() == m_stiffnessRevision) return;
  m_stiffnessRevision = links.stiffnessRevision();
  const std::vector<btScalar>& factors = links.stiffness();
  const bool isScaled = factors.size() == m_springs.size();
  for (std::size_t k = 0; k < m_springs.size(); ++k) {
    const double own = stiffnessOf(cloth.body().m_links[static_cast<int>(k)], k);
    m_springs[k].stiffness = isScaled ? own * static_cast<double>(factors[k]) : own;
  }
  m_solver->noteStiffness(m_springs);
}

// A link that was cut copies its neighbour's material, ours: it gets the body's first one back in the end.
void HookeSprings::disableLinks(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  if (!m_powerless) {
    m_powerless = body.appendMaterial();
    m_powerless->m_kLST = kPowerless;
  }
  for (int k = 0; k < body.m_links.size(); ++k) {
    btSoftBody::Material*& material = body.m_links[k].m_material;
    const bool isNew = static_cast<std::size_t>(k) >= m_ownMaterials.size();
    if (isNew) m_ownMaterials.push_back(material == m_powerless ? body.m_materials[0] : material);
    material = m_powerless;
  }
  cloth.linkConstants().refresh();
}

void HookeSprings::detach(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  for (int k = 0; k < body.m_links.size(); ++k) {
    const std::size_t index = static_cast<std::size_t>(k);
    body.m_links[k].m_material = index < m_ownMaterials.size() ? m_ownMaterials[index] : body.m_materials[0];
  }
  cloth.linkConstants().refresh();
}

void HookeSprings::apply(WetCloth& cloth, const Step& step) {
  scaleStiffness(cloth);
  gather(cloth.body(), step);
  followAnchors(cloth.body(), step);
  const std::vector<Spring>& springs = limitedSprings(step.dt);
  m_solver->solve(springs, m_nodes, step.dt, m_parameters.iterations);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    if (m_nodes[i].isFixed) continue;
    const std::array<double, 3>& change = m_nodes[i].velocityChange;
    cloth.push(cloth.body().m_nodes[static_cast<int>(i)],
               btVector3(static_cast<btScalar>(change[0]), static_cast<btScalar>(change[1]),
                         static_cast<btScalar>(change[2])));
  }
  pullAnchors(cloth.body(), springs, step);
}

const std::vector<Spring>& HookeSprings::limitedSprings(double dt) {
  double mass = 0;
  for (const SpringNode& node : m_nodes) mass = std::max(mass, node.mass);
  const double most = kRigid * mass / (dt * dt);
  const auto isWithin = [&](const Spring& spring) { return spring.stiffness <= most; };
  if (std::all_of(m_springs.begin(), m_springs.end(), isWithin)) return m_springs;
  m_limitedSprings = m_springs;
  for (Spring& spring : m_limitedSprings) spring.stiffness = std::min(spring.stiffness, most);
  return m_limitedSprings;
}

// Rest lengths are read in every step: Bullet resets them when a body was cut, and an application may change them.
void HookeSprings::gather(const btSoftBody& body, const Step& step) {
  for (std::size_t k = 0; k < m_springs.size(); ++k) {
    m_springs[k].restLength = static_cast<double>(body.m_links[static_cast<int>(k)].m_rl);
  }
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    SpringNode& state = m_nodes[i];
    state.isFixed = !(node.m_im > 0);
    state.mass = state.isFixed ? 0 : 1 / static_cast<double>(node.m_im);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t c = static_cast<std::size_t>(axis);
      state.position[c] = static_cast<double>(node.m_x[axis]);
      state.velocity[c] = static_cast<double>(node.m_v[axis]);
      state.acceleration[c] = state.isFixed ? 0 : static_cast<double>(step.gravity[axis]);
    }
  }
}

namespace {

struct AnchorPoint {
  const btSoftBody::Node* node;
  btRigidBody* rigid;
  btVector3 arm;
};

// Bullet keeps the anchors of its position-based and of its deformable worlds in two lists.
template <class Visit>
void forEachAnchor(btSoftBody& body, Visit visit) {
  for (int k = 0; k < body.m_anchors.size(); ++k) {
    const btSoftBody::Anchor& anchor = body.m_anchors[k];
    const btTransform& transform = anchor.m_body->getWorldTransform();
    visit(AnchorPoint{anchor.m_node, anchor.m_body, transform.getBasis() * anchor.m_local});
  }
  for (int k = 0; k < body.m_deformableAnchors.size(); ++k) {
    btSoftBody::DeformableNodeRigidAnchor& anchor = body.m_deformableAnchors[k];
    btRigidBody* rigid = const_cast<btRigidBody*>(btRigidBody::upcast(anchor.m_cti.m_colObj));
    if (!rigid) continue;
    visit(AnchorPoint{anchor.m_node, rigid, rigid->getWorldTransform().getBasis() * anchor.m_local});
  }
}

}  // namespace

// Bullet ties an anchored node to its rigid body after us. If the springs moved the node freely, the tie would only
// ever carry that one node's momentum, and the cloth would hang far too low.
void HookeSprings::followAnchors(btSoftBody& body, const Step& step) {
  forEachAnchor(body, [&](const AnchorPoint& anchor) {
    SpringNode& state = m_nodes[toSize(nodeIndex(body, anchor.node))];
    const btVector3 target = anchor.rigid->getCenterOfMassPosition() + anchor.arm;
    const btVector3 velocity = anchor.rigid->getVelocityInLocalPoint(anchor.arm);
    state.isFixed = true;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t c = static_cast<std::size_t>(axis);
      state.velocity[c] =
          (static_cast<double>(target[axis]) - state.position[c]) / step.dt + static_cast<double>(velocity[axis]);
    }
  });
}

void HookeSprings::pullAnchors(btSoftBody& body, const std::vector<Spring>& springs, const Step& step) {
  forEachAnchor(body, [&](const AnchorPoint& anchor) {
    if (anchor.rigid->isStaticOrKinematicObject()) return;
    const std::array<double, 3> pull = m_solver->forceOn(springs, toSize(nodeIndex(body, anchor.node)));
    const btVector3 force(static_cast<btScalar>(pull[0]), static_cast<btScalar>(pull[1]),
                          static_cast<btScalar>(pull[2]));
    anchor.rigid->activate();
    anchor.rigid->applyImpulse(force * static_cast<btScalar>(step.dt), anchor.arm);
  });
}

void HookeSprings::transferState(StateArchive& archive) {
  for (Spring& spring : m_springs) archive.value(spring.stiffness);
  archive.value(m_stiffnessRevision);
  m_solver->transferState(archive, m_springs);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
