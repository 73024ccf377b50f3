// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "common/command.h"

namespace argil::evaluation {

// What the command line knows of the evaluation: each adds one subcommand, a kind of chart, below
// `argil chart`.
void add_chart_force(CLI::App& chart, cli::Selected& selected);
void add_chart_failures(CLI::App& chart, cli::Selected& selected);
void add_chart_stability(CLI::App& chart, cli::Selected& selected);
void add_chart_memory(CLI::App& chart, cli::Selected& selected);
void add_chart_surface(CLI::App& chart, cli::Selected& selected);
void add_chart_decimate(CLI::App& chart, cli::Selected& selected);
void add_chart_operations(CLI::App& chart, cli::Selected& selected);
void add_chart_edits(CLI::App& chart, cli::Selected& selected);
void add_chart_gallery(CLI::App& chart, cli::Selected& selected);
void add_chart_bridge(CLI::App& chart, cli::Selected& selected);
void add_chart_report(CLI::App& chart, cli::Selected& selected);
void add_chart_normals(CLI::App& chart, cli::Selected& selected);

}  // namespace argil::evaluation
