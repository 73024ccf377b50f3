// SPDX-License-Identifier: GPL-3.0-or-later
// How much memory a clay takes: a ball of growing detail, and pieces of which most is plain.
#include "memory/rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>

#include <malloc.h>

#include "chart/chart.h"
#include "common/output.h"
#include "rivals/whole_levels.h"
#include "scene/distance.h"
#include "scene/model.h"
#include "scene/scene.h"

namespace argil::evaluation {
namespace {

namespace fs = std::filesystem;

using MakeClay = std::function<Result<Clay>()>;

/// What the process has allocated and not given back.
std::int64_t heap_bytes() {
  // Blocks of the heap, and large ones that malloc maps separately.
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

/// A wave of period 1 between -1 and 1, in two parabolas: cheaper than a sine, as smooth.
double wave(double t) {
  const double s = t - std::floor(t) - 0.5;
  return 8.0 * s * (1.0 - 2.0 * std::abs(s));
}

/// Bumps about a voxel high and ten wide keep the finest level everywhere: a smooth ball would be
/// stored at a coarser one. The phases keep them from vanishing at the nodes of coarse levels.
Result<Clay> bumpy_ball(double radius_voxels) {
  constexpr double kTurn = 1.0 / (10.0 * kVoxelMm);
  const double radius_mm = kVoxelMm * radius_voxels;
  const auto distance = [=](const Vec3& p) {
    const double bumps =
        wave(kTurn * p.x + 0.11) + wave(kTurn * p.y + 0.17) + wave(kTurn * p.z + 0.23);
    return length(p) - radius_mm - 0.35 * kVoxelMm * bumps;
  };
  const double half = radius_mm + 2.0 * kVoxelMm;
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  return Clay::from_distance(distance, {{-half, -half, -half}, {half, half, half}}, options);
}

/// A ball with one groove: a ring of 20 voxels radius, 4 voxels deep.
Result<Clay> engraved_ball(double radius_voxels) {
  const double radius_mm = kVoxelMm * radius_voxels;
  const Distance groove = torus(20.0 * kVoxelMm, 4.0 * kVoxelMm);
  const Vec3 top{0.0, 0.0, radius_mm};
  const auto distance = [=](const Vec3& p) {
    return std::max(length(p) - radius_mm, -groove(p - top));
  };
  const double half = radius_mm + 2.0 * kVoxelMm;
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  return Clay::from_distance(distance, {{-half, -half, -half}, {half, half, half}}, options);
}

std::int64_t dense_bytes(const Clay& clay) {
  assert(!clay.bounds_mm().empty());
  const Vec3 size = clay.bounds_mm().size();
  double nodes = 1.0;
  // Of a dense grid of floats over the clay's bounds.
  for (std::size_t a = 0; a < 3; ++a) nodes *= std::round(size[a] / clay.options().voxel_mm) + 1.0;
  return static_cast<std::int64_t>(nodes * sizeof(float));
}

/// The columns of the clay as it is; `process_bytes` grew by making it.
void describe_clay(const Clay& clay, MemoryRow& row) {
  const Vec3 size = clay.bounds_mm().size();
  row.voxels_across = std::max({size.x, size.y, size.z}) / clay.options().voxel_mm;
  const std::vector<LevelStats> levels = clay.level_stats();
  assert(!levels.empty() && levels[0].level == 0);  // the finest first
  row.levels = static_cast<int>(levels.size());
  row.finest_active = levels[0].active_voxels;
  row.finest_bytes = levels[0].bytes;
  row.finest_leaf_bytes = leaf_bytes(clay, 0);
  for (const LevelStats& level : levels) {
    row.stack_active += level.active_voxels;
    row.stack_bytes += level.bytes;
    row.stack_leaf_bytes += leaf_bytes(clay, level.level);
  }
  row.hash = clay.hash();
}

Result<MemoryRow> measure_memory_row(const std::string& piece, const MakeClay& make) {
  MemoryRow row;
  row.piece = piece;
  const std::int64_t before = heap_bytes();
  auto made = make();
  if (!made) return made.error();
  row.process_bytes = heap_bytes() - before;
  const Clay& clay = made.value();
  describe_clay(clay, row);
  const Clay whole = with_whole_levels(clay);
  const std::vector<LevelStats> levels = whole.level_stats();
  row.whole_finest_active = levels[0].active_voxels;
  row.whole_finest_leaf_bytes = leaf_bytes(whole, 0);
  for (const LevelStats& level : levels) row.whole_bytes += level.bytes;
  row.dense_bytes = dense_bytes(whole);
  return row;
}

/// A model that is not there is said, not measured.
Result<void> measure_model(const std::string& piece, const std::string& name, double size_voxels,
                           MemoryResult& result) {
  const fs::path file = model_file(name);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    result.skipped.push_back(missing_model(piece, file));
    return {};
  }
  auto row = measure_memory_row(
      piece, [&] { return import_model(file, size_voxels * kVoxelMm, kVoxelMm); });
  if (!row) return row.error();
  result.rows.push_back(std::move(row).value());
  return {};
}

Result<void> measure_balls(bool quick, const Progress& progress, MemoryResult& result) {
  const std::vector<int> radii =
      quick ? std::vector<int>{32, 64, 128} : std::vector<int>{32, 64, 128, 256, 512};
  for (const int radius : radii) {
    if (auto go = tell(progress, "balls", 0.7 * radius / (2.0 * radii.back())); !go) return go;
    auto row = measure_memory_row("ball", [&] { return bumpy_ball(radius); });
    if (!row) return row.error();
    row.value().is_ball = true;
    row.value().voxels_across = 2.0 * radius;
    result.rows.push_back(std::move(row).value());
  }
  return {};
}

Result<void> measure_pieces(bool quick, const Progress& progress, MemoryResult& result) {
  constexpr std::array<std::array<const char*, 2>, 3> kModels{
      {{"bunny", "stanford-bunny.obj"}, {"fandisk", "fandisk.obj"}, {"rocker", "rocker-arm.obj"}}};
  const double size_voxels = quick ? 96.0 : 400.0;
  double done = 0.7;
  for (const auto& [piece, file] : kModels) {
    if (auto go = tell(progress, "pieces", done); !go) return go;
    if (auto measured = measure_model(piece, file, size_voxels, result); !measured) {
      return measured;
    }
    done += 0.07;
  }
  if (auto go = tell(progress, "pieces", done); !go) return go;
  auto row =
      measure_memory_row("engraved ball", [&] { return engraved_ball(quick ? 96.0 : 400.0); });
  if (!row) return row.error();
  result.rows.push_back(std::move(row).value());
  return {};
}

}  // namespace

Result<MemoryResult> measure_memory(bool quick, const Progress& progress) {
  MemoryResult result;
  if (auto measured = measure_balls(quick, progress, result); !measured) return measured.error();
  if (auto measured = measure_pieces(quick, progress, result); !measured) return measured.error();
  return result;
}

std::string memory_csv(const std::vector<MemoryRow>& rows) {
  std::string text =
      "# Memory of clay, finest voxel 0.25 mm; 'ball' has detail everywhere, R/h is half its "
      "voxels_across; 'whole' has every leaf of the surface at every level\n"
      "kind,piece,voxels_across,levels,finest_active,finest_bytes,bytes_per_active,stack_active,"
      "stack_bytes,stack_to_finest,finest_leaf_bytes,stack_leaf_bytes,leaves_to_finest,"
      "process_bytes,whole_finest_active,whole_finest_leaf_bytes,whole_bytes,dense_bytes,hash\n";
  for (const MemoryRow& row : rows) {
    text.append(row.is_ball ? "ball," : "piece,").append(row.piece).append(",");
    text.append(cli::number(row.voxels_across)).append(",").append(std::to_string(row.levels));
    text.append(",").append(std::to_string(row.finest_active)).append(",");
    text.append(std::to_string(row.finest_bytes)).append(",");
    text.append(cli::number(row.bytes_per_active()));
    for (const std::int64_t value : {row.stack_active, row.stack_bytes}) {
      text.append(",").append(std::to_string(value));
    }
    text.append(",").append(cli::number(row.stack_to_finest()));
    for (const std::int64_t value : {row.finest_leaf_bytes, row.stack_leaf_bytes}) {
      text.append(",").append(std::to_string(value));
    }
    text.append(",").append(cli::number(row.leaves_to_finest()));
    for (const std::int64_t value :
         {row.process_bytes, row.whole_finest_active, row.whole_finest_leaf_bytes, row.whole_bytes,
          row.dense_bytes}) {
      text.append(",").append(std::to_string(value));
    }
    text.append(",").append(cli::hex(row.hash)).append("\n");
  }
  return text;
}

/// The slope of a least-squares line through the logarithms: 2 where memory grows with the surface,
/// 3 with the volume.
double growth_exponent(std::span<const MemoryRow> rows, MemoryValue value) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const MemoryRow& row : rows) {
    if (!row.is_ball) continue;
    const double a = std::log(row.voxels_across);
    const double b = std::log(static_cast<double>(row.*value));
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  assert(n >= 2.0);  // a line needs two points
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace argil::evaluation
