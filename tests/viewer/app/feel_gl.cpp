// SPDX-License-Identifier: GPL-3.0-or-later
// Weights, ramp and position filter (eq. 3 to 8 of Blanch et al. 2004) in the device panel: what is
// chosen there is what the recording of the run says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/haptics/servo/recording.h"
#include "argil/io/project_file.h"

#include "viewer/support/window_run.h"

namespace argil {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ViewFeelGl : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", Clay::ball(25.0, {}).value()).ok());
  }

  /// What the recording says that a script makes, of a window with a simulated Falcon.
  std::string recorded(const std::string& script, const std::string& more = "") {
    const test::WindowRun run = play(
        "settle\nframes 10\n" + script +
            "click Record\nframes 10\nclick End the recording\nframes 5\n",
        test::shell_word(folder_ / "s.vdb") + " --device sim " + more, "--width 900 --height 780");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.value("complaints", nlohmann::json()).size(), 0U) << run.report.dump();
    const auto recording = haptics::read_recording(folder_ / "argil-run-1.csv");
    EXPECT_TRUE(recording.ok()) << recording.error().message;
    return recording ? recording.value().note : "";
  }
};

TEST_F(ViewFeelGl, WhatIsChosenInThePanelIsFelt) {
  const std::string note = recorded(
      "click Feel\nframes 3\nclick Filter positions\nframes 3\nclick Tau\nframes 3\n"
      "click Touch and work\nframes 3\nclick Work: drag\nframes 3\nclick Changeover\nframes 90\n"
      "click Feel\nframes 3\n");
  // A click on a slider chooses what lies there, beyond the usual 0.2, 1 and 0.1.
  EXPECT_THAT(note, AllOf(HasSubstr(" filter=0."), Not(HasSubstr(" filter=0.2"))));
  EXPECT_THAT(note, HasSubstr("filter-lambda=0.3"));
  EXPECT_THAT(note, HasSubstr("mix-passive=1,0.3"));
  EXPECT_THAT(note, HasSubstr("mix-active=0.3,1."));
  EXPECT_THAT(note, HasSubstr("mix-ramp=1"));
}

TEST_F(ViewFeelGl, DampingIsFixedOrAdaptiveAsChosen) {
  EXPECT_THAT(recorded(""), Not(HasSubstr("damping")));
  const std::string chosen =
      "click Feel\nframes 3\nclick Damping\nframes 3\nclick Damping/Adaptive\nframes 90\n"
      "click Feel\nframes 3\n";
  std::filesystem::remove(folder_ / "argil-run-1.csv");
  EXPECT_THAT(recorded(chosen), HasSubstr("damping=adaptive"));
}

TEST_F(ViewFeelGl, TheCommandLineBeginsWithIt) {
  const std::string note =
      recorded("", "--filter 0.4 --filter-lambda 0.7 --mix-active 0.2,1.5 --damping adaptive");
  EXPECT_THAT(note, HasSubstr("damping=adaptive"));
  EXPECT_THAT(note, HasSubstr("filter=0.4, filter-lambda=0.7"));
  EXPECT_THAT(note, HasSubstr("mix-active=0.2,1.5"));
}

}  // namespace
}  // namespace argil
