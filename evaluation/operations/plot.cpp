// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of operations: a panel each with error against time, a curve a method and body.
#include "operations/plot.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>

#include "common/output.h"

namespace argil::evaluation {
namespace {

/// Colours that the colour-blind can tell apart; marks of the ball, and open ones of the block.
struct MethodLook {
  const char* method;
  const char* title;
  const char* colour;
  int ball_mark;
  int block_mark;
};
constexpr std::array kMethodLooks{
    MethodLook{"argil", "Argil", "#0072b2", 7, 6},
    MethodLook{"argil_fine", "Argil, tolerance 0.01 voxels", "#56b4e9", 7, 6},
    MethodLook{"openvdb", "OpenVDB", "#e69f00", 5, 4},
    MethodLook{"cgal", "CGAL: wrap, corefinement, edge collapse", "#009e73", 9, 8},
    MethodLook{"blender", "Blender: voxel remesh, exact Boolean", "#cc79a7", 11, 10},
    MethodLook{"openmesh", "OpenMesh quadrics", "#d55e00", 13, 12},
    MethodLook{"meshoptimizer", "meshoptimizer", "#000000", 3, 2}};

struct OperationPanel {
  const char* operation;
  const char* title;
};
constexpr std::array kOperationPanels{OperationPanel{"import", "import"},
                                      OperationPanel{"offset +2", "offset by 2 voxels"},
                                      OperationPanel{"offset -2", "offset by -2 voxels"},
                                      OperationPanel{"offset -8", "offset by -8 voxels"},
                                      OperationPanel{"union", "union with a turned copy"},
                                      OperationPanel{"resample", "resample to 1.3 voxels"},
                                      OperationPanel{"hollow", "hollow, a wall of 8 voxels"},
                                      OperationPanel{"decimate", "to 10 % of the triangles"}};

/// What is less is drawn here: mesh Booleans are exact but for rounding.
constexpr double kLeastDrawn = 1e-4;

std::string look_style(const MethodLook& look, bool is_ball) {
  return std::string("lw ") + (is_ball ? "2" : "1.2 dt 2") + " pt " +
         std::to_string(is_ball ? look.ball_mark : look.block_mark) + " ps 0.8 lc rgb '" +
         look.colour + "'";
}

/// "x y least most" by size.
std::string operation_points(const std::vector<OperationRow>& rows, const char* operation,
                             const MethodLook& look, bool is_ball) {
  std::string points;
  for (const OperationRow& row : rows) {
    if (row.operation != operation || row.method != look.method) continue;
    if ((row.body == "wavy ball") != is_ball || !(row.least_cpu_s > 0.0)) continue;
    for (const double value : {row.cpu_s, std::max(row.error.rms, kLeastDrawn), row.least_cpu_s}) {
      points += cli::number(value) + " ";
    }
    points += cli::number(row.most_cpu_s) + "\n";
  }
  return points;
}

std::string operation_panel(const std::vector<OperationRow>& rows, const char* operation) {
  PlotLines lines;
  for (const MethodLook& look : kMethodLooks) {
    for (const bool is_ball : {true, false}) {
      lines.add(operation_points(rows, operation, look, is_ball),
                "xerrorlines " + look_style(look, is_ball));
    }
  }
  return lines.text();
}

std::string sizes_text(const std::vector<OperationRow>& rows) {
  std::set<double> sizes;
  for (const OperationRow& row : rows) sizes.insert(row.million);
  std::string text;
  for (const double million : sizes) {
    const bool is_last = million == *sizes.rbegin();
    text += (text.empty() ? "" : is_last ? " and " : ", ") + cli::number(million);
  }
  return text;
}

std::string operations_legend() {
  KeyStrip key(0.1, 4);
  for (const MethodLook& look : kMethodLooks) {
    key.add("linespoints " + look_style(look, true), look.title);
  }
  key.add("linespoints lw 2 pt 7 ps 0.8 lc rgb '#808080'", "wavy ball");
  key.add("linespoints lw 1.2 dt 2 pt 6 ps 0.8 lc rgb '#808080'", "turned block");
  return key.text();
}

}  // namespace

Script operations_script(const std::vector<OperationRow>& rows) {
  const Sheet sheet{
      "operations", 1280, 860, "Operations beside others: time and error, as bodies grow",
      "Bodies of " + sizes_text(rows) +
          " million vertices, a mark each from left to right; down and left is better. Error: rms "
          "in finest voxels from the exact result, 1e-4 and less as one."};
  const PanelGrid grid{4, 2, 0.065, 0.985, 0.865, 0.165, 0.05, 0.125};
  std::string text =
      "unset key\nset logscale xy\nset format x '%g'\nset format y '%g'\n"
      "set xrange [*:*]\nset yrange [*:*]\nset xlabel 'CPU time [s]'\nset ylabel 'error "
      "[voxels]'\n";
  for (std::size_t at = 0; at < kOperationPanels.size(); ++at) {
    const OperationPanel& panel = kOperationPanels[at];
    text +=
        std::string(at % grid.columns == 0 ? "set ylabel 'error [voxels]'\n" : "unset ylabel\n") +
        panel_head(grid, at, panel.title) + operation_panel(rows, panel.operation);
  }
  return finished(sheet, text + operations_legend());
}

}  // namespace argil::evaluation
