// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/DropList.h"

#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/Water.h"

#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void DropList::setMost(std::size_t most, double waterDensity) {
  m_most = most;
  m_waterDensity = waterDensity;
  for (std::size_t k = 0; k < 3; ++k) {
    m_position[k].reserve(most);
    m_velocity[k].reserve(most);
  }
  for (std::vector<double>* values : {&m_mass, &m_diameter, &m_age}) values->reserve(most);
  for (std::size_t i = 0; i < size(); ++i) m_diameter[i] = dropDiameter(m_mass[i], m_waterDensity);
  while (size() > most) {
    const std::size_t last = size() - 1;
    const Double3 place = position(last);
    const Double3 speed = velocity(last);
    const double mass = m_mass[last];
    remove(last);
    join(nearest(place), speed, mass);
  }
}

void DropList::add(const Double3& position, const Double3& velocity, double mass) {
  if (size() >= m_most) {
    join(nearest(position), velocity, mass);
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    m_position[k].push_back(position[k]);
    m_velocity[k].push_back(velocity[k]);
  }
  m_mass.push_back(mass);
  m_diameter.push_back(dropDiameter(mass, m_waterDensity));
  m_age.push_back(0);
}

std::size_t DropList::nearest(const Double3& position) const {
  std::size_t found = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size(); ++i) {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double way = m_position[k][i] - position[k];
      squared += way * way;
    }
    if (squared < least) {
      least = squared;
      found = i;
    }
  }
  return found;
}

// It stays where it is: on the way to the centre of both there may be cloth.
void DropList::join(std::size_t i, const Double3& velocity, double mass) {
  const double both = m_mass[i] + mass;
  for (std::size_t k = 0; k < 3; ++k) {
    m_velocity[k][i] = (m_mass[i] * m_velocity[k][i] + mass * velocity[k]) / both;
  }
  m_mass[i] = both;
  m_diameter[i] = dropDiameter(both, m_waterDensity);
  ++m_merged;
}

void DropList::remove(std::size_t i) {
  const auto dropFrom = [i](std::vector<double>& values) {
    values[i] = values.back();
    values.pop_back();
  };
  for (std::size_t k = 0; k < 3; ++k) {
    dropFrom(m_position[k]);
    dropFrom(m_velocity[k]);
  }
  for (std::vector<double>* values : {&m_mass, &m_diameter, &m_age}) dropFrom(*values);
}

void DropList::move(std::size_t i, const Double3& position, const Double3& velocity, double dt) {
  for (std::size_t k = 0; k < 3; ++k) {
    m_position[k][i] = position[k];
    m_velocity[k][i] = velocity[k];
  }
  m_age[i] += dt;
}

void DropList::setMass(std::size_t i, double mass) {
  m_mass[i] = mass;
  m_diameter[i] = dropDiameter(mass, m_waterDensity);
}

double DropList::total() const { return compensatedSum(m_mass); }

void DropList::transferState(StateArchive& archive) {
  const std::size_t count = archive.count(size());
  if (archive.isChecking() && count > m_most) archive.fail("there are more drops in flight than may be");
  if (archive.isRestoring()) resize(count);
  const std::array<std::vector<double>*, 9> arrays = {&m_position[0], &m_position[1], &m_position[2],
                                                      &m_velocity[0], &m_velocity[1], &m_velocity[2],
                                                      &m_mass,        &m_diameter,    &m_age};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::vector<double>* values : arrays) {
      double value = archive.isSaving() ? (*values)[i] : 0;
      archive.local(value);
      if (archive.isChecking() && !std::isfinite(value)) archive.fail("a drop is not finite");
      if (archive.isRestoring()) (*values)[i] = value;
    }
  }
  archive.value(m_merged);
}

void DropList::resize(std::size_t count) {
  for (std::size_t k = 0; k < 3; ++k) {
    m_position[k].resize(count);
    m_velocity[k].resize(count);
  }
  for (std::vector<double>* values : {&m_mass, &m_diameter, &m_age}) values->resize(count);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
