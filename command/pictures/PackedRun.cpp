// SPDX-License-Identifier: Zlib
#include "command/pictures/PackedRun.h"

#include "command/pictures/LittleEndian.h"
#include "command/pictures/PageJson.h"
#include "command/pictures/Rods.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pictures {
namespace {

using Values = std::vector<float> ClothState::*;

struct Range {
  float low = 0;
  float high = 1;

  /// In [0, most], the nearest.
  int quantized(float value, int most) const {
    const float share = (value - low) / std::max(high - low, 1e-12F);
    return static_cast<int>(std::lround(std::min(1.0F, std::max(0.0F, share)) * static_cast<float>(most)));
  }
};

void putUint16(std::string& bytes, int value) {
  putByte(bytes, static_cast<std::uint32_t>(value));
  putByte(bytes, static_cast<std::uint32_t>(value) >> 8U);
}

/// 0, -1, 1, -2, ... become 0, 1, 2, 3, ...: what is near zero has an empty high byte.
std::uint32_t folded(int value) {
  const auto wrapped = static_cast<std::int16_t>(static_cast<std::uint16_t>(value & 0xFFFF));
  return static_cast<std::uint32_t>(wrapped < 0 ? -2 * wrapped - 1 : 2 * wrapped);
}

Bounds boxOf(const FrameSequence& sequence) {
  Bounds box = boundsOf(sequence);
  for (const Frame& frame : sequence.frames) {
    for (const Drop& drop : frame.drops) box.add(drop.position);
  }
  return box;
}

Range rangeOf(const FrameSequence& sequence, Values values, Range range) {
  for (const Frame& frame : sequence.frames) {
    for (const ClothState& cloth : frame.cloths) {
      for (const float value : cloth.*values) range.high = std::max(range.high, value);
    }
  }
  return range;
}

class Packer {
 public:
  Packer(const FrameSequence& sequence, nlohmann::json& head)
      : m_sequence(sequence), m_box(boxOf(sequence)), m_head(head) {}

  std::string pack() {
    m_head["box"] = {m_box.low, m_box.high};
    m_head["times"] = nlohmann::json::array();
    for (const Frame& frame : m_sequence.frames) m_head["times"].push_back(frame.time);
    const Range saturation{0, 1};
    const Range stretch = rangeOf(m_sequence, &ClothState::stretch, {1, 1.02F});
    const Range speed = rangeOf(m_sequence, &ClothState::speed, {0, 0.1F});
    m_head["ranges"] = {{"saturation", {saturation.low, saturation.high}},
                        {"stretch", {stretch.low, stretch.high}},
                        {"speed", {speed.low, speed.high}}};
    for (std::size_t cloth = 0; cloth < m_sequence.cloths.size(); ++cloth) {
      putShape(m_sequence.cloths[cloth]);
      putPositions(cloth);
      putValues(cloth, &ClothState::saturation, saturation);
      putValues(cloth, &ClothState::stretch, stretch);
      putValues(cloth, &ClothState::speed, speed);
    }
    putSolids();
    putRods();
    putDrops();
    return std::move(m_bytes);
  }

 private:
  Range axis(std::size_t i) const { return {m_box.low[i], m_box.high[i]}; }

  void putShape(const ClothShape& shape) {
    m_head["cloths"].push_back(pageJson(shape));
    putAll(shape.texture);
    putAll(shape.triangles);
  }

  template <std::size_t Count>
  void putAll(const std::vector<std::array<float, Count>>& tuples) {
    for (const auto& tuple : tuples) {
      for (const float x : tuple) putFloat(m_bytes, x);
    }
  }
  void putAll(const std::vector<Triangle>& triangles) {
    for (const Triangle& triangle : triangles) {
      for (const int corner : triangle) putInt32(m_bytes, corner);
    }
  }

  /// Of a frame's nodes: how far each is from where it would be had it gone on as before, less the same of the node
  /// before it. All low bytes, then all high bytes.
  void putPositions(std::size_t cloth) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<int> last, before;
      std::string low, high;
      for (const Frame& frame : m_sequence.frames) {
        std::vector<int> now;
        for (const Vector3& p : frame.cloths[cloth].positions) now.push_back(axis(i).quantized(p[i], 65535));
        if (last.empty()) last = before = std::vector<int>(now.size(), 0);
        int left = 0;
        for (std::size_t node = 0; node < now.size(); ++node) {
          const int surprise = now[node] - 2 * last[node] + before[node];
          const std::uint32_t rest = folded(surprise - left);
          putByte(low, rest);
          putByte(high, rest >> 8U);
          left = surprise;
        }
        before = std::move(last);
        last = std::move(now);
      }
      m_bytes += low + high;
    }
  }

  /// Of each node: the change since the frame before, less that of the node before it.
  void putValues(std::size_t cloth, Values values, const Range& range) {
    std::vector<int> last(m_sequence.cloths[cloth].texture.size(), 0);
    for (const Frame& frame : m_sequence.frames) {
      int left = 0;
      for (std::size_t node = 0; node < last.size(); ++node) {
        const int now = range.quantized((frame.cloths[cloth].*values)[node], 255);
        putByte(m_bytes, static_cast<std::uint32_t>(now - last[node] - left));
        left = now - last[node];
        last[node] = now;
      }
    }
  }

  void putSolids() {
    m_head["solids"] = nlohmann::json::array();
    for (const Solid& solid : m_sequence.scenery.solids) {
      m_head["solids"].push_back(
          {{"vertices", solid.vertices.size()}, {"triangles", solid.triangles.size()}, {"colour", solid.colour}});
      putAll(solid.vertices);
      putAll(solid.normals);
      putAll(solid.triangles);
    }
    m_head["wetness"] = nlohmann::json::array();
    for (const Frame& frame : m_sequence.frames) {
      std::vector<double> wetness;
      for (const float wet : frame.wetness) wetness.push_back(std::round(100 * static_cast<double>(wet)) / 100);
      m_head["wetness"].push_back(wetness);
    }
    m_head["posed"] = !m_sequence.frames.front().poses.empty();
    for (const Frame& frame : m_sequence.frames) {
      for (const Pose& pose : frame.poses) {
        putAll(std::vector<Vector3>{pose.place});
        putAll(std::vector<std::array<float, 4>>{pose.turn});
      }
    }
  }

  void putRods() {
    std::vector<Rods> rods;
    for (std::size_t i = 0; i < m_sequence.cloths.size(); ++i) {
      rods.emplace_back(m_sequence.cloths[i], m_sequence.frames.front().cloths[i]);
    }
    for (const Frame& frame : m_sequence.frames) {
      std::vector<Rod> all;
      for (std::size_t i = 0; i < rods.size(); ++i) {
        const std::vector<Rod> some = rods[i].at(frame.cloths[i], m_sequence.scenery.grounds);
        all.insert(all.end(), some.begin(), some.end());
      }
      putUint16(m_bytes, static_cast<int>(all.size()));
      for (const Rod& rod : all) {
        for (const float x : rod.from) putFloat(m_bytes, x);
        for (const float x : rod.to) putFloat(m_bytes, x);
        putFloat(m_bytes, rod.radius);
      }
    }
  }

  void putDrops() {
    Range radius{0, 1e-6F};
    for (const Frame& frame : m_sequence.frames) {
      for (const Drop& drop : frame.drops) radius.high = std::max(radius.high, drop.radius);
    }
    m_head["largestDrop"] = radius.high;
    for (const Frame& frame : m_sequence.frames) {
      const std::size_t count = std::min<std::size_t>(frame.drops.size(), 65535);
      putUint16(m_bytes, static_cast<int>(count));
      for (std::size_t drop = 0; drop < count; ++drop) {
        for (std::size_t i = 0; i < 3; ++i) {
          putUint16(m_bytes, axis(i).quantized(frame.drops[drop].position[i], 65535));
        }
        putUint16(m_bytes, radius.quantized(frame.drops[drop].radius, 65535));
      }
    }
  }

  const FrameSequence& m_sequence;
  const Bounds m_box;
  nlohmann::json& m_head;
  std::string m_bytes;
};

}  // namespace

std::string packed(const FrameSequence& sequence, nlohmann::json& head) { return Packer(sequence, head).pack(); }

}  // namespace pictures
