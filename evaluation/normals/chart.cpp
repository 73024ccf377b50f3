// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart normals: ways to the normal of waves, by what they cost and how exact they are.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "normals/rows.h"

namespace argil::evaluation {
namespace {

std::string normals_summary(const std::vector<NormalRow>& rows) {
  std::string text =
      "strategy             setting  depth   deg rms   deg max    mm rms    mm max      bytes    "
      "ns\n";
  char line[160];
  for (const NormalRow& row : rows) {
    std::snprintf(line, sizeof line, "%-20s %7g %6g %9.2g %9.2g %9.2g %9.2g %10zu %5.0f\n",
                  row.strategy.c_str(), row.setting, row.depth_mm, row.angle_rms_deg,
                  row.angle_max_deg, row.distance_rms_mm, row.distance_max_mm, row.bytes, row.ns);
    text += line;
  }
  return text;
}

Result<cli::Outcome> make_normals_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_normals(options.quick, progress);
  if (!measured) return measured.error();
  const std::vector<NormalRow>& rows = measured.value();
  cli::Outcome outcome;
  outcome.text = normals_summary(rows);
  outcome.json["rows"] = rows.size();
  if (auto written = write_chart(files.value(), "normals.csv", normals_csv(rows),
                                 normals_script(rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_normals(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "normals", "ways to the normal of waves: error against time", *options,
           [options](const Progress& progress) { return make_normals_chart(*options, progress); });
}

}  // namespace argil::evaluation
