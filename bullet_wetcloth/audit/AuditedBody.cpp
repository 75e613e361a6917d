// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/audit/AuditedBody.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void AuditedBody::build(const btSoftBody& body) {
  m_whole.build(body);
  m_steps.reset();
  observe();
}

void AuditedBody::follow(const btSoftBody& body) {
  m_steps.emplace();
  m_steps->faces.build(body);
  m_steps->record = std::make_shared<SmallStepRecord>(body);
}

void AuditedBody::restart() {
  m_whole.restart(*body());
  observe();
  if (!m_steps) return;
  m_steps->faces.restart(*body());
  m_steps->record->clear();
}

void AuditedBody::observe() {
  ClothSolver* const solver = ClothSolver::of(*body());
  if (!solver) return;
  if (!m_steps) follow(*body());
  solver->addObserver(m_steps->record);
}

int AuditedBody::smallSteps() const {
  return m_steps ? m_steps->record->count(static_cast<std::size_t>(body()->m_nodes.size())) : 0;
}

void AuditedBody::takeSmallStep(int index) {
  if (!m_steps) return;
  if (index < smallSteps()) {
    m_steps->faces.advance(m_steps->record->places(index), m_steps->record->origin());
  } else {
    m_steps->faces.stand();
  }
}

void AuditedBody::endSmallSteps() {
  if (!m_steps) return;
  m_steps->faces.correct(*body(), smallSteps() > 0);
  m_steps->record->clear();
}

void AuditedBody::transferState(StateArchive& archive, const btSoftBody& body) {
  m_whole.transferState(archive, body);
  unsigned char hasSteps = m_steps ? 1 : 0;
  archive.local(hasSteps);
  if (archive.isRestoring()) hasSteps != 0 ? follow(body) : m_steps.reset();
  if (hasSteps == 0) return;
  // While a state is checked, it goes into what is thrown away.
  Steps scratch{{}, std::make_shared<SmallStepRecord>(body)};
  Steps& steps = archive.isChecking() ? scratch : *m_steps;
  steps.faces.transferState(archive, body);
  steps.record->transferState(archive);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
