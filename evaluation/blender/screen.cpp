// SPDX-License-Identifier: GPL-3.0-or-later
#include "blender/screen.h"

#include <array>
#include <chrono>
#include <thread>
#include <vector>

#include "blender/child.h"
#include "chart/chart.h"

namespace argil::evaluation {
namespace {

/// How often it is looked whether there is a screen.
constexpr std::chrono::milliseconds kScreenLook{50};
/// Xvfb takes some tenths of a second.
constexpr double kScreenPatienceS = 20.0;

}  // namespace

std::string screen_obstacle() {
  constexpr std::array kNeeded{NeededProgram{"blender", "blender"}, NeededProgram{"Xvfb", "xvfb"}};
  return blender_obstacle(kNeeded);
}

Result<Screen> Screen::open(const cli::ScratchFolder& scratch, const Progress& progress) {
  const OutputFile number(scratch / "display");
  const OutputFile said(scratch / "screen");
  // It writes the number of the first free display to its stdout.
  auto program = std::make_unique<cli::ChildProgram>(
      (scratch / "display").parent_path(),
      std::vector<std::string>{"Xvfb", "-displayfd", "1", "-noreset", "-screen", "0", "1024x768x24",
                               "-nolisten", "tcp"},
      cli::ChildProgram::Output{number.handle(), said.handle()});
  for (double waited_s = 0.0; waited_s < kScreenPatienceS && !program->ended();) {
    if (auto go = tell(progress, "Blender", 0.0); !go) return go.error();
    std::string display = text_in(scratch / "display");
    if (display.ends_with('\n')) {
      display.pop_back();
      return Screen(std::move(program), std::move(display));
    }
    std::this_thread::sleep_for(kScreenLook);
    waited_s += std::chrono::duration<double>(kScreenLook).count();
  }
  return Error{ErrorKind::internal, "Xvfb gave no display (" + text_in(scratch / "screen") + ")"};
}

}  // namespace argil::evaluation
