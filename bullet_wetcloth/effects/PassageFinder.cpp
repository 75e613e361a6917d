#include "bullet_wetcloth/effects/PassageFinder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using collision::Pair;
using Point = SweptFaces::Point;

// Sign of (b - a) x (c - a) . (d - a): which side of the plane a b c the point d is on, or which way one edge passes
// the other. 0 when rounding leaves it open; the bound is that of Shewchuk's orient3d (1997).
int sideOf(const Point& a, const Point& b, const Point& c, const Point& d) {
  double u[3];
  double v[3];
  double w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = static_cast<double>(b[k]) - static_cast<double>(a[k]);
    v[k] = static_cast<double>(c[k]) - static_cast<double>(a[k]);
    w[k] = static_cast<double>(d[k]) - static_cast<double>(a[k]);
  }
  double volume = 0;
  double size = 0;
  for (int k = 0; k < 3; ++k) {
    const double left = u[(k + 1) % 3] * v[(k + 2) % 3];
    const double right = u[(k + 2) % 3] * v[(k + 1) % 3];
    volume += (left - right) * w[k];
    size += (std::fabs(left) + std::fabs(right)) * std::fabs(w[k]);
  }
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  const double error = (7 + 56 * unit) * unit * size;
  return volume > error ? 1 : volume < -error ? -1 : 0;
}

void copy(const Point& from, Point& to) { std::copy(from, from + 3, to); }

bool isCornerOf(const SweptFaces::Face& face, int node) {
  return face.nodes[0] == node || face.nodes[1] == node || face.nodes[2] == node;
}

bool shareANode(const int (&e)[2], const int (&f)[2]) {
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
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
  m_undecided.reserve(kMostUndecided);
  m_undecidedNext.reserve(kMostUndecided);
}

void PassageFinder::lookAt(const SweptFaces& faces) {
  faces.visitSelf([&](int a, int b) { lookAt(faces, a, faces, b); });
}

void PassageFinder::lookAt(const SweptFaces& a, const SweptFaces& b) {
  a.visitPairs(b, [&](int faceOfA, int faceOfB) { lookAt(a, faceOfA, b, faceOfB); });
}

void PassageFinder::lookAt(const SweptFaces& a, int faceOfA, const SweptFaces& b, int faceOfB) {
  verticesAgainst(a, faceOfA, b, faceOfB);
  verticesAgainst(b, faceOfB, a, faceOfA);
  edgesAgainst(a, faceOfA, b, faceOfB);
}

void PassageFinder::verticesAgainst(const SweptFaces& a, int faceOfA, const SweptFaces& b, int faceOfB) {
  const SweptFaces::Face& face = a.face(faceOfA);
  const SweptFaces::Face& other = b.face(faceOfB);
  for (std::size_t i = face.vertexBegin; i < face.vertexEnd; ++i) {
    const SweptFaces::Vertex& vertex = a.vertex(i);
    if (!vertex.box.overlaps(b.boxOf(faceOfB))) continue;
    if (&a == &b && isCornerOf(other, vertex.node)) continue;
    consider(Pair::vertexFace, {&a, &b, {vertex.node, other.nodes[0], other.nodes[1], other.nodes[2]}});
  }
}

void PassageFinder::edgesAgainst(const SweptFaces& a, int faceOfA, const SweptFaces& b, int faceOfB) {
  const SweptFaces::Face& face = a.face(faceOfA);
  const SweptFaces::Face& other = b.face(faceOfB);
  for (std::size_t i = face.edgeBegin; i < face.edgeEnd; ++i) {
    const SweptFaces::Edge& e = a.edge(i);
    if (!e.box.overlaps(b.boxOf(faceOfB))) continue;
    for (std::size_t j = other.edgeBegin; j < other.edgeEnd; ++j) {
      const SweptFaces::Edge& f = b.edge(j);
      if (!e.box.overlaps(f.box)) continue;
      if (&a == &b && shareANode(e.nodes, f.nodes)) continue;
      consider(Pair::edgeEdge, {&a, &b, {e.nodes[0], e.nodes[1], f.nodes[0], f.nodes[1]}});
    }
  }
}

// Nearly all pairs stay on one side, and are done with here.
void PassageFinder::consider(Pair pair, const Subject& subject) {
  ++m_candidates;
  const int firstNodes = pair == Pair::vertexFace ? 1 : 2;
  const SweptFaces::Position* at[4];
  for (int k = 0; k < 4; ++k) {
    at[k] = &(k < firstNodes ? subject.first : subject.second)->position(subject.nodes[k]);
  }
  int before = sideOf(at[0]->start, at[1]->start, at[2]->start, at[3]->start);
  const int after = sideOf(at[0]->end, at[1]->end, at[2]->end, at[3]->end);
  if (before == 0) before = rememberedSide(pair, subject);
  if (before == 0 || before == after) return;
  Block& block = blockOf(pair);
  block.queries.emplace_back();
  for (int k = 0; k < 4; ++k) {
    copy(at[k]->start, block.queries.back().start[k]);
    copy(at[k]->end, block.queries.back().end[k]);
  }
  block.questions.push_back({subject, before, after});
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

void PassageFinder::finish() {
  ask(Pair::vertexFace);
  ask(Pair::edgeEdge);
  std::sort(m_undecidedNext.begin(), m_undecidedNext.end());
  m_undecided.swap(m_undecidedNext);
  m_undecidedNext.clear();
}

void PassageFinder::forget() {
  for (Block* block : {&m_vertexFace, &m_edgeEdge}) {
    block->queries.clear();
    block->questions.clear();
  }
  m_undecided.clear();
  m_undecidedNext.clear();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
