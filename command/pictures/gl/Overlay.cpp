// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/Overlay.h"

#include "Embedded.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace pictures {
namespace {

constexpr int firstCharacter = 32;
constexpr int characterCount = 95;
constexpr std::size_t floatsPerVertex = 8;
constexpr GLuint atlasUnit = 2;
// A rectangle is painted with this texel of the atlas, which is full.
constexpr float fullTexel = 1.5F;
constexpr int fullTexels = 4;

/// Of a character of UTF-8, all bytes but the first.
bool isContinuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

Overlay::Overlay()
    : m_program({embedded::common_glsl, embedded::overlay_vert_glsl},
                {embedded::common_glsl, embedded::overlay_frag_glsl}) {
  m_vertices.addBuffer(0, {2, 2, 4});
  glGenTextures(1, &m_atlas);
  setTextSize(m_textSize);
}

Overlay::~Overlay() { glDeleteTextures(1, &m_atlas); }

void Overlay::setTextSize(float pixels) {
  m_textSize = std::round(pixels);
  if (static_cast<int>(m_textSize) != m_baked) bake(static_cast<int>(m_textSize));
}

void Overlay::bake(int pixels) {
  m_baked = pixels;
  const int side = 64 + 16 * pixels;
  std::vector<std::uint8_t> coverage(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::vector<stbtt_packedchar> packed(characterCount);
  stbtt_pack_context context;
  const int rowsBelow = side - fullTexels;
  stbtt_PackBegin(&context, coverage.data() + static_cast<std::size_t>(fullTexels) * static_cast<std::size_t>(side),
                  side, rowsBelow, side, 1, nullptr);
  stbtt_PackSetOversampling(&context, 2, 1);
  stbtt_PackFontRange(&context, reinterpret_cast<const unsigned char*>(embedded::DejaVuSansSubset_ttf.data()), 0,
                      static_cast<float>(pixels), firstCharacter, characterCount, packed.data());
  stbtt_PackEnd(&context);
  for (std::ptrdiff_t row = 0; row < fullTexels; ++row) std::fill_n(coverage.begin() + row * side, fullTexels, 255);
  m_glyphs.clear();
  const float scale = 1 / static_cast<float>(side);
  for (const stbtt_packedchar& glyph : packed) {
    m_glyphs.push_back({glyph.xoff, glyph.yoff, glyph.xoff2, glyph.yoff2, glyph.x0 * scale,
                        (glyph.y0 + fullTexels) * scale, glyph.x1 * scale, (glyph.y1 + fullTexels) * scale,
                        glyph.xadvance});
  }
  const float full = fullTexel * scale;
  m_glyphs.push_back({0, 0, 0, 0, full, full, full, full, 0});
  glActiveTexture(GL_TEXTURE0 + atlasUnit);
  glBindTexture(GL_TEXTURE_2D, m_atlas);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, side, side, 0, GL_RED, GL_UNSIGNED_BYTE, coverage.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

/// The font has ASCII alone; what else there is becomes a question mark.
const Overlay::Glyph& Overlay::glyphOf(char character) const {
  const int code = static_cast<unsigned char>(character);
  const bool isKnown = code >= firstCharacter && code < firstCharacter + characterCount;
  return m_glyphs[static_cast<std::size_t>((isKnown ? code : '?') - firstCharacter)];
}

float Overlay::widthOf(const std::string& text) const {
  float width = 0;
  for (const char character : text) {
    if (!isContinuation(character)) width += glyphOf(character).advance;
  }
  return width;
}

void Overlay::addQuadrilateral(const std::array<float, 4>& place, const std::array<float, 4>& inAtlas,
                               const Tint& tint) {
  for (const auto& [x, y] : {std::array{0, 1}, {2, 1}, {2, 3}, {0, 1}, {2, 3}, {0, 3}}) {
    const auto across = static_cast<std::size_t>(x);
    const auto down = static_cast<std::size_t>(y);
    m_corners.insert(m_corners.end(), {place[across], place[down], inAtlas[across], inAtlas[down]});
    m_corners.insert(m_corners.end(), tint.begin(), tint.end());
  }
}

void Overlay::addRectangle(float left, float top, float width, float height, const Tint& tint) {
  const Glyph& full = m_glyphs.back();
  addQuadrilateral({left, top, left + width, top + height}, {full.u0, full.v0, full.u1, full.v1}, tint);
}

void Overlay::addText(float left, float baseline, const std::string& text, const Tint& tint) {
  float pen = left;
  baseline = std::round(baseline);
  for (const char character : text) {
    if (isContinuation(character)) continue;
    const Glyph& glyph = glyphOf(character);
    addQuadrilateral({pen + glyph.left, baseline + glyph.top, pen + glyph.right, baseline + glyph.bottom},
                     {glyph.u0, glyph.v0, glyph.u1, glyph.v1}, tint);
    pen += glyph.advance;
  }
}

void Overlay::draw(float areaWidth, float areaHeight) {
  if (m_corners.empty()) return;
  m_vertices.upload(0, m_corners);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  m_program.use();
  m_program.set("areaSize", areaWidth, areaHeight);
  m_program.set("atlas", static_cast<int>(atlasUnit));
  glActiveTexture(GL_TEXTURE0 + atlasUnit);
  glBindTexture(GL_TEXTURE_2D, m_atlas);
  m_vertices.drawVertices(m_corners.size() / floatsPerVertex);
  glDisable(GL_BLEND);
  m_corners.clear();
}

}  // namespace pictures
