// SPDX-License-Identifier: Zlib
#include "command/reality/FallingSheet.h"

#include "command/accuracy/Specimen.h"

#include <cmath>

namespace reality {
namespace {

constexpr double sheetStep = 1. / 240;  // [s]
constexpr double longestFall = 60;      // a search may ask for anything [s]

/// The sheet in Bullet's world.
class FallRun {
 public:
  explicit FallRun(const FallingSheet& sheet) : m_specimen(settingsOf(sheet)) {
    wetcloth::Wind::Parameters air;
    air.dragCoefficient = sheet.dragCoefficient;
    m_specimen.cloth().add<wetcloth::Wind>(air);
  }

  void advance() {
    m_specimen.substep(sheetStep);
    ++m_steps;
  }
  double time() const { return m_steps * sheetStep; }
  double speed() { return -static_cast<double>(m_specimen.body().m_nodes[0].m_v.y()); }
  double fallen() { return -static_cast<double>(m_specimen.body().m_nodes[0].m_x.y()); }

 private:
  static accuracy::Specimen::Settings settingsOf(const FallingSheet& sheet) {
    accuracy::Specimen::Settings settings;
    settings.patch = accuracy::levelSquare(std::sqrt(sheet.area), 2, sheet.arealDensity);
    return settings;
  }

  accuracy::Specimen m_specimen;
  int m_steps = 0;
};

}  // namespace

double terminalSpeedOf(const FallingSheet& sheet) {
  constexpr double steady = 1e-5;  // change of the speed in a step, of the speed
  FallRun run(sheet);
  double before = 0;
  do {
    before = run.speed();
    run.advance();
  } while (run.speed() - before > steady * run.speed() && run.time() < longestFall);
  return run.speed();
}

double fallTimeOf(const FallingSheet& sheet, double height) {
  FallRun run(sheet);
  double before = 0;
  while (run.fallen() < height && run.time() < longestFall) {
    before = run.fallen();
    run.advance();
  }
  return run.time() - sheetStep * (run.fallen() - height) / (run.fallen() - before);
}

}  // namespace reality
