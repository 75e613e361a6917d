// SPDX-License-Identifier: Zlib
// What the page's scripts may call. Nothing that it calls throws: error() says what went wrong in the last call, on one
// line, or nothing.
#include "web/WebScene.h"

#include <emscripten/bind.h>

#include <exception>
#include <memory>
#include <string>

namespace wetcloth_web {
namespace {

std::string lastError;

template <class Action>
void attempt(const Action& action) {
  lastError.clear();
  try {
    action();
  } catch (const std::exception& error) {
    lastError = error.what();
  }
}

/// Null when the scene is refused.
std::unique_ptr<WebScene> open(const std::string& description, const std::string& name) {
  std::unique_ptr<WebScene> scene;
  attempt([&] { scene = std::make_unique<WebScene>(description, name); });
  return scene;
}

}  // namespace

EMSCRIPTEN_BINDINGS(wetcloth) {
  using emscripten::optional_override;
  emscripten::function("open", &open);
  emscripten::function("error", optional_override([] { return lastError; }));
  emscripten::class_<WebScene>("Scene")
      .function("run", &WebScene::run)
      .function("triangles", &WebScene::triangles)
      .function("texture", &WebScene::texture)
      .function("solidVertices", &WebScene::solidVertices)
      .function("solidNormals", &WebScene::solidNormals)
      .function("solidTriangles", &WebScene::solidTriangles)
      .function("look", &WebScene::look)
      .function("positions", &WebScene::positions)
      .function("saturation", &WebScene::saturation)
      .function("stretch", &WebScene::stretch)
      .function("speed", &WebScene::speed)
      .function("drops", &WebScene::drops)
      .function("among", &WebScene::among)
      .function("state", &WebScene::state)
      .function("grab", &WebScene::grab)
      .function("dragTo", &WebScene::dragTo)
      .function("release", optional_override([](WebScene& scene) { scene.live().release(); }))
      .function("advance", optional_override([](WebScene& scene, double seconds) {
                  attempt([&] { scene.live().advance(seconds); });
                }))
      .function("step", optional_override([](WebScene& scene) { attempt([&] { scene.live().step(); }); }))
      .function("reset", optional_override([](WebScene& scene) { attempt([&] { scene.live().reset(); }); }))
      .function("restore", optional_override([](WebScene& scene) { attempt([&] { scene.live().restore(); }); }))
      .function("setPaused", optional_override([](WebScene& scene, bool paused) { scene.live().setPaused(paused); }))
      .function("setCompared", optional_override([](WebScene& scene, bool compared) {
                  attempt([&] { scene.live().setCompared(compared); });
                }))
      .function("turnEffect", optional_override([](WebScene& scene, unsigned index, bool on) {
                  attempt([&] { scene.live().turnEffect(index, on); });
                }))
      .function("setWind", optional_override([](WebScene& scene, float x, float y, float z) {
                  attempt([&] { scene.live().setWind(btVector3(x, y, z)); });
                }))
      .function("setRain", optional_override(
                               [](WebScene& scene, double flux) { attempt([&] { scene.live().setRainFlux(flux); }); }))
      .function("setExposure", optional_override([](WebScene& scene, double exposure) {
                  attempt([&] { scene.live().setExposure(exposure); });
                }))
      .function("setFabric", optional_override([](WebScene& scene, const std::string& preset) {
                  attempt([&] { scene.live().setFabric(preset); });
                }))
      .function("setSolver", optional_override([](WebScene& scene, const std::string& solver) {
                  attempt([&] { scene.live().setSolver(command::valueOf(command::solverNames(), solver)); });
                }));
}

}  // namespace wetcloth_web
