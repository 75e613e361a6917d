// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Swelling.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/state/StateArchive.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const Swelling::Parameters& parameters) {
  const double strain = parameters.saturatedStrain;
  if (!(strain > -0.5 && strain < 0.5)) rejectValue("Swelling.saturatedStrain", strain, "in (-0.5, 0.5)");
}

void setRestLength(btSoftBody::Link& link, btScalar length) {
  link.m_rl = length;
  link.m_c1 = length * length;
}

}  // namespace

double swellingStrain(double saturation, double saturatedStrain) { return saturatedStrain * saturation; }

Swelling::Swelling(Parameters parameters) { setParameters(parameters); }

void Swelling::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;
  m_isStale = true;
}

// After a cut a link may have another's place in the list. Bullet is then about to reset all rest lengths, so what
// matters is the factor of the shape that it takes them from: that of the water on the link's nodes.
void Swelling::attach(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  if (body.m_links.size() == 0) {
    rejectValue("Swelling: body.m_links.size()", 0, "at least 1: what changes is the rest length of links");
  }
  if (cloth.has(name(), this)) reject("Swelling", "the cloth has one already");
  m_isStale = true;
  const std::size_t known = m_lengths.size();
  if (known == static_cast<std::size_t>(body.m_links.size())) {
    if (areAllOther(body)) adoptReset(body);  // by btSoftBody::scale(), of the cloth as it was swollen
    return;
  }
  const bool isFirst = known == 0;
  m_saturation.reset(cloth.body(), cloth.water());
  m_lengths.resize(m_saturation.size());
  for (std::size_t k = 0; k < m_lengths.size(); ++k) {
    const btScalar found = body.m_links[static_cast<int>(k)].m_rl;
    const double factor = isFirst ? 1 : factorOf(k);
    const bool isOurs = k < known && found == m_lengths[k].written;
    const double natural = isOurs ? m_lengths[k].natural : static_cast<double>(found) / factor;
    m_lengths[k] = {natural, factor, found};
  }
  m_restLengthScale = body.getRestLengthScale();
}

void Swelling::detach(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  if (m_lengths.size() != static_cast<std::size_t>(body.m_links.size())) return;
  if (m_lengthsWillBeReset && !body.m_bUpdateRtCst) adoptReset(body);
  const bool wasScaled = body.getRestLengthScale() != m_restLengthScale;
  for (std::size_t k = 0; k < m_lengths.size(); ++k) {
    btSoftBody::Link& link = body.m_links[static_cast<int>(k)];
    adoptChange(m_lengths[k], link.m_rl, wasScaled);
    const btScalar natural = static_cast<btScalar>(m_lengths[k].natural);
    if (natural != link.m_rl) setRestLength(link, natural);
    cloth.restLengths().note(k, natural, 1);
  }
}

void Swelling::apply(WetCloth& cloth, const Step& step) {
  static_cast<void>(step);
  btSoftBody& body = cloth.body();
  if (body.m_bUpdateRtCst) {
    m_lengthsWillBeReset = true;  // and what we wrote now would be lost
    return;
  }
  if (m_lengthsWillBeReset) adoptReset(body);
  if (!m_saturation.update(cloth.water()) && !m_isStale) return;
  writeLengths(cloth);
}

bool Swelling::areAllOther(const btSoftBody& body) const {
  for (std::size_t k = 0; k < m_lengths.size(); ++k) {
    if (m_lengths[k].written == body.m_links[static_cast<int>(k)].m_rl) return false;
  }
  return true;
}

double Swelling::factorOf(std::size_t link) const {
  return 1 + swellingStrain(m_saturation[link], m_parameters.saturatedStrain);
}

void Swelling::adoptReset(btSoftBody& body) {
  for (std::size_t k = 0; k < m_lengths.size(); ++k) {
    Length& length = m_lengths[k];
    length.written = body.m_links[static_cast<int>(k)].m_rl;
    length.natural = static_cast<double>(length.written) / length.factor;
  }
  m_linksVisited += static_cast<long long>(m_lengths.size());
  m_restLengthScale = body.getRestLengthScale();
  m_lengthsWillBeReset = false;
}

void Swelling::adoptChange(Length& length, btScalar found, bool wasScaled) const {
  if (found == length.written) return;
  length.natural = wasScaled ? static_cast<double>(found) / length.factor : static_cast<double>(found);
}

// Always from the natural length, so that no number of cycles adds up an error.
void Swelling::writeLengths(WetCloth& cloth) {
  btSoftBody& body = cloth.body();
  const bool wasScaled = body.getRestLengthScale() != m_restLengthScale;
  m_restLengthScale = body.getRestLengthScale();
  for (std::size_t k = 0; k < m_lengths.size(); ++k) {
    btSoftBody::Link& link = body.m_links[static_cast<int>(k)];
    Length& length = m_lengths[k];
    adoptChange(length, link.m_rl, wasScaled);
    length.factor = factorOf(k);
    length.written = static_cast<btScalar>(length.natural * length.factor);
    if (length.written != link.m_rl) setRestLength(link, length.written);
    cloth.restLengths().note(k, length.written, length.factor);
  }
  m_linksVisited += static_cast<long long>(m_lengths.size());
  m_isStale = false;
}

void Swelling::transferState(StateArchive& archive) {
  m_saturation.transferState(archive);
  archive.each(m_lengths, [&](Length& length) { archive.value(length.natural, length.factor, length.written); });
  archive.value(m_restLengthScale, m_isStale, m_lengthsWillBeReset, m_linksVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
