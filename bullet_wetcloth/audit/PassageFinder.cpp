// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/audit/PassageFinder.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using collision::Pair;

using Nodes = const SweptFaces::Position* [4];

struct Sides {
  int before;
  int after;
};

// Sign of (b - a) x (c - a) . (d - a): which side of the plane a b c the point d is on, or which way one edge passes
// the other. 0 when rounding leaves it open; the bound is that of Shewchuk's orient3d (1997). Both moments at a time,
// for the compiler to make wide instructions of.
Sides sidesOf(const Nodes& nodes) {
  const auto& a = nodes[0]->at;
  const auto& b = nodes[1]->at;
  const auto& c = nodes[2]->at;
  const auto& d = nodes[3]->at;
  double volume[2], size[2];
  for (int m = 0; m < 2; ++m) {
    const double u[3] = {b[0][m] - a[0][m], b[1][m] - a[1][m], b[2][m] - a[2][m]};
    const double v[3] = {c[0][m] - a[0][m], c[1][m] - a[1][m], c[2][m] - a[2][m]};
    const double w[3] = {d[0][m] - a[0][m], d[1][m] - a[1][m], d[2][m] - a[2][m]};
    const double left[3] = {u[1] * v[2], u[2] * v[0], u[0] * v[1]};
    const double right[3] = {u[2] * v[1], u[0] * v[2], u[1] * v[0]};
    volume[m] = (left[0] - right[0]) * w[0] + (left[1] - right[1]) * w[1] + (left[2] - right[2]) * w[2];
    size[m] = (std::fabs(left[0]) + std::fabs(right[0])) * std::fabs(w[0]) +
              (std::fabs(left[1]) + std::fabs(right[1])) * std::fabs(w[1]) +
              (std::fabs(left[2]) + std::fabs(right[2])) * std::fabs(w[2]);
  }
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  constexpr double bound = (7 + 56 * unit) * unit;
  const auto sign = [&](int m) { return (volume[m] > bound * size[m]) - (volume[m] < -bound * size[m]); };
  return {sign(0), sign(1)};
}

// Without branches, here and where they are called: nearly half of the pairs have a common node, in no order that a
// processor could foresee.
bool contains(const int (&corners)[3], int node) {
  return (corners[0] == node) | (corners[1] == node) | (corners[2] == node);
}

bool shareANode(const int (&e)[2], const int (&f)[2]) {
  return (e[0] == f[0]) | (e[0] == f[1]) | (e[1] == f[0]) | (e[1] == f[1]);
}

// Keeps those for which keeps(index) is true, and returns how many.
template <class Keeps>
std::size_t filter(int* indices, std::size_t count, const Keeps& keeps) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int index = indices[i];
    indices[kept] = index;
    kept += keeps(static_cast<std::size_t>(index)) ? 1 : 0;
  }
  return kept;
}

}  // namespace

bool PassageFinder::Undecided::operator<(const Undecided& other) const {
  if (first != other.first) return std::less<>()(first, other.first);
  if (second != other.second) return std::less<>()(second, other.second);
  return std::tie(pair, nodes) < std::tie(other.pair, other.nodes);
}

PassageFinder::PassageFinder(collision::Tier tier, OnPassage onPassage)
    : m_check(tier), m_onPassage(std::move(onPassage)), m_contacts(kBlock) {
  for (Block* block : {&m_vertexFace, &m_edgeEdge}) {
    block->queries.reserve(kBlock);
    block->questions.reserve(kBlock);
  }
  for (Near* near : {&m_near, &m_nearOther}) {
    for (Few* few : {&near->vertices, &near->edges, &near->faces}) few->boxes.resize(SweptFaces::kMostInPatch);
  }
  m_undecided.reserve(kMostUndecided);
  m_undecidedNext.reserve(kMostUndecided);
}

void PassageFinder::begin(long long mostCandidates) {
  m_mostCandidates = m_candidates + mostCandidates;
  m_isComplete = true;
}

void PassageFinder::lookAt(const SweptFaces& faces) {
  const auto visit = [&](int patch, int other) {
    lookAt(faces, patch, faces, other);
    return mayGoOn();
  };
  m_isComplete = m_isComplete && faces.visitSelf(visit);
}

void PassageFinder::lookAt(const SweptFaces& a, const SweptFaces& b) {
  const auto visit = [&](int patchOfA, int patchOfB) {
    lookAt(a, patchOfA, b, patchOfB);
    return mayGoOn();
  };
  m_isComplete = m_isComplete && a.visitPairs(b, visit);
}

void PassageFinder::lookAt(const SweptFaces& a, int patchOfA, const SweptFaces& b, int patchOfB) {
  findNear(a, patchOfA, b.boxOf(patchOfB), m_near);
  if (&a == &b && patchOfA == patchOfB) {
    verticesAgainstFaces(a, m_near.vertices, a, m_near.faces);
    edgesAgainstEdges(a, m_near.edges, a, m_near.edges);
    return;
  }
  findNear(b, patchOfB, a.boxOf(patchOfA), m_nearOther);
  verticesAgainstFaces(a, m_near.vertices, b, m_nearOther.faces);
  verticesAgainstFaces(b, m_nearOther.vertices, a, m_near.faces);
  edgesAgainstEdges(a, m_near.edges, b, m_nearOther.edges);
}

void PassageFinder::findNear(const SweptFaces& of, int patch, const SweptBox& box, Near& near) {
  findNear(of.vertices().boxes, of.patch(patch).vertices, box, near.vertices);
  findNear(of.edges().boxes, of.patch(patch).edges, box, near.edges);
  findNear(of.faces().boxes, of.patch(patch).faces, box, near.faces);
}

void PassageFinder::findNear(const SweptBoxes& boxes, SweptFaces::Range range, const SweptBox& box, Few& few) {
  few.count = boxes.findOverlapping(box, range.begin, range.end, few.parts.data());
  for (std::size_t i = 0; i < few.count; ++i) few.boxes.set(i, boxes[static_cast<std::size_t>(few.parts[i])]);
  for (std::size_t i = few.count; i % SweptBoxes::kWide != 0; ++i) few.boxes.set(i, SweptBox());
}

void PassageFinder::verticesAgainstFaces(const SweptFaces& a, const Few& vertices, const SweptFaces& b,
                                         const Few& faces) {
  const std::size_t end = SweptBoxes::wholeBlocks(faces.count);
  const bool isOneBody = &a == &b;
  const auto cornersOf = [&](std::size_t index) -> const auto& {
    return b.faces().nodes[static_cast<std::size_t>(faces.parts[index])].node;
  };
  for (std::size_t i = 0; i < vertices.count; ++i) {
    const int vertex = a.vertices().nodes[static_cast<std::size_t>(vertices.parts[i])].node[0];
    const auto isPair = [&](std::size_t face) { return !(isOneBody & contains(cornersOf(face), vertex)); };
    std::size_t found = faces.boxes.findOverlapping(vertices.boxes[i], 0, end, m_found.data());
    found = filter(m_found.data(), found, isPair);
    for (std::size_t j = 0; j < found; ++j) {
      const auto& corners = cornersOf(static_cast<std::size_t>(m_found[j]));
      consider(Pair::vertexFace, {&a, &b, {vertex, corners[0], corners[1], corners[2]}});
    }
  }
}

void PassageFinder::edgesAgainstEdges(const SweptFaces& a, const Few& edges, const SweptFaces& b, const Few& others) {
  const std::size_t end = SweptBoxes::wholeBlocks(others.count);
  const bool isOneBody = &a == &b;
  const bool isOnePatch = &edges == &others;  // has each pair in both orders
  const auto endsOf = [&](std::size_t index) -> const auto& {
    return b.edges().nodes[static_cast<std::size_t>(others.parts[index])].node;
  };
  for (std::size_t i = 0; i < edges.count; ++i) {
    const auto& e = a.edges().nodes[static_cast<std::size_t>(edges.parts[i])].node;
    const auto isPair = [&](std::size_t other) {
      return !((isOneBody & shareANode(e, endsOf(other))) | (isOnePatch & (other < i)));
    };
    const std::size_t begin = isOnePatch ? i / SweptBoxes::kWide * SweptBoxes::kWide : 0;
    std::size_t found = others.boxes.findOverlapping(edges.boxes[i], begin, end, m_found.data());
    found = filter(m_found.data(), found, isPair);
    for (std::size_t j = 0; j < found; ++j) {
      const auto& f = endsOf(static_cast<std::size_t>(m_found[j]));
      consider(Pair::edgeEdge, {&a, &b, {e[0], e[1], f[0], f[1]}});
    }
  }
}

// Nearly all pairs stay on one side, and are done with here.
void PassageFinder::consider(Pair pair, const Subject& subject) {
  ++m_candidates;
  const int firstNodes = pair == Pair::vertexFace ? 1 : 2;
  Nodes at;
  for (int k = 0; k < 4; ++k) {
    at[k] = &(k < firstNodes ? subject.first : subject.second)->position(subject.nodes[k]);
  }
  Sides sides = sidesOf(at);
  if (sides.before == 0) sides.before = rememberedSide(pair, subject);
  if (sides.before == 0 || sides.before == sides.after) return;
  Block& block = blockOf(pair);
  block.queries.emplace_back();
  collision::Query<btScalar>& query = block.queries.back();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = static_cast<double>(subject.first->origin()[static_cast<int>(axis)]);
    for (std::size_t k = 0; k < 4; ++k) {
      query.start[k][axis] = static_cast<btScalar>(at[k]->at[axis][0] - origin);
      query.end[k][axis] = static_cast<btScalar>(at[k]->at[axis][1] - origin);
    }
  }
  block.questions.push_back({subject, sides.before, sides.after});
  if (block.queries.size() == kBlock) ask(pair);
}

int PassageFinder::rememberedSide(Pair pair, const Subject& subject) const {
  if (m_undecided.empty()) return 0;
  const auto& n = subject.nodes;
  const Undecided wanted{pair, subject.first->body(), subject.second->body(), {n[0], n[1], n[2], n[3]}, 0};
  const auto found = std::lower_bound(m_undecided.begin(), m_undecided.end(), wanted);
  return found == m_undecided.end() || wanted < *found ? 0 : found->side;
}

void PassageFinder::ask(Pair pair) {
  Block& block = blockOf(pair);
  const std::size_t count = block.queries.size();
  m_check(pair, block.queries.data(), count, m_contacts.data());
  for (std::size_t i = 0; i < count; ++i) {
    const Question& question = block.questions[i];
    if (!m_contacts[i].found) continue;
    if (question.sideAfter != 0) {
      m_onPassage(pair, question.subject, m_contacts[i]);
    } else if (m_undecidedNext.size() < kMostUndecided) {
      const Subject& subject = question.subject;
      const auto& n = subject.nodes;
      m_undecidedNext.push_back(
          {pair, subject.first->body(), subject.second->body(), {n[0], n[1], n[2], n[3]}, question.sideBefore});
    }
  }
  block.queries.clear();
  block.questions.clear();
}

bool PassageFinder::finish() {
  ask(Pair::vertexFace);
  ask(Pair::edgeEdge);
  std::sort(m_undecidedNext.begin(), m_undecidedNext.end());
  m_undecided.swap(m_undecidedNext);
  m_undecidedNext.clear();
  return m_isComplete;
}

void PassageFinder::forget() {
  for (Block* block : {&m_vertexFace, &m_edgeEdge}) {
    block->queries.clear();
    block->questions.clear();
  }
  m_undecided.clear();
  m_undecidedNext.clear();
}

void PassageFinder::transferState(StateArchive& archive, const btAlignedObjectArray<btSoftBody*>& bodies) {
  const auto transferBody = [&](const btSoftBody*& body) {
    const int number = archive.isSaving() ? bodies.findLinearSearch(const_cast<btSoftBody*>(body)) : 0;
    const int place = archive.index(number < bodies.size() ? number : -1, bodies.size(), "soft body of an audit");
    if (archive.isRestoring()) body = place < 0 ? nullptr : bodies[place];
  };
  archive.growing(m_undecided, [&](Undecided& undecided) {
    transferBody(undecided.first);
    transferBody(undecided.second);
    archive.value(undecided.pair, undecided.side);
    for (int& node : undecided.nodes) archive.value(node);
  });
  if (archive.isRestoring()) std::sort(m_undecided.begin(), m_undecided.end());
  archive.value(m_candidates);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
