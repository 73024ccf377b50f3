// SPDX-License-Identifier: GPL-3.0-or-later
// A long session: ten thousand dabs, each with its mirror image, on a ball of half a million
// surface vertices, in strokes of a hundred that carve and add in turn; every other stroke is
// undone and done again, and every fourth undone for good. What dabs, the ends of strokes, undo and
// redo cost, with the surface brought up to date; and, at the hand's own speed, how far the clay
// lags behind it. Prints two markdown tables. Usage: bench_long_session [strokes, usually 100];
// about five minutes and 2 GB.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "argil/engine/surface.h"

#include "bench/ball_session.h"
#include "bench/clock.h"
#include "bench/hand.h"
#include "bench/quantile.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

constexpr int kDabs = 100;  ///< of a stroke
constexpr double kSpacing = 0.25;

/// Wall times in ms; those of clay alone and with the surface after it.
struct Costs {
  std::vector<double> dab;
  std::vector<double> dab_cpu;
  std::vector<double> end;
  std::vector<double> end_all;
  std::vector<double> undo;
  std::vector<double> undo_all;
  std::vector<double> redo;
  std::vector<double> redo_all;
};

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "bench_long_session: %s\n", what);
  std::exit(1);
}

/// Does something with the clay and then the surface.
template <class Work>
void timed(Clay& clay, Surface& surface, const Work& work, std::vector<double>& alone,
           std::vector<double>& all) {
  const double start = wall_ms();
  if (!work()) fail("a step failed");
  alone.push_back(wall_ms() - start);
  surface.update(clay);
  all.push_back(wall_ms() - start);
}

void stroke(Clay& clay, Surface& surface, const Tool& tool, int number, double ball_mm,
            Costs& costs) {
  const StrokeStyle style{.spacing = kSpacing, .mirror = {.x = true}};
  if (!clay.begin_stroke(tool, style)) fail("a stroke did not begin");
  for (const StrokeSample& sample :
       wandering_samples(start_of_stroke(number), tool, kSpacing, ball_mm, kDabs)) {
    const double cpu = process_cpu_ms();
    const double start = wall_ms();
    if (!clay.extend_stroke({&sample, 1})) fail("a dab failed");
    surface.update(clay);
    costs.dab.push_back(wall_ms() - start);
    costs.dab_cpu.push_back(process_cpu_ms() - cpu);
  }
  timed(
      clay, surface, [&] { return clay.end_stroke().ok(); }, costs.end, costs.end_all);
}

Costs session(Ball& ball, const Tool& tool, int strokes) {
  Costs costs;
  for (int n = 0; n < strokes; ++n) {
    Tool now = tool;
    now.action = n % 2 == 0 ? Action::carve : Action::add;
    stroke(ball.clay, ball.surface, now, n, ball.radius_mm, costs);
    if (n % 2 == 0) continue;
    const auto undo = [&] { return ball.clay.undo(); };
    timed(ball.clay, ball.surface, undo, costs.undo, costs.undo_all);
    timed(
        ball.clay, ball.surface, [&] { return ball.clay.redo(); }, costs.redo, costs.redo_all);
    if (n % 4 == 3) timed(ball.clay, ball.surface, undo, costs.undo, costs.undo_all);
  }
  if (!ball.clay.validate().empty()) fail("the clay is broken");
  return costs;
}

void print_times(int covered, const Costs& costs) {
  const double median = quantile(costs.dab, 0.5);
  const double p99 = quantile(costs.dab, 0.99);
  std::printf("| %d | %zu | %.2f | %.2f | %.2f | %.2f | %.1f", covered, costs.dab.size(),
              quantile(costs.dab_cpu, 0.5), median, p99, p99 / median, quantile(costs.dab, 1.0));
  for (const auto* each :
       {&costs.end, &costs.end_all, &costs.undo, &costs.undo_all, &costs.redo, &costs.redo_all}) {
    std::printf(" | %.1f, %.1f", quantile(*each, 0.5), quantile(*each, 1.0));
  }
  std::printf(" |\n");
  std::fflush(stdout);
}

/// A second of a hand with a pose each millisecond: how long after each pose the clay and its
/// surface are where it was. All poses that are due are given at once.
std::vector<double> lags(Ball& ball, const Tool& tool, double speed_mm_per_s) {
  constexpr int kPoses = 1000;
  const double step = speed_mm_per_s * 1e-3;
  const double in_spacings = step / smallest_radius(tool);
  std::vector<StrokeSample> path =
      wandering_samples(start_of_stroke(3), tool, in_spacings, ball.radius_mm, kPoses);
  for (int n = 0; n < kPoses; ++n) path[static_cast<std::size_t>(n)].time_s = 1e-3 * n;
  if (!ball.clay.begin_stroke(tool, {.spacing = kSpacing})) fail("a stroke did not begin");
  std::vector<double> found;
  const double start = wall_ms();
  for (std::size_t given = 0; given < path.size();) {
    const auto due = static_cast<std::size_t>(
        std::clamp(wall_ms() - start + 1.0, 0.0, static_cast<double>(path.size())));
    if (due == given) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      continue;
    }
    if (!ball.clay.extend_stroke(std::span(path).subspan(given, due - given))) fail("no dabs");
    ball.surface.update(ball.clay);
    for (; given < due; ++given) {
      found.push_back(wall_ms() - start - static_cast<double>(given));
    }
  }
  if (!ball.clay.end_stroke()) fail("a stroke did not end");
  ball.clay.undo();
  ball.surface.update(ball.clay);
  return found;
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  using namespace argil;
  using namespace argil::bench;
  const int strokes = argc > 1 ? std::atoi(argv[1]) : 100;
  if (argc > 2 || strokes < 4) {
    std::fprintf(stderr, "usage: bench_long_session [strokes, at least 4]\n");
    return 2;
  }
  std::printf(
      "Wall times in ms of all cores; of pairs the median and the longest.\n\n"
      "| covered | dabs | CPU median | median | p99 | p99 / median | longest | end | with "
      "surface | undo | with surface | redo | with surface |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int covered : {1'000, 10'000}) {
    auto ball = made_ball(500'000);
    if (!ball) fail(ball.error().message.c_str());
    const Tool tool = tool_covering(covered, Action::carve, ball.value().radius_mm);
    print_times(covered, session(ball.value(), tool, strokes));
  }
  auto ball = made_ball(2'000'000);
  if (!ball) fail(ball.error().message.c_str());
  std::printf(
      "\nHow long after a pose the clay and its surface are where the hand was, in ms.\n\n"
      "| ball's vertices | covered | hand, mm/s | dabs/s | median | p99 | longest |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const double speed : {100.0, 300.0, 1000.0, 3000.0}) {
    const Tool tool = tool_covering(10'000, Action::carve, ball.value().radius_mm);
    const std::vector<double> found = lags(ball.value(), tool, speed);
    std::printf("| %zu | 10000 | %.0f | %.0f | %.1f | %.1f | %.1f |\n",
                ball.value().vertices.size(), speed, speed / (kSpacing * smallest_radius(tool)),
                quantile(found, 0.5), quantile(found, 0.99), quantile(found, 1.0));
    std::fflush(stdout);
  }
  return 0;
}
