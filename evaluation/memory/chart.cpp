// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart memory: what detail costs, and what levels save.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "common/command.h"
#include "common/output.h"
#include "memory/rows.h"

namespace argil::evaluation {
namespace {

std::string memory_summary(const MemoryResult& result) {
  std::string text = "what            across   active finest  bytes/active  stack/finest  MB\n";
  char line[160];
  for (const MemoryRow& row : result.rows) {
    std::snprintf(line, sizeof line, "%-14s %7.0f %15s %13.2f %13.2f  %.1f (whole %.1f)\n",
                  row.piece.c_str(), row.voxels_across, cli::grouped(row.finest_active).c_str(),
                  row.bytes_per_active(), row.stack_to_finest(),
                  1e-6 * static_cast<double>(row.stack_bytes),
                  1e-6 * static_cast<double>(row.whole_bytes));
    text += line;
  }
  for (const std::string& skipped : result.skipped) text += "skipped " + skipped + "\n";
  return text;
}

Result<cli::Outcome> make_memory_chart(const ChartOptions& options, const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_memory(options.quick, progress);
  if (!measured) return measured.error();
  const MemoryResult& result = measured.value();
  cli::Outcome outcome;
  outcome.text = memory_summary(result);
  outcome.json["rows"] = result.rows.size();
  outcome.json["growth_exponent"] = {
      {"active_voxels", growth_exponent(result.rows, &MemoryRow::finest_active)},
      {"leaf_bytes", growth_exponent(result.rows, &MemoryRow::stack_leaf_bytes)},
      {"bytes", growth_exponent(result.rows, &MemoryRow::stack_bytes)}};
  outcome.json["skipped"] = result.skipped;
  if (auto written = write_chart(files.value(), "memory.csv", memory_csv(result.rows),
                                 memory_script(result.rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_memory(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "memory", "what detail costs in memory, and what levels save", *options,
           [options](const Progress& progress) { return make_memory_chart(*options, progress); });
}

}  // namespace argil::evaluation
