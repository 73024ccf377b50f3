// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/force/lattice_force.h"

namespace argil::haptics {

/// How the force is taken from a window.
enum class ForceMethod {
  /// LatticeForce: the sum over the tool's body (default).
  volume,
  /// point_force: eq. 1 and 2 at its centre. Stiffer in the hand, and without a torque.
  point,
};

/// The force that the servo asks for in a tick: takes the newest window from the clay's thread,
/// sums the force on it, and keeps what is felt free of steps.
///
/// When a window, the clay in it or the tool's size changes, old and new force are both known at
/// that tick and their difference is faded out linearly over kFadeMs: one query a tick, two on
/// the tick of a change. A tool of another shape or size takes effect with the first window whose
/// spacing fits it (choose_lattice); until then the old one is felt. While the fade runs the force
/// is not conservative: it holds up to half the step of a change times the path moved meanwhile.
///
/// Threads  Realtime: for one servo thread; no allocation, lock or system call (ServoRealtime.*).
/// Cost     `at` one query of its method; begin_tick none, but on the tick of a change two or
///          three, and when the tool's size changed the making of its table (5 us; 25 with an
///          exponent that is not whole).
class ServoForce {
 public:
  /// How long the step of a change is faded out: longer than the 5 to 30 ms between windows,
  /// shorter than a hand reacts. In time and not in ticks: a fade of 32 ticks cut 4 % more clay at
  /// 4 kHz.
  static constexpr double kFadeMs = 32.0;

  /// `channel` must outlive this, which is its only reader.
  ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law,
             ForceMethod method = ForceMethod::volume) noexcept;

  /// Begins a tick with the tool where it truly is: takes the newest window and sets up the fade of
  /// the change it brings, measured there.
  ///
  /// Units  elapsed_s: since the last tick.
  void begin_tick(const ForceTool& tool, double elapsed_s = 1e-3) noexcept;

  /// The force at any pose in the tick that was begun, what is left of the fade included; the same
  /// for the same pose. The tool's shape and radii do not count, those of begin_tick do. Stiffness,
  /// energy and error are those of the window, not faded.
  ForceResult at(const ForceTool& pose) const noexcept;

  /// One tick with one query: begin_tick, and `at` the same pose. Before the first window that fits
  /// the tool all is zero and `outside_window` is set.
  ForceResult tick(const ForceTool& tool, double elapsed_s = 1e-3) noexcept;

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
  static Wrench sum(const Wrench& a, const Wrench& b, double factor) noexcept;  ///< a + factor b
  void take_window(const ForceTool& tool) noexcept;
  void set_up_fade(const ForceTool& tool) noexcept;
  ForceResult felt_on_window(const ForceTool& tool) const noexcept;

  WindowChannel& channel_;
  ForceMaterial material_;
  ForceLaw law_;
  ForceMethod method_;
  std::optional<LatticeForce> force_;  ///< for felt_tool_ on the spacing of the window
  ForceTool felt_tool_;                ///< shape and radii that are felt
  ForceTool last_tool_;                ///< of the last begin_tick
  Wrench step_;                        ///< what is being faded out
  double fade_left_ms_ = 0.0;          ///< after this tick
  bool is_fading_ = false;             ///< in this tick
};

}  // namespace argil::haptics
