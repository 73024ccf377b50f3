// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>

namespace argil::haptics {

struct EnergyAccountOptions {
  /// What flows in whatever the hand does, mW (N mm/s); usual 1, half of what the servo puts into
  /// the weakest swing that is called a limit cycle, >= 0. More eases a tool out of clay that was
  /// added around it sooner, and is felt to push.
  double power_mw = 1.0;
  /// The most that is saved up, mJ (N mm); usual 1, >= 0. More is given in one push.
  double most_nmm = 1.0;
  /// Of the device, which takes it from the hand in any case; usual 3, a Falcon's, >= 0. Above the
  /// device's own the loop may give energy.
  double device_damping_n_s_per_m = 3.0;
};

/// What changes of the felt clay may give the hand.
///
/// A tool that rests in a potential cannot be given energy by it. It is given some when the
/// potential under the tool is exchanged for a higher one: by clay that was added there, or by a
/// hand that stops working the clay and feels all of its force again. Such a rise is made only as
/// far as it is paid for from here, so that over any time the hand gets no more than what flowed in
/// and was saved up before. It begins empty.
///
/// Units    energy in N mm, which are mJ.
/// Threads  Realtime: one thread.
/// Source   the energy tanks of M. Franken, S. Stramigioli, S. Misra, C. Secchi, A. Macchelli,
///          "Bilateral telemanipulation with time delays: a two-layer approach combining passivity
///          and transparency", IEEE Trans. Robotics 27(4) (2011). Ours gates a change of the
///          potential and not a force, and what falls give back is not saved.
class EnergyAccount {
 public:
  explicit EnergyAccount(const EnergyAccountOptions& options = {}) noexcept : options_(options) {
    assert(options.power_mw >= 0.0 && options.most_nmm >= 0.0);
    assert(options.device_damping_n_s_per_m >= 0.0);
  }

  /// What flows in during `elapsed_s`, the handle moving at this speed; a time that is not greater
  /// than 0 brings nothing.
  void tick(double elapsed_s, double speed_mm_per_s) noexcept {
    if (!(elapsed_s > 0.0)) return;
    const double damping_n_s_per_mm = 1e-3 * options_.device_damping_n_s_per_m;
    const double power_mw =
        options_.power_mw + damping_n_s_per_mm * speed_mm_per_s * speed_mm_per_s;
    saved_nmm_ = std::min(options_.most_nmm, saved_nmm_ + power_mw * elapsed_s);
  }

  /// What a rise may cost now; >= 0.
  double saved_nmm() const noexcept { return saved_nmm_; }

  /// Takes out what a rise has cost; a fall, which is below 0, costs nothing.
  void pay(double rise_nmm) noexcept {
    assert(rise_nmm <= saved_nmm_ + 1e-6);
    saved_nmm_ = std::max(0.0, saved_nmm_ - std::max(0.0, rise_nmm));
  }

 private:
  EnergyAccountOptions options_;
  double saved_nmm_ = 0.0;
};

}  // namespace argil::haptics
