// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "argil/core/result.h"

#include "chart/script.h"
#include "command.h"
#include "gnuplot.h"

namespace argil::cli::chart {

/// What the kinds of chart share. A kind is one file that adds its subcommand below `chart`, and a
/// line in cmd_chart.cpp.
struct ChartOptions {
  std::filesystem::path folder = "charts";
  bool quick = false;
};

/// A kind of chart with the options -o and --quick. `options` must live as long as `work`.
CLI::App* add_kind(CLI::App& chart, Selected& selected, const std::string& name,
                   const std::string& description, ChartOptions& options, Work work);

/// Makes the folder when it is not there.
Result<void> make_folder(const std::filesystem::path& folder);

/// Runs gnuplot on a script in the folder of the chart and puts its picture there, whole.
/// Errors  as drawn_by_gnuplot and io::replace_text: a picture that was there is as it was.
Result<void> plot(const std::filesystem::path& folder, const std::string& script);

/// Writes the one table and the one script of a small chart, draws it when gnuplot is there, and
/// tells `outcome` the files; says in its text when there is no picture.
Result<void> write_chart(const std::filesystem::path& folder, const std::string& csv_name,
                         const std::string& csv, const Script& script, Outcome& outcome);

void add_chart_force(CLI::App& chart, Selected& selected);
void add_chart_failures(CLI::App& chart, Selected& selected);
void add_chart_stability(CLI::App& chart, Selected& selected);
void add_chart_memory(CLI::App& chart, Selected& selected);
void add_chart_surface(CLI::App& chart, Selected& selected);
void add_chart_decimate(CLI::App& chart, Selected& selected);
void add_chart_bridge(CLI::App& chart, Selected& selected);

}  // namespace argil::cli::chart
