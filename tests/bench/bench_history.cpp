// SPDX-License-Identifier: GPL-3.0-or-later
// What a kept history costs: opening a project with none, with few and with as many steps as are
// kept, the first undo beyond the opening, and closing. Bumpy balls with detail everywhere, of half
// a million and eight million surface vertices; strokes of 1000 samples. Prints a markdown table:
// CPU seconds of all threads, of opening medians of five; peaks are beyond what the process had.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "argil/io/session.h"

#include "bench/clock.h"
#include "bench/memory.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"

namespace {

using namespace argil;
namespace fs = std::filesystem;

constexpr double kVoxelMm = 0.25;
constexpr int kRuns = 5;

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): nothing else runs
}

template <class T>
T take(Result<T> result) {
  if (!result) fail(result.error().message);
  return std::move(result).value();
}

void check(const Result<void>& result) {
  if (!result) fail(result.error().message);
}

io::SessionOptions keeping() {
  io::SessionOptions options;
  options.autosave_steps = 0;
  options.keeps_history = true;
  return options;
}

/// A wave of 1000 samples over a few millimetres somewhere on the ball.
Stroke any_stroke(std::mt19937& random, double radius_mm) {
  const auto angle = [&] { return 1e-6 * static_cast<double>(random() % 6283185); };
  const double turn = angle();
  const double rise = 0.4 * std::sin(angle());
  Stroke stroke;
  stroke.tool.radii_mm = {1.5, 1.5, 1.5};
  stroke.tool.strength = 0.3;
  for (int n = 0; n < 1000; ++n) {
    const double along = turn + 3e-5 * n;
    const double up = rise + 0.005 * std::sin(0.02 * n);
    stroke.samples.push_back({0.01 * n,
                              radius_mm * Vec3{std::cos(along) * std::cos(up),
                                               std::sin(along) * std::cos(up), std::sin(up)},
                              {},
                              0.5 + 0.4 * std::sin(0.013 * n)});
  }
  return stroke;
}

double open_cpu_s(const fs::path& project) {
  std::array<double, kRuns> runs{};
  for (double& run : runs) {
    const double begin = bench::process_cpu_ms();
    io::Session session = take(io::Session::open(project, keeping()));
    run = 1e-3 * (bench::process_cpu_ms() - begin);
    check(session.discard());
  }
  std::sort(runs.begin(), runs.end());
  return runs[kRuns / 2];
}

/// A project of the ball with so many steps more than it has.
void add_steps(const fs::path& project, int steps, double radius_mm, std::mt19937& random) {
  io::Session session = take(io::Session::open(project, keeping()));
  for (int n = 0; n < steps; ++n) {
    const Stroke stroke = any_stroke(random, radius_mm);
    take(session.clay().apply(stroke));
    session.record(stroke);
  }
  check(session.close());
}

void row(const fs::path& project, const std::string& name) {
  const double open = open_cpu_s(project);
  io::Session session = take(io::Session::open(project, keeping()));
  const io::HistorySize size = session.history_size();
  const double before_mb = bench::begin_peak();
  const double begin = bench::process_cpu_ms();
  check(session.deepen());
  const double deepened = bench::process_cpu_ms();
  const double peak_mb = bench::status_mb("VmHWM") - before_mb;
  const int depth = session.sculpture().undo_depth();
  check(session.close());
  std::printf("| %s | %zu | %.1f | %.2f | %.2f | %d | %.0f | %.2f |\n", name.c_str(), size.steps,
              1e-6 * static_cast<double>(size.bytes), open, 1e-3 * (deepened - begin), depth,
              peak_mb, 1e-3 * (bench::process_cpu_ms() - deepened));
  std::fflush(stdout);
}

void rows(double vertices) {
  const double radius_mm = kVoxelMm * std::sqrt(vertices / 1.5 / (4.0 * std::numbers::pi));
  const test::ScratchFolder folder;
  const fs::path project = folder / "ball.vdb";
  io::Session made =
      take(io::Session::create(project, take(test::bumpy_ball(radius_mm, kVoxelMm)), keeping()));
  check(made.close());
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "ball, %.1f M vertices", 1e-6 * vertices);
  std::mt19937 random(5);
  for (const int more : {0, 20, 480}) {
    if (more > 0) add_steps(project, more, radius_mm, random);
    row(project, name.data());
  }
}

}  // namespace

int main() {
  std::printf(
      "| project | steps kept | MB | open: CPU s | first undo beyond it: CPU s | steps that "
      "memory holds then | peak MB | close: CPU s |\n|---|---|---|---|---|---|---|---|\n");
  for (const double vertices : {0.5e6, 8e6}) rows(vertices);
}
