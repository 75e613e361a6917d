// SPDX-License-Identifier: Zlib
#include "command/pictures/Rods.h"

#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace pictures {
namespace {

std::size_t index(int node) { return static_cast<std::size_t>(node); }

int farthestFrom(int from, const std::vector<int>& nodes, const std::vector<Vector3>& positions) {
  return *std::max_element(nodes.begin(), nodes.end(), [&](int a, int b) {
    return length(positions[index(a)] - positions[index(from)]) < length(positions[index(b)] - positions[index(from)]);
  });
}

/// The two nodes farthest apart, if all lie on the line between them.
std::vector<std::array<int, 2>> endsOfLine(const std::vector<int>& nodes, const std::vector<Vector3>& positions) {
  if (nodes.size() < 2) return {};
  const int first = farthestFrom(nodes.front(), nodes, positions);
  const int last = farthestFrom(first, nodes, positions);
  const Vector3 across = positions[index(last)] - positions[index(first)];
  if (length(across) <= 0) return {};
  const bool isLine = std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    return length(cross(positions[index(node)] - positions[index(first)], unit(across))) < 0.01F * length(across);
  });
  if (!isLine) return {};
  return {{first, last}};
}

/// The pinned nodes, those together that links connect.
std::vector<std::vector<int>> connectedPins(const ClothShape& shape) {
  std::map<int, int> groupOf;
  for (const int node : shape.pinned) groupOf[node] = node;
  const auto rename = [&](int before, int after) {
    for (auto& [node, group] : groupOf) {
      if (group == before) group = after;
    }
  };
  for (const auto& [a, b] : shape.links) {
    const auto first = groupOf.find(a);
    const auto second = groupOf.find(b);
    if (first == groupOf.end() || second == groupOf.end() || first->second == second->second) continue;
    rename(first->second, second->second);
  }
  std::map<int, std::vector<int>> groups;
  for (const auto& [node, group] : groupOf) groups[group].push_back(node);
  std::vector<std::vector<int>> result;
  for (const auto& [group, nodes] : groups) result.push_back(nodes);
  return result;
}

void standOn(const Ground& ground, Rod& rod) {
  if (std::abs(dot(ground.normal, unit(rod.to - rod.from))) < 0.99F) return;
  Vector3& foot = dot(ground.normal, rod.from) < dot(ground.normal, rod.to) ? rod.from : rod.to;
  foot = foot - ground.normal * (dot(ground.normal, foot) - ground.offset);
}

}  // namespace

Rods::Rods(const ClothShape& shape, const ClothState& rest) : m_ends(endsOfLine(shape.pinned, rest.positions)) {
  if (!m_ends.empty()) return;
  for (const std::vector<int>& group : connectedPins(shape)) {
    for (const auto& ends : endsOfLine(group, rest.positions)) m_ends.push_back(ends);
  }
}

std::vector<Rod> Rods::at(const ClothState& state, const std::vector<Ground>& grounds) const {
  std::vector<Rod> rods;
  const auto isFree = [&](int node) { return std::binary_search(state.released.begin(), state.released.end(), node); };
  for (const auto& [first, last] : m_ends) {
    if (isFree(first) || isFree(last)) continue;
    const Vector3 across = state.positions[index(last)] - state.positions[index(first)];
    Rod rod{state.positions[index(first)] - across * 0.05F, state.positions[index(last)] + across * 0.05F,
            0.01F * length(across)};
    for (const Ground& ground : grounds) standOn(ground, rod);
    rods.push_back(rod);
  }
  return rods;
}

}  // namespace pictures
