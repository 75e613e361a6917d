// SPDX-License-Identifier: Zlib
// The loops that tests wait for.
#include "tests/support/PassageCheck.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace wetcloth_test {

namespace {

using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

struct Box {
  double low[3];
  double high[3];
};

bool overlap(const Box& a, const Box& b) {
  bool doThey = true;  // without branches, which nobody could foresee
  for (int axis = 0; axis < 3; ++axis) doThey = doThey & (a.low[axis] <= b.high[axis]) & (b.low[axis] <= a.high[axis]);
  return doThey;
}

/// A part of a mesh, where it goes.
struct Part {
  int node[3];
  int count;
  Box box;
};

Part partOf(const int* nodes, int count, const std::vector<Place>& from, const std::vector<Place>& to, double near) {
  Part part = {{-1, -1, -1}, count, {}};
  std::copy(nodes, nodes + count, part.node);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int k = 0; k < count; ++k) {
      const auto node = std::size_t(nodes[k]);
      low = std::min({low, from[node][axis], to[node][axis]});
      high = std::max({high, from[node][axis], to[node][axis]});
    }
    part.box.low[axis] = low - near / 2;
    part.box.high[axis] = high + near / 2;
  }
  return part;
}

bool shareANode(const Part& a, const Part& b) {
  return std::any_of(a.node, a.node + a.count,
                     [&](int node) { return std::find(b.node, b.node + b.count, node) != b.node + b.count; });
}

/// Along this axis the parts overlap least.
int longestAxis(const std::vector<Part>& parts) {
  Box all = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  for (const Part& part : parts) {
    for (int axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], part.box.low[axis]);
      all.high[axis] = std::max(all.high[axis], part.box.high[axis]);
    }
  }
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (all.high[axis] - all.low[axis] > all.high[longest] - all.low[longest]) longest = axis;
  }
  return longest;
}

/// All parts are sorted along one axis; each is compared with those that begin before it ends. `wants` says of two
/// numbers of nodes whether such parts are a pair.
template <class Wants, class Take>
void sweep(std::vector<Part> parts, const Wants& wants, const Take& take) {
  if (parts.empty()) return;
  const int axis = longestAxis(parts);
  std::sort(parts.begin(), parts.end(),
            [axis](const Part& a, const Part& b) { return a.box.low[axis] < b.box.low[axis]; });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size() && !(parts[j].box.low[axis] > parts[i].box.high[axis]); ++j) {
      const Part& a = parts[i];
      const Part& b = parts[j];
      if (wants(a.count, b.count) && overlap(a.box, b.box) && !shareANode(a, b)) take(a, b);
    }
  }
}

std::vector<Query<double>> queriesOf(Pair kind, const std::vector<PassagePair>& pairs, const std::vector<Place>& from,
                                     const std::vector<Place>& to) {
  std::vector<Query<double>> queries;
  for (const PassagePair& pair : pairs) {
    if (pair.kind != kind) continue;
    Query<double> query;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = std::size_t(pair.node[k]);
      std::copy(from[node].begin(), from[node].end(), query.start[k]);
      std::copy(to[node].begin(), to[node].end(), query.end[k]);
    }
    queries.push_back(query);
  }
  return queries;
}

}  // namespace

std::vector<PassagePair> pairsThatComeNear(const PassageMesh& mesh, const std::vector<Place>& from,
                                           const std::vector<Place>& to, double near) {
  std::vector<Part> edges;
  for (const auto& edge : mesh.edges) edges.push_back(partOf(edge.data(), 2, from, to, near));
  std::vector<Part> others;
  for (const int& vertex : mesh.vertices) others.push_back(partOf(&vertex, 1, from, to, near));
  for (const auto& face : mesh.faces) others.push_back(partOf(face.data(), 3, from, to, near));
  std::vector<PassagePair> pairs;
  sweep(
      std::move(edges), [](int, int) { return true; },
      [&](const Part& a, const Part& b) {
        pairs.push_back({Pair::edgeEdge, {a.node[0], a.node[1], b.node[0], b.node[1]}});
      });
  sweep(
      std::move(others), [](int a, int b) { return a != b; },
      [&](const Part& a, const Part& b) {
        const Part& vertex = a.count == 1 ? a : b;
        const Part& face = a.count == 1 ? b : a;
        pairs.push_back({Pair::vertexFace, {vertex.node[0], face.node[0], face.node[1], face.node[2]}});
      });
  return pairs;
}

int countPassages(const PassageMesh& mesh, const std::vector<Place>& from, const std::vector<Place>& to,
                  const std::function<bool(const PassagePair&)>& isWanted) {
  static const ContinuousCheck fast(Tier::fast);
  static const ContinuousCheck judge(ContinuousCheck::hasExact() ? Tier::exact : Tier::conservative);
  std::vector<PassagePair> pairs = pairsThatComeNear(mesh, from, to);
  if (isWanted) {
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const PassagePair& pair) { return !isWanted(pair); }),
                pairs.end());
  }
  int count = 0;
  for (const Pair kind : {Pair::vertexFace, Pair::edgeEdge}) {
    const std::vector<Query<double>> queries = queriesOf(kind, pairs, from, to);
    std::vector<Contact> contacts(queries.size());
    fast(kind, queries.data(), queries.size(), contacts.data());
    for (std::size_t k = 0; k < queries.size(); ++k) {
      if (contacts[k].found && judge(kind, queries[k]).found) ++count;
    }
  }
  return count;
}

}  // namespace wetcloth_test
