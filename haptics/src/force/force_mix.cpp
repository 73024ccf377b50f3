// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/force_mix.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <sstream>

namespace argil::haptics {
namespace {

struct Weight {
  const char* name;
  double value;
};

Error not_greater(const Weight& large, const Weight& small) {
  std::ostringstream what;
  what << large.name << " is " << large.value << " and " << small.name << " is " << small.value
       << "; " << large.name << " must be greater than " << small.name;
  return {ErrorKind::bad_input, what.str()};
}

Error not_a_weight(const Weight& weight, double least) {
  std::ostringstream what;
  what << weight.name << " is " << weight.value << "; must be " << least << " to "
       << ForceMix::kMost;
  return {ErrorKind::bad_input, what.str()};
}

}  // namespace

Result<void> validate(const ForceMix& mix) {
  const Weight contact_passive{"contact_passive", mix.contact_passive};
  const Weight viscosity_passive{"viscosity_passive", mix.viscosity_passive};
  const Weight contact_active{"contact_active", mix.contact_active};
  const Weight viscosity_active{"viscosity_active", mix.viscosity_active};
  const auto is_in = [](const Weight& w, double least) {  // a NaN is outside
    return w.value >= least && w.value <= ForceMix::kMost;
  };
  for (const Weight& w : {contact_passive, contact_active}) {
    if (!is_in(w, ForceMix::kLeastContact)) return not_a_weight(w, ForceMix::kLeastContact);
  }
  for (const Weight& w : {viscosity_passive, viscosity_active}) {
    if (!is_in(w, 0.0)) return not_a_weight(w, 0.0);
  }
  const std::array<std::array<Weight, 2>, 4> large_and_small{
      {{contact_passive, viscosity_passive},
       {viscosity_active, contact_active},
       {contact_passive, contact_active},
       {viscosity_active, viscosity_passive}}};
  for (const auto& [large, small] : large_and_small) {
    if (large.value <= small.value) return not_greater(large, small);
  }
  return {};
}

Vec3 mix_forces(const ForceMix& mix, const Vec3& contact, const Vec3& viscosity,
                double p) noexcept {
  assert(p >= 0.0 && p <= 1.0);
  return contact_share(mix, p) * contact +
         std::lerp(mix.viscosity_passive, mix.viscosity_active, p) * viscosity;
}

double contact_share(const ForceMix& mix, double p) noexcept {
  return std::lerp(mix.contact_passive, mix.contact_active, p);
}

ModeBlend::ModeBlend(double ramp_s) noexcept : ramp_s_(ramp_s) {
  assert(ramp_s >= 0.0 && ramp_s <= kMostRampS);
}

double ModeBlend::tick(bool is_active, double period_s) noexcept {
  if (!(period_s > 0.0)) return p_;
  const double step = period_s / ramp_s_;
  p_ = std::clamp(is_active ? p_ + step : p_ - step, 0.0, 1.0);
  return p_;
}

}  // namespace argil::haptics
