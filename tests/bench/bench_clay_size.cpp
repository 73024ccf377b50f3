// SPDX-License-Identifier: GPL-3.0-or-later
// Does a force query cost more on a larger clay? A rough plate that keeps every finest leaf, grown
// from about 1 M to 30 M active voxels; the same tools at the same position of each.
// Usage: bench_clay_size [largest side in mm]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"

#include "bench/clock.h"

namespace argil {
namespace {

/// A plate of this side whose top has bumps of one finest voxel and eight of them wide.
Result<Clay> rough_plate(double side_mm) {
  const ClayOptions options;
  const double turn = 2.0 * 3.14159265358979323846 / (8.0 * options.voxel_mm);
  const double half = side_mm / 2.0;
  const auto distance = [=](const Vec3& p) {
    // The phases keep the bumps from vanishing at the nodes of coarse levels.
    const double bumps = options.voxel_mm * std::sin(turn * p.x + 0.7) * std::sin(turn * p.y + 1.1);
    return std::max({p.z - bumps, -4.0 - p.z, std::abs(p.x) - half, std::abs(p.y) - half});
  };
  return Clay::from_distance(distance, {{-half, -half, -4.0}, {half, half, 1.0}}, options);
}

struct Times {
  double p50 = 0.0;
  double p99 = 0.0;
};

Result<Times> query_times(const Clay& clay, double radius_mm) {
  haptics::ForceTool tool;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.position_mm = {0.1, 0.2, 0.5 * radius_mm};
  const haptics::Lattice lattice = haptics::choose_lattice(tool);
  auto window = read_window(
      clay,
      {tool.position_mm, lattice.voxel_mm, haptics::window_reach_mm(tool, lattice, 0.5 * radius_mm),
       haptics::window_depth_mm(tool, {}, lattice)},
      Extension::layers);
  if (!window) return window.error();
  const haptics::LatticeForce force(tool, {}, haptics::ForceLaw::energy, lattice.voxel_mm);
  std::vector<double> us;
  for (int i = 0; i < 20'000; ++i) {
    const double before = bench::thread_cpu_ms();
    const haptics::ForceResult felt = force.evaluate(window.value().view, tool);
    us.push_back(1e3 * (bench::thread_cpu_ms() - before));
    if (felt.outside_window) return Error{ErrorKind::internal, "the tool left its window"};
  }
  std::sort(us.begin(), us.end());
  return Times{us[us.size() / 2], us[us.size() * 99 / 100]};
}

int run(double largest_mm) {
  std::printf("side_mm,active_voxels,radius_mm,p50_us,p99_us\n");
  for (const double share : {0.18, 0.5, 1.0}) {
    const auto clay = rough_plate(share * largest_mm);
    if (!clay) {
      std::fprintf(stderr, "bench_clay_size: %s\n", clay.error().message.c_str());
      return 1;
    }
    std::int64_t active = 0;
    for (const LevelStats& level : clay.value().level_stats()) active += level.active_voxels;
    for (const double radius : {1.0, 4.0, 16.0}) {
      const auto times = query_times(clay.value(), radius);
      if (!times) {
        std::fprintf(stderr, "bench_clay_size: %s\n", times.error().message.c_str());
        return 1;
      }
      std::printf("%g,%lld,%g,%.2f,%.2f\n", share * largest_mm, static_cast<long long>(active),
                  radius, times.value().p50, times.value().p99);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace
}  // namespace argil

int main(int argc, char** argv) { return argil::run(argc > 1 ? std::atof(argv[1]) : 480.0); }
