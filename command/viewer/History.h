// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

namespace viewer {

/// The latest values of a number that changes; the oldest give way to new ones.
class History {
 public:
  explicit History(std::size_t capacity = 480) : m_capacity(capacity) {}

  void add(double value) {
    if (m_values.size() < m_capacity) {
      m_values.push_back(static_cast<float>(value));
      return;
    }
    m_values[m_oldest] = static_cast<float>(value);
    m_oldest = (m_oldest + 1) % m_capacity;
  }
  void clear() {
    m_values.clear();
    m_oldest = 0;
  }

  std::size_t size() const { return m_values.size(); }
  /// @param age 0 for the oldest, size() - 1 for the latest
  float at(std::size_t age) const { return m_values[(m_oldest + age) % m_values.size()]; }
  float latest() const { return m_values.empty() ? 0 : at(m_values.size() - 1); }

 private:
  std::size_t m_capacity;
  std::size_t m_oldest = 0;
  std::vector<float> m_values;  // round and round
};

}  // namespace viewer
