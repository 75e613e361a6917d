// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/DiffusionStep.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void DiffusionStep::reset(std::size_t nodes, std::size_t edges) {
  for (auto* array : {&m_first, &m_second, &m_stage, &m_aboveLowest, &m_range}) array->assign(nodes, 0);
  m_correction.assign(edges, 0);
  m_limiter.reset(nodes);
}

// The first stage, from the lowest saturation up, so that it stays within its bounds to rounding.
void DiffusionStep::advance(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacities,
                            const std::vector<double>& saturation, const std::vector<double>& fluxes) {
  const auto [lowest, highest] = std::minmax_element(saturation.begin(), saturation.end());
  for (std::size_t i = 0; i < saturation.size(); ++i) {
    m_aboveLowest[i] = capacities[i] * (saturation[i] - *lowest);
    m_range[i] = capacities[i] * (*highest - *lowest);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    m_aboveLowest[toSize(edges[e].a)] -= fluxes[e];
    m_aboveLowest[toSize(edges[e].b)] += fluxes[e];
  }
  for (std::size_t i = 0; i < saturation.size(); ++i) {
    const double above = capacities[i] > 0 ? m_aboveLowest[i] / capacities[i] : 0;
    m_stage[i] = std::clamp(*lowest + above, *lowest, *highest);
  }
}

void DiffusionStep::correct(const std::vector<WeightedEdge>& edges, double dt, std::vector<double>& fluxes) {
  for (std::size_t i = 0; i < m_second.size(); ++i) m_second[i] = (m_first[i] + m_second[i]) / 2;
  explicitFluxes(edges, m_second, dt, m_correction);
  m_limiter.apply(edges, m_range, m_correction, m_aboveLowest);
  for (std::size_t e = 0; e < edges.size(); ++e) fluxes[e] += m_correction[e];
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
