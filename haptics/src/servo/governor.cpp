// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/governor.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace argil::haptics {

double stiffness_limit_n_per_m(double damping_n_s_per_m, double period_s, double delay_s) noexcept {
  assert(period_s > 0.0 && delay_s >= 0.0);
  return damping_n_s_per_m / (0.5 * period_s + delay_s);
}

double chatter_limit_n_per_m(double mass_kg, double lateness_s) noexcept {
  assert(mass_kg > 0.0 && lateness_s > 0.0);
  constexpr double kPi = 3.14159265358979323846;
  return mass_kg * (kPi / lateness_s) * (kPi / lateness_s);
}

/// What is slower is believed soon, what is faster only when it lasts: it vibrates where it is too
/// stiff, and a spring that stiffens under load gives the hand energy.
double Governor::believe(double value, double before, double period_s) const noexcept {
  const double time_s = value > before ? options_.settle_s : options_.recover_s;
  return before + (value - before) * std::min(1.0, period_s / time_s);
}

double Governor::tick(double period_s, const DeviceTraits& traits, double nominal_period_s,
                      double coupling_damping_n_s_per_m, double lateness_s) noexcept {
  assert(nominal_period_s > 0.0 && traits.damping_n_s_per_m >= 0.0 && lateness_s >= 0.0);
  if (period_s_ <= 0.0) period_s_ = nominal_period_s;
  if (period_s > 0.0) {
    period_s_ = believe(period_s, period_s_, period_s);
    lateness_s_ = believe(lateness_s, lateness_s_, period_s);
  }
  if (!options_.is_on) return std::numeric_limits<double>::infinity();
  const double late_s = delay_s(traits, nominal_period_s);
  const double limit = options_.share * stiffness_limit_n_per_m(
                                            traits.damping_n_s_per_m + coupling_damping_n_s_per_m,
                                            period_s_, late_s);
  if (lateness_s_ <= 0.0 || traits.mass_kg <= 0.0) return limit;
  const double total_s = lateness_s_ + 0.5 * period_s_ + late_s;
  return std::min(limit, chatter_limit_n_per_m(traits.mass_kg, total_s));
}

double Governor::aid_stiffness_n_per_m(const DeviceTraits& traits,
                                       double nominal_period_s) const noexcept {
  assert(period_s_ > 0.0 && nominal_period_s > 0.0);
  return 0.5 * options_.share *
         stiffness_limit_n_per_m(traits.damping_n_s_per_m, period_s_,
                                 delay_s(traits, nominal_period_s));
}

}  // namespace argil::haptics
