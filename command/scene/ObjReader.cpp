// SPDX-License-Identifier: Zlib
#include "command/scene/ObjReader.h"

#include "command/cli/TextFile.h"
#include "command/scene/EarClipping.h"
#include "command/scene/MendedMesh.h"
#include "command/scene/ObjLines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace command {
namespace {

constexpr std::size_t mostCorners = 4096;  // of a face

[[noreturn]] void rejectLine(int line, const std::string& complaint) {
  throw std::invalid_argument("line " + std::to_string(line) + ": " + complaint);
}

bool isAllowed(double coordinate) { return std::abs(coordinate) < 1e18; }

Point readVertex(std::istringstream& words, int line) {
  Point xyz;
  for (double& coordinate : xyz) {
    std::string word;
    words >> word;
    char* end = nullptr;
    coordinate = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !isAllowed(coordinate)) {
      rejectLine(line, "vertex coordinate \"" + word + "\" must be a finite number below 1e18");
    }
  }
  return xyz;
}

/// A place in the picture, of which the second number may be missing.
std::array<float, 2> readTexture(std::istringstream& words) {
  std::array<float, 2> place{0, 0};
  for (float& coordinate : place) {
    if (!(words >> coordinate) || !std::isfinite(coordinate)) coordinate = 0;
  }
  return place;
}

/// A corner as the file has it: numbers from 0, -1 for no texture coordinates.
struct FaceCorner {
  int vertex;
  int texture;
};

/// Numbers count from 1, or back from the last one: -1 is the last so far. Throws std::invalid_argument.
int readNumber(const char* text, char** end, std::size_t count) {
  const long number = std::strtol(text, end, 10);
  const long fromOne = number < 0 ? static_cast<long>(count) + number + 1 : number;
  const bool isThere = *end != text && fromOne >= 1 && fromOne <= static_cast<long>(count);
  return isThere ? static_cast<int>(fromOne - 1) : -1;
}

/// "7", "7/1", "7//3" and "7/1/3" all mean vertex 7. Texture coordinates that are not there are none.
FaceCorner readCorner(const std::string& word, std::size_t vertices, std::size_t textures, int line) {
  char* end = nullptr;
  FaceCorner corner{readNumber(word.c_str(), &end, vertices), -1};
  if (corner.vertex < 0 || (*end != '\0' && *end != '/')) {
    rejectLine(line, "face index \"" + word + "\" must be from 1 to " + std::to_string(vertices) +
                         ", the number of vertices above it, or negative from the last");
  }
  if (*end == '/') corner.texture = readNumber(end + 1, &end, textures);
  return corner;
}

/// What has been read so far.
class ObjMesh {
 public:
  explicit ObjMesh(const Placement& placement) : m_placement(placement) {}

  void take(const std::string& text, int line) {
    std::istringstream words(text);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") m_places.push_back(m_placement(readVertex(words, line)));
    if (keyword == "vt") m_mesh.texture.push_back(readTexture(words));
    if (keyword == "f") takeFace(words, line);
    if (keyword == "l") takeLine(words, line);
    if (keyword == "g") takeNames(words, m_groups);
    if (keyword == "o") takeNames(words, m_objects);
  }

  TriangleMesh finish() {
    if (m_places.empty()) throw std::invalid_argument("has no vertices, must have lines \"v x y z\"");
    if (m_mesh.triangles.empty()) throw std::invalid_argument("has no faces, must have lines \"f i j k\"");
    for (const Point& place : m_places) {
      if (!std::all_of(place.begin(), place.end(), isAllowed)) {
        throw std::invalid_argument("is too large when scaled: coordinates must be below 1e18 m");
      }
      m_mesh.vertices.emplace_back(btScalar(place[0]), btScalar(place[1]), btScalar(place[2]));
    }
    if (m_mesh.texture.empty()) m_mesh.textureTriangles.clear();
    return std::move(m_mesh);
  }

 private:
  static void takeNames(std::istringstream& words, std::vector<std::string>& names) {
    names.clear();
    for (std::string name; words >> name;) names.push_back(name);
  }

  std::vector<FaceCorner> readCorners(std::istringstream& words, int line) const {
    std::vector<FaceCorner> corners;
    for (std::string word; words >> word;) {
      corners.push_back(readCorner(word, m_places.size(), m_mesh.texture.size(), line));
    }
    if (corners.size() < 3) rejectLine(line, "a face must have at least 3 corners");
    if (corners.size() > mostCorners) {
      rejectLine(line, "a face must have at most " + std::to_string(mostCorners) + " corners, has " +
                           std::to_string(corners.size()));
    }
    std::vector<int> vertices;
    for (const FaceCorner& corner : corners) vertices.push_back(corner.vertex);
    std::sort(vertices.begin(), vertices.end());
    if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end()) {
      rejectLine(line, "a face must not have the same corner twice");
    }
    // A polygon that is not flat is cut the same way whichever corner comes first, and, in takeFace(), either way
    // round.
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end(),
                                 [](const FaceCorner& a, const FaceCorner& b) { return a.vertex < b.vertex; }),
                corners.end());
    return corners;
  }

  /// Goes on where the line of the same name has ended, or begins it.
  void takeLine(std::istringstream& words, int number) {
    std::vector<int> vertices;
    for (std::string word; words >> word;) {
      vertices.push_back(readCorner(word, m_places.size(), m_mesh.texture.size(), number).vertex);
    }
    for (const auto* names : {&m_groups, &m_objects}) {
      for (const std::string& name : *names) {
        std::vector<int>& line = m_mesh.lines[name];
        const bool goesOn = !line.empty() && !vertices.empty() && line.back() == vertices.front();
        line.insert(line.end(), vertices.begin() + (goesOn ? 1 : 0), vertices.end());
      }
    }
  }

  void takeFace(std::istringstream& words, int line) {
    std::vector<FaceCorner> corners = readCorners(words, line);
    const bool isTurned = corners[1].vertex > corners.back().vertex;
    if (isTurned) std::reverse(corners.begin() + 1, corners.end());
    std::vector<Point> places;
    for (const FaceCorner& corner : corners) places.push_back(m_places[static_cast<std::size_t>(corner.vertex)]);
    for (auto [a, b, c] : clipEars(places)) {
      if (isTurned) std::swap(b, c);
      const FaceCorner &first = corners[static_cast<std::size_t>(a)], &second = corners[static_cast<std::size_t>(b)],
                       &third = corners[static_cast<std::size_t>(c)];
      m_mesh.triangles.push_back({first.vertex, second.vertex, third.vertex});
      m_mesh.textureTriangles.push_back({first.texture, second.texture, third.texture});
    }
    for (const auto* names : {&m_groups, &m_objects}) {
      for (const std::string& name : *names) {
        for (const FaceCorner& corner : corners) m_mesh.groups[name].push_back(corner.vertex);
      }
    }
  }

  const Placement& m_placement;
  std::vector<Point> m_places;
  std::vector<std::string> m_groups;
  std::vector<std::string> m_objects;
  TriangleMesh m_mesh;
};

}  // namespace

std::array<double, 3> Placement::operator()(std::array<double, 3> place) const {
  for (double& coordinate : place) coordinate *= scale;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (rotation[axis] == 0) continue;
    const double angle = rotation[axis] * std::acos(-1.0) / 180;
    double& u = place[(axis + 1) % 3];
    double& v = place[(axis + 2) % 3];
    const double before = u;
    u = std::cos(angle) * before - std::sin(angle) * v;
    v = std::sin(angle) * before + std::cos(angle) * v;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += translation[axis];
  return place;
}

TriangleMesh readObj(const std::string& file, const Placement& placement) {
  const std::string text = readTextFile(file);
  ObjMesh mesh(placement);
  for (ObjLines lines(text); lines.next();) mesh.take(lines.text(), lines.number());
  return mended(mesh.finish());
}

}  // namespace command
