// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/passivity.h"

#include <algorithm>
#include <cassert>

#include "math/units.h"

namespace argil::haptics {

PassivityController::PassivityController(const PassivityOptions& options, int delay_ticks) noexcept
    : options_(options),
      delay_(static_cast<std::size_t>(std::clamp(delay_ticks, 0, kMostDelayTicks))) {
  assert(options.most_damping_n_s_per_m > 0.0);
}

Vec3 PassivityController::tick(const Vec3& force_n, const Vec3& moved_mm,
                               double period_s) noexcept {
  assert(is_finite(moved_mm) && delay_ < written_n_.size());
  // The force that acted while the handle moved is `delay_` ticks old.
  given_nmm_ += dot(written_n_[delay_], moved_mm);
  most_given_nmm_ = std::max(most_given_nmm_, given_nmm_);
  Vec3 given_n = force_n;
  const double moved_squared = dot(moved_mm, moved_mm);
  if (options_.controls && given_nmm_ > 0.0 && moved_squared > 0.0 && period_s > 0.0) {
    // If the handle moves on as it did, this takes back all of it within the tick.
    given_n -=
        std::min(given_nmm_ / moved_squared, options_.most_damping_n_s_per_m / kMmPerM / period_s) *
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
