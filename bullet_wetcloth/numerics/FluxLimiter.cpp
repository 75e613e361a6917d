// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/FluxLimiter.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kRounds = 4;
constexpr double kSumRounding = 8 * std::numeric_limits<double>::epsilon();
constexpr double kLargestFlux = 1e100;  // sums of them stay finite [kg]

double share(double allowed, double wanted) { return wanted > allowed ? std::max(allowed, 0.0) / wanted : 1; }

}  // namespace

void FluxLimiter::reset(std::size_t nodeCount) {
  m_sums.assign(nodeCount, Sums());
  m_nodes.assign(nodeCount, Node());
}

void FluxLimiter::apply(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacity,
                        std::vector<double>& fluxes, std::vector<double>& held) {
  for (std::size_t i = 0; i < m_nodes.size(); ++i) m_nodes[i].ceiling = std::max(capacity[i], held[i]);
  sumFluxes(edges, fluxes);
  for (int round = 0; findOffenders(held); ++round) {
    if (round > kRounds) break;  // only rounding is left, which the clamp below takes
    if (round == kRounds) findSafeShares(held);
    scale(edges, fluxes);
    sumFluxes(edges, fluxes);
  }
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    held[i] = std::clamp(held[i] + (m_sums[i].in - m_sums[i].out), 0.0, m_nodes[i].ceiling);
  }
}

void FluxLimiter::sumFluxes(const std::vector<WeightedEdge>& edges, std::vector<double>& fluxes) {
  std::fill(m_sums.begin(), m_sums.end(), Sums());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    // Comparisons with NaN are false.
    fluxes[e] = fluxes[e] >= -kLargestFlux ? std::min(fluxes[e], kLargestFlux) : fluxes[e] < 0 ? -kLargestFlux : 0;
    Sums& a = m_sums[toSize(edges[e].a)];
    Sums& b = m_sums[toSize(edges[e].b)];
    const double toB = std::max(fluxes[e], 0.0);
    const double toA = std::max(-fluxes[e], 0.0);
    a.in += toA;
    a.out += toB;
    b.in += toB;
    b.out += toA;
  }
}

// Whether a node would leave its bounds, and what share of its fluxes would keep it from that if the other nodes' stay.
bool FluxLimiter::findOffenders(const std::vector<double>& held) {
  bool found = false;
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    Node& node = m_nodes[i];
    const double in = m_sums[i].in;
    const double out = m_sums[i].out;
    const double result = held[i] + (in - out);
    const double rounding = kSumRounding * (held[i] + in + out);
    node.takeShare = node.giveShare = 1;
    if (result >= -rounding && result <= node.ceiling + rounding) continue;
    found = true;
    if (result < 0) {
      node.giveShare = share(held[i] + in, out);
    } else {
      node.takeShare = share(node.ceiling - held[i] + out, in);
    }
  }
  return found;
}

void FluxLimiter::findSafeShares(const std::vector<double>& held) {
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    m_nodes[i].giveShare = share(held[i], m_sums[i].out);
    m_nodes[i].takeShare = share(m_nodes[i].ceiling - held[i], m_sums[i].in);
  }
}

void FluxLimiter::scale(const std::vector<WeightedEdge>& edges, std::vector<double>& fluxes) const {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Node& a = m_nodes[toSize(edges[e].a)];
    const Node& b = m_nodes[toSize(edges[e].b)];
    fluxes[e] *= fluxes[e] > 0 ? std::min(a.giveShare, b.takeShare) : std::min(b.giveShare, a.takeShare);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
