// SPDX-License-Identifier: Zlib
// What your renderer draws: a vertex buffer of your own, filled with positions, normals, colour and roughness in one
// pass; and what your debug drawer draws: the cloth by its saturation, and the wind on it.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>
#include <vector>

struct Vertex {  // as your shader wants it
  float position[3];
  float normal[3];
  float colour[3];  // linear RGB
  float roughness;
};

// Yours draws with OpenGL; this one counts.
class CountingDrawer : public btIDebugDraw {
 public:
  int lines = 0, triangles = 0;
  using btIDebugDraw::drawTriangle;
  void drawLine(const btVector3&, const btVector3&, const btVector3&) override { ++lines; }
  void drawTriangle(const btVector3&, const btVector3&, const btVector3&, const btVector3&, btScalar) override {
    ++triangles;
  }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return 0; }
};

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getWorldInfo().m_gravity = btVector3(0, btScalar(-9.81), 0);
  world.getWorldInfo().m_sparsesdf.Initialize();

  wetcloth::ClothPatch patch;
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  const std::unique_ptr<btSoftBody> body = patch.build(world.getWorldInfo());
  world.addSoftBody(body.get());
  wetcloth::WetClothWorld wet(world);
  wetcloth::WetCloth& cloth = wet.add(*body, wetcloth::Fabric::cotton());
  cloth.add<wetcloth::Absorption>();
  adjust(cloth.add<wetcloth::Wind>(), [](auto& wind) { wind.velocity = btVector3(0, 0, 3); });

  std::vector<Vertex> vertices(static_cast<std::size_t>(cloth.nodeCount()));
  constexpr int stride = sizeof(Vertex) / sizeof(float);  // offsets and strides count floats, as Bullet's own do
  const wetcloth::VertexBuffer buffer = {vertices[0].position, cloth.nodeCount(), {0, stride},
                                         {3, stride},          {6, stride},       {9, stride}};
  const Vertex& middle = vertices[static_cast<std::size_t>(patch.node(16, 16))];
  std::printf("time [s]  the middle: position [m]       normal              colour (linear)   roughness\n");
  for (int frame = 0; frame <= 600; ++frame) {
    world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
    wetcloth::fillVertexBuffer(cloth, buffer);  // then upload it
    if (frame % 120 != 0) continue;
    const auto& [x, n, c, roughness] = middle;
    std::printf("%8d  %8.3f %6.3f %6.3f    %6.3f %6.3f %6.3f   %.3f %.3f %.3f   %.3f\n", frame / 60, x[0], x[1], x[2],
                n[0], n[1], n[2], c[0], c[1], c[2], roughness);
  }

  CountingDrawer drawer;
  wetcloth::debugDraw(wet, drawer);
  std::printf("The debug drawer got %d triangles and %d lines of wind.\n", drawer.triangles, drawer.lines);
  world.removeSoftBody(body.get());
  return middle.roughness < 0.6F && drawer.triangles == body->m_faces.size() && drawer.lines > 0 ? 0 : 1;
}
