// SPDX-License-Identifier: Zlib
// Several wet cloths on the same side of one: they share what a node can take through its area there, so that k of them
// at one place give what one does. The other side has an area of its own.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/RigidBody.h"

#include <memory>
#include <vector>

namespace wetcloth_test::contact_wetting_of_stacks_test {
namespace {

using wetcloth::ContactWetting;

enum class Effect { onTheOne, onTheOthers, onAll };

/// A dry sheet, and wet ones that touch it and not each other.
class Stack {
 public:
  explicit Stack(WorldKind kind) : m_scene(kind, kNoGravity, Lying().builder(kind)) {
    m_scene.addBulletSprings(5);
    for (int i = 0; i < m_scene.body().m_nodes.size(); ++i) m_scene.body().m_nodes[i].m_im = 0;
  }
  ~Stack() {
    for (const auto& body : m_others) {
      m_scene.wet().remove(*body);
      m_scene.bullet().remove(*body);
    }
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;

  /// Held so near above the sheet (below for -1) that they touch. Moved by `shift` along it.
  void addWet(int side, double shift = 0, int n = 4) {
    Lying lying;
    lying.n = n;
    lying.height += side * 0.5 * kMargin;
    auto body = lying.builder(m_scene.bullet().kind())(m_scene.bullet().info());
    for (int i = 0; i < body->m_nodes.size(); ++i)
      body->m_nodes[i].m_x.setX(body->m_nodes[i].m_x.x() + btScalar(shift));
    m_places.emplace_back();
    for (int i = 0; i < body->m_nodes.size(); ++i) m_places.back().push_back(body->m_nodes[i].m_x);
    body->setActivationState(DISABLE_DEACTIVATION);
    constexpr int group = 64;
    m_scene.bullet().add(*body, group, btBroadphaseProxy::AllFilter & ~group);
    wetcloth::WetCloth& cloth = m_scene.wet().add(*body);
    cloth.setSaturation(0.6);
    m_others.push_back(std::move(body));
  }
  /// Water that the sheet has taken after some steps [kg].
  double taken(Effect effect) {
    ContactWetting::Parameters parameters;
    parameters.cloths = true;
    for (wetcloth::WetCloth& cloth : m_scene.wet().cloths()) {
      const bool isTheOne = &cloth == &m_scene.cloth();
      if (effect == Effect::onAll || isTheOne == (effect == Effect::onTheOne)) cloth.add<ContactWetting>(parameters);
    }
    for (int i = 0; i < 60; ++i) {
      m_scene.step(1);
      putBack();
    }
    return m_scene.cloth().ledger().absorbed;
  }

 private:
  // Contacts push them away.
  void putBack() {
    for (std::size_t k = 0; k < m_others.size(); ++k) {
      for (int i = 0; i < m_others[k]->m_nodes.size(); ++i) {
        btSoftBody::Node& node = m_others[k]->m_nodes[i];
        node.m_x = node.m_q = m_places[k][static_cast<std::size_t>(i)];
        node.m_v = node.m_vn = btVector3(0, 0, 0);
      }
    }
  }

  ClothScene m_scene;
  std::vector<std::unique_ptr<btSoftBody>> m_others;
  std::vector<std::vector<btVector3>> m_places;
};

class ContactWettingOfStacks {
 protected:
  double takenFrom(int above, int below, Effect effect, double shift = 0, int n = 4) {
    Stack stack(GetParam());
    for (int i = 0; i < above; ++i) stack.addWet(1, i * shift, n);
    for (int i = 0; i < below; ++i) stack.addWet(-1, 0, n);
    return stack.taken(effect);
  }
};

TEST_F_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfStacks, ManyGiveWhatOneDoes) {
  for (const Effect effect : {Effect::onTheOne, Effect::onTheOthers, Effect::onAll}) {
    SCOPED_TRACE(static_cast<int>(effect));
    const double one = takenFrom(1, 0, effect);
    ASSERT_GT(one, 0);
    // The wet ones dry a little less each.
    EXPECT_NEAR(takenFrom(3, 0, effect), one, 0.03 * one);
    EXPECT_NEAR(takenFrom(0, 2, effect), takenFrom(0, 1, effect), 0.03 * one);
  }
}

TEST_F_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfStacks, EachSideHasAnAreaOfItsOwn) {
  const double one = takenFrom(1, 0, Effect::onTheOne);
  EXPECT_NEAR(takenFrom(1, 1, Effect::onTheOne), one + takenFrom(0, 1, Effect::onTheOne), 0.03 * one);
  EXPECT_NEAR(takenFrom(2, 3, Effect::onTheOne), takenFrom(1, 1, Effect::onTheOne), 0.06 * one);
}

// Meshes that do not lie node on node.
TEST_F_IN_WORLDS_WITH_FACE_CONTACTS(ContactWettingOfStacks, ShiftedOnesGiveHardlyMoreThanOne) {
  for (const int n : {4, 7}) {
    const double one = takenFrom(1, 0, Effect::onTheOne, 0, n);
    const double three = takenFrom(3, 0, Effect::onTheOne, 0.03, n);
    EXPECT_GT(three, 0.9 * one) << n;
    EXPECT_LT(three, 1.5 * one) << n;
  }
}

}  // namespace
}  // namespace wetcloth_test::contact_wetting_of_stacks_test
