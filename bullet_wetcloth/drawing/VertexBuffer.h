// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetCloth;

/// Where one value of each vertex lies in a vertex buffer, counted in floats as in Bullet's btVertexBufferDescriptor.
struct VertexAttribute {
  int offset = 0;  ///< from VertexBuffer::base to the first vertex's [floats], >= 0
  int stride = 0;  ///< from one vertex's to the next [floats], at least what the value takes; 0: not wanted
};

/// A user's vertex buffer: floats in memory that the CPU can write, interleaved or not, one vertex per node in the
/// order of btSoftBody::m_nodes.
struct VertexBuffer {
  /// The buffer's first float; the application owns it.
  float* base = nullptr;
  int vertexCount = 0;        ///< that the buffer has room for; must be the number of the body's nodes
  VertexAttribute position;   ///< 3 floats: x, y, z in the world [m]
  VertexAttribute normal;     ///< 3 floats, of length 1; by Bullet at the end of its last step (btSoftBody::Node::m_n)
  VertexAttribute colour;     ///< 3 floats: diffuse, linear RGB, each in [0, 1], as WetCloth::colour()
  VertexAttribute roughness;  ///< 1 float in [0, 1], as WetCloth::roughness()
};

/// Writes what is wanted of a cloth into the buffer, in one pass over its nodes and without allocating; what lies
/// between the values stays. Beside btSoftBodySolver::copySoftBodyToVertexBuffer() it has colour and roughness, and
/// works in all of Bullet's worlds.
///
/// Nodes by which a cut made the body larger since the last step are dry. Bullet knows no normals before its first
/// step: btSoftBody::updateNormals() makes them.
///
/// Throws std::invalid_argument, and then writes nothing: base is null; vertexCount is not the number of nodes; an
/// offset is negative; a stride is neither 0 nor at least what the value takes.
WETCLOTH_EXPORT void fillVertexBuffer(const WetCloth& cloth, const VertexBuffer& buffer);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
