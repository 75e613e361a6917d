// SPDX-License-Identifier: Zlib
#include "web/WebScene.h"

#include "command/cli/Errors.h"
#include "command/pictures/PageJson.h"
#include "command/scene/SceneReader.h"

#include <array>
#include <cstddef>

namespace wetcloth_web {
namespace {

using emscripten::typed_memory_view;
using emscripten::val;
using nlohmann::json;

std::size_t toSize(int number) { return static_cast<std::size_t>(number); }

template <class T, std::size_t Count>
val flat(const std::vector<std::array<T, Count>>& tuples) {
  return val(typed_memory_view(Count * tuples.size(), tuples.empty() ? nullptr : tuples.front().data()));
}

val flat(const std::vector<float>& values) { return val(typed_memory_view(values.size(), values.data())); }

command::Scene read(const std::string& description, const std::string& name) {
  json parsed;
  try {
    parsed = json::parse(description);
  } catch (const json::exception& error) {
    throw command::InputError(command::onOneLine(name + ": " + error.what()));
  }
  return command::readScene(parsed, name);
}

json switchesOf(const viewer::LiveScene& live) {
  json switches = json::array();
  const auto& list = live.effects().list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    switches.push_back({{"key", list[i].key},
                        {"inScene", list[i].isInScene},
                        {"on", list[i].isOn},
                        {"waits", list[i].waitsForReset},
                        {"refusal", list[i].refusal},
                        {"microseconds", live.effects().microseconds(i)}});
  }
  return switches;
}

std::array<double, 3> plain(const btVector3& vector) {
  return {static_cast<double>(vector.x()), static_cast<double>(vector.y()), static_cast<double>(vector.z())};
}

}  // namespace

WebScene::WebScene(const std::string& description, const std::string& name) : m_live(read(description, name)) {
  look(false);
  for (std::size_t i = 0; i < m_live.cloths().size(); ++i) m_rods.emplace_back(m_live.cloths()[i], m_frame->cloths[i]);
}

std::string WebScene::run() const {
  json run{{"scenery", pictures::pageJson(m_live.scenery())},
           {"view", pictures::pageJson(pictures::fitView(m_live.scenery(), {*m_frame}, pictures::pageAspect))},
           {"shaders", pictures::pageShaders()},
           {"ranges", {{"saturation", {0, 1}}, {"stretch", {1, 1.1}}, {"speed", {0, 4}}}},
           {"cloths", json::array()},
           {"solids", json::array()}};
  for (const pictures::ClothShape& shape : m_live.cloths()) run["cloths"].push_back(pictures::pageJson(shape));
  for (const pictures::Solid& solid : m_live.scenery().solids) run["solids"].push_back({{"colour", solid.colour}});
  return run.dump();
}

val WebScene::triangles(int cloth) const { return flat(m_live.cloths()[toSize(cloth)].triangles); }
val WebScene::texture(int cloth) const { return flat(m_live.cloths()[toSize(cloth)].texture); }
val WebScene::solidVertices(int solid) const { return flat(m_live.scenery().solids[toSize(solid)].vertices); }
val WebScene::solidNormals(int solid) const { return flat(m_live.scenery().solids[toSize(solid)].normals); }
val WebScene::solidTriangles(int solid) const { return flat(m_live.scenery().solids[toSize(solid)].triangles); }

void WebScene::look(bool plain) {
  m_frame = &m_live.frame(plain ? viewer::Side::plainBullet : viewer::Side::wet);
  m_drops.clear();
  for (const pictures::Drop& drop : m_frame->drops) {
    m_drops.insert(m_drops.end(), drop.position.begin(), drop.position.end());
    m_drops.push_back(drop.radius);
  }
}

const pictures::ClothState& WebScene::cloth(int number) const { return m_frame->cloths[toSize(number)]; }
val WebScene::positions(int number) const { return flat(cloth(number).positions); }
val WebScene::saturation(int number) const { return flat(cloth(number).saturation); }
val WebScene::stretch(int number) const { return flat(cloth(number).stretch); }
val WebScene::speed(int number) const { return flat(cloth(number).speed); }
val WebScene::drops() const { return flat(m_drops); }

std::string WebScene::among() const {
  json among{{"poses", json::array()}, {"wetness", m_frame->wetness}, {"rods", json::array()}};
  for (const pictures::Pose& pose : m_frame->poses)
    among["poses"].push_back({{"place", pose.place}, {"turn", pose.turn}});
  for (std::size_t i = 0; i < m_rods.size(); ++i) {
    for (const pictures::Rod& rod : m_rods[i].at(m_frame->cloths[i], m_live.scenery().grounds)) {
      among["rods"].push_back({{"from", rod.from}, {"to", rod.to}, {"radius", rod.radius}});
    }
  }
  return among.dump();
}

std::string WebScene::state() const {
  const json state{{"time", m_live.time()},
                   {"water", m_live.waterHeld()},
                   {"saturation", m_live.meanSaturation()},
                   {"failure", m_live.failure()},
                   {"notice", m_live.notice()},
                   {"effects", switchesOf(m_live)},
                   {"commit", m_live.effects().commitMicroseconds()},
                   {"library", m_live.libraryMicroseconds()},
                   {"bullet", m_live.bulletMicroseconds()},
                   {"solver", command::nameOf(m_live.solver())},
                   {"waits", m_live.waitsForReset()},
                   {"wind", plain(m_live.wind())},
                   {"windVaries", m_live.windVaries()},
                   {"rain", m_live.rainFlux()},
                   {"exposure", m_live.exposure()}};
  return state.dump(-1, ' ', false, json::error_handler_t::replace);
}

double WebScene::grab(float originX, float originY, float originZ, float directionX, float directionY, float directionZ,
                      bool plain) {
  const btVector3 origin(originX, originY, originZ);
  const btVector3 direction = btVector3(directionX, directionY, directionZ).normalized();
  if (!m_live.grab({origin, direction}, plain ? viewer::Side::plainBullet : viewer::Side::wet)) return -1;
  return static_cast<double>((m_live.grip()->node().m_x - origin).dot(direction));
}

void WebScene::dragTo(float x, float y, float z) { m_live.dragTo(btVector3(x, y, z)); }

}  // namespace wetcloth_web
