// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/DeformableSolverState.h"

#include <BulletSoftBody/btDeformableBackwardEulerObjective.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btPreconditioner.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btDeformableBodySolver* solverOf(const SoftBodyArray& bodies) {
  return bodies.size() > 0 ? static_cast<btDeformableBodySolver*>(bodies[0]->getSoftBodySolver()) : nullptr;
}

template <class Visit>
void forEachNode(const SoftBodyArray& bodies, const Visit& visit) {
  std::size_t number = 0;
  for (int i = 0; i < bodies.size(); ++i) {
    for (int k = 0; k < bodies[i]->m_nodes.size(); ++k) visit(bodies[i]->m_nodes[k], number++);
  }
}

// Its numbers are private, but what it does to ones tells them.
std::vector<btScalar> inverseMassesOf(MassPreconditioner& preconditioner, int nodes) {
  btAlignedObjectArray<btVector3> ones;
  btAlignedObjectArray<btVector3> products;
  ones.resize(nodes, btVector3(1, 1, 1));
  products.resize(nodes, btVector3(0, 0, 0));
  preconditioner(ones, products);
  std::vector<btScalar> inverseMasses;
  for (int i = 0; i < nodes; ++i) inverseMasses.push_back(products[i].x());
  return inverseMasses;
}

// It takes its numbers from the nodes, which have these for as long as that.
void set(MassPreconditioner& preconditioner, const SoftBodyArray& bodies, std::vector<btScalar> inverseMasses) {
  const auto swapAll = [&] {
    forEachNode(bodies, [&](btSoftBody::Node& node, std::size_t i) { std::swap(node.m_im, inverseMasses[i]); });
  };
  swapAll();
  preconditioner.reinitialize(true);
  swapAll();
}

}  // namespace

void prepareDeformableSolver(StateArchive& archive, const SoftBodyArray& bodies) {
  btDeformableBodySolver* const solver = solverOf(bodies);
  if (!solver) return;
  unsigned char hasStepped = solver->m_objective->getIndices()->size() > 0 ? 1 : 0;
  archive.local(hasStepped);
  if (archive.isRestoring()) solver->reinitialize(hasStepped != 0 ? bodies : SoftBodyArray(), 0);
}

void transferDeformableSolver(StateArchive& archive, const SoftBodyArray& bodies) {
  btDeformableBodySolver* const solver = solverOf(bodies);
  if (!solver) return;
  std::size_t nodes = 0;
  forEachNode(bodies, [&](btSoftBody::Node&, std::size_t) { ++nodes; });
  MassPreconditioner& preconditioner = *solver->m_objective->m_massPreconditioner;
  std::vector<btScalar> inverseMasses = inverseMassesOf(preconditioner, static_cast<int>(nodes));
  archive.array(inverseMasses);
  if (archive.isRestoring()) set(preconditioner, bodies, inverseMasses);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
