// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "argil/core/clay_heartbeat.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/servo_force.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/surface_texture.h"

namespace argil::haptics {

struct ClaySceneOptions {
  /// Shape, radii and orientation of the tool; position and velocities are the handle's.
  ForceTool tool;
  ForceMaterial material;
  ForceLaw law = ForceLaw::energy;
  ForceMethod method = ForceMethod::automatic;

  /// How contact and viscosity add up, touching and working (eq. 3 and 4).
  ForceMix mix;
  /// How long p of eq. 5 takes from 0 to 1 and back, s; ModeBlend has usual value and range.
  double mix_ramp_s = ModeBlend::kUsualRampS;

  /// Radius in mm of the ball that the tool cuts away wherever it works, at once and all of it, so
  /// that the hand need not wait for the clay to feel that; usual 0: the tool does something else.
  /// Only for a ball that carves with all its strength, unmasked, and where the hand is; what it
  /// takes too much is missing for OwnCuts::kKeptS and then comes back as the account pays.
  double own_cut_mm = 0.0;

  /// What clay that is added under the tool, and the end of working, may give the hand.
  EnergyAccountOptions account;

  /// When given, what of the clay is too fine for the tool's windows is felt as a vibration while
  /// the tool slides; usually not.
  std::optional<TextureOptions> texture = {};

  /// Where in the clay's frame the device's 0 lies; same axes, same scale. For another scale, and
  /// for an offset that moves: PlacedScene.
  Vec3 offset_mm;

  /// How far the tool may move before the next window comes, mm, of a hand that rests: usually
  /// resting_margin_mm() of the tool, >= 0; small and a hand that starts off fast leaves the
  /// window, large and a window costs more. A hand that moves on gets what its speed needs, v (A +
  /// P + 5 ms) for clay that is felt A late every P, when that is more, and 4 mm at least where A
  /// is above 20 ms. Either is less where the window would not fit kWindowCapacity: for tools below
  /// 0.63 mm, and long ones.
  std::optional<double> margin_mm;

  /// Between samples to the clay, s of the servo's clock; usual 0.005, > 0. A change of is_active
  /// is told at once. Large and strokes lose their curves.
  double sample_period_s = 0.005;

  /// Age of the oldest sample without an answer from which kSceneWindowStale is set, s; usual 0.1,
  /// > 0, above the clay's own period (ClayWorkerOptions::refresh_s) and the time of a step.
  double stale_after_s = 0.1;

  /// Indices that an earlier scene gave to samples on the same ring; this one goes on from there.
  /// Its first sample then ends the stroke that the other may have left open.
  std::uint64_t samples_before = 0;

  /// When given, kSceneClayStopped is set as long as it is not alive. Must outlive the scene.
  const ClayHeartbeat* heartbeat = nullptr;
};

/// The clay as a scene: feels the newest window that the clay's thread published, and tells that
/// thread where the tool is and whether it works.
///
/// Contact and viscosity are mixed with weights that depend on whether the hand touches or works,
/// blended over mix_ramp_s when it changes from one to the other. A hand that stops working feels
/// more of the contact again, which would give it energy: what the account does not pay of that is
/// held back, as after an exchange of windows (ServoForce).
///
/// Faults   kSceneWaiting before the first window; kSceneWindowStale; kSceneOutsideWindow, where
///          the force is what the part of the tool in the window gives; kSceneClayStopped. A full
///          ring is no fault: samples are dropped and counted, and what is not answered in time is
///          stale.
/// Torque   not rendered: the device has three degrees of freedom.
/// Threads  Realtime: as ForceScene (ClaySceneStress.*).
/// Cost     that of ServoForce for each force_at; end_tick also pushes a sample every few ticks.
/// Source   eq. 3 to 5 of Blanch et al. 2004 (docs/equations.md).
class ClayScene final : public ForceScene {
 public:
  /// The scene is the ring's only producer and the channel's only reader; both must outlive it.
  ClayScene(const ClaySceneOptions& options, ToolSampleRing& ring, WindowChannel& channel) noexcept;

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  /// The contact as a hand feels it that touches; no drag and no texture.
  Vec3 touch_n(const HandleState& handle) const noexcept override;
  /// Tells the clay where the proxy is: the tool that is seen is the one that works and is felt.
  void end_tick(const HandleState& tool) noexcept override;
  /// One is spent on whether the texture is touched.
  int most_queries() const noexcept override { return texture_ ? 11 : 12; }
  /// An open stroke ends with the next sample: where the hand was meanwhile is not known, and a
  /// straight cut to where it is now is not what it did.
  void forget_motion() noexcept override;

  /// Tells the clay that the tool no longer works it. Only while the servo does not run.
  void end_stroke() noexcept;

  /// The last index given to a sample, dropped ones included.
  std::uint64_t samples() const noexcept { return samples_; }
  /// Samples that the ring did not take.
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }
  /// The strongest that the texture has been, N; nothing without one. Only while the servo does not
  /// run.
  std::optional<double> most_texture_n() const noexcept {
    return texture_ ? std::optional(texture_->most_force_n()) : std::nullopt;
  }

  WindowStamp window_stamp() const noexcept override {
    return {window().sequence, window().answers, age_s_, lateness_s()};
  }

  /// The contact's energy for the hand at a position, N mm: force_at without its drag and texture
  /// is minus the slope of it. For whoever measures what an exchange of windows gives.
  double energy_at(const HandleState& handle) const noexcept;

  /// The window that this tick reads.
  const WindowSlot& window() const noexcept { return servo_.window(); }

 private:
  ForceTool tool_at(const HandleState& handle) const noexcept;
  double lateness_s() const noexcept;
  double reach_mm() const noexcept;
  void learn(const HandleState& handle) noexcept;
  bool is_sample_due(const HandleState& tool) noexcept;
  void push_sample(const HandleState& tool) noexcept;
  void start_clock(double now_s) noexcept;
  void hear_answer() noexcept;
  void judge(double now_s) noexcept;
  void feel_texture(const ForceTool& tool) noexcept;

  ClaySceneOptions options_;
  ToolSampleRing& ring_;
  ServoForce servo_;
  ToolSample request_;  ///< the window that is wanted, but for its centre and a larger reach
  std::optional<SurfaceTexture> texture_;
  ModeBlend blend_;  ///< p of eq. 5: 0 touches, 1 works
  double last_tick_s_ = 0.0;
  double passed_s_ = 0.0;  ///< since the tick before
  double next_sample_s_ = 0.0;
  bool was_active_ = false;
  bool has_ticked_ = false;
  Vec3 tool_mm_;  ///< of the last end_tick, in the device's frame
  bool has_tool_ = false;
  bool is_cut_ = false;  ///< the next sample ends the stroke
  double clock_start_s_ = 0.0;
  std::uint64_t clock_start_sample_ = 0;  ///< the last one from before
  std::uint64_t samples_ = 0;
  std::uint64_t answered_ = 0;          ///< index of the newest sample answered
  double oldest_unanswered_s_ = 0.0;    ///< its time, when samples_ > answered_
  double age_s_ = -1.0;                 ///< of what this tick feels
  double oldest_s_ = 0.0;               ///< as old as it gets, A + P, lately
  double fastest_mm_per_s_ = 0.0;       ///< of the handle, lately
  std::uint32_t faults_ = kSceneSound;  ///< those of the tick, outside apart
};

}  // namespace argil::haptics
