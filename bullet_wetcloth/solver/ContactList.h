// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <new>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A body's list of contacts with rigid bodies, btSoftBody::m_rcontacts, filled anew in every step.
///
/// A contact has nearly 800 bytes, of which a position-based world uses the first 150; the others are arrays that stay
/// empty. So contacts of the step before are not destroyed, and are written over where they stand: making them anew
/// took longer than finding them.
class ContactList {
 public:
  /// A new step: the list is empty.
  void begin(btSoftBody& body) { body.m_rcontacts.resizeNoInitialize(0); }
  /// One more contact, whose fields up to m_c4 are to be set.
  btSoftBody::RContact& add(btSoftBody& body) {
    btAlignedObjectArray<btSoftBody::RContact>& contacts = body.m_rcontacts;
    const int index = contacts.size();
    btSoftBody::RContact& contact = contacts.expandNonInitializing();
    follow(&contact - index, contacts.capacity(), index);
    if (index >= m_made) {
      new (&contact) btSoftBody::RContact();
      m_made = index + 1;
    }
    return contact;
  }

 private:
  // In a new block of memory only those exist that are in the list.
  void follow(const btSoftBody::RContact* block, int capacity, int size) {
    if (block == m_block && capacity == m_capacity) return;
    m_block = block;
    m_capacity = capacity;
    m_made = size;
  }

  const btSoftBody::RContact* m_block = nullptr;  // of the list
  int m_capacity = 0;
  int m_made = 0;  // contacts that exist in it, whether they are in the list or not
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
