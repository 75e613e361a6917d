// SPDX-License-Identifier: Zlib
#include "command/scene/GarmentReader.h"

#include "command/scene/FabricReader.h"
#include "command/scene/PatchReader.h"
#include "command/scene/ReadMesh.h"
#include "command/scene/ReadParameters.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

using wetcloth::ClothPatch;

TriangleMesh meshOf(const ClothPatch& patch) {
  TriangleMesh mesh;
  ClothScene cloth;
  cloth.shape = patch;
  mesh.vertices = cloth.nodePositions();
  for (int j = 0; j + 1 < patch.rows; ++j) {
    for (int i = 0; i + 1 < patch.columns; ++i) {
      mesh.triangles.push_back({patch.node(i, j), patch.node(i + 1, j), patch.node(i + 1, j + 1)});
      mesh.triangles.push_back({patch.node(i, j), patch.node(i + 1, j + 1), patch.node(i, j + 1)});
    }
  }
  const auto width = static_cast<float>(patch.edgeU.length());
  const auto height = static_cast<float>(patch.edgeV.length());
  for (const auto& [u, v] : patch.textureCoordinates()) mesh.sheet.push_back({u * width, v * height});
  for (const auto& [name, edge] : edgeNames()) mesh.lines[name] = nodesOfEdge(patch, edge);
  for (int i = 0; i < patch.nodeCount(); ++i) mesh.nodeOfVertex.push_back(i);
  return mesh;
}

GarmentPanel readPanel(const JsonCursor& cursor) {
  GarmentPanel panel;
  panel.name = cursor.at("name").text();
  if (cursor.exactlyOneOf({"patch", "obj"}) == "patch") {
    panel.mesh = meshOf(readPatch(cursor.at("patch")));
  } else {
    panel.mesh = readMesh(cursor.at("obj"));
    panel.mesh.sheet = sheetOf(panel.mesh.vertices);
  }
  return panel;
}

std::vector<GarmentPanel> readPanels(const JsonCursor& list) {
  std::vector<GarmentPanel> panels;
  std::set<std::string> names;
  for (JsonCursor element : list.elements()) {
    element.expectObject(keys::panel);
    panels.push_back(readPanel(element));
    if (!names.insert(panels.back().name).second) element.at("name").complain("is the name of another panel, too");
  }
  if (panels.empty()) list.reject("an array with at least one panel");
  return panels;
}

std::size_t panelAt(const JsonCursor& name, const std::vector<GarmentPanel>& panels) {
  std::vector<std::pair<std::string, std::size_t>> choices;
  for (std::size_t i = 0; i < panels.size(); ++i) choices.emplace_back(panels[i].name, i);
  return name.choice(choices);
}

std::vector<int> nodesAt(const JsonCursor& cursor, const TriangleMesh& mesh) {
  if (cursor.exactlyOneOf({"line", "nodes"}) == "line") {
    const JsonCursor name = cursor.at("line");
    if (mesh.lines.empty()) name.complain("the OBJ has no lines, \"l i j k\" below \"g name\"");
    return name.choice(std::vector<std::pair<std::string, std::vector<int>>>(mesh.lines.begin(), mesh.lines.end()));
  }
  std::vector<int> nodes;
  for (const JsonCursor& vertex : cursor.at("nodes").elements()) {
    const int index = vertex.integer(0, static_cast<int>(mesh.nodeOfVertex.size()) - 1);
    nodes.push_back(mesh.nodeOfVertex[static_cast<std::size_t>(index)]);
  }
  if (nodes.empty()) cursor.at("nodes").reject("an array with at least one node");
  return nodes;
}

std::vector<PanelNode> readSide(JsonCursor cursor, const std::vector<GarmentPanel>& panels) {
  cursor.expectObject(keys::seamSide);
  const std::size_t panel = panelAt(cursor.at("panel"), panels);
  std::vector<PanelNode> side;
  for (const int node : nodesAt(cursor, panels[panel].mesh)) side.push_back({panel, node});
  const auto reversed = cursor.find("reversed");
  if (reversed && reversed->boolean()) std::reverse(side.begin(), side.end());
  return side;
}

std::vector<Stitch> readSeams(const JsonCursor& list, const std::vector<GarmentPanel>& panels) {
  std::vector<Stitch> stitches;
  for (JsonCursor seam : list.elements()) {
    seam.expectObject(keys::seam);
    const std::vector<PanelNode> first = readSide(seam.at("first"), panels);
    const std::vector<PanelNode> second = readSide(seam.at("second"), panels);
    if (first.size() != second.size()) {
      seam.complain("its sides must have as many nodes as each other, have " + std::to_string(first.size()) + " and " +
                    std::to_string(second.size()));
    }
    for (std::size_t i = 0; i < first.size(); ++i) stitches.emplace_back(first[i], second[i]);
  }
  return stitches;
}

/// Fabrics of single panels; the others are of the cloth's.
void readFabrics(const JsonCursor& list, std::vector<GarmentPanel>& panels, std::vector<wetcloth::Fabric>& fabrics) {
  std::set<std::size_t> seen;
  for (JsonCursor element : list.elements()) {
    element.expectObject(keys::panelFabric);
    const std::size_t panel = panelAt(element.at("panel"), panels);
    if (!seen.insert(panel).second) element.at("panel").complain("has a fabric already");
    panels[panel].fabric = static_cast<int>(fabrics.size());
    fabrics.push_back(readFabric(element.at("fabric")));
    panels[panel].arealDensity = fabrics.back().arealDensity;
  }
}

/// "panels" and "seams", and what of a garment says how they become one.
void readPattern(const JsonCursor& pattern, const JsonCursor* how, ClothScene& cloth) {
  std::vector<GarmentPanel> panels = readPanels(pattern.at("panels"));
  std::vector<Stitch> stitches;
  if (const auto seams = pattern.find("seams")) stitches = readSeams(*seams, panels);
  GarmentScene garment;
  garment.fabrics = {cloth.fabric};
  for (GarmentPanel& panel : panels) panel.arealDensity = cloth.fabric.arealDensity;
  double flexion = 0.02;
  if (how != nullptr) {
    if (const auto fabrics = how->find("fabrics")) readFabrics(*fabrics, panels, garment.fabrics);
    readNumber(*how, "sewing_s", Range::positive(), garment.sewing);
    readNumber(*how, "settling_s", Range::notNegative(), garment.settling);
    readNumber(*how, "flexion_stiffness", Range::positiveFraction(), flexion);
  }
  try {
    SewnMesh sewnMesh = sewn(panels, stitches);
    sewnMesh.mesh.flexionStiffness = flexion;
    garment.fabricOfNode = std::move(sewnMesh.fabricOfNode);
    garment.fabricOfTriangle = std::move(sewnMesh.fabricOfTriangle);
    cloth.shape = std::move(sewnMesh.mesh);
  } catch (const std::invalid_argument& error) {
    pattern.complain(error.what());
  }
  cloth.garment = std::move(garment);
}

void readPatternFile(const JsonCursor& name, const JsonCursor* how, ClothScene& cloth) {
  const std::string file = fileBeside(name);
  const Json json = loadJson(file);
  JsonCursor pattern(json, file);
  pattern.expectObject(keys::pattern);
  readPattern(pattern, how, cloth);
}

}  // namespace

void readGarment(JsonCursor cursor, ClothScene& cloth) {
  if (cursor.isText()) return readPatternFile(cursor, nullptr, cloth);
  if (!cursor.isObject()) cursor.reject("the name of a file, or an object with \"panels\"");
  cursor.expectObject(keys::garment);
  if (cursor.exactlyOneOf({"file", "panels"}) == "file") {
    if (const auto seams = cursor.find("seams")) seams->complain("the file has them");
    readPatternFile(cursor.at("file"), &cursor, cloth);
  } else {
    readPattern(cursor, &cursor, cloth);
  }
}

}  // namespace command
