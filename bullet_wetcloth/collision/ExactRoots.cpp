// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/ExactRoots.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wetcloth::collision::exact {

namespace {

// A root is first narrowed to this share, 2^-32, of its interval: enough for the sign of nearly every other polynomial,
// and a numerator still fits in a machine word.
constexpr unsigned kGuessBits = 32;

// Most pairs of roots part after a few halvings; only where they have not is it worth to look for a multiple root.
constexpr int kDenominatorOfDoubt = 16;

int signAt(const Polynomial& polynomial, const Integer& numerator, const Integer& denominator) {
  if (numerator.is_zero()) return polynomial.c[0].sign();
  const int degree = polynomial.degree();
  if (degree < 0) return 0;
  Integer value = polynomial.c[degree];
  Integer scale = 1;
  for (int i = degree - 1; i >= 0; --i) {
    scale *= denominator;
    value *= numerator;
    value += polynomial.c[i] * scale;
  }
  return value.sign();
}

// On (low, low + 1) / denominator, times a positive number.
void bernsteinCoefficients(const Polynomial& polynomial, const Integer& low, const Integer& denominator,
                           Integer (&bernstein)[4]) {
  Integer c[4] = {polynomial.c[0], polynomial.c[1], polynomial.c[2], polynomial.c[3]};
  if (denominator != 1) {
    Integer scale = denominator;
    for (int i = 2; i >= 0; --i, scale *= denominator) c[i] *= scale;
    for (int first = 0; first < 3; ++first)
      for (int i = 2; i >= first; --i) c[i] += c[i + 1] * low;
  }
  bernstein[0] = c[0] * 3;
  bernstein[1] = bernstein[0] + c[1];
  bernstein[2] = bernstein[1] + c[1] + c[2];
  bernstein[3] = (c[0] + c[1] + c[2] + c[3]) * 3;
}

int signVariations(const Integer (&coefficients)[4]) {
  int variations = 0;
  int last = 0;
  for (const Integer& coefficient : coefficients) {
    const int sign = coefficient.sign();
    if (sign == 0) continue;
    if (sign == -last) ++variations;
    last = sign;
  }
  return variations;
}

int firstSign(const Integer (&coefficients)[4]) {
  for (const Integer& coefficient : coefficients)
    if (!coefficient.is_zero()) return coefficient.sign();
  return 0;
}

unsigned bitsOf(const Integer& value) {
  return value.is_zero() ? 0 : static_cast<unsigned>(msb(value.sign() < 0 ? Integer(-value) : value)) + 1;
}

// Where in (0, 1) the one root is, about. No decision depends on it.
double guessRoot(const Integer (&bernstein)[4], int signBelow) {
  unsigned bits = 0;
  for (const Integer& coefficient : bernstein) bits = std::max(bits, bitsOf(coefficient));
  double b[4];
  for (int i = 0; i < 4; ++i) {
    const Integer shortened = bits > 62 ? Integer(bernstein[i] >> (bits - 62)) : bernstein[i];
    b[i] = signBelow * static_cast<double>(shortened.convert_to<std::int64_t>());
  }
  const double c1 = 3 * (b[1] - b[0]);
  const double c2 = 3 * (b[2] - 2 * b[1] + b[0]);
  const double c3 = b[3] - b[0] + 3 * (b[1] - b[2]);
  double root = 0;
  double step = 0.5;
  for (int halving = 0; halving < 39; ++halving) {  // to 2e-12
    const double t = root + step;
    if (((c3 * t + c2) * t + c1) * t + b[0] > 0) root = t;
    step *= 0.5;
  }
  return root;
}

}  // namespace

int Polynomial::degree() const {
  int degree = 3;
  while (degree >= 0 && c[degree].is_zero()) --degree;
  return degree;
}

Root::Root(Integer numerator, Integer denominator)
    : m_low(std::move(numerator)), m_high(m_low), m_denominator(std::move(denominator)) {}

Root::Root(const Polynomial& polynomial, Integer low, Integer denominator, const Integer (&bernstein)[4])
    : m_polynomial(&polynomial),
      m_low(std::move(low)),
      m_denominator(std::move(denominator)),
      m_signBelow(firstSign(bernstein)) {
  m_low <<= kGuessBits;
  m_denominator <<= kGuessBits;
  constexpr std::int64_t parts = std::int64_t(1) << kGuessBits;
  m_high = m_low + parts;
  // The ends of the interval may be roots as well: they are not evaluated, ever.
  const double guess = guessRoot(bernstein, m_signBelow);
  const std::int64_t part = std::clamp<std::int64_t>(std::llround(guess * parts), 1, parts - 1);
  const Integer middle = m_low + part;
  narrowAt(middle);
  if (m_high - m_low > 1) narrowAt(m_low == middle ? Integer(middle + 1) : Integer(middle - 1));
  while (m_high - m_low > 1) narrowAt((m_low + m_high) >> 1);
}

void Root::narrowAt(const Integer& numerator) {
  const int sign = signAt(*m_polynomial, numerator, m_denominator);
  if (sign != -m_signBelow) m_low = numerator;
  if (sign != m_signBelow) m_high = numerator;
}

int Root::sign(const Polynomial& polynomial) {
  if (isFraction()) return signAt(polynomial, m_low, m_denominator);
  if (polynomial.degree() < 2) return signOfLinear(polynomial);
  const int sign = signOnInterval(polynomial);
  return sign != 0 ? sign : signByDivision(polynomial);
}

// 0 when it is not the same all over the interval. Where the Bernstein coefficients are of one sign, so is the
// polynomial in the open interval, even if some of them are 0.
int Root::signOnInterval(const Polynomial& quadratic) const {
  const Integer constant = quadratic.c[0] * m_denominator * m_denominator;
  const Integer linear = quadratic.c[1] * m_denominator;
  const Integer low = quadratic.c[2] * m_low;
  const Integer high = quadratic.c[2] * m_high;
  const int signs[] = {Integer(constant + (linear + low) * m_low).sign(),
                       Integer((constant << 1) + linear * m_low + (linear + (low << 1)) * m_high).sign(),
                       Integer(constant + (linear + high) * m_high).sign()};
  const auto [least, largest] = std::minmax_element(std::begin(signs), std::end(signs));
  return *least >= 0 ? *largest : *largest <= 0 ? *least : 0;
}

// Compares the root with the root of the linear polynomial.
int Root::signOfLinear(const Polynomial& linear) {
  const int slope = linear.c[1].sign();
  if (slope == 0) return linear.c[0].sign();
  const Integer numerator = slope > 0 ? Integer(-linear.c[0]) : linear.c[0];
  const Integer denominator = slope > 0 ? linear.c[1] : Integer(-linear.c[1]);
  const Integer scaled = numerator * m_denominator;
  if (scaled <= m_low * denominator) return slope;
  if (scaled >= m_high * denominator) return -slope;
  const int sign = signAt(*m_polynomial, numerator, denominator);
  if (sign != 0) return sign == m_signBelow ? slope : -slope;
  m_low = m_high = numerator;
  m_denominator = denominator;
  return 0;
}

// With g the quadratic and p the polynomial of the root, g2^2 p = q g + r, q and r linear: at the root q g = -r. A p of
// degree 2 needs no exception, its q is constant.
int Root::signByDivision(const Polynomial& quadratic) {
  const Integer(&g)[4] = quadratic.c;
  const Integer(&p)[4] = m_polynomial->c;
  Polynomial quotient;
  quotient.c[1] = g[2] * p[3];
  quotient.c[0] = g[2] * p[2] - g[1] * p[3];
  const int quotientSign = sign(quotient);
  // Where q is 0 the root is that of q, a fraction: signOfLinear has noticed.
  if (quotientSign == 0) return signAt(quadratic, m_low, m_denominator);
  const Integer square = g[2] * g[2];
  Polynomial remainder;
  remainder.c[1] = square * p[1] - quotient.c[1] * g[0] - quotient.c[0] * g[1];
  remainder.c[0] = square * p[0] - quotient.c[0] * g[0];
  return -quotientSign * sign(remainder);
}

double Root::fromBelow(double tolerance) {
  // Half of the tolerance for the interval; the other half is more than the rounding to a double takes.
  const unsigned bits = static_cast<unsigned>(1 - std::ilogb(tolerance));
  while (((m_high - m_low) << bits) > m_denominator) {
    const Integer middle = m_low + m_high;
    m_low <<= 1;
    m_high <<= 1;
    m_denominator <<= 1;
    narrowAt(middle);
  }
  return std::ldexp(Integer((m_low << 53) / m_denominator).convert_to<double>(), -53);
}

RootFinder::RootFinder(const Polynomial& polynomial) : m_polynomial(polynomial) {
  const int degree = polynomial.degree();
  m_areFractions = degree < 2;
  if (degree == 1) {
    m_low = -1;  // so that 0 is not yet found
    addFraction(-polynomial.c[0], polynomial.c[1]);
  }
}

// Unless it is not in [0, 1] or was found before.
void RootFinder::addFraction(Integer numerator, Integer denominator) {
  if (denominator.sign() < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  if (numerator.sign() < 0 || numerator > denominator) return;
  if (numerator * m_denominator <= m_low * denominator) return;
  m_fractions[m_fractionCount++] = {std::move(numerator), std::move(denominator)};
}

// A polynomial of degree 3 at most with a multiple root has only fractions for roots: the multiple one is the common
// root of p and p', and that of the linear remainder of p divided by p' (unless p' divides p: then it is triple).
bool RootFinder::findMultipleRoot() {
  const Integer(&c)[4] = m_polynomial.c;
  if (m_polynomial.degree() == 2) {
    if (c[1] * c[1] != c[0] * c[2] * 4) return false;
    addFraction(-c[1], c[2] * 2);
    return true;
  }
  const Integer slope = (c[1] * c[3] * 3 - c[2] * c[2]) * 2;
  const Integer constant = c[0] * c[3] * 9 - c[1] * c[2];
  if (slope.is_zero()) {
    if (!constant.is_zero()) return false;
    addFraction(-c[2], c[3] * 3);
    return true;
  }
  const Polynomial derivative = {{c[1], c[2] * 2, c[3] * 3, 0}};
  if (signAt(derivative, slope.sign() < 0 ? constant : Integer(-constant), abs(slope)) != 0) return false;
  addFraction(-constant, slope);
  addFraction(constant * c[3] * 2 - c[2] * slope, c[3] * slope);  // the sum of the roots is -c2 / c3
  if (m_fractionCount == 2 &&
      m_fractions[1].numerator * m_fractions[0].denominator < m_fractions[0].numerator * m_fractions[1].denominator) {
    std::swap(m_fractions[0], m_fractions[1]);
  }
  return true;
}

std::optional<Root> RootFinder::nextFraction() {
  if (m_fractionCount == 0) return std::nullopt;
  Root root(m_fractions[0].numerator, m_fractions[0].denominator);
  --m_fractionCount;
  std::swap(m_fractions[0], m_fractions[1]);
  return root;
}

// Past the interval. What was halved on the way down is put together again on the way up.
void RootFinder::moveOn() {
  ++m_low;
  while (m_denominator != 1 && !bit_test(m_low, 0)) {
    m_low >>= 1;
    m_denominator >>= 1;
  }
  m_isAtPoint = true;
}

// Descartes' rule: no more roots in an open interval than sign variations of the Bernstein coefficients there, and not
// fewer by an odd number. Halving ends, for want of multiple roots.
std::optional<Root> RootFinder::next() {
  while (!m_areFractions) {
    if (m_isAtPoint) {
      m_isAtPoint = false;
      if (signAt(m_polynomial, m_low, m_denominator) == 0) return Root(m_low, m_denominator);
    }
    if (m_low == m_denominator) return std::nullopt;
    Integer bernstein[4];
    bernsteinCoefficients(m_polynomial, m_low, m_denominator, bernstein);
    const int variations = signVariations(bernstein);
    if (variations < 2) {
      std::optional<Root> root;
      if (variations == 1) root.emplace(m_polynomial, m_low, m_denominator, bernstein);
      moveOn();
      if (root) return root;
      continue;
    }
    if (!m_checkedForMultiple && m_denominator >= kDenominatorOfDoubt) {
      m_checkedForMultiple = true;
      m_areFractions = findMultipleRoot();
    }
    m_low <<= 1;
    m_denominator <<= 1;
  }
  return nextFraction();
}

}  // namespace wetcloth::collision::exact
