// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <Eigen/SparseCore>

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// L D L^T of a symmetric, positive definite sparse matrix, for many solves: they do not allocate, and several
/// right-hand sides share one pass over the factor, neither of which Eigen's own solve() offers.
class SparseFactor {
 public:
  /// Factors the matrix, of which only the lower triangle is read. When it is not positive definite, all solutions are
  /// 0.
  void compute(const Eigen::SparseMatrix<double>& matrix);

  std::size_t size() const { return m_inverseDiagonal.size(); }
  /// Where the matrix's row is in the vectors that solveInPlace() takes: rows are reordered to keep the factor sparse.
  int row(int matrixRow) const { return m_permutation[static_cast<std::size_t>(matrixRow)]; }

  /// Solves for N right-hand sides at once. N is 1 or 3.
  template <std::size_t N>
  void solveInPlace(std::vector<std::array<double, N>>& x) const;

 private:
  std::vector<int> m_permutation;
  std::vector<int> m_firstOfColumn;  // of L without its unit diagonal
  std::vector<int> m_rows;
  std::vector<double> m_values;
  std::vector<double> m_inverseDiagonal;  // 1 / D
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
