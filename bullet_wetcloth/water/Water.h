// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Where the water of one cloth came from and went to [kg]. At every step, to rounding,
/// initial + absorbed == held + dripped + evaporated.
struct Ledger {
  double initial = 0;     ///< held when the cloth was added, plus what was set by hand since (may be negative)
  double absorbed = 0;    ///< brought by the sources
  double dripped = 0;     ///< lost as liquid: drops, and what another cloth took
  double evaporated = 0;  ///< lost as vapour
  double held = 0;        ///< in the cloth now
  double runOff = 0;      ///< struck the cloth and was not taken in; never part of the balance

  /// initial + absorbed - dripped - evaporated - held: zero to rounding.
  double imbalance() const { return initial + absorbed - dripped - evaporated - held; }
};

/// A sum whose rounding error does not grow with the number of terms (Neumaier 1974).
class WETCLOTH_EXPORT CompensatedSum {
 public:
  /// One term more.
  void add(double term) {
    const double sum = m_sum + term;
    const bool sumIsLarger = (m_sum < 0 ? -m_sum : m_sum) >= (term < 0 ? -term : term);
    m_compensation += sumIsLarger ? (m_sum - sum) + term : (term - sum) + m_sum;
    m_sum = sum;
  }
  /// The sum so far.
  double value() const { return m_sum + m_compensation; }
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  double m_sum = 0;
  double m_compensation = 0;
};

/// The sum of all these values, by a CompensatedSum.
WETCLOTH_EXPORT double compensatedSum(const std::vector<double>& values);

/// An exponential never reaches its end. So when a node lacks less than this share of its capacity, it is filled, and
/// when it holds less, it is dried, all at once: then a cloth that is full or dry can idle. The value is a tenth of the
/// deviation from the closed forms that we promise not to exceed.
constexpr double kNegligible = 1e-13;

/// The water of one cloth, per node, and its ledger. All in kg and double, whatever Bullet's precision.
///
/// Effects change it through absorb(), runOff(), drip(), handOver(), evaporate(), move() and redistribute(). Masses and
/// velocities follow once per step, in the commit: until then Water remembers what arrived at each node, and with which
/// momentum.
class WETCLOTH_EXPORT Water {
 public:
  /// What came to a node since the last commit.
  struct Arrival {
    double mass = 0;                 ///< water that came and stays [kg]
    double momentum[3] = {0, 0, 0};  ///< of `mass` and `runOff` together, when they came [kg m/s]
    double runOff = 0;               ///< water that struck the node and ran off [kg]
    /// Water that changed the node's mass since the commit without being in `mass` [kg]: > 0 what redistribute()
    /// brought or what has joined the node already, < 0 what went to other nodes or cloths.
    double shifted = 0;
  };

  /// Number of nodes.
  std::size_t size() const { return m_held.size(); }

  /// Water in the node now [kg].
  double held(std::size_t node) const { return m_held[node]; }
  /// The same of all nodes, in their order. It stays at its place until the body's nodes change in number.
  const std::vector<double>& heldByNode() const { return m_held; }
  /// Without water [kg].
  double dryMass(std::size_t node) const { return m_dryMass[node]; }
  /// What the node holds when saturated.
  double capacity(std::size_t node) const { return m_capacity[node]; }
  /// held / capacity: 0 dry, 1 saturated, more when a source has overfilled the node.
  double saturation(std::size_t node) const { return m_held[node] / capacity(node); }
  /// Dry mass and water [kg].
  double totalMass(std::size_t node) const { return m_dryMass[node] + m_held[node]; }
  /// Which of the cloth's fabrics the node is of: a place in WetCloth::fabrics().
  std::size_t fabric(std::size_t node) const { return static_cast<std::size_t>(m_fabric[node]); }
  /// How many fabrics there are.
  std::size_t fabricCount() const { return m_parts.size(); }
  /// Water that a fabric holds at saturation per dry mass [kg/kg].
  double capacityRatio(std::size_t fabric) const { return m_parts[fabric].capacityRatio; }

  /// Where all water came from and went to.
  Ledger ledger() const;

  /// Grows with every change of the water or of a capacity, by an effect or by hand. An effect that found nothing to do
  /// may idle until this number is another one.
  unsigned long long revision() const { return m_revision; }
  /// All water that was ever moved [kg]: into the cloth, out of it, between its nodes, or by hand. Never falls.
  double moved() const;
  /// Capacity of all nodes [kg].
  double totalCapacity() const {
    double total = 0;
    for (const Part& part : m_parts) total += part.capacityRatio * part.dryMass;
    return total;
  }

  // --- for effects, inside a step ---------------------------------------------------------------------------

  /// Water that arrives from outside with velocity (vx, vy, vz) [m/s]. `mass` must be finite and >= 0.
  void absorb(std::size_t node, double mass, double vx, double vy, double vz) {
    const double before = m_held[node];
    m_held[node] = before + mass;
    const double arrived = m_held[node] - before;  // what the rounded sum really gained, so the ledger stays exact
    m_newlyAbsorbed[node % kLanes] += arrived;
    Arrival& arrival = m_arrivals[node];
    arrival.mass += arrived;
    arrival.momentum[0] += arrived * vx;
    arrival.momentum[1] += arrived * vy;
    arrival.momentum[2] += arrived * vz;
    markMoved();
  }
  /// Water that strikes a node with velocity (vx, vy, vz) [m/s] and runs off: it leaves its momentum, as in an
  /// inelastic impact, and goes away with the node's velocity. `mass` must be finite and >= 0.
  void runOff(std::size_t node, double mass, double vx, double vy, double vz) {
    if (!(mass > 0)) return;
    strike(node, mass, vx, vy, vz);
    if (m_keepsShed) shed(node, mass);
  }
  /// The same of water that somebody follows further: it is not shed().
  void runOffFollowed(std::size_t node, double mass, double vx, double vy, double vz) {
    if (mass > 0) strike(node, mass, vx, vy, vz);
  }
  /// Liquid that leaves at the node's own velocity; at most what is held. Returns what left.
  double drip(std::size_t node, double mass) {
    const double left = take(node, mass, m_dripped);
    if (keepsShed() && left > 0) shed(node, left);
    return left;
  }
  /// Liquid that another cloth takes in this step, at most what is held; returns what left. It is booked as dripped.
  /// It leaves with the velocity that the node has now, and at once: water that arrives later in the step meets a node
  /// without it. Call WetCloth::joinArrivals() before.
  double handOver(std::size_t node, double mass) {
    const double left = take(node, mass, m_dripped);
    m_arrivals[node].shifted -= left;
    m_handedOver.add(left);
    return left;
  }
  /// Vapour that leaves at the node's own velocity; at most what is held. Returns what left.
  double evaporate(std::size_t node, double mass) { return take(node, mass, m_evaporated); }
  /// Water that moves from one node to another, at most what is held. It takes along the velocity (vx, vy, vz) of the
  /// node that it leaves [m/s]; the part of it that came to that node in this same step keeps the momentum that it
  /// brought.
  void move(std::size_t from, std::size_t to, double mass, double vx, double vy, double vz);
  /// Water that moves between many nodes at once: node i ends with `held[i]` [kg], finite and >= 0. Their sum must be
  /// what is held now; a difference by rounding is booked under `initial`. Momentum is left to the caller: call
  /// WetCloth::joinArrivals() before, since what has not joined its node yet would not move on, and give the nodes
  /// their new velocities with WetCloth::push().
  void redistribute(const std::vector<double>& held);

  // --- for who follows the water that leaves ------------------------------------------------------------------

  /// Whether from now on, what drips from a node or runs off it stays there as shed() until it is taken. It is no
  /// longer water of the cloth, and has no weight. What is there when nothing is to be kept any more is forgotten.
  void keepShed(bool keeps);
  /// Whether it does.
  bool keepsShed() const { return m_keepsShed; }
  /// What left the node as liquid and was not taken yet [kg]; only while it is kept.
  double shed(std::size_t node) const { return m_shed[node]; }
  /// Takes it.
  void takeShed(std::size_t node) { m_shed[node] = 0; }
  /// At all nodes [kg].
  double totalShed() const { return compensatedSum(m_shed); }
  /// Whether a node has shed something since clearShedMore().
  bool hasShedMore() const { return m_hasShedMore; }
  /// Says that all of it was seen.
  void clearShedMore() { m_hasShedMore = false; }
  /// What other cloths took by handOver() so far [kg].
  double handedOver() const { return m_handedOver.value(); }

  // --- for the commit ---------------------------------------------------------------------------------------

  /// Whether water came, left or moved since the last commit.
  bool movedSinceCommit() const { return m_movedSinceCommit; }
  /// Whether water left a node, or moved between nodes, since the last commit.
  bool leftSinceCommit() const { return m_leftSinceCommit; }
  /// What came to a node since the last commit.
  const Arrival& arrival(std::size_t node) const { return m_arrivals[node]; }
  /// Says that the momentum of what arrived is in the node's velocity now: from then on it is water like all other.
  void joinArrival(std::size_t node);
  /// The commit is done: nothing has come since.
  void clearArrivals();

  // --- for WetCloth -----------------------------------------------------------------------------------------

  /// Starts over with these dry masses [kg], all > 0, no water, and an empty ledger.
  /// @param capacityRatios  of each fabric [kg/kg], > 0, at least one
  /// @param fabricOfNode    of each node, a place in `capacityRatios`
  void reset(std::vector<double> dryMass, const std::vector<double>& capacityRatios, std::vector<int> fabricOfNode);
  /// Replaces the water by hand; booked under `initial`. Each value finite and >= 0.
  void setHeld(const std::vector<double>& held);
  /// New dry mass of one node, its water unchanged.
  void setDryMass(std::size_t node, double mass) {
    Part& part = m_parts[fabric(node)];
    part.dryMass += mass - m_dryMass[node];
    m_dryMass[node] = mass;
    m_capacity[node] = part.capacityRatio * mass;
    ++m_revision;
  }
  /// The body's nodes changed: new dry masses and new water [kg] of each, whose sum must be what is held now, to
  /// rounding, and which fabric each is of.
  void replaceNodes(std::vector<double> dryMass, std::vector<double> held, std::vector<int> fabricOfNode);
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  // absorb() adds neighbouring nodes to different sums, so that the processor need not finish one addition before the
  // next.
  static constexpr std::size_t kLanes = 8;

  // All nodes of one fabric.
  struct Part {
    double capacityRatio = 0;  // [kg/kg]
    double dryMass = 0;        // [kg]
  };

  void sumDryMasses();
  void setCapacities();
  void keepShedOfGoneNodes();
  double take(std::size_t node, double mass, CompensatedSum& account);
  void strike(std::size_t node, double mass, double vx, double vy, double vz);
  void shed(std::size_t node, double mass) {
    m_shed[node] += mass;
    m_hasShedMore = true;
  }
  void markMoved() {
    m_movedSinceCommit = true;
    ++m_revision;
  }

  std::vector<double> m_held;
  std::vector<double> m_dryMass;
  std::vector<Arrival> m_arrivals;
  std::vector<double> m_capacity;
  std::vector<int> m_fabric;
  std::vector<Part> m_parts;
  double m_movedWithin = 0;  // between nodes, and by hand
  CompensatedSum m_initial;
  CompensatedSum m_absorbed;                        // up to the last commit
  std::array<double, kLanes> m_newlyAbsorbed = {};  // since then
  CompensatedSum m_dripped;
  CompensatedSum m_evaporated;
  CompensatedSum m_runOff;
  CompensatedSum m_handedOver;
  std::vector<double> m_shed;  // of each node, once it is kept [kg]
  unsigned long long m_revision = 0;
  bool m_movedSinceCommit = false;
  bool m_leftSinceCommit = false;
  bool m_keepsShed = false;
  bool m_hasShedMore = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
