// SPDX-License-Identifier: Zlib
#include "command/scene/ObjReader.h"

#include "command/cli/TextFile.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace command {
namespace {

[[noreturn]] void rejectLine(int line, const std::string& complaint) {
  throw std::invalid_argument("line " + std::to_string(line) + ": " + complaint);
}

btVector3 readVertex(std::istringstream& words, int line) {
  double xyz[3];
  for (double& coordinate : xyz) {
    std::string word;
    words >> word;
    char* end = nullptr;
    coordinate = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !(std::abs(coordinate) < 1e18)) {
      rejectLine(line, "vertex coordinate \"" + word + "\" must be a finite number below 1e18");
    }
  }
  return btVector3(btScalar(xyz[0]), btScalar(xyz[1]), btScalar(xyz[2]));
}

/// "7", "7/1", "7//3" and "7/1/3" all mean vertex 7, counted from 1; "-1" means the last one so far.
int readIndex(const std::string& word, std::size_t vertices, int line) {
  char* end = nullptr;
  const long count = static_cast<long>(vertices);
  const long index = std::strtol(word.c_str(), &end, 10);
  const bool isNumber = end != word.c_str() && (*end == '\0' || *end == '/');
  const long fromOne = index < 0 ? count + index + 1 : index;
  if (!isNumber || fromOne < 1 || fromOne > count) {
    rejectLine(line, "face index \"" + word + "\" must be from 1 to " + std::to_string(count) +
                         ", the number of vertices above it, or negative from the last");
  }
  return static_cast<int>(fromOne - 1);
}

void readFace(std::istringstream& words, int line, TriangleMesh& mesh) {
  std::vector<int> corners;
  for (std::string word; words >> word;) corners.push_back(readIndex(word, mesh.vertices.size(), line));
  if (corners.size() < 3) rejectLine(line, "a face must have at least 3 corners");
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::array<int, 3> triangle{corners[0], corners[i - 1], corners[i]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) {
      rejectLine(line, "a face must not have the same corner twice");
    }
    mesh.triangles.push_back(triangle);
  }
}

/// A node without area around it would have no mass, and Bullet takes a node without mass for a pinned one.
void requireAreaAtEveryVertex(const TriangleMesh& mesh) {
  std::vector<double> area(mesh.vertices.size(), 0);
  for (const auto& corners : mesh.triangles) {
    const auto vertex = [&](int i) {
      return mesh.vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
    };
    const double doubled = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).length();
    for (const int corner : corners) area[static_cast<std::size_t>(corner)] += doubled;
  }
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (area[i] > 0) continue;
    throw std::invalid_argument("vertex " + std::to_string(i + 1) +
                                " must be a corner of a face that has an area; remove it or its face");
  }
}

}  // namespace

TriangleMesh readObj(const std::string& file) {
  std::istringstream text(readTextFile(file));
  TriangleMesh mesh;
  std::string lineText;
  for (int line = 1; std::getline(text, lineText); ++line) {
    std::istringstream words(lineText.substr(0, lineText.find('#')));
    std::string keyword;
    words >> keyword;
    if (keyword == "v") mesh.vertices.push_back(readVertex(words, line));
    if (keyword == "f") readFace(words, line, mesh);
  }
  if (mesh.vertices.empty()) throw std::invalid_argument("has no vertices, must have lines \"v x y z\"");
  if (mesh.triangles.empty()) throw std::invalid_argument("has no faces, must have lines \"f i j k\"");
  requireAreaAtEveryVertex(mesh);
  return mesh;
}

}  // namespace command
