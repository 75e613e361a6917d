// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardNodes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Supporting planes of rigid bodies: each along a face, with all of the body behind it for as long as its nodes keep
/// to what is expected of them. What is beyond one of them meets nothing of the body. Convex bodies have one for each
/// place around them.
class SupportPlanes {
 public:
  /// Bodies are expected elsewhere.
  void forget();
  /// Forgets all planes. The nodes live as long as planes are asked for; parts are near at this distance [m].
  void begin(const GuardNodes& nodes, btScalar near);
  /// Whether a part with up to four of the nodes is beyond a plane of the shell with this number of a mesh whose nodes
  /// begin with `firstNode`, and not near it, for all of the expected motion.
  bool areBeyond(const int* nodes, int count, const GuardMesh& mesh, int number, int firstNode);

 private:
  static constexpr std::size_t kLanes = 8;
  struct Block {
    btScalar normal[3][kLanes];
    btScalar offset[2][kLanes];  // at the start and at the end
  };
  struct Shell {
    bool isFound = false;
    std::vector<Block> blocks;
    std::size_t last = 0;  // plane that something was beyond
  };
  // A part of a cloth.
  struct Part {
    const int* nodes;
    int count;
    btScalar distance;  // beyond a plane that it has to be [m]
  };
  struct SameNormal;
  struct Farthest;
  struct Support;

  void find(const GuardMesh& mesh, const GuardMesh::Shell& of, int firstNode, Shell& shell) const;
  static std::size_t farthest(const Shell& shell, const btVector3& point);
  static bool hasNormal(const Shell& shell, const btVector3& normal);
  bool isBeyond(const Part& part, const Shell& shell, std::size_t plane) const;
  btVector3 middleOf(const Part& part) const;

  std::vector<Shell> m_shells;
  const GuardNodes* m_nodes = nullptr;
  btScalar m_near = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
