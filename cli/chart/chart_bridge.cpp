// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart bridge: which simulators can be felt, and how stiffly.
#include <memory>

#include "chart/bridge_map.h"
#include "chart/chart.h"

namespace argil::cli::chart {
namespace {

Result<Outcome> make_bridge_chart(const ChartOptions& options, const Progress& progress) {
  if (auto made = make_folder(options.folder); !made) return made.error();
  const auto rows = measure_bridge_map(options.quick, progress);
  if (!rows) return rows.error();
  Outcome outcome;
  outcome.json["rows"] = rows.value().size();
  if (auto written = write_chart(options.folder, "bridge.csv", bridge_map_csv(rows.value()),
                                 bridge_map_script(rows.value()), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_bridge(CLI::App& chart, Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "bridge", "which simulators can be felt through argil bridge", *options,
           [options](const Progress& progress) { return make_bridge_chart(*options, progress); });
}

}  // namespace argil::cli::chart
