// SPDX-License-Identifier: Zlib
#include "command/pictures/VtkSeries.h"

#include "command/pictures/ClothColour.h"
#include "command/pictures/ClothNames.h"
#include "command/pictures/LittleEndian.h"
#include "command/pictures/NumberedName.h"
#include "command/pictures/OutputFile.h"
#include "command/pictures/VertexNormals.h"

#include <sstream>

namespace pictures {
namespace {

/// The XML of one file, and the numbers that go behind it.
class PolyData {
 public:
  PolyData(std::size_t points, std::size_t polygons, double time) {
    m_xml.precision(12);
    m_xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
             "NumberOfTuples=\"1\" format=\"ascii\">"
          << time << "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" << points
          << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" << polygons << "\">\n";
  }

  void begin(const std::string& element) { m_xml << "<" << element << ">\n"; }
  void end(const std::string& element) { m_xml << "</" << element << ">\n"; }
  void array(const std::string& type, const std::string& name, int components, const std::string& bytes) {
    m_xml << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
          << "\" format=\"appended\" offset=\"" << m_numbers.size() << "\"/>\n";
    putUint64(m_numbers, bytes.size());
    m_numbers += bytes;
  }
  std::string file() const {
    return m_xml.str() + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + m_numbers +
           "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::ostringstream m_xml;
  std::string m_numbers;
};

std::string bytesOf(const std::vector<Vector3>& vectors) {
  std::string bytes;
  for (const Vector3& vector : vectors) {
    for (const float x : vector) putFloat(bytes, x);
  }
  return bytes;
}

std::string bytesOf(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) putFloat(bytes, value);
  return bytes;
}

std::string colourArray(const ClothShape& shape, const ClothState& state) {
  std::string bytes;
  for (const Rgb& colour : clothColours(shape, state.saturation)) {
    for (const std::uint8_t c : encodedColour(colour)) putByte(bytes, c);
  }
  return bytes;
}

void putTriangles(const std::vector<Triangle>& triangles, PolyData& data) {
  std::string corners;
  std::string ends;
  int end = 0;
  for (const Triangle& triangle : triangles) {
    for (const int node : triangle) putInt32(corners, node);
    putInt32(ends, end += 3);
  }
  data.begin("Polys");
  data.array("Int32", "connectivity", 1, corners);
  data.array("Int32", "offsets", 1, ends);
  data.end("Polys");
}

std::string polyData(const ClothShape& shape, const ClothState& state, double time) {
  PolyData data(state.positions.size(), shape.triangles.size(), time);
  data.begin("PointData Scalars=\"wetness\" Normals=\"Normals\"");
  data.array("Float32", "wetness", 1, bytesOf(state.saturation));
  data.array("Float32", "speed", 1, bytesOf(state.speed));
  data.array("Float32", "stretch", 1, bytesOf(state.stretch));
  data.array("UInt8", "colour", 3, colourArray(shape, state));
  data.array("Float32", "Normals", 3, bytesOf(vertexNormals(state.positions, shape.triangles)));
  data.end("PointData");
  data.begin("Points");
  data.array("Float32", "Points", 3, bytesOf(state.positions));
  data.end("Points");
  putTriangles(shape.triangles, data);
  return data.file();
}

}  // namespace

void writeVtkSeries(const FrameSequence& sequence, const std::string& folder) {
  const std::string inFolder = folder + "/";
  const std::vector<std::string> names = clothNames(sequence);
  std::ostringstream list;
  list.precision(12);
  list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
          "<Collection>\n";
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const Frame& frame = sequence.frames[i];
    for (std::size_t cloth = 0; cloth < names.size(); ++cloth) {
      const std::string name = numberedName(names[cloth], i, ".vtp");
      writeFile(inFolder + name, polyData(sequence.cloths[cloth], frame.cloths[cloth], frame.time));
      list << "<DataSet timestep=\"" << frame.time << "\" part=\"" << cloth << "\" name=\"" << names[cloth]
           << "\" file=\"" << name << "\"/>\n";
    }
  }
  list << "</Collection>\n</VTKFile>\n";
  writeFile(inFolder + "run.pvd", list.str());
}

}  // namespace pictures
