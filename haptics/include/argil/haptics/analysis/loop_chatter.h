// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>

namespace argil::haptics {

/// A handle that carves: mass, damping and hand, and a spring between where the tool is and where
/// it was when it cut what it feels.
///
///   m s^2 + b s + k_h + K (e^(-t_d s) - e^(-tau s)) = 0
///
/// with tau from the tool's motion to the force that knows of what it has cut. Behind a coupling
/// the spring and the coupling are in series.
struct CarvingLoop {
  /// m, with the hand's; > 0.
  double mass_kg = 0.4589;
  /// b, physical, with the hand's; >= 0.
  double damping_n_s_per_m = 3.0;
  /// k_h, of the hand's spring to its intended position; >= 0.
  double hand_stiffness_n_per_m = 0.0;
  /// K, of the felt force; > 0.
  double stiffness_n_per_m = 0.0;
  /// k_c; infinite: none.
  double coupling_n_per_m = std::numeric_limits<double>::infinity();
  /// t_d: half a tick and the device's delay, by which the place itself is felt late; >= 0.
  double delay_s = 1.5e-3;
};

/// Where a loop begins to cycle by itself.
struct Chatter {
  double lateness_s = 0.0;  ///< tau
  double frequency_hz = 0.0;
};

/// The shortest tau, longer than t_d, at which the loop has a root on the imaginary axis; none: it
/// is calm however late the clay is.
///
/// Accuracy  1e-4 of tau; friction, encoder and the clamp of the force are left out
///           (LateWindows.CycleWhereTheEquationSays).
/// Threads   any; no allocation.
/// Cost      1 ms.
/// Source    docs/theory.md, "Late windows".
std::optional<Chatter> first_chatter(const CarvingLoop& loop) noexcept;

/// tau of clay that is felt A late when a window is new and every P (docs/theory.md, "Late
/// windows"). All in s, >= 0.
struct CarvingLateness {
  double age_s = 0.0;       ///< A
  double period_s = 0.0;    ///< P, between windows
  double dab_s = 0.0;       ///< D, between what the clay hears of the tool
  double exchange_s = 0.0;  ///< L, until a new window is felt: half of how long it is blended in
  double delay_s = 1.5e-3;  ///< t_d, as of the loop
  /// A + P/2 + D/2 + L + t_d.
  double total_s() const noexcept {
    return age_s + 0.5 * period_s + 0.5 * dab_s + exchange_s + delay_s;
  }
};

}  // namespace argil::haptics
