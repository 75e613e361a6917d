// SPDX-License-Identifier: Zlib
#include "command/pictures/HtmlPage.h"

#include "Embedded.h"
#include "command/pictures/OutputFile.h"
#include "command/pictures/PackedRun.h"
#include "command/pictures/PageJson.h"

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace pictures {
namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string smaller(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(&smaller[0]), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
  if (result != Z_OK) throw std::runtime_error("could not be compressed: out of memory");
  smaller.resize(size);
  return smaller;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U];
    }
  }
  return text;
}

void replaceAll(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::string escaped(std::string text) {
  replaceAll(text, "&", "&amp;");
  replaceAll(text, "<", "&lt;");
  return text;
}

nlohmann::json jsonOf(const std::vector<Series>& series) {
  nlohmann::json json = nlohmann::json::array();
  for (const Series& one : series) json.push_back({{"name", one.name}, {"unit", one.unit}, {"values", one.values}});
  return json;
}

/// All text that is not ASCII, and what could end the element that it is in, as escapes.
std::string scriptSafe(const nlohmann::json& json) {
  std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  replaceAll(text, "<", "\\u003c");
  return text;
}

std::string script() {
  std::string text;
  for (const std::string_view part : {embedded::math_js, embedded::unpack_js, embedded::camera_js, embedded::meshes_js,
                                      embedded::renderer_js, embedded::plots_js, embedded::player_js}) {
    text += part;
    text += '\n';
  }
  return text;
}

}  // namespace

void writeHtml(const FrameSequence& sequence, const std::string& path) {
  nlohmann::json head;
  const std::string bytes = packed(sequence, head);
  head["scenery"] = pageJson(sequence.scenery);
  head["series"] = jsonOf(sequence.series);
  head["view"] = pageJson(fitView(sequence.scenery, sequence.frames, pageAspect));
  head["shaders"] = pageShaders();
  std::string page(embedded::page_html);
  // From the end of the page to its start: a title may look like a place.
  const std::vector<std::pair<std::string_view, std::string>> parts{{"{{bytes}}", base64(deflated(bytes))},
                                                                    {"{{head}}", scriptSafe(head)},
                                                                    {"{{script}}", script()},
                                                                    {"{{style}}", std::string(embedded::page_css)},
                                                                    {"{{title}}", escaped(sequence.scenery.title)}};
  for (const auto& [place, text] : parts) page.replace(page.find(place), place.size(), text);
  writeFile(path, page);
}

}  // namespace pictures
