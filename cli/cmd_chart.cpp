// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart KIND: how fast, how accurate, at what cost. Each kind has its folder in evaluation/.
#include "chart/kinds.h"
#include "commands.h"

namespace argil::cli {

void add_chart(CLI::App& app, Selected& selected) {
  CLI::App* chart = app.add_subcommand("chart", "measure, and draw charts of speed and accuracy");
  chart->require_subcommand(1);
  evaluation::add_chart_force(*chart, selected);
  evaluation::add_chart_failures(*chart, selected);
  evaluation::add_chart_stability(*chart, selected);
  evaluation::add_chart_memory(*chart, selected);
  evaluation::add_chart_surface(*chart, selected);
  evaluation::add_chart_decimate(*chart, selected);
  evaluation::add_chart_operations(*chart, selected);
  evaluation::add_chart_edits(*chart, selected);
  evaluation::add_chart_gallery(*chart, selected);
  evaluation::add_chart_bridge(*chart, selected);
  evaluation::add_chart_report(*chart, selected);
  evaluation::add_chart_normals(*chart, selected);
}

}  // namespace argil::cli
