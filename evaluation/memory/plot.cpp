// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of memory: bytes a voxel, ratios, growth, and whole pieces.
#include <cmath>
#include <cstdio>
#include <functional>

#include "common/output.h"
#include "memory/rows.h"

namespace argil::evaluation {
namespace {

constexpr const char* kOurs = "linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2'";
constexpr const char* kLeaves = "linespoints pt 5 ps 0.8 lw 2 lc rgb '#56b4e9'";
constexpr const char* kProcess = "points pt 6 ps 1.5 lw 1.5 lc rgb '#d55e00'";
constexpr const char* kVoxels = "linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73'";
constexpr const char* kSlope = "lines lw 1.5 dt 3 lc rgb '#606060'";

using MemoryMeasure = std::function<double(const MemoryRow&)>;

double real(std::int64_t value) { return static_cast<double>(value); }

std::string over_detail(const std::vector<MemoryRow>& rows, const MemoryMeasure& value) {
  return points_of(
      rows, [](const MemoryRow& row) { return row.is_ball; },
      [](const MemoryRow& row) { return 0.5 * row.voxels_across; }, value);
}

/// A level line across the detail of the balls.
std::string level_line(const std::vector<MemoryRow>& rows, double y) {
  return over_detail(rows, [=](const MemoryRow&) { return y; });
}

std::string bytes_panel(const std::vector<MemoryRow>& rows) {
  PlotLines lines;
  lines.add(over_detail(rows, [](const MemoryRow& r) { return r.bytes_per_active(); }), kOurs,
            "finest level");
  lines.add(over_detail(rows,
                        [](const MemoryRow& r) {
                          return real(r.finest_leaf_bytes) / real(r.finest_active);
                        }),
            kLeaves, "its leaves alone");
  lines.add(level_line(rows, 16.0), kAskedStyle, "asked from 128 on: at most 16");
  return "set key at graph 0.98,0.97 right top\nset logscale x\nset yrange [0:*]\n"
         "set ylabel 'bytes for each active voxel'\n" +
         lines.text();
}

std::string memory_ratio_panel(const std::vector<MemoryRow>& rows) {
  PlotLines lines;
  lines.add(over_detail(rows, [](const MemoryRow& r) { return r.stack_to_finest(); }), kOurs,
            "all levels over the finest");
  lines.add(over_detail(rows, [](const MemoryRow& r) { return r.leaves_to_finest(); }), kLeaves,
            "the same of the leaves alone");
  lines.add(
      over_detail(rows,
                  [](const MemoryRow& r) { return real(r.process_bytes) / real(r.stack_bytes); }),
      kProcess, "growth of the process over all levels");
  lines.add(level_line(rows, 1.5), kAskedStyle, "asked: at most 1.5");
  return "set key at graph 0.98,0.04 right bottom\nset yrange [0:*]\nset ylabel 'ratio of "
         "bytes'\n" +
         lines.text();
}

std::string exponent_text(const std::vector<MemoryRow>& rows, MemoryValue value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", growth_exponent(rows, value));
  return text;
}

std::string growth_panel(const std::vector<MemoryRow>& rows) {
  PlotLines lines;
  lines.add(over_detail(rows, [](const MemoryRow& r) { return real(r.finest_active); }), kVoxels,
            "active voxels, grow by " + exponent_text(rows, &MemoryRow::finest_active));
  lines.add(over_detail(rows, [](const MemoryRow& r) { return real(r.stack_leaf_bytes); }), kLeaves,
            "bytes of leaves, by " + exponent_text(rows, &MemoryRow::stack_leaf_bytes));
  lines.add(over_detail(rows, [](const MemoryRow& r) { return real(r.stack_bytes); }), kOurs,
            "all bytes, by " + exponent_text(rows, &MemoryRow::stack_bytes));
  lines.add(
      over_detail(rows, [](const MemoryRow& r) { return 20.0 * std::pow(r.voxels_across, 2); }),
      kSlope, "a square");
  return "set logscale xy\nset format y '%.0s%c'\nset yrange [*:*]\n"
         "set ylabel 'voxels, bytes'\n" +
         lines.text();
}

/// Three bars for each piece.
std::string pieces_panel(const std::vector<MemoryRow>& rows) {
  std::string dense, whole, stack, names;
  int at = 0;
  for (const MemoryRow& row : rows) {
    if (row.is_ball) continue;
    constexpr double kMb = 1e-6;
    dense += point_text(at, kMb * real(row.dense_bytes));
    whole += point_text(at + 1, kMb * real(row.whole_bytes));
    stack += point_text(at + 2, kMb * real(row.stack_bytes));
    char saving[96];
    std::snprintf(saving, sizeof saving, "%s\"%s\\n%.1f times\" %d", names.empty() ? "" : ",",
                  row.piece.c_str(), real(row.whole_bytes) / real(row.stack_bytes), at + 1);
    names += saving;
    at += 4;
  }
  PlotLines lines;
  lines.add(dense, "boxes fs solid 0.9 lc rgb '#bbbbbb'", "dense grid");
  lines.add(whole, "boxes fs solid 0.9 lc rgb '#e69f00'", "every level whole");
  lines.add(stack, "boxes fs solid 0.9 lc rgb '#0072b2'", "as it is");
  return "unset logscale x\nset logscale y\nset format y '%g'\nset yrange [0.5:60000]\n"
         "set boxwidth 0.85\nset xtics (" +
         names + ")\nset xrange [-1:" + std::to_string(at - 1) +
         "]\nset ylabel 'MB'\nunset xlabel\n"
         "set key at graph 0.98,0.97 right top Right noreverse\n" +
         lines.text();
}

}  // namespace

Script memory_script(const std::vector<MemoryRow>& rows) {
  const Sheet sheet{"memory", 1280, 860, "Memory: what detail costs, and what levels save",
                    "A ball with bumps everywhere, R/h its detail; and pieces that are plain in "
                    "most places."};
  PanelGrid grid{2, 2, 0.07, 0.98, 0.86, 0.08, 0.075, 0.13};
  std::string text =
      "set xlabel 'R/h'\nset xrange [24:700]\n"
      "set xtics (32,64,128,256,512)\n";
  text += panel_head(grid, 0, "Bytes for each active voxel") + bytes_panel(rows);
  text +=
      panel_head(grid, 1, "Coarser levels, and what the process says") + memory_ratio_panel(rows);
  text += "set key at graph 0.02,0.97 left top Left reverse\n";
  text += panel_head(grid, 2, "Growth with detail") + growth_panel(rows);
  text += panel_head(grid, 3, "Pieces, and how many times less than every level whole") +
          pieces_panel(rows);
  return finished(sheet, text);
}

}  // namespace argil::evaluation
