// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/TriangleMesh.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// A flat piece of cloth, where it is put before it is sewn.
struct GarmentPanel {
  std::string name;
  TriangleMesh mesh;           ///< with `sheet`
  double arealDensity = 0.15;  ///< [kg/m^2]
  int fabric = 0;              ///< number in the garment's list
};

/// A node of a panel.
struct PanelNode {
  std::size_t panel;
  int node;

  bool operator<(const PanelNode& other) const {
    return std::make_pair(panel, node) < std::make_pair(other.panel, other.node);
  }
};

/// Two nodes that become one.
using Stitch = std::pair<PanelNode, PanelNode>;

/// Panels sewn together: one mesh.
struct SewnMesh {
  TriangleMesh mesh;              ///< with `restEdges`, those of the panels; groups are the panels
  std::vector<int> fabricOfNode;  ///< on a seam that of the panel that was named first
  std::vector<int> fabricOfTriangle;
};

/// Nodes that are stitched together become one in the middle between them, so triangles at a seam are longer than at
/// rest until they draw the panels together. All triangles are turned to show the same side to their neighbours.
/// Throws std::invalid_argument when stitches join corners of the same triangle.
SewnMesh sewn(const std::vector<GarmentPanel>& panels, const std::vector<Stitch>& stitches);

}  // namespace command
