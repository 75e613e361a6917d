// SPDX-License-Identifier: Zlib
#include "command/viewer/Panel.h"

#include "command/viewer/PlainVector.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace viewer {
namespace {

const ImVec4 warning(1.0F, 0.65F, 0.35F, 1);
const ImVec4 faint(0.62F, 0.65F, 0.70F, 1);

constexpr double secondsPerHour = 3600;

template <class... Values>
std::string text(const char* format, Values... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// "wet_friction" as "wet friction".
std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

void textAtRight(const std::string& line) {
  ImGui::SameLine();
  const float left = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(line.c_str()).x;
  ImGui::SetCursorPosX(std::max(left, ImGui::GetCursorPosX()));
  ImGui::TextUnformatted(line.c_str());
}

void row(const std::string& name, const std::string& value) {
  ImGui::TextUnformatted(name.c_str());
  textAtRight(value);
}

void wrapped(const ImVec4& colour, const std::string& line) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", line.c_str());
  ImGui::PopStyleColor();
}

std::string microseconds(double value) { return value < 9.95 ? text("%.1f us", value) : text("%.0f us", value); }

void plot(const char* name, const History& history, float low, float high, const std::string& latest) {
  row(name, latest);
  const auto valueAt = [](void* data, int index) {
    return static_cast<const History*>(data)->at(static_cast<std::size_t>(index));
  };
  History copy = history;  // ImGui wants something that it could change
  ImGui::PushItemWidth(-1);
  ImGui::PlotLines((std::string("##") + name).c_str(), valueAt, &copy, static_cast<int>(history.size()), 0, nullptr,
                   low, high, ImVec2(0, 2.2F * ImGui::GetTextLineHeight()));
  ImGui::PopItemWidth();
}

float highestOf(const History& history) {
  float highest = 0;
  for (std::size_t age = 0; age < history.size(); ++age) highest = std::max(highest, history.at(age));
  return highest;
}

}  // namespace

void Panel::noteFrame(double seconds) { m_frameTimes.add(1e3 * seconds); }

double Panel::framesPerSecond() const {
  const std::size_t count = std::min<std::size_t>(m_frameTimes.size(), 30);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += static_cast<double>(m_frameTimes.at(m_frameTimes.size() - 1 - i));
  return sum > 0 ? 1e3 * static_cast<double>(count) / sum : 0;
}

void Panel::draw(LiveScene& live, ViewSettings& settings, float left, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(left, 0));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  drawTime(live, settings);
  drawColourings(settings);
  if (ImGui::CollapsingHeader("Effects", ImGuiTreeNodeFlags_DefaultOpen)) drawEffects(live);
  if (ImGui::CollapsingHeader("Plots", ImGuiTreeNodeFlags_DefaultOpen)) drawPlots(live);
  if (ImGui::CollapsingHeader("Levers", ImGuiTreeNodeFlags_DefaultOpen)) drawLevers(live);
  ImGui::End();
}

void Panel::drawTime(LiveScene& live, ViewSettings& settings) {
  row(live.scene().name, text("%.2f s", live.time()));
  ImGui::PushStyleColor(ImGuiCol_Text, faint);
  row(command::nameOf(live.scene().world) + ", " + command::nameOf(command::ownPrecision),
      text("%.0f pictures/s", framesPerSecond()));
  ImGui::PopStyleColor();
  if (ImGui::Button(live.isPaused() ? "Go on" : "Pause")) live.setPaused(!live.isPaused());
  ImGui::SameLine();
  if (ImGui::Button("Step")) live.step();
  ImGui::SameLine();
  if (ImGui::Button("Reset")) live.reset();
  ImGui::SameLine();
  if (ImGui::Button("Scene's own")) live.restore();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Reset, with all settings as the scene has them");
  ImGui::Checkbox("slow motion", &settings.slowMotion);
  ImGui::SameLine();
  bool compared = live.isCompared();
  if (ImGui::Checkbox("plain Bullet beside it", &compared)) live.setCompared(compared);
  if (!live.failure().empty()) wrapped(warning, live.failure());
  if (!live.notice().empty()) wrapped(warning, live.notice());
}

void Panel::drawColourings(ViewSettings& settings) {
  using pictures::Colouring;
  static const std::array<std::pair<const char*, Colouring>, 4> choices{{{"fabric", Colouring::fabric},
                                                                         {"saturation", Colouring::saturation},
                                                                         {"stretch", Colouring::stretch},
                                                                         {"speed", Colouring::speed}}};
  ImGui::Spacing();
  for (const auto& [name, colouring] : choices) {
    if (ImGui::RadioButton(name, settings.colouring == colouring)) settings.colouring = colouring;
    if (colouring != Colouring::speed) ImGui::SameLine();
  }
  ImGui::Spacing();
}

void Panel::drawEffects(LiveScene& live) {
  const auto& effects = live.effects().list();
  const auto drawThose = [&](bool inScene) {
    for (std::size_t i = 0; i < effects.size(); ++i) {
      if (effects[i].isInScene == inScene) drawEffect(live, i);
    }
  };
  drawThose(true);
  if (ImGui::TreeNodeEx("more than the scene names", ImGuiTreeNodeFlags_NoTreePushOnOpen)) drawThose(false);
  ImGui::Separator();
  drawCosts(live);
}

void Panel::drawEffect(LiveScene& live, std::size_t index) {
  const EffectSwitches::Switch& effect = live.effects().list()[index];
  bool on = effect.isOn;
  const bool turned = ImGui::Checkbox(words(effect.key).c_str(), &on);
  if (effect.isOn) textAtRight(microseconds(live.effects().microseconds(index)));
  if (turned) live.turnEffect(index, on);
  if (effect.waitsForReset) wrapped(warning, "from the next reset on (R)");
  if (!effect.refusal.empty()) wrapped(warning, effect.refusal);
}

void Panel::drawCosts(const LiveScene& live) {
  const double library = live.libraryMicroseconds();
  const double bullet = live.bulletMicroseconds();
  row("masses and links", microseconds(live.effects().commitMicroseconds()));
  row("the library in all", microseconds(library));
  row(live.scene().clothSolver ? "Bullet's step, on ours" : "Bullet's own step", microseconds(bullet));
  row("the library on top", bullet > 0 ? text("%.1f %%", 100 * library / bullet) : "");
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Time on the clock for one step of the scene, %d of Bullet's,\nover the last half second or so",
                      live.substeps());
  }
}

void Panel::drawLevers(LiveScene& live) {
  ImGui::PushItemWidth(-0.34F * ImGui::GetWindowWidth());
  drawWeather(live);
  drawSolver(live);
  drawFabric(live);
  drawQuality(live);
  ImGui::PopItemWidth();
  if (!m_refusal.empty()) wrapped(warning, m_refusal);
}

/// A lever of an effect that is off is there, but does not move.
void Panel::drawWeather(LiveScene& live) {
  const auto lever = [&](const char* effect, const auto& draw) {
    ImGui::BeginDisabled(!live.isOn(effect));
    try {
      if (draw()) m_refusal.clear();
    } catch (const std::invalid_argument& refused) {
      m_refusal = refused.what();
    }
    ImGui::EndDisabled();
  };
  lever("wind", [&] { return drawWind(live); });
  lever("absorption", [&] { return drawExposure(live); });
  lever("rain", [&] { return drawRain(live); });
}

bool Panel::drawWind(LiveScene& live) {
  std::array<float, 3> velocity = plainVector(live.wind());
  const char* const name = live.windVaries() ? "wind, gusty" : "wind [m/s]";
  if (!ImGui::SliderFloat3(name, velocity.data(), -15, 15, "%.1f")) return false;
  live.setWind(bulletVector(velocity));
  return true;
}

bool Panel::drawExposure(LiveScene& live) {
  float exposure = static_cast<float>(live.exposure());
  const char* const name = live.exposureVaries() ? "exposed, in parts" : "exposure";
  if (!ImGui::SliderFloat(name, &exposure, 0, 1, "%.2f")) return false;
  live.setExposure(static_cast<double>(exposure));
  return true;
}

bool Panel::drawRain(LiveScene& live) {
  float flux = static_cast<float>(secondsPerHour * live.rainFlux());
  const bool harder = ImGui::SliderFloat("rain [mm/h]", &flux, 0, 1000, "%.0f", ImGuiSliderFlags_Logarithmic);
  if (harder) live.setRainFlux(static_cast<double>(flux) / secondsPerHour);
  std::array<float, 3> direction = plainVector(live.rainDirection());
  const bool turned = ImGui::SliderFloat3("rain falls to", direction.data(), -1, 1, "%.2f");
  if (turned) live.setRainDirection(bulletVector(direction));
  return harder || turned;
}

void Panel::drawSolver(LiveScene& live) {
  ImGui::BeginDisabled(live.scene().world == command::WorldKind::deformable);
  if (ImGui::BeginCombo("solver", command::nameOf(live.solver()).c_str())) {
    for (const auto& [name, solver] : command::solverNames()) {
      if (ImGui::Selectable(name.c_str(), live.solver() == solver)) live.setSolver(solver);
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
}

void Panel::drawFabric(LiveScene& live) {
  const char* const own = "the scene's own";
  if (ImGui::BeginCombo("fabric", live.fabric().empty() ? own : words(live.fabric()).c_str())) {
    if (ImGui::Selectable(own, live.fabric().empty())) live.setFabric("");
    for (const wetcloth::Fabric& fabric : wetcloth::Fabric::presets()) {
      if (ImGui::Selectable(words(fabric.name).c_str(), live.fabric() == fabric.name)) live.setFabric(fabric.name);
    }
    ImGui::EndCombo();
  }
  if (live.waitsForReset()) wrapped(warning, "from the next reset on (R)");
}

void Panel::drawQuality(LiveScene& live) {
  int substeps = live.substeps();
  if (ImGui::SliderInt("substeps", &substeps, 1, 32)) live.setSubsteps(substeps);
  int iterations = live.iterations();
  if (ImGui::SliderInt("iterations", &iterations, 1, 100)) live.setIterations(iterations);
}

void Panel::drawPlots(const LiveScene& live) {
  const double water = live.waterHeld();
  plot("water held", live.waterHistory(), 0, std::max(1e-6F, 1.05F * highestOf(live.waterHistory())),
       water < 1 ? text("%.1f g", 1e3 * water) : text("%.2f kg", water));
  plot("mean saturation", live.saturationHistory(), 0, 1, text("%.1f %%", 100 * live.meanSaturation()));
  plot("time of a picture", m_frameTimes, 0, std::max(20.0F, highestOf(m_frameTimes)),
       text("%.1f ms", static_cast<double>(m_frameTimes.latest())));
}

}  // namespace viewer
