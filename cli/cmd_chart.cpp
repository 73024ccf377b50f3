// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart KIND: how fast, how accurate, at what cost. Each kind has its file in chart/.
#include "chart/chart.h"

namespace argil::cli {

void add_chart(CLI::App& app, Selected& selected) {
  CLI::App* chart = app.add_subcommand("chart", "measure, and draw charts of speed and accuracy");
  chart->require_subcommand(1);
  chart::add_chart_force(*chart, selected);
  chart::add_chart_failures(*chart, selected);
  chart::add_chart_stability(*chart, selected);
  chart::add_chart_memory(*chart, selected);
  chart::add_chart_surface(*chart, selected);
  chart::add_chart_decimate(*chart, selected);
  chart::add_chart_bridge(*chart, selected);
}

}  // namespace argil::cli
