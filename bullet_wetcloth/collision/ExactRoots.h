// SPDX-License-Identifier: Zlib
#pragma once

// The roots of small integer polynomials in [0, 1] and the signs of other polynomials there, without any rounding.
// Compiled only where Boost was found.

#include <boost/multiprecision/cpp_int.hpp>

#include <memory>
#include <optional>
#include <utility>

namespace wetcloth::collision::exact {

/// Grows without bound; 4096 bits stay off the heap, and no query of tests/data/ccd needs more.
using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<4096, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3.
struct Polynomial {
  Integer c[4];

  int degree() const;  ///< -1 for the polynomial 0
  bool isZero() const { return degree() < 0; }
};

/// A root in [0, 1] of a polynomial that outlives it. Either a fraction, or known to lie in an open interval that
/// holds no other root; the polynomial changes its sign there.
class Root {
 public:
  /// The number numerator / denominator; the denominator is positive.
  Root(Integer numerator, Integer denominator);
  /// The only root in (low, low + 1) / denominator, where `bernstein` are the coefficients on that interval.
  Root(const Polynomial& polynomial, Integer low, Integer denominator, const Integer (&bernstein)[4]);

  /// The sign, -1, 0 or 1, of a polynomial of degree 2 at most. Not const: on the way the root may turn out to be a
  /// fraction.
  int sign(const Polynomial& polynomial);

  /// A double not larger than the root, and smaller by no more than the tolerance (in [1e-12, 1]).
  double fromBelow(double tolerance);

 private:
  bool isFraction() const { return m_low == m_high; }
  void narrowAt(const Integer& numerator);
  int signOnInterval(const Polynomial& quadratic) const;
  int signOfLinear(const Polynomial& linear);
  int signByDivision(const Polynomial& quadratic);

  const Polynomial* m_polynomial = nullptr;
  // Between m_low / m_denominator and m_high / m_denominator.
  Integer m_low;
  Integer m_high;
  Integer m_denominator;
  int m_signBelow = 0;  // of the polynomial between m_low and the root
};

/// Finds the distinct roots in [0, 1] of a polynomial that outlives it, in increasing order. Finds none of the
/// polynomial 0.
class RootFinder {
 public:
  explicit RootFinder(const Polynomial& polynomial);
  /// The next root; empty when there are no more.
  std::optional<Root> next();

 private:
  struct Fraction {
    Integer numerator;
    Integer denominator;
  };
  void addFraction(Integer numerator, Integer denominator);
  bool findMultipleRoot();
  void moveOn();
  std::optional<Root> nextFraction();

  const Polynomial& m_polynomial;
  // All roots up to m_low / m_denominator (without it, while m_isAtPoint) are found. To look at next: the interval up
  // to (m_low + 1) / m_denominator.
  Integer m_low = 0;
  Integer m_denominator = 1;
  bool m_isAtPoint = true;
  bool m_checkedForMultiple = false;
  // What is left to find, when all roots are fractions and known at once.
  bool m_areFractions = false;
  int m_fractionCount = 0;
  Fraction m_fractions[2];
};

}  // namespace wetcloth::collision::exact
