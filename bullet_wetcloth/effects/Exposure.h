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
/// function of the node's position and unit normal, and of time where it changes. Effects ask for the middle of their
/// step, Step::middle(). A constant that is set anew before each step is the one at its start: of first order in the
/// step, where a function of time is of second.
class WETCLOTH_EXPORT Exposure {
 public:
  /// Of a node's position [m] and its normal, of length 1.
  using Function = std::function<double(const btVector3& position, const btVector3& normal)>;
  /// And of the simulated time [s].
  using FunctionOfTime = std::function<double(const btVector3& position, const btVector3& normal, double time)>;

  /// A constant in [0, 1].
  Exposure(double everywhere) : m_value(everywhere) {}
  /// One value in [0, 1] for each node.
  Exposure(std::vector<double> perNode) : m_value(std::move(perNode)) {}
  /// A function, asked for each node in each step.
  Exposure(Function function) : m_value(std::move(function)) {}
  /// The same of a function that changes in time.
  Exposure(FunctionOfTime function) : m_value(std::move(function)) {}
  /// The same of a lambda, of two arguments or of three.
  template <class F, class = decltype(std::declval<F>()(btVector3(), btVector3()))>
  Exposure(F function) : m_value(Function(std::move(function))) {}
  /// \overload
  template <class F, class = void, class = decltype(std::declval<F>()(btVector3(), btVector3(), double()))>
  Exposure(F function) : m_value(FunctionOfTime(std::move(function))) {}

  /// Whether it is a function.
  bool isFunction() const {
    return std::holds_alternative<Function>(m_value) || std::holds_alternative<FunctionOfTime>(m_value);
  }
  /// Whether it is an array.
  bool isPerNode() const { return std::holds_alternative<std::vector<double>>(m_value); }

  /// A function's value is clamped to [0, 1], and NaN counts as 0. Nodes beyond the end of an array (made when the
  /// body was cut) have exposure 0.
  /// @param time  simulated [s]
  double at(std::size_t node, const btVector3& position, const btVector3& normal, double time) const;

  /// Throws std::invalid_argument naming `field` and the value when a constant or an array's value is not in
  /// [0, 1] or not finite, when an array has no values, and when a function is empty.
  void requireValid(const char* field) const;
  /// Throws std::invalid_argument when an array has not one value per node.
  void requireSize(const char* field, std::size_t nodes) const;
  /// The same for what takes the place of `before`: an array as long as that one is right, too, since the body may have
  /// been cut after it was given.
  void requireSize(const char* field, std::size_t nodes, const Exposure& before) const;

 private:
  std::variant<double, std::vector<double>, Function, FunctionOfTime> m_value;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
