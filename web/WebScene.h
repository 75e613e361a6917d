// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"
#include "command/pictures/Rods.h"
#include "command/viewer/LiveScene.h"

#include <emscripten/val.h>

#include <string>
#include <vector>

namespace wetcloth_web {

/// A scene that runs in a page. Numbers are handed over as typed arrays that look into this program's memory: they are
/// read at once, as the next call may move it. Texts are JSON where they are more than a word.
class WebScene {
 public:
  /// Throws command::InputError with the line that the command would print. @param description  a scene file's text
  WebScene(const std::string& description, const std::string& name);

  /// What stays the same: scenery, view, shapes, solids; what page/renderer.js calls a run.
  std::string run() const;
  emscripten::val triangles(int cloth) const;
  emscripten::val texture(int cloth) const;
  emscripten::val solidVertices(int solid) const;
  emscripten::val solidNormals(int solid) const;
  emscripten::val solidTriangles(int solid) const;

  viewer::LiveScene& live() { return m_live; }

  /// Looks at the world as it is now, for what follows. @param plain  of the world in plain Bullet
  void look(bool plain);
  emscripten::val positions(int cloth) const;
  emscripten::val saturation(int cloth) const;
  emscripten::val stretch(int cloth) const;
  emscripten::val speed(int cloth) const;
  /// Of each drop x, y, z and radius [m].
  emscripten::val drops() const;
  /// Poses and wetness of the solids, rods that cloths hang from.
  std::string among() const;

  /// Time, water, failure, and of each effect whether it is on and what it costs.
  std::string state() const;

  /// Takes hold of the cloth on a ray from `origin` along `direction`; how far along it is [m], or -1.
  double grab(float originX, float originY, float originZ, float directionX, float directionY, float directionZ,
              bool plain);
  void dragTo(float x, float y, float z);

 private:
  const pictures::ClothState& cloth(int number) const;

  viewer::LiveScene m_live;
  std::vector<pictures::Rods> m_rods;
  const pictures::Frame* m_frame = nullptr;  // of the world that was looked at last
  std::vector<float> m_drops;
};

}  // namespace wetcloth_web
