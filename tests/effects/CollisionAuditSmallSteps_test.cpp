// SPDX-License-Identifier: Zlib
// Of cloths that ClothSolver steps the audit looks at each small step: what passes through and comes back within one
// substep is seen, and what only the chord of the substep would pass through is not.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/SolverScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::collision_audit_small_steps_test {
namespace {

using wetcloth::AuditTotals;
using wetcloth::ClothSolver;
using wetcloth::CollisionAudit;
using wetcloth::Passage;
using wetcloth::collision::Pair;

btVector3 at(double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); }

const int kSmallSteps = 100;
const double kHeight = 0.02;  // [m]
const double kPi = 3.14159265358979;

// A large triangle that is pinned, if it is wanted, and a small one above it, whose corners hang from springs that
// swing through half a period in 1/60 s.
BodyBuilder sprung(bool hasLarge, bool hasSmall) {
  return [=](btSoftBodyWorldInfo& info) {
    std::vector<btVector3> places;
    std::vector<btScalar> masses;
    const auto add = [&](std::initializer_list<btVector3> corners, double mass) {
      places.insert(places.end(), corners);
      masses.insert(masses.end(), corners.size(), btScalar(mass));
    };
    if (hasLarge) add({at(-1, 0, -1), at(1, 0, -1), at(0, 0, 1)}, 0);
    if (hasSmall) add({at(-0.05, kHeight, 0), at(0.05, kHeight, 0), at(0, kHeight, 0.0625)}, 0.01);
    if (hasSmall) add({at(-0.05, 1, 0), at(0.05, 1, 0), at(0, 1, 0.0625)}, 0);
    auto body = std::make_unique<btSoftBody>(&info, static_cast<int>(places.size()), places.data(), masses.data());
    for (int first = 0; first + 3 <= static_cast<int>(places.size()); first += hasLarge ? 3 : 6) {
      const bool isSmall = !hasLarge || first == 3;
      if (first < 6) body->appendFace(first, first + 1, first + 2);
      for (int k = 0; isSmall && k < 3; ++k) body->appendLink(first + k, first + 3 + k, body->m_materials[0]);
    }
    return body;
  };
}

ClothSolver::Parameters soft() {
  ClothSolver::Parameters parameters = smallSteps(kSmallSteps, 0.01 * (60 * kPi) * (60 * kPi));
  return parameters;
}

/// Cloths on ClothSolver, in a world of wet cloths, the first with an audit.
class Audited {
 public:
  Audited(std::initializer_list<BodyBuilder> builders, const ClothSolver::Parameters& parameters)
      : scene(WorldKind::softRigid, kNoGravity, parameters) {
    for (const BodyBuilder& builder : builders) bodies.push_back(&scene.add(builder));
    wet = std::make_unique<wetcloth::WetClothWorld>(scene.bullet().world());
    wet->setLog({});
    for (btSoftBody* const body : bodies) wet->add(*body);
    CollisionAudit::Parameters audited;
    audited.onPassage = [this](const Passage& passage) { events.push_back(passage); };
    audit = &wet->cloths().begin()->add<CollisionAudit>(audited);
    scene.step(1);  // the solver takes the bodies; from the next step on they are looked at
  }
  static void push(btSoftBody& body, double velocity) {
    for (int i = 0; i < body.m_nodes.size(); ++i) {
      if (body.m_nodes[i].m_im > 0) body.m_nodes[i].m_v = at(0, velocity, 0);
    }
  }
  std::string state() const {
    std::ostringstream stream;
    wet->save(stream);
    return stream.str();
  }

  SolverScene scene;
  std::vector<btSoftBody*> bodies;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
  CollisionAudit* audit = nullptr;
  std::vector<Passage> events;
};

// After half a period the corners are where they were.
void expectThereAndBack(Audited& audited, btSoftBody& swinging, int corner) {
  Audited::push(swinging, -10);
  audited.scene.step(1);
  ASSERT_NEAR(double(swinging.m_nodes[corner].m_x.y()), kHeight, 0.005);
  audited.audit->look();
  const AuditTotals totals = audited.audit->totals();
  EXPECT_EQ(totals.vertexFace, 6);
  EXPECT_EQ(totals.edgeEdge, 0);
  EXPECT_EQ(totals.substeps, 1);
  ASSERT_EQ(audited.events.size(), 6U);
  // kHeight = 10 m/s / omega sin(omega t), but for the error of small steps.
  const double through = std::asin(kHeight * 60 * kPi / 10) / (60 * kPi);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(audited.events[k].time - 1.0 / 60, k < 3 ? through : 1.0 / 60 - through, 3e-4);
    EXPECT_NEAR(double(audited.events[k].position.y()), 0, 1e-6);
  }
}

TEST(CollisionAuditSmallSteps, ThereAndBackInOneSubstepIsSeen) {
  Audited audited({sprung(true, true)}, soft());
  expectThereAndBack(audited, *audited.bodies[0], 3);
}

TEST(CollisionAuditSmallSteps, ThereAndBackThroughAnotherClothIsSeen) {
  Audited audited({sprung(true, false), sprung(false, true)}, soft());
  expectThereAndBack(audited, *audited.bodies[1], 0);
}

TEST(CollisionAuditSmallSteps, ABodyThatBulletStepsIsMetAtTheEndOfTheSubstep) {
  Audited audited({sprung(true, false), sprung(false, true)}, soft());
  audited.bodies[0]->m_cfg.kDG = btScalar(0.1);  // not taken
  audited.scene.step(1);
  audited.audit->reset();
  Audited::push(*audited.bodies[1], -10);
  audited.scene.step(1);
  audited.audit->look();
  EXPECT_EQ(audited.audit->totals().substeps, 1);
  EXPECT_EQ(audited.audit->totals().passages(), 0);
  audited.bodies[1]->m_nodes[0].m_x.setY(btScalar(-0.01));
  audited.audit->look();
  EXPECT_GT(audited.audit->totals().passages(), 0);
}

/// Counts from the small-step callback what passes in a body: every vertex against every face.
class EveryVertexAndFace {
 public:
  explicit EveryVertexAndFace(ClothSolver& solver, const btSoftBody& body) {
    keep([&](int node) { return body.m_nodes[node].m_x; }, body, m_before);
    solver.setSmallStepCallback([this](const ClothSolver::SmallStepView& view) {
      keep([&](int node) { return view.position(node); }, view.body, m_now);
      countIn(view.body);
      m_before = m_now;
    });
  }
  long long count() const { return m_count; }

 private:
  template <class PlaceOf>
  static void keep(const PlaceOf& placeOf, const btSoftBody& body, std::vector<btVector3>& places) {
    places.clear();
    for (int node = 0; node < body.m_nodes.size(); ++node) places.push_back(placeOf(node));
  }
  static double volume(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& d) {
    return double((b - a).cross(c - a).dot(d - a));
  }
  void countIn(const btSoftBody& body) {
    for (int f = 0; f < body.m_faces.size(); ++f) {
      int nodes[4];
      for (int k = 0; k < 3; ++k) nodes[k + 1] = int(body.m_faces[f].m_n[k] - &body.m_nodes[0]);
      for (nodes[0] = 0; nodes[0] < body.m_nodes.size(); ++nodes[0]) {
        if (nodes[0] != nodes[1] && nodes[0] != nodes[2] && nodes[0] != nodes[3]) m_count += passes(nodes) ? 1 : 0;
      }
    }
  }
  bool passes(const int (&nodes)[4]) const {
    const auto side = [&](const std::vector<btVector3>& x) {
      return volume(x[std::size_t(nodes[1])], x[std::size_t(nodes[2])], x[std::size_t(nodes[3])],
                    x[std::size_t(nodes[0])]) > 0;
    };
    if (side(m_before) == side(m_now)) return false;
    wetcloth::collision::Query<double> query;
    for (int k = 0; k < 4; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        query.start[k][axis] = double(m_before[std::size_t(nodes[k])][axis]);
        query.end[k][axis] = double(m_now[std::size_t(nodes[k])][axis]);
      }
    }
    return m_check(Pair::vertexFace, query).found;
  }

  wetcloth::collision::ContinuousCheck m_check;
  std::vector<btVector3> m_before, m_now;
  long long m_count = 0;
};

BodyBuilder patchAt(double height) {
  return [=](btSoftBodyWorldInfo& info) {
    wetcloth::ClothPatch patch = levelPatch(9, 1);
    patch.origin.setY(btScalar(height));
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
    return patch.build(info);
  };
}

// So that it passes through itself.
void crumple(btSoftBody& body) {
  std::mt19937 random(7);
  const auto velocity = [&] { return 80.0 * double(random()) / double(std::mt19937::max()) - 40; };
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double x = velocity();
    const double y = velocity();
    const double z = velocity();
    if (body.m_nodes[i].m_im > 0) body.m_nodes[i].m_v = at(x, y, z);
  }
}

TEST(CollisionAuditSmallSteps, CountsWhatTheSmallStepsTell) {
  Audited audited({sprung(true, true)}, soft());
  Audited::push(*audited.bodies[0], -10);
  EveryVertexAndFace every(audited.scene.solver(), *audited.bodies[0]);
  audited.scene.step(30);
  audited.audit->look();
  EXPECT_GT(every.count(), 20);
  EXPECT_EQ(audited.audit->totals().vertexFace, every.count());
}

TEST(CollisionAuditSmallSteps, GuardedNothingPasses) {
  ClothSolver::Parameters parameters = smallSteps(10);
  parameters.guard.emplace();
  Audited audited({patchAt(0), patchAt(0.05)}, parameters);
  for (btSoftBody* const body : audited.bodies) crumple(*body);
  audited.scene.step(60);
  audited.audit->look();
  EXPECT_EQ(audited.audit->totals().passages(), 0);
  EXPECT_EQ(audited.audit->totals().incompleteSubsteps, 0);
}

// A cloth that an application carries after another one, which is as fast and 3 cm ahead. It is put 10 cm ahead between
// two steps, beyond the other one, and goes there in the small steps of the next.
TEST(CollisionAuditSmallSteps, PinsThatAreMovedBetweenStepsPassOnlyOnTheirWay) {
  const auto square = [](double height, int nodes, double side, const std::vector<wetcloth::ClothPatch::Edge>& pinned) {
    return [=](btSoftBodyWorldInfo& info) {
      wetcloth::ClothPatch patch = levelPatch(nodes, side);
      patch.origin.setY(btScalar(height));
      patch.pinnedEdges = pinned;
      return patch.build(info);
    };
  };
  using Edge = wetcloth::ClothPatch::Edge;
  ClothSolver::Parameters parameters = smallSteps(10);
  parameters.guard.emplace();
  Audited audited({square(0.03, 2, 0.5, {Edge::bottom, Edge::top}), square(0, 9, 1, {})}, parameters);
  audited.scene.step(1);  // the audit has seen small steps
  Audited::push(*audited.bodies[1], -6);
  for (int step = 0; step < 5; ++step) {
    for (int i = 0; i < 4; ++i) audited.bodies[0]->m_nodes[i].m_x -= at(0, 0.1, 0);
    audited.scene.step(1);
  }
  audited.audit->look();
  EXPECT_NEAR(double(audited.bodies[1]->m_nodes[0].m_x.y()), -0.5, 1e-3);
  EXPECT_EQ(audited.audit->totals().passages(), 0);
}

// The substep that has begun is part of the state: it is looked at after it was restored.
TEST(CollisionAuditSmallSteps, ARestoredAuditGoesOnBitForBit) {
  Audited first({patchAt(0), patchAt(0.05)}, smallSteps(10));
  Audited second({patchAt(0), patchAt(0.05)}, smallSteps(10));
  for (btSoftBody* const body : first.bodies) crumple(*body);
  first.scene.step(12);
  std::istringstream saved(first.state());
  second.wet->restore(saved);
  const long long atSave = first.audit->totals().passages();
  EXPECT_GT(atSave, 0);
  first.scene.step(8);
  second.scene.step(8);
  EXPECT_EQ(first.state(), second.state());
  EXPECT_GT(first.audit->totals().passages(), atSave);
  EXPECT_EQ(first.audit->totals().passages(), second.audit->totals().passages());
}

TEST(CollisionAuditSmallSteps, ObserversAndTheSolverMayGoInAnyOrder) {
  struct Counter : ClothSolver::SmallStepObserver {
    void afterSmallStep(const ClothSolver::SmallStepView&) override { ++count; }
    int count = 0;
  };
  auto counter = std::make_shared<Counter>();
  {
    SolverScene scene;
    scene.add(levelPatch(4, 1));
    scene.solver().addObserver(counter);
    scene.solver().addObserver(counter);
    auto other = std::make_shared<Counter>();
    scene.solver().addObserver(other);
    scene.step(1);
    EXPECT_EQ(counter->count, 10);
    EXPECT_EQ(other->count, 10);
    other.reset();
    scene.step(1);
    EXPECT_EQ(counter->count, 20);
  }
  EXPECT_EQ(counter.use_count(), 1);
}

TEST(CollisionAuditSmallSteps, AnAuditMayBeRemoved) {
  Audited audited({patchAt(0)}, smallSteps(10));
  audited.scene.step(2);
  audited.wet->cloths().begin()->remove(*audited.audit);
  audited.scene.step(2);
}

}  // namespace
}  // namespace wetcloth_test::collision_audit_small_steps_test
