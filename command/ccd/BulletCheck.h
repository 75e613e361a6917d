// SPDX-License-Identifier: Zlib
#pragma once

#include <bullet_wetcloth/collision/Query.h>

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

namespace command {

/// A vertex-face query as a face and a node of Bullet's deformable world, at the moment at which
/// btDeformableMultiBodyDynamicsWorld looks for collisions. Bullet has no edge-edge check.
///
/// Bullet takes positions and velocities, which are rounded to btScalar: already in float64 the end of the motion is
/// `start + (end - start)`, rounded. Its thresholds are absolute, so its answer depends on the unit of time, too: with
/// a step of 1 a velocity is a displacement; with that of a world, in seconds, Bullet finds more.
class BulletQuery {
 public:
  /// What Bullet passes to continuousCollisionDetection: how far from the face's plane still counts [length].
  static constexpr double kMargin = 1e-6;

  /// `step` [s]: the time that the motion takes.
  explicit BulletQuery(const wetcloth::collision::Query<double>& query, double step = 1) : m_step(btScalar(step)) {
    for (int i = 0; i < 4; ++i) {
      btSoftBody::Node& node = m_nodes[i];
      const double* start = query.start[i];
      const double* end = query.end[i];
      node.m_x = btVector3(btScalar(start[0]), btScalar(start[1]), btScalar(start[2]));
      node.m_v = btVector3(btScalar((end[0] - start[0]) / step), btScalar((end[1] - start[1]) / step),
                           btScalar((end[2] - start[2]) / step));
      node.m_q = node.m_x + m_step * node.m_v;  // the predicted place; elsewhere in Bullet it is the previous one
      node.m_vn = node.m_v;
      node.m_im = 1;
    }
    pointFaceAtNodes();
    const btSoftBody::Node* a = m_face.m_n[0];
    const btSoftBody::Node* b = m_face.m_n[1];
    const btSoftBody::Node* c = m_face.m_n[2];
    // None of these has unit length, and m_vn is not a velocity.
    m_face.m_n0 = (b->m_x - a->m_x).cross(c->m_x - a->m_x);
    m_face.m_n1 = (b->m_q - a->m_q).cross(c->m_q - a->m_q);
    m_face.m_vn = (b->m_v - a->m_v).cross(c->m_v - a->m_v) * m_step * m_step;
    m_face.m_normal = m_face.m_n0;  // this one has
    m_face.m_normal.safeNormalize();
  }
  BulletQuery(const BulletQuery& other) : m_step(other.m_step), m_face(other.m_face) {
    for (int i = 0; i < 4; ++i) m_nodes[i] = other.m_nodes[i];
    pointFaceAtNodes();
  }
  BulletQuery& operator=(const BulletQuery&) = delete;

  /// Bullet's answer without the culling that its world puts before it.
  bool check() const {
    btVector3 weights;
    return continuousCollisionDetection(&m_face, &m_nodes[0], m_step, btScalar(kMargin), weights);
  }
  /// The whole of what Bullet's world asks: the test of the Bernstein coefficients, then check().
  bool checkAsItsWorldDoes() const {
    btVector3 weights;
    return bernsteinCCD(&m_face, &m_nodes[0], m_step, SAFE_EPSILON, weights);
  }

  btScalar step() const { return m_step; }
  const btSoftBody::Node& node() const { return m_nodes[0]; }
  const btSoftBody::Face& face() const { return m_face; }

 private:
  void pointFaceAtNodes() {
    for (int i = 0; i < 3; ++i) m_face.m_n[i] = &m_nodes[i + 1];
  }

  btScalar m_step;
  btSoftBody::Node m_nodes[4]{};
  btSoftBody::Face m_face{};
};

/// Bullet's answer to a vertex-face query; for many of them, or to measure, keep BulletQuery instead.
inline bool bulletContinuousCheck(const wetcloth::collision::Query<double>& query, double step = 1) {
  return BulletQuery(query, step).check();
}

}  // namespace command
