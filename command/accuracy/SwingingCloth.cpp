// SPDX-License-Identifier: Zlib
#include "command/accuracy/SwingingCloth.h"

#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace accuracy {
namespace {

constexpr int clothSide = SwingingCloth::side;
constexpr double arealDensity = 0.150;

/// A row of the record, of points that are read by functions: position and velocity of node i along an axis, its mass.
template <class Position, class Velocity, class Mass>
void note(ClothRecord& record, double time, Position position, Velocity velocity, Mass massOf) {
  double mass = 0;
  double across = 0;
  double height = 0;
  double kinetic = 0;
  double lowest = 0;
  for (int i = 0; i < clothSide * clothSide; ++i) {
    mass += massOf(i);
    across += massOf(i) * position(i, 0);
    height += massOf(i) * position(i, 1);
    for (int axis = 0; axis < 3; ++axis) kinetic += massOf(i) * velocity(i, axis) * velocity(i, axis) / 2;
    if (i < clothSide) lowest += position(i, 1) / clothSide;
  }
  record.times.push_back(time);
  record.across.push_back(across / mass);
  record.heights.push_back(height / mass);
  record.lowest.push_back(lowest);
  record.energies.push_back(kinetic / mass + SwingingCloth::gravity * height / mass);
  record.isFinite = record.isFinite && std::isfinite(kinetic) && std::fabs(height / mass) < 100;
}

Specimen::Settings settingsOf(const SwingingCloth& cloth, const ClothSolver& solver) {
  Specimen::Settings settings;
  settings.patch = cloth.patch();
  settings.world.gravity = btVector3(0, btScalar(-SwingingCloth::gravity), 0);
  if (solver.kind == ClothSolver::Kind::smallSteps) {
    settings.world.clothSolver.emplace().smallSteps = solver.iterations;
  } else {
    settings.world.iterations = solver.iterations;
  }
  if (solver.kind == ClothSolver::Kind::deformableExplicit || solver.kind == ClothSolver::Kind::deformableImplicit) {
    settings.world.kind = command::WorldKind::deformable;
    settings.world.implicit = solver.kind == ClothSolver::Kind::deformableImplicit;
    command::DeformableSprings springs;
    springs.stiffness = SwingingCloth::stiffness;
    springs.bendingStiffness = SwingingCloth::bendingStiffness;
    springs.damping = 0;
    settings.springs = springs;
  }
  return settings;
}

std::vector<double> massesOf(btSoftBody& body, const wetcloth::WetCloth& cloth) {
  std::vector<double> masses;
  for (int i = 0; i < body.m_nodes.size(); ++i) masses.push_back(cloth.dryMass(i));
  return masses;
}

}  // namespace

wetcloth::ClothPatch SwingingCloth::patch() const {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = clothSide;
  patch.edgeU = btVector3(0, 0, btScalar(length));
  // From the lower edge to the pinned one, which is at height 0.
  patch.origin = btVector3(btScalar(length * std::sin(angle)), btScalar(-length * std::cos(angle)), 0);
  patch.edgeV = -patch.origin;
  patch.arealDensity = arealDensity;
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

/// Written from the paper's description of the springs and not from the patch's code.
MassSpringReference SwingingCloth::reference() const {
  std::vector<MassSpringReference::Point> points;
  std::vector<MassSpringReference::Spring> springs;
  const double width = length / (clothSide - 1);
  // A node has a third of its triangles; their diagonals all run one way, from (i, j) to (i + 1, j + 1).
  const auto triangles = [](int i, int j) {
    int count = 0;
    if (i < clothSide - 1 && j < clothSide - 1) count += 2;
    if (i > 0 && j < clothSide - 1) count += 1;
    if (i < clothSide - 1 && j > 0) count += 1;
    if (i > 0 && j > 0) count += 2;
    return count;
  };
  for (int j = 0; j < clothSide; ++j) {
    for (int i = 0; i < clothSide; ++i) {
      const double fall = length - j * width;  // below the pins, along the cloth
      MassSpringReference::Point point;
      point.position = {fall * std::sin(angle), -fall * std::cos(angle), i * width};
      point.mass = arealDensity * width * width / 2 * triangles(i, j) / 3;
      point.isFixed = j == clothSide - 1;
      points.push_back(point);
    }
  }
  const auto add = [&](int i, int j, int di, int dj, double stiffnessOfKind) {
    if (i + di < 0 || i + di >= clothSide || j + dj >= clothSide) return;
    springs.push_back({j * clothSide + i, (j + dj) * clothSide + i + di, width * std::hypot(di, dj), stiffnessOfKind});
  };
  for (int j = 0; j < clothSide; ++j) {
    for (int i = 0; i < clothSide; ++i) {
      add(i, j, 1, 0, stiffness);
      add(i, j, 0, 1, stiffness);
      add(i, j, 1, 1, stiffness);
      add(i, j, -1, 1, stiffness);
      add(i, j, 2, 0, bendingStiffness);
      add(i, j, 0, 2, bendingStiffness);
    }
  }
  return MassSpringReference(std::move(points), std::move(springs), gravity);
}

ClothRecord record(const SwingingCloth& cloth, const ClothSolver& solver, double duration) {
  Specimen specimen(settingsOf(cloth, solver));
  if (solver.kind == ClothSolver::Kind::hookeSprings) {
    wetcloth::HookeSprings::Parameters springs;
    springs.stiffness = SwingingCloth::stiffness;
    springs.bendingStiffness = SwingingCloth::bendingStiffness;
    springs.iterations = solver.iterations;
    specimen.cloth().add<wetcloth::HookeSprings>(springs);
  }
  btSoftBody& body = specimen.body();
  const std::vector<double> masses = massesOf(body, specimen.cloth());
  const auto noteNow = [&](ClothRecord& record, double time) {
    note(
        record, time, [&](int i, int axis) { return static_cast<double>(body.m_nodes[i].m_x[axis]); },
        [&](int i, int axis) { return static_cast<double>(body.m_nodes[i].m_v[axis]); },
        [&](int i) { return masses[static_cast<std::size_t>(i)]; });
  };
  ClothRecord record;
  noteNow(record, 0);
  const int steps = static_cast<int>(std::lround(60 * duration)) * solver.substeps;
  for (int i = 1; i <= steps && record.isFinite; ++i) {
    const double start = command::processorTime();
    specimen.substep(solver.substep());
    record.seconds += command::processorTime() - start;
    noteNow(record, i * solver.substep());
  }
  return record;
}

ClothRecord recordReference(const SwingingCloth& cloth, double dt, double duration) {
  MassSpringReference reference = cloth.reference();
  const auto noteNow = [&](ClothRecord& record, double time) {
    const auto point = [&](int i) -> const MassSpringReference::Point& {
      return reference.points()[static_cast<std::size_t>(i)];
    };
    note(
        record, time, [&](int i, int axis) { return point(i).position[static_cast<std::size_t>(axis)]; },
        [&](int i, int axis) { return point(i).velocity[static_cast<std::size_t>(axis)]; },
        [&](int i) { return point(i).mass; });
  };
  ClothRecord record;
  noteNow(record, 0);
  const int steps = static_cast<int>(std::lround(duration / dt));
  const int every = std::max(1, static_cast<int>(std::lround(1e-3 / dt)));
  for (int i = 1; i <= steps; ++i) {
    reference.step(dt);
    if (i % every == 0) noteNow(record, i * dt);
  }
  return record;
}

double sagOf(const ClothRecord& record) {
  if (!record.isFinite) return std::numeric_limits<double>::infinity();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < record.times.size(); ++i) {
    if (record.times[i] < record.times.back() / 2) continue;
    sum += -record.lowest[i] - SwingingCloth::length;
    ++count;
  }
  return sum / count;
}

double periodOf(const ClothRecord& record) {
  std::vector<double> passes;
  for (std::size_t i = 1; record.isFinite && i < record.times.size(); ++i) {
    const double before = record.across[i - 1];
    const double after = record.across[i];
    if ((before > 0) == (after > 0)) continue;
    passes.push_back(record.times[i - 1] + (record.times[i] - record.times[i - 1]) * before / (before - after));
  }
  if (passes.size() < 3) return std::numeric_limits<double>::infinity();
  return 2 * (passes.back() - passes.front()) / static_cast<double>(passes.size() - 1);
}

double energyDriftOf(const ClothRecord& record) {
  if (!record.isFinite) return std::numeric_limits<double>::infinity();
  const double lowest = -SwingingCloth::gravity * SwingingCloth::length / 2;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < record.times.size(); ++i) {
    if (record.times[i] < 0.75 * record.times.back()) continue;
    sum += record.energies[i] - lowest;
    ++count;
  }
  return sum / count / (record.energies.front() - lowest) - 1;
}

}  // namespace accuracy
