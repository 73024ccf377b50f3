// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "argil/core/clay_heartbeat.h"
#include "argil/haptics/rig/rig.h"

#include "commands/brush.h"
#include "commands/ui_state.h"
#include "document/document_thread.h"

namespace argil::viewer {

/// The force in the hand while sculpting: runs the rig that the state of the window asks for, ties
/// it to the document thread, and leads the simulated hand by the mouse.
///
/// Threads  the window's.
class HapticControl {
 public:
  HapticControl(UiState& ui, DocumentThread& document, haptics::FalconOptions falcon = {});
  /// The document thread must have let go of ring and channel: UnlinkHaptics was sent and done, or
  /// the thread has ended.
  ~HapticControl() = default;
  HapticControl(const HapticControl&) = delete;
  HapticControl& operator=(const HapticControl&) = delete;

  /// Once a frame: stops the force or gives it again; starts, stops and restarts the rig as the
  /// state asks; leads the hand to the pointer, where it works the clay while `presses` (the
  /// mouse's left button, over the clay). What cannot be done comes back as an error, once.
  Result<void> tick(double now_s, const std::optional<SurfaceHit>& hit, bool presses);

  bool is_running() const noexcept { return rig_.is_running(); }
  /// Begins to record the servo's ticks, or ends it: then the file. Errors  as HapticRig's.
  Result<std::filesystem::path> toggle_recording();
  haptics::HapticRig& rig() noexcept { return rig_; }
  double most_force_n() const noexcept { return most_force_n_; }

  /// What the surface's force may be at most so that the material, as it is chosen, is felt
  /// steadily: a direct coupling has nothing else that holds it back (haptics::check_rig).
  double most_surface_force_n() const;

 private:
  haptics::RigOptions wanted_options() const;
  bool is_as_wanted() const;
  void obey();
  Result<void> start(double now_s);
  void stop();
  void lead(const std::optional<SurfaceHit>& hit, bool presses);

  UiState& ui_;
  DocumentThread& document_;
  haptics::FalconOptions falcon_;  ///< but for the firmware (UiState::firmware)
  ClayHeartbeat heartbeat_;
  HapticChoice running_;
  std::filesystem::path firmware_;  ///< of what runs, as brush_ and clay_
  Brush brush_;                     ///< of what runs
  double radius_mm_ = 0.0;
  std::optional<PieceKey> piece_;
  std::filesystem::path clay_;
  std::filesystem::path recording_;
  double tried_s_ = -1.0;
  std::optional<SurfaceHit> last_hit_;
  double most_force_n_ = 0.0;
  bool was_pressing_ = false;
  bool is_on_clay_ = false;  ///< what is pressed, or would be
  bool is_refusal_told_ = false;
  haptics::HapticRig rig_;  ///< last: its thread, which uses the heartbeat, ends first
};

}  // namespace argil::viewer
