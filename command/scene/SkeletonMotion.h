// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/ObjReader.h"

#include <LinearMath/btTransform.h>

#include <string>
#include <vector>

namespace command {

/// The joints of a skeleton and where each of them is at which time.
struct SkeletonMotion {
  struct Joint {
    std::string name;
    std::vector<btTransform> places;  ///< in the world, one for each time, turned from how it is at rest
    std::vector<btVector3> ends;      ///< of its bones: where the next joints are, as seen from it at rest [m]
    std::vector<btVector3> skin;      ///< vertices of the file's mesh that follow this joint most, seen from it [m]
  };
  std::vector<double> times;  ///< [s], the first is 0
  std::vector<Joint> joints;
};

/// The first animation of a BVH or glTF file, by assimp. Throws std::invalid_argument that says what is wrong with the
/// file, with the line or the joint, or that this build is without assimp.
SkeletonMotion readSkeletonMotion(const std::string& file, const Placement& placement);

}  // namespace command
