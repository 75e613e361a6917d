// SPDX-License-Identifier: Zlib
#include "command/pictures/UsdFile.h"

#include "command/pictures/Bounds.h"
#include "command/pictures/ClothColour.h"
#include "command/pictures/ClothNames.h"
#include "command/pictures/OutputFile.h"
#include "command/pictures/PosedSolid.h"
#include "command/pictures/StandingMesh.h"
#include "command/pictures/VertexNormals.h"

#include <cmath>

namespace pictures {
namespace {

template <std::size_t Count>
void put(std::ostream& out, const std::array<float, Count>& tuple) {
  out << '(';
  for (std::size_t i = 0; i < Count; ++i) out << (i == 0 ? "" : ", ") << tuple[i];
  out << ')';
}
void put(std::ostream& out, float value) { out << value; }
void put(std::ostream& out, int value) { out << value; }

template <class Value>
void put(std::ostream& out, const std::vector<Value>& values) {
  out << '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i != 0) out << ", ";
    put(out, values[i]);
  }
  out << ']';
}

std::vector<int> cornersOf(const std::vector<Triangle>& triangles) {
  std::vector<int> corners;
  for (const Triangle& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

std::vector<Vector3> boxOf(const std::vector<Vector3>& points) {
  Bounds bounds;
  for (const Vector3& point : points) bounds.add(point);
  return {bounds.low, bounds.high};
}

/// Frames per second of the run, which also is one of them when there is only one.
double frameRate(const std::vector<Frame>& frames) {
  const double duration = frames.back().time - frames.front().time;
  return duration > 0 ? static_cast<double>(frames.size() - 1) / duration : 1;
}

class UsdWriter {
 public:
  UsdWriter(const FrameSequence& sequence, std::ostream& out) : m_sequence(sequence), m_out(out) { m_out.precision(7); }

  void write() {
    head();
    m_out << "\ndef Xform \"scene\"\n{\n";
    std::vector<std::string> names;
    for (const ClothShape& cloth : m_sequence.cloths) names.push_back(cloth.name);
    const std::vector<StandingMesh> standing = standingMeshes(m_sequence);
    for (const StandingMesh& mesh : standing) names.push_back(mesh.name);
    names = uniqueNames(names);
    for (std::size_t i = 0; i < m_sequence.cloths.size(); ++i) cloth(i, names[i]);
    for (std::size_t i = 0; i < standing.size(); ++i) stands(standing[i], names[m_sequence.cloths.size() + i]);
    m_out << "}\n";
  }

 private:
  void head() {
    const Vector3& up = m_sequence.scenery.up;
    const double rate = frameRate(m_sequence.frames);
    m_out << "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    doc = \"" << title() << "\"\n    startTimeCode = 0\n"
          << "    endTimeCode = " << m_sequence.frames.size() - 1 << "\n    framesPerSecond = " << rate
          << "\n    timeCodesPerSecond = " << rate << "\n    metersPerUnit = 1\n    upAxis = \""
          << (std::abs(up[2]) > std::abs(up[1]) ? 'Z' : 'Y') << "\"\n)\n";
  }

  std::string title() const {
    std::string text = onOneLine(m_sequence.scenery.title);
    for (char& c : text) {
      if (c == '"' || c == '\\') c = '\'';
    }
    return text;
  }

  void beginMesh(const std::string& name, const std::vector<Triangle>& triangles, bool bothSides) {
    m_out << "    def Mesh \"" << name << "\"\n    {\n        uniform bool doubleSided = " << (bothSides ? 1 : 0)
          << "\n        uniform token subdivisionScheme = \"none\"\n";
    fixed("int[] faceVertexCounts", std::vector<int>(triangles.size(), 3));
    fixed("int[] faceVertexIndices", cornersOf(triangles));
  }

  template <class Value>
  void fixed(const std::string& attribute, const std::vector<Value>& values, const char* interpolation = "") {
    m_out << "        " << attribute << " = ";
    put(m_out, values);
    m_out << interpolation << '\n';
  }

  template <class ValuesIn>
  void sampledInFrames(const std::string& attribute, ValuesIn valuesIn) {
    m_out << "        " << attribute << ".timeSamples = {\n";
    for (std::size_t i = 0; i < m_sequence.frames.size(); ++i) {
      m_out << "            " << i << ": ";
      put(m_out, valuesIn(m_sequence.frames[i]));
      m_out << ",\n";
    }
    m_out << "        }\n";
  }

  template <class ValuesAt>
  void sampled(const std::string& attribute, std::size_t cloth, ValuesAt valuesAt) {
    sampledInFrames(attribute, [&](const Frame& frame) { return valuesAt(frame.cloths[cloth]); });
  }

  template <class ValuesAt>
  void sampledByVertex(const std::string& attribute, std::size_t cloth, ValuesAt valuesAt) {
    m_out << "        " << attribute << perVertex << '\n';
    sampled(attribute, cloth, valuesAt);
  }

  void cloth(std::size_t index, const std::string& name) {
    const ClothShape& shape = m_sequence.cloths[index];
    beginMesh(name, shape.triangles, true);
    sampled("float3[] extent", index, [](const ClothState& state) { return boxOf(state.positions); });
    sampled("point3f[] points", index, [](const ClothState& state) { return state.positions; });
    sampledByVertex("normal3f[] normals", index,
                    [&](const ClothState& state) { return vertexNormals(state.positions, shape.triangles); });
    sampledByVertex("float[] primvars:wetness", index, [](const ClothState& state) { return state.saturation; });
    sampledByVertex("color3f[] primvars:displayColor", index,
                    [&](const ClothState& state) { return clothColours(shape, state.saturation); });
    texture(shape);
    m_out << "    }\n";
  }

  void texture(const ClothShape& shape) {
    if (!shape.ownTexture) {
      fixed("texCoord2f[] primvars:st", shape.texture, perVertex);
      return;
    }
    fixed("texCoord2f[] primvars:st", shape.ownTexture->places,
          " (\n            interpolation = \"faceVarying\"\n        )");
    fixed("int[] primvars:st:indices", cornersOf(shape.ownTexture->triangles));
  }

  void stands(const StandingMesh& mesh, const std::string& name) {
    beginMesh(name, mesh.triangles, false);
    if (mesh.solid && !m_sequence.frames.front().poses.empty()) {
      moves(*mesh.solid);
    } else {
      fixed("float3[] extent", boxOf(mesh.vertices));
      fixed("point3f[] points", mesh.vertices);
      fixed("normal3f[] normals", mesh.normals, perVertex);
    }
    fixed("color3f[] primvars:displayColor", std::vector<Rgb>{mesh.colour},
          " (\n            interpolation = \"constant\"\n        )");
    m_out << "    }\n";
  }

  void moves(std::size_t solid) {
    const auto in = [&](const Frame& frame) { return posedSolid(m_sequence.scenery, frame, solid); };
    sampledInFrames("float3[] extent", [&](const Frame& frame) { return boxOf(in(frame).vertices); });
    sampledInFrames("point3f[] points", [&](const Frame& frame) { return in(frame).vertices; });
    m_out << "        normal3f[] normals" << perVertex << '\n';
    sampledInFrames("normal3f[] normals", [&](const Frame& frame) { return in(frame).normals; });
  }

  static constexpr const char* perVertex = " (\n            interpolation = \"vertex\"\n        )";

  const FrameSequence& m_sequence;
  std::ostream& m_out;
};

}  // namespace

void writeUsd(const FrameSequence& sequence, const std::string& path) {
  OutputFile file(path);
  UsdWriter(sequence, file.stream()).write();
  file.close();
}

}  // namespace pictures
