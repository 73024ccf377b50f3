// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/haptic_words.h"

#include <cassert>
#include <cstdio>

namespace argil::viewer {
namespace {

/// A loop that is slower than this fraction of what was asked is what limits.
constexpr double kSlow = 0.9;

/// printf with up to two numbers.
std::string numbers(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace

std::string governor_words(const GovernorState& state) {
  assert(state.nominal_period_s > 0.0);
  if (state.is_direct) {
    return "Governor: not asked. A direct coupling feels the material as it is, whose surface "
           "force "
           "is kept within what this device holds steadily.";
  }
  if (!(state.allowed_n_per_m > 0.0)) return "Governor: waits for the first tick.";
  const double nominal_hz = 1.0 / state.nominal_period_s;
  // The allowed stiffness falls with the period of a tick, so a slow loop is named as the cause.
  const bool is_slow = state.rate_hz > 0.0 && state.rate_hz < kSlow * nominal_hz;
  const std::string why =
      state.filter_lag_s > 0.0 ? numbers("The position filter's lag of %.1f ms sets the limit.",
                                         1e3 * state.filter_lag_s)
      : is_slow ? numbers("The slow loop sets the limit: %.0f ticks a second instead of %.0f.",
                          state.rate_hz, nominal_hz)
                : numbers("The device's damping and delay set the limit, at %.0f ticks a second.",
                          state.rate_hz > 0.0 ? state.rate_hz : nominal_hz);
  if (state.asked_n_per_m > state.allowed_n_per_m) {
    return numbers("Governor: ACTIVE, holds the coupling at %.0f N/m of the %.0f asked. ",
                   state.allowed_n_per_m, state.asked_n_per_m) +
           why + " This is as it should be: it keeps the force steady.";
  }
  return numbers("Governor: at rest, %.0f N/m asked and up to %.0f allowed. ", state.asked_n_per_m,
                 state.allowed_n_per_m) +
         why;
}

std::string damping_words(double added_n_s_per_m) {
  assert(added_n_s_per_m >= 0.0);
  if (added_n_s_per_m == 0.0) return "Damping: adaptive, adds nothing, since nothing swings.";
  return numbers("Damping: adaptive, ADDS %.1f N s/m, since the handle swings in what it touches.",
                 added_n_s_per_m);
}

std::string falcon_words(const haptics::FalconStatus& status) {
  switch (status.state) {
    case haptics::FalconState::closed:
      return "Falcon: closed.";
    case haptics::FalconState::probing:
      return "Falcon: asking whether its firmware runs.";
    case haptics::FalconState::uploading:
      return numbers("Falcon: sending its firmware, %.0f %%, attempt %.0f.",
                     100.0 * status.uploaded, status.attempt);
    case haptics::FalconState::unhomed: {
      std::string words = "Falcon: homing. ";
      int missing = 0;
      for (const bool is_homed : status.is_homed) missing += is_homed ? 0 : 1;
      if (missing == 0) return words.append("Pull the grip out once, then the force comes.");
      words.append("Pull the grip fully out, then push it straight in. ");
      return words.append(numbers("Arms still to find: %.0f of 3.", missing));
    }
    case haptics::FalconState::active:
      return numbers(
          "Falcon: active, %.0f exchanges a second. The large button of its grip works the clay.",
          status.round_trip_s > 0.0 ? 1.0 / status.round_trip_s : 0.0);
    case haptics::FalconState::fault:
      return std::string("Falcon: ").append(haptics::falcon_fault_text(status.fault));
  }
  return "";
}

}  // namespace argil::viewer
