// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart decimate: what fewer triangles miss of the clay, and what it costs to remove them.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "common/options.h"
#include "decimate/rows.h"

namespace argil::evaluation {
namespace {

struct DecimateChartOptions : ChartOptions {
  std::filesystem::path project;
};

std::string decimate_summary(const DecimateResult& result) {
  std::string text =
      "errors in finest voxels, the worse of both directions\n"
      "piece      by          share  triangles      mean       max  printable   cpu s\n";
  char line[160];
  for (const DecimateRow& row : result.rows) {
    std::snprintf(line, sizeof line, "%-10s %-10s %4.0f %% %10lld %9.5f %9.4f  %-9s %7.3f\n",
                  row.piece.c_str(), decimator_name(row.decimator), 100.0 * row.fraction,
                  static_cast<long long>(row.triangles), row.mean_voxels(),
                  row.error.max_mm() / row.voxel_mm, row.printable ? "yes" : "no", row.cpu_s);
    text += line;
  }
  for (const std::string& reason : result.skipped) text += "skipped " + reason + "\n";
  return text;
}

Result<cli::Outcome> make_decimate_chart(const DecimateChartOptions& options,
                                         const Progress& progress) {
  if (!options.project.empty()) {
    if (auto input = cli::check_input(options.project); !input) return input.error();
  }
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_decimate(options.quick, options.project, progress);
  if (!measured) return measured.error();
  const DecimateResult& result = measured.value();
  cli::Outcome outcome;
  outcome.text = decimate_summary(result);
  outcome.json["rows"] = result.rows.size();
  outcome.json["skipped"] = result.skipped;
  if (auto written = write_chart(files.value(), "decimate.csv", decimate_csv(result.rows),
                                 decimate_script(result.rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_decimate(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<DecimateChartOptions>();
  CLI::App* command = add_kind(
      chart, selected, "decimate", "error of fewer triangles against count and time", *options,
      [options](const Progress& progress) { return make_decimate_chart(*options, progress); });
  command->add_option("PROJECT", options->project, "a project to measure besides");
}

}  // namespace argil::evaluation
