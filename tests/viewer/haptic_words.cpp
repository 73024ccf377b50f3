// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_words.h"

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

bool says(const GovernorState& state, const char* words) {
  return governor_words(state).find(words) != std::string::npos;
}

TEST(GovernorWords, SayWhetherItHoldsHowMuchAndWhatSetsTheLimit) {
  GovernorState state;
  state.asked_n_per_m = 1500.0;
  EXPECT_TRUE(says(state, "waits"));
  state.allowed_n_per_m = 2200.0;
  state.rate_hz = 998.0;
  EXPECT_TRUE(says(state, "at rest, 1500 N/m asked and up to 2200"));
  EXPECT_TRUE(says(state, "damping and delay"));
  state.allowed_n_per_m = 900.0;
  state.rate_hz = 500.0;
  EXPECT_TRUE(says(state, "ACTIVE, holds the coupling at 900 N/m of the 1500"));
  EXPECT_TRUE(says(state, "500 ticks a second instead of 1000"));
  state.is_direct = true;
  EXPECT_TRUE(says(state, "not asked"));
}

}  // namespace
}  // namespace argil::viewer
