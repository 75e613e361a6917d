// SPDX-License-Identifier: Zlib
#include "command/pictures/PlySequence.h"

#include "command/pictures/ClothColour.h"
#include "command/pictures/ClothNames.h"
#include "command/pictures/LittleEndian.h"
#include "command/pictures/NumberedName.h"
#include "command/pictures/OutputFile.h"
#include "command/pictures/VertexNormals.h"

#include <sstream>

namespace pictures {
namespace {

std::string header(const FrameSequence& sequence, const ClothShape& shape, double time, std::size_t vertexCount) {
  std::ostringstream text;
  text << "ply\nformat binary_little_endian 1.0\n"
       << "comment " << onOneLine(sequence.scenery.title) << ", " << onOneLine(shape.name) << "\n"
       << "comment time_s " << time << "\n"
       << "element vertex " << vertexCount << "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) text << "property float " << name << "\n";
  for (const char* name : {"red", "green", "blue"}) text << "property uchar " << name << "\n";
  text << "property float wetness\n"
       << "element face " << shape.triangles.size() << "\n"
       << "property list uchar int vertex_indices\nend_header\n";
  return text.str();
}

std::string plyBytes(const FrameSequence& sequence, std::size_t cloth, const Frame& frame) {
  const ClothShape& shape = sequence.cloths[cloth];
  const ClothState& state = frame.cloths[cloth];
  const std::vector<Vector3> normals = vertexNormals(state.positions, shape.triangles);
  const std::vector<Rgb> colours = clothColours(shape, state.saturation);
  std::string bytes = header(sequence, shape, frame.time, state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    for (const float x : state.positions[i]) putFloat(bytes, x);
    for (const float x : normals[i]) putFloat(bytes, x);
    for (const std::uint8_t c : encodedColour(colours[i])) putByte(bytes, c);
    putFloat(bytes, state.saturation[i]);
  }
  for (const Triangle& triangle : shape.triangles) {
    putByte(bytes, 3);
    for (const int node : triangle) putInt32(bytes, node);
  }
  return bytes;
}

}  // namespace

void writePlySequence(const FrameSequence& sequence, const std::string& folder) {
  const std::vector<std::string> names = clothNames(sequence);
  for (std::size_t frame = 0; frame < sequence.frames.size(); ++frame) {
    for (std::size_t cloth = 0; cloth < names.size(); ++cloth) {
      writeFile(folder + "/" + numberedName(names[cloth], frame, ".ply"),
                plyBytes(sequence, cloth, sequence.frames[frame]));
    }
  }
}

}  // namespace pictures
