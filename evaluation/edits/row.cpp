// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the chart.
#include "edits/row.h"

#include <cmath>

#include "common/machine.h"
#include "common/output.h"

namespace argil::evaluation {
namespace {

void append_spread(const std::optional<DistanceSpread>& spread, double voxel_mm,
                   std::string& text) {
  if (!spread) {
    text += ",,,,";
    return;
  }
  text.append(",").append(cli::number(spread->mean_mm));
  for (const double mm : {spread->mean_mm, spread->p99_mm, spread->max_mm}) {
    text.append(",").append(cli::number(mm / voxel_mm));
  }
}

}  // namespace

const char* editor_name(Editor editor) {
  switch (editor) {
    case Editor::argil:
      return "argil";
    case Editor::plain:
      return "blender";
    case Editor::dyntopo:
      return "blender_dyntopo";
    case Editor::remesh:
      break;
  }
  return "blender_remesh";
}

std::string edits_csv(const std::vector<EditRow>& rows) {
  std::string text =
      "# Strokes on " + cli::machine_name() + "; " + std::to_string(kLongDabs) +
      " dabs each; a dab: the difference to strokes of " + std::to_string(kShortDabs) +
      "; times in ms: the least of the runs; CPU of all threads; errors in finest voxels of a clay "
      "with as many vertices where no mm is named\n"
      "editor,brush,tool,vertices,covered,covered_vertices,radius_mm,voxel_mm,dab_wall_ms,"
      "dab_cpu_ms,stroke_wall_ms,after_stroke_wall_ms,moved_mm,to_finer_mean_mm,to_finer_mean,"
      "to_finer_p99,to_finer_max,to_swept_mean_mm,to_swept_mean,to_swept_p99,to_swept_max,"
      "longest_edge\n";
  for (const EditRow& row : rows) {
    text.append(editor_name(row.editor)).append(",").append(brush_name(row.brush));
    text.append(",").append(row.tool);
    for (const double value : {row.vertices, row.covered}) {
      text.append(",").append(std::to_string(std::llround(value)));
    }
    text.append(",").append(std::to_string(row.covered_vertices));
    for (const double value :
         {row.radius_mm, row.voxel_mm, row.times.dab_wall_ms(), row.times.dab_cpu_ms(),
          row.times.stroke_wall_ms(), row.times.once.wall_ms, row.moved_mm}) {
      text.append(",").append(cli::number(value));
    }
    const bool has_error = row.error.has_value();
    append_spread(has_error ? std::optional(row.error->to_finer) : std::nullopt, row.voxel_mm,
                  text);
    append_spread(has_error ? row.error->to_swept : std::nullopt, row.voxel_mm, text);
    text.append(",")
        .append(has_error ? cli::number(row.error->longest_edge_mm / row.voxel_mm) : "")
        .append("\n");
  }
  return text;
}

}  // namespace argil::evaluation
