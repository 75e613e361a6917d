// SPDX-License-Identifier: Zlib
#include "command/pictures/ObjFile.h"

#include "command/pictures/ClothNames.h"
#include "command/pictures/OutputFile.h"
#include "command/pictures/PointCache2.h"
#include "command/pictures/StandingMesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace pictures {
namespace {

/// Moved and scaled, both directions alike, to lie in [0, 1].
std::vector<Texture> inUnitSquare(std::vector<Texture> texture) {
  Texture low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
  float size = 0;
  for (const Texture& place : texture) low = {std::min(low[0], place[0]), std::min(low[1], place[1])};
  for (const Texture& place : texture) size = std::max({size, place[0] - low[0], place[1] - low[1]});
  if (!(size > 0)) size = 1;
  for (Texture& place : texture) place = {(place[0] - low[0]) / size, (place[1] - low[1]) / size};
  return texture;
}

void writeCloth(const FrameSequence& sequence, std::size_t cloth, const std::string& name, const std::string& path) {
  const ClothShape& shape = sequence.cloths[cloth];
  OutputFile file(path);
  std::ostream& out = file.stream();
  out.precision(9);
  out << "# " << onOneLine(sequence.scenery.title) << ", metres\no " << name << "\n";
  for (const Vector3& p : sequence.frames.front().cloths[cloth].positions) {
    out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  const TextureMap map = shape.ownTexture.value_or(TextureMap{inUnitSquare(shape.texture), shape.triangles});
  for (const Texture& place : map.places) out << "vt " << place[0] << ' ' << place[1] << '\n';
  out << "s 1\n";
  for (std::size_t f = 0; f < shape.triangles.size(); ++f) {
    out << 'f';
    for (std::size_t k = 0; k < 3; ++k) out << ' ' << shape.triangles[f][k] + 1 << '/' << map.triangles[f][k] + 1;
    out << '\n';
  }
  file.close();
}

void writeScenery(const std::vector<StandingMesh>& meshes, const std::string& folder) {
  std::vector<std::string> names;
  for (const StandingMesh& mesh : meshes) names.push_back(mesh.name);
  names = uniqueNames(names);
  OutputFile file(folder + "/scenery.obj");
  std::ostream& out = file.stream();
  out.precision(9);
  out << "# what stands around the cloths, in the first frame, metres\n";
  int first = 1;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    out << "o " << names[i] << '\n';
    for (const Vector3& p : meshes[i].vertices) out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const Vector3& n : meshes[i].normals) out << "vn " << n[0] << ' ' << n[1] << ' ' << n[2] << '\n';
    for (const Triangle& triangle : meshes[i].triangles) {
      out << 'f';
      for (const int corner : triangle) out << ' ' << first + corner << "//" << first + corner;
      out << '\n';
    }
    first += static_cast<int>(meshes[i].vertices.size());
  }
  file.close();
}

}  // namespace

void writeObjAndPointCaches(const FrameSequence& sequence, const std::string& folder) {
  const std::string inFolder = folder + "/";
  std::vector<std::string> names{"scenery"};
  for (const ClothShape& cloth : sequence.cloths) names.push_back(cloth.name);
  names = uniqueNames(names);
  for (std::size_t cloth = 0; cloth < sequence.cloths.size(); ++cloth) {
    const std::string& name = names[cloth + 1];
    const std::string path = inFolder + name;
    writeCloth(sequence, cloth, name, path + ".obj");
    writePointCache(sequence, cloth, path + ".pc2");
  }
  const std::vector<StandingMesh> meshes = standingMeshes(sequence);
  if (!meshes.empty()) writeScenery(meshes, folder);
}

}  // namespace pictures
