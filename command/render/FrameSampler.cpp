// SPDX-License-Identifier: Zlib
#include "command/render/FrameSampler.h"

#include "command/run/ScenePainter.h"
#include "command/scene/ColliderSurface.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/shading/Colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace command {
namespace {

using pictures::ClothShape;
using pictures::ClothState;

pictures::Vector3 plain(const btVector3& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

pictures::Rgb plain(const wetcloth::Colour& colour) {
  return {static_cast<float>(colour.r), static_cast<float>(colour.g), static_cast<float>(colour.b)};
}

std::vector<pictures::Texture> textureOf(const wetcloth::ClothPatch& patch) {
  const auto width = static_cast<float>(patch.edgeU.length());
  const auto height = static_cast<float>(patch.edgeV.length());
  std::vector<pictures::Texture> texture;
  for (const auto& [u, v] : patch.textureCoordinates()) texture.push_back({u * width, v * height});
  return texture;
}

std::vector<pictures::Texture> textureOf(const TriangleMesh& mesh) {
  return mesh.sheet.empty() ? sheetOf(mesh.vertices) : mesh.sheet;
}

std::optional<pictures::TextureMap> ownTextureOf(const ClothScene& scene) {
  const auto* mesh = std::get_if<TriangleMesh>(&scene.shape);
  if (mesh == nullptr || !mesh->hasTexture()) return std::nullopt;
  return pictures::TextureMap{mesh->texture, mesh->textureTriangles};
}

pictures::FabricLook lookOf(const wetcloth::Fabric& fabric) {
  const auto& dry = fabric.dryColour;
  const wetcloth::Colour dryColour{dry[0], dry[1], dry[2]};
  return {plain(dryColour), plain(wetcloth::wetColour(dryColour, 1)), static_cast<float>(fabric.dryRoughness),
          static_cast<float>(wetcloth::wetRoughness(fabric.dryRoughness, 1))};
}

/// Of a garment as many as there are panels in a row of the same fabric.
std::vector<pictures::FabricPart> partsOf(const ClothScene& scene, std::size_t triangles) {
  if (!scene.garment) return {{lookOf(scene.fabric), triangles}};
  std::vector<pictures::FabricPart> parts;
  const std::vector<int>& fabrics = scene.garment->fabricOfTriangle;
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    if (i == 0 || fabrics[i] != fabrics[i - 1]) {
      parts.push_back({lookOf(scene.garment->fabrics[wetcloth::toSize(fabrics[i])]), 0});
    }
    ++parts.back().triangles;
  }
  return parts;
}

ClothShape shapeOf(const ClothScene& scene, const btSoftBody& body) {
  ClothShape shape;
  shape.name = scene.name;
  shape.texture = std::visit([](const auto& form) { return textureOf(form); }, scene.shape);
  shape.ownTexture = ownTextureOf(scene);
  shape.triangles = facesOf(body);
  const btSoftBody::Node* const first = &body.m_nodes[0];
  for (int i = 0; i < body.m_links.size(); ++i) {
    const auto& nodes = body.m_links[i].m_n;
    shape.links.push_back({static_cast<int>(nodes[0] - first), static_cast<int>(nodes[1] - first)});
  }
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im == 0) shape.pinned.push_back(i);
  }
  shape.parts = partsOf(scene, shape.triangles.size());
  return shape;
}

float distance(const btSoftBody& body, const std::array<int, 2>& link) {
  return static_cast<float>((body.m_nodes[link[0]].m_x - body.m_nodes[link[1]].m_x).length());
}

/// Bullet takes what it has not seen yet as it is now.
std::vector<float> restLengthsOf(const ClothShape& shape, const btSoftBody& body) {
  std::vector<float> lengths;
  for (std::size_t i = 0; i < shape.links.size(); ++i) {
    lengths.push_back(body.m_bUpdateRtCst ? distance(body, shape.links[i])
                                          : static_cast<float>(body.m_links[static_cast<int>(i)].m_rl));
  }
  return lengths;
}

pictures::Solid solidOf(const Collider& collider) {
  pictures::Solid solid;
  for (const ColliderSurface::Piece& piece : surfaceOf(collider).pieces) {
    const int first = static_cast<int>(solid.vertices.size());
    for (const btVector3& corner : piece.corners) solid.vertices.push_back(plain(corner));
    for (const btVector3& normal : piece.normals) solid.normals.push_back(plain(normal));
    solid.triangles.push_back({first, first + 1, first + 2});
    if (piece.corners.size() == 4) solid.triangles.push_back({first, first + 2, first + 3});
  }
  return solid;
}

/// None while nothing moves.
std::vector<pictures::Pose> posesOf(const Scene& scene, double time) {
  std::vector<pictures::Pose> poses;
  bool isMoving = false;
  for (const Collider& collider : scene.colliders) {
    if (collider.as<Plane>() != nullptr) continue;
    isMoving = isMoving || collider.motion;
    const btTransform place = collider.at(time);
    const btQuaternion turn = place.getRotation();
    poses.push_back({plain(place.getOrigin()),
                     {static_cast<float>(turn.x()), static_cast<float>(turn.y()), static_cast<float>(turn.z()),
                      static_cast<float>(turn.w())}});
  }
  if (!isMoving) poses.clear();
  return poses;
}

constexpr pictures::Rgb skinColour{0.50F, 0.30F, 0.20F};

bool isSkin(const Scene& scene, std::size_t collider) {
  return std::any_of(scene.figures.begin(), scene.figures.end(), [&](const FigureScene& figure) {
    return collider >= figure.first && collider < figure.first + figure.count;
  });
}

/// @param areas  of each collider that is no plane, in turn [m^2]
std::vector<float> wetnessOf(const SceneWorld& world, const std::vector<double>& areas) {
  constexpr double wetAllOver = 0.05;  // [kg/m^2]: a film as thin as 0.05 mm has no dry places
  const std::vector<Collider>& colliders = world.scene().colliders;
  std::vector<float> wetness;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    if (colliders[i].as<Plane>() != nullptr) continue;
    const double film = world.filmOn(i);
    const double area = areas[wetness.size()];
    wetness.push_back(film > 0 ? static_cast<float>(std::min(1.0, film / (wetAllOver * area))) : 0);
  }
  return wetness;
}

pictures::Scenery sceneryOf(const Scene& scene) {
  pictures::Scenery scenery;
  scenery.title = scene.name;
  scenery.up = plain(scene.up());
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    if (const auto* plane = scene.colliders[i].as<Plane>()) {
      scenery.grounds.push_back({plain(plane->normal), static_cast<float>(plane->offset)});
      continue;
    }
    scenery.solids.push_back(solidOf(scene.colliders[i]));
    if (isSkin(scene, i)) scenery.solids.back().colour = skinColour;
  }
  if (scene.water) scenery.waterLevel = static_cast<float>(scene.water->level);
  scenery.viewDirection = plain(scene.camera.direction);
  scenery.fieldOfView = static_cast<float>(scene.camera.fieldOfView);
  return scenery;
}

void takeNodes(const btSoftBody& body, ClothState& state) {
  const std::size_t count = wetcloth::toSize(body.m_nodes.size());
  state.positions.resize(count);
  state.speed.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    state.positions[i] = plain(node.m_x);
    state.speed[i] = static_cast<float>(node.m_v.length());
  }
}

void takeReleased(const btSoftBody& body, const ClothShape& shape, ClothState& state) {
  state.released.clear();
  for (const int node : shape.pinned) {
    if (body.m_nodes[node].m_im > 0) state.released.push_back(node);
  }
}

void takeStretch(const btSoftBody& body, const ClothShape& shape, const std::vector<float>& restLengths,
                 ClothState& state) {
  state.stretch.assign(state.positions.size(), 0);
  for (std::size_t i = 0; i < shape.links.size(); ++i) {
    const float stretch = distance(body, shape.links[i]) / std::max(restLengths[i], 1e-12F);
    for (const int node : shape.links[i]) {
      float& most = state.stretch[wetcloth::toSize(node)];
      most = std::max(most, stretch);
    }
  }
}

void takeDrops(const SceneWorld& world, double time, pictures::Frame& frame) {
  frame.drops.clear();
  if (world.drops() == nullptr) return;
  std::vector<float> spheres(4 * world.drops()->size());
  world.drops()->writeSpheres(spheres.data(), time);
  for (std::size_t i = 0; i < spheres.size(); i += 4) {
    frame.drops.push_back({{spheres[i], spheres[i + 1], spheres[i + 2]}, spheres[i + 3]});
  }
}

}  // namespace

FrameSampler::FrameSampler(const SceneWorld& world) : m_scenery(sceneryOf(world.scene())) {
  for (const Collider& collider : world.scene().colliders) {
    if (collider.as<Plane>() == nullptr) m_solidAreas.push_back(areaOf(collider));
  }
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const btSoftBody& body = *world.bodies()[i];
    m_cloths.push_back(shapeOf(world.scene().cloths[i], body));
    m_restLengths.push_back(restLengthsOf(m_cloths.back(), body));
  }
}

void FrameSampler::take(const SceneWorld& world, double time, pictures::Frame& frame) const {
  frame.time = time;
  frame.poses = posesOf(world.scene(), time);
  frame.wetness = wetnessOf(world, m_solidAreas);
  takeDrops(world, time, frame);
  frame.cloths.resize(m_cloths.size());
  for (std::size_t i = 0; i < m_cloths.size(); ++i) {
    ClothState& state = frame.cloths[i];
    takeNodes(*world.bodies()[i], state);
    takeStretch(*world.bodies()[i], m_cloths[i], m_restLengths[i], state);
    takeReleased(*world.bodies()[i], m_cloths[i], state);
    state.saturation.assign(state.positions.size(), 0);
    if (world.cloths().empty()) continue;  // plain Bullet knows no water
    for (std::size_t node = 0; node < state.saturation.size(); ++node) {
      state.saturation[node] = static_cast<float>(world.cloths()[i]->saturation(static_cast<int>(node)));
    }
  }
}

}  // namespace command
