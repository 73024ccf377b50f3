// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/passivity.h"

#include <algorithm>
#include <cassert>

#include "units.h"

namespace argil::haptics {
PassivityController::PassivityController(const PassivityOptions& options, int delay_ticks) noexcept
    : options_(options),
      delay_(static_cast<std::size_t>(std::clamp(delay_ticks, 0, kMostDelayTicks))) {}

Vec3 PassivityController::tick(const Vec3& force_n, const Vec3& moved_mm,
                               double period_s) noexcept {
  assert(is_finite(moved_mm));
  given_nmm_ += dot(written_n_[delay_], moved_mm);
  most_given_nmm_ = std::max(most_given_nmm_, given_nmm_);
  Vec3 given_n = force_n;
  const double way_squared = dot(moved_mm, moved_mm);
  if (options_.controls && given_nmm_ > 0.0 && way_squared > 0.0 && period_s > 0.0) {
    // If the handle goes on as it went, this takes back all of it within the tick.
    given_n -=
        std::min(given_nmm_ / way_squared, options_.most_damping_n_s_per_m / kMmPerM / period_s) *
        moved_mm;
  }
  std::copy_backward(written_n_.begin(), written_n_.end() - 1, written_n_.end());
  written_n_[0] = given_n;
  return given_n;
}

void PassivityController::reset() noexcept {
  written_n_ = {};
  given_nmm_ = 0.0;
}

}  // namespace argil::haptics
