// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/Layout.h"
#include "bullet_wetcloth/Range.h"
#include "bullet_wetcloth/WetCloth.h"

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class BodyFilms;
class SubstepHook;
class WorldPart;

/// How a WetClothWorld gets its turn in each substep.
enum class Hook {
  preTick,  ///< through Bullet's pre-tick callback, the application's own callback running first; and its tick
            ///< callback while a cloth has an effect of the stage `contact`
  manual    ///< the application calls WetClothWorld::preTick(dt) from its own pre-tick callback, and tick(dt) from
            ///< its own tick callback
};

/// Makes the cloths of one Bullet world able to get wet.
///
/// Works with btSoftRigidDynamicsWorld, btSoftMultiBodyDynamicsWorld and btDeformableMultiBodyDynamicsWorld. The
/// application keeps its world, its bodies, its loop and its callbacks; nothing here deletes them. Destroy the
/// WetClothWorld, or detach() it, before the world is deleted, and remove() a cloth before its body is. One object
/// belongs to one thread at a time; different worlds may run in different threads.
class WETCLOTH_EXPORT WetClothWorld {
 public:
  /// Attaches to a world. An application's own callbacks go on being called, first, and the world's user info is not
  /// touched. Throws std::invalid_argument when the world is of another kind or has a WetClothWorld, and when the
  /// program and the library were compiled with settings that do not go together, such as _GLIBCXX_DEBUG in one of
  /// them.
  explicit WetClothWorld(btDynamicsWorld& world, Hook hook = Hook::preTick);
  /// As detach(), unless there are no cloths: then the world is not touched, and may be gone. Callbacks of a world that
  /// is still there are put back when it next calls us. Bodies that were deleted are not touched.
  ~WetClothWorld();
  WetClothWorld(const WetClothWorld&) = delete;
  WetClothWorld& operator=(const WetClothWorld&) = delete;

  /// Wraps a soft body of this world; dry at first. Its free nodes' present masses are their dry masses.
  /// Throws std::invalid_argument when the body is not in the world, was added before, has no nodes or a mass that
  /// is not finite, is a reduced deformable one, or when a field of the fabric is out of range. A cloth whose body was
  /// deleted and that another body is found in the place of, is forgotten. In a step, as in an effect's apply(), it
  /// throws, too: cloths and effects come and go between steps.
  ///
  /// Where Bullet would hang in a step that makes the body's tree of faces anew (MeshReport::bulletBuildsFaceTree()),
  /// as in the first one and after setMass() or a cut, that step begins with our buildFaceTree().
  WetCloth& add(btSoftBody& body, const Fabric& fabric = Fabric::cotton());
  /// The same; throws std::invalid_argument on null.
  WetCloth& add(btSoftBody* body, const Fabric& fabric = Fabric::cotton());
  /// The same for a body that is sewn of several fabrics: node i is of `fabrics[fabricOfNode[i]]`, the first being 0.
  /// Throws std::invalid_argument, too, when there is no fabric, `fabricOfNode` has not one value per node, or a value
  /// is not a place in `fabrics`; then nothing has changed.
  WetCloth& add(btSoftBody& body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode);
  /// The same; throws std::invalid_argument on null.
  WetCloth& add(btSoftBody* body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode);
  /// Lets go of the world now, so that it and its bodies may be deleted in any order: removes the cloths, whose effects
  /// give back what they changed, and puts the application's callbacks back. Afterwards this object does nothing, its
  /// destructor neither, and add(), save() and restore() throw std::invalid_argument.
  void detach();

  /// Forgets a cloth. The body keeps its present (wet) masses. Throws std::invalid_argument when it is not known, and
  /// in a step.
  void remove(btSoftBody& body);
  /// The cloth that wraps this body, or null.
  WetCloth* find(const btSoftBody& body);
  /// The same, to look at.
  const WetCloth* find(const btSoftBody& body) const;
  /// In the order in which they were added: `for (WetCloth& cloth : wet.cloths())`. Ends with the next add() or
  /// remove().
  Range<WetCloth, std::unique_ptr<WetCloth>> cloths() { return Range<WetCloth, std::unique_ptr<WetCloth>>(m_cloths); }
  /// The same, to look at.
  Range<const WetCloth, std::unique_ptr<WetCloth>> cloths() const {
    return Range<const WetCloth, std::unique_ptr<WetCloth>>(m_cloths);
  }

  /// The application's world.
  btDynamicsWorld& world() { return m_world; }
  /// The same, to look at.
  const btDynamicsWorld& world() const { return m_world; }
  /// All soft bodies of the world, wet or not; none once detached.
  const btAlignedObjectArray<btSoftBody*>& softBodies() const;
  /// Whether a body is one of these. Only its address is looked at: it may have been deleted.
  bool isInWorld(const btSoftBody& body) const;

  /// True while Bullet will call us: false after the application has overwritten the pre-tick callback.
  bool isHooked() const;
  /// The same of Bullet's tick callback, which is ours only while a cloth has an effect of the stage `contact`.
  bool isTickHooked() const;

  /// One substep of `dt` seconds, before Bullet predicts: for Hook::manual, and for an application whose own callback
  /// has replaced ours (see isHooked()). A dt that is not finite and positive is ignored. Never throws.
  void preTick(btScalar dt);
  /// The part of the same substep between Bullet's collision detection and its solve, where effects of the stage
  /// `contact` run: for Hook::manual, and for an application whose own tick callback has replaced ours (see
  /// isTickHooked()). Call it from Bullet's tick callback, btDynamicsWorld::setInternalTickCallback(callback, userInfo,
  /// false). A dt that is not finite and positive is ignored. Never throws.
  void tick(btScalar dt);

  /// Saves what this world, its bodies and its cloths carry from one step to the next: a run that is saved and restored
  /// between any two steps goes on as if nothing had been, bit for bit (docs/trust.md tells where it does not).
  ///
  /// Saved are the soft and rigid bodies' motion, sleep and forces, their contacts, Bullet's trees of boxes and pairs,
  /// the world's clock, the water, and what each effect remembers (Effect::transferState()). Left to the application
  /// are what it built and what it set: masses, shapes, materials, m_cfg, anchors, joints, multibodies, motion states,
  /// gravity, the effects' parameters and callbacks.
  /// Throws StateError when the stream fails, and for what is not saved (bodies with tetrahedra or joints of clusters).
  void save(std::ostream& stream) const;
  /// Restores a saved state into a world that the same program has built in the same way: the same bodies, cloths and
  /// effects, added in the same order. So an application builds its scene anew and then restores. Call it between
  /// steps. Throws StateError that names what is wrong with the stream (cut off, changed, foreign, of another version,
  /// precision or world), and then nothing has changed.
  void restore(std::istream& stream);

  /// Films of water on rigid bodies, which ContactWetting takes from: null where nobody puts any there (Drops does).
  BodyFilms* films() const;

  /// Simulated time [s]: the sum of the substeps that the cloths have had. It starts at 0 and goes on, after a
  /// restore(), from the time that was saved.
  double time() const { return m_time; }

  /// Takes the library's messages (a body left the world, was cut, ...). The default writes to std::clog; an empty
  /// function silences them. What it throws is lost.
  void setLog(std::function<void(const std::string&)> log);
  /// Says something through it.
  void log(const std::string& message) const;

 private:
  friend class WetCloth;
  friend class WorldPart;
  WetClothWorld(btDynamicsWorld& world, Hook hook, const Layout& caller);
  void shareTick();
  void transferState(StateArchive& archive);
  void transferSolver(StateArchive& archive) const;
  void requireAttached() const;
  void requireBetweenSteps() const;
  void noticeDeletion(const WetCloth& cloth);
  bool noticePresence(WetCloth& cloth) const;
  Step stepOf(const btSoftBody& body, btScalar dt, double time) const;
  btVector3 gravityOf(const btSoftBody& body) const;
  double fallShareOf(const btSoftBody& body, btScalar dt) const;
  void warnOfMissingGravity(const btSoftBody& body) const;
  void forget(const WetCloth& cloth);
  void leavePart();

  btDynamicsWorld& m_world;
  Hook m_hook;
  std::unique_ptr<SubstepHook> m_substepHook;  // null once detached, or the world was seen to be gone
  std::vector<std::unique_ptr<WetCloth>> m_cloths;
  WorldPart* m_part = nullptr;
  std::function<void(const std::string&)> m_log;
  double m_time = 0;
  double m_stepStart = 0;  // of the substep that runs [s]
  bool m_isStepping = false;
  bool m_sharesTick = false;
};

/// Of the file that includes this: each has a constant of its own.
constexpr Layout kLayout = {sizeof(std::vector<double>), sizeof(std::string), sizeof(std::function<void()>),
                            sizeof(btSoftBody),          sizeof(WetCloth),    sizeof(WetClothWorld)};

inline WetClothWorld::WetClothWorld(btDynamicsWorld& world, Hook hook) : WetClothWorld(world, hook, kLayout) {}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
