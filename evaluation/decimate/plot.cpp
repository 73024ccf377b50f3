// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of fewer triangles: their error against count and time.
#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "common/output.h"
#include "decimate/rows.h"

namespace argil::evaluation {
namespace {

/// Colours that the colour-blind can tell apart.
struct DecimatorLook {
  Decimator decimator;
  const char* title;
  const char* style;
};
constexpr std::array kDecimatorLooks{
    DecimatorLook{Decimator::argil, "Argil, against the clay",
                  "linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2'"},
    DecimatorLook{Decimator::openmesh, "OpenMesh, quadrics",
                  "linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00'"},
    DecimatorLook{Decimator::cgal, "CGAL, Garland-Heckbert quadrics",
                  "linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73'"}};
constexpr const char* kWhole = "lines lw 1.5 dt 2 lc rgb '#606060'";

using DecimateValue = std::function<double(const DecimateRow&)>;

double triangles(const DecimateRow& row) { return static_cast<double>(row.triangles); }
double cpu_s(const DecimateRow& row) { return row.cpu_s; }
double mean_error(const DecimateRow& row) { return row.mean_voxels(); }

std::vector<std::string> pieces_of(const std::vector<DecimateRow>& rows) {
  std::vector<std::string> pieces;
  for (const DecimateRow& row : rows) {
    if (row.decimator == Decimator::none) pieces.push_back(row.piece);
  }
  return pieces;
}

/// A level line at the error of the whole surface, as wide as the three curves.
std::string whole_line(const std::vector<DecimateRow>& rows, const std::string& piece,
                       const DecimateValue& x) {
  double error = 0.0;
  double least = 0.0;
  double most = 0.0;
  for (const DecimateRow& row : rows) {
    if (row.piece != piece) continue;
    if (row.decimator == Decimator::none) {
      error = mean_error(row);
      continue;
    }
    least = least == 0.0 ? x(row) : std::min(least, x(row));
    most = std::max(most, x(row));
  }
  return most == 0.0 ? "" : point_text(least, error) + point_text(most, error);
}

std::string decimate_panel(const std::vector<DecimateRow>& rows, const std::string& piece,
                           const DecimateValue& x) {
  PlotLines lines;
  for (const DecimatorLook& look : kDecimatorLooks) {
    const auto keep = [&](const DecimateRow& row) {
      return row.piece == piece && row.decimator == look.decimator;
    };
    lines.add(points_of(rows, keep, x, mean_error), look.style);
  }
  lines.add(whole_line(rows, piece, x), kWhole);
  return "set ylabel 'mean error [voxels]'\n" + lines.text();
}

std::string decimate_legend() {
  KeyStrip key(0.085, 4);
  for (const DecimatorLook& look : kDecimatorLooks) key.add(look.style, look.title);
  key.add(kWhole, "the whole surface");
  return key.text();
}

}  // namespace

Script decimate_script(const std::vector<DecimateRow>& rows) {
  const Sheet sheet{
      "decimate", 1280, 860, "Fewer triangles: what they miss, and what they cost",
      "From the whole surface to 50, 30, 10, 3 and 1 % of its triangles, a mark each. "
      "Further down is more exact. Mean distance between mesh and clay in finest "
      "voxels, the worse of both directions; CPU time of all threads."};
  const std::vector<std::string> pieces = pieces_of(rows);
  const PanelGrid grid{pieces.size(), 2, 0.07, 0.985, 0.865, 0.15, 0.065, 0.135};
  std::string text = "unset key\nset logscale xy\nset format y '%g'\nset yrange [*:*]\n";
  std::size_t at = 0;
  text += "set xlabel 'triangles'\nset format x '%.0s%c'\n";
  for (const std::string& piece : pieces) {
    text += panel_head(grid, at++, piece + ": at the same count") +
            decimate_panel(rows, piece, triangles);
  }
  text += "set xlabel 'CPU time [s]'\nset format x '%g'\n";
  for (const std::string& piece : pieces) {
    text +=
        panel_head(grid, at++, piece + ": for the same time") + decimate_panel(rows, piece, cpu_s);
  }
  return finished(sheet, text + decimate_legend());
}

}  // namespace argil::evaluation
