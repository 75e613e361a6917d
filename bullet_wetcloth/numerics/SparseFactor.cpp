// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SparseFactor.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <numeric>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void SparseFactor::compute(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Eigen::SparseMatrix<double>& lower = factor.matrixL().nestedExpression();
  const Eigen::Index size = lower.outerSize();
  m_permutation.resize(static_cast<std::size_t>(size));
  m_inverseDiagonal.resize(static_cast<std::size_t>(size));
  m_firstOfColumn.assign(1, 0);
  m_rows.clear();
  m_values.clear();
  if (factor.info() != Eigen::Success) {
    m_firstOfColumn.assign(m_permutation.size() + 1, 0);
    std::fill(m_inverseDiagonal.begin(), m_inverseDiagonal.end(), 0);
    std::iota(m_permutation.begin(), m_permutation.end(), 0);
    return;
  }
  const Eigen::VectorXd diagonal = factor.vectorD();  // a copy at each call
  m_rows.reserve(static_cast<std::size_t>(lower.nonZeros()));
  m_values.reserve(static_cast<std::size_t>(lower.nonZeros()));
  for (Eigen::Index j = 0; j < size; ++j) {
    m_permutation[static_cast<std::size_t>(j)] = factor.permutationP().indices()[j];
    m_inverseDiagonal[static_cast<std::size_t>(j)] = 1 / diagonal[j];
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      if (entry.row() == j) continue;
      m_rows.push_back(static_cast<int>(entry.row()));
      m_values.push_back(entry.value());
    }
    m_firstOfColumn.push_back(static_cast<int>(m_rows.size()));
  }
}

template <std::size_t N>
void SparseFactor::solveInPlace(std::vector<std::array<double, N>>& x) const {
  for (std::size_t j = 0; j < size(); ++j) {
    const std::array<double, N> known = x[j];
    const std::size_t end = static_cast<std::size_t>(m_firstOfColumn[j + 1]);
    for (std::size_t k = static_cast<std::size_t>(m_firstOfColumn[j]); k < end; ++k) {
      std::array<double, N>& target = x[static_cast<std::size_t>(m_rows[k])];
      for (std::size_t c = 0; c < N; ++c) target[c] -= m_values[k] * known[c];
    }
  }
  for (std::size_t j = size(); j-- > 0;) {
    std::array<double, N> target = x[j];
    for (std::size_t c = 0; c < N; ++c) target[c] *= m_inverseDiagonal[j];
    const std::size_t end = static_cast<std::size_t>(m_firstOfColumn[j + 1]);
    for (std::size_t k = static_cast<std::size_t>(m_firstOfColumn[j]); k < end; ++k) {
      const std::array<double, N>& known = x[static_cast<std::size_t>(m_rows[k])];
      for (std::size_t c = 0; c < N; ++c) target[c] -= m_values[k] * known[c];
    }
    x[j] = target;
  }
}

template void SparseFactor::solveInPlace<1>(std::vector<std::array<double, 1>>& x) const;
template void SparseFactor::solveInPlace<3>(std::vector<std::array<double, 3>>& x) const;

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
