// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// The handle, or the proxy that stands for it, as a scene sees it. Frame: mm about the middle of
/// the device's workspace, x to the right, y up, z towards the user.
struct HandleState {
  Vec3 position_mm;
  Vec3 velocity_mm_per_s;
  /// Of the servo's clock.
  double time_s = 0.0;
  /// The hand works the clay (it holds the button), rather than touching it.
  bool is_active = false;
};

/// What a scene can find wrong with itself. Bits; the servo answers each as docs/lab.md says.
enum SceneFault : std::uint32_t {
  kSceneSound = 0,
  kSceneWindowStale = 1U << 0,    ///< the clay has not answered for too long
  kSceneOutsideWindow = 1U << 1,  ///< the tool has left what the scene knows
  kSceneClayStopped = 1U << 2,    ///< the clay's thread has ended
  kSceneNotFinite = 1U << 3,      ///< a force that is not finite; set by the coupling
  kSceneWaiting = 1U << 4,        ///< nothing is known yet: before the clay's first window
  kSceneClutched = 1U << 5,       ///< the handle is being moved elsewhere in the workspace
  kSceneStopped = 1U << 6,        ///< a simulator says stop, or has left: no force at once
};

struct SceneForce {
  Vec3 force_n;  ///< on the handle

  /// How fast the force grows with depth here, >= 0: the coupling's first guess. 0 where it is not
  /// known and where nothing is touched.
  double stiffness_n_per_m = 0.0;
  std::uint32_t faults = kSceneSound;
};

/// Which window of the clay was felt: what a recording needs to be replayed, and how old it was.
struct WindowStamp {
  /// Its number; 0: none.
  std::uint64_t sequence = 0;
  /// Index of the newest ToolSample that it takes into account.
  std::uint64_t answers = 0;
  /// From that sample's time until the tick, s: how long ago the clay was as it is felt. Below 0
  /// where that is not known: nothing was answered yet on this clock.
  double age_s = -1.0;
  /// How much later than the tool's motion its work on the clay is felt, on average, s; 0: nothing
  /// is worked, or what is worked is felt at once. Not in recordings.
  double lateness_s = 0.0;
};

/// What a scene's aid may know of a tick, besides where the tool is.
struct AidTick {
  /// Since the last tick, > 0.
  double elapsed_s = 1e-3;
  /// How much of the last aid the device was given, 0 to 1; ramps and limits took the rest.
  double given_part = 1.0;
  /// The hand's own place, which no filter has touched, in the scene's frame: the aid works on its
  /// motion.
  Vec3 handle_mm;
  /// From a force written to the force held.
  int delay_ticks = 1;
  /// How stiff an aid may be in the hand, >= 0: Governor::aid_stiffness_n_per_m.
  double most_stiffness_n_per_m = 500.0;
};

/// Something to feel: a force for every position and velocity.
///
/// In a tick the servo calls begin_tick once with the true handle, then force_at one or more times
/// (a virtual coupling searches for its proxy), then aid_n and end_tick with the proxy.
///
/// Errors   a fault of SceneForce; a force that is not finite is one too.
/// Threads  Realtime: all are for the servo's thread; noexcept, no allocation, lock or system call.
class ForceScene {
 public:
  virtual ~ForceScene() = default;
  ForceScene() = default;
  ForceScene(const ForceScene&) = delete;
  ForceScene& operator=(const ForceScene&) = delete;

  /// Takes what is new (a window, the time). Scenes without a state need none.
  virtual void begin_tick(const HandleState& handle) noexcept;

  /// The force at a position; the same for the same position within a tick.
  virtual SceneForce force_at(const HandleState& handle) const noexcept = 0;

  /// What the surface itself pushes there, along its normal: without drag, and however little a
  /// hand that works feels of it. 0 where nothing is touched.
  virtual Vec3 touch_n(const HandleState& handle) const noexcept;

  /// A force on the handle besides what is felt at the tool, such as guidance: the coupling neither
  /// knows nor balances it. Once in a tick, with the tool as end_tick has it, before that.
  virtual Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept;

  /// Where the tool has ended up in this tick: the proxy, or the handle where they are one.
  virtual void end_tick(const HandleState& tool) noexcept;

  /// The motion from the last tick to the next one means nothing: the clock jumped, the device was
  /// lost, a force was not finite, the servo ended. No stroke may be made of it. Called between
  /// ticks, perhaps again and again, and perhaps without a tick after it.
  virtual void forget_motion() noexcept;

  /// Most calls of force_at in a tick that the scene can afford; 1 or more.
  virtual int most_queries() const noexcept { return 40; }

  /// Which of the clay's windows this tick feels.
  virtual WindowStamp window_stamp() const noexcept { return {}; }
};

inline void ForceScene::begin_tick(const HandleState& /*handle*/) noexcept {}
/// Of a tool at rest: what is left is the surface's, where a scene has nothing else.
inline Vec3 ForceScene::touch_n(const HandleState& handle) const noexcept {
  HandleState at_rest = handle;
  at_rest.velocity_mm_per_s = {};
  return force_at(at_rest).force_n;
}
inline Vec3 ForceScene::aid_n(const HandleState& /*tool*/, const AidTick& /*tick*/) noexcept {
  return {};
}
inline void ForceScene::end_tick(const HandleState& /*tool*/) noexcept {}
inline void ForceScene::forget_motion() noexcept {}

}  // namespace argil::haptics
