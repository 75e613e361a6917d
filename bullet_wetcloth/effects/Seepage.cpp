// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Seepage.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"
#include "bullet_wetcloth/numerics/EdgeFlow.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kEarthGravity = 9.81;  // [m/s^2]
constexpr double kMostSeepageSubsteps = 64;
constexpr double kLargestSeepageExponent = 100;

void requireValid(const Seepage::Parameters& parameters) {
  requireNotNegative("Seepage.speed", parameters.speed);
  if (!(parameters.exponent >= 1 && parameters.exponent <= kLargestSeepageExponent)) {
    rejectValue("Seepage.exponent", parameters.exponent, "in [1, 100]");
  }
}

// With the nodes' conductivities known.
double upwindFlow(double conductance, double speed, double first, double second, double drop) {
  return conductance * speed * (drop > 0 ? first : second) * drop;
}

}  // namespace

double relativeConductivity(double saturation, double exponent) {
  if (exponent == 1) return saturation;
  if (exponent == 3) return saturation * saturation * saturation;
  return std::pow(saturation, exponent);
}

double seepageFlow(double conductance, double speed, double exponent, double firstSaturation, double secondSaturation,
                   double drop) {
  return upwindFlow(conductance, speed, relativeConductivity(firstSaturation, exponent),
                    relativeConductivity(secondSaturation, exponent), drop);
}

Seepage::Seepage(Parameters parameters) : m_flow(std::make_unique<EdgeFlow>()) { setParameters(parameters); }

void Seepage::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;
  m_steadyState.restart();
}

Seepage::~Seepage() = default;

void Seepage::attach(WetCloth& cloth) {
  requireFaces("Seepage", cloth.body());
  m_mesh = &cloth.restMesh();
  layEdges();
  for (auto* array : {&m_depths, &m_conductivity, &m_outflow}) array->assign(m_flow->nodeCount(), 0);
  m_steadyState.restart();
}

void Seepage::layEdges() {
  m_flow->reset(*m_mesh, delaunayWeights(measuredTriangles(*m_mesh)));
  for (auto* array : {&m_fluxes, &m_substepFluxes}) array->assign(m_flow->edges().size(), 0);
}

void Seepage::apply(WetCloth& cloth, const Step& step) {
  if (m_steadyState.isReached(cloth.body(), cloth.water(), step.gravity)) return;
  m_flow->load(cloth.water());
  measureDepths(cloth, step);
  const double speed = m_parameters.speed * static_cast<double>(step.gravity.length()) / kEarthGravity;
  flow(std::isfinite(speed) ? speed : 0, step.dt);
  if (m_flow->hasMoved()) {
    cloth.joinArrivals();
    m_flow->commit(cloth.body(), cloth.water(), m_fluxes,
                   [&](btSoftBody::Node& node, const btVector3& change) { cloth.push(node, change); });
  }
  m_nodesVisited += static_cast<long long>(m_flow->nodeCount());
  m_steadyState.note(cloth.body(), cloth.water(), step.gravity, step.dt, m_flow->moved());
}

void Seepage::measureDepths(const WetCloth& cloth, const Step& step) {
  const btSoftBody& body = cloth.body();
  const btVector3 down = step.gravity.fuzzyZero() ? btVector3(0, 0, 0) : step.gravity.normalized();
  // From node 0, so that a cloth far from the origin keeps its precision.
  const btVector3& origin = body.m_nodes[0].m_x;
  for (std::size_t i = 0; i < m_depths.size(); ++i) {
    const double depth = static_cast<double>(down.dot(body.m_nodes[static_cast<int>(i)].m_x - origin));
    m_depths[i] = std::isfinite(depth) ? depth : 0;
  }
}

// So many that no wave, of speed n v at most, passes a node in one of them.
double Seepage::substepCount(double speed, double dt) {
  std::fill(m_outflow.begin(), m_outflow.end(), 0);
  for (const WeightedEdge& edge : m_flow->edges()) {
    const double drop = m_depths[toSize(edge.b)] - m_depths[toSize(edge.a)];
    m_outflow[toSize(drop > 0 ? edge.a : edge.b)] += edge.weight * std::fabs(drop);
  }
  double fastest = 0;
  for (std::size_t i = 0; i < m_outflow.size(); ++i) {
    fastest = std::max(fastest, m_outflow[i] / m_flow->capacities()[i]);
  }
  return std::clamp(std::ceil(dt * speed * m_parameters.exponent * fastest), 1.0, kMostSeepageSubsteps);
}

void Seepage::flow(double speed, double dt) {
  const double count = substepCount(speed, dt);
  const auto& edges = m_flow->edges();
  std::fill(m_fluxes.begin(), m_fluxes.end(), 0);
  for (int substep = 0; substep < static_cast<int>(count); ++substep) {
    for (std::size_t i = 0; i < m_conductivity.size(); ++i) {
      m_conductivity[i] = relativeConductivity(m_flow->saturation(i), m_parameters.exponent);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::size_t a = toSize(edges[e].a);
      const std::size_t b = toSize(edges[e].b);
      const double flow =
          upwindFlow(edges[e].weight, speed, m_conductivity[a], m_conductivity[b], m_depths[b] - m_depths[a]);
      m_substepFluxes[e] = dt / count * flow;
    }
    m_flow->limit(m_substepFluxes);
    for (std::size_t e = 0; e < edges.size(); ++e) m_fluxes[e] += m_substepFluxes[e];
    ++m_substeps;
  }
}

void Seepage::transferState(StateArchive& archive) {
  if (archive.isRestoring()) layEdges();  // the mesh at rest may be another one than when the effect was added here
  m_flow->transferState(archive);
  m_steadyState.transferState(archive);
  archive.value(m_nodesVisited, m_substeps);
}

Seepage::Parameters seepageInBalance(const Diffusion::Parameters& diffusion, double height) {
  requirePositive("seepageInBalance.height", height);
  static_cast<void>(Diffusion(diffusion));  // is it one?
  Seepage::Parameters parameters;
  parameters.speed = std::sqrt(diffusion.warpDiffusivity) * std::sqrt(diffusion.weftDiffusivity) / height;
  parameters.exponent = std::min(diffusion.exponent + 1, kLargestSeepageExponent);
  return parameters;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
