// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Pictures, films, pages and files of a run. Plain numbers in float32, whatever Bullet's precision is.
namespace pictures {

using Vector3 = std::array<float, 3>;  ///< [m], or of length 1
using Rgb = std::array<float, 3>;      ///< linear RGB, each in [0, 1]
using Triangle = std::array<int, 3>;   ///< indices of vertices
using Texture = std::array<float, 2>;  ///< place on the flat sheet [m]

/// Texture coordinates that a mesh brought along, one for each corner, so that a seam may have two.
struct TextureMap {
  std::vector<Texture> places;      ///< as the mesh's file has them, without a unit
  std::vector<Triangle> triangles;  ///< indices of places, one triangle for each of the cloth's
};

/// What a fabric looks like. Colours are linear in the saturation between dry and wet.
struct FabricLook {
  Rgb dryColour{};
  Rgb wetColour{};  ///< at saturation 1
  float dryRoughness = 1;
  float wetRoughness = 1;
};

/// Triangles of one fabric, which follow each other.
struct FabricPart {
  FabricLook look;
  std::size_t triangles = 0;  ///< how many
};

/// What of a cloth stays the same during a run.
struct ClothShape {
  std::string name;
  std::vector<Texture> texture;           ///< one per node
  std::optional<TextureMap> ownTexture;   ///< what other programs are given instead of `texture`, where there is one
  std::vector<Triangle> triangles;        ///< indices of nodes
  std::vector<std::array<int, 2>> links;  ///< indices of nodes
  std::vector<int> pinned;                ///< nodes
  std::vector<FabricPart> parts;          ///< of the triangles, in their order
};

/// A cloth at one moment: one value per node, but for `released`.
struct ClothState {
  std::vector<Vector3> positions;  ///< [m]
  std::vector<float> saturation;   ///< water over capacity, [0, 1]
  std::vector<float> stretch;      ///< largest of its links' length over length at rest, 1 unstretched
  std::vector<float> speed;        ///< [m/s]
  std::vector<int> released;       ///< nodes that were pinned at first, sorted
};

/// Water that has left a cloth and falls.
struct Drop {
  Vector3 position{};  ///< [m]
  float radius = 0;    ///< [m]
};

/// Where a solid is: turned about the origin, then moved.
struct Pose {
  Vector3 place{};                        ///< [m]
  std::array<float, 4> turn{0, 0, 0, 1};  ///< quaternion x, y, z, w of length 1
};

/// Everything that moves, at one moment.
struct Frame {
  double time = 0;  ///< [s]
  std::vector<ClothState> cloths;
  std::vector<Drop> drops;
  std::vector<Pose> poses;     ///< of each solid; empty: all are as the scenery has them
  std::vector<float> wetness;  ///< of each solid, [0, 1]; empty: all are dry
};

/// A plane that cloth can lie on: points p with normal . p = offset.
struct Ground {
  Vector3 normal{};  ///< of length 1
  float offset = 0;  ///< [m]
};

/// A rigid body, as triangles that face outwards (counter-clockwise seen from outside).
struct Solid {
  std::vector<Vector3> vertices;  ///< [m]
  std::vector<Vector3> normals;   ///< one per vertex, of length 1
  std::vector<Triangle> triangles;
  Rgb colour{0.50F, 0.42F, 0.33F};  ///< dry; of stone
};

/// What the cloths of a scene are among.
struct Scenery {
  std::string title;
  Vector3 up{0, 1, 0};
  std::vector<Ground> grounds;
  std::vector<Solid> solids;
  std::optional<float> waterLevel;            ///< height of a level surface of water along `up` [m]
  Vector3 viewDirection{-0.45F, -0.35F, -1};  ///< the camera looks along it; not of length 1
  float fieldOfView = 30;                     ///< vertical [degrees]
};

/// A number in the course of a run, one value per frame.
struct Series {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// A whole run.
struct FrameSequence {
  Scenery scenery;
  std::vector<ClothShape> cloths;
  std::vector<Frame> frames;  ///< each has as many cloths
  std::vector<Series> series;
};

}  // namespace pictures
