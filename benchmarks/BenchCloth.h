// SPDX-License-Identifier: Zlib
#pragma once

#include <bullet_wetcloth/bullet_wetcloth.h>

#include "tests/support/BodyScene.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

namespace wetcloth_bench {

template <class Action>
double secondsOf(Action action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A square cloth of `side` x `side` nodes that hangs from two corners in a soft-rigid world: 10 iterations, a step of
/// 1/60 s. Several of these can take turns in one run.
class BenchCloth {
 public:
  enum class Mesh { ours, bullets };

  explicit BenchCloth(int side, Mesh mesh = Mesh::ours)
      : m_scene(wetcloth_test::WorldKind::softRigid, mesh == Mesh::ours ? ourPatch(side) : bulletsPatch(side),
                btVector3(0, -10, 0)) {
    body().m_cfg.piterations = 10;
  }
  BenchCloth(const BenchCloth&) = delete;
  BenchCloth& operator=(const BenchCloth&) = delete;

  btSoftBody& body() { return m_scene.body(); }
  wetcloth::WetCloth& wet() {
    if (!m_wetWorld) {
      m_wetWorld = std::make_unique<wetcloth::WetClothWorld>(m_scene.world(), wetcloth::Hook::manual);
      m_wetWorld->add(body());
      m_scene.world().setInternalTickCallback(onPreTick, this, true);
    }
    return m_wetWorld->cloths().front();
  }
  /// Time spent in our part of the last step [s].
  double ourSeconds() const { return m_ourSeconds; }
  void step() { m_scene.bullet().step(1, btScalar(1) / 60); }

 private:
  static wetcloth_test::BodyBuilder ourPatch(int side) {
    wetcloth::ClothPatch patch = wetcloth_test::squarePatch(side);
    patch.pinnedCorners = {wetcloth::ClothPatch::Corner::bottomLeft, wetcloth::ClothPatch::Corner::bottomRight};
    return [patch](btSoftBodyWorldInfo& info) { return patch.build(info); };
  }
  /// As in Bullet's own demos: nearly twice the links, in an order that makes each wait for the one before.
  static wetcloth_test::BodyBuilder bulletsPatch(int side) {
    return [side](btSoftBodyWorldInfo& info) {
      std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreatePatch(info, btVector3(0, 0, 0), btVector3(1, 0, 0),
                                                                      btVector3(0, 0, 1), btVector3(1, 0, 1), side,
                                                                      side, 1 + 2, true));
      body->generateBendingConstraints(2);
      body->setTotalMass(btScalar(0.15));
      return body;
    };
  }

  static void onPreTick(btDynamicsWorld* world, btScalar dt) {
    BenchCloth& cloth = *static_cast<BenchCloth*>(world->getWorldUserInfo());
    cloth.m_ourSeconds = secondsOf([&] { cloth.m_wetWorld->preTick(dt); });
  }

  wetcloth_test::BodyScene m_scene;
  std::unique_ptr<wetcloth::WetClothWorld> m_wetWorld;
  double m_ourSeconds = 0;
};

}  // namespace wetcloth_bench
