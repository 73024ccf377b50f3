// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/lattice_force.h"

namespace argil::haptics {

/// What the servo asks once a tick: takes the newest window, evaluates the force on it, and keeps
/// the force continuous when the window, the clay in it or the tool's size changed.
class ServoForce {
 public:
  /// Over how many ticks the step of a change is faded out.
  static constexpr int kBlendTicks = 32;

  ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law) noexcept;

  /// One tick. Threads: Realtime, one servo thread.
  ForceResult tick(const ForceTool& tool) noexcept;

  /// Sequence of the window that the last tick read; 0 before the first window.
  std::uint64_t sequence() const noexcept;
};

}  // namespace argil::haptics
