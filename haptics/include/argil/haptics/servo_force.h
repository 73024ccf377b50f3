// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/lattice_force.h"

namespace argil::haptics {

/// What the servo asks once a tick: takes the newest window from the clay's thread, sums the force
/// on it, and keeps what is felt free of steps.
///
/// When a window, the clay in it or the tool's size changes, old and new force are both known at
/// that tick and their difference is faded out linearly over kBlendTicks: one query a tick, two on
/// the tick of a change. A tool of another shape or size takes effect with the first window whose
/// spacing fits it (choose_lattice); until then the old one is felt. While the fade runs the force
/// is not conservative: it holds up to half the step of a change times the way moved meanwhile.
///
/// Threads  Realtime: `tick` is for one servo thread; no allocation, lock or system call.
/// Cost     a query of LatticeForce; on the tick of a change a second one, and when the tool's size
///          changed the making of its table (5 us; 25 with an exponent that is not whole).
class ServoForce {
 public:
  /// Over how many ticks the step of a change is faded out: 32 ms at 1 kHz, longer than the 5 to 30
  /// ms between windows, shorter than a hand reacts.
  static constexpr int kBlendTicks = 32;

  /// `channel` must outlive this; its reading side belongs to it.
  ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law) noexcept;

  /// One tick. Before the first window that fits the tool all is zero and `outside_window` is set.
  ForceResult tick(const ForceTool& tool) noexcept;

  /// The window that the last tick read.
  const WindowSlot& window() const noexcept { return channel_.read_slot(); }

 private:
  /// Force and torque as they add up: what is faded.
  struct Wrench {
    Vec3 contact_n;
    Vec3 viscosity_n;
    Vec3 contact_nmm;
    Vec3 viscosity_nmm;
  };
  static Wrench wrench_of(const ForceResult& result) noexcept;
  static Wrench sum(const Wrench& a, const Wrench& b, double share) noexcept;  ///< a + share b
  void take_window(const ForceTool& tool) noexcept;
  ForceResult felt_on_window(const ForceTool& tool) const noexcept;

  WindowChannel& channel_;
  ForceMaterial material_;
  ForceLaw law_;
  std::optional<LatticeForce> force_;  ///< for felt_tool_ on the spacing of the window
  ForceTool felt_tool_;                ///< shape and radii that are felt
  Wrench shown_;                       ///< the last result
  Wrench step_;                        ///< what is being faded out
  int ticks_left_ = 0;
};

}  // namespace argil::haptics
