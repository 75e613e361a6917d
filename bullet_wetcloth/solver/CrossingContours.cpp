// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/CrossingContours.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

std::array<int, 3> sorted(std::array<int, 3> face) {
  std::sort(face.begin(), face.end());
  return face;
}

}  // namespace

void CrossingContours::addEnds(const Crossing& crossing, int number) {
  const std::array<int, 3> other = sorted(crossing.face);
  for (const int third : crossing.beside) {
    if (third < 0) continue;
    const std::array<int, 3> own = sorted({crossing.edge[0], crossing.edge[1], third});
    if (own < other) {
      m_ends.push_back({{own, other}, number, false});
    } else {
      m_ends.push_back({{other, own}, number, true});
    }
  }
}

int CrossingContours::rootOf(int crossing, bool& isOther) const {
  isOther = false;
  while (m_parent[toSize(crossing)] != crossing) {
    isOther = isOther != m_isOtherThanParent[toSize(crossing)];
    crossing = m_parent[toSize(crossing)];
  }
  return crossing;
}

void CrossingContours::find(const std::vector<Crossing>& crossings) {
  m_ends.clear();
  m_parent.clear();
  m_isOtherThanParent.assign(crossings.size(), false);
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    m_parent.push_back(static_cast<int>(k));
    addEnds(crossings[k], static_cast<int>(k));
  }
  std::sort(m_ends.begin(), m_ends.end(), [](const End& a, const End& b) {
    return a.faces != b.faces ? a.faces < b.faces : a.crossing < b.crossing;
  });
  for (std::size_t k = 1; k < m_ends.size(); ++k) {
    if (m_ends[k - 1].faces != m_ends[k].faces) continue;
    bool isOther[2];
    const int one = rootOf(m_ends[k - 1].crossing, isOther[0]);
    const int two = rootOf(m_ends[k].crossing, isOther[1]);
    if (one == two) continue;
    m_parent[toSize(std::max(one, two))] = std::min(one, two);
    const bool areOther = m_ends[k - 1].isOfSecond != m_ends[k].isOfSecond;
    m_isOtherThanParent[toSize(std::max(one, two))] = (isOther[0] != isOther[1]) != areOther;
  }
  m_count = 0;
  m_contour.resize(crossings.size());
  m_isOther.resize(crossings.size());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    bool isOther = false;
    const int root = rootOf(static_cast<int>(k), isOther);
    m_isOther[k] = isOther;
    m_contour[k] = root == static_cast<int>(k) ? m_count++ : m_contour[toSize(root)];
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
