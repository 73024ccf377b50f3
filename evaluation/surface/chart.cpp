// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart surface: how exact the surface is, and what it costs.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "surface/rows.h"

namespace argil::evaluation {
namespace {

std::string surface_summary(const std::vector<SurfaceRow>& rows) {
  std::string text =
      "errors in h^2/R_curv\n"
      "scene  mesher           R/h   vertices     max      rms  us/vertex  wall ms\n";
  char line[160];
  for (const SurfaceRow& row : rows) {
    std::snprintf(line, sizeof line, "%-6s %-14s %5.0f %10lld %7.3f %8.3f %10.3f %8.1f\n",
                  row.scene.c_str(), mesher_name(row.mesher), row.detail,
                  static_cast<long long>(row.vertices), row.error_max, row.error_rms,
                  row.cpu_us_per_vertex(), 1e-3 * row.wall_us);
    text += line;
  }
  return text;
}

Result<cli::Outcome> make_surface_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_surface(options.quick, progress);
  if (!measured) return measured.error();
  const std::vector<SurfaceRow>& rows = measured.value();
  cli::Outcome outcome;
  outcome.text = surface_summary(rows);
  outcome.json["rows"] = rows.size();
  if (auto written = write_chart(files.value(), "surface.csv", surface_csv(rows),
                                 surface_script(rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_surface(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "surface", "error of the surface's vertices against time", *options,
           [options](const Progress& progress) { return make_surface_chart(*options, progress); });
}

}  // namespace argil::evaluation
