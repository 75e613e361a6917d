// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/ClothMesh.h"
#include "command/pictures/gl/SolidMesh.h"

#include "command/pictures/ColourScale.h"
#include "command/pictures/FrameSequence.h"
#include "command/pictures/Rods.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace pictures {

/// A cloth with what it hangs from.
class ClothOnRods {
 public:
  explicit ClothOnRods(const ClothShape& shape);

  /// @param leastRadius  of a rod, which is to be seen from far away, too [m]
  void update(const ClothState& state, const ColourScale& scale, const std::vector<Ground>& grounds, float leastRadius);

  const ClothShape& shape() const { return m_shape; }
  /// The longer side of the flat sheet [m].
  float side() const { return m_side; }
  const std::vector<Rod>& rods() const { return m_rods; }
  void drawCloth() const { m_mesh.draw(); }
  /// Some of its triangles.
  void drawCloth(std::size_t first, std::size_t count) const { m_mesh.draw(first, count); }
  void drawBars() const;

 private:
  const ClothShape m_shape;
  ClothMesh m_mesh;
  const float m_side;
  std::unique_ptr<Rods> m_findRods;  // made in the first state
  std::vector<Rod> m_rods;
  std::vector<std::unique_ptr<SolidMesh>> m_bars;
};

}  // namespace pictures
