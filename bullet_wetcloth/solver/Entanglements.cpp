// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Entanglements.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kToldAfter = 2;  // for which crossings may get no fewer before that is told [s]

std::string pairs(long long count) { return std::to_string(count) + " pairs of an edge and a face of cloths"; }

/// Of the edge's first node, in the world.
std::string placeOf(const Crossing& crossing, const std::vector<ClothGuard::Cloth>& cloths) {
  int node = crossing.edge[0];  // among those of all cloths
  for (int cloth = 0; cloth < crossing.cloth[0]; ++cloth) node -= cloths[toSize(cloth)].nodeCount;
  const BodyPoint place = crossingPlaceOf(cloths[toSize(crossing.cloth[0])], node, btVector3(0, 0, 0));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.3f, %.3f, %.3f) m", place[0], place[1], place[2]);
  return text.data();
}

}  // namespace

long long Entanglements::count(const Cloths& cloths, const ClothSolver::Guard& parameters) {
  m_crossings.find(cloths.nodes, parameters);
  m_crossings.joinCuts(cloths.nodes);
  const long long found = static_cast<long long>(m_crossings.found().size());
  m_most = std::max(m_most, found);
  return found;
}

void Entanglements::begin(const Cloths& cloths, const ClothSolver::Guard& parameters, double dt, const Log& log) {
  const bool isUntangling = parameters.untangle && m_known > 0;
  const bool wasPlaced = m_wasPlaced;
  m_wasPlaced = cloths.isAnyPlaced;
  if (!cloths.isAnyPlaced && !cloths.isAnyOpening && !isUntangling) return m_untangling.clear();
  const long long known = m_known;
  m_known = count(cloths, parameters);
  if (cloths.isAnyPlaced && m_known > (wasPlaced ? known : 0)) {
    tell(cloths, parameters, "where a cloth is new or was put elsewhere", log);
    m_fewest = m_known;
    m_noFewer = 0;
  } else if (cloths.isAnyOpening && m_known > known) {
    tell(cloths, parameters, "where a cut has opened", log);
    m_fewest = m_known;
    m_noFewer = 0;
  } else if (m_known > 0) {
    tellIfNoFewer(dt, log);
  } else if (known > 0) {
    log("wetcloth: no edge of a cloth crosses a face any more");
  }
  parameters.untangle ? m_untangling.begin(m_crossings.found(), cloths.nodes) : m_untangling.clear();
}

void Entanglements::lookAgain(const Cloths& cloths, const ClothSolver::Guard& parameters, const Log& log) {
  const long long known = m_known;
  m_known = count(cloths, parameters);
  if (m_known <= known) return;
  tell(cloths, parameters, "since pins have forced them", log);
  m_fewest = m_known;
  m_noFewer = 0;
}

void Entanglements::tell(const Cloths& cloths, const ClothSolver::Guard& parameters, const std::string& why,
                         const Log& log) const {
  std::set<int> numbers;
  for (const Crossing& crossing : m_crossings.found()) {
    for (const int cloth : crossing.cloth) numbers.insert(cloths.numbers[toSize(cloth)]);
  }
  std::string bodies;
  for (const int number : numbers) bodies += (bodies.empty() ? "" : ", ") + std::to_string(number);
  log("wetcloth: " + pairs(m_known) + " cross " + why + " (soft bodies of the world from 0: " + bodies +
      "), the first near " + placeOf(m_crossings.found().front(), cloths.nodes) + "; they are " +
      (parameters.untangle ? "untangled" : "left as they are"));
}

// Once: they go on being untangled.
void Entanglements::tellIfNoFewer(double dt, const Log& log) {
  if (m_known < m_fewest) {
    m_fewest = m_known;
    m_noFewer = 0;
    return;
  }
  const bool wasPatient = m_noFewer < kToldAfter;
  m_noFewer += dt;
  if (wasPatient && m_noFewer >= kToldAfter) {
    log("wetcloth: " + pairs(m_known) + " still cross, and for " + std::to_string(static_cast<int>(kToldAfter)) +
        " s they got no fewer");
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
