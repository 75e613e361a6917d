// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which of its body's nodes this is.
inline int indexOf(const btSoftBody& body, const btSoftBody::Node* node) {
  return static_cast<int>(node - &body.m_nodes[0]);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
