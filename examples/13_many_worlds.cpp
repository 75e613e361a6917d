// SPDX-License-Identifier: Zlib
// Eight worlds in one process, each with a towel in a wind of its own, stepped side by side on the threads of Bullet's
// task scheduler. Each comes bit for bit to what it comes to alone.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <LinearMath/btThreads.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>
#include <vector>

namespace {

// All that a world needs is its own: nothing is shared between threads.
class Room {
 public:
  explicit Room(double windSpeed) {
    m_world.getWorldInfo().m_sparsesdf.Initialize();
    wetcloth::ClothPatch patch;
    patch.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft, wetcloth::ClothPatch::Corner::topRight};
    m_cloth = patch.build(m_world.getWorldInfo());
    m_world.addSoftBody(m_cloth.get());
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_world);
    m_towel = &m_wet->add(*m_cloth, wetcloth::Fabric::cotton());
    m_towel->add<wetcloth::Absorption>();
    wetcloth::Wind::Parameters wind;
    wind.velocity = btVector3(0, 0, btScalar(windSpeed));  // [m/s]
    m_towel->add<wetcloth::Wind>(wind);
  }
  ~Room() {
    m_wet.reset();
    m_world.removeSoftBody(m_cloth.get());
  }

  void step(int count) {
    for (int i = 0; i < count; ++i) m_world.stepSimulation(btScalar(1) / 240, 0);
  }
  double held() const { return m_towel->ledger().held; }
  // Where every node is, and what it holds.
  std::vector<double> look() const {
    std::vector<double> all;
    for (int i = 0; i < m_towel->nodeCount(); ++i) {
      const btVector3& place = m_cloth->m_nodes[i].m_x;
      for (const btScalar coordinate : {place.x(), place.y(), place.z()}) all.push_back(double(coordinate));
      all.push_back(m_towel->held(i));
    }
    return all;
  }

 private:
  btSoftBodyRigidBodyCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btDbvtBroadphase m_broadphase;
  btSequentialImpulseConstraintSolver m_solver;
  btSoftRigidDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
  std::unique_ptr<btSoftBody> m_cloth;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  wetcloth::WetCloth* m_towel = nullptr;
};

using Rooms = std::vector<std::unique_ptr<Room>>;

Rooms rooms() {
  Rooms made;
  for (int speed = 0; speed < 8; ++speed) made.push_back(std::make_unique<Room>(speed));
  return made;
}

struct StepRooms : btIParallelForBody {
  explicit StepRooms(Rooms& these) : m_rooms(these) {}
  void forLoop(int begin, int end) const override {
    for (int i = begin; i < end; ++i) m_rooms[static_cast<std::size_t>(i)]->step(120);
  }
  Rooms& m_rooms;
};

}  // namespace

int main() {
  Rooms together = rooms();
  // Null where Bullet was built without threads, as Debian's is: then an application brings a scheduler of its own.
  const std::unique_ptr<btITaskScheduler> scheduler(btCreateDefaultTaskScheduler());
  btSetTaskScheduler(scheduler ? scheduler.get() : btGetSequentialTaskScheduler());
  std::printf("%s, %d threads\n", btGetTaskScheduler()->getName(), btGetTaskScheduler()->getNumThreads());
  btGetTaskScheduler()->parallelFor(0, static_cast<int>(together.size()), 1, StepRooms(together));
  btSetTaskScheduler(nullptr);

  Rooms alone = rooms();
  bool alike = true;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    alone[i]->step(120);
    alike = alike && alone[i]->look() == together[i]->look();
    std::printf("wind %zu m/s: %.2f g of water\n", i, 1000 * together[i]->held());
  }
  std::printf(alike ? "The same bits as one after another.\n" : "Other bits than one after another.\n");
  return alike ? 0 : 1;
}
