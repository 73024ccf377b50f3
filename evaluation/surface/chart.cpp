// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart surface: how exact the surface is, and what it costs.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "surface/rows.h"

namespace argil::evaluation {
namespace {

std::string surface_summary(const SurfaceResult& result) {
  std::string text =
      "errors in h^2/R_curv\n"
      "scene  mesher           R/h   vertices     max      rms  us/vertex  wall ms  under 5 deg\n";
  char line[160];
  for (const SurfaceRow& row : result.rows) {
    std::snprintf(line, sizeof line, "%-6s %-14s %5.0f %10lld %7.4f %8.4f %10.3f %8.1f %10.3f %%\n",
                  row.scene.c_str(), mesher_name(row.mesher), row.detail,
                  static_cast<long long>(row.vertices), row.error_max, row.error_rms,
                  row.cpu_us_per_vertex(), 1e-3 * row.wall_us, 1e2 * row.sliver_fraction);
    text += line;
  }
  for (const std::string& reason : result.skipped) text += "skipped " + reason + "\n";
  return text;
}

Result<cli::Outcome> make_surface_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_surface(options.quick, progress);
  if (!measured) return measured.error();
  const std::vector<SurfaceRow>& rows = measured.value().rows;
  cli::Outcome outcome;
  outcome.text = surface_summary(measured.value());
  outcome.json["rows"] = rows.size();
  outcome.json["skipped"] = measured.value().skipped;
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
