// SPDX-License-Identifier: GPL-3.0-or-later
// How old the clay is that a hand feels while it carves: a stroke at 50 mm/s around a bumpy ball of
// 2 M vertices, dabs and windows on one thread, as ClayWorker has them, and a servo of 1 kHz in
// real time. The age of a tick is its time less that of the newest sample which its window answers.
// Usage: bench_age [SECONDS [CSV]], 3 by default; ages by percentile go to the file, which
// docs/charts/age.gp draws
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "argil/engine/clay_worker.h"
#include "argil/haptics/force/lattice_force.h"

#include "bench/ball_session.h"
#include "bench/quantile.h"

namespace argil::bench {
namespace {

constexpr double kMmPerS = 50.0;
constexpr double kTickS = 1e-3;

struct Ages {
  std::vector<double> ms;  ///< of each tick that had a window
  ClayWorkerCounts counts;
};

/// The hand's way around the ball, half sunk into it.
Vec3 place_at(double time_s, double ball_mm, double radius_mm) {
  const double away = ball_mm + height_of(Action::carve) * radius_mm;
  const double turn = kMmPerS * time_s / away;
  return {away * std::cos(turn), away * std::sin(turn), 0.0};
}

/// The servo's side: samples as ClayScene sends them, and the ages of the windows.
class Servo {
 public:
  Servo(double ball_mm, double radius_mm) : ball_mm_(ball_mm), radius_mm_(radius_mm) {
    haptics::ForceTool tool;
    tool.radii_mm = {radius_mm, radius_mm, radius_mm};
    const haptics::Lattice lattice = haptics::choose_lattice(tool);
    sample_.voxel_mm = lattice.voxel_mm;
    sample_.reach_mm =
        std::min(haptics::window_reach_mm(tool, lattice, haptics::resting_margin_mm(tool)),
                 kMostWindowReachVoxels * lattice.voxel_mm);
    sample_.depth_mm = haptics::window_depth_mm(tool, {}, lattice);
    sample_.pressure = 1.0;
    sample_.is_active = true;
  }

  void run(double seconds, ToolSampleRing& ring, WindowChannel& channel, std::vector<double>& ms) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const int ticks = static_cast<int>(seconds / kTickS);
    for (int n = 0; n < ticks; ++n) {
      std::this_thread::sleep_until(begin + n * std::chrono::milliseconds(1));
      const double now = std::chrono::duration<double>(Clock::now() - begin).count();
      ++sample_.index;
      sample_.time_s = now;
      sample_.position_mm = place_at(now, ball_mm_, radius_mm_);
      ring.push(sample_);
      channel.fetch();
      const WindowSlot& slot = channel.read_slot();
      if (slot.answers > 0) ms.push_back(1e3 * (now - slot.time_s));
    }
  }

 private:
  double ball_mm_;
  double radius_mm_;
  ToolSample sample_;
};

Result<Ages> measure(Ball& ball, double radius_mm, double seconds) {
  ClayWorkerOptions options;
  options.tool.action = Action::carve;
  options.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  options.tool.strength = 0.2;  // a hand holds on to the depth that it has
  ToolSampleRing ring(1024);
  WindowChannel channel;
  ClayWorker worker(ball.clay, options, ring, channel);
  Ages ages;
  std::atomic<bool> is_over = false;
  std::thread servo([&] {
    Servo(ball.radius_mm, radius_mm).run(seconds, ring, channel, ages.ms);
    is_over = true;
  });
  Result<bool> done = true;
  while (!is_over) {
    const auto stepped = worker.step();
    if (!stepped) done = stepped;
    if (!stepped || !stepped.value()) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
  servo.join();
  if (const auto finished = worker.finish(); !finished) return finished.error();
  if (!done) return done.error();
  ages.counts = worker.counts();
  return ages;
}

void write_percentiles(double radius_mm, const std::vector<double>& ms, std::FILE* csv) {
  for (int percent = 0; percent <= 100; ++percent) {
    std::fprintf(csv, "%g,%d,%.3f\n", radius_mm, percent, quantile(ms, 0.01 * percent));
  }
}

/// `csv` may be null.
Result<void> run(double seconds, std::FILE* csv) {
  auto ball = made_ball(2'000'000);
  if (!ball) return ball.error();
  std::printf("| R, mm | age of the clay, ms: p50 / p99 / max | windows/s | dabs/s |\n");
  std::printf("|---|---|---|---|\n");
  for (const double radius : {1.0, 4.0, 16.0}) {
    const auto ages = measure(ball.value(), radius, seconds);
    if (!ages) return ages.error();
    const std::vector<double>& ms = ages.value().ms;
    std::printf("| %g | %.1f / %.1f / %.1f | %.0f | %.0f |\n", radius, quantile(ms, 0.5),
                quantile(ms, 0.99), quantile(ms, 1.0),
                static_cast<double>(ages.value().counts.windows) / seconds,
                static_cast<double>(ages.value().counts.dabs) / seconds);
    std::fflush(stdout);
    if (csv != nullptr) write_percentiles(radius, ms, csv);
    ball.value().clay.undo();
  }
  return {};
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 3.0;
  std::FILE* csv = argc > 2 ? std::fopen(argv[2], "w") : nullptr;
  if (argc > 2 && csv == nullptr) {
    std::fprintf(stderr, "bench_age: '%s' cannot be written\n", argv[2]);
    return 1;
  }
  if (csv != nullptr) std::fprintf(csv, "radius_mm,percent,age_ms\n");
  const auto done = argil::bench::run(seconds, csv);
  const bool is_written = csv == nullptr || std::fclose(csv) == 0;
  if (done && is_written) return 0;
  std::fprintf(stderr, "bench_age: %s\n",
               done ? "the file could not be written whole" : done.error().message.c_str());
  return 1;
}
