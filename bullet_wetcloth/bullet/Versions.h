// SPDX-License-Identifier: Zlib
// What Bullet 3.05 to 3.21 lack. Its classes are asked, not BT_BULLET_VERSION: 3.21, which lacks all of
// this, and 3.22, which has it, both call themselves 320.
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <string>
#include <type_traits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace versions {

template <class Body>
auto isReduced(const Body& body, int /*newer*/) -> decltype(body.m_reducedModel) {
  return body.m_reducedModel;
}

template <class Body>
bool isReduced(const Body& /*body*/, long /*older*/) {
  return false;
}

template <class Body, class = void>
struct KeepsFaceContacts : std::false_type {};

// Older ones use their list of contacts for the continuous check, too, and empty it for that.
template <class Body>
struct KeepsFaceContacts<Body, std::void_t<decltype(std::declval<Body&>().m_faceNodeContactsCCD)>> : std::true_type {};

}  // namespace versions

/** Whether `body` is a btReducedDeformableBody, which Bullet has from 3.22 on. */
inline bool isReduced(const btSoftBody& body) { return versions::isReduced(body, 0); }

/** Whether the deformable world's list of contacts of two soft bodies is there after its substep. */
constexpr bool keepsFaceContacts() { return versions::KeepsFaceContacts<btSoftBody>::value; }

/** Bullet's version as its headers have it, "3.24". */
inline std::string bulletVersion() {
  const std::string digits = std::to_string(BT_BULLET_VERSION);
  return digits.substr(0, digits.size() - 2) + "." + digits.substr(digits.size() - 2);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
