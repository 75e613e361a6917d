// SPDX-License-Identifier: Zlib
// Hand-made queries, each a class in which floating-point checks fail, with the truth and the time known in closed
// form.

#include "tests/support/QueryGeometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace wetcloth_test::continuous_check_degenerate_test {
namespace {

template <class Scalar>
struct Moving {
  Scalar from[3];
  Scalar to[3];
};

enum class Truth {
  meets,
  apart,       ///< farther than any rounding or tolerance: no tier may take it for a contact
  justMisses,  ///< apart, but only exact arithmetic needs to see it
};

template <class Scalar>
struct HandMade {
  const char* name;
  Pair pair;
  Truth truth;
  double time;  ///< exact
  Query<Scalar> query;
};

template <class Scalar>
Query<Scalar> queryOf(const Moving<Scalar>& p0, const Moving<Scalar>& p1, const Moving<Scalar>& p2,
                      const Moving<Scalar>& p3) {
  Query<Scalar> query;
  const Moving<Scalar>* const points[4] = {&p0, &p1, &p2, &p3};
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      query.start[i][axis] = points[i]->from[axis];
      query.end[i][axis] = points[i]->to[axis];
    }
  }
  return query;
}

template <class Scalar>
Moving<Scalar> still(Scalar x, Scalar y, Scalar z) {
  return {{x, y, z}, {x, y, z}};
}

// Straight down through z = 0 in the middle of the motion.
template <class Scalar>
Moving<Scalar> dropping(Scalar x, Scalar y, Scalar height) {
  return {{x, y, height}, {x, y, -height}};
}

// The point `p` against the resting face (0, 0, 0), (size, 0, 0), (0, size, 0), moved by (far, far, far).
template <class Scalar>
Query<Scalar> onFace(const Moving<Scalar>& p, Scalar size = 4, Scalar far = 0) {
  return queryOf(p, still<Scalar>(far, far, far), still<Scalar>(far + size, far, far),
                 still<Scalar>(far, far + size, far));
}

// The edge p0-p1 against the resting edge (0, 0, 0)-(4, 0, 0), moved by (far, far, far).
template <class Scalar>
Query<Scalar> onEdge(const Moving<Scalar>& p0, const Moving<Scalar>& p1, Scalar far = 0) {
  return queryOf(p0, p1, still<Scalar>(far, far, far), still<Scalar>(far + 4, far, far));
}

template <class Scalar>
std::vector<HandMade<Scalar>> faceCases() {
  using M = Moving<Scalar>;
  using Limits = std::numeric_limits<Scalar>;
  const Pair pair = Pair::vertexFace;
  const Scalar denormal = Limits::denorm_min();
  const Scalar huge = Limits::max();
  const Scalar tiny = static_cast<Scalar>(1e-12);
  const Scalar vast = static_cast<Scalar>(1e12);
  const Scalar belowEight = std::nextafter(Scalar(8), Scalar(0));
  const Scalar moment = std::ldexp(Scalar(1), -(Limits::digits - 4));
  const auto s = [](Scalar x, Scalar y, Scalar z) { return still<Scalar>(x, y, z); };

  std::vector<HandMade<Scalar>> cases;
  const auto meets = [&](const char* name, double time, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::meets, time, query});
  };
  const auto apart = [&](const char* name, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::apart, 0, query});
  };
  const auto justMisses = [&](const char* name, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::justMisses, 0, query});
  };

  meets("through the inside", 0.5, onFace<Scalar>(dropping<Scalar>(1, 1, 1)));
  apart("passes by the side", onFace<Scalar>(dropping<Scalar>(5, 5, 1)));
  apart("stops short", onFace<Scalar>(M{{1, 1, 2}, {1, 1, 1}}));
  meets("root at 0", 0, onFace<Scalar>(M{{1, 1, 0}, {1, 1, 1}}));
  meets("root at 1", 1, onFace<Scalar>(M{{1, 1, 1}, {1, 1, 0}}));
  meets("root at 0 of a face that leaves", 0,
        queryOf<Scalar>(s(1, 1, 0), M{{0, 0, 0}, {0, 0, 3}}, M{{4, 0, 0}, {4, 0, 1}}, M{{0, 4, 0}, {0, 4, 2}}));
  justMisses("stops one ulp short", onFace<Scalar>(M{{9, 9, 9}, {9, 9, std::nextafter(Scalar(8), Scalar(9))}}, 4, 8));
  justMisses("starts one ulp past", onFace<Scalar>(M{{9, 9, belowEight}, {9, 9, 7}}, 4, 8));
  meets("starts on and leaves", 0, onFace<Scalar>(M{{9, 9, 8}, {9, 9, 7}}, 4, 8));
  meets("tiny time", static_cast<double>(moment), onFace<Scalar>(M{{1, 1, moment}, {1, 1, moment - 1}}));
  meets("late time", 1 - static_cast<double>(moment), onFace<Scalar>(M{{1, 1, 1 - moment}, {1, 1, -moment}}));
  meets("face comes to the point", 0.25,
        queryOf<Scalar>(s(1, 1, 0), M{{0, 0, -1}, {0, 0, 3}}, M{{4, 0, -1}, {4, 0, 3}}, M{{0, 4, -1}, {0, 4, 3}}));

  // The face's height under the point is t (1 - t), the point's 1/4.
  const M rising = {{4, 0, 0}, {4, 0, 4}};
  meets("double root", 0.5, queryOf<Scalar>(M{{1, 1, 0.25}, {0, 1, 0.25}}, s(0, 0, 0), rising, s(0, 4, 0)));
  const Scalar above = std::nextafter(Scalar(0.25), Scalar(1));
  justMisses("double root missed by one ulp",
             queryOf<Scalar>(M{{1, 1, above}, {0, 1, above}}, s(0, 0, 0), rising, s(0, 4, 0)));
  apart("no root, double root nearby", queryOf<Scalar>(M{{1, 1, 0.5}, {0, 1, 0.5}}, s(0, 0, 0), rising, s(0, 4, 0)));

  // With s = 2 t - 1: p2 - p1 = (4 s, -4, 0), p3 - p1 = (0, 4 s, -4), p0 - p1 = a quarter of both + (0, 0, s), and the
  // cubic is 16 s^3.
  const M second = {{-4, -4, 0}, {4, -4, 0}};
  const M third = {{0, -4, -4}, {0, 4, -4}};
  meets("triple root", 0.5, queryOf<Scalar>(M{{-1, -2, -2}, {1, 0, 0}}, s(0, 0, 0), second, third));
  // The same with the whole of both: outside of the face when it is coplanar.
  apart("triple root without contact", queryOf<Scalar>(M{{-4, -8, -5}, {4, 0, -3}}, s(0, 0, 0), second, third));
  meets("triple root, all in one point", 0.5,
        queryOf<Scalar>(M{{0, 0, -1}, {0, 0, 1}}, s(0, 0, 0), M{{-1, 0, 0}, {1, 0, 0}}, M{{0, -1, 0}, {0, 1, 0}}));

  meets("coplanar all along, enters across an edge", 0.5, onFace<Scalar>(M{{5, 1, 0}, {1, 1, 0}}));
  meets("coplanar all along, grazes a vertex", 0.5, onFace<Scalar>(M{{4, 1, 0}, {4, -1, 0}}));
  apart("coplanar all along, passes by", onFace<Scalar>(M{{5, 5, 0}, {5, -5, 0}}));
  const Scalar beside = std::nextafter(Scalar(4), Scalar(5));
  justMisses("coplanar all along, one ulp beside", onFace<Scalar>(M{{beside, 1, 0}, {beside, -1, 0}}));
  meets("coplanar all along, starts inside", 0, onFace<Scalar>(M{{1, 1, 0}, {9, 9, 0}}));
  meets("coplanar all along, slanted plane", 0.5,
        queryOf<Scalar>(M{{5, 1, 6}, {1, 1, 2}}, s(0, 0, 0), s(4, 0, 4), s(0, 4, 4)));
  apart("coplanar all along, slanted plane, passes by",
        queryOf<Scalar>(M{{5, 5, 10}, {5, -5, 0}}, s(0, 0, 0), s(4, 0, 4), s(0, 4, 4)));
  meets("coplanar, the plane moves along", 0.5,
        queryOf<Scalar>(M{{5, 1, 0}, {1, 1, 8}}, M{{0, 0, 0}, {0, 0, 8}}, M{{4, 0, 0}, {4, 0, 8}},
                        M{{0, 4, 0}, {0, 4, 8}}));

  const auto onNeedle = [&](const M& p) { return queryOf<Scalar>(p, s(0, 0, 0), s(8, 0, 0), s(4, 0, 0)); };
  meets("zero-area face", 0.5, onNeedle(dropping<Scalar>(2, 0, 1)));
  meets("zero-area face, on its end", 0.5, onNeedle(dropping<Scalar>(8, 0, 1)));
  apart("zero-area face missed", onNeedle(dropping<Scalar>(2, 1, 1)));
  justMisses("zero-area face missed by one denormal", onNeedle(dropping<Scalar>(2, denormal, 1)));
  meets("zero-area face with two points the same", 0.5,
        queryOf<Scalar>(dropping<Scalar>(2, 0, 1), s(0, 0, 0), s(4, 0, 0), s(4, 0, 0)));
  const auto onPoint = [&](const M& p) { return queryOf<Scalar>(p, s(1, 1, 0), s(1, 1, 0), s(1, 1, 0)); };
  meets("face that is a point", 0.5, onPoint(dropping<Scalar>(1, 1, 1)));
  apart("face that is a point missed", onPoint(dropping<Scalar>(1, 2, 1)));
  justMisses("face that is a point missed by one ulp",
             onPoint(dropping<Scalar>(1, std::nextafter(Scalar(1), Scalar(0)), 1)));
  meets("face that shrinks to a point", 1,
        queryOf<Scalar>(s(0, 0, 0), M{{4, 0, 4}, {0, 0, 0}}, M{{0, 4, 4}, {0, 0, 0}}, M{{-4, -4, 4}, {0, 0, 0}}));

  meets("no motion, on the face", 0, onFace<Scalar>(s(1, 1, 0)));
  apart("no motion, apart", onFace<Scalar>(s(1, 1, 1)));
  justMisses("no motion, one ulp off", onFace<Scalar>(s(9, 9, belowEight), 4, 8));
  const auto together = [](Scalar x, Scalar y, Scalar z) { return M{{x, y, z}, {x + 3, y - 5, z + 7}}; };
  meets("common motion, on the face", 0,
        queryOf<Scalar>(together(1, 1, 0), together(0, 0, 0), together(4, 0, 0), together(0, 4, 0)));
  apart("common motion, apart",
        queryOf<Scalar>(together(1, 1, 1), together(0, 0, 0), together(4, 0, 0), together(0, 4, 0)));
  meets("four points the same", 0, queryOf<Scalar>(s(2, 3, 4), s(2, 3, 4), s(2, 3, 4), s(2, 3, 4)));

  meets("on a vertex", 0.5, onFace<Scalar>(dropping<Scalar>(0, 0, 1)));
  meets("on an edge", 0.5, onFace<Scalar>(dropping<Scalar>(2, 0, 1)));
  meets("on the long edge", 0.5, onFace<Scalar>(dropping<Scalar>(3, 1, 1)));
  justMisses("one denormal beside a vertex", onFace<Scalar>(dropping<Scalar>(-denormal, 0, 1)));
  justMisses("one denormal beside an edge", onFace<Scalar>(dropping<Scalar>(2, -denormal, 1)));
  justMisses("one ulp beside an edge", onFace<Scalar>(M{{9, belowEight, 9}, {9, belowEight, 7}}, 4, 8));
  justMisses("one ulp beside the long edge",
             onFace<Scalar>(dropping<Scalar>(3, std::nextafter(Scalar(1), Scalar(2)), 1)));

  meets("1e-12", 0.5, onFace<Scalar>(dropping<Scalar>(tiny, tiny, tiny), 4 * tiny));
  meets("1e12", 0.5, onFace<Scalar>(dropping<Scalar>(vast, vast, vast), 4 * vast));
  apart("1e-12, passes by", onFace<Scalar>(dropping<Scalar>(5 * tiny, 5 * tiny, tiny), 4 * tiny));
  apart("1e12, passes by", onFace<Scalar>(dropping<Scalar>(5 * vast, 5 * vast, vast), 4 * vast));
  meets("1e-12 at 1e12", 0.5, onFace<Scalar>(dropping<Scalar>(vast, vast, tiny), 4 * vast));
  justMisses("1e-12 above 1e12", onFace<Scalar>(M{{vast, vast, 2 * tiny}, {vast, vast, tiny}}, 4 * vast));
  meets("1e12 through 1e-12", 0.5, onFace<Scalar>(dropping<Scalar>(tiny, tiny, vast), 4 * tiny));
  justMisses("1e12 by the side of 1e-12", onFace<Scalar>(dropping<Scalar>(5 * tiny, 5 * tiny, vast), 4 * tiny));
  meets("denormals", 0.5, onFace<Scalar>(dropping<Scalar>(denormal, denormal, denormal), 4 * denormal));
  justMisses("denormals, passes by",
             onFace<Scalar>(dropping<Scalar>(5 * denormal, 5 * denormal, denormal), 4 * denormal));
  meets("denormal motion", 0.5, onFace<Scalar>(dropping<Scalar>(1, 1, denormal)));
  justMisses("denormal height", onFace<Scalar>(M{{1, 1, 2 * denormal}, {1, 1, denormal}}));
  meets("the largest numbers", 0.5,
        queryOf<Scalar>(dropping<Scalar>(0, 0, huge), s(-huge, -huge, 0), s(huge, -huge, 0), s(0, huge, 0)));
  justMisses("the largest numbers, passes by",
             queryOf<Scalar>(dropping<Scalar>(huge, huge, huge), s(-huge, -huge, 0), s(huge, -huge, 0), s(0, huge, 0)));
  return cases;
}

template <class Scalar>
std::vector<HandMade<Scalar>> edgeCases() {
  using M = Moving<Scalar>;
  using Limits = std::numeric_limits<Scalar>;
  const Pair pair = Pair::edgeEdge;
  const Scalar denormal = Limits::denorm_min();
  const Scalar huge = Limits::max();
  const Scalar tiny = static_cast<Scalar>(1e-12);
  const Scalar vast = static_cast<Scalar>(1e12);
  const Scalar moment = std::ldexp(Scalar(1), -(Limits::digits - 4));
  const auto s = [](Scalar x, Scalar y, Scalar z) { return still<Scalar>(x, y, z); };
  const auto d = [](Scalar x, Scalar y, Scalar height) { return dropping<Scalar>(x, y, height); };

  std::vector<HandMade<Scalar>> cases;
  const auto meets = [&](const char* name, double time, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::meets, time, query});
  };
  const auto apart = [&](const char* name, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::apart, 0, query});
  };
  const auto justMisses = [&](const char* name, const Query<Scalar>& query) {
    cases.push_back({name, pair, Truth::justMisses, 0, query});
  };

  meets("edges cross", 0.5, onEdge<Scalar>(d(1, -1, 1), d(1, 1, 1)));
  apart("passes beyond the end", onEdge<Scalar>(d(5, -1, 1), d(5, 1, 1)));
  apart("stops short", onEdge<Scalar>(M{{1, -1, 2}, {1, -1, 1}}, M{{1, 1, 2}, {1, 1, 1}}));
  meets("root at 0", 0, onEdge<Scalar>(M{{1, -1, 0}, {1, -1, 1}}, M{{1, 1, 0}, {1, 1, 1}}));
  meets("root at 1", 1, onEdge<Scalar>(M{{1, -1, 1}, {1, -1, 0}}, M{{1, 1, 1}, {1, 1, 0}}));
  const Scalar aboveEight = std::nextafter(Scalar(8), Scalar(9));
  justMisses("stops one ulp short",
             onEdge<Scalar>(M{{9, 7, 9}, {9, 7, aboveEight}}, M{{9, 9, 9}, {9, 9, aboveEight}}, 8));
  meets("tiny time", static_cast<double>(moment),
        onEdge<Scalar>(M{{1, -1, moment}, {1, -1, moment - 1}}, M{{1, 1, moment}, {1, 1, moment - 1}}));
  meets("late time", 1 - static_cast<double>(moment),
        onEdge<Scalar>(M{{1, -1, 1 - moment}, {1, -1, -moment}}, M{{1, 1, 1 - moment}, {1, 1, -moment}}));
  meets("both move", 0.25,
        queryOf<Scalar>(M{{1, -1, 3}, {1, -1, -5}}, M{{1, 1, 3}, {1, 1, -5}}, M{{0, 0, 0}, {0, 0, 4}},
                        M{{4, 0, 0}, {4, 0, 4}}));

  meets("on the end of one", 0.5, onEdge<Scalar>(d(4, -1, 1), d(4, 1, 1)));
  meets("ends meet", 0.5, onEdge<Scalar>(d(4, 0, 1), d(8, 3, 1)));
  meets("end on the inside", 0.5, onEdge<Scalar>(d(2, 0, 1), d(2, 3, 1)));
  justMisses("one ulp beyond the end", onEdge<Scalar>(d(std::nextafter(Scalar(4), Scalar(5)), -1, 1),
                                                      d(std::nextafter(Scalar(4), Scalar(5)), 1, 1)));
  justMisses("end one denormal beside", onEdge<Scalar>(d(2, denormal, 1), d(2, 3, 1)));

  meets("parallel", 0.5, onEdge<Scalar>(d(1, 0, 1), d(3, 0, 1)));
  meets("parallel, opposite ways", 0.5, onEdge<Scalar>(d(3, 0, 1), d(1, 0, 1)));
  meets("parallel, ends meet", 0.5, onEdge<Scalar>(d(4, 0, 1), d(8, 0, 1)));
  apart("parallel, beyond the end", onEdge<Scalar>(d(5, 0, 1), d(7, 0, 1)));
  apart("parallel, by the side", onEdge<Scalar>(d(1, 1, 1), d(3, 1, 1)));
  justMisses("parallel, one denormal beside", onEdge<Scalar>(d(1, denormal, 1), d(3, denormal, 1)));
  meets("parallel, comes in the common plane", 0.5, onEdge<Scalar>(M{{1, 2, 0}, {1, -2, 0}}, M{{3, 2, 0}, {3, -2, 0}}));
  meets("collinear", 0.5, onEdge<Scalar>(M{{6, 0, 0}, {2, 0, 0}}, M{{8, 0, 0}, {4, 0, 0}}));
  apart("collinear, stops short", onEdge<Scalar>(M{{6, 0, 0}, {5, 0, 0}}, M{{8, 0, 0}, {7, 0, 0}}));
  justMisses("collinear, stops one ulp short",
             onEdge<Scalar>(M{{6, 0, 0}, {std::nextafter(Scalar(4), Scalar(5)), 0, 0}}, M{{8, 0, 0}, {7, 0, 0}}));
  meets("collinear along a diagonal", 0.5,
        queryOf<Scalar>(M{{6, 6, 6}, {2, 2, 2}}, M{{8, 8, 8}, {4, 4, 4}}, s(0, 0, 0), s(4, 4, 4)));
  meets("the same edge twice", 0, onEdge<Scalar>(s(0, 0, 0), s(4, 0, 0)));

  meets("zero-length edge", 0.5, onEdge<Scalar>(d(1, 0, 1), d(1, 0, 1)));
  meets("zero-length edge on the end", 0.5, onEdge<Scalar>(d(4, 0, 1), d(4, 0, 1)));
  apart("zero-length edge, by the side", onEdge<Scalar>(d(1, 1, 1), d(1, 1, 1)));
  justMisses("zero-length edge, one denormal beside", onEdge<Scalar>(d(1, denormal, 1), d(1, denormal, 1)));
  meets("both of zero length", 0.5, queryOf<Scalar>(d(1, 2, 1), d(1, 2, 1), s(1, 2, 0), s(1, 2, 0)));
  apart("both of zero length, by the side", queryOf<Scalar>(d(1, 3, 1), d(1, 3, 1), s(1, 2, 0), s(1, 2, 0)));
  const Scalar belowTwo = std::nextafter(Scalar(2), Scalar(1));
  justMisses("both of zero length, one ulp beside",
             queryOf<Scalar>(d(1, belowTwo, 1), d(1, belowTwo, 1), s(1, 2, 0), s(1, 2, 0)));
  meets("edge that shrinks to a point", 1, onEdge<Scalar>(M{{1, -3, 2}, {1, 0, 0}}, M{{1, 3, 2}, {1, 0, 0}}));

  meets("coplanar all along", 0.5, onEdge<Scalar>(M{{6, -1, 0}, {2, -1, 0}}, M{{6, 1, 0}, {2, 1, 0}}));
  apart("coplanar all along, stops short", onEdge<Scalar>(M{{6, -1, 0}, {5, -1, 0}}, M{{6, 1, 0}, {5, 1, 0}}));
  apart("coplanar all along, passes by", onEdge<Scalar>(M{{5, -6, 0}, {5, 4, 0}}, M{{5, -4, 0}, {5, 6, 0}}));
  const Scalar beside = std::nextafter(Scalar(4), Scalar(5));
  justMisses("coplanar all along, one ulp beside",
             onEdge<Scalar>(M{{beside, -6, 0}, {beside, 4, 0}}, M{{beside, -4, 0}, {beside, 6, 0}}));
  meets("coplanar all along, end meets end", 0.5, onEdge<Scalar>(M{{4, -5, 0}, {4, -1, 0}}, M{{4, -2, 0}, {4, 2, 0}}));

  // With s = 2 t - 1, seen along the second edge: p0 = (s - 2, -1), p1 = (s + 2, s + 1); the cubic is 8 s^2.
  meets("double root", 0.5,
        queryOf<Scalar>(M{{-3, -1, -1}, {-1, -1, -1}}, M{{1, 1, 0}, {3, 1, 2}}, s(0, -4, 0), s(0, 4, 0)));
  const Scalar lower = std::nextafter(Scalar(-1), Scalar(-2));
  justMisses("double root missed by one ulp",
             queryOf<Scalar>(M{{-3, -1, lower}, {-1, -1, lower}}, M{{1, 1, 0}, {3, 1, 2}}, s(0, -4, 0), s(0, 4, 0)));
  apart("no root, double root nearby",
        queryOf<Scalar>(M{{-3, -1, -1.5}, {-1, -1, -1.5}}, M{{1, 1, 0}, {3, 1, 2}}, s(0, -4, 0), s(0, 4, 0)));
  // p1 = (s, -1, 0), p2 = (0, s, -1), p3 = (s, -1 - s, 1 + s) from p0: the cubic is s^3.
  meets("triple root", 0.5,
        queryOf<Scalar>(s(0, 0, 0), M{{-1, -1, 0}, {1, -1, 0}}, M{{0, -1, -1}, {0, 1, -1}}, M{{-1, 0, 0}, {1, -2, 2}}));
  // p3 = (3 s, -3 - s, 1 + s) has the same cubic and crosses beyond p1.
  apart("triple root without contact", queryOf<Scalar>(s(0, 0, 0), M{{-1, -1, 0}, {1, -1, 0}},
                                                       M{{0, -1, -1}, {0, 1, -1}}, M{{-3, -2, 0}, {3, -4, 2}}));

  apart("no motion, apart", onEdge<Scalar>(s(1, -1, 1), s(1, 1, 1)));
  meets("no motion, crossing", 0, onEdge<Scalar>(s(1, -1, 0), s(1, 1, 0)));
  justMisses("no motion, one denormal apart", onEdge<Scalar>(s(1, -1, denormal), s(1, 1, denormal)));
  const auto together = [](Scalar x, Scalar y, Scalar z) { return M{{x, y, z}, {x + 3, y - 5, z + 7}}; };
  meets("common motion, crossing", 0,
        queryOf<Scalar>(together(1, -1, 0), together(1, 1, 0), together(0, 0, 0), together(4, 0, 0)));
  apart("common motion, apart",
        queryOf<Scalar>(together(1, -1, 1), together(1, 1, 1), together(0, 0, 0), together(4, 0, 0)));

  const auto scaled = [&](Scalar unit, Scalar x) {
    return queryOf<Scalar>(d(x * unit, -unit, unit), d(x * unit, unit, unit), s(0, 0, 0), s(4 * unit, 0, 0));
  };
  meets("1e-12", 0.5, scaled(tiny, 1));
  meets("1e12", 0.5, scaled(vast, 1));
  apart("1e-12, passes by", scaled(tiny, 5));
  apart("1e12, passes by", scaled(vast, 5));
  meets("1e-12 at 1e12", 0.5,
        queryOf<Scalar>(d(vast, -tiny, tiny), d(vast, tiny, tiny), s(0, 0, 0), s(2 * vast, 0, 0)));
  justMisses("1e-12 beside 1e12",
             queryOf<Scalar>(d(vast, tiny, tiny), d(vast, 2 * tiny, tiny), s(0, 0, 0), s(2 * vast, 0, 0)));
  meets("denormals", 0.5, scaled(denormal, 1));
  justMisses("denormals, passes by", scaled(denormal, 5));
  meets("denormal motion", 0.5, onEdge<Scalar>(d(1, -1, denormal), d(1, 1, denormal)));
  meets("the largest numbers", 0.5,
        queryOf<Scalar>(d(-huge, 0, huge), d(huge, 0, huge), s(0, -huge, 0), s(0, huge, 0)));
  justMisses("the largest numbers, passes by",
             queryOf<Scalar>(d(1, 0, huge), d(huge, 0, huge), s(0, -huge, 0), s(0, huge, 0)));
  return cases;
}

template <class Scalar>
std::vector<HandMade<Scalar>> handMade() {
  std::vector<HandMade<Scalar>> cases = faceCases<Scalar>();
  for (const HandMade<Scalar>& edges : edgeCases<Scalar>()) cases.push_back(edges);
  return cases;
}

template <class Scalar>
class ContinuousCheckHandMade : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContinuousCheckHandMade, Scalars, );

template <class Scalar>
std::string tell(const Way& way, const HandMade<Scalar>& made) {
  return std::string(way.name) + ", " + made.name + ": " + literal(made.pair, made.query);
}

TYPED_TEST(ContinuousCheckHandMade, NoWayMissesOne) {
  for (const auto& made : handMade<TypeParam>()) {
    for (const Way& way : everyWay()) {
      if (made.truth == Truth::meets) {
        EXPECT_TRUE(ask(way, made.pair, made.query)) << tell(way, made);
      }
    }
  }
}

TYPED_TEST(ContinuousCheckHandMade, NoWayTakesFarForNear) {
  for (const auto& made : handMade<TypeParam>()) {
    for (const Way& way : everyWay()) {
      if (made.truth == Truth::apart) {
        EXPECT_FALSE(ask(way, made.pair, made.query)) << tell(way, made);
      }
    }
  }
}

TYPED_TEST(ContinuousCheckHandMade, ExactTakesNoNearMissForAContact) {
  if (!ContinuousCheck::hasExact()) GTEST_SKIP() << "a build without Tier::exact";
  for (const auto& made : handMade<TypeParam>()) {
    for (const Way& way : everyWay()) {
      if (made.truth == Truth::justMisses && way.tier == Tier::exact) {
        EXPECT_FALSE(ask(way, made.pair, made.query)) << tell(way, made);
      }
    }
  }
}

TYPED_TEST(ContinuousCheckHandMade, NoTimeIsLate) {
  for (const auto& made : handMade<TypeParam>()) {
    for (const Way& way : everyWay()) {
      if (made.truth != Truth::meets) continue;
      for (const double tolerance : {1e-12, 1e-6, 1e-2}) {
        CheckSettings settings;
        settings.tolerance = tolerance;
        const Contact contact = ask(way, made.pair, made.query, settings);
        EXPECT_GE(contact.time, 0) << tell(way, made);
        EXPECT_LE(contact.time, made.time) << tell(way, made) << ", tolerance " << tolerance;
      }
    }
  }
}

TYPED_TEST(ContinuousCheckHandMade, AMissHasNoTimeAndNoPlace) {
  int misses = 0;
  for (const auto& made : handMade<TypeParam>()) {
    for (const Way& way : everyWay()) {
      const Contact contact = ask(way, made.pair, made.query);
      if (contact.found) continue;
      ++misses;
      EXPECT_EQ(contact.time, 0) << tell(way, made);
    }
  }
  EXPECT_GT(misses, 0);
}

TYPED_TEST(ContinuousCheckHandMade, WhereIsInRangeAndTheNearestPlace) {
  for (const auto& made : handMade<TypeParam>()) {
    // Where squares of lengths leave the range of double, a nearest place cannot be asked for, only one in range.
    const long double size = extent(made.query);
    const bool measurable = size < 1e30L && size > 1e-30L;
    for (const Way& way : everyWay()) {
      const Contact contact = ask(way, made.pair, made.query);
      if (!contact.found) continue;
      EXPECT_TRUE(whereInRange(made.pair, contact))
          << tell(way, made) << ": " << contact.where[0] << ", " << contact.where[1];
      if (!measurable) continue;
      const long double named = distanceOf(made.pair, made.query, contact.time, contact.where);
      EXPECT_LE(named, distanceAt(made.pair, made.query, contact.time) + whereRounding(made.query))
          << tell(way, made) << " at " << contact.time << ": " << contact.where[0] << ", " << contact.where[1];
    }
  }
}

// All of these cross the plane of the face, or one edge the plane of the other and its motion, at once and in the
// inside: every interval that ends before the contact can be excluded.
TYPED_TEST(ContinuousCheckHandMade, TimeIsAsCloseAsTheToleranceWhereTheContactIsPlain) {
  const std::vector<std::string> plain = {"through the inside", "edges cross", "face comes to the point", "both move"};
  int asked = 0;
  for (const auto& made : handMade<TypeParam>()) {
    if (std::find(plain.begin(), plain.end(), made.name) == plain.end()) continue;
    for (const Way& way : everyWay()) {
      for (const double tolerance : {1e-9, 1e-6, 1e-2}) {
        CheckSettings settings;
        settings.tolerance = tolerance;
        // Twice: the last interval may end just before the contact, by less than its rounding or its width.
        EXPECT_GE(ask(way, made.pair, made.query, settings).time, made.time - 2 * tolerance)
            << tell(way, made) << ", tolerance " << tolerance;
        ++asked;
      }
    }
  }
  EXPECT_GE(asked, 4 * 4 * 3);
}

template <class Scalar>
class ContinuousCheckNotFinite : public testing::Test {};
TYPED_TEST_SUITE(ContinuousCheckNotFinite, Scalars, );

TYPED_TEST(ContinuousCheckNotFinite, IsAContactAtTheStartWhereverItStands) {
  using Limits = std::numeric_limits<TypeParam>;
  const auto cases = handMade<TypeParam>();
  for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (const auto& made : cases) {
      if (std::string(made.name) != "stops short") continue;
      for (const Way& way : everyWay()) {
        for (int place = 0; place < 24; ++place) {
          Query<TypeParam> query = made.query;
          (place < 12 ? query.start : query.end)[place % 12 / 3][place % 3] = bad;
          const Contact contact = ask(way, made.pair, query);
          EXPECT_TRUE(contact.found) << way.name << ": " << literal(made.pair, query);
          EXPECT_EQ(contact.time, 0) << way.name << ": " << literal(made.pair, query);
          EXPECT_TRUE(whereInRange(made.pair, contact)) << way.name << ": " << literal(made.pair, query);
        }
      }
    }
  }
}

TYPED_TEST(ContinuousCheckNotFinite, EverythingAtOnceToo) {
  Query<TypeParam> query;
  for (auto* points : {&query.start, &query.end}) {
    for (auto& point : *points)
      for (TypeParam& coordinate : point) coordinate = std::numeric_limits<TypeParam>::quiet_NaN();
  }
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (const Way& way : everyWay()) {
      const Contact contact = ask(way, pair, query);
      EXPECT_TRUE(contact.found) << way.name;
      EXPECT_EQ(contact.time, 0) << way.name;
      EXPECT_TRUE(whereInRange(pair, contact)) << way.name;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_degenerate_test
