// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of clay that is served in windows: held, carved and slid over.
#include <algorithm>
#include <array>
#include <functional>

#include "chart/sheet.h"
#include "common/output.h"
#include "stability/plot.h"

namespace argil::evaluation {
namespace {

constexpr const char* kLine = "lines lw 1.4 dt 2 lc rgb '#606060'";

/// Below it a swing or a ripple is drawn at the panel's lower edge.
constexpr double kLeastMm = 1e-3;
constexpr double kLeastN = 0.01;

std::string points(int mark, const char* color) {
  return "points pt " + std::to_string(mark) + " ps 0.9 lw 1.6 lc rgb '" + color + "'";
}

std::string lined(int mark, const char* color) { return "lines" + points(mark, color); }

using Picks = std::function<bool(const SampledRow&)>;
using RowPoint = std::function<std::string(const SampledRow&)>;

std::string picked(const std::vector<SampledRow>& rows, const Picks& picks, const RowPoint& point) {
  std::string text;
  for (const SampledRow& row : rows) {
    if (picks(row)) text += point(row);
  }
  return text;
}

/// The swing of a held tool over the slope where it rests.
std::string passive_panel(const std::vector<SampledRow>& rows) {
  const RowPoint point = [](const SampledRow& row) {
    return point_text(row.closed_slope_n_per_m, std::max(kLeastMm, row.found.position_pp_mm));
  };
  const auto is = [](bool has_drag, bool is_default) {
    return [=](const SampledRow& row) {
      return !row.is_carving && row.has_drag == has_drag &&
             (row.servo == ServedServo::usual) == is_default;
    };
  };
  PlotLines lines;
  lines.add("200 0.18\n20000 0.18\n", kLine, "limit cycle");
  lines.add(picked(rows, is(false, false), point), points(6, "#000000"), "direct, contact alone");
  lines.add(picked(rows, is(true, false), point), points(2, "#0072b2"), "direct, with drag");
  lines.add(picked(rows, is(true, true), point), points(3, "#d55e00"), "default servo");
  return lines.text();
}

/// The chatter of the force while carving, over the radius; servos side by side.
std::string carving_panel(const std::vector<SampledRow>& rows) {
  const auto is = [](ServedServo servo) {
    return [=](const SampledRow& row) { return row.is_carving && row.servo == servo; };
  };
  const auto at = [](double beside) {
    return [=](const SampledRow& row) {
      return point_text(row.radius_mm * beside, std::max(kLeastN, row.found.force_pp_n));
    };
  };
  PlotLines lines;
  lines.add("0.3 0.5\n30 0.5\n", kLine, "buzz");
  lines.add(picked(rows, is(ServedServo::raw), at(0.88)), points(4, "#cc79a7"),
            "direct, raw velocities");
  lines.add(picked(rows, is(ServedServo::direct), at(1.0)), points(6, "#000000"),
            "direct, mean of 3 ms");
  lines.add(picked(rows, is(ServedServo::usual), at(1.14)), points(3, "#d55e00"), "default servo");
  return lines.text();
}

/// The slope at the first limit cycle, a column for each tool and hand.
std::string limit_panel(const std::vector<SampledLimit>& limits) {
  std::array<std::string, 4> texts;
  std::string names;
  double x = 0.0;
  for (const SampledLimit& limit : limits) {
    const auto add = [&x](std::string& text, double y) {
      if (y > 0.0) text += point_text(x, y);
    };
    if (limit.has_drag) {
      add(texts[3], limit.sampled_slope_n_per_m);
      continue;
    }
    x += 1.0;
    // In double quotes gnuplot takes \n as a new line.
    names += (names.empty() ? "\"" : ",\"") + cli::number(limit.radius_mm) + " mm\\ne " +
             cli::number(limit.exponent) + "\\n" + haptics::hand_model(limit.hand).name + "\" " +
             cli::number(x);
    add(texts[0], limit.linear_n_per_m);
    add(texts[1], limit.closed_slope_n_per_m);
    add(texts[2], limit.sampled_slope_n_per_m);
  }
  PlotLines lines;
  lines.add(texts[0], "points pt 2 ps 1.3 lw 1.6 lc rgb '#606060'", "linear wall");
  lines.add(texts[1], "points pt 6 ps 1.6 lw 1.6 lc rgb '#e69f00'", "closed form");
  lines.add(texts[2], points(7, "#000000"), "sampled, contact alone");
  lines.add(texts[3], points(2, "#0072b2"), "sampled, with drag");
  return "set xtics (" + names + ")\nset xrange [0.4:" + cli::number(x + 0.6) + "]\n" +
         lines.text();
}

/// The ripple of a prescribed slide over the size of a cell.
std::string cogging_panel(const std::vector<CoggingRow>& rows) {
  std::array<std::string, 4> texts;
  for (const CoggingRow& row : rows) {
    if (row.hand || row.speed_mm_per_s < 50.0) continue;
    const std::size_t which = (row.tilt_deg > 0.0 ? 2U : 0U) + (row.exponent == 4.0 ? 1U : 0U);
    texts[which] += point_text(row.cell_mm, 100.0 * std::max(row.normal_pp, row.sideways_pp));
  }
  const auto theory = [](double ripple) {
    return point_text(0.15, 100.0 * ripple) + point_text(6.0, 100.0 * ripple);
  };
  PlotLines lines;
  lines.add(theory(kTheorySmooth8), kLine, "theory C.4, smooth, 8 nodes");
  lines.add(theory(kTheorySmooth16), "lines lw 1.4 dt 3 lc rgb '#606060'",
            "theory C.4, smooth, 16 nodes");
  lines.add(texts[3], lined(5, "#d55e00"), "leaning 20 degrees, e 4, skin 1 mm");
  lines.add(texts[2], lined(7, "#e69f00"), "leaning, e 2, skin 8 mm");
  lines.add(texts[1], lined(9, "#0072b2"), "along the cells, e 4, skin 1 mm");
  lines.add(texts[0], lined(13, "#56b4e9"), "along the cells, e 2, skin 8 mm");
  return lines.text();
}

std::string sampled_panel_axes(std::size_t i) {
  const std::string key = "set key Left reverse samplen 1.6 font ',11' opaque ";
  switch (i) {
    case 0:
      return key +
             "left top\nset logscale xy\nset xrange [200:20000]\nset yrange [8e-4:100]\n"
             "set xlabel 'slope where it rests [N/m]'\nset ylabel 'swing [mm]'\n";
    case 1:
      return key +
             "right top\nset xrange [0.3:30]\nset yrange [8e-3:20]\n"
             "set xtics ('0.5' 0.5,'1' 1,'2' 2,'16' 16)\n"
             "set xlabel 'radius of the tool [mm]'\nset ylabel 'force p-p in 50 ms [N]'\n";
    case 2:
      return key +
             "right top\nunset logscale x\nset yrange [1000:60000]\n"
             "set xlabel 'radius of the tool, exponent, hand' offset 0,-1.4\n"
             "set ylabel 'slope where it rests [N/m]'\n";
    default:
      break;
  }
  return key +
         "right top\nset logscale x\nset xrange [0.15:6]\nset yrange [1e-3:1000]\n"
         "set xtics ('0.25' 0.25,'0.5' 0.5,'1' 1,'4' 4)\n"
         "set xlabel 'cell [mm], a quarter of the radius'\n"
         "set ylabel 'ripple p-p [% of the force]'\n";
}

}  // namespace

Script sampled_script(const SampledResult& result, const std::vector<CoggingRow>& cogging) {
  const Sheet sheet{"stability_sampled", 1280, 900, "Clay served in windows, held and carved",
                    "Flat clay of 0.5 mm voxels, 1 kHz, one tick of delay, 0.15 N of friction. A "
                    "mark for each tool, skin, exponent and hand; the lower edge: nothing."};
  const PanelGrid grid{2, 2, 0.07, 0.985, 0.85, 0.13, 0.09, 0.16};
  const std::array<std::function<std::string()>, 4> panels{
      [&] { return passive_panel(result.rows); }, [&] { return carving_panel(result.rows); },
      [&] { return limit_panel(result.limits); }, [&] { return cogging_panel(cogging); }};
  const std::array<const char*, 4> titles{"Held with 3 N", "While carving: chatter of the force",
                                          "Slope at the first limit cycle, direct",
                                          "Sliding through cells at 3 N"};
  std::string text;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    text += panel_head(grid, i, titles[i]) + sampled_panel_axes(i) + panels[i]();
  }
  return finished(sheet, text);
}

}  // namespace argil::evaluation
