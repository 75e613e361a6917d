// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <functional>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Velocity of the air [m/s]: the same everywhere, or a function of position [m] and time [s].
class WETCLOTH_EXPORT WindField {
 public:
  /// Of a position [m] and the simulated time [s].
  using Function = std::function<btVector3(const btVector3& position, double time)>;

  /// Air at rest.
  WindField() = default;
  /// Of air [m/s], in SI units or others. Cloth in a faster wind would leave the places that Bullet can tell apart.
  static constexpr double fastest = 1e6;

  /// The same velocity everywhere [m/s], no faster than `fastest`.
  WindField(const btVector3& everywhere) : m_constant(everywhere) {}
  /// A function, asked in each step at each triangle.
  WindField(Function function) : m_function(std::move(function)) {}
  /// The same of a lambda.
  template <class F, class = decltype(std::declval<F>()(btVector3(), double()))>
  WindField(F function) : m_function(std::move(function)) {}

  /// Whether it is a function.
  bool isFunction() const { return static_cast<bool>(m_function); }
  /// The velocity of one that is no function [m/s].
  const btVector3& constant() const { return m_constant; }

  /// A function's value that is not finite or faster than `fastest` counts as no wind.
  btVector3 at(const btVector3& position, double time) const;

  /// Throws std::invalid_argument naming `field` and the value when a constant is not finite or too fast.
  void requireValid(const char* field) const;

 private:
  btVector3 m_constant = btVector3(0, 0, 0);
  Function m_function;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
