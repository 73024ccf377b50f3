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

double Governor::tick(double period_s, const DeviceTraits& traits, double nominal_period_s,
                      double coupling_damping_n_s_per_m) noexcept {
  assert(nominal_period_s > 0.0 && traits.damping_n_s_per_m >= 0.0);
  if (period_s_ <= 0.0) period_s_ = nominal_period_s;
  // A slower loop is believed soon, a faster one only when it lasts: it vibrates where it is too
  // stiff.
  if (period_s > 0.0) {
    const double time_s = period_s > period_s_ ? options_.settle_s : options_.recover_s;
    period_s_ += (period_s - period_s_) * std::min(1.0, period_s / time_s);
  }
  if (!options_.is_on) return std::numeric_limits<double>::infinity();
  const double delay_s = traits.delay_s * period_s_ / nominal_period_s;
  return options_.share *
         stiffness_limit_n_per_m(traits.damping_n_s_per_m + coupling_damping_n_s_per_m, period_s_,
                                 delay_s);
}

}  // namespace argil::haptics
