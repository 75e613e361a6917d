// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace command {

/// A cloth's triangles, as a file has them.
struct TriangleMesh {
  std::vector<btVector3> vertices;                   ///< the cloth's nodes [m]
  std::vector<std::array<int, 3>> triangles;         ///< of nodes
  std::vector<std::array<float, 2>> texture;         ///< texture coordinates; empty: the file has none
  std::vector<std::array<int, 3>> textureTriangles;  ///< of each triangle's corners; -1: none there
  std::map<std::string, std::vector<int>> groups;    ///< the nodes of each, sorted
  std::map<std::string, std::vector<int>> lines;  ///< the nodes along each, in turn; what is not a face's is left out
  /// Of each triangle how long its edges are at rest, each opposite its corner [m]; empty: as they are here.
  std::vector<std::array<double, 3>> restEdges;
  std::vector<double> arealDensities;       ///< of each triangle [kg/m^2]; empty: the cloth's fabric's
  double flexionStiffness = 1;              ///< of links across edges, btSoftBody::Material::m_kLST, (0, 1]
  std::vector<std::array<float, 2>> sheet;  ///< of each node its place on the flat cloth [m]; empty: not known
  std::vector<int> nodeOfVertex;            ///< of each of the file's vertices: vertices in one place share a node
  std::vector<std::string> remarks;         ///< what was mended and what is unusual, for the user

  /// Whether each corner has texture coordinates.
  bool hasTexture() const {
    return !textureTriangles.empty() &&
           std::all_of(textureTriangles.begin(), textureTriangles.end(),
                       [](const auto& corners) { return corners[0] >= 0 && corners[1] >= 0 && corners[2] >= 0; });
  }
};

/// Of each vertex its place seen along the axis in which all of them reach least far [m].
std::vector<std::array<float, 2>> sheetOf(const std::vector<btVector3>& vertices);

}  // namespace command
