// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ContactList.h"

#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <LinearMath/btAlignedAllocator.h>

#include <cstdlib>
#include <cstring>
#include <memory>

namespace wetcloth_test::contact_list_test {
namespace {

using wetcloth::ContactList;

// Contacts that were never made have whatever the memory had: no empty arrays, which their destructors would free.
void expectMade(btSoftBody& body) {
  for (int k = 0; k < body.m_rcontacts.size(); ++k) {
    const btSoftBody::RContact& contact = body.m_rcontacts[k];
    for (const btMultiBodyJacobianData* const data :
         {&contact.jacobianData_normal, &contact.jacobianData_t1, &contact.jacobianData_t2}) {
      ASSERT_EQ(data->m_jacobians.size(), 0) << k;
      ASSERT_EQ(data->scratch_m.capacity(), 0) << k;
    }
  }
}

// While it lives Bullet gets memory that is not zero, as its own is; laid out so that Bullet's own function frees it.
class SoiledMemory {
 public:
  SoiledMemory() { btAlignedAllocSetCustomAligned(soiled, nullptr); }
  ~SoiledMemory() { btAlignedAllocSetCustomAligned(nullptr, nullptr); }

 private:
  static void* soiled(std::size_t size, int alignment) {
    const std::size_t room = size + sizeof(void*) + static_cast<std::size_t>(alignment);
    void* const block = std::malloc(room);
    if (!block) return nullptr;
    std::memset(block, 0xa5, room);
    char* const memory = btAlignPointer(static_cast<char*>(block) + sizeof(void*), static_cast<std::size_t>(alignment));
    std::memcpy(memory - sizeof(void*), &block, sizeof block);
    return memory;
  }
};

TEST(ContactList, OnlyWhatExistsIsWrittenOver) {
  btSoftBodyWorldInfo info;
  const std::unique_ptr<btSoftBody> body = squarePatch(3).build(info);
  ContactList contacts;
  const auto fill = [&](int count) {
    contacts.begin(*body);
    for (int k = 0; k < count; ++k) contacts.add(*body).m_node = &body->m_nodes[k % 9];
  };
  const SoiledMemory soiled;
  for (const int count : {5, 3, 40, 12, 0, 41}) {
    fill(count);
    EXPECT_EQ(body->m_rcontacts.size(), count);
    expectMade(*body);
  }
  // Bullet's own tests of nodes add to the same list, which moves it when it is full.
  for (int k = 0; k < 100; ++k) body->m_rcontacts.push_back(btSoftBody::RContact());
  fill(128);
  expectMade(*body);
  // An application, or Bullet when it takes the body back, gives the memory away.
  body->m_rcontacts.clear();
  fill(128);
  expectMade(*body);
  const btSoftBody::Node* const node = body->m_rcontacts[127].m_node;
  fill(128);
  EXPECT_EQ(body->m_rcontacts[127].m_node, node);
}

}  // namespace
}  // namespace wetcloth_test::contact_list_test
