// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/EffectSwitches.h"
#include "command/viewer/Grip.h"
#include "command/viewer/History.h"
#include "command/viewer/Picking.h"

#include "command/render/FrameSampler.h"
#include "command/scene/SceneWorld.h"

#include <memory>
#include <optional>
#include <string>

namespace viewer {

enum class Side { wet, plainBullet };

/// A scene that runs while somebody plays with it, without any window. Beside it, on request, the same scene in plain
/// Bullet.
///
/// What is set stays set when the scene is reset. Setters throw std::invalid_argument naming the field and the value,
/// and then nothing changes.
class LiveScene {
 public:
  /// Throws InputError when the library refuses a cloth or an effect.
  explicit LiveScene(command::Scene scene, const command::EffectCatalogue& catalogue = command::effectCatalogue());

  // --- time -------------------------------------------------------------------------------------------------

  /// Lets time pass on the clock: as many steps as it holds, times the time scale. When the machine cannot keep up, the
  /// scene is slower than the clock. Nothing while paused.
  /// @param seconds since the last call; what is not in (0, inf) counts for nothing
  void advance(double seconds);
  /// One step, paused or not.
  void step();
  /// Back to the start, with all that was set; no cloth is held. What the library does not take together (effects that
  /// were turned on one after the other) goes back to what the scene says, and notice() tells why.
  void reset();
  /// The same, and all settings but the pause and the time scale are the scene's own again.
  void restore();

  void setPaused(bool paused) { m_isPaused = paused; }
  bool isPaused() const { return m_isPaused; }
  /// @param scale simulated time over the clock's, (0, 4]
  void setTimeScale(double scale);
  double timeScale() const { return m_timeScale; }
  double time() const { return m_wet->time(); }  ///< simulated [s]
  long long steps() const { return m_steps; }    ///< since the start
  /// Why the run ended, on one line; empty: it has not. A reset clears it.
  const std::string& failure() const { return m_failure; }
  /// Why the last reset did not keep all that was set; empty: it did.
  const std::string& notice() const { return m_notice; }

  // --- effects ----------------------------------------------------------------------------------------------

  const EffectSwitches& effects() const { return m_effects; }
  /// By its key in a scene.
  bool isOn(const std::string& effect) const;
  /// By its place in effects().list(). A refusal by the library stands there, too.
  void turnEffect(std::size_t index, bool on);
  /// Per step of the scene: all of the library's part, its commits included [us].
  double libraryMicroseconds() const;
  /// The rest of the same step, which is Bullet's [us].
  double bulletMicroseconds() const;

  // --- levers -----------------------------------------------------------------------------------------------

  /// Of the air, the same everywhere, for the effect wind [m/s]; finite.
  void setWind(const btVector3& velocity);
  /// What the effect wind has now: where it varies, at the centre of a cloth. 0 where there is none.
  btVector3 wind() const;
  /// Whether the wind is the scene's, which differs from place to place or in time.
  bool windVaries() const;

  /// To water, for the effect absorption, [0, 1].
  void setExposure(double exposure);
  /// What the effect absorption has now; where it varies, or where there is none, 1.
  double exposure() const;
  /// Whether the exposure is the scene's, which differs from place to place.
  bool exposureVaries() const;

  /// For the effect rain [kg/m^2/s], >= 0.
  void setRainFlux(double flux);
  double rainFlux() const;
  /// In which drops fall, of any length > 0.
  void setRainDirection(const btVector3& direction);
  btVector3 rainDirection() const;

  /// A preset of the library for all cloths, from the next reset on; they keep the scene's colours.
  void setFabric(const std::string& preset);
  /// Empty: the scene's own.
  const std::string& fabric() const { return m_levers.fabric; }
  /// Who steps the cloths, from the next reset on; plain Bullet stays on its own. The world "deformable" has only that.
  void setSolver(command::SolverKind solver);
  command::SolverKind solver() const { return m_levers.solver.value_or(m_original.solver()); }
  /// Whether something that was set waits for a reset.
  bool waitsForReset() const;

  /// Per step of the scene, [1, 1000].
  void setSubsteps(int substeps);
  int substeps() const { return m_scene.substeps; }
  /// Of Bullet's solvers, [1, 10000].
  void setIterations(int iterations);
  int iterations() const { return m_scene.iterations; }

  // --- comparison -------------------------------------------------------------------------------------------

  /// Plain Bullet goes on from where the wet cloths are now.
  void setCompared(bool compared);
  bool isCompared() const { return m_plain != nullptr; }

  // --- hand -------------------------------------------------------------------------------------------------

  /// Takes hold of the first cloth on a ray; false when there is none.
  bool grab(const Ray& ray, Side side = Side::wet);
  /// Where the held node is to go [m]; ignored when nothing is held or a number is not finite.
  void dragTo(const btVector3& goal);
  void release() { m_grip.reset(); }
  /// What is held; null: nothing.
  const Grip* grip() const { return m_grip ? &*m_grip : nullptr; }
  Side grippedSide() const { return m_grippedSide; }

  // --- what there is to see ---------------------------------------------------------------------------------

  const command::Scene& scene() const { return m_scene; }
  const command::SceneWorld& world() const { return *m_wet; }
  const pictures::Scenery& scenery() const { return m_sampler->scenery(); }
  const std::vector<pictures::ClothShape>& cloths() const { return m_sampler->cloths(); }
  /// As it is now. Plain Bullet's only while isCompared().
  const pictures::Frame& frame(Side side);

  double waterHeld() const;                                          ///< [kg]
  double meanSaturation() const;                                     ///< water over capacity, all cloths together
  const History& waterHistory() const { return m_water; }            ///< one value per step [kg]
  const History& saturationHistory() const { return m_saturation; }  ///< one value per step

 private:
  struct Levers {
    std::optional<btVector3> wind;
    std::optional<double> exposure;
    std::optional<double> rainFlux;
    std::optional<btVector3> rainDirection;
    std::string fabric;
    std::optional<command::SolverKind> solver;
  };

  command::Scene equippedScene();
  void build();
  void buildAgain();
  void buildPlain();
  void forgetSettings();
  void pullLevers();
  void pull(Side side, btScalar dt);
  void note();

  command::Scene m_original;
  EffectSwitches m_effects;
  command::Scene m_scene;  // the one that runs; the worlds refer to it
  std::unique_ptr<command::SceneWorld> m_wet;
  std::unique_ptr<command::SceneWorld> m_plain;
  std::unique_ptr<command::FrameSampler> m_sampler;
  Levers m_levers;
  std::string m_fabricInUse;
  std::optional<Grip> m_grip;
  Side m_grippedSide = Side::wet;
  pictures::Frame m_frames[2];
  bool m_isPaused = false;
  double m_timeScale = 1;
  double m_timeLeft = 0;  // on the clock, not yet simulated [s]
  long long m_steps = 0;
  std::string m_failure;
  std::string m_notice;
  History m_water;
  History m_saturation;
};

}  // namespace viewer
