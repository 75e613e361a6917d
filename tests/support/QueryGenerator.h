// SPDX-License-Identifier: Zlib
#pragma once

// Queries by class, each class a way in which floating-point collision checks are known to fail. The same seed gives
// the same queries on every machine: no distributions of the standard library, whose numbers differ between compilers.

#include "tests/support/QueryGeometry.h"

#include <cstdint>
#include <limits>
#include <random>

namespace wetcloth_test {

enum class QueryClass {
  lattice,     ///< small integers: contacts on boundaries, double roots and coplanar motion turn up exactly
  oneUlp,      ///< touches exactly at a quarter of the motion; then one coordinate moved by one ulp
  farOffset,   ///< small features far from the origin
  tinyTime,    ///< contact within 2^-30 .. 2^-60 of the start (float: 2^-10 .. 2^-25)
  coplanar,    ///< all in one plane all along
  cloth,       ///< about to touch, motion small beside the size
  degenerate,  ///< points that coincide, parallel edges, no or common motion
  mixedScale,  ///< axes stretched by 1e-12 .. 1e12
  anything     ///< uniform in a cube
};

constexpr QueryClass kQueryClasses[] = {QueryClass::lattice,    QueryClass::oneUlp,     QueryClass::farOffset,
                                        QueryClass::tinyTime,   QueryClass::coplanar,   QueryClass::cloth,
                                        QueryClass::degenerate, QueryClass::mixedScale, QueryClass::anything};

inline const char* nameOf(QueryClass kind) {
  switch (kind) {
    case QueryClass::lattice: return "lattice";
    case QueryClass::oneUlp: return "oneUlp";
    case QueryClass::farOffset: return "farOffset";
    case QueryClass::tinyTime: return "tinyTime";
    case QueryClass::coplanar: return "coplanar";
    case QueryClass::cloth: return "cloth";
    case QueryClass::degenerate: return "degenerate";
    case QueryClass::mixedScale: return "mixedScale";
    default: return "anything";
  }
}

class QueryGenerator {
 public:
  explicit QueryGenerator(std::uint64_t seed) : m_engine(seed) {}

  template <class Scalar>
  Query<Scalar> next(QueryClass kind, Pair pair) {
    switch (kind) {
      case QueryClass::lattice: return converted<Scalar>(lattice());
      case QueryClass::oneUlp: return oneUlp<Scalar>(pair);
      case QueryClass::farOffset: return converted<Scalar>(farOffset(pair, std::is_same<Scalar, float>::value));
      case QueryClass::tinyTime: return converted<Scalar>(tinyTime(pair, std::is_same<Scalar, float>::value));
      case QueryClass::coplanar: return converted<Scalar>(coplanar());
      case QueryClass::cloth: return converted<Scalar>(aimed(pair, real(0, 1), 0.1));
      case QueryClass::degenerate: return converted<Scalar>(degenerate(pair));
      case QueryClass::mixedScale: return converted<Scalar>(mixedScale(pair));
      default: return converted<Scalar>(uniform());
    }
  }

  /// Meets at `quarters` / 4, if not before. Integers of less than 7 bits.
  Query<double> touching(Pair pair, int quarters) {
    int at[4][3];
    const int a = integer(0, 4);
    const int b = pair == Pair::vertexFace ? integer(0, 4 - a) : integer(0, 4);
    for (int axis = 0; axis < 3; ++axis) {
      int(*x)[3] = at;
      for (int i = 0; i < 4; ++i) x[i][axis] = 4 * integer(-2, 2);
      if (pair == Pair::vertexFace) {
        x[0][axis] = x[1][axis] + (a * (x[2][axis] - x[1][axis]) + b * (x[3][axis] - x[1][axis])) / 4;
      } else {
        const int along = 4 * integer(-2, 2);
        x[2][axis] = x[0][axis] + a * (x[1][axis] - x[0][axis]) / 4 - b * along / 4;
        x[3][axis] = x[2][axis] + along;
      }
    }
    Query<double> query;
    for (int i = 0; i < 4; ++i) {
      const bool rests = integer(0, 3) == 0;
      for (int axis = 0; axis < 3; ++axis) {
        const int quarterOfMotion = rests ? 0 : integer(-4, 4);
        query.start[i][axis] = at[i][axis] - quarters * quarterOfMotion;
        query.end[i][axis] = at[i][axis] + (4 - quarters) * quarterOfMotion;
      }
    }
    return query;
  }

  Query<double> lattice() {
    const int range = integer(1, 3);
    const double scale = std::ldexp(1.0, integer(-3, 3));
    const int flatAxis = integer(0, 5);
    Query<double> query;
    for (int i = 0; i < 4; ++i) {
      const bool rests = integer(0, 2) == 0;
      for (int axis = 0; axis < 3; ++axis) {
        query.start[i][axis] = axis == flatAxis && i > 0 ? query.start[0][axis] : scale * integer(-range, range);
        query.end[i][axis] = axis == flatAxis && i > 0 ? query.end[0][axis]
                             : rests                   ? query.start[i][axis]
                                                       : scale * integer(-range, range);
      }
    }
    return query;
  }

  Query<double> uniform() {
    Query<double> query;
    for (int i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        query.start[i][axis] = real(-1, 1);
        query.end[i][axis] = real(-1, 1);
      }
    }
    return query;
  }

  /// Comes together at `time` but for rounding, or just misses by the side. `motion` is its size relative to the shape.
  Query<double> aimed(Pair pair, double time, double motion) {
    double at[4][3];
    const double a = real(-0.05, 1.05);
    const double b = pair == Pair::vertexFace ? real(-0.05, 1.05 - a) : real(-0.05, 1.05);
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 4; ++i) at[i][axis] = real(-1, 1);
      if (pair == Pair::vertexFace) {
        at[0][axis] = at[1][axis] + a * (at[2][axis] - at[1][axis]) + b * (at[3][axis] - at[1][axis]);
      } else {
        const double along = at[3][axis] - at[2][axis];
        at[2][axis] = at[0][axis] + a * (at[1][axis] - at[0][axis]) - b * along;
        at[3][axis] = at[2][axis] + along;
      }
    }
    Query<double> query;
    for (int i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double velocity = real(-motion, motion);
        query.start[i][axis] = at[i][axis] - time * velocity;
        query.end[i][axis] = at[i][axis] + (1 - time) * velocity;
      }
    }
    return query;
  }

  int integer(int first, int last) {
    return first + static_cast<int>(m_engine() % static_cast<std::uint64_t>(last - first + 1));
  }
  double real(double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(m_engine() >> 11), -53);
  }

 private:
  template <class Scalar>
  Query<Scalar> oneUlp(Pair pair) {
    Query<double> exact = touching(pair, integer(0, 4));
    // 17 bits of offset and 7 of shape are what a float holds.
    if (integer(0, 1) == 0)
      for (int axis = 0; axis < 3; ++axis) translate(exact, axis, integer(-65000, 65000));
    Query<Scalar> query = converted<Scalar>(exact);
    if (integer(0, 4) == 0) return query;
    auto& points = integer(0, 1) == 0 ? query.start : query.end;
    Scalar& coordinate = points[integer(0, 3)][integer(0, 2)];
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    coordinate = std::nextafter(coordinate, integer(0, 1) == 0 ? infinity : -infinity);
    return query;
  }

  Query<double> farOffset(Pair pair, bool single) {
    Query<double> query = integer(0, 1) == 0 ? aimed(pair, real(0, 1), 1) : touching(pair, integer(0, 4));
    const double size = std::ldexp(1.0, integer(-10, 0));
    for (int i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        query.start[i][axis] *= size;
        query.end[i][axis] *= size;
      }
    }
    for (int axis = 0; axis < 3; ++axis)
      translate(query, axis, std::round(real(-1, 1) * std::pow(10.0, single ? integer(1, 5) : integer(6, 9))));
    return query;
  }

  Query<double> tinyTime(Pair pair, bool single) {
    const double time = std::ldexp(1.0, single ? -integer(10, 25) : -integer(30, 60));
    if (integer(0, 1) == 0) return aimed(pair, time, 1);
    // A plane along the axes keeps the height above it exact.
    Query<double> query = aimed(pair, 0, 0);
    const int up = integer(0, 2);
    const int moving = pair == Pair::vertexFace ? 1 : 2;
    const double sign = integer(0, 1) == 0 ? 1 : -1;
    for (int i = 0; i < 4; ++i) {
      query.start[i][up] = i < moving ? sign * time : 0;
      query.end[i][up] = i < moving ? sign * (time - 1) : 0;
    }
    return query;
  }

  Query<double> coplanar() {
    Query<double> query;
    const bool integers = integer(0, 1) == 0;
    if (integers) {
      query = lattice();
    } else {
      query = uniform();
    }
    const int normal = integer(0, 2);
    const int u = (normal + 1) % 3;
    const int v = (normal + 2) % 3;
    const bool slanted = integers && integer(0, 1) == 0;
    const double from = integers ? integer(-2, 2) : real(-1, 1);
    const double to = integer(0, 1) == 0 ? from : real(-1, 1);
    for (int i = 0; i < 4; ++i) {
      query.start[i][normal] = slanted ? query.start[i][u] + 2 * query.start[i][v] : from;
      query.end[i][normal] = slanted ? query.end[i][u] + 2 * query.end[i][v] : to;
    }
    return query;
  }

  Query<double> degenerate(Pair pair) {
    Query<double> query = integer(0, 1) == 0 ? lattice() : touching(pair, integer(0, 4));
    const auto copyPoint = [&query](int to, int from) {
      for (int axis = 0; axis < 3; ++axis) {
        query.start[to][axis] = query.start[from][axis];
        query.end[to][axis] = query.end[from][axis];
      }
    };
    switch (integer(0, 6)) {
      case 0: copyPoint(2, 1); break;
      case 1:
        copyPoint(2, 1);
        copyPoint(3, 1);
        break;
      case 2: copyPoint(1, 0); break;
      case 3: copyPoint(3, 2); break;
      case 4:
        for (int axis = 0; axis < 3; ++axis) {
          query.start[3][axis] = query.start[2][axis] + (query.start[1][axis] - query.start[0][axis]);
          query.end[3][axis] = query.end[2][axis] + (query.end[1][axis] - query.end[0][axis]);
        }
        break;
      case 5:
        for (int i = 0; i < 4; ++i)
          for (int axis = 0; axis < 3; ++axis) query.end[i][axis] = query.start[i][axis];
        break;
      default:
        for (int i = 1; i < 4; ++i) {
          for (int axis = 0; axis < 3; ++axis)
            query.end[i][axis] = query.start[i][axis] + (query.end[0][axis] - query.start[0][axis]);
        }
    }
    return query;
  }

  Query<double> mixedScale(Pair pair) {
    Query<double> query = integer(0, 1) == 0 ? aimed(pair, real(0, 1), 1) : touching(pair, integer(0, 4));
    for (int axis = 0; axis < 3; ++axis) {
      const double stretch = std::pow(10.0, integer(-12, 12));
      for (int i = 0; i < 4; ++i) {
        query.start[i][axis] *= stretch;
        query.end[i][axis] *= stretch;
      }
    }
    return query;
  }

  static void translate(Query<double>& query, int axis, double by) {
    for (int i = 0; i < 4; ++i) {
      query.start[i][axis] += by;
      query.end[i][axis] += by;
    }
  }

  std::mt19937_64 m_engine;
};

}  // namespace wetcloth_test
