// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/Renderer.h"

#include "Embedded.h"
#include "command/pictures/ColourMap.h"
#include "command/pictures/ColourScale.h"
#include "command/pictures/PosedSolid.h"
#include "command/pictures/VectorMath.h"
#include "command/pictures/gl/ClothOnRods.h"
#include "command/pictures/gl/ColourBar.h"
#include "command/pictures/gl/Overlay.h"
#include "command/pictures/gl/PictureBuffer.h"
#include "command/pictures/gl/PictureUniforms.h"
#include "command/pictures/gl/ShaderProgram.h"
#include "command/pictures/gl/ShadowMap.h"
#include "command/pictures/gl/SolidMesh.h"
#include "command/pictures/gl/VertexArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace pictures {
namespace {

constexpr GLuint pictureBlock = 0;
constexpr GLuint shadowUnit = 0;
constexpr GLuint colourMapUnit = 1;
constexpr float shadowSoftness = 0.009F;  // over the size of what there is to see
/// Cloth sinks a little into what it lies on, and its triangles cut into what is round: over the same size.
constexpr float sunk = 0.035F;

const Vector3 metalColour{0.16F, 0.17F, 0.19F};
const Vector3 dropColour{0.30F, 0.42F, 0.50F};

void requireOpenGl33() {
  if (epoxy_is_desktop_gl() && epoxy_gl_version() >= 33) return;
  throw std::runtime_error("the renderer needs OpenGL 3.3 core; this context is older");
}

/// A lamp above and beside the first camera, which stays there when the camera moves.
Vector3 lampOf(const Scenery& scenery) {
  const Vector3 forward = unit(scenery.viewDirection);
  Vector3 right = cross(forward, scenery.up);
  right = length(right) < 1e-3F ? perpendicular(scenery.up) : unit(right);
  const Vector3 level = cross(scenery.up, right);  // forward, without its slope
  return unit(scenery.up * 1.0F - right * 0.55F - level * 0.55F);
}

/// How far the eye is from what reaches to it, the grounds and the water [m].
float clearanceOf(const Scenery& scenery, const Vector3& eye) {
  float clearance = 1e30F;
  for (const Ground& ground : scenery.grounds) {
    clearance = std::min(clearance, std::abs(dot(ground.normal, eye) - ground.offset));
  }
  if (scenery.waterLevel) clearance = std::min(clearance, std::abs(dot(scenery.up, eye) - *scenery.waterLevel));
  return clearance;
}

/// Half of what a pixel is wide at a place that is seen in the middle of the picture [m].
float halfPixel(const View& view, const Vector3& place, int height) {
  const float tangent = std::tan(view.fieldOfView * 3.14159265F / 360);
  return tangent * length(place - view.eye) / static_cast<float>(height);
}

}  // namespace

class Renderer::Parts {
 public:
  Parts(const Scenery& scenery, const std::vector<ClothShape>& cloths);
  ~Parts();
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void draw(const Frame& frame, const View& view, const Area& area);
  void write(const std::string& left, const std::string& right, const Area& area);
  void writeHead(const std::string& text, const Area& area);

  ColourScale scale{Colouring::fabric};

 private:
  using Pieces = ShaderProgram::Pieces;

  void makePictureBlock();
  void makeColourMap();
  void makeSquare();

  void castShadows(const std::vector<Vector3>& points);
  void setPicture(const Frame& frame, const View& view, const Area& area);
  void setState() const;
  PictureBuffer::Part partWithEdges(const std::vector<Vector3>& points, const Area& area) const;
  void drawGround(const ShaderProgram& program, const Ground& ground, const ShadowMap::Footprint& where,
                  float behind) const;
  void drawGrounds() const;
  void drawSolids(const Frame& frame) const;
  void drawDrops(const Frame& frame);
  void drawCloths() const;
  void drawWater() const;

  const Scenery m_scenery;
  const Vector3 m_towardsLamp;
  std::vector<std::unique_ptr<ClothOnRods>> m_hangings;
  std::vector<std::unique_ptr<SolidMesh>> m_solids;
  SolidMesh m_drop;
  VertexArray m_square;
  VertexArray m_nothing;
  ShadowMap m_shadowMap;
  ShaderProgram m_caster, m_cloth, m_measured, m_solid, m_backdrop, m_shadedGround, m_ground, m_water;
  PictureBuffer m_buffer;
  Overlay m_overlay;
  GLuint m_pictureBuffer = 0;
  GLuint m_colourMap = 0;
  Extent m_extent;  // of the frame
  PictureUniforms m_uniforms;
  float m_behind = 0;  // what cloth may lie on is pushed back by this [depth]
  float m_size = 0;    // of all there is to see, from the first frame on [m]
};

Renderer::Parts::Parts(const Scenery& scenery, const std::vector<ClothShape>& cloths)
    : m_scenery(scenery),
      m_towardsLamp(lampOf(scenery)),
      m_drop(roundBall()),
      m_caster({embedded::common_glsl, embedded::caster_vert_glsl},
               {embedded::common_glsl, embedded::caster_frag_glsl}),
      m_cloth({embedded::common_glsl, embedded::cloth_vert_glsl},
              {embedded::common_glsl, embedded::light_glsl, embedded::cloth_light_glsl, embedded::cloth_frag_glsl}),
      m_measured(
          {embedded::common_glsl, embedded::cloth_vert_glsl},
          {embedded::common_glsl, embedded::light_glsl, embedded::cloth_light_glsl, embedded::measured_frag_glsl}),
      m_solid({embedded::common_glsl, embedded::solid_vert_glsl},
              {embedded::common_glsl, embedded::light_glsl, embedded::solid_frag_glsl}),
      m_backdrop({embedded::common_glsl, embedded::backdrop_vert_glsl},
                 {embedded::common_glsl, embedded::light_glsl, embedded::backdrop_glsl, embedded::backdrop_frag_glsl}),
      m_shadedGround({embedded::common_glsl, embedded::ground_vert_glsl},
                     {embedded::common_glsl, embedded::light_glsl, embedded::backdrop_glsl,
                      embedded::ground_shaded_glsl, embedded::ground_frag_glsl}),
      m_ground({embedded::common_glsl, embedded::ground_vert_glsl},
               {embedded::common_glsl, embedded::light_glsl, embedded::backdrop_glsl, embedded::ground_open_glsl,
                embedded::ground_frag_glsl}),
      m_water({embedded::common_glsl, embedded::ground_vert_glsl},
              {embedded::common_glsl, embedded::light_glsl, embedded::water_frag_glsl}) {
  for (const ClothShape& cloth : cloths) m_hangings.push_back(std::make_unique<ClothOnRods>(cloth));
  for (const Solid& solid : scenery.solids) m_solids.push_back(std::make_unique<SolidMesh>(solid));
  makePictureBlock();
  makeColourMap();
  makeSquare();
}

Renderer::Parts::~Parts() {
  glDeleteBuffers(1, &m_pictureBuffer);
  glDeleteTextures(1, &m_colourMap);
}

void Renderer::Parts::makePictureBlock() {
  glGenBuffers(1, &m_pictureBuffer);
  glBindBuffer(GL_UNIFORM_BUFFER, m_pictureBuffer);
  glBufferData(GL_UNIFORM_BUFFER, sizeof(PictureUniforms), nullptr, GL_DYNAMIC_DRAW);
  for (const ShaderProgram* program :
       {&m_cloth, &m_measured, &m_solid, &m_backdrop, &m_shadedGround, &m_ground, &m_water}) {
    program->bindBlock("Picture", pictureBlock);
    program->use();
    program->set("shadowMap", static_cast<int>(shadowUnit));
    program->set("colourMap", static_cast<int>(colourMapUnit));
  }
}

void Renderer::Parts::makeColourMap() {
  constexpr int steps = 256;
  std::vector<float> colours;
  for (int i = 0; i < steps; ++i) {
    const Rgb colour = mappedColour(static_cast<float>(i) / (steps - 1));
    colours.insert(colours.end(), colour.begin(), colour.end());
  }
  glGenTextures(1, &m_colourMap);
  glActiveTexture(GL_TEXTURE0 + colourMapUnit);
  glBindTexture(GL_TEXTURE_2D, m_colourMap);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, steps, 1, 0, GL_RGB, GL_FLOAT, colours.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
}

void Renderer::Parts::makeSquare() {
  m_square.addBuffer(0, {2});
  m_square.upload(0, {-1, -1, 1, -1, 1, 1, -1, 1});
  m_square.setTriangles({{0, 1, 2}, {0, 2, 3}});
}

void Renderer::Parts::castShadows(const std::vector<Vector3>& points) {
  m_shadowMap.fit(points, m_towardsLamp);
  m_shadowMap.begin();
  m_caster.use();
  m_caster.set("clipFromCaster", m_shadowMap.clipFromWorld());
  m_caster.set("behind", 0.0F);
  for (const auto& hanging : m_hangings) {
    hanging->drawCloth();
    hanging->drawBars();
  }
  m_caster.set("behind", m_shadowMap.depthStep(sunk * m_size));
  for (const auto& solid : m_solids) solid->draw();
  m_shadowMap.end();
}

void Renderer::Parts::setPicture(const Frame& frame, const View& view, const Area& area) {
  PictureUniforms& uniforms = m_uniforms;
  look(uniforms, view, static_cast<float>(area.width) / static_cast<float>(area.height), m_extent,
       clearanceOf(m_scenery, view.eye));
  uniforms.shadowFromWorld = m_shadowMap.mapFromWorld();
  uniforms.towardsLamp = {m_towardsLamp[0], m_towardsLamp[1], m_towardsLamp[2], 0};
  uniforms.up = {m_scenery.up[0], m_scenery.up[1], m_scenery.up[2], m_size};
  uniforms.forward[3] = static_cast<float>(frame.time);
  const float softness = shadowSoftness * m_size + 2 * m_shadowMap.width() / ShadowMap::texels;
  uniforms.shadow = {softness, softness / m_shadowMap.width(), 0, 0};
  glBindBuffer(GL_UNIFORM_BUFFER, m_pictureBuffer);
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof uniforms, &uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, pictureBlock, m_pictureBuffer);
  m_behind = depthStep(uniforms, m_extent, sunk * m_size);
}

/// The shaders give sRGB themselves, so that any framebuffer will do.
void Renderer::Parts::setState() const {
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  m_shadowMap.bind(shadowUnit);
  glActiveTexture(GL_TEXTURE0 + colourMapUnit);
  glBindTexture(GL_TEXTURE_2D, m_colourMap);
}

void Renderer::Parts::drawGround(const ShaderProgram& program, const Ground& ground, const ShadowMap::Footprint& where,
                                 float behind) const {
  program.use();
  program.set("behind", behind);
  program.set("normal", ground.normal);
  program.set("middle", where.middle);
  program.set("alongU", where.halfU);
  program.set("alongV", where.halfV);
  m_square.draw();
}

/// First where shadows may fall, then the rest, a little lower: looking into the shadow map everywhere would take a
/// third of a picture's time.
void Renderer::Parts::drawGrounds() const {
  const float reach = 30 * m_size;
  for (const Ground& ground : m_scenery.grounds) {
    if (dot(ground.normal, eyeOf(m_uniforms)) < ground.offset) continue;  // who is below the ground looks through it
    if (const auto shaded = m_shadowMap.footprintOn(ground)) drawGround(m_shadedGround, ground, *shaded, m_behind);
    const Vector3 middle = m_extent.middle - ground.normal * (dot(ground.normal, m_extent.middle) - ground.offset);
    const Vector3 u = perpendicular(ground.normal);
    drawGround(m_ground, ground, {middle, u * reach, cross(ground.normal, u) * reach}, 1.01F * m_behind);
  }
}

/// A film of water makes what is below it darker, by reflecting inside, and smooth.
void Renderer::Parts::drawSolids(const Frame& frame) const {
  m_solid.use();
  m_solid.set("behind", m_behind);
  for (std::size_t i = 0; i < m_solids.size(); ++i) {
    const float wet = frame.wetness.empty() ? 0 : frame.wetness[i];
    m_solid.set("albedo", m_scenery.solids[i].colour * (1 - 0.3F * wet));
    m_solid.set("roughness", 0.7F - 0.5F * wet);
    m_solids[i]->draw();
  }
  m_solid.set("behind", 0.0F);
  m_solid.set("albedo", metalColour);
  m_solid.set("roughness", 0.4F);
  for (const auto& hanging : m_hangings) hanging->drawBars();
}

void Renderer::Parts::drawDrops(const Frame& frame) {
  if (frame.drops.empty()) return;
  std::vector<float> places;
  for (const Drop& drop : frame.drops) {
    places.insert(places.end(), {drop.position[0], drop.position[1], drop.position[2], drop.radius});
  }
  m_solid.use();
  m_solid.set("behind", 0.0F);
  m_solid.set("albedo", dropColour);
  m_solid.set("roughness", 0.15F);
  m_drop.drawAt(places);
}

void Renderer::Parts::drawCloths() const {
  const ShaderProgram& program = scale.colouring() == Colouring::fabric ? m_cloth : m_measured;
  program.use();
  for (const auto& hanging : m_hangings) {
    const ClothShape& shape = hanging->shape();
    constexpr float threads = 128;  // real ones would be finer than pixels
    program.set("threadsPerMetre", threads / hanging->side());
    program.set("threadsPerLine", threads / 16);
    std::size_t first = 0;
    for (const auto& [look, triangles] : shape.parts) {
      program.set("dryColour", look.dryColour);
      program.set("wetColour", look.wetColour);
      program.set("roughness", look.dryRoughness, look.wetRoughness);
      hanging->drawCloth(first, triangles);
      first += triangles;
    }
  }
}

void Renderer::Parts::drawWater() const {
  if (!m_scenery.waterLevel) return;
  const Vector3& up = m_scenery.up;
  const Vector3 u = perpendicular(up);
  const float reach = 6 * m_size;
  const Vector3 middle = m_extent.middle + up * (*m_scenery.waterLevel - dot(up, m_extent.middle));
  m_water.use();
  m_water.set("behind", 0.0F);
  m_water.set("middle", middle);
  m_water.set("reach", reach);
  m_water.set("alongU", u * reach);
  m_water.set("alongV", cross(up, u) * reach);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  m_square.draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

/// Around all the points and somewhat more; the ground and the sky have no edges.
PictureBuffer::Part Renderer::Parts::partWithEdges(const std::vector<Vector3>& points, const Area& area) const {
  const PictureBuffer::Part all{0, 0, area.width, area.height};
  if (m_scenery.waterLevel) return all;
  float left = 1;
  float right = -1;
  float low = 1;
  float high = -1;
  for (const Vector3& point : points) {
    const auto [x, y, depth] = placeInPicture(m_uniforms, point);
    if (depth <= 0) return all;
    left = std::min(left, x);
    right = std::max(right, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  constexpr float margin = 0.05F;
  const auto pixel = [](float place, int count) {
    return static_cast<int>(std::round((0.5F + 0.5F * std::clamp(place, -1.0F, 1.0F)) * static_cast<float>(count)));
  };
  const int x = pixel(left - margin, area.width);
  const int y = pixel(low - margin, area.height);
  return {x, y, pixel(right + margin, area.width) - x, pixel(high + margin, area.height) - y};
}

void Renderer::Parts::draw(const Frame& frame, const View& view, const Area& area) {
  scale.include(frame);
  for (std::size_t i = 0; i < frame.poses.size(); ++i) m_solids[i]->update(posedSolid(m_scenery, frame, i));
  std::vector<Vector3> points = pointsOf(m_scenery, frame);
  for (std::size_t i = 0; i < m_hangings.size(); ++i) {
    m_hangings[i]->update(frame.cloths[i], scale, m_scenery.grounds, 1.4F * halfPixel(view, view.target, area.height));
    for (const Rod& rod : m_hangings[i]->rods()) points.insert(points.end(), {rod.from, rod.to});
  }
  m_extent = extentOf(points);
  if (m_size == 0) m_size = 2 * m_extent.radius;
  castShadows(points);
  setPicture(frame, view, area);
  m_buffer.begin(area.width, area.height);
  setState();
  drawCloths();  // the nearest first, so that what they hide is not painted
  drawSolids(frame);
  drawDrops(frame);
  drawGrounds();
  m_backdrop.use();
  m_nothing.drawVertices(3);
  drawWater();
  m_buffer.put(area.x, area.y, partWithEdges(points, area));
  if (scale.colouring() != Colouring::fabric) {
    drawColourBar(m_overlay, scale, static_cast<float>(area.width), static_cast<float>(area.height));
  }
}

void Renderer::Parts::write(const std::string& left, const std::string& right, const Area& area) {
  const auto width = static_cast<float>(area.width);
  const auto height = static_cast<float>(area.height);
  glViewport(area.x, area.y, area.width, area.height);
  m_overlay.setTextSize(textSizeFor(width, height));
  const float margin = 1.2F * m_overlay.textSize();
  const bool isRoomForBoth = m_overlay.widthOf(left + "  " + right) + 2 * margin < width;
  if (isRoomForBoth) m_overlay.addText(margin, height - margin, left, ink);
  m_overlay.addText(width - margin - m_overlay.widthOf(right), height - margin, right, ink);
  m_overlay.draw(width, height);
}

void Renderer::Parts::writeHead(const std::string& text, const Area& area) {
  const auto width = static_cast<float>(area.width);
  const auto height = static_cast<float>(area.height);
  glViewport(area.x, area.y, area.width, area.height);
  m_overlay.setTextSize(1.15F * textSizeFor(1.4F * width, height));
  m_overlay.addText(0.5F * (width - m_overlay.widthOf(text)), 1.9F * m_overlay.textSize(), text, ink);
  m_overlay.draw(width, height);
}

Renderer::Renderer(const Scenery& scenery, const std::vector<ClothShape>& cloths) {
  requireOpenGl33();
  m_parts = std::make_unique<Parts>(scenery, cloths);
}

Renderer::~Renderer() = default;

void Renderer::setColouring(Colouring colouring) { m_parts->scale = ColourScale(colouring); }

Colouring Renderer::colouring() const { return m_parts->scale.colouring(); }

void Renderer::includeInColourBar(const Frame& frame) { m_parts->scale.include(frame); }

void Renderer::draw(const Frame& frame, const View& view, const Area& area) { m_parts->draw(frame, view, area); }

void Renderer::write(const std::string& left, const std::string& right, const Area& area) {
  m_parts->write(left, right, area);
}

void Renderer::writeHead(const std::string& text, const Area& area) { m_parts->writeHead(text, area); }

}  // namespace pictures
