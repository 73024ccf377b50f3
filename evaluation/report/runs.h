// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/haptics/servo/servo.h"

#include "chart/sheet.h"
#include "lab/lab.h"
#include "lab/run.h"

namespace argil::evaluation {

/// A scene of the lab, and how it went on virtual time.
struct SceneRun {
  cli::lab::LabOptions options;
  cli::lab::LabScene scene;
  cli::lab::LabRun run;
};

/// Errors  as the lab's: what stands in `options`, an interrupt.
Result<SceneRun> run_scene(const cli::lab::LabOptions& options, const Progress& progress);

/// The command line of it.
std::string command_of(const cli::lab::LabOptions& options);

inline double time_of(const haptics::ServoTick& tick) { return tick.time_s; }

/// "x y" of ticks of a device that answers, every `stride`-th; a point that repeats once.
using TickValue = std::function<double(const haptics::ServoTick&)>;
std::string tick_points(const std::vector<haptics::ServoTick>& ticks, std::size_t stride,
                        const TickValue& x, const TickValue& y);

}  // namespace argil::evaluation
