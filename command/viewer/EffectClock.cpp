// SPDX-License-Identifier: Zlib
#include "command/viewer/EffectClock.h"

#include <algorithm>

namespace viewer {

class EffectClock::Lap : public wetcloth::Effect {
 public:
  Lap(EffectClock& clock, Part part, wetcloth::Stage stage) : m_clock(clock), m_part(part), m_stage(stage) {}

  const char* name() const override { return "Lap"; }
  wetcloth::Stage stage() const override { return m_stage; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { m_clock.lap(m_part); }

 private:
  EffectClock& m_clock;
  Part m_part;
  wetcloth::Stage m_stage;
};

EffectClock::Part EffectClock::addPart() {
  m_now.push_back(0);
  m_averages.push_back(0);
  return m_now.size() - 1;
}

std::unique_ptr<wetcloth::Effect> EffectClock::endOf(Part part, wetcloth::Stage stage) {
  return std::make_unique<Lap>(*this, part, stage);
}

std::unique_ptr<wetcloth::Effect> EffectClock::beginning(wetcloth::Stage stage) {
  return std::make_unique<Lap>(*this, noPart, stage);
}

void EffectClock::beginStep() {
  std::fill(m_now.begin(), m_now.end(), 0.0);
  m_start = m_last = Clock::now();
}

void EffectClock::lap(Part part) {
  const Clock::time_point now = Clock::now();
  if (part != noPart) m_now[part] += std::chrono::duration<double, std::micro>(now - m_last).count();
  m_last = now;
}

void EffectClock::endStep() {
  average(std::chrono::duration<double, std::micro>(Clock::now() - m_start).count(), m_stepAverage);
  for (Part part = 0; part < m_now.size(); ++part) average(m_now[part], m_averages[part]);
  ++m_steps;
}

void EffectClock::clear() {
  std::fill(m_averages.begin(), m_averages.end(), 0.0);
  m_stepAverage = 0;
  m_steps = 0;
}

void EffectClock::average(double microseconds, double& average) const {
  constexpr double share = 1.0 / 30;
  average += (microseconds - average) * std::max(share, 1.0 / static_cast<double>(m_steps + 1));
}

}  // namespace viewer
