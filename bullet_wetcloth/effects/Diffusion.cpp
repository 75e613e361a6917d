// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Diffusion.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/RequireFaces.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"
#include "bullet_wetcloth/numerics/DiffusionSolver.h"
#include "bullet_wetcloth/numerics/DiffusionStep.h"
#include "bullet_wetcloth/numerics/Direction.h"
#include "bullet_wetcloth/numerics/EdgeFlow.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kMostDiffusionSubsteps = 1000;
constexpr double kLargestDiffusionExponent = 100;

void requireValid(const Diffusion::Parameters& parameters) {
  requirePositive("Diffusion.warpDiffusivity", parameters.warpDiffusivity);
  requirePositive("Diffusion.weftDiffusivity", parameters.weftDiffusivity);
  if (!(parameters.exponent >= 0 && parameters.exponent <= kLargestDiffusionExponent)) {
    rejectValue("Diffusion.exponent", parameters.exponent, "in [0, 100]");
  }
  requireFinite("Diffusion.warp", parameters.warp);
  if (directionOf(parameters.warp).isZero()) reject("Diffusion.warp", "must not be of length 0");
  if (!(parameters.tolerance > 0 && parameters.tolerance < 1)) {
    rejectValue("Diffusion.tolerance", parameters.tolerance, "in (0, 1)");
  }
}

std::array<btScalar, 3> warpOf(const Diffusion::Parameters& parameters) {
  return {parameters.warp.x(), parameters.warp.y(), parameters.warp.z()};
}

// What the edges' weights are made of.
auto conductance(const Diffusion::Parameters& parameters) {
  return std::make_tuple(parameters.warpDiffusivity, parameters.weftDiffusivity, warpOf(parameters));
}

std::vector<WeightedEdge> diffusionEdges(const RestMesh& mesh, const Diffusion::Parameters& parameters,
                                         const std::vector<double>& warpCoordinate) {
  const double warp = parameters.warpDiffusivity;
  const double weft = parameters.weftDiffusivity;
  std::vector<WeightedEdge> edges =
      delaunayWeights(warp == weft ? measuredTriangles(mesh) : orthotropicTriangles(mesh, warpCoordinate, warp, weft));
  const double mean = std::sqrt(warp) * std::sqrt(weft);
  for (WeightedEdge& edge : edges) edge.weight *= mean;
  return edges;
}

}  // namespace

double relativeDiffusivity(double saturation, double exponent) { return std::pow(saturation, exponent); }

double diffusionPotential(double saturation, double exponent) {
  if (exponent == 0) return saturation;
  if (exponent == 1) return saturation * saturation / 2;
  if (exponent == 2) return saturation * saturation * saturation / 3;
  return saturation * std::pow(saturation, exponent) / (exponent + 1);
}

Diffusion::Diffusion(Parameters parameters)
    : m_flow(std::make_unique<EdgeFlow>()),
      m_solver(std::make_unique<DiffusionSolver>()),
      m_step(std::make_unique<DiffusionStep>()) {
  setParameters(parameters);
}

void Diffusion::setParameters(Parameters parameters) {
  requireValid(parameters);
  if (m_cloth && conductance(parameters) != conductance(m_parameters)) conductAs(parameters);
  m_parameters = parameters;
  m_steadyState.restart();
}

// Takes over what another one builds that is added now. It keeps the warp that it knows, unless that is another one.
void Diffusion::conductAs(const Parameters& parameters) {
  Diffusion built(parameters);
  const bool isSameWarp = warpOf(parameters) == warpOf(m_parameters);
  if (isSameWarp) built.m_warpCoordinate = m_warpCoordinate;
  built.attach(*m_cloth);
  m_flow.swap(built.m_flow);
  m_step.swap(built.m_step);
  m_warpCoordinate.swap(built.m_warpCoordinate);
  m_saturation.swap(built.m_saturation);
  m_potential.swap(built.m_potential);
  m_fluxes.swap(built.m_fluxes);
  m_substepFluxes.swap(built.m_substepFluxes);
  m_solver->forgetFactor();
}

Diffusion::~Diffusion() = default;

long long Diffusion::solves() const { return m_solver->solves(); }
long long Diffusion::factorizations() const { return m_solver->factorizations(); }
long long Diffusion::iterations() const { return m_solver->iterations(); }

void Diffusion::attach(WetCloth& cloth) {
  requireFaces("Diffusion", cloth.body());
  m_cloth = &cloth;
  rememberWarp(cloth);
  layEdges();
  m_solver->reset(m_flow->nodeCount());
  m_saturation.assign(m_flow->nodeCount(), 0);
  m_potential.assign(m_flow->nodeCount(), 0);
  m_steadyState.restart();
}

void Diffusion::layEdges() {
  const RestMesh& mesh = m_cloth->restMesh();
  m_flow->reset(mesh, diffusionEdges(mesh, m_parameters, m_warpCoordinate));
  m_fluxes.assign(m_flow->edges().size(), 0);
  m_substepFluxes.assign(m_flow->edges().size(), 0);
  m_step->reset(m_flow->nodeCount(), m_flow->edges().size());
}

void Diffusion::detach(WetCloth&) { m_cloth = nullptr; }

// How far each node lies along the warp. A node made by a cut lies where its neighbours do.
void Diffusion::rememberWarp(WetCloth& cloth) {
  const btSoftBody& body = cloth.body();
  const std::size_t known = m_warpCoordinate.size();
  m_warpCoordinate.resize(cloth.water().size(), 0);
  const btVector3 warp = directionOf(m_parameters.warp);
  for (std::size_t i = known; i < m_warpCoordinate.size(); ++i) {
    if (known == 0) {
      m_warpCoordinate[i] = static_cast<double>(warp.dot(body.m_nodes[static_cast<int>(i)].m_x));
      continue;
    }
    double sum = 0;
    int count = 0;
    for (const int neighbour : cloth.restMesh().neighbours(i)) {
      if (toSize(neighbour) >= i) continue;
      sum += m_warpCoordinate[toSize(neighbour)];
      ++count;
    }
    m_warpCoordinate[i] = count > 0 ? sum / count : 0;
  }
}

void Diffusion::apply(WetCloth& cloth, const Step& step) {
  if (m_steadyState.isReached(cloth.body(), cloth.water(), step.gravity)) return;
  if (m_flow->load(cloth.water())) {
    m_solver->forgetFactor();
    m_longestSubstep = longestExplicitStep(m_flow->edges(), m_flow->capacities());
  }
  if (m_parameters.method == Method::explicitSubsteps) {
    flowInSubsteps(step.dt);
  } else {
    flowInOneStep(step.dt);
  }
  if (m_flow->hasMoved()) {
    cloth.joinArrivals();
    m_flow->commit(cloth.body(), cloth.water(), m_fluxes,
                   [&](btSoftBody::Node& node, const btVector3& change) { cloth.push(node, change); });
  }
  m_nodesVisited += static_cast<long long>(m_flow->nodeCount());
  m_steadyState.note(cloth.body(), cloth.water(), step.gravity, step.dt, m_flow->moved());
}

void Diffusion::flowInOneStep(double dt) {
  const auto& edges = m_flow->edges();
  const auto& capacities = m_flow->capacities();
  const double tau = DiffusionStep::kGamma * dt;
  for (std::size_t i = 0; i < m_saturation.size(); ++i) m_saturation[i] = m_flow->saturation(i);
  const auto potential = [this](double s) { return diffusionPotential(s, m_parameters.exponent); };
  if (m_parameters.method == Method::factored) {
    const auto smooth = [&](std::vector<double>& p) { m_solver->smoothFactored(edges, capacities, tau, p); };
    m_step->solve(edges, capacities, m_saturation, dt, potential, smooth, m_fluxes);
  } else {
    const double tolerance = m_parameters.tolerance;
    const auto smooth = [&](std::vector<double>& p) {
      m_solver->smoothIteratively(edges, capacities, tau, tolerance, p);
    };
    m_step->solve(edges, capacities, m_saturation, dt, potential, smooth, m_fluxes);
  }
  m_flow->limit(m_fluxes);
}

void Diffusion::setPotential() {
  for (std::size_t i = 0; i < m_potential.size(); ++i) {
    m_potential[i] = diffusionPotential(m_flow->saturation(i), m_parameters.exponent);
  }
}

void Diffusion::flowInSubsteps(double dt) {
  const double count = std::clamp(std::ceil(dt / m_longestSubstep), 1.0, kMostDiffusionSubsteps);
  std::fill(m_fluxes.begin(), m_fluxes.end(), 0);
  for (int substep = 0; substep < static_cast<int>(count); ++substep) {
    setPotential();
    explicitFluxes(m_flow->edges(), m_potential, dt / count, m_substepFluxes);
    m_flow->limit(m_substepFluxes);
    for (std::size_t e = 0; e < m_fluxes.size(); ++e) m_fluxes[e] += m_substepFluxes[e];
    ++m_substeps;
  }
}

void Diffusion::transferState(StateArchive& archive) {
  archive.array(m_warpCoordinate);
  if (archive.isRestoring()) layEdges();  // the mesh at rest may be another one than when the effect was added here
  m_flow->transferState(archive);
  m_solver->transferState(archive, m_flow->edges(), m_flow->capacities());
  m_steadyState.transferState(archive);
  archive.value(m_longestSubstep, m_nodesVisited, m_substeps);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
