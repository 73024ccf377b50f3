// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"

#include "chart/sheet.h"

namespace argil::evaluation {

/// What one clay takes.
struct MemoryRow {
  bool is_ball = false;  ///< the ball with fine detail everywhere; else a piece
  std::string piece;
  double voxels_across = 0.0;  ///< longest side in finest voxels; twice R/h of the ball
  int levels = 0;
  std::int64_t finest_active = 0;
  std::int64_t finest_bytes = 0;
  std::int64_t stack_active = 0;       ///< all levels
  std::int64_t stack_bytes = 0;        ///< Clay::level_stats(): leaves and the trees above them
  std::int64_t finest_leaf_bytes = 0;  ///< without the trees
  std::int64_t stack_leaf_bytes = 0;
  std::int64_t process_bytes = 0;  ///< what the process had more of the heap once the clay stood
  std::int64_t whole_finest_active = 0;  ///< with every leaf of the surface at every level
  std::int64_t whole_finest_leaf_bytes = 0;
  std::int64_t whole_bytes = 0;
  std::int64_t dense_bytes = 0;  ///< the box around the piece at the finest voxel, a float a node
  std::uint64_t hash = 0;

  double bytes_per_active() const noexcept {
    return static_cast<double>(finest_bytes) / static_cast<double>(finest_active);
  }
  double stack_to_finest() const noexcept {
    return static_cast<double>(stack_bytes) / static_cast<double>(finest_bytes);
  }
  double leaves_to_finest() const noexcept {
    return static_cast<double>(stack_leaf_bytes) / static_cast<double>(finest_leaf_bytes);
  }
};

struct MemoryResult {
  std::vector<MemoryRow> rows;
  std::vector<std::string> skipped;  ///< pieces whose model is not there
};

Result<MemoryResult> measure_memory(bool quick, const Progress& progress);
std::string memory_csv(const std::vector<MemoryRow>& rows);

using MemoryValue = std::int64_t MemoryRow::*;

/// Of the balls, of which there are two at least: n where a value grows as (R/h)^n, the slope of
/// the line of least squares through the logarithms.
double growth_exponent(std::span<const MemoryRow> rows, MemoryValue value);

/// The chart of memory as a gnuplot script that carries its data.
Script memory_script(const std::vector<MemoryRow>& rows);

}  // namespace argil::evaluation
