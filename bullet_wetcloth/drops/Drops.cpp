// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/Drops.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/drops/DropsState.h"
#include "bullet_wetcloth/drops/DropsStep.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const DropAir& air) {
  requireNotNegative("Drops.air.density", air.density);
  requireNotNegative("Drops.air.viscosity", air.viscosity);
  requirePositive("Drops.air.waterDensity", air.waterDensity);
  requirePositive("Drops.air.surfaceTension", air.surfaceTension);
}

void requireValid(const Drops::Parameters& parameters) {
  constexpr int most = 10000000;
  requirePositive("Drops.dropMass", parameters.dropMass);
  requireValid(parameters.air);
  parameters.wind.requireValid("Drops.wind");
  if (!(parameters.mostDrops >= 1 && parameters.mostDrops <= most)) {
    rejectValue("Drops.mostDrops", parameters.mostDrops, "in [1, " + std::to_string(most) + "]");
  }
  requirePositive("Drops.longestFlight", parameters.longestFlight);
  requireNotNegative("Drops.filmDensity", parameters.filmDensity);
  requirePositive("Drops.filmCell", parameters.filmCell);
  if (parameters.surface) requireValid("Drops.surface", *parameters.surface);
}

const Drops::Parameters& checked(const Drops::Parameters& parameters) {
  requireValid(parameters);
  return parameters;
}

}  // namespace

Drops::Drops(WetClothWorld& world, Parameters parameters)
    : WorldPart((checked(parameters), world)), m_state(std::make_unique<State>(parameters)) {
  setParameters(std::move(parameters));
  for (WetCloth& cloth : world.cloths()) Drops::follow(cloth);
}

Drops::Drops(WetClothWorld& world) : Drops(world, Parameters()) {}

Drops::~Drops() {
  for (const auto& followed : m_state->cloths) followed->target.cloth().water().keepShed(false);
}

const Drops::Parameters& Drops::parameters() const { return m_state->parameters; }

void Drops::setParameters(Parameters parameters) {
  requireValid(parameters);
  State& state = *m_state;
  const bool areOtherFilms =
      parameters.filmCell != state.parameters.filmCell || parameters.filmDensity != state.parameters.filmDensity;
  if (areOtherFilms && !state.films.empty()) reject("Drops.filmDensity", "is fixed once drops have landed on bodies");
  state.parameters = std::move(parameters);
  if (areOtherFilms) state.films = State::filmsFor(state.parameters);
  state.surface.reset();
  if (state.parameters.surface) state.surface = normalized(*state.parameters.surface);
  state.drops.setMost(static_cast<std::size_t>(state.parameters.mostDrops), state.parameters.air.waterDensity);
}

std::size_t Drops::add(Pour pour) { return m_state->spouts.add(std::move(pour)); }
std::size_t Drops::add(Glass glass) { return m_state->spouts.add(std::move(glass)); }
std::size_t Drops::pours() const { return m_state->spouts.pours(); }
const Pour& Drops::pour(std::size_t number) const { return m_state->spouts.pour(number); }
std::size_t Drops::glasses() const { return m_state->spouts.glasses(); }
double Drops::waterIn(std::size_t glass) const { return m_state->spouts.waterIn(glass); }

void Drops::setPour(std::size_t number, Pour pour) {
  static_cast<void>(this->pour(number));  // throws where there is none
  requireValid("pours[" + std::to_string(number) + "]", pour);
  m_state->spouts.setPour(number, std::move(pour));
}

std::size_t Drops::size() const { return m_state->drops.size(); }

Drop Drops::operator[](std::size_t i) const {
  const DropList& drops = m_state->drops;
  return {asBullet(drops.position(i)), asBullet(drops.velocity(i)), drops.mass(i), drops.diameter(i)};
}

void Drops::writeSpheres(float* spheres, double time) const {
  const double since = time - m_state->time;
  for (std::size_t i = 0; i < size(); ++i) {
    const Double3 position = m_state->drops.position(i);
    const Double3 velocity = m_state->drops.velocity(i);
    for (std::size_t k = 0; k < 3; ++k) *spheres++ = static_cast<float>(position[k] + velocity[k] * since);
    *spheres++ = static_cast<float>(m_state->drops.diameter(i) / 2);
  }
}

long long Drops::born() const { return m_state->counts.born; }
long long Drops::landedOnCloth() const { return m_state->counts.landedOnCloth; }
long long Drops::ended() const { return m_state->counts.ended; }
long long Drops::merged() const { return m_state->drops.merged(); }
double Drops::filmOn(const btCollisionObject& body) const { return m_state->films.on(body); }

long long Drops::candidates() const {
  long long sum = 0;
  for (const auto& followed : m_state->cloths) sum += followed->target.candidates();
  return sum;
}

// --- in the world ---------------------------------------------------------------------------------------------------

// Drops go the way of the substep that has ended: in it, it is known how cloths and bodies moved.
void Drops::step(double dt, double time) {
  const double flown = m_state->lastStep;
  Flight(*m_state, *world(), flown, time).run();
  m_state->lastStep = dt;
  m_state->time = time;
}

void Drops::follow(WetCloth& cloth) {
  cloth.water().keepShed(true);
  m_state->cloths.push_back(std::make_unique<State::Followed>(
      State::Followed{ClothTarget(cloth), cloth.ledger(), cloth.water().totalShed(), cloth.water().handedOver()}));
}

BodyFilms* Drops::films() { return &m_state->films; }

namespace {

// What has come and gone of one cloth. `inFlight` is what its nodes have shed, `brought` what ran off it.
template <class Followed>
void addTo(WorldLedger& sum, const Followed& followed) {
  const Water& water = followed.target.cloth().water();
  const Ledger now = water.ledger();
  const Ledger& before = followed.before;
  sum.initial += now.initial - before.initial + before.held + followed.shedBefore;
  sum.absorbed += now.absorbed - before.absorbed;
  sum.absorbed -= water.handedOver() - followed.handedOverBefore;
  sum.brought += now.runOff - before.runOff;
  sum.evaporated += now.evaporated - before.evaporated;
  sum.held += now.held;
  sum.inFlight += water.totalShed();
}

}  // namespace

// Its water goes with it.
void Drops::forget(const WetCloth& cloth) {
  State& state = *m_state;
  const auto isIt = [&](const auto& followed) { return &followed->target.cloth() == &cloth; };
  const auto found = std::find_if(state.cloths.begin(), state.cloths.end(), isIt);
  if (found == state.cloths.end()) return;
  addTo(state.gone, **found);
  state.accounts.left.add(state.gone.held);
  state.accounts.left.add(state.gone.inFlight);
  state.gone.held = state.gone.inFlight = 0;
  state.cloths.erase(found);
}

WorldLedger Drops::ledger() const {
  const State& state = *m_state;
  WorldLedger ledger = state.gone;
  for (const auto& followed : state.cloths) addTo(ledger, *followed);
  ledger.absorbed -= state.accounts.taken.value() + state.films.taken();
  ledger.brought += state.accounts.poured.value() - state.accounts.returned.value();
  ledger.inFlight += state.drops.total();
  ledger.films = state.films.total();
  ledger.left = state.accounts.left.value();
  return ledger;
}

void Drops::transferState(StateArchive& archive) {
  State& state = *m_state;
  archive.expect(state.cloths.size(), "the number of cloths that drops land on");
  archive.value(state.areFollowed);
  for (const auto& followed : state.cloths) followed->target.transferState(archive);
  for (const auto& followed : state.cloths) {
    Ledger& before = followed->before;
    archive.value(before.initial, before.absorbed, before.evaporated, before.held, before.runOff);
    archive.value(followed->shedBefore, followed->handedOverBefore);
  }
  WorldLedger& gone = state.gone;
  archive.value(gone.initial, gone.absorbed, gone.brought, gone.evaporated);
  state.drops.transferState(archive);
  state.bodies.transferState(archive);
  state.films.transferState(archive);
  state.spouts.transferState(archive);
  State::Accounts& accounts = state.accounts;
  for (auto* sum : {&accounts.poured, &accounts.taken, &accounts.returned, &accounts.left}) sum->transferState(archive);
  archive.value(state.counts.born, state.counts.landedOnCloth, state.counts.ended);
  archive.value(state.lastStep, state.time);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
