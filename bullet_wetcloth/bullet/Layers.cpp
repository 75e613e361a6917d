// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/Layers.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

std::vector<FaceNodes> nodesOfFaces(const btSoftBody& body) {
  std::vector<FaceNodes> faces(static_cast<std::size_t>(body.m_faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) faces[f][k] = nodeIndex(body, body.m_faces[static_cast<int>(f)].m_n[k]);
  }
  return faces;
}

std::vector<bool> areDoubled(const std::vector<FaceNodes>& faces) {
  std::vector<std::pair<FaceNodes, std::size_t>> sorted;
  sorted.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    sorted.emplace_back(faces[f], f);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> doubled(faces.size(), false);
  for (std::size_t k = 1; k < sorted.size(); ++k) doubled[sorted[k].second] = sorted[k].first == sorted[k - 1].first;
  return doubled;
}

std::vector<FaceNodes> layersOf(const btSoftBody& body) {
  const std::vector<FaceNodes> faces = nodesOfFaces(body);
  const std::vector<bool> doubled = areDoubled(faces);
  std::vector<FaceNodes> layers;
  layers.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!doubled[f]) layers.push_back(faces[f]);
  }
  return layers;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
