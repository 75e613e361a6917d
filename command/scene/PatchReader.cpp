// SPDX-License-Identifier: Zlib
#include "command/scene/PatchReader.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::ClothPatch;

namespace {

constexpr int mostNodesAlongAnEdge = 4096;
constexpr int mostNodesOfPatch = 1000000;

}  // namespace

ClothPatch readPatch(JsonCursor cursor) {
  cursor.expectObject(keys::patch);
  ClothPatch patch;
  if (const auto columns = cursor.find("columns")) patch.columns = columns->integer(2, mostNodesAlongAnEdge);
  if (const auto rows = cursor.find("rows")) patch.rows = rows->integer(2, mostNodesAlongAnEdge);
  if (patch.nodeCount() > mostNodesOfPatch) cursor.complain("columns x rows must be at most 1000000");
  readVector(cursor, "origin_m", patch.origin);
  patch.edgeU = readVector(cursor.at("edge_u_m"));
  patch.edgeV = readVector(cursor.at("edge_v_m"));
  const btScalar lengths = patch.edgeU.length() * patch.edgeV.length();
  if (!(patch.edgeU.cross(patch.edgeV).length() > btScalar(1e-6) * lengths)) {
    cursor.at("edge_v_m").reject("across edge_u_m; the two must not be parallel, nor of length 0");
  }
  readNumber(cursor, "mechanical_stiffness", Range::positiveFraction(), patch.mechanicalStiffness);
  readNumber(cursor, "shear_stiffness", Range::positiveFraction(), patch.shearStiffness);
  readNumber(cursor, "flexion_stiffness", Range::positiveFraction(), patch.flexionStiffness);
  return patch;
}

const std::vector<std::pair<std::string, ClothPatch::Edge>>& edgeNames() {
  using Edge = ClothPatch::Edge;
  static const std::vector<std::pair<std::string, Edge>> names{
      {"left", Edge::left}, {"right", Edge::right}, {"bottom", Edge::bottom}, {"top", Edge::top}};
  return names;
}

std::vector<int> nodesOfEdge(const ClothPatch& patch, ClothPatch::Edge edge) {
  using Edge = ClothPatch::Edge;
  const bool isLevel = edge == Edge::bottom || edge == Edge::top;
  std::vector<int> nodes;
  for (int i = 0; i < (isLevel ? patch.columns : patch.rows); ++i) {
    nodes.push_back(isLevel ? patch.node(i, edge == Edge::top ? patch.rows - 1 : 0)
                            : patch.node(edge == Edge::right ? patch.columns - 1 : 0, i));
  }
  return nodes;
}

}  // namespace command
