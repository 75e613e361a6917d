// SPDX-License-Identifier: Zlib
#include "command/render/SampleRun.h"

#include "command/cli/Errors.h"
#include "command/cli/Progress.h"
#include "command/render/FrameSampler.h"
#include "command/run/RunSeries.h"
#include "command/scene/SceneWorld.h"
#include "command/scene/SoundState.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace command {
namespace {

using pictures::ClothState;
using pictures::Frame;

constexpr double roundOff = 0.01;  // of a step: scenes write 1/60 s in decimals

/// A state of the run, and what its series say of it.
struct Sample {
  Frame frame;
  std::vector<double> numbers;
};

float mix(float a, float b, double share) { return a + static_cast<float>(share) * (b - a); }

std::vector<float> mix(const std::vector<float>& a, const std::vector<float>& b, double share) {
  std::vector<float> mixed(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) mixed[i] = mix(a[i], b[i], share);
  return mixed;
}

ClothState mix(const ClothState& a, const ClothState& b, double share) {
  ClothState mixed;
  mixed.positions.resize(a.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mixed.positions[i][axis] = mix(a.positions[i][axis], b.positions[i][axis], share);
    }
  }
  mixed.saturation = mix(a.saturation, b.saturation, share);
  mixed.stretch = mix(a.stretch, b.stretch, share);
  mixed.speed = mix(a.speed, b.speed, share);
  mixed.released = b.released;
  return mixed;
}

/// The shorter way round.
pictures::Pose mix(const pictures::Pose& a, const pictures::Pose& b, double share) {
  pictures::Pose mixed;
  float alike = 0;
  for (std::size_t i = 0; i < 4; ++i) alike += a.turn[i] * b.turn[i];
  float length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    mixed.turn[i] = mix(a.turn[i], alike < 0 ? -b.turn[i] : b.turn[i], share);
    length += mixed.turn[i] * mixed.turn[i];
  }
  for (float& component : mixed.turn) component /= std::sqrt(length);
  for (std::size_t axis = 0; axis < 3; ++axis) mixed.place[axis] = mix(a.place[axis], b.place[axis], share);
  return mixed;
}

/// Between two steps. Drops come and go, so they are those of the later one.
Sample mix(const Sample& a, const Sample& b, double share) {
  Sample mixed;
  for (std::size_t i = 0; i < a.frame.cloths.size(); ++i) {
    mixed.frame.cloths.push_back(mix(a.frame.cloths[i], b.frame.cloths[i], share));
  }
  for (std::size_t i = 0; i < a.frame.poses.size(); ++i) {
    mixed.frame.poses.push_back(mix(a.frame.poses[i], b.frame.poses[i], share));
  }
  mixed.frame.wetness = mix(a.frame.wetness, b.frame.wetness, share);
  mixed.frame.drops = b.frame.drops;
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    mixed.numbers.push_back(a.numbers[i] + share * (b.numbers[i] - a.numbers[i]));
  }
  return mixed;
}

/// Takes frames from a run at times of their own.
class FramesAtTimes {
 public:
  /// @param steps  of the run: frames later than the last step are taken after it
  FramesAtTimes(const std::vector<double>& times, double secondsPerStep, int steps)
      : m_times(times), m_secondsPerStep(secondsPerStep), m_steps(steps) {
    m_sequence.series = runSeries();
  }

  pictures::FrameSequence& sequence() { return m_sequence; }

  /// After step 0, 1, 2, ...
  void offer(const SceneWorld& world, const FrameSampler& sampler, int step) {
    std::swap(m_before, m_now);
    sampler.take(world, step * m_secondsPerStep, m_now.frame);
    m_now.numbers = measureRun(world, m_now.frame);
    for (; taken() < m_times.size() && stepsUntil(m_times[taken()]) <= step + roundOff;) {
      const double late = step - stepsUntil(m_times[taken()]);  // [steps]
      keep(late < roundOff ? m_now : mix(m_before, m_now, 1 - late));
    }
  }

 private:
  std::size_t taken() const { return m_sequence.frames.size(); }
  double stepsUntil(double time) const { return std::min(time / m_secondsPerStep, static_cast<double>(m_steps)); }

  void keep(const Sample& sample) {
    const double time = m_times[taken()];
    m_sequence.frames.push_back(sample.frame);
    m_sequence.frames.back().time = time;
    for (std::size_t i = 0; i < sample.numbers.size(); ++i) m_sequence.series[i].values.push_back(sample.numbers[i]);
  }

  const std::vector<double>& m_times;
  double m_secondsPerStep;
  int m_steps;
  Sample m_before;
  Sample m_now;
  pictures::FrameSequence m_sequence;
};

int stepsOf(const Scene& scene) { return std::max(1, static_cast<int>(std::lround(scene.duration / scene.step))); }

void requireMemory(const Scene& scene, double frames) {
  constexpr double bytesPerNode = 24;
  constexpr double most = 2e9;  // [bytes]
  double nodes = 0;
  for (const ClothScene& cloth : scene.cloths) nodes += cloth.nodeCount();
  if (frames * nodes * bytesPerNode <= most) return;
  char text[200];
  std::snprintf(text, sizeof text,
                ": %.0f frames of %.0f nodes are %.1f GB, must be at most %.0f GB: take fewer frames per second, or a "
                "shorter --duration",
                frames, nodes, frames * nodes * bytesPerNode / 1e9, most / 1e9);
  throw InputError(scene.file + text);
}

bool isSame(const pictures::Series& a, const pictures::Series& b) {
  const auto isNear = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::max(std::abs(x), std::abs(y)); };
  return a.unit == b.unit && std::equal(a.values.begin(), a.values.end(), b.values.begin(), isNear);
}

/// Those that have something to tell: no zeros throughout, nothing that is the same as one before it.
std::vector<pictures::Series> telling(const std::vector<pictures::Series>& all) {
  std::vector<pictures::Series> kept;
  for (const pictures::Series& one : all) {
    const bool isZero = std::all_of(one.values.begin(), one.values.end(), [](double value) { return value == 0; });
    const bool isKnown = std::any_of(kept.begin(), kept.end(), [&](const auto& other) { return isSame(one, other); });
    if (!isZero && !isKnown) kept.push_back(one);
  }
  return kept;
}

}  // namespace

pictures::FrameSequence sampleRun(const Scene& scene, const std::vector<double>& times, SceneWorld::Kind kind) {
  requireMemory(scene, static_cast<double>(times.size()));
  const int steps = stepsOf(scene);
  SceneWorld world(scene, kind);
  const FrameSampler sampler(world);
  FramesAtTimes frames(times, scene.step, steps);
  Progress progress("running " + scene.name);
  frames.offer(world, sampler, 0);
  const int lastStep = std::min(steps, static_cast<int>(std::ceil(times.back() / scene.step - roundOff)));
  for (int step = 1; step <= lastStep; ++step) {
    world.step();
    requireSound(world);
    frames.offer(world, sampler, step);
    progress.update(static_cast<double>(step) / lastStep);
  }
  pictures::FrameSequence& sequence = frames.sequence();
  sequence.scenery = sampler.scenery();
  sequence.cloths = sampler.cloths();
  sequence.series = telling(sequence.series);
  return std::move(sequence);
}

pictures::FrameSequence sampleRun(const Scene& scene, double framesPerSecond) {
  const double end = stepsOf(scene) * scene.step;
  requireMemory(scene, end * framesPerSecond);
  const int count = static_cast<int>((end + roundOff * scene.step) * framesPerSecond) + 1;
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(i / framesPerSecond);
  return sampleRun(scene, times);
}

}  // namespace command
