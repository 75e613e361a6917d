// SPDX-License-Identifier: Zlib
#include "command/stability/Cases.h"

#include <bullet_wetcloth/collision/ContinuousCheck.h>
#include "command/ccd/TextbookCheck.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

// Contacts whose coplanarity cubic is next to nothing, has its roots at the ends or twice, or overflows.
namespace stability {
namespace {

using wetcloth::collision::CheckSettings;
using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

/// A query whose answer is known from how it was made.
struct Known {
  Pair pair;
  bool meets;
  double time;  ///< of the first contact, if they meet
  Query<double> query;
};

using Point = std::array<double, 3>;

Known vertexFace(const Point& from, const Point& to, bool meets, double time) {
  Known known{Pair::vertexFace, meets, time, {}};
  const Point still[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    known.query.start[0][axis] = from[axis];
    known.query.end[0][axis] = to[axis];
    for (std::size_t k = 0; k < 3; ++k) known.query.start[k + 1][axis] = known.query.end[k + 1][axis] = still[k][axis];
  }
  return known;
}

/// The edge p-q, moved by `motion`, against the edge (-1, 0, 0)-(1, 0, 0) at rest.
Known edgeEdge(const Point& p, const Point& q, const Point& motion, bool meets, double time) {
  Known known{Pair::edgeEdge, meets, time, {}};
  const Point ends[4] = {p, q, {-1, 0, 0}, {1, 0, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      known.query.start[k][axis] = ends[k][axis];
      known.query.end[k][axis] = ends[k][axis] + (k < 2 ? motion[axis] : 0);
    }
  }
  return known;
}

/// All points by the same amount: powers of two, so that nothing is rounded and the answer stays.
Known moved(Known known, double factor, double offset) {
  for (auto* const points : {&known.query.start, &known.query.end}) {
    for (auto& point : *points) {
      for (double& coordinate : point) coordinate = coordinate * factor + offset;
    }
  }
  return known;
}

std::vector<Known> plain() {
  std::vector<Known> known;
  for (int i = 1; i < 8; ++i) {
    for (int j = 1; i + j < 8; ++j) {
      const double x = i * 0.5;
      const double y = j * 0.5;
      known.push_back(vertexFace({x, y, 1}, {x, y, -1}, true, 0.5));
      known.push_back(vertexFace({x, y, 1}, {x, y, 0.5}, false, 0));
      known.push_back(vertexFace({-x, y, 1}, {-x, y, -1}, false, 0));
    }
    const double x = i * 0.25 - 1;
    known.push_back(edgeEdge({x, -1, 1}, {x, 1, 1}, {0, 0, -2}, true, 0.5));
    known.push_back(edgeEdge({x, 1, 1}, {x, 3, 1}, {0, 0, -2}, false, 0));
  }
  return known;
}

std::vector<Known> coplanar() {
  std::vector<Known> known;
  for (int i = 1; i < 16; ++i) {
    const double y = i * 0.25;
    // In the plane of the face all along: the cubic is 0. It comes in through the edge x = 0.
    known.push_back(vertexFace({-1, y, 0}, {1, y, 0}, y <= 4, 0.5));
    known.push_back(vertexFace({-2, y, 0}, {-1, y, 0}, false, 0));
    // Edges that slide along in one plane
    known.push_back(edgeEdge({y / 8, 1, 0}, {y / 8, 2, 0}, {0, -2, 0}, true, 0.5));
    known.push_back(edgeEdge({2 + y, 1, 0}, {2 + y, 2, 0}, {0, -2, 0}, false, 0));
    // On one line
    known.push_back(edgeEdge({2, 0, 0}, {3, 0, 0}, {-2, 0, 0}, true, 0.5));
  }
  return known;
}

/// The face's third corner moves so that the point just touches the plane and turns back.
std::vector<Known> doubleRoots() {
  std::vector<Known> known;
  for (int i = 1; i < 8; ++i) {
    // The edge is lowered and turned about its own crossing point: volume z(t) times a factor that is 0 there, too.
    const double x = i * 0.125 - 0.5;
    Known one = edgeEdge({x, -1, 1}, {x, 1, 1}, {0, 0, -2}, true, 0.5);
    one.query.start[0][0] = x - 1;
    one.query.end[0][0] = x + 1;
    one.query.start[1][0] = x + 1;
    one.query.end[1][0] = x - 1;
    known.push_back(one);
    // Parallel edges that come to lie on each other at the moment when they turn through parallel.
    Known parallel = edgeEdge({-1, 0, 1}, {1, 0, 1}, {0, 0, -2}, true, 0.5);
    parallel.query.start[0][1] = -x;
    parallel.query.end[0][1] = x;
    parallel.query.start[1][1] = x;
    parallel.query.end[1][1] = -x;
    known.push_back(parallel);
  }
  return known;
}

std::vector<Known> rootsAtTheEnds() {
  std::vector<Known> known;
  for (int i = 1; i < 8; ++i) {
    const double x = i * 0.25;
    known.push_back(vertexFace({x, x, 0}, {x, x, 1}, true, 0));
    known.push_back(vertexFace({x, x, 1}, {x, x, 0}, true, 1));
    known.push_back(vertexFace({x, x, 0}, {x, x, 0}, true, 0));
    known.push_back(vertexFace({0, x, 1}, {0, x, 0}, true, 1));
    known.push_back(vertexFace({0, 0, 1}, {0, 0, 0}, true, 1));
    known.push_back(edgeEdge({0.5, -1, 0}, {0.5, 1, 0}, {0, 0, 1}, true, 0));
    known.push_back(edgeEdge({0.5, -1, 1}, {0.5, 1, 1}, {0, 0, -1}, true, 1));
    known.push_back(edgeEdge({1, 0, 1}, {1, 1, 1}, {0, 0, -1}, true, 1));
  }
  return known;
}

std::vector<Known> all() {
  std::vector<Known> known = plain();
  for (auto* const some : {coplanar, doubleRoots, rootsAtTheEnds}) {
    for (const Known& one : some()) known.push_back(one);
  }
  return known;
}

std::vector<Known> scaled(double factor, double offset) {
  std::vector<Known> known;
  for (const Known& one : all()) known.push_back(moved(one, factor, offset));
  return known;
}

template <class Scalar>
Query<Scalar> rounded(const Query<double>& query) {
  Query<Scalar> result;
  for (int k = 0; k < 4; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      result.start[k][axis] = static_cast<Scalar>(query.start[k][axis]);
      result.end[k][axis] = static_cast<Scalar>(query.end[k][axis]);
    }
  }
  return result;
}

/// No contact may be missed; its time may not be later than the true one, nor earlier than the tolerance lets it be,
/// where it is the exact tier that answers; and that tier gives no false alarms.
void check(const ContinuousCheck& answer, const Known& known, CaseMeter& meter) {
  const Contact contact = answer(known.pair, rounded<btScalar>(known.query));
  const bool isFinite =
      std::isfinite(contact.time) && std::isfinite(contact.where[0]) && std::isfinite(contact.where[1]);
  meter.compare("finite", isFinite ? 0 : 1, 0);
  if (known.meets) {
    meter.compare("missed contacts", contact.found ? 0 : 1, 0);
    if (contact.found) meter.compare("late", std::max(0.0, contact.time - known.time), 0);
  } else if (answer.tier() == Tier::exact) {
    meter.compare("false alarms", contact.found ? 1 : 0, 0);
  }
  if (known.meets && contact.found && answer.tier() == Tier::exact) {
    meter.compare("early", std::max(0.0, known.time - contact.time), answer.settings().tolerance);
  }
}

void checkTextbook(const Known& known, CaseMeter& meter) {
  const Contact contact = command::comparison::textbookCheck(known.pair, rounded<btScalar>(known.query), btScalar(0));
  if (known.meets) meter.compare("missed contacts", contact.found ? 0 : 1, 0);
  if (!known.meets) meter.compare("false alarms", contact.found ? 1 : 0, 0);
}

HardCase cubic(std::string name, std::string about, std::function<std::vector<Known>()> make) {
  HardCase hardCase;
  hardCase.name = std::move(name);
  hardCase.group = "cubics";
  hardCase.about = std::move(about);
  hardCase.worlds = {World::none};
  hardCase.naiveMethod = "the textbook's cubic";
  hardCase.compute = [make = std::move(make)](Way way, CaseMeter& meter) {
    std::vector<ContinuousCheck> checks{ContinuousCheck(Tier::fast), ContinuousCheck(Tier::conservative)};
    if (ContinuousCheck::hasExact()) checks.emplace_back(Tier::exact);
    for (const Known& known : make()) {
      if (way == Way::naive) checkTextbook(known, meter);
      if (way != Way::ours) continue;
      for (const ContinuousCheck& answer : checks) check(answer, known, meter);
    }
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> cubicCases() {
  return {
      cubic("cubic_coplanar", "all four points in one plane all along: the cubic is 0", coplanar),
      cubic("cubic_double_roots", "edges that turn through parallel in the moment in which they meet", doubleRoots),
      cubic("cubic_roots_at_0_and_1", "contact at the very start or end of the motion", rootsAtTheEnds),
      // Powers of two that float32 holds with the points, which are multiples of 1/8
      cubic("cubic_tiny_coordinates", "all of these 2^-40 times as large",
            [] { return scaled(std::ldexp(1, -40), 0); }),
      cubic("cubic_huge_coordinates", "all of these 2^40 times as large", [] { return scaled(std::ldexp(1, 40), 0); }),
      cubic("cubic_far_from_the_origin", "all of these 2^16 m away", [] { return scaled(1, std::ldexp(1, 16)); })};
}

}  // namespace stability
