// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// Makes a body for a world.
using BodyBuilder = std::function<std::unique_ptr<btSoftBody>(btSoftBodyWorldInfo&)>;

/// `links` links that hang straight down from the origin, node 0 at the top and pinned; `mass` for each node [kg].
inline BodyBuilder hangingRope(int links, double linkLength, double mass, bool pinned = true) {
  return [=](btSoftBodyWorldInfo& info) {
    const btVector3 end(0, btScalar(-links * linkLength), 0);
    std::unique_ptr<btSoftBody> rope(
        btSoftBodyHelpers::CreateRope(info, btVector3(0, 0, 0), end, links - 1, pinned ? 1 : 0));
    for (int i = pinned ? 1 : 0; i < rope->m_nodes.size(); ++i) rope->setMass(i, btScalar(mass));
    // setMass() makes Bullet take the shape of the first step for the shape at rest; a test may stretch it before that.
    rope->updateConstants();
    rope->m_bUpdateRtCst = false;
    return rope;
  };
}

/// A body of these nodes, masses and triangles, without links.
inline BodyBuilder triangles(const std::vector<btVector3>& positions, const std::vector<btScalar>& masses,
                             const std::vector<std::array<int, 3>>& faces) {
  return [=](btSoftBodyWorldInfo& info) {
    auto body =
        std::make_unique<btSoftBody>(&info, static_cast<int>(positions.size()), positions.data(), masses.data());
    for (const auto& face : faces) body->appendFace(face[0], face[1], face[2]);
    return body;
  };
}

}  // namespace wetcloth_test
