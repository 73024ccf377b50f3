// SPDX-License-Identifier: GPL-3.0-or-later
// What a stroke with a large tool costs: making its preview, a dab in the preview with what is
// drawn of it, the same dab in the clay and with the clay's surface, and how far what is drawn is
// from what the clay becomes; of tools that need no preview the clay's part alone, which has to fit
// in a frame. Prints a markdown table; tools in finest voxels. Usage: bench_preview [vertices of
// the ball]; default 6 million, of which the bumps make 8; takes some 4 GB and two minutes
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/hash.h"
#include "argil/engine/preview.h"

#include "bench/clock.h"
#include "bench/hand.h"
#include "bench/quantile.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;
constexpr double kSpacing = 0.25;
/// Of a row; the 99th percentile of so few is the slowest but one. No row is of an anchored action,
/// whose dabs cost the more the longer the way.
constexpr int kPreviewDabs = 100;
constexpr int kClayDabs = 10;
constexpr int kBegins = 9;

struct Times {
  std::vector<double> cpu_ms;  ///< of all threads
  std::vector<double> wall_ms;
};

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "bench_preview: %s\n", error.message.c_str());
  std::exit(1);
}

template <class T>
T value_of(Result<T> result) {
  if (!result) stop(result.error());
  return std::move(result).value();
}
void check(const Result<void>& result) {
  if (!result) stop(result.error());
}

template <class Do>
void timed(Times& times, const Do& act) {
  const double cpu = bench::process_cpu_ms();
  const double wall = bench::wall_ms();
  act();
  times.wall_ms.push_back(bench::wall_ms() - wall);
  times.cpu_ms.push_back(bench::process_cpu_ms() - cpu);
}

struct Row {
  const char* name;
  Action action;
  double radius_voxels;
  std::optional<double> tool_voxels = {};
};

std::optional<Preview> begin(const Clay& clay, const DisplaySurface& surface, const Tool& tool,
                             const StrokeStyle& style, std::optional<double> tool_voxels) {
  return value_of(Preview::begin(clay, surface, tool, style, tool_voxels));
}

/// How far the blocks that the last update of a preview made are from the clay's surface, in voxels
/// of its level.
struct Misses {
  double most = 0.0;
  double mean = 0.0;
};
Misses misses(const Preview& preview, const Clay& clay) {
  const double voxel = kVoxelMm * static_cast<double>(1 << preview.level());
  Misses found;
  std::int64_t count = 0;
  for (const BlockId& id : preview.changed()) {
    for (const DisplayVertex& v : preview.block(id).vertices) {
      const auto& p = v.position_mm;
      const double miss = std::abs(clay.distance_at({double{p[0]}, double{p[1]}, double{p[2]}}));
      found.most = std::max(found.most, miss / voxel);
      found.mean += miss / voxel;
      ++count;
    }
  }
  found.mean /= static_cast<double>(std::max<std::int64_t>(count, 1));
  return found;
}

struct Figures {
  int level = 0;
  Times begin;
  Times dab;
  Times surface;  ///< part of the dab
  Times clay_dab;
  Times clay_surface;
  double clay_end_ms = 0.0;
  Misses misses;
  std::uint64_t hash = 0;
};

/// The clay takes the first dabs of the stroke. `ahead` null: nothing is drawn but the clay.
void work_clay(Clay& clay, DisplaySurface& surface, const Preview* ahead,
               std::span<const StrokeSample> samples, Figures& figures) {
  for (const StrokeSample& sample : samples) {
    value_of(clay.queue_stroke({&sample, 1}));
    timed(figures.clay_dab, [&] { value_of(clay.work_stroke()); });
    if (ahead == nullptr) timed(figures.clay_surface, [&] { value_of(surface.update(clay)); });
  }
  const double start = bench::wall_ms();
  value_of(clay.end_stroke());
  figures.clay_end_ms = bench::wall_ms() - start;
  if (ahead != nullptr) figures.misses = misses(*ahead, clay);
  clay.undo();
}

/// What the preview draws must not be updated meanwhile: the clay is worked once for that and once
/// for its own surface.
void compare_with_clay(const Row& row, Clay& clay, DisplaySurface& surface, const Tool& tool,
                       const StrokeStyle& style, std::span<const StrokeSample> samples,
                       Figures& figures) {
  if (auto ahead = begin(clay, surface, tool, style, row.tool_voxels)) {
    value_of(ahead->extend(samples));
    value_of(ahead->end());
    value_of(ahead->update_surface());
    check(clay.begin_stroke(tool, style));
    work_clay(clay, surface, &*ahead, samples, figures);
    figures.clay_dab = {};
  }
  check(clay.begin_stroke(tool, style));
  work_clay(clay, surface, nullptr, samples, figures);
  value_of(surface.update(clay));
}

Figures measure(const Row& row, Clay& clay, DisplaySurface& surface, double ball_mm) {
  Tool tool;
  tool.action = row.action;
  const double radius = kVoxelMm * row.radius_voxels;
  tool.radii_mm = {radius, radius, radius};
  const StrokeStyle style{.spacing = kSpacing};
  const std::vector<StrokeSample> samples =
      wandering_samples({1.0, 0.3, 0.8}, tool, kSpacing, ball_mm, kPreviewDabs);
  Figures figures;
  for (int i = 0; i < kBegins; ++i)
    timed(figures.begin, [&] { begin(clay, surface, tool, style, row.tool_voxels); });
  if (auto preview = begin(clay, surface, tool, style, row.tool_voxels)) {
    figures.level = preview->level();
    for (const StrokeSample& sample : samples) {
      timed(figures.dab, [&] {
        value_of(preview->extend({&sample, 1}));
        timed(figures.surface, [&] { value_of(preview->update_surface()); });
      });
    }
    figures.hash = preview->clay().hash();
  }
  // The error is that of a stroke of the dabs that the clay is given time for.
  compare_with_clay(row, clay, surface, tool, style, std::span(samples).first(kClayDabs), figures);
  return figures;
}

void print(const Row& row, const Figures& f) {
  const auto cell = [](const std::vector<double>& v) {
    if (v.empty()) {
      std::printf("– | ");
      return;
    }
    std::printf("%.3g (%.3g) | ", quantile(v, 0.5), quantile(v, 0.99));
  };
  std::printf("| %s | %.0f | %.0f | %d | ", row.name, row.radius_voxels,
              row.tool_voxels.value_or(Preview::usual_voxels(row.action)), f.level);
  cell(f.begin.cpu_ms);
  cell(f.begin.wall_ms);
  cell(f.dab.cpu_ms);
  cell(f.dab.wall_ms);
  cell(f.surface.cpu_ms);
  cell(f.clay_dab.cpu_ms);
  cell(f.clay_dab.wall_ms);
  cell(f.clay_surface.cpu_ms);
  std::printf("%.3g | %.2f (%.3f) | `%016llx` |\n", f.clay_end_ms, f.misses.most, f.misses.mean,
              static_cast<unsigned long long>(f.hash));
  std::fflush(stdout);
}

void run(double vertices) {
  const double area = vertices / kVerticesPerSquareVoxel;
  const double ball_mm = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  Clay clay = value_of(test::bumpy_ball(ball_mm, kVoxelMm));
  DisplaySurface surface;
  value_of(surface.update(clay));
  std::printf(
      "Ball of %.3g vertices, radius %.0f finest voxels. ms, median (99th percentile).\n\n"
      "| tool | radius, finest voxels | in its voxels at most | level | begin CPU | begin wall | "
      "preview dab CPU | preview "
      "dab wall | of it surface CPU | clay dab CPU | clay dab wall | its surface CPU | end of the "
      "clay's stroke | miss in voxels of the level: most (mean) | hash |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      static_cast<double>(surface.stats().vertices), ball_mm / kVoxelMm);
  for (const Row& row : {Row{"carve", Action::carve, 64}, Row{"add", Action::add, 64},
                         Row{"smooth", Action::smooth, 32}, Row{"inflate", Action::inflate, 32},
                         Row{"flatten", Action::flatten, 32}, Row{"pinch", Action::pinch, 32},
                         Row{"carve", Action::carve, 100}, Row{"carve", Action::carve, 200},
                         Row{"carve", Action::carve, 400}, Row{"carve", Action::carve, 800},
                         Row{"carve", Action::carve, 200, 32}, Row{"add", Action::add, 200},
                         Row{"smooth", Action::smooth, 64}, Row{"smooth", Action::smooth, 100},
                         Row{"smooth", Action::smooth, 200}, Row{"inflate", Action::inflate, 64},
                         Row{"inflate", Action::inflate, 100}, Row{"flatten", Action::flatten, 64},
                         Row{"pinch", Action::pinch, 64}}) {
    print(row, measure(row, clay, surface, ball_mm));
  }
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  argil::bench::run(argc > 1 ? std::atof(argv[1]) : 6e6);
  return 0;
}
