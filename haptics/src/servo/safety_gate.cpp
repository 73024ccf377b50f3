// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/safety_gate.h"

#include <algorithm>
#include <cassert>

namespace argil::haptics {
namespace {

/// A gain after a tick of its ramp from 0 to 1 in `ramp_s`, or back.
double ramp(double gain, double period_s, double ramp_s, double towards) noexcept {
  assert(gain >= 0.0 && gain <= 1.0 && period_s >= 0.0);
  const double step = ramp_s > 0.0 ? period_s / ramp_s : 1.0;
  return towards > gain ? std::min(gain + step, towards) : std::max(gain - step, towards);
}

}  // namespace

const char* fault_text(std::uint32_t faults) noexcept {
  if ((faults & kForceNotFinite) != 0) {
    return "the scene gave a force that is not a number; the force was cut to zero";
  }
  if ((faults & kDeviceLost) != 0) {
    return "the device does not answer; check its cable and its power adapter";
  }
  if ((faults & kClockJumped) != 0) {
    return "the servo was held up for more than 50 ms and three ticks, or its clock went back; "
           "close other programs, or allow it real-time priority";
  }
  if ((faults & kStopping) != 0) return "the servo has ended";
  if ((faults & kHalted) != 0)
    return "the emergency stop was pressed; resume when nothing is in the way";
  if ((faults & kSimulatorStop) != 0) return "the simulator says stop, or has left; let it go on";
  if ((faults & kWindowStale) != 0) {
    return "the clay has not answered in time; use a smaller tool or a coarser voxel";
  }
  if ((faults & kOutsideWindow) != 0) {
    return "the tool moved faster than the clay could follow; move slower or use a smaller tool";
  }
  if ((faults & kClayStopped) != 0) return "the clay's thread has ended; see its error";
  if ((faults & kWaiting) != 0) return "waiting for the clay's first window";
  if ((faults & kClutched) != 0) return "the clutch is held; let go of it to feel again";
  if ((faults & kForceLimited) != 0) return "the force reached its limit";
  if ((faults & kSlewLimited) != 0) return "the force changed faster than its limit";
  return "";
}

bool shorten(Vec3& force_n, double most_n) noexcept {
  assert(!(most_n < 0.0));
  const double size = length(force_n);
  if (!(size > most_n)) return false;  // also for NaN: an infinite slew in a tick of no time
  force_n *= most_n / size;
  return true;
}

Vec3 SafetyGate::limit(const Vec3& wanted_n, std::uint32_t& faults, double period_s) noexcept {
  if (!is_finite(wanted_n)) faults |= kForceNotFinite;
  if ((faults & kCutFaults) != 0) {
    gain_ = 0.0;
    given_n_ = good_n_ = {};
    return {};
  }
  const bool fades = (faults & kRampFaults) != 0;
  gain_ =
      ramp(gain_, period_s, fades ? options_.ramp_out_s : options_.ramp_in_s, fades ? 0.0 : 1.0);
  if (!fades) {
    good_n_ = wanted_n;
    if (shorten(good_n_, options_.most_force_n)) faults |= kForceLimited;
  }
  Vec3 step = gain_ * good_n_ - given_n_;
  if (shorten(step, options_.most_slew_n_per_s * period_s)) faults |= kSlewLimited;
  given_n_ += step;
  shorten(given_n_, options_.most_force_n);  // rounding only
  assert(is_finite(given_n_));
  return given_n_;
}

}  // namespace argil::haptics
