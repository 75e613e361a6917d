// SPDX-License-Identifier: Zlib
// An effect of your own: a hair dryer that takes water out of the cloth where a function says.

#include <bullet_wetcloth/Require.h>
#include <bullet_wetcloth/bullet_wetcloth.h>
#include <bullet_wetcloth/water/DryMass.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

class HairDryer : public wetcloth::Effect {
 public:
  struct Parameters {
    double rate = 0.01;                                             // evaporation in full heat [kg/(m^2 s)], >= 0
    std::function<double(const btVector3& position, double)> heat;  // of position and time, in [0, 1]
  };

  explicit HairDryer(Parameters parameters) : m_parameters(std::move(parameters)) {
    wetcloth::requireNotNegative("HairDryer.rate", m_parameters.rate);
    if (!m_parameters.heat) throw std::invalid_argument("HairDryer.heat: must be a function");
  }

  const char* name() const override { return "HairDryer"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::losses; }

  // Called when the effect is added, and again when the body was cut.
  void attach(wetcloth::WetCloth& cloth) override { m_areas = wetcloth::nodeAreas(cloth.body()); }

  // Called once per substep. Masses, link constants and the ledger follow by themselves.
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override {
    for (std::size_t i = 0; i < m_areas.size(); ++i) {
      const btVector3& position = cloth.body().m_nodes[static_cast<int>(i)].m_x;
      const double heat = m_parameters.heat(position, step.time);
      cloth.water().evaporate(i, m_parameters.rate * heat * m_areas[i] * step.dt);
    }
  }

 private:
  Parameters m_parameters;
  std::vector<double> m_areas;  // of each node [m^2]
};

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();

  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 17;
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  const std::unique_ptr<btSoftBody> cloth = patch.build(world.getWorldInfo());
  world.addSoftBody(cloth.get());

  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& towel = wet.add(*cloth);
  towel.setSaturation(1);
  HairDryer::Parameters dryer;
  dryer.heat = [](const btVector3& position, double time) {  // a warm spot that sweeps along the towel in 20 s
    const double distance = static_cast<double>(position.x()) - time / 20;
    return std::exp(-distance * distance / (0.15 * 0.15));
  };
  towel.add<HairDryer>(dryer);

  std::printf("time [s]  evaporated [g]  saturation along the towel, left to right\n");
  for (int frame = 0; frame <= 1200; ++frame) {
    if (frame % 240 == 0) {
      std::printf("%8d  %14.2f ", frame / 60, 1000 * towel.ledger().evaporated);
      for (int i = 0; i < patch.columns; i += 2) std::printf("  %.2f", towel.saturation(patch.node(i, 8)));
      std::printf("\n");
    }
    world.stepSimulation(btScalar(1) / 60, 0);
  }

  const wetcloth::Ledger ledger = towel.ledger();
  world.removeSoftBody(cloth.get());
  return std::fabs(ledger.imbalance()) < 1e-12 && ledger.evaporated > 0 ? 0 : 1;
}
