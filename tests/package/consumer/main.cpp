// SPDX-License-Identifier: Zlib
// An application that uses all that an installed library offers: effects, save and restore, a vertex buffer, the
// collision checks, an error. As a plugin, its host calls useWetCloth().
#include <bullet_wetcloth/bullet_wetcloth.h>
#include <bullet_wetcloth/collision/ContinuousCheck.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef _WIN32
#define SHOWN __declspec(dllexport)
#else
#define SHOWN __attribute__((visibility("default")))
#endif

namespace {

struct Scene {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<btSoftBody> cloth;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
  wetcloth::WetCloth* towel = nullptr;

  Scene() {
    world.getWorldInfo().m_sparsesdf.Initialize();
    wetcloth::ClothPatch patch;
    patch.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft, wetcloth::ClothPatch::Corner::topRight};
    cloth = patch.build(world.getWorldInfo());
    world.addSoftBody(cloth.get());
    wet = std::make_unique<wetcloth::WetClothWorld>(world);
    towel = &wet->add(*cloth, wetcloth::Fabric::cotton());
    towel->add<wetcloth::Absorption>();
    towel->add<wetcloth::Diffusion>();
    wetcloth::Wind::Parameters wind;
    wind.velocity = btVector3(4, 0, 1);
    towel->add<wetcloth::Wind>(wind);
    towel->add<wetcloth::HookeSprings>();
    towel->add<wetcloth::CollisionAudit>();
  }
  ~Scene() {
    wet.reset();
    world.removeSoftBody(cloth.get());
  }

  void step(int count) {
    for (int i = 0; i < count; ++i) world.stepSimulation(btScalar(1) / 240, 0);
  }
  std::string state() const {
    std::ostringstream stream;
    wet->save(stream);
    return stream.str();
  }
};

bool restoredRunGoesOn() {
  Scene first;
  first.step(5);
  Scene second;
  std::istringstream saved(first.state());
  second.wet->restore(saved);
  first.step(5);
  second.step(5);
  return first.towel->ledger().held > 0 && first.state() == second.state();
}

bool damagedStateIsRefused() {
  Scene scene;
  std::istringstream damaged("not a state");
  try {
    scene.wet->restore(damaged);
  } catch (const wetcloth::StateError&) {
    return true;
  }
  return false;
}

bool badParameterIsRefused() {
  Scene scene;
  wetcloth::Rain::Parameters rain;
  rain.flux = -1;
  try {
    scene.towel->add<wetcloth::Rain>(rain);
  } catch (const std::invalid_argument&) {
    return true;
  }
  return false;
}

bool vertexBufferIsFilled() {
  Scene scene;
  scene.step(1);
  const auto nodes = static_cast<std::size_t>(scene.cloth->m_nodes.size());
  std::vector<float> floats(3 * nodes, -1.0f);
  wetcloth::VertexBuffer buffer;
  buffer.base = floats.data();
  buffer.vertexCount = static_cast<int>(nodes);
  buffer.colour = {0, 3};
  wetcloth::fillVertexBuffer(*scene.towel, buffer);
  return floats.front() >= 0 && floats.back() >= 0;
}

bool pointMeetsTriangle() {
  using namespace wetcloth::collision;
  const Query<double> query{{{0.2, 0.2, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                            {{0.2, 0.2, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  return ContinuousCheck(Tier::conservative)(Pair::vertexFace, query).found;
}

}  // namespace

/// How many of the uses above failed.
extern "C" SHOWN int useWetCloth() {
  struct Use {
    const char* name;
    bool (*works)();
  };
  int failed = 0;
  for (const Use& use : {Use{"save and restore", restoredRunGoesOn}, Use{"damaged state", damagedStateIsRefused},
                         Use{"bad parameter", badParameterIsRefused}, Use{"vertex buffer", vertexBufferIsFilled},
                         Use{"collision check", pointMeetsTriangle}}) {
    if (use.works()) continue;
    std::printf("failed: %s\n", use.name);
    ++failed;
  }
  return failed;
}

int main() {
  const int failed = useWetCloth();
  const wetcloth::Fabric fabric = wetcloth::Fabric::cotton();
  std::printf("capacity %g, float%d\n", fabric.capacity, static_cast<int>(8 * sizeof(btScalar)));
  return failed;
}
