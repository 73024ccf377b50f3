// SPDX-License-Identifier: GPL-3.0-or-later
// What operations on a whole clay cost: a ball of about two million surface vertices with bumps of
// ten voxels' wavelength, so that all of it is held at the finest level. Prints a markdown table;
// one run each, since each takes seconds. Argument: the number of vertices, default 2 000 000.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include "argil/engine/clay.h"
#include "argil/engine/mask_filter.h"
#include "argil/engine/operation.h"
#include "argil/engine/surface.h"

#include "bench/clock.h"
#include "support/bumpy_clay.h"

namespace {

using namespace argil;

constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;

void row(Clay& clay, const char* name, const Operation& operation) {
  const double wall = 1e-3 * bench::wall_ms();
  const double cpu = 1e-3 * bench::process_cpu_ms();
  const auto report = clay.apply(operation);
  const double took_cpu = 1e-3 * bench::process_cpu_ms() - cpu;
  const double took = 1e-3 * bench::wall_ms() - wall;
  if (!report) {
    std::printf("| %s | failed: %s |\n", name, report.error().message.c_str());
    return;
  }
  const double surface_start = 1e-3 * bench::wall_ms();
  const TriangleMesh mesh = extract_surface(clay);
  const double surface = 1e-3 * bench::wall_ms() - surface_start;
  const double undo_start = 1e-3 * bench::wall_ms();
  clay.undo();
  const double undo = 1e-3 * bench::wall_ms() - undo_start;
  std::printf("| %s | %.2f | %.2f | %.2f | %lld | %.2f | %.2f |\n", name, took_cpu, took, undo,
              static_cast<long long>(report.value().changed_leaves), surface,
              1e-6 * static_cast<double>(mesh.positions.size()));
  std::fflush(stdout);
}

/// Of edits of the mask; no vertex moves.
void mask_row(Clay& clay, const char* name, const MaskFilter& filter) {
  const double wall = 1e-3 * bench::wall_ms();
  const double cpu = 1e-3 * bench::process_cpu_ms();
  const auto done = filter_mask(clay, filter);
  const double took_cpu = 1e-3 * bench::process_cpu_ms() - cpu;
  const double took = 1e-3 * bench::wall_ms() - wall;
  clay.undo();
  std::printf("| %s | %.2f | %.2f | | %s | | |\n", name, took_cpu, took,
              done ? "" : done.error().message.c_str());
  std::fflush(stdout);
}

/// A disk of half the radius about the top, with a border of its own softness.
bool mask_top(Clay& clay, double radius) {
  Stroke stroke;
  stroke.tool.action = Action::mask;
  stroke.tool.radii_mm = {0.5 * radius, 0.5 * radius, 0.5 * radius};
  stroke.samples = {{0.0, {0.0, 0.0, radius}, {}, 1.0}, {1.0, {0.01, 0.0, radius}, {}, 1.0}};
  return clay.apply(stroke).ok();
}

Combine with(CombineKind kind, const std::shared_ptr<const Clay>& other, const Vec3& at) {
  Combine combine;
  combine.kind = kind;
  combine.clay = other;
  combine.placement.position_mm = at;
  return combine;
}

Combine turned(Combine combine) {
  combine.placement.orientation = normalized(Quat{1.0, 0.2, 0.1, 0.3});
  return combine;
}

}  // namespace

int main(int argc, char** argv) {
  const double vertices = argc > 1 ? std::atof(argv[1]) : 2e6;
  const double radius =
      kVoxelMm * std::sqrt(vertices / kVerticesPerSquareVoxel / (4.0 * std::numbers::pi));
  auto made = test::bumpy_ball(radius, kVoxelMm);
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  auto small = Clay::ball(0.3 * radius, options);
  if (!made || !small) return 1;
  Clay& clay = made.value();
  const auto other = std::make_shared<const Clay>(std::move(small).value());
  const Vec3 top{0.0, 0.0, radius};
  std::printf(
      "| operation | CPU s | wall s | undo s | leaves changed | whole surface s | M vertices |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  row(clay, "cut through the middle", Cut{{0.1, 0.2, 0.3}, {0.3, 0.2, 1.0}, false});
  row(clay, "cut off a cap", Cut{{0.0, 0.0, 0.8 * radius}, {0.1, 0.0, 1.0}, false});
  row(clay, "difference with a ball", with(CombineKind::subtract, other, top));
  row(clay, "union with a ball", with(CombineKind::unite, other, top));
  auto beside = test::bumpy_ball(radius, kVoxelMm, {}, {0.6 * radius, 0.0, 0.0});
  if (!beside) return 1;
  const auto copy = std::make_shared<const Clay>(std::move(beside).value());
  row(clay, "union with its copy beside", with(CombineKind::unite, copy, {}));
  row(clay, "union with a turned copy", turned(with(CombineKind::unite, copy, {})));
  const auto stamp = std::make_shared<const Clay>(Clay::ball(8.0 * kVoxelMm, options).value());
  row(clay, "union with a stamp", with(CombineKind::unite, stamp, top + Vec3{0.03, 0.02, 0.01}));
  row(clay, "intersection with a ball", with(CombineKind::intersect, other, top));
  row(clay, "resample to twice the voxel", Resample{2.0 * kVoxelMm});
  row(clay, "resample to half the voxel", Resample{0.5 * kVoxelMm});
  row(clay, "resample to 1.3 voxels", Resample{1.3 * kVoxelMm});
  row(clay, "offset by 2 voxels", Offset{2.0 * kVoxelMm});
  row(clay, "offset by -2 voxels", Offset{-2.0 * kVoxelMm});
  row(clay, "hollow, a wall of 8 voxels", Hollow{8.0 * kVoxelMm, {}});
  row(clay, "hollow with a drain",
      Hollow{8.0 * kVoxelMm, {{-top, {0.0, 0.0, 1.0}, 6.0 * kVoxelMm}}});
  mask_row(clay, "mask by cavities of 4 voxels", MaskCavity{4.0 * kVoxelMm, 1.0});
  if (!mask_top(clay, radius)) return 1;
  mask_row(clay, "mask of a disk grown by 10 voxels", MaskGrow{10.0 * kVoxelMm});
  mask_row(clay, "mask of a disk grown by 100 voxels", MaskGrow{100.0 * kVoxelMm});
  return 0;
}
