// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/Crossings.h"
#include "bullet_wetcloth/solver/Untangling.h"

#include <functional>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Cloths that cross, though the guard lets nothing pass: they were made or put so, or pins have forced them. It counts
/// and tells them when that may have happened, and as long as they are untangled.
class Entanglements {
 public:
  using Log = std::function<void(const std::string&)>;
  /// The cloths of a step.
  struct Cloths {
    std::vector<ClothGuard::Cloth> nodes;
    std::vector<int> numbers;   ///< of their bodies in the world
    bool isAnyPlaced = false;   ///< one is new, was cut, or has nodes that were put elsewhere
    bool isAnyOpening = false;  ///< nodes of one that counted as one have come apart
    void clear() {
      nodes.clear();
      numbers.clear();
      isAnyPlaced = isAnyOpening = false;
    }
  };

  /// Before the first small step.
  /// @param dt  of the step [s]
  void begin(const Cloths& cloths, const ClothSolver::Guard& parameters, double dt, const Log& log);
  /// After each cloth's small step, and before the guard's.
  void push(const Cloths& cloths) { m_untangling.push(cloths.nodes); }
  /// After the last one, when something was forced through something.
  void lookAgain(const Cloths& cloths, const ClothSolver::Guard& parameters, const Log& log);

  /// What the guard leaves alone.
  const CrossingExemptions& exemptions() const { return m_untangling.exemptions(); }
  /// The most crossings that were counted at once.
  long long most() const { return m_most; }
  void resetMost() { m_most = 0; }

 private:
  long long count(const Cloths& cloths, const ClothSolver::Guard& parameters);
  void tell(const Cloths& cloths, const ClothSolver::Guard& parameters, const std::string& why, const Log& log) const;
  void tellIfNoFewer(double dt, const Log& log);

  Crossings m_crossings;
  Untangling m_untangling;
  bool m_wasPlaced = false;  // in the step before
  long long m_known = 0;     // by the last count
  long long m_fewest = 0;    // since they were told
  double m_noFewer = 0;      // for so long [s]
  long long m_most = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
