// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/ClothOnRods.h"

#include <algorithm>
#include <cstddef>

namespace pictures {
namespace {

float sideOf(const ClothShape& shape) {
  Texture low{1e30F, 1e30F};
  Texture high{-1e30F, -1e30F};
  for (const Texture& place : shape.texture) {
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], place[i]);
      high[i] = std::max(high[i], place[i]);
    }
  }
  return std::max({high[0] - low[0], high[1] - low[1], 1e-3F});
}

}  // namespace

ClothOnRods::ClothOnRods(const ClothShape& shape) : m_shape(shape), m_mesh(shape), m_side(sideOf(shape)) {}

void ClothOnRods::update(const ClothState& state, const ColourScale& scale, const std::vector<Ground>& grounds,
                         float leastRadius) {
  m_mesh.update(state, scale.placesOf(state));
  if (m_findRods == nullptr) m_findRods = std::make_unique<Rods>(m_shape, state);
  m_bars.clear();
  m_rods = m_findRods->at(state, grounds);
  for (const Rod& rod : m_rods) {
    m_bars.push_back(std::make_unique<SolidMesh>(roundBar(rod.from, rod.to, std::max(rod.radius, leastRadius))));
  }
}

void ClothOnRods::drawBars() const {
  for (const auto& bar : m_bars) bar->draw();
}

}  // namespace pictures
