// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of the force as gnuplot scripts that carry their data.
#include "force/plot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "argil/haptics/force/tool_force.h"

#include "force/plot_whole.h"

namespace argil::evaluation {
namespace {

/// A gnuplot number, or its mark for "missing".
std::string gnuplot_number(double value) {
  if (!std::isfinite(value)) return "NaN";
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string gnuplot_text(std::string text) {
  std::replace(text.begin(), text.end(), '\'', ' ');
  return "'" + text + "'";
}

/// How the points of one series look: colours that the colour-blind can tell apart.
struct SeriesLook {
  const char* series;
  const char* title;
  const char* style;
};

constexpr std::array kSeriesLooks{
    SeriesLook{"point", "point: the tool’s centre", "points pt 9 ps 1.1 lc rgb '#7f7f7f'"},
    SeriesLook{"stencil", "stencil: 96, 288, 768 points",
               "linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00'"},
    SeriesLook{"blanch", "blanch: lattice, N = 4, 6, 8 …",
               "linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9'"},
    SeriesLook{"energy", "energy: lattice, N = 4, 6, 8 …",
               "linespoints pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2'"},
    SeriesLook{"lod_blanch", "lod, blanch law", "points pt 13 ps 1.3 lc rgb '#cc79a7'"},
    SeriesLook{"lod", "lod", "points pt 13 ps 1.8 lc rgb '#d55e00'"},
    SeriesLook{"servo", "servo (default): lod or centre",
               "points pt 12 ps 1.8 lw 2 lc rgb '#009e73'"},
    SeriesLook{"fine", "fine: every finest voxel, R ≤ 32", "points pt 11 ps 1.1 lc rgb '#000000'"}};

struct ForcePanel {
  const char* scene;
  const char* title;
  double limit_pct;  ///< what docs/forces.md promises of the default there
  /// The limit is a share of what all of the clay pushes with, whichever way, and not of the force:
  /// two faces that push against each other leave a small difference of what each does wrong.
  bool is_of_pushes = false;
};

constexpr std::array kPanels{ForcePanel{"all smooth", "Smooth: plane, ball, torus", 1.0},
                             ForcePanel{"edge", "Edge of 90°", 3.0},
                             ForcePanel{"rough", "Rough plane", 3.0},
                             ForcePanel{"slot", "Slot one radius wide", 3.0},
                             ForcePanel{"sheet", "Sheet one radius thick", 1.0, true},
                             ForcePanel{"bunny", "Stanford bunny", 3.0}};

/// A y value of a panel chart, in percent, and how it is called.
struct Measure {
  const char* name;
  const char* axis;
  std::function<double(const Tally&)> value;
  double limit_pct;  ///< promised in every panel; 0: the panel says
  bool is_error;     ///< of the force, which is known of the centre alone as well
};

std::string plot_head(const std::string& picture, int width, int height, const std::string& title,
                      const std::string& subtitle) {
  return "# Made by 'argil chart force'; run gnuplot on it in its folder.\n"
         "set encoding utf8\n"
         "set terminal svg noenhanced size " +
         std::to_string(width) + "," + std::to_string(height) +
         " font 'DejaVu Sans,12' background rgb 'white'\nset output " + gnuplot_text(picture) +
         "\nset logscale xy\nset xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' "
         "1e4, '10⁵' 1e5)\nset grid lc rgb '#e4e4e4' lw 1\n"
         "set border 3 lc rgb '#808080'\nset tics nomirror textcolor rgb '#404040'\n"
         "set format y '%g'\nset format x '%g'\n"
         "set label 1 " +
         gnuplot_text(title) + " at screen 0.03,0.965 font ',16'\nset label 2 " +
         gnuplot_text(subtitle) + " at screen 0.03,0.925 font ',11' textcolor rgb '#606060'\n";
}

/// The points of one series in one scene, one a line.
std::string scene_points(const std::vector<ForceRow>& rows, const std::string& scene,
                         const char* series, const Measure& measure) {
  std::string text;
  for (const ForceRow& row : rows) {
    if (row.scene != scene || row.series != series) continue;
    const double y = measure.value(row.tally);
    const double x = quantile(row.tally.cpu_us, 0.5);
    // The axes are logarithmic: they have no 0.
    if (std::isfinite(x) && y > 0.0) text += gnuplot_number(x) + " " + gnuplot_number(y) + "\n";
  }
  return text;
}

std::string margin(const char* side, double fraction) {
  return std::string("set ") + side + "margin at screen " + gnuplot_number(fraction) + "\n";
}

std::string data_block(const std::string& name, const std::string& lines) {
  std::string text = name;
  return text.append(" << EOD\n").append(lines).append("EOD\n");
}

/// Where panel `i` of `count` stands: three to a row, the legend to their right.
std::string panel_margins(std::size_t i, std::size_t count) {
  assert(i < count);
  constexpr double kLeft = 0.075, kRight = 0.745, kTop = 0.84, kBottom = 0.09;
  constexpr double kGapX = 0.035, kGapY = 0.13;
  const std::size_t columns = std::min<std::size_t>(count, 3);
  const std::size_t rows = (count + columns - 1) / columns;
  const auto real = [](std::size_t a) { return static_cast<double>(a); };
  const double width = (kRight - kLeft - kGapX * real(columns - 1)) / real(columns);
  const double height = (kTop - kBottom - kGapY * real(rows - 1)) / real(rows);
  const double left = kLeft + real(i % columns) * (width + kGapX);
  const double top = kTop - real(i / columns) * (height + kGapY);
  return margin("l", left) + margin("r", left + width) + margin("t", top) +
         margin("b", top - height);
}

/// The corner that the default promises to stay in.
std::string promise(double limit_pct) {
  assert(limit_pct > 0.0);
  return "set object 1 rect from graph 0, graph 0 to 8, " + gnuplot_number(limit_pct) +
         " behind fc rgb '#e8f4e6' fs solid noborder\n";
}

/// The p95 of the error that keeps to the panel's limit at every pose.
double limit_of(const std::vector<ForceRow>& rows, const ForcePanel& panel,
                const Measure& measure) {
  if (measure.limit_pct > 0.0) return measure.limit_pct;
  if (!panel.is_of_pushes) return panel.limit_pct;
  const auto row = std::ranges::find_if(rows, [&](const ForceRow& each) {
    return each.scene == panel.scene && each.method == "servo";
  });
  assert(row != rows.end());
  return panel.limit_pct * quantile(row->tally.opposed, 0.95);
}

/// The default with the windows that it waits for: where they stand beside the sum alone.
std::string window_points(const std::vector<ForceRow>& rows, const std::string& scene,
                          const Measure& measure) {
  std::string text;
  for (const ForceRow& row : rows) {
    if (row.scene != scene || row.method != "servo") continue;
    const cli::WindowTimes& windows = row.tally.windows;
    const double sum_us = quantile(row.tally.cpu_us, 0.5);
    for (const auto* ms : {&windows.moved, &windows.after_dab, &windows.fresh}) {
      text += gnuplot_number(sum_us + 1e3 * quantile(*ms, 0.5)) + " " +
              gnuplot_number(measure.value(row.tally)) + "\n";
    }
  }
  return text;
}

/// Where the servo takes the centre: its time and error, and joined to it those of the sum there.
std::string centre_points(const std::vector<ForceRow>& rows, const std::string& scene,
                          const Measure& measure) {
  const ForceRow* servo = nullptr;
  const ForceRow* lod = nullptr;
  for (const ForceRow& row : rows) {
    if (row.scene != scene) continue;
    if (row.method == "servo") servo = &row;
    if (row.method == "lod") lod = &row;
  }
  if (!measure.is_error || servo == nullptr || lod == nullptr) return {};
  const Tally& t = servo->tally;
  if (t.centre_error.empty()) return {};
  return gnuplot_number(quantile(t.centre_us, 0.5)) + " " +
         gnuplot_number(100.0 * quantile(t.centre_error, 0.95)) + "\n" +
         gnuplot_number(quantile(lod->tally.cpu_us, 0.5)) + " " +
         gnuplot_number(100.0 * quantile(t.centre_lod_error, 0.95)) + "\n";
}

std::string panel_text(const std::vector<ForceRow>& rows, const ForcePanel& panel,
                       const Measure& measure, bool with_key) {
  std::string blocks;
  std::string plots;
  for (const SeriesLook& look : kSeriesLooks) {
    const std::string points = scene_points(rows, panel.scene, look.series, measure);
    if (points.empty()) continue;
    const std::string name = std::string("$") + look.series;
    blocks += data_block(name, points);
    plots += std::string(plots.empty() ? "plot " : ", ") + name + " with " + look.style +
             " title " + gnuplot_text(look.title);
  }
  const std::string windows = window_points(rows, panel.scene, measure);
  if (!windows.empty()) {
    blocks += data_block("$windows", windows);
    plots +=
        ", $windows with linespoints pt 6 ps 0.9 lw 1.5 lc rgb '#009e73' title "
        "'servo + window: move, dab, new'";
  }
  const std::string centre = centre_points(rows, panel.scene, measure);
  if (!centre.empty()) {
    blocks += data_block("$centre", centre);
    plots +=
        ", $centre with linespoints pt 8 ps 1.1 lw 1.5 lc rgb '#7b3294' title "
        "'centre where enough, lod there'";
  }
  return blocks + "set title " + gnuplot_text(panel.title) + " font ',13' offset 0,-0.4\n" +
         promise(limit_of(rows, panel, measure)) +
         (with_key ? "set key at screen 0.985,0.84 right top Left reverse samplen 1.6 spacing 1.35"
                     " font ',11'\n"
                   : "unset key\n") +
         plots + "\n";
}

std::string panels_text(const std::vector<ForceRow>& rows, const Measure& measure) {
  std::vector<ForcePanel> shown;
  for (const ForcePanel& panel : kPanels) {
    const bool known = std::any_of(rows.begin(), rows.end(),
                                   [&](const ForceRow& row) { return row.scene == panel.scene; });
    if (known) shown.push_back(panel);
  }
  std::string text = "set multiplot\n";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    text += panel_margins(i, shown.size());
    text += i % 3 == 0 ? "set format y '%g'\nset ylabel " + gnuplot_text(measure.axis) + "\n"
                       : "set format y ''\nunset ylabel\n";
    text += i + 3 >= shown.size() ? "set xlabel 'median time from hand to force [µs]'\n"
                                  : "unset xlabel\n";
    text += panel_text(rows, shown[i], measure, i == 0);
    text += "unset label 1\nunset label 2\n";
  }
  return text + "unset multiplot\n";
}

Script panels_script(const std::vector<ForceRow>& rows, const Measure& measure,
                     const std::string& title, const std::string& subtitle) {
  const std::string name = std::string("force_") + measure.name;
  return {name + ".gp", name + ".svg",
          plot_head(name + ".svg", 1280, 720, title, subtitle) +
              "set xrange [0.08:1e5]\nset yrange [1e-3:1e3]\n" + panels_text(rows, measure)};
}

/// One method against the radius, in one style.
struct Curve {
  const char* method;
  const char* title;
  const char* style;
};

constexpr std::array kCurves{
    Curve{"fine", "fine: every finest voxel", "pt 11 ps 1 lw 2 lc rgb '#000000'"},
    Curve{"blanch_32", "blanch, N = 32", "pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#56b4e9'"},
    Curve{"energy_32", "energy, N = 32", "pt 7 ps 0.5 dt 3 lw 1.5 lc rgb '#0072b2'"},
    Curve{"blanch_16", "blanch, N = 16", "pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#56b4e9'"},
    Curve{"energy_16", "energy, N = 16", "pt 7 ps 0.5 dt 2 lw 1.5 lc rgb '#0072b2'"},
    Curve{"blanch_8", "blanch, N = 8", "pt 7 ps 0.5 lw 1.5 lc rgb '#56b4e9'"},
    Curve{"energy_8", "energy, N = 8", "pt 7 ps 0.5 lw 1.5 lc rgb '#0072b2'"},
    Curve{"stencil_768", "stencil, 768 points", "pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#e69f00'"},
    Curve{"stencil_288", "stencil, 288 points", "pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#e69f00'"},
    Curve{"stencil_96", "stencil, 96 points", "pt 5 ps 0.6 lw 1.5 lc rgb '#e69f00'"},
    Curve{"lod_blanch", "lod, blanch law", "pt 13 ps 1 lw 2 lc rgb '#cc79a7'"},
    Curve{"lod", "lod", "pt 13 ps 1.5 lw 3 lc rgb '#d55e00'"},
    Curve{"servo", "servo (default): lod or centre", "pt 12 ps 1.5 lw 2 lc rgb '#009e73'"},
    Curve{"point", "point: the tool’s centre", "pt 9 ps 0.9 lw 1.5 lc rgb '#7f7f7f'"}};

/// "radius value" lines of the ball's rows of one method.
std::string along_radius(const std::vector<ForceRow>& rows, const std::string& method,
                         const std::function<double(const Tally&)>& value) {
  std::string text;
  for (const ForceRow& row : rows) {
    if (row.method != method || row.tool != "ball") continue;
    text += std::to_string(row.radius_voxels) + " " + gnuplot_number(value(row.tally)) + "\n";
  }
  return text;
}

/// What reading a query's nodes takes at least: from the block size that they fit in.
double floor_us(double samples, const ReadRates& rates) {
  constexpr double kSmall = 65536.0;
  assert(rates.small_bytes_per_us > 0.0 && rates.large_bytes_per_us > 0.0);
  const double bytes = samples * sizeof(float);
  return bytes / (bytes <= kSmall ? rates.small_bytes_per_us : rates.large_bytes_per_us);
}

/// Nodes under a ball's kernel on the finest lattice, whether they were summed or not.
std::string finest_floor(const std::vector<ForceRow>& rows, const ReadRates& rates) {
  std::string text;
  for (const ForceRow& row : rows) {
    if (row.method != "fine" || row.tool != "ball") continue;
    const double reach = haptics::kKernelSupport * row.radius_voxels;
    // In finest voxels, of which each is one node.
    const double samples = 4.0 / 3.0 * std::numbers::pi * reach * reach * reach;
    text +=
        std::to_string(row.radius_voxels) + " " + gnuplot_number(floor_us(samples, rates)) + "\n";
  }
  return text;
}

Script radius_script(const std::vector<ForceRow>& rows, const ReadRates& rates,
                     const std::string& title) {
  char subtitle[256];
  std::snprintf(subtitle, sizeof subtitle,
                "Balls, all scenes, median thread CPU time. Floors: the nodes’ bytes over the "
                "measured %.0f GB/s (64 KiB) or %.0f GB/s (1 MiB).",
                1e-3 * rates.small_bytes_per_us, 1e-3 * rates.large_bytes_per_us);
  std::string blocks;
  std::string plots = "plot ";
  for (const Curve& curve : kCurves) {
    const std::string name = std::string("$") + curve.method;
    const auto median = [](const Tally& t) { return quantile(t.cpu_us, 0.5); };
    blocks += data_block(name, along_radius(rows, curve.method, median));
    plots +=
        name + " with linespoints " + curve.style + " title " + gnuplot_text(curve.title) + ", ";
  }
  const auto least = [&](const Tally& t) { return floor_us(t.samples, rates); };
  blocks += data_block("$floor_fine", finest_floor(rows, rates));
  blocks += data_block("$floor_lod", along_radius(rows, "lod", least));
  plots +=
      "$floor_fine with lines lw 1.5 dt 4 lc rgb '#909090' title 'floor of fine', "
      "$floor_lod with lines lw 1.5 dt 4 lc rgb '#d55e00' title 'floor of lod'\n";
  return {"force_radius.gp", "force_radius.svg",
          plot_head("force_radius.svg", 1100, 680, title, subtitle) + margin("l", 0.085) +
              margin("r", 0.73) + margin("t", 0.88) + margin("b", 0.1) +
              "set xrange [3.6:142]\nset xtics (4, 8, 16, 32, 64, 128)\n"
              "set yrange [0.02:3e6]\nset ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1 000' "
              "1e3, '10 000' 1e4, '100 000' 1e5, '1 000 000' 1e6)\nset xlabel 'radius of the tool "
              "[finest voxels]'\n"
              "set ylabel 'time of a query [µs]'\n"
              "set arrow 1 from graph 0, first 1000 to graph 1, first 1000 nohead lc rgb "
              "'#b0b0b0' dt 2\nset label 3 'one tick of 1 kHz' at graph 0.015, first 1350 font "
              "',10' textcolor rgb '#707070'\n"
              "set key at screen 0.985,0.88 right top Left reverse samplen 2.4 spacing 1.25 font "
              "',11'\n" +
              blocks + plots};
}

}  // namespace

std::vector<Script> force_scripts(const std::vector<ForceRow>& by_scene,
                                  const std::vector<ForceRow>& by_radius, const ReadRates& rates,
                                  const std::string& machine) {
  const Measure error{"accuracy", "error of the force, p95 [%]",
                      [](const Tally& t) { return 100.0 * quantile(t.error, 0.95); }, 0.0, true};
  const Measure ripple{"ripple", "ripple while sliding, rms, p95 [%]",
                       [](const Tally& t) { return 100.0 * quantile(t.ripple_rms, 0.95); }, 0.5,
                       false};
  assert(!by_radius.empty());
  const auto [least, most] = std::minmax_element(
      by_radius.begin(), by_radius.end(),
      [](const ForceRow& a, const ForceRow& b) { return a.radius_voxels < b.radius_voxels; });
  const std::string tools = "Balls and 4:1 ellipsoids, radius " +
                            std::to_string(least->radius_voxels) + " to " +
                            std::to_string(most->radius_voxels) + " finest voxels, e = 1, 2, 4;";
  return {
      panels_script(
          by_scene, error, "Force: accuracy against time (" + machine + ")",
          tools +
              " 0.05 to 2 radii deep. Shaded: promised; of the sheet 1 % of what both faces push."),
      panels_script(
          by_scene, ripple, "Force: ripple against time (" + machine + ")",
          tools + " half a radius deep, sliding three cells of the method’s own lattice."),
      whole_script(by_radius, "Force: from hand to force (" + machine + ")"),
      radius_script(by_radius, rates, "Force: time against the tool’s radius (" + machine + ")")};
}

}  // namespace argil::evaluation
