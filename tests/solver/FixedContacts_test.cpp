// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/FixedContacts.h"

#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace wetcloth_test::fixed_contacts_test {
namespace {

using wetcloth::FixedContacts;
using wetcloth::MovingNodes;
using wetcloth::PackedNodes;
using wetcloth::PlaneContact;

constexpr std::size_t kSlots = 40;
constexpr btScalar kStep = btScalar(1) / 600;
constexpr btScalar kMargin = btScalar(0.01);

// Nodes at random within a few millimetres of the plane y = 0, with velocities of some m/s.
struct Nodes {
  Nodes() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int axis = 0; axis < 3; ++axis) {
      for (PackedNodes::Lane* const lane : {&position[axis], &predicted[axis], &velocity[axis]}) {
        lane->assign(kSlots + PackedNodes::kPadding, 0);
      }
      for (std::size_t k = 0; k < kSlots; ++k) {
        position[axis][k] = btScalar(number(random) * (axis == 1 ? 0.005 : 1));
        predicted[axis][k] = position[axis][k] + btScalar(1e-4 * number(random));
        velocity[axis][k] = btScalar(3 * number(random));
      }
    }
  }
  MovingNodes moving() {
    MovingNodes nodes = {};
    nodes.count = kSlots;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.position[axis] = position[axis].data();
      nodes.predicted[axis] = predicted[axis].data();
      nodes.velocity[axis] = velocity[axis].data();
    }
    return nodes;
  }
  btVector3 at(std::size_t slot) const { return {position[0][slot], position[1][slot], position[2][slot]}; }

  PackedNodes::Lane position[3];
  PackedNodes::Lane predicted[3];
  PackedNodes::Lane velocity[3];
};

struct Case {
  PlaneContact contact;
  btVector3 velocity;
};

// Planes at random, some of which a node has two of, and some nodes none.
std::vector<Case> casesAtRandom() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Case> cases;
  for (int object = 0; object < 2; ++object) {
    for (std::size_t slot = 0; slot < kSlots; slot += 1 + random() % 3) {
      const btVector3 normal =
          btVector3(btScalar(0.3 * number(random)), 1, btScalar(0.3 * number(random))).normalized();
      cases.push_back(
          {{slot, normal, btScalar(0.004 * number(random)), btScalar(0.5 + number(random) / 2), btScalar(0.05)},
           btVector3(btScalar(number(random)), btScalar(number(random)), 0)});
    }
  }
  return cases;
}

FixedContacts contactsOf(const std::vector<Case>& cases) {
  FixedContacts contacts;
  contacts.reset(kSlots);
  for (const Case& each : cases) contacts.add(each.contact, each.velocity);
  return contacts;
}

// One contact after the other, in vectors: the law of Bullet's PSolve_RContacts.
void projectByLaw(Nodes& nodes, std::vector<Case>& cases) {
  const MovingNodes moving = nodes.moving();
  for (Case& each : cases) {
    PlaneContact& contact = each.contact;
    const btVector3 carried = each.velocity * kStep;
    contact.offset -= carried.dot(contact.normal);
    const btVector3 relative = moving.wayOf(contact.slot, kStep) - carried;
    const btScalar approach = relative.dot(contact.normal);
    if (approach > SIMD_EPSILON) continue;
    const btScalar gap = std::min(nodes.at(contact.slot).dot(contact.normal) + contact.offset, kMargin);
    const btVector3 slip = relative - contact.normal * approach;
    const btVector3 moved = relative - slip * contact.slips + contact.normal * (gap * contact.recovers);
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][contact.slot] -= moved[axis];
  }
}

TEST(FixedContacts, FollowTheLawAndLeaveOthersAlone) {
  std::vector<Case> cases = casesAtRandom();
  FixedContacts contacts = contactsOf(cases);
  EXPECT_EQ(contacts.size(), cases.size());
  Nodes nodes;
  Nodes expected;
  const Nodes before;
  for (int step = 0; step < 3; ++step) {
    contacts.project(nodes.moving(), kStep, kMargin);
    projectByLaw(expected, cases);
  }
  std::size_t untouched = 0;
  for (std::size_t k = 0; k < kSlots; ++k) {
    EXPECT_LT(double((nodes.at(k) - expected.at(k)).length()), 1e-6) << k;
    const bool isTouched =
        std::any_of(cases.begin(), cases.end(), [&](const Case& each) { return each.contact.slot == k; });
    if (isTouched) continue;
    EXPECT_TRUE(nodes.at(k) == before.at(k)) << k;
    ++untouched;
  }
  EXPECT_GT(untouched, 3u);
}

TEST(FixedContacts, AllProcessorsComeToTheSameBits) {
  const wetcloth::InstructionSet best = wetcloth::instructionSet();
  Nodes wide;
  Nodes narrow;
  contactsOf(casesAtRandom()).project(wide.moving(), kStep, kMargin);
  wetcloth::forceInstructionSet(wetcloth::InstructionSet::baseline);
  contactsOf(casesAtRandom()).project(narrow.moving(), kStep, kMargin);
  wetcloth::forceInstructionSet(best);
  for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(wide.position[axis] == narrow.position[axis]);
}

// A node that falls onto a plane and does not bounce; another that leaves it, and one that is dragged by friction.
TEST(FixedContacts, ANodeStopsAndSlidesAsItsContactSays) {
  const auto velocityAfter = [](const btVector3& velocity, btScalar slips) {
    Nodes nodes;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.velocity[axis][9] = velocity[axis];
      nodes.position[axis][9] = nodes.predicted[axis][9] = velocity[axis] * kStep;
    }
    FixedContacts contacts;
    contacts.reset(kSlots);
    contacts.add({9, btVector3(0, 1, 0), 0, slips, 0}, btVector3(0, 0, 0));
    contacts.project(nodes.moving(), kStep, kMargin);
    return nodes.at(9) / kStep;
  };
  EXPECT_LT(double((velocityAfter(btVector3(2, -1, 0), 1) - btVector3(2, 0, 0)).length()), 1e-5);
  EXPECT_LT(double((velocityAfter(btVector3(2, -1, 0), btScalar(0.25)) - btVector3(btScalar(0.5), 0, 0)).length()),
            1e-5);
  EXPECT_LT(double((velocityAfter(btVector3(2, 1, 0), btScalar(0.25)) - btVector3(2, 1, 0)).length()), 1e-5);
}

}  // namespace
}  // namespace wetcloth_test::fixed_contacts_test
