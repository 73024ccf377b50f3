// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/governor.h"

#include <algorithm>
#include <limits>

namespace argil::haptics {

double stiffness_limit_n_per_m(double damping_n_s_per_m, double period_s, double delay_s) noexcept {
  return damping_n_s_per_m / (0.5 * period_s + delay_s);
}

double Governor::tick(double period_s, const DeviceTraits& traits, double nominal_period_s,
                      double coupling_damping_n_s_per_m) noexcept {
  if (period_s_ <= 0.0) period_s_ = nominal_period_s;
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
