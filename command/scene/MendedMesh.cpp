// SPDX-License-Identifier: Zlib
#include "command/scene/MendedMesh.h"

#include "bullet_wetcloth/bullet_wetcloth.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace command {
namespace {

using wetcloth::MeshReport;

constexpr std::size_t mostNodesOfMesh = 1000000;

std::size_t toSize(int i) { return static_cast<std::size_t>(i); }

void remark(TriangleMesh& mesh, std::size_t count, const std::string& one, const std::string& many) {
  if (count > 0) mesh.remarks.push_back(std::to_string(count) + " " + (count == 1 ? one : many));
}

std::string inMetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g m", length);
  return text;
}

void renumber(TriangleMesh& mesh) {
  for (auto& corners : mesh.triangles) {
    for (int& corner : corners) corner = mesh.nodeOfVertex[toSize(corner)];
  }
  for (auto& [name, nodes] : mesh.lines) {
    for (int& node : nodes) node = mesh.nodeOfVertex[toSize(node)];
  }
  for (auto& [name, nodes] : mesh.groups) {
    for (int& node : nodes) node = mesh.nodeOfVertex[toSize(node)];
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

void joinCoincidentVertices(TriangleMesh& mesh) {
  const MeshReport report = wetcloth::checkMesh(mesh.vertices, mesh.triangles);
  std::vector<btVector3> nodes;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const int first = report.firstAt[i];
    const bool isFirst = first == static_cast<int>(i);
    mesh.nodeOfVertex.push_back(isFirst ? static_cast<int>(nodes.size()) : mesh.nodeOfVertex[toSize(first)]);
    if (isFirst) nodes.push_back(mesh.vertices[i]);
  }
  mesh.vertices = std::move(nodes);
  const std::string within = " (within " + inMetres(report.tolerance) + ") and joined to it";
  remark(mesh, toSize(report.coincidentNodes), "vertex is in the place of another" + within,
         "vertices are in the place of another" + within);
  renumber(mesh);
}

/// @param faces  sorted
void leaveOut(TriangleMesh& mesh, const std::vector<int>& faces) {
  const auto compact = [&](auto& list) {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < list.size(); ++f) {
      if (!std::binary_search(faces.begin(), faces.end(), static_cast<int>(f))) list[kept++] = list[f];
    }
    list.resize(kept);
  };
  compact(mesh.triangles);
  compact(mesh.textureTriangles);
}

/// "4, 7 to 9": the vertices of these nodes, numbered as the file does.
std::string verticesOf(const TriangleMesh& mesh, const std::vector<bool>& isMeant) {
  std::string text;
  const std::size_t count = mesh.nodeOfVertex.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!isMeant[toSize(mesh.nodeOfVertex[i])]) continue;
    std::size_t last = i;
    while (last + 1 < count && isMeant[toSize(mesh.nodeOfVertex[last + 1])]) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(i + 1);
    if (last > i) text += (last == i + 1 ? ", " : " to ") + std::to_string(last + 1);
    i = last;
  }
  return text;
}

/// A node without area around it would have no mass, and Bullet takes a node without mass for a pinned one.
void requireAreaAtEveryNode(const TriangleMesh& mesh) {
  std::vector<bool> isBare(mesh.vertices.size(), true);
  for (const auto& corners : mesh.triangles) {
    for (const int corner : corners) isBare[toSize(corner)] = false;
  }
  const auto bare = std::count(isBare.begin(), isBare.end(), true);
  if (bare == 0) return;
  const bool isOne = bare == 1;
  throw std::invalid_argument((isOne ? "vertex " : "vertices ") + verticesOf(mesh, isBare) + " must be " +
                              (isOne ? "a corner of a face that has an area; remove it or its face"
                                     : "corners of faces that have an area; remove them or their faces"));
}

}  // namespace

TriangleMesh mended(TriangleMesh mesh) {
  joinCoincidentVertices(mesh);
  if (mesh.vertices.size() > mostNodesOfMesh) {
    throw std::invalid_argument("has " + std::to_string(mesh.vertices.size()) +
                                " vertices in different places, must have at most " + std::to_string(mostNodesOfMesh));
  }
  const MeshReport joined = wetcloth::checkMesh(mesh.vertices, mesh.triangles);
  std::vector<int> faces = joined.degenerateFaces;
  remark(mesh, faces.size(), "face has no area and is left out", "faces have no area and are left out");
  std::vector<int> doubled;
  std::set_difference(joined.doubledFaces.begin(), joined.doubledFaces.end(), faces.begin(), faces.end(),
                      std::back_inserter(doubled));
  remark(mesh, doubled.size(), "face is there twice and counts once", "faces are there twice and count once");
  faces.insert(faces.end(), doubled.begin(), doubled.end());
  std::sort(faces.begin(), faces.end());
  leaveOut(mesh, faces);
  requireAreaAtEveryNode(mesh);
  const MeshReport left = wetcloth::checkMesh(mesh.vertices, mesh.triangles);
  remark(mesh, left.nonManifoldEdges.size(), "edge has more than two faces", "edges have more than two faces");
  if (left.parts > 1) mesh.remarks.push_back("it is in " + std::to_string(left.parts) + " pieces that nothing joins");
  remark(mesh, toSize(left.facePieces - left.parts), "part hangs on by a vertex, not by an edge",
         "parts hang on by a vertex, not by an edge");
  return mesh;
}

}  // namespace command
