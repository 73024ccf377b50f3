// SPDX-License-Identifier: GPL-3.0-or-later
// A force query: reading the window, which the clay's thread does, and the sum, which the servo
// does.
#include <bit>
#include <cmath>

#include "argil/engine/window.h"
#include "argil/haptics/tool_force.h"

#include "bench/row.h"

namespace argil::bench {
namespace {

haptics::ForceTool tool_on_top(double radius_mm) {
  haptics::ForceTool tool;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.position_mm = {0.0, 0.0, 40.0};
  return tool;
}

Result<FieldWindow> window_for(const Clay& clay, const haptics::ForceTool& tool,
                               const haptics::ForceMaterial& material) {
  const double radius = tool.radii_mm.x;
  const int level =
      haptics::choose_level(radius, clay.options().voxel_mm, clay.level_count() - 1).level;
  const double voxel = std::ldexp(clay.options().voxel_mm, level);
  return read_window(clay, level, tool.position_mm, haptics::kKernelSupport * radius + 2.0 * voxel,
                     2.0 * radius + material.skin_mm, Extension::march);
}

std::string tool_size(const benchmark::State& state) {
  return "R " + std::to_string(state.range(0)) + " mm";
}

void force_window(benchmark::State& state) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const haptics::ForceTool tool = tool_on_top(static_cast<double>(state.range(0)));
  RowResult row(state);
  for (auto _ : state) {
    auto read = window_for(*clay, tool, {});
    state.PauseTiming();
    const FieldWindow* window = value_or_fail(state, read);
    if (window == nullptr) break;
    Hash64 hash;
    hash.update(std::as_bytes(window->view.distance_mm));
    row.add(hash.digest());
    state.ResumeTiming();
  }
  row.show(tool_size(state));
}

void force_sum(benchmark::State& state, haptics::ForceLaw law) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const haptics::ForceTool tool = tool_on_top(static_cast<double>(state.range(0)));
  const haptics::ForceMaterial material;
  auto read = window_for(*clay, tool, material);
  const FieldWindow* window = value_or_fail(state, read);
  if (window == nullptr) return;
  haptics::ForceResult felt;
  for (auto _ : state) {
    felt = haptics::volume_force(window->view, tool, material, law);
    benchmark::DoNotOptimize(felt);
  }
  if (felt.outside_window) state.SkipWithError("the tool left its window");
  RowResult row(state);
  row.add(std::bit_cast<std::uint64_t>(felt.contact_n.z));
  row.show(tool_size(state) + ", " + std::to_string(felt.samples) + " samples");
}

BENCHMARK(force_window)->Arg(1)->Arg(4)->Arg(16)->UseRealTime();
BENCHMARK_CAPTURE(force_sum, energy, haptics::ForceLaw::energy)->Arg(1)->Arg(4)->Arg(16);
BENCHMARK_CAPTURE(force_sum, blanch, haptics::ForceLaw::blanch)->Arg(1)->Arg(4)->Arg(16);

}  // namespace
}  // namespace argil::bench
