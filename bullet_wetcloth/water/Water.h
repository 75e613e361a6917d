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
  void add(double term) {
    const double sum = m_sum + term;
    const bool sumIsLarger = (m_sum < 0 ? -m_sum : m_sum) >= (term < 0 ? -term : term);
    m_compensation += sumIsLarger ? (m_sum - sum) + term : (term - sum) + m_sum;
    m_sum = sum;
  }
  double value() const { return m_sum + m_compensation; }
  void transferState(StateArchive& archive);

 private:
  double m_sum = 0;
  double m_compensation = 0;
};

/// The same of all of these.
WETCLOTH_EXPORT double compensatedSum(const std::vector<double>& values);

/// An exponential never arrives: when less than this share of a node's capacity is missing, or left to go, it goes all
/// at once, so that a cloth which is full or dry can idle. A tenth of the closeness to the closed forms that we
/// promise.
constexpr double kNegligible = 1e-13;

/// The water of one cloth, per node, and its ledger. All in kg and double, whatever Bullet's precision.
///
/// Effects change it through absorb(), runOff(), drip(), handOver(), evaporate(), move() and redistribute(); what
/// arrived since the last commit and with which momentum is remembered, so that the commit can update velocities and
/// masses once per step.
class WETCLOTH_EXPORT Water {
 public:
  /// What came to a node since the last commit.
  struct Arrival {
    double mass = 0;                 ///< that stays [kg]
    double momentum[3] = {0, 0, 0};  ///< of mass and runOff [kg m/s]
    double runOff = 0;               ///< that brought momentum, and left [kg]
    double shifted = 0;  ///< went to others (< 0), or came and is no part of mass: from nodes, or joined already [kg]
  };

  std::size_t size() const { return m_held.size(); }

  double held(std::size_t node) const { return m_held[node]; }
  double dryMass(std::size_t node) const { return m_dryMass[node]; }
  /// What the node holds when saturated.
  double capacity(std::size_t node) const { return m_capacityRatio * m_dryMass[node]; }
  /// held / capacity: 0 dry, 1 saturated, more when a source has overfilled the node.
  double saturation(std::size_t node) const { return m_held[node] / capacity(node); }
  double totalMass(std::size_t node) const { return m_dryMass[node] + m_held[node]; }
  double capacityRatio() const { return m_capacityRatio; }

  Ledger ledger() const;

  /// Grows with every change of the water or of a capacity, by an effect or by hand: an effect that found nothing to do
  /// may idle until it changes.
  unsigned long long revision() const { return m_revision; }
  /// All water that was ever moved, in, out, within or by hand [kg]: never falls.
  double moved() const;
  /// Capacity of all nodes [kg].
  double totalCapacity() const { return m_capacityRatio * m_totalDryMass; }

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
  void runOff(std::size_t node, double mass, double vx, double vy, double vz);
  /// Liquid that leaves at the node's own velocity; at most what is held. Returns what left.
  double drip(std::size_t node, double mass) { return take(node, mass, m_dripped); }
  /// Liquid that another cloth takes in this step, with the velocity that the node has now; at most what is held.
  /// Booked as dripped, but what arrives later in the step does not meet it any more. Call WetCloth::joinArrivals()
  /// before. Returns what left.
  double handOver(std::size_t node, double mass) {
    const double left = drip(node, mass);
    m_arrivals[node].shifted -= left;
    return left;
  }
  /// Vapour that leaves at the node's own velocity; at most what is held. Returns what left.
  double evaporate(std::size_t node, double mass) { return take(node, mass, m_evaporated); }
  /// Water that moves inside the cloth, with the velocity (vx, vy, vz) of the node it leaves [m/s]; what of it came to
  /// that node in this step goes on with the momentum that it brought. At most what is held.
  void move(std::size_t from, std::size_t to, double mass, double vx, double vy, double vz);
  /// Water that moves between many nodes at once: node i ends with `held[i]` [kg], finite and >= 0. The sum must be
  /// what is held now, to rounding, which is booked under `initial`. The momentum that moved with it is the caller's
  /// to see to, with WetCloth::push(), and WetCloth::joinArrivals() before: what arrived in this step and has not
  /// joined its node stays with it, whatever moves on.
  void redistribute(const std::vector<double>& held);

  // --- for the commit ---------------------------------------------------------------------------------------

  bool movedSinceCommit() const { return m_movedSinceCommit; }
  /// Whether water left a node, or moved between nodes, since the last commit.
  bool leftSinceCommit() const { return m_leftSinceCommit; }
  const Arrival& arrival(std::size_t node) const { return m_arrivals[node]; }
  /// The arrival's momentum is in the node's velocity now: its mass is the node's like all other.
  void joinArrival(std::size_t node);
  void clearArrivals();

  // --- for WetCloth -----------------------------------------------------------------------------------------

  /// Starts over with these dry masses [kg], all > 0, no water, and an empty ledger.
  void reset(std::vector<double> dryMass, double capacityRatio);
  /// Replaces the water by hand; booked under `initial`. Each value finite and >= 0.
  void setHeld(const std::vector<double>& held);
  /// New dry mass of one node, its water unchanged.
  void setDryMass(std::size_t node, double mass) {
    m_totalDryMass += mass - m_dryMass[node];
    m_dryMass[node] = mass;
    ++m_revision;
  }
  /// The body's nodes changed: new arrays whose total water must equal the old one's to rounding.
  void replaceNodes(std::vector<double> dryMass, std::vector<double> held);
  void transferState(StateArchive& archive);

 private:
  // Consecutive nodes are summed in turn, so that no addition waits for the one before.
  static constexpr std::size_t kLanes = 8;

  double take(std::size_t node, double mass, CompensatedSum& account);
  void markMoved() {
    m_movedSinceCommit = true;
    ++m_revision;
  }

  std::vector<double> m_held;
  std::vector<double> m_dryMass;
  std::vector<Arrival> m_arrivals;
  double m_capacityRatio = 0;
  double m_totalDryMass = 0;
  double m_movedWithin = 0;  // between nodes, and by hand
  CompensatedSum m_initial;
  CompensatedSum m_absorbed;                        // up to the last commit
  std::array<double, kLanes> m_newlyAbsorbed = {};  // since then
  CompensatedSum m_dripped;
  CompensatedSum m_evaporated;
  CompensatedSum m_runOff;
  unsigned long long m_revision = 0;
  bool m_movedSinceCommit = false;
  bool m_leftSinceCommit = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
