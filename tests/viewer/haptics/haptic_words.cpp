// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/haptic_words.h"

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
  EXPECT_TRUE(says(state, "as it should be"));
  state.filter_lag_s = 4e-3;
  EXPECT_TRUE(says(state, "The position filter's lag of 4.0 ms sets the limit"));
  state.is_direct = true;
  EXPECT_TRUE(says(state, "not asked"));
}

TEST(DampingWords, SayHowMuchIsAddedNow) {
  EXPECT_NE(damping_words(0.0).find("adds nothing"), std::string::npos);
  EXPECT_NE(damping_words(12.34).find("ADDS 12.3 N s/m"), std::string::npos);
}

TEST(FalconWords, SayHowFarItHasComeAndWhatToDoNext) {
  const auto says = [](const haptics::FalconStatus& status, const char* words) {
    return falcon_words(status).find(words) != std::string::npos;
  };
  haptics::FalconStatus status;
  status.state = haptics::FalconState::uploading;
  status.uploaded = 0.43;
  status.attempt = 2;
  EXPECT_TRUE(says(status, "43 %, attempt 2"));
  status.state = haptics::FalconState::unhomed;
  status.is_homed = {true, false, true};
  EXPECT_TRUE(says(status, "push it straight in. Arms still to find: 1 of 3"));
  status.is_homed = {true, true, true};
  EXPECT_TRUE(says(status, "Pull the grip out once"));
  EXPECT_FALSE(says(status, "Arms still"));
  status.state = haptics::FalconState::active;
  status.round_trip_s = 1.25e-3;
  EXPECT_TRUE(says(status, "800 exchanges a second"));
  status.state = haptics::FalconState::fault;
  for (int fault = 1; fault < haptics::kFalconFaults; ++fault) {
    status.fault = static_cast<haptics::FalconFault>(fault);
    EXPECT_TRUE(says(status, haptics::falcon_fault_text(status.fault))) << fault;
  }
}

}  // namespace
}  // namespace argil::viewer
