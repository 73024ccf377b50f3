// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures by a gnuplot of the test's own, which does what the real one does not do on demand.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/setting.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Gnuplot : public testing::Test {
 protected:
  Gnuplot() {
    fs::create_directory(folder_ / "bin");
    fs::create_directory(folder_ / "tmp");
    fill(picture(), "what was there");
  }

  fs::path picture() const { return folder_ / "run.svg"; }
  /// What it leaves behind in the place for scratch.
  bool has_leftovers() const { return !fs::is_empty(folder_ / "tmp"); }

  /// Draws a run by a gnuplot that does this in the folder where it is to draw.
  Ended draw(const std::string& shell, const RunOptions& options = {}) const {
    const fs::path program = folder_ / "bin/gnuplot";
    fill(program, "#!/bin/sh\n" + shell + "\n");
    fs::permissions(program, fs::perms::owner_all);
    const Setting path("PATH", (folder_ / "bin").string() + ":/usr/bin:/bin");
    const Setting scratch("TMPDIR", (folder_ / "tmp").string());
    return run_argil(
        {"lab", "wall-linear", "--seconds", "2", "--plot", picture().string(), "--json"}, options);
  }

  std::string file(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }

  ScratchFolder folder_;
};

TEST_F(Gnuplot, DrawsWhereNobodyElseCanEnter) {
  const Ended run =
      draw("stat -c %a .. >" + file("mode") + "; printf '<svg>new</svg>\\n\\n' >run.svg");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(content_of(folder_ / "mode"), "700\n");
  EXPECT_THAT(content_of(picture()), HasSubstr("new"));
  EXPECT_FALSE(has_leftovers());
}

TEST_F(Gnuplot, EndsWithAnInterruptAndThePictureStays) {
  RunOptions interrupted;
  interrupted.interrupt_when = [&] { return content_of(folder_ / "begun").ends_with('\n'); };
  const Ended run = draw("echo $$ >" + file("begun") + "; exec sleep 600", interrupted);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(run.json()["error"]["kind"], "interrupted");
  EXPECT_EQ(content_of(picture()), "what was there");
  EXPECT_FALSE(has_leftovers());
  EXPECT_EQ(::kill(std::stoi(content_of(folder_ / "begun")), 0), -1) << "it goes on";
  EXPECT_EQ(errno, ESRCH);
}

/// The terminal tells both: that gnuplot fails then is no fault of its script.
TEST_F(Gnuplot, ThatFailsByCtrlCIsAnInterrupt) {
  const Ended run = draw("kill -INT $PPID; exit 1");
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(run.json()["error"]["kind"], "interrupted");
}

/// As by a forced end, which runs no destructors.
TEST_F(Gnuplot, GoesWithTheProgramThatBeganIt) {
  RunOptions killed;
  killed.signal = SIGKILL;
  killed.interrupt_when = [&] { return content_of(folder_ / "begun").ends_with('\n'); };
  const Ended run =
      draw("echo begun >" + file("begun") + "; sleep 1; echo survived >" + file("after"), killed);
  EXPECT_EQ(run.signal, SIGKILL);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_FALSE(fs::exists(folder_ / "after"));
}

TEST_F(Gnuplot, WhosePictureIsCutOffChangesNothing) {
  const Ended run = draw("printf '<svg>half of the pict' >run.svg");
  EXPECT_EQ(run.status, 5);
  EXPECT_THAT(run.err, HasSubstr("cut off"));
  EXPECT_EQ(content_of(picture()), "what was there");
  EXPECT_FALSE(has_leftovers());
}

TEST_F(Gnuplot, IsQuotedWhereItFails) {
  const Ended run = draw("echo this is wrong >&2; printf '<svg>x</svg>' >run.svg; exit 1");
  EXPECT_EQ(run.status, 5);
  EXPECT_THAT(run.err, HasSubstr("this is wrong"));
  EXPECT_EQ(content_of(picture()), "what was there");
}

}  // namespace
}  // namespace argil::test
