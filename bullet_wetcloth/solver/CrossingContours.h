// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/Crossings.h"

#include <array>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Joins crossings to the curves along which two layers cross: two faces cross along a line between two crossings of an
/// edge of the one with the other.
class CrossingContours {
 public:
  void find(const std::vector<Crossing>& crossings);
  /// Curves, numbered from 0.
  int count() const { return m_count; }
  /// Of a crossing.
  int contour(std::size_t crossing) const { return m_contour[crossing]; }
  /// Which of the curve's two layers its edge belongs to.
  bool isOfOtherLayer(std::size_t crossing) const { return m_isOther[crossing]; }

 private:
  // An end of the line between two faces.
  struct End {
    std::array<std::array<int, 3>, 2> faces;
    int crossing;
    bool isOfSecond;  // its edge
  };

  void addEnds(const Crossing& crossing, int number);
  int rootOf(int crossing, bool& isOther) const;

  std::vector<End> m_ends;
  std::vector<int> m_parent;  // of each crossing, in a tree for each curve
  std::vector<bool> m_isOtherThanParent;
  std::vector<int> m_contour;
  std::vector<bool> m_isOther;
  int m_count = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
