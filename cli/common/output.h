// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/haptics/servo/histogram.h"
#include "argil/mesh/check.h"

#include "common/outcome.h"

namespace argil::cli {

/// Exit status for an error: docs/command_line.md.
int status_of(ErrorKind kind) noexcept;

/// {"error":{"kind","message","status"}}
Json error_json(const std::string& kind, const std::string& message, int status);
std::string kind_name(ErrorKind kind);

/// An error of work on `file` with its name in front, where it is not said yet: readers say it, but
/// what is found among triangles or in a clay knows no file. Not where the disk is at fault, which
/// may be that of another file, nor for an interrupt.
Error named(const std::filesystem::path& file, Error error);

Json to_json(const Vec3& v);
Json to_json(const std::vector<LevelStats>& levels);
Json to_json(const mesh::MeshVerdict& verdict);
/// The names of a servo's faults.
Json faults_json(std::uint32_t faults);
/// {"p50","p99","max"} by nearest rank; zeros when there are none.
Json percentiles(std::vector<double> values);
/// Of ServoRun::window_age: "p50", "p99" and "max" in ms.
Json age_json(const haptics::Histogram& ages);

std::string hex(std::uint64_t hash);
/// Up to six significant digits.
std::string number(double value);
/// With the thousands parted by spaces.
std::string grouped(std::int64_t value);
/// A table of the levels, one line each.
std::string levels_text(const std::vector<LevelStats>& levels);
std::string verdict_text(const mesh::MeshVerdict& verdict);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Draws a bar on stderr when that is a terminal and the user did not ask for quiet, and asks the
/// work to stop when it is interrupted (io/safe_file.h). `finish_progress` removes the bar.
Progress terminal_progress(bool quiet);
void finish_progress();

/// A line on stderr, once in a process and unless `quiet`: what a servo's threads were refused, and
/// the remedy (ServoThread::priority_refusal, FalconDevice's or HapticRig's). Of "" nothing.
void note_refusal(const std::string& refusal, bool quiet);

/// interrupted after such a signal, between stages that do not report progress.
Result<void> check_interrupt();

}  // namespace argil::cli
