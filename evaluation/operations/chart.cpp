// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart operations: what whole operations cost and how exact they are, beside others'.
#include "chart/chart.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "common/options.h"
#include "operations/plot.h"
#include "operations/run.h"

namespace argil::evaluation {
namespace {

struct OperationsChartOptions : ChartOptions {
  std::vector<double> million;  ///< none: as `quick` says
};

/// Throws as cli::parse_number.
std::vector<double> parse_sizes(const std::string& text) {
  constexpr cli::Range kMillion{0.01, 10.0};
  std::vector<double> million;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    million.push_back(cli::parse_number("--sizes", text.substr(begin, end - begin), kMillion));
    begin = end + 1;
  }
  return million;
}

OperationsOptions options_of(const OperationsChartOptions& chart) {
  OperationsOptions options;
  if (chart.quick) options = {{0.01}, 1};
  if (!chart.million.empty()) options.million = chart.million;
  return options;
}

std::string operations_summary(const OperationsResult& result) {
  std::string text =
      "errors in finest voxels\n"
      "operation   body          by             million   vertices    cpu s       rms       p99    "
      "   "
      "max\n";
  char line[200];
  for (const OperationRow& row : result.rows) {
    std::snprintf(line, sizeof line, "%-11s %-13s %-13s %8g %10lld %8.3f %9.2g %9.2g %9.2g\n",
                  row.operation.c_str(), row.body.c_str(), row.method.c_str(), row.million,
                  static_cast<long long>(row.vertices), row.cpu_s, row.error.rms,
                  row.error.p99.value_or(row.error.max), row.error.max);
    text += line;
  }
  for (const std::string& reason : result.skipped) text += "skipped " + reason + "\n";
  return text;
}

Result<cli::Outcome> make_operations_chart(const OperationsChartOptions& options,
                                           const Progress& progress) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  auto measured = measure_operations(options_of(options), progress);
  if (!measured) return measured.error();
  const OperationsResult& result = measured.value();
  cli::Outcome outcome;
  outcome.text = operations_summary(result);
  outcome.json["rows"] = result.rows.size();
  outcome.json["skipped"] = result.skipped;
  if (auto written = write_chart(files.value(), "operations.csv", operations_csv(result.rows),
                                 operations_script(result.rows), outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_operations(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<OperationsChartOptions>();
  CLI::App* command = add_kind(
      chart, selected, "operations", "whole operations beside others: time and accuracy", *options,
      [options](const Progress& progress) { return make_operations_chart(*options, progress); });
  command
      ->add_option_function<std::string>(
          "--sizes", [options](const std::string& text) { options->million = parse_sizes(text); },
          "million vertices of the bodies, from .01 to 10; default .1,.5")
      ->type_name("M,...");
}

}  // namespace argil::evaluation
