// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/FreeParts.h"

#include <algorithm>
#include <numeric>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void FreeParts::find(const std::vector<Spring>& springs, const SpringEnergy& energy) {
  const std::size_t size = energy.size();
  std::vector<std::size_t> parent(size + 1);  // the last one stands for what is held
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto rootOf = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < size; ++i) {
    if (!(energy.inertia(i) > 0)) parent[i] = size;
  }
  for (const Spring& spring : springs) {
    const std::size_t a = rootOf(static_cast<std::size_t>(spring.a));
    const std::size_t b = rootOf(static_cast<std::size_t>(spring.b));
    parent[std::min(a, b)] = std::max(a, b);
  }
  std::vector<std::size_t> number(size + 1, kHeld);
  m_part.assign(size, kHeld);
  std::size_t parts = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t root = rootOf(i);
    if (root == size) continue;
    if (number[root] == kHeld) number[root] = parts++;
    m_part[i] = number[root];
  }
  m_balances.resize(parts);
}

void FreeParts::centre(const SpringEnergy& energy, std::vector<std::array<double, 3>>& positions) {
  if (m_balances.empty()) return;
  std::fill(m_balances.begin(), m_balances.end(), Balance{});
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (m_part[i] == kHeld) continue;
    Balance& balance = m_balances[m_part[i]];
    for (std::size_t c = 0; c < 3; ++c) {
      balance.moment[c] += energy.inertia(i) * (energy.inertialPosition(i)[c] - positions[i][c]);
    }
    balance.inertia += energy.inertia(i);
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (m_part[i] == kHeld) continue;
    const Balance& balance = m_balances[m_part[i]];
    for (std::size_t c = 0; c < 3; ++c) positions[i][c] += balance.moment[c] / balance.inertia;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
