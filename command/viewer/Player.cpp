// SPDX-License-Identifier: Zlib
#include "command/viewer/Player.h"

#include "command/viewer/MouseHand.h"
#include "command/viewer/OrbitCamera.h"
#include "command/viewer/Panel.h"
#include "command/viewer/PlainVector.h"
#include "command/viewer/ViewLayout.h"
#include "command/viewer/Window.h"

#include "command/cli/Errors.h"
#include "command/cli/StagedOutput.h"
#include "command/pictures/PngFile.h"
#include "command/pictures/gl/Renderer.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace viewer {
namespace {

using pictures::Colouring;

std::string nameOf(Colouring colouring) {
  switch (colouring) {
    case Colouring::saturation: return "saturation";
    case Colouring::stretch: return "stretch";
    case Colouring::speed: return "speed";
    case Colouring::fabric: break;
  }
  return "fabric";
}

constexpr double comparisonZoom = 1.5;
constexpr double roomToMove = 1.2;         // around what is there at first
constexpr double stillPictureTime = 0.05;  // between pictures of what stands still [s]; widgets need some to answer

constexpr const char* keyHelp =
    "space pause    N or . one step    R reset    S slow motion    C compare with plain Bullet    H hide    P picture  "
    "  "
    "Esc quit    1 fabric    2 saturation    3 stretch    4 speed    drag the cloth to pull it    drag elsewhere to "
    "orbit    right drag to move    wheel to zoom";

/// "wetcloth_0001.png", the first of them that is not there.
std::string unusedPictureName() {
  for (int number = 1;; ++number) {
    char name[40];
    std::snprintf(name, sizeof name, "wetcloth_%04d.png", number);
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) return name;
  }
}

constexpr ImGuiWindowFlags labelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoFocusOnAppearing;

void drawLabel(const char* name, const std::string& text, double left, double top) {
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(left), static_cast<float>(top)));
  ImGui::SetNextWindowBgAlpha(0.6F);
  ImGui::Begin(name, nullptr, labelFlags);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

/// Along the lower edge of the scene.
void drawHelp(const ViewLayout& layout) {
  const float width = static_cast<float>(layout.sceneWidth());
  ImGui::SetNextWindowPos(ImVec2(0, static_cast<float>(layout.height)), ImGuiCond_Always, ImVec2(0, 1));
  ImGui::SetNextWindowSize(ImVec2(width, 0));
  ImGui::SetNextWindowBgAlpha(0.6F);
  ImGui::Begin("keys", nullptr, labelFlags & ~ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextWrapped("%s", keyHelp);
  ImGui::End();
}

/// Height of the highest level ground.
std::optional<double> floorOf(const pictures::Scenery& scenery) {
  std::optional<double> floor;
  for (const pictures::Ground& ground : scenery.grounds) {
    const double cosine = static_cast<double>(bulletVector(ground.normal).dot(bulletVector(scenery.up)));
    const double height = static_cast<double>(ground.offset);
    if (cosine > 0.99 && (!floor || height > *floor)) floor = height;
  }
  return floor;
}

/// The first state, and where the scene will take cloths by their pins.
std::vector<pictures::Frame> framesToFit(const command::Scene& scene, const pictures::Frame& first) {
  std::vector<pictures::Frame> frames{first};
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    if (!scene.cloths[i].motion) continue;
    for (const btVector3& offset : scene.cloths[i].motion->offsets) {
      pictures::Frame moved = first;
      for (pictures::Vector3& place : moved.cloths[i].positions) place = plainVector(bulletVector(place) + offset);
      frames.push_back(std::move(moved));
    }
  }
  return frames;
}

/// The window, the scene in it, and what keys and mouse do.
class Player {
 public:
  Player(LiveScene& live, const PlayerOptions& options)
      : m_live(live),
        m_options(options),
        m_window("wetcloth: " + live.scene().name, options.width, options.height),
        m_renderer(live.scenery(), live.cloths()),
        m_camera(fittedView()),
        m_fitsComparison(live.isCompared()) {
    m_camera.zoom(roomToMove);
    if (const auto floor = floorOf(live.scenery())) m_camera.stayAbove(*floor);
  }

  PlayerReport run();

 private:
  void takeKey(const std::string& key);
  void moveTime();
  void draw();
  void drawOverScene();
  void drawGrip();
  void savePicture(const std::string& file);
  void fitComparison();
  pictures::View fittedView();
  ViewLayout layout() const;

  LiveScene& m_live;
  PlayerOptions m_options;
  Window m_window;
  ViewSettings m_settings;
  pictures::Renderer m_renderer;
  OrbitCamera m_camera;
  bool m_fitsComparison;
  MouseHand m_hand;
  Panel m_panel;
  int m_frames = 0;
  bool m_wantsPicture = false;
  double m_lastTime = 0;
};

PlayerReport Player::run() {
  const double start = m_lastTime = m_window.time();
  while (!m_window.isClosed() && (!m_options.frames || m_frames < *m_options.frames)) {
    m_window.beginPicture(m_live.isPaused() && !m_options.frames ? stillPictureTime : 0);
    for (const std::string& key : m_window.keys()) takeKey(key);
    fitComparison();
    m_hand.take(m_live, m_camera, layout());
    moveTime();
    draw();
    if (m_wantsPicture) savePicture(unusedPictureName());
    m_wantsPicture = false;
    const bool isLast = m_window.isClosed() || (m_options.frames && m_frames + 1 >= *m_options.frames);
    if (isLast && !m_options.lastPicture.empty()) pictures::writePng(m_options.lastPicture, m_window.read());
    m_window.show();
    ++m_frames;
  }
  const double seconds = m_window.time() - start;
  return {m_frames, seconds > 0 ? m_frames / seconds : 0, m_hand.drags(), nameOf(m_settings.colouring),
          m_settings.slowMotion};
}

void Player::takeKey(const std::string& key) {
  m_settings.message.clear();
  if (key == "space") m_live.setPaused(!m_live.isPaused());
  if (key == "n" || key == ".") m_live.step();
  if (key == "r") m_live.reset();
  if (key == "s") m_settings.slowMotion = !m_settings.slowMotion;
  if (key == "c") m_live.setCompared(!m_live.isCompared());
  if (key == "1") m_settings.colouring = Colouring::fabric;
  if (key == "2") m_settings.colouring = Colouring::saturation;
  if (key == "3") m_settings.colouring = Colouring::stretch;
  if (key == "4") m_settings.colouring = Colouring::speed;
  if (key == "h") m_settings.panelShown = !m_settings.panelShown;
  if (key == "p") m_wantsPicture = true;
  if (key == "escape") m_window.close();
}

/// With a number of pictures, what they show must not depend on how fast they are drawn.
void Player::moveTime() {
  const double now = m_window.time();
  if (m_frames > 0) m_panel.noteFrame(now - m_lastTime);
  m_live.setTimeScale(m_settings.slowMotion ? slowMotionScale : 1);
  if (!m_options.frames) {
    m_live.advance(now - m_lastTime);
  } else if (!m_live.isPaused()) {
    m_live.step();
  }
  m_lastTime = now;
}

void Player::draw() {
  const ViewLayout now = layout();
  m_renderer.setColouring(m_settings.colouring);
  if (now.isCompared) {
    m_renderer.draw(m_live.frame(Side::plainBullet), m_camera.view(), now.areaOf(Side::plainBullet));
  }
  m_renderer.draw(m_live.frame(Side::wet), m_camera.view(), now.areaOf(Side::wet));
  drawOverScene();
  if (now.panelWidth > 0) {
    m_panel.draw(m_live, m_settings, static_cast<float>(now.sceneWidth()), static_cast<float>(now.panelWidth),
                 static_cast<float>(now.height));
  }
  m_window.drawWidgets();
}

void Player::drawOverScene() {
  const ViewLayout now = layout();
  const double margin = 10;
  if (now.isCompared) {
    drawLabel("left", "plain Bullet", margin, margin);
    drawLabel("right", "wet", now.leftOf(Side::wet) + margin, margin);
  }
  drawGrip();
  if (!m_settings.message.empty()) drawLabel("message", m_settings.message, margin, 5 * margin);
  if (m_settings.panelShown) drawHelp(now);
}

void Player::drawGrip() {
  if (m_live.grip() == nullptr) return;
  const ViewLayout now = layout();
  const Side side = m_live.grippedSide();
  const auto node = m_camera.project(m_live.grip()->node().m_x, now.aspect());
  const auto goal = m_camera.project(m_live.grip()->goal(), now.aspect());
  if (!node || !goal) return;
  const auto place = [&](const std::array<double, 2>& point) {
    const auto [x, y] = now.inWindow(point, side);
    return ImVec2(static_cast<float>(x), static_cast<float>(y));
  };
  ImDrawList* const list = ImGui::GetBackgroundDrawList();
  const ImU32 colour = IM_COL32(255, 170, 60, 255);
  list->AddLine(place(*node), place(*goal), colour, 2);
  list->AddCircleFilled(place(*node), 4, colour);
  list->AddCircle(place(*goal), 7, colour, 0, 2);
}

void Player::savePicture(const std::string& file) {
  try {
    command::StagedOutput output(file, file, command::StagedOutput::Kind::file);
    pictures::writePng(output.path(), m_window.read());
    output.commit();
    m_settings.message = "picture in " + file;
  } catch (const std::runtime_error& failed) {
    m_settings.message = failed.what();
  }
}

/// Half as wide a picture has to be of the same things.
void Player::fitComparison() {
  if (m_live.isCompared() == m_fitsComparison) return;
  m_fitsComparison = m_live.isCompared();
  m_camera.zoom(m_fitsComparison ? comparisonZoom : 1 / comparisonZoom);
}

pictures::View Player::fittedView() {
  const auto aspect = static_cast<float>(layout().aspect());
  return pictures::fitView(m_live.scenery(), framesToFit(m_live.scene(), m_live.frame(Side::wet)), aspect);
}

ViewLayout Player::layout() const {
  ViewLayout layout;
  layout.pixelsPerUnit = m_window.pixelsPerUnit();
  layout.width = m_window.width() / layout.pixelsPerUnit;
  layout.height = std::max(1, m_window.height()) / layout.pixelsPerUnit;  // a hidden window has none
  layout.panelWidth = m_settings.panelShown ? Panel::usualWidth * m_window.textScale() : 0;
  layout.isCompared = m_live.isCompared();
  return layout;
}

}  // namespace

void requirePlayer() {}

PlayerReport play(LiveScene& live, const PlayerOptions& options) {
  try {
    return Player(live, options).run();
  } catch (const command::RunError&) {
    throw;
  } catch (const std::runtime_error& failed) {
    throw command::RunError("wetcloth: " + command::onOneLine(failed.what()));
  }
}

}  // namespace viewer
