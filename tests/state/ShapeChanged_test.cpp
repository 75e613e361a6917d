// SPDX-License-Identifier: Zlib
// What effects take from the shape that a cloth has when they are added, or when its shape at rest is changed, is
// saved: restored into a world that was built anew, where they were added to another shape, the run goes on bit for
// bit.

#include "tests/state/StateScene.h"

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::shape_changed_test {
namespace {

using state_scene::Case;
using state_scene::sameNumbers;
using state_scene::StateScene;
using state_scene::Story;
using wetcloth::WetCloth;

/// Another shape: longer one way than the other, so that edges of triangles flip, too.
void lengthenAlongX(btSoftBody& body) {
  for (int k = 0; k < body.m_links.size(); ++k) {
    btSoftBody::Link& link = body.m_links[k];
    const btVector3 along = link.m_n[1]->m_x - link.m_n[0]->m_x;
    const btScalar share = std::fabs(along.x()) / (along.length() + btScalar(1e-9));
    link.m_rl *= 1 + btScalar(0.8) * share;
    link.m_c1 = link.m_rl * link.m_rl;
  }
}

TEST_IN_EVERY_WORLD(ShapeChanged, WhileItRan) {
  for (const Story story : {Story::hanging, Story::onRigid}) {
    SCOPED_TRACE(story);
    StateScene early({GetParam(), story});
    early.step(12);
    lengthenAlongX(early.cloth().body());
    early.step(40);
    const std::string state = early.saved();
    StateScene late({GetParam(), story});
    late.restore(state);
    EXPECT_TRUE(sameNumbers(late.look(), early.look()));
    EXPECT_EQ(late.saved(), state);
    late.step(40);
    early.step(40);
    EXPECT_TRUE(sameNumbers(late.look(), early.look()));
    EXPECT_TRUE(late.saved() == early.saved());
  }
}

/// A wet towel that hangs by its corners, and is given an effect when it has fallen into its folds, or at once.
class Towel {
 public:
  using Add = void (*)(WetCloth&);

  Towel(WorldKind kind, Add addEffects) : m_scene(kind, hangingPatch(6)), m_wet(m_scene.world()), m_add(addEffects) {
    m_scene.addBulletSprings(20, 0.05);
    m_scene.body().m_cfg.collisions = m_scene.bullet().isDeformable()
                                          ? btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN
                                          : btSoftBody::fCollision::SDF_RS;
    for (int i = 0; i < m_scene.body().m_nodes.size(); i += 3) m_scene.node(i).m_v = btVector3(1, 0, btScalar(0.4 * i));
    WetCloth& cloth = m_wet.add(m_scene.body());
    std::vector<double> held;
    for (int i = 0; i < cloth.nodeCount(); ++i) held.push_back((i % 5) * 0.2 * cloth.capacity(i));
    cloth.setHeld(held);
  }
  void add() { m_add(m_wet.cloths()[0]); }
  void step(int count) { m_scene.bullet().step(count); }
  void lengthen() { lengthenAlongX(m_scene.body()); }
  std::string saved() const {
    std::ostringstream stream;
    m_wet.save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet.restore(stream);
  }

 private:
  BodyScene m_scene;
  wetcloth::WetClothWorld m_wet;
  Add m_add;
};

void expectTheSame(WorldKind kind, Towel::Add add) {
  for (const bool isLengthened : {false, true}) {
    SCOPED_TRACE(isLengthened);
    Towel early(kind, add);
    early.step(20);
    if (isLengthened) early.lengthen();
    early.add();
    early.step(10);
    const std::string state = early.saved();
    Towel late(kind, add);
    late.add();
    late.restore(state);
    EXPECT_TRUE(late.saved() == state);
    early.step(20);
    late.step(20);
    EXPECT_TRUE(late.saved() == early.saved());
  }
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeDryingWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::Drying>(); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeDiffusionWasAdded) {
  for (const Towel::Add add :
       {Towel::Add([](WetCloth& cloth) { cloth.add<wetcloth::Diffusion>(); }), Towel::Add([](WetCloth& cloth) {
          wetcloth::Diffusion::Parameters wicking;
          wicking.warpDiffusivity = 2e-5;
          wicking.warp = btVector3(1, 1, 0);
          cloth.add<wetcloth::Diffusion>(wicking);
        }),
        Towel::Add([](WetCloth& cloth) {
          wetcloth::Diffusion::Parameters wicking;
          wicking.method = wetcloth::Diffusion::Method::explicitSubsteps;
          cloth.add<wetcloth::Diffusion>(wicking);
        })}) {
    expectTheSame(GetParam(), add);
  }
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeSeepageWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::Seepage>(); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeDrippingWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) {
    cloth.setSaturation(1);
    cloth.add<wetcloth::Dripping>();
  });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeWindWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) {
    wetcloth::Wind::Parameters air;
    air.velocity = btVector3(1, 0, 4);
    air.skinFriction = 0.01;
    cloth.add<wetcloth::Wind>(air);
  });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeWaterDragWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) {
    wetcloth::WaterDrag::Parameters pool;
    pool.surface = wetcloth::WaterSurface();
    pool.surface->offset = -0.5;
    cloth.add<wetcloth::WaterDrag>(pool);
  });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeRainWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::Rain>(); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeSplashWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::Splash>(); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeImmersionWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) {
    wetcloth::Immersion::Parameters pool;
    pool.surface = wetcloth::WaterSurface();
    pool.surface->offset = -0.5;
    cloth.add<wetcloth::Immersion>(pool);
  });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeSwellingWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::Swelling>(); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeStiffnessWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) {
    if (cloth.isInDeformableWorld()) cloth.add<wetcloth::HookeSprings>(springsOf(50, 2));
    cloth.add<wetcloth::WetStiffness>();
  });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeSpringsWereAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::HookeSprings>(springsOf(50, 2)); });
}

TEST_IN_EVERY_WORLD(ShapeChanged, BeforeTheAuditWasAdded) {
  expectTheSame(GetParam(), [](WetCloth& cloth) { cloth.add<wetcloth::CollisionAudit>(); });
}

}  // namespace
}  // namespace wetcloth_test::shape_changed_test
