// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How far each node is in contact with water, in [0, 1]: a constant, an array with one value per node, or a
/// function of the node's position and unit normal.
class WETCLOTH_EXPORT Exposure {
 public:
  using Function = std::function<double(const btVector3& position, const btVector3& normal)>;

  Exposure(double everywhere) : m_value(everywhere) {}
  Exposure(std::vector<double> perNode) : m_value(std::move(perNode)) {}
  Exposure(Function function) : m_value(std::move(function)) {}
  template <class F, class = decltype(std::declval<F>()(btVector3(), btVector3()))>
  Exposure(F function) : m_value(Function(std::move(function))) {}

  bool isFunction() const { return std::holds_alternative<Function>(m_value); }
  bool isPerNode() const { return std::holds_alternative<std::vector<double>>(m_value); }

  /// A function's value is clamped to [0, 1], and NaN counts as 0. Nodes beyond the end of an array (made when the
  /// body was cut) have exposure 0.
  double at(std::size_t node, const btVector3& position, const btVector3& normal) const;

  /// Throws std::invalid_argument naming `field` and the value when a constant or an array's value is not in
  /// [0, 1] or not finite, when an array has no values, and when a function is empty.
  void requireValid(const char* field) const;
  /// Throws std::invalid_argument when an array has not one value per node.
  void requireSize(const char* field, std::size_t nodes) const;
  /// The same for what takes the place of `before`: an array as long as that one is right, too, since the body may have
  /// been cut after it was given.
  void requireSize(const char* field, std::size_t nodes, const Exposure& before) const;

 private:
  std::variant<double, std::vector<double>, Function> m_value;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
