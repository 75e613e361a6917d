// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Splash.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMouth = 0.01;  // of the reach

void requireValid(const Splash::Sphere& sphere) {
  requireFinite("Splash.region.centre", sphere.centre);
  requirePositive("Splash.region.radius", sphere.radius);
}

void requireValid(const Splash::Cone& cone) {
  requireFinite("Splash.region.apex", cone.apex);
  if (!(cone.halfAngle > 0 && cone.halfAngle < kPi / 2)) {
    rejectValue("Splash.region.halfAngle", cone.halfAngle, "in (0, pi/2)");
  }
  requirePositive("Splash.region.reach", cone.reach);
}

void requireValid(const Splash::Parameters& parameters) {
  std::visit([](const auto& shape) { requireValid(shape); }, parameters.region);
  requireFinite("Splash.velocity", parameters.velocity);
  if (directionOf(parameters.velocity).isZero()) {
    reject("Splash.velocity", "must not be of length 0: it tells where to");
  }
  requireNotNegative("Splash.flux", parameters.flux);
}

double flowOf(const Splash::Sphere& sphere, double flux) { return kPi * sphere.radius * sphere.radius * flux; }
double flowOf(const Splash::Cone& cone, double flux) { return coneFlow(cone.halfAngle, flux, cone.reach); }

}  // namespace

double coneFlux(double distance, double flux, double reach) {
  const double ratio = reach / std::max(distance, kMouth * reach);
  return flux * ratio * ratio;
}

double coneFlow(double halfAngle, double flux, double reach) {
  const double half = std::sin(halfAngle / 2);  // 1 - cos h, which loses its digits in a narrow cone, is 2 half^2
  return 4 * kPi * half * half * reach * reach * flux;
}

Splash::Splash(Parameters parameters) { setParameters(parameters); }

void Splash::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;
  m_steadyState.restart();
}

void Splash::attach(WetCloth& cloth) {
  m_catcher.attach("Splash", cloth.body());
  m_steadyState.restart();
}

void Splash::apply(WetCloth& cloth, const Step& step) {
  m_catcher.skip();
  if (m_parameters.flux == 0 || m_steadyState.isReached(cloth.body(), cloth.water(), step.gravity)) return;
  m_catcher.begin(cloth.body());
  std::visit([&](const auto& region) { catchDrops(region, step.dt); }, m_parameters.region);
  m_catcher.deliver(cloth.water(), flow() * step.dt);
  m_nodesVisited += static_cast<long long>(m_catcher.positions().size());
  // Drops that all run off move no water, but go on pushing.
  m_steadyState.note(cloth.body(), cloth.water(), step.gravity, step.dt,
                     caught() > 0 ? cloth.water().totalCapacity() : 0);
}

bool Splash::wakes(const WetCloth& /*cloth*/, const Step& /*step*/) const { return caught() > 0; }

void Splash::catchDrops(const Sphere& sphere, double dt) {
  const btVector3 direction = directionOf(m_parameters.velocity);
  for (std::size_t f = 0; f < m_catcher.triangles().size(); ++f) {
    if (!(static_cast<double>((m_catcher.centroid(f) - sphere.centre).length()) <= sphere.radius)) continue;
    m_catcher.strike(f, direction, m_parameters.flux * dt, m_parameters.velocity);
  }
}

void Splash::catchDrops(const Cone& cone, double dt) {
  const btVector3 axis = directionOf(m_parameters.velocity);
  const btScalar speed = m_parameters.velocity.length();
  const double cosine = std::cos(cone.halfAngle);
  for (std::size_t f = 0; f < m_catcher.triangles().size(); ++f) {
    const btVector3 fromApex = m_catcher.centroid(f) - cone.apex;
    const double distance = static_cast<double>(fromApex.length());
    if (!(distance <= cone.reach && static_cast<double>(fromApex.dot(axis)) >= cosine * distance)) continue;
    const btVector3 direction = distance > 0 ? directionOf(fromApex) : axis;
    m_catcher.strike(f, direction, coneFlux(distance, m_parameters.flux, cone.reach) * dt, direction * speed);
  }
}

double Splash::flow() const {
  return std::visit([&](const auto& region) { return flowOf(region, m_parameters.flux); }, m_parameters.region);
}

void Splash::transferState(StateArchive& archive) {
  m_catcher.transferState(archive);
  m_steadyState.transferState(archive);
  archive.value(m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
