// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart bridge: which simulators can be felt, and how stiffly.
#include "chart/chart.h"

#include <memory>

#include "bridge/map.h"
#include "chart/kinds.h"

namespace argil::evaluation {
namespace {

Result<cli::Outcome> make_bridge_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  const auto rows = measure_bridge_map(options.quick, progress);
  if (!rows) return rows.error();
  cli::Outcome outcome;
  outcome.json["rows"] = rows.value().size();
  if (auto written = write_chart(files.value(), "bridge.csv", bridge_map_csv(rows.value()),
                                 bridge_map_script(rows.value()), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_bridge(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "bridge", "which simulators can be felt through argil bridge", *options,
           [options](const Progress& progress) { return make_bridge_chart(*options, progress); });
}

}  // namespace argil::evaluation
