// SPDX-License-Identifier: Zlib
// With the guard, bodies with VF_SS are taken, and what touches is listed as Bullet lists it.
#include "tests/solver/GuardScene.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace wetcloth_test::guard_contacts_test {
namespace {

using Flags = btSoftBody::fCollision;

constexpr double kThickness = 0.004;

Guard thickGuard() {
  Guard guard;
  guard.thickness = kThickness;
  return guard;
}

btSoftBody& addSoft(GuardScene& scene, const BodyBuilder& builder, int flags = Flags::SDF_RS | Flags::VF_SS) {
  btSoftBody& body = scene.add(builder);
  body.m_cfg.collisions = flags;
  return body;
}

BodyBuilder builderOf(const wetcloth::ClothPatch& patch) {
  return [=](btSoftBodyWorldInfo& info) { return patch.build(info); };
}

// --- who is taken ---------------------------------------------------------------------------------------------------

std::string reasonWith(std::optional<Guard> guard, int flags, WorldKind kind) {
  GuardScene scene(guard, kind);
  const btSoftBody& body = addSoft(scene, builderOf(hangingPatch(4)), flags);
  scene.step(2);
  return scene.solver().reasonNotTaken(body);
}

TEST_IN_POSITION_BASED_WORLDS(GuardContacts, BodiesThatCollideAreTakenWithTheGuard) {
  Guard selfOnly;
  selfOnly.others = false;
  const int flags = Flags::SDF_RS | Flags::VF_SS;
  EXPECT_EQ(reasonWith(Guard(), flags, GetParam()), "");
  EXPECT_EQ(reasonWith(Guard(), flags | Flags::CL_SELF, GetParam()), "");
  EXPECT_NE(reasonWith(std::nullopt, flags, GetParam()).find("unless the guard is on"), std::string::npos);
  EXPECT_NE(reasonWith(selfOnly, flags, GetParam()).find("unless the guard is on for others"), std::string::npos);
  EXPECT_NE(reasonWith(Guard(), flags | Flags::CL_SS, GetParam()).find("clusters"), std::string::npos);
}

// Bullet's contacts and the guard's do not mix.
TEST_IN_POSITION_BASED_WORLDS(GuardContacts, OneThatIsLeftToBulletKeepsTheOthersThere) {
  GuardScene scene(Guard(), GetParam());
  btSoftBody& first = addSoft(scene, builderOf(levelSheet(5, 0.3, btVector3(0, 0, 0))));
  btSoftBody& other = addSoft(scene, builderOf(levelSheet(5, 0.3, btVector3(0, btScalar(0.1), 0))));
  const btSoftBody& alone = addSoft(scene, builderOf(levelSheet(5, 0.3, btVector3(2, 0, 0))), Flags::SDF_RS);
  other.m_cfg.kPR = 1;
  scene.step(1);
  EXPECT_NE(scene.solver().reasonNotTaken(first).find("one of which is left to Bullet"), std::string::npos);
  EXPECT_EQ(scene.solver().reasonNotTaken(alone), "");
  other.m_cfg.kPR = 0;
  scene.step(2);
  EXPECT_EQ(scene.solver().reasonNotTaken(first), "");
  EXPECT_EQ(scene.solver().reasonNotTaken(other), "");
}

// Bullet makes the tree of faces by which it collides in a body's first step only.
TEST_IN_POSITION_BASED_WORLDS(GuardContacts, BulletCollidesThemAgainWhenTheGuardIsTakenAway) {
  GuardScene scene(Guard(), GetParam(), kNoGravity);
  btSoftBody& lower = addSoft(scene, builderOf(levelSheet(5, 0.3, btVector3(0, 0, 0))));
  btSoftBody& upper = addSoft(scene, builderOf(levelSheet(5, 0.3, btVector3(0, btScalar(0.015), 0))));
  scene.step(3);
  EXPECT_EQ(lower.m_scontacts.size() + upper.m_scontacts.size(), 0);
  scene.solver().setParameters({});
  scene.step(2);
  EXPECT_GT(lower.m_scontacts.size(), 0);  // margins of 0.01
  EXPECT_GT(upper.m_scontacts.size(), 0);
}

// --- what is listed -------------------------------------------------------------------------------------------------

// The point of a triangle that is nearest to another one, found by trying its inside, its sides and its corners.
struct NearestPoint {
  double distance = HUGE_VAL;
  double weights[3] = {};
  double way[3] = {};  // from there to the other point

  NearestPoint(const btVector3& to, const btVector3 (&corners)[3]) {
    double p[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) p[k][axis] = double(corners[k][axis]) - double(to[axis]);
    }
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      double along = 0, squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        along -= p[k][axis] * (p[next][axis] - p[k][axis]);
        squared += (p[next][axis] - p[k][axis]) * (p[next][axis] - p[k][axis]);
      }
      double weightsOfSide[3] = {};
      weightsOfSide[next] = std::clamp(along / squared, 0.0, 1.0);
      weightsOfSide[k] = 1 - weightsOfSide[next];
      take(p, weightsOfSide);
    }
    takeInside(p);
  }

 private:
  void take(const double (&p)[3][3], const double (&by)[3]) {
    double point[3] = {};
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) point[axis] += by[k] * p[k][axis];
    }
    const double found = std::sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    if (found >= distance) return;
    distance = found;
    for (int k = 0; k < 3; ++k) {
      weights[k] = by[k];
      way[k] = -point[k];
    }
  }
  void takeInside(const double (&p)[3][3]) {
    double u[3], v[3];
    double uu = 0, uv = 0, vv = 0, pu = 0, pv = 0;
    for (int axis = 0; axis < 3; ++axis) {
      u[axis] = p[1][axis] - p[0][axis];
      v[axis] = p[2][axis] - p[0][axis];
      uu += u[axis] * u[axis];
      uv += u[axis] * v[axis];
      vv += v[axis] * v[axis];
      pu -= p[0][axis] * u[axis];
      pv -= p[0][axis] * v[axis];
    }
    const double det = uu * vv - uv * uv;
    const double s = (pu * vv - pv * uv) / det;
    const double t = (pv * uu - pu * uv) / det;
    if (s >= 0 && t >= 0 && s + t <= 1) take(p, {1 - s - t, s, t});
  }
};

NearestPoint nearestPoint(const btSoftBody::Node& node, const btSoftBody::Face& face) {
  return NearestPoint(node.m_x, {face.m_n[0]->m_x, face.m_n[1]->m_x, face.m_n[2]->m_x});
}

bool isCorner(const btSoftBody::Node& node, const btSoftBody::Face& face) {
  return std::find(face.m_n, face.m_n + 3, &node) != face.m_n + 3;
}

void expectAsFound(const btSoftBody::SContact& contact) {
  const NearestPoint found = nearestPoint(*contact.m_node, *contact.m_face);
  EXPECT_LT(found.distance, kThickness * 1.07);
  double difference = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double place = double(contact.m_node->m_x[axis]) - found.way[axis];
    for (int k = 0; k < 3; ++k) place -= double(contact.m_weights[k]) * double(contact.m_face->m_n[k]->m_x[axis]);
    difference = std::max(difference, std::fabs(place));
    EXPECT_NEAR(double(contact.m_normal[axis]), found.way[axis] / found.distance, 1e-3);
  }
  EXPECT_LT(difference, 1e-5);
  EXPECT_NEAR(double(contact.m_normal.length()), 1, 1e-5);
  EXPECT_NEAR(double(contact.m_cfm[0] + contact.m_cfm[1]), 1, 1e-5);
}

// All that touch are in the list, once; what is in it touches. Returns how many are.
int expectListed(const btSoftBody& vertexOf, const btSoftBody& faceOf) {
  int count = 0;
  for (int i = 0; i < vertexOf.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = vertexOf.m_nodes[i];
    for (int f = 0; f < faceOf.m_faces.size(); ++f) {
      const btSoftBody::Face& face = faceOf.m_faces[f];
      int listed = 0;
      for (int k = 0; k < vertexOf.m_scontacts.size(); ++k) {
        const btSoftBody::SContact& contact = vertexOf.m_scontacts[k];
        if (contact.m_node != &node || contact.m_face != &face) continue;
        ++listed;
        expectAsFound(contact);
      }
      if (isCorner(node, face)) {
        EXPECT_EQ(listed, 0);
      } else if (nearestPoint(node, face).distance < kThickness * (1 - 1e-4)) {
        EXPECT_EQ(listed, 1) << i << ' ' << f;
      }
      count += listed;
    }
  }
  return count;
}

TEST_IN_POSITION_BASED_WORLDS(GuardContacts, AreWhatASearchOfAllPairsFinds) {
  GuardScene scene(thickGuard(), GetParam());
  scene.addFloor();
  const btSoftBody& first = addSoft(scene, wavySheet(11, 0.6));
  const btSoftBody& second =
      addSoft(scene, wavySheet(12, 0.6, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))));
  int all = 0;
  for (int k = 0; k < 10; ++k) {
    scene.step(10);
    const int now = expectListed(first, second) + expectListed(second, first) + expectListed(first, first) +
                    expectListed(second, second);
    EXPECT_EQ(now, first.m_scontacts.size() + second.m_scontacts.size());
    all += now;
  }
  EXPECT_GT(all, 20);
}

// Its right half lies on its left half.
BodyBuilder foldedSheet(int n, double side, double height) {
  return [=](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body = levelSheet(n, side, btVector3(0, btScalar(height), 0)).build(info);
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      btVector3& x = body->m_nodes[k].m_x;
      if (x.x() > btScalar(0.001)) x += btVector3(-2 * x.x(), btScalar(2 * kThickness), 0);
      body->m_nodes[k].m_q = x;
    }
    return body;
  };
}

TEST_IN_POSITION_BASED_WORLDS(GuardContacts, OfABodyWithItself) {
  GuardScene scene(thickGuard(), GetParam());
  scene.addFloor();
  const btSoftBody& body = addSoft(scene, foldedSheet(11, 0.3, 0.012));
  scene.step(40);
  EXPECT_GT(expectListed(body, body), 50);
  EXPECT_EQ(expectListed(body, body), body.m_scontacts.size());
}

TEST_IN_POSITION_BASED_WORLDS(GuardContacts, AreOfBodiesThatAskForThem) {
  GuardScene scene(thickGuard(), GetParam());
  scene.addFloor();
  const btSoftBody& first = addSoft(scene, wavySheet(11, 0.6));
  const btSoftBody& second =
      addSoft(scene, wavySheet(12, 0.6, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))), Flags::SDF_RS);
  scene.step(90);
  EXPECT_EQ(second.m_scontacts.size(), 0);
  EXPECT_EQ(expectListed(first, first), first.m_scontacts.size());
}

TEST_IN_POSITION_BASED_WORLDS(GuardContacts, OfALayerThatLiesOnOneThatSleeps) {
  GuardScene scene(thickGuard(), GetParam());
  btSoftBody& lower = addSoft(scene, builderOf(levelSheet(9, 0.3, btVector3(0, 0, 0))));
  const btSoftBody& upper =
      addSoft(scene, builderOf(levelSheet(9, 0.3, btVector3(btScalar(0.01), btScalar(kThickness), 0))));
  lower.setActivationState(DISABLE_SIMULATION);
  scene.step(5);
  EXPECT_GT(expectListed(upper, lower), 50);
  EXPECT_EQ(lower.m_scontacts.size(), 0);
}

// A layer that lies on another touches it in every step, not now and then.
TEST_IN_POSITION_BASED_WORLDS(GuardContacts, OfALayerThatLiesOnAnotherDoNotFlicker) {
  GuardScene scene(thickGuard(), GetParam());
  scene.addFloor();
  addSoft(scene, builderOf(levelSheet(9, 0.3, btVector3(0, btScalar(0.012), 0))));
  const btSoftBody& upper =
      addSoft(scene, builderOf(levelSheet(9, 0.3, btVector3(btScalar(0.01), btScalar(0.017), 0))));
  scene.step(60);
  for (int step = 0; step < 60; ++step) {
    scene.step(1);
    std::set<const btSoftBody::Node*> touching;
    for (int k = 0; k < upper.m_scontacts.size(); ++k) touching.insert(upper.m_scontacts[k].m_node);
    EXPECT_GE(touching.size(), 72u) << step;  // of 81, of which a column has no cloth under it
  }
}

}  // namespace
}  // namespace wetcloth_test::guard_contacts_test
