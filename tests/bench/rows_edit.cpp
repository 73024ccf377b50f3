// SPDX-License-Identifier: GPL-3.0-or-later
// A dab, and what bringing the surface up to date after it costs.
#include <cmath>
#include <cstdint>

#include "argil/engine/surface.h"

#include "bench/row.h"

namespace argil::bench {
namespace {

std::string tool_size(const benchmark::State& state) {
  return "R " + std::to_string(state.range(0)) + " mm";
}

void dab(benchmark::State& state, Action action) {
  auto made = ball_to_edit();
  Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const Stroke stroke = dab_on_top(static_cast<double>(state.range(0)), action);
  RowResult row(state);
  for (auto _ : state) {
    auto report = clay->apply(stroke);
    state.PauseTiming();
    if (value_or_fail(state, report) == nullptr) break;
    row.add(clay->hash());
    clay->undo();
    state.ResumeTiming();
  }
  row.show(tool_size(state));
}

/// One of the dabs of a stroke, each an edit of its own: the end of the stroke does not count.
void stroke_dab(benchmark::State& state, Action action) {
  auto made = ball_to_edit();
  Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  Stroke stroke = dab_on_top(static_cast<double>(state.range(0)), action);
  stroke.samples.clear();
  for (int n = -20; n <= 20; ++n) {
    const double angle = 0.025 * n * static_cast<double>(state.range(0)) / 4.0;
    stroke.samples.push_back(
        {0.1 * n,
         40.0 * Vec3{0.316 * std::sin(angle), 0.949 * std::sin(angle), std::cos(angle)},
         {},
         1.0});
  }
  RowResult row(state);
  std::int64_t dabs = 0;
  for (auto _ : state) {
    if (!clay->begin_stroke(stroke.tool, stroke).ok()) return state.SkipWithError("no stroke");
    benchmark::DoNotOptimize(clay->extend_stroke(stroke.samples));
    state.PauseTiming();
    auto report = clay->end_stroke();
    if (value_or_fail(state, report) == nullptr) break;
    dabs += report.value().dabs;
    row.add(clay->hash());
    clay->undo();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(dabs);
  row.show(tool_size(state));
}

void surface_update(benchmark::State& state) {
  auto made = ball_to_edit();
  Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const Stroke stroke = dab_on_top(static_cast<double>(state.range(0)), Action::carve);
  Surface surface;
  surface.update(*clay);
  RowResult row(state);
  for (auto _ : state) {
    state.PauseTiming();
    auto report = clay->apply(stroke);
    if (value_or_fail(state, report) == nullptr) break;
    state.ResumeTiming();
    benchmark::DoNotOptimize(surface.update(*clay));
    state.PauseTiming();
    row.add(hash_of(surface.weld()));
    clay->undo();
    surface.update(*clay);
    state.ResumeTiming();
  }
  row.show(tool_size(state));
}

void surface_whole(benchmark::State& state) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  RowResult row(state);
  std::size_t triangles = 0;
  for (auto _ : state) {
    const TriangleMesh mesh = extract_surface(*clay);
    state.PauseTiming();
    row.add(hash_of(mesh));
    triangles = mesh.triangles.size();
    state.ResumeTiming();
  }
  row.show(std::to_string(triangles) + " triangles");
}

BENCHMARK_CAPTURE(dab, carve, Action::carve)->Arg(1)->Arg(4)->Arg(16)->UseRealTime();
BENCHMARK_CAPTURE(dab, add, Action::add)->Arg(4)->UseRealTime();
BENCHMARK_CAPTURE(dab, smooth, Action::smooth)->Arg(4)->UseRealTime();
BENCHMARK_CAPTURE(dab, inflate, Action::inflate)->Arg(4)->UseRealTime();
BENCHMARK_CAPTURE(dab, emboss, Action::emboss)->Arg(4)->UseRealTime();
BENCHMARK_CAPTURE(stroke_dab, carve, Action::carve)->Arg(4)->Arg(8)->UseRealTime();
BENCHMARK_CAPTURE(stroke_dab, crease, Action::crease)->Arg(4)->Arg(8)->UseRealTime();
BENCHMARK(surface_update)->Arg(1)->Arg(4)->Arg(16)->UseRealTime();
BENCHMARK(surface_whole)->UseRealTime();

}  // namespace
}  // namespace argil::bench
