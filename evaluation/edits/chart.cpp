// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart edits: what strokes cost and how exact they are, beside Blender's on the same ball.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "edits/plot.h"
#include "edits/run.h"

namespace argil::evaluation {
namespace {

std::string edits_summary(const EditResult& result) {
  std::string text =
      "errors in voxels, to the same stroke on edges a quarter as long\n"
      "editor           brush  tool        vertices  covered  dab ms  cpu ms  stroke ms    mean    "
      " max\n";
  char line[200];
  for (const EditRow& row : result.rows) {
    std::snprintf(line, sizeof line, "%-16s %-6s %-10s %9.0f %8.0f %7.3f %7.3f %10.2f",
                  editor_name(row.editor), brush_name(row.brush), row.tool.c_str(), row.vertices,
                  row.covered, row.times.dab_wall_ms(), row.times.dab_cpu_ms(),
                  row.times.stroke_wall_ms());
    text += line;
    if (row.error) {
      std::snprintf(line, sizeof line, " %7.4f %7.3f", row.error->to_finer.mean_mm / row.voxel_mm,
                    row.error->to_finer.max_mm / row.voxel_mm);
      text += line;
    }
    text += "\n";
  }
  for (const std::string& reason : result.skipped) text += "skipped " + reason + "\n";
  return text;
}

Result<cli::Outcome> make_edits_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_edits(options.quick, progress);
  if (!measured) return measured.error();
  const EditResult& result = measured.value();
  cli::Outcome outcome;
  outcome.text = edits_summary(result);
  outcome.json["rows"] = result.rows.size();
  outcome.json["skipped"] = result.skipped;
  if (auto written = write_chart(files.value(), "edits.csv", edits_csv(result.rows),
                                 edits_script(result.rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_edits(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "edits", "strokes beside Blender's: time and accuracy", *options,
           [options](const Progress& progress) { return make_edits_chart(*options, progress); });
}

}  // namespace argil::evaluation
