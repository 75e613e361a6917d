// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drawing/VertexBuffer.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/shading/Colour.h"

#include <cstddef>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const std::string& name, const VertexAttribute& attribute, int floats) {
  if (attribute.offset < 0) rejectValue("VertexBuffer." + name + ".offset", attribute.offset, ">= 0");
  if (attribute.stride != 0 && attribute.stride < floats) {
    rejectValue("VertexBuffer." + name + ".stride", attribute.stride, "0, or at least " + std::to_string(floats));
  }
}

void requireValid(const VertexBuffer& buffer, int nodes) {
  if (buffer.base == nullptr) reject("VertexBuffer.base", "must not be null");
  if (buffer.vertexCount != nodes) {
    rejectValue("VertexBuffer.vertexCount", buffer.vertexCount, "the number of nodes, " + std::to_string(nodes));
  }
  requireValid("position", buffer.position, 3);
  requireValid("normal", buffer.normal, 3);
  requireValid("colour", buffer.colour, 3);
  requireValid("roughness", buffer.roughness, 1);
}

// Where an attribute's next value goes; nowhere when it is not wanted.
class Cursor {
 public:
  Cursor(float* base, const VertexAttribute& attribute)
      : m_next(attribute.stride > 0 ? base + attribute.offset : nullptr), m_stride(attribute.stride) {}

  template <class... Values>
  void write(Values... values) {
    if (m_next == nullptr) return;
    float* to = m_next;
    ((*to++ = static_cast<float>(values)), ...);
    m_next += m_stride;
  }

 private:
  float* m_next;
  std::ptrdiff_t m_stride;
};

// Both are linear in the saturation, so their ends say all.
struct Looks {
  Colour dry;
  Colour wet;
  double dryRoughness;
  double wetRoughness;

  explicit Looks(const Fabric& fabric)
      : dry{fabric.dryColour[0], fabric.dryColour[1], fabric.dryColour[2]},
        wet(wetColour(dry, 1)),
        dryRoughness(fabric.dryRoughness),
        wetRoughness(wetcloth::wetRoughness(fabric.dryRoughness, 1)) {}
};

double mix(double dry, double wet, double share) { return dry + (wet - dry) * share; }

double shareOf(double saturation) { return saturation > 0 ? (saturation < 1 ? saturation : 1) : 0; }

}  // namespace

void fillVertexBuffer(const WetCloth& cloth, const VertexBuffer& buffer) {
  const btSoftBody& body = cloth.body();
  requireValid(buffer, cloth.nodeCount());
  const Water& water = cloth.water();
  const std::size_t nodes = static_cast<std::size_t>(buffer.vertexCount);
  Cursor position(buffer.base, buffer.position);
  Cursor normal(buffer.base, buffer.normal);
  Cursor colour(buffer.base, buffer.colour);
  Cursor roughness(buffer.base, buffer.roughness);
  // Panels of a garment have their nodes one after the other.
  for (std::size_t i = 0; i < nodes;) {
    const std::size_t fabric = water.fabric(i);
    const Looks looks(cloth.fabrics()[fabric]);
    for (; i < nodes && water.fabric(i) == fabric; ++i) {
      const btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
      const double wetness = shareOf(water.saturation(i));
      position.write(node.m_x.x(), node.m_x.y(), node.m_x.z());
      normal.write(node.m_n.x(), node.m_n.y(), node.m_n.z());
      colour.write(mix(looks.dry.r, looks.wet.r, wetness), mix(looks.dry.g, looks.wet.g, wetness),
                   mix(looks.dry.b, looks.wet.b, wetness));
      roughness.write(mix(looks.dryRoughness, looks.wetRoughness, wetness));
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
