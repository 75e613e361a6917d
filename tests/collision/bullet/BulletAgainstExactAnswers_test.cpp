// SPDX-License-Identifier: Zlib
// Bullet 3.24's check of a node against a face, on the queries of tests/data/ccd. The exact answers are the judge, so
// nothing here says that Bullet is right: its disagreements are counted, each under the first step of its pipeline that
// goes wrong, and pinned. A newer Bullet that mends one of them fails here, and docs/ccd.md is to be updated.
//
// The counts are those of Debian's libbullet-dev 3.24 on x86-64 (SSE arithmetic, `long double` of 64 bits).

#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "command/ccd/BulletCheck.h"
#include "tests/support/QueryData.h"

#include <BulletSoftBody/poly34.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace wetcloth_test::bullet_against_exact_answers_test {
namespace {

using Wide = long double;
using WideCubic = std::array<Wide, 4>;  // power basis, constant term first

constexpr double kStepOfOne = 1;
constexpr double kBulletsDefaultStep = 1.0 / 60;

Wide valueOf(const WideCubic& f, Wide t) { return ((f[3] * t + f[2]) * t + f[1]) * t + f[0]; }

// The roots in [low, high] by bisection between the extrema; values within `error` are roots themselves, so that a
// double root is found although nothing changes sign there.
std::vector<Wide> rootsByBisection(const WideCubic& f, Wide low, Wide high, Wide error) {
  std::vector<Wide> ends{low};
  const Wide a = 3 * f[3], b = 2 * f[2], c = f[1];
  if (const Wide discriminant = b * b - 4 * a * c; discriminant >= 0) {
    // The form that subtracts no near-equal numbers.
    const Wide w = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
    std::vector<Wide> extrema;
    if (a != 0) extrema.push_back(w / a);
    if (w != 0) extrema.push_back(c / w);
    std::sort(extrema.begin(), extrema.end());
    for (const Wide t : extrema)
      if (t > low && t < high) ends.push_back(t);
  }
  ends.push_back(high);

  std::vector<Wide> roots;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (std::fabs(valueOf(f, ends[i])) <= error) roots.push_back(ends[i]);
    if (i + 1 == ends.size()) break;
    Wide from = ends[i], to = ends[i + 1];
    const Wide first = valueOf(f, from), last = valueOf(f, to);
    if (std::fabs(first) <= error || std::fabs(last) <= error || (first < 0) == (last < 0)) continue;
    for (int k = 0; k < 80; ++k) {  // more than a long double's 64 bits
      const Wide middle = (from + to) / 2;
      ((valueOf(f, middle) < 0) == (first < 0) ? from : to) = middle;
    }
    roots.push_back((from + to) / 2);
  }
  return roots;
}

struct WideVector {
  Wide x, y, z;
};
WideVector wide(const btVector3& v) { return {Wide(v.x()), Wide(v.y()), Wide(v.z())}; }
WideVector operator-(const WideVector& a, const WideVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
WideVector operator+(const WideVector& a, const WideVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
WideVector operator*(Wide s, const WideVector& a) { return {s * a.x, s * a.y, s * a.z}; }
Wide dot(const WideVector& a, const WideVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
WideVector cross(const WideVector& a, const WideVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Wide length(const WideVector& a) { return std::sqrt(dot(a, a)); }

// When the node is in the face's plane, for what Bullet holds (so after rounding to btScalar); time in steps.
struct CoplanarTimes {
  WideCubic cubic;
  Wide error;  // of a coefficient
  std::vector<Wide> roots;
  bool always;

  explicit CoplanarTimes(const command::BulletQuery& query) {
    const btSoftBody::Face& face = query.face();
    const auto place = [&](const btSoftBody::Node& n) { return wide(n.m_x) - wide(face.m_n[0]->m_x); };
    const auto motion = [&](const btSoftBody::Node& n) {
      return Wide(query.step()) * (wide(n.m_v) - wide(face.m_n[0]->m_v));
    };
    const WideVector b = place(*face.m_n[1]), c = place(*face.m_n[2]), p = place(query.node());
    const WideVector db = motion(*face.m_n[1]), dc = motion(*face.m_n[2]), dp = motion(query.node());
    const WideVector normal0 = cross(b, c), normal1 = cross(b, dc) + cross(db, c), normal2 = cross(db, dc);
    cubic = {dot(normal0, p), dot(normal0, dp) + dot(normal1, p), dot(normal1, dp) + dot(normal2, p), dot(normal2, dp)};
    // A coefficient is a sum of fewer than 64 products, each of them rounded a few times.
    error = 64 * LDBL_EPSILON * (length(b) + length(db)) * (length(c) + length(dc)) * (length(p) + length(dp));
    always = std::all_of(cubic.begin(), cubic.end(), [&](Wide k) { return std::fabs(k) <= error; });
    if (always) {
      roots = {0, 1};  // the two times that Bullet looks at
    } else {
      roots = rootsByBisection(cubic, 0, 1, error);
    }
  }
};

// Bullet's own inside test at a time of ours, in steps.
bool bulletTouchesAt(const command::BulletQuery& query, Wide time) {
  const btScalar t = btScalar(time * query.step());
  const btSoftBody::Face& face = query.face();
  const auto at = [&](const btSoftBody::Node& n) { return n.m_x + t * n.m_v; };
  const btVector3 a = at(*face.m_n[0]), b = at(*face.m_n[1]), c = at(*face.m_n[2]);
  btVector3 normal = (b - a).cross(c - a);
  normal.safeNormalize();
  btVector3 weights;
  return proximityTest(a, b, c, at(query.node()), normal, btScalar(command::BulletQuery::kMargin), weights);
}

// Bullet's pipeline without its separating planes, from the mathematics and from Bullet's own solvers: the next thing
// to blame. That it is the same pipeline is tested, on every query that Bullet does not separate.
struct BulletWithoutSeparatingPlanes {
  std::array<btScalar, 4> cubic;  // constant term first
  int degree;                     // that Bullet takes it for; -1 where it takes it for zero
  bool found = false;

  explicit BulletWithoutSeparatingPlanes(const command::BulletQuery& query) {
    const btSoftBody::Face& face = query.face();
    const btSoftBody::Node &a = *face.m_n[0], &b = *face.m_n[1], &c = *face.m_n[2], &p = query.node();
    const btVector3 edge1 = b.m_x - a.m_x, edge2 = c.m_x - a.m_x, offset = p.m_x - a.m_x;
    const btVector3 rate1 = b.m_v - a.m_v, rate2 = c.m_v - a.m_v, speed = p.m_v - a.m_v;
    const btVector3 normal0 = edge1.cross(edge2), normal2 = rate1.cross(rate2);
    const btVector3 normal1 = edge1.cross(rate2) + rate1.cross(edge2);
    cubic = {normal0.dot(offset), normal0.dot(speed) + normal1.dot(offset), normal2.dot(offset) + normal1.dot(speed),
             normal2.dot(speed)};
    degree = 3;
    while (degree >= 0 && std::abs(cubic[std::size_t(degree)]) < btScalar(SAFE_EPSILON)) --degree;

    btScalar roots[3] = {0, 0, 0};
    int count = 0;
    switch (degree) {
      case 3: count = SolveP3(roots, cubic[2] / cubic[3], cubic[1] / cubic[3], cubic[0] / cubic[3]); break;
      case 2: count = SolveP2(roots, cubic[1] / cubic[2], cubic[0] / cubic[2]); break;
      case 1:
        count = 1;
        roots[0] = -cubic[0] / cubic[1];
        break;
      case 0: break;
      default: count = 2; roots[1] = query.step();
    }
    // A vector, because of an array of three GCC says that sorting reads past it.
    std::vector<btScalar> sorted(roots, roots + count);
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < count && !found; ++i) {
      if (sorted[std::size_t(i)] <= 0) continue;
      if (sorted[std::size_t(i)] > query.step() + SIMD_EPSILON) break;
      found = bulletTouchesAt(query, Wide(sorted[std::size_t(i)]) / query.step());
    }
  }

  // What SolveP3 replaces by a tiny positive number.
  bool hasNegativeQ() const {
    const btScalar a = cubic[2] / cubic[3], b = cubic[1] / cubic[3];
    return degree == 3 && a * a < 3 * b;
  }
};

struct Disagreements {
  int contacts = 0;
  int missed = 0;
  // Of the missed, by the first step that goes wrong:
  int separated = 0;   // hasSeparatingPlane says so
  int thresholds = 0;  // a coefficient that is not zero is taken for zero
  int negativeQ = 0;   // SolveP3 replaces a negative q
  int lostDigits = 0;  // SolveP3's root is so inexact that the node is off the plane there
  int unexplained = 0;
  // Of the separated, those that the rest of the pipeline would not have found either:
  int lostAnyway = 0;
  int falseAlarms = 0;
  // Of the false alarms:
  int grazing = 0;  // at a true time of coplanarity, within Bullet's margin of 1e-6
};

bool operator==(const Disagreements& a, const Disagreements& b) {
  return a.contacts == b.contacts && a.missed == b.missed && a.separated == b.separated &&
         a.thresholds == b.thresholds && a.negativeQ == b.negativeQ && a.lostDigits == b.lostDigits &&
         a.unexplained == b.unexplained && a.lostAnyway == b.lostAnyway && a.falseAlarms == b.falseAlarms &&
         a.grazing == b.grazing;
}

std::ostream& operator<<(std::ostream& out, const Disagreements& d) {
  return out << "contacts " << d.contacts << ", missed " << d.missed << " (separated " << d.separated << ", thresholds "
             << d.thresholds << ", negative q " << d.negativeQ << ", lost digits " << d.lostDigits << ", unexplained "
             << d.unexplained << "; of the separated lost anyway " << d.lostAnyway << "), false alarms "
             << d.falseAlarms << " (grazing " << d.grazing << ")";
}

std::vector<KnownQuery> queriesThatBulletKnows(const std::string& collection) {
  std::vector<KnownQuery> queries = knownQueries(collection);
  queries.erase(std::remove_if(queries.begin(), queries.end(),
                               [](const auto& q) { return q.pair != wetcloth::collision::Pair::vertexFace; }),
                queries.end());
  return queries;
}

void blameForMiss(const command::BulletQuery& query, Disagreements& counts) {
  const BulletWithoutSeparatingPlanes rest(query);
  if (hasSeparatingPlane(&query.face(), &query.node(), query.step())) {
    ++counts.separated;
    if (!rest.found) ++counts.lostAnyway;
    return;
  }
  const CoplanarTimes reference(query);
  const bool dropped = [&] {
    for (int k = std::max(rest.degree + 1, 0); k < 4; ++k)
      if (std::fabs(reference.cubic[std::size_t(k)]) > reference.error) return true;
    return false;
  }();
  // With the right roots all of them would be found: nothing is to blame on the inside test.
  const bool mended =
      std::any_of(reference.roots.begin(), reference.roots.end(), [&](Wide t) { return bulletTouchesAt(query, t); });
  ++(!mended               ? counts.unexplained
     : dropped             ? counts.thresholds
     : rest.hasNegativeQ() ? counts.negativeQ
     : rest.degree == 3    ? counts.lostDigits
                           : counts.unexplained);
}

Disagreements disagreementsOf(const std::string& collection, double step) {
  Disagreements counts;
  for (const KnownQuery& known : queriesThatBulletKnows(collection)) {
    const command::BulletQuery query(known.points, step);
    const bool found = query.check();
    // What Bullet's world puts before it changes no answer.
    EXPECT_EQ(query.checkAsItsWorldDoes(), found)
        << known.id << ": Bullet's bernsteinVFTest changed: update docs/ccd.md";
    counts.contacts += known.meets;
    if (known.meets && !found) {
      ++counts.missed;
      blameForMiss(query, counts);
    } else if (!known.meets && found) {
      ++counts.falseAlarms;
      const CoplanarTimes reference(query);
      counts.grazing += std::any_of(reference.roots.begin(), reference.roots.end(),
                                    [&](Wide t) { return bulletTouchesAt(query, t); });
    }
  }
  return counts;
}

Disagreements pinnedDisagreements(int contacts, std::array<int, 5> missedByCause, int lostAnyway, int falseAlarms,
                                  int grazing) {
  Disagreements counts;
  counts.contacts = contacts;
  counts.separated = missedByCause[0];
  counts.thresholds = missedByCause[1];
  counts.negativeQ = missedByCause[2];
  counts.lostDigits = missedByCause[3];
  counts.unexplained = missedByCause[4];
  for (const int count : missedByCause) counts.missed += count;
  counts.lostAnyway = lostAnyway;
  counts.falseAlarms = falseAlarms;
  counts.grazing = grazing;
  return counts;
}

void expectDisagreements(const std::string& collection, double step, const Disagreements& expected) {
  EXPECT_EQ(disagreementsOf(collection, step), expected)
      << "the collection " << collection << ", step " << step << ". Fewer under one cause: Bullet mended that cause "
      << "(separated: hasSeparatingPlane, thresholds: SAFE_EPSILON in continuousCollisionDetection and SIMD_EPSILON in "
      << "proximityTest, negative q and lost digits: SolveP3); update docs/ccd.md";
}

#ifdef BT_USE_DOUBLE_PRECISION
constexpr bool kBulletIsFloat64 = true;
#else
constexpr bool kBulletIsFloat64 = false;
#endif

// On ARM a compiler that is not told otherwise multiplies and adds Bullet's numbers in one operation, and one query of
// those that lose their digits or just keep them changes sides: 27 with GCC 12.
#ifdef __aarch64__
constexpr bool kMayFuse = true;
#else
constexpr bool kMayFuse = false;
#endif

// Hand-made and rigid scenes: nodes at rest and axis-parallel motion abound, and hasSeparatingPlane answers "separated"
// for all of them. It alone is to blame for every miss but those few that are coplanar all along, or that SolveP3
// loses. The false alarms graze the border of the face: exactly a miss, and within the margin of 1e-6.
TEST(BulletAgainstExactAnswers, RealQueries) {
  if (kBulletIsFloat64) {
    expectDisagreements("real", kStepOfOne, pinnedDisagreements(125, {55, 0, 0, 0, 0}, 1, 21, 21));
    expectDisagreements("real", kBulletsDefaultStep, pinnedDisagreements(125, {55, 0, 0, 0, 0}, 4, 21, 21));
  } else {
    expectDisagreements("real", kStepOfOne, pinnedDisagreements(125, {92, 0, 0, 0, 0}, 2, 41, 40));
    expectDisagreements("real", kBulletsDefaultStep, pinnedDisagreements(125, {92, 0, 0, 0, 0}, 9, 41, 40));
  }
}

// A cloth moves in no special direction, so nothing is separated wrongly; what is left is the root finder, in float64
// by its negative q alone. In float32 the 2 cm edges of this cloth give coefficients below the thresholds: with a step
// of 1 nothing is found at all. Seconds make velocities, and so the coefficients, larger; the digits that SolveP3 then
// loses are those of a nearly linear motion, whose cubic has a huge second coefficient once it is made monic.
TEST(BulletAgainstExactAnswers, ClothQueries) {
  if (kBulletIsFloat64) {
    expectDisagreements("cloth", kStepOfOne, pinnedDisagreements(157, {0, 0, 27, 0, 0}, 0, 0, 0));
    expectDisagreements("cloth", kBulletsDefaultStep, pinnedDisagreements(157, {0, 0, 27, 0, 0}, 0, 0, 0));
  } else {
    expectDisagreements("cloth", kStepOfOne, pinnedDisagreements(157, {0, 157, 0, 0, 0}, 0, 0, 0));
    const int lostDigits = disagreementsOf("cloth", kBulletsDefaultStep).lostDigits;
    EXPECT_NEAR(lostDigits, 26, kMayFuse ? 2 : 0);
    expectDisagreements("cloth", kBulletsDefaultStep, pinnedDisagreements(157, {0, 0, 24, lostDigits, 0}, 0, 0, 0));
  }
}

// What the blame above rests on.
TEST(BulletAgainstExactAnswers, OurCopyOfBulletsPipelineAnswersAsBulletDoes) {
  for (const std::string collection : {"real", "cloth"}) {
    for (const double step : {kStepOfOne, kBulletsDefaultStep}) {
      for (const KnownQuery& known : queriesThatBulletKnows(collection)) {
        const command::BulletQuery query(known.points, step);
        if (hasSeparatingPlane(&query.face(), &query.node(), query.step())) {
          EXPECT_FALSE(query.check()) << known.id;
        } else {
          EXPECT_EQ(BulletWithoutSeparatingPlanes(query).found, query.check())
              << known.id << ": Bullet's continuousCollisionDetection changed: update docs/ccd.md";
        }
      }
    }
  }
}

// Bullet's Bernstein coefficients are those of the same cubic, times 3: with its units of length^3 they are compared
// with an absolute SAFE_EPSILON, which only ever lets more through.
TEST(BulletAgainstExactAnswers, ItsBernsteinCullingLosesNoContact) {
  // A coefficient is a sum of 24 products that each are rounded thrice.
  constexpr Wide kRoundings = 72;
  for (const std::string collection : {"real", "cloth"}) {
    for (const KnownQuery& known : queriesThatBulletKnows(collection)) {
      const command::BulletQuery query(known.points);
      if (known.meets) {
        EXPECT_TRUE(bernsteinVFTest(&query.face(), &query.node(), query.step(), SAFE_EPSILON)) << known.id;
      }
      btScalar k[4];
      getBernsteinCoeff(&query.face(), &query.node(), query.step(), k[0], k[1], k[2], k[3]);
      const CoplanarTimes reference(query);
      const WideCubic& a = reference.cubic;
      const Wide expected[4] = {3 * a[0], 3 * a[0] + a[1], 3 * a[0] + 2 * a[1] + a[2], 3 * (a[0] + a[1] + a[2] + a[3])};
      const Wide coordinates = [&] {
        Wide most = 0;
        for (const auto* points : {&known.points.start, &known.points.end}) {
          for (const auto& point : *points) {
            for (const double coordinate : point) most = std::max(most, std::fabs(Wide(coordinate)));
          }
        }
        return most;
      }();
      // m_q is rounded to the digits of the place, not of the motion.
      const Wide scale = reference.error / (64 * LDBL_EPSILON);
      const Wide size = std::cbrt(scale);
      const Wide tolerance = kRoundings * SIMD_EPSILON * (scale + coordinates * size * size);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(double(k[i]), double(expected[i]), double(tolerance)) << known.id;
    }
  }
}

// Rounding to float makes other queries of some: there Bullet is not to blame, whatever it answers. In float64, and for
// all cloth queries, no answer changes.
TEST(BulletAgainstExactAnswers, RoundingChangesSomeAnswersInFloat32) {
  if (!wetcloth::collision::ContinuousCheck::hasExact()) GTEST_SKIP() << "this build has no exact tier";
  const wetcloth::collision::ContinuousCheck exact(wetcloth::collision::Tier::exact);
  for (const std::string collection : {"real", "cloth"}) {
    int lost = 0, lostAndMissed = 0, gained = 0, gainedAndFound = 0;
    for (const KnownQuery& known : queriesThatBulletKnows(collection)) {
      const command::BulletQuery bullet(known.points);
      const btSoftBody::Node* nodes[4] = {&bullet.node(), bullet.face().m_n[0], bullet.face().m_n[1],
                                          bullet.face().m_n[2]};
      wetcloth::collision::Query<double> rounded;
      for (int i = 0; i < 4; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          rounded.start[i][axis] = double(nodes[i]->m_x[axis]);
          // Where a place and a motion differ much in size, their sum is rounded once more, to double. That turns one
          // answer: without it, by rational arithmetic, 7 contacts are lost and 8 gained.
          rounded.end[i][axis] = double(nodes[i]->m_x[axis]) + double(nodes[i]->m_v[axis]);
        }
      }
      const bool meets = exact(wetcloth::collision::Pair::vertexFace, rounded).found;
      lost += known.meets && !meets;
      lostAndMissed += known.meets && !meets && !bullet.check();
      gained += !known.meets && meets;
      gainedAndFound += !known.meets && meets && bullet.check();
    }
    const bool changes = !kBulletIsFloat64 && collection == "real";
    EXPECT_EQ(lost, changes ? 6 : 0) << collection;
    EXPECT_EQ(lostAndMissed, changes ? 2 : 0) << collection;
    EXPECT_EQ(gained, changes ? 9 : 0) << collection;
    EXPECT_EQ(gainedAndFound, changes ? 5 : 0) << collection;
  }
}

// The inside test that bernsteinVFTest returns before: turned on, it would lose contacts.
TEST(BulletAgainstExactAnswers, ItsUnreachableInsideTestWouldLoseContacts) {
  const auto lostContacts = [](const std::string& collection) {
    int lost = 0;
    for (const KnownQuery& known : queriesThatBulletKnows(collection)) {
      if (!known.meets) continue;
      const command::BulletQuery query(known.points);
      btScalar k0 = 0, k1 = 0, k2 = 0, k3 = 0;
      getBernsteinCoeff(&query.face(), &query.node(), query.step(), k0, k1, k2, k3);
      lost += !coplanarAndInsideTest(k0, k1, k2, k3, &query.face(), &query.node(), query.step());
    }
    return lost;
  };
  EXPECT_EQ(lostContacts("real"), kBulletIsFloat64 ? 22 : 48)
      << "Bullet's coplanarAndInsideTest changed: update docs/ccd.md";
  EXPECT_EQ(lostContacts("cloth"), kBulletIsFloat64 ? 0 : 157)
      << "Bullet's coplanarAndInsideTest changed: update docs/ccd.md";
}

// x^3 + a x^2 + b x + c with a, b, c uniform in [-1, 1]: a^2 < 3 b for 4/9 of them.
TEST(BulletAgainstExactAnswers, SolveP3GivesAWrongRootToFourOfNineRandomCubics) {
  constexpr int kCubics = 20000;
  // Near a double root, rounding moves roots by the square root of FLT_EPSILON, 3.5e-4.
  constexpr Wide kWrong = 1e-3L;
  std::mt19937 random(1);  // its numbers are the same everywhere, unlike those of the distributions
  const auto coefficient = [&random] { return btScalar(double(random()) / 2147483648.0 - 1); };
  int negativeQ = 0, wrong = 0, wrongOtherwise = 0;
  for (int i = 0; i < kCubics; ++i) {
    const btScalar a = coefficient(), b = coefficient(), c = coefficient();
    btScalar x[3];
    const int count = SolveP3(x, a, b, c);
    // No root is farther from 0 than 1 plus the largest coefficient.
    bool allFound = true;
    for (const Wide root : rootsByBisection({Wide(c), Wide(b), Wide(a), 1}, -2, 2, 0))
      allFound = allFound && std::any_of(x, x + count, [&](btScalar y) { return std::fabs(y - root) <= kWrong; });
    const bool negative = Wide(a) * a < 3 * Wide(b);
    negativeQ += negative;
    (negative ? wrong : wrongOtherwise) += !allFound;
  }
  EXPECT_EQ(negativeQ, 8944);
  // The others have so large an |r| that q hardly matters.
  EXPECT_EQ(wrong, kBulletIsFloat64 ? 8916 : 8908) << "Bullet's SolveP3 changed: update docs/ccd.md";
  EXPECT_EQ(wrongOtherwise, 0) << "Bullet's SolveP3 changed: update docs/ccd.md";
}

}  // namespace
}  // namespace wetcloth_test::bullet_against_exact_answers_test
