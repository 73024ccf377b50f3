// SPDX-License-Identifier: GPL-3.0-or-later
// A force query: reading the window, which the clay's thread does, and the sum, which the servo
// does; and what a tick of the servo is with the tool's own cuts taken out of the window.
#include <algorithm>
#include <bit>

#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/servo_force.h"

#include "bench/clock.h"
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
  const haptics::Lattice lattice = haptics::choose_lattice(tool);
  return read_window(
      clay,
      {tool.position_mm, lattice.voxel_mm, haptics::window_reach_mm(tool, lattice, tool.radii_mm.x),
       haptics::window_depth_mm(tool, material, lattice)},
      Extension::layers);
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

/// One query of the servo, or of the plain sum that it is checked against.
void force_query(benchmark::State& state, haptics::ForceLaw law, bool plain) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const haptics::ForceTool tool = tool_on_top(static_cast<double>(state.range(0)));
  const haptics::ForceMaterial material;
  auto read = window_for(*clay, tool, material);
  const FieldWindow* window = value_or_fail(state, read);
  if (window == nullptr) return;
  const haptics::LatticeForce lattice(tool, material, law, window->view.voxel_mm);
  haptics::ForceResult felt;
  for (auto _ : state) {
    felt = plain ? haptics::volume_force(window->view, tool, material, law)
                 : lattice.evaluate(window->view, tool);
    benchmark::DoNotOptimize(felt);
  }
  if (felt.outside_window) state.SkipWithError("the tool left its window");
  RowResult row(state);
  row.add(std::bit_cast<std::uint64_t>(felt.contact_n.z));
  row.show(tool_size(state) + ", " + std::to_string(felt.samples) + " samples");
}

/// A channel whose newest window is this one.
void publish(WindowChannel& channel, const FieldWindow& window) {
  WindowSlot& slot = channel.write_slot();
  slot.sequence = 1;
  slot.origin_mm = window.view.origin_mm;
  slot.voxel_mm = window.view.voxel_mm;
  slot.nodes = window.view.nodes;
  std::copy(window.view.distance_mm.begin(), window.view.distance_mm.end(),
            slot.distance_mm.begin());
  channel.publish();
}

/// A tick of the servo's force but for what a coupling asks of it: begin, one query, and the cut. A
/// tool that sinks in at 20 mm/s, for 50 ms until it is put back where it began.
void force_tick(benchmark::State& state, bool cuts) {
  constexpr int kTicks = 50;
  constexpr double kTickS = 1e-3;
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  haptics::ForceTool tool = tool_on_top(static_cast<double>(state.range(0)));
  const haptics::ForceMaterial material;
  auto read = window_for(*clay, tool, material);
  const FieldWindow* window = value_or_fail(state, read);
  if (window == nullptr) return;
  RowResult row(state);
  haptics::ForceResult felt;
  const Vec3 begin_mm = tool.position_mm;
  for (auto _ : state) {
    WindowChannel channel;
    publish(channel, *window);
    haptics::ServoForce servo(channel, material, haptics::ForceLaw::energy,
                              haptics::ForceMethod::volume, {}, cuts ? tool.radii_mm.x : 0.0);
    tool.position_mm = begin_mm;
    servo.begin_tick(tool, kTickS);
    const double begin_ms = thread_cpu_ms();
    for (int tick = 0; tick < kTicks; ++tick) {
      tool.position_mm.z -= 0.02;
      servo.begin_tick(tool, kTickS);
      felt = servo.at(tool);
      servo.cut(tool, kTickS, cuts);
    }
    state.SetIterationTime(1e-3 * (thread_cpu_ms() - begin_ms) / kTicks);
    row.add(std::bit_cast<std::uint64_t>(felt.contact_n.z));
  }
  row.show(tool_size(state) + ", a tick of 50");
}

BENCHMARK(force_window)->Arg(1)->Arg(4)->Arg(16)->UseRealTime();
BENCHMARK_CAPTURE(force_query, energy, haptics::ForceLaw::energy, false)->Arg(1)->Arg(4)->Arg(32);
BENCHMARK_CAPTURE(force_query, blanch, haptics::ForceLaw::blanch, false)->Arg(1)->Arg(4)->Arg(32);
BENCHMARK_CAPTURE(force_query, plain_energy, haptics::ForceLaw::energy, true)->Arg(4);
BENCHMARK_CAPTURE(force_tick, own_cuts, true)
    ->Arg(1)
    ->Arg(4)
    ->Arg(16)
    ->Iterations(50)
    ->UseManualTime();
BENCHMARK_CAPTURE(force_tick, no_cuts, false)
    ->Arg(1)
    ->Arg(4)
    ->Arg(16)
    ->Iterations(50)
    ->UseManualTime();

}  // namespace
}  // namespace argil::bench
