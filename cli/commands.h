// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "common/command.h"

namespace argil::cli {

// Each adds one subcommand with its options to `app`.
void add_import(CLI::App& app, Selected& selected);
void add_info(CLI::App& app, Selected& selected);
void add_sculpt(CLI::App& app, Selected& selected);
void add_edit(CLI::App& app, Selected& selected);
void add_export(CLI::App& app, Selected& selected);
void add_check(CLI::App& app, Selected& selected);
void add_repair(CLI::App& app, Selected& selected);
void add_prepare(CLI::App& app, Selected& selected);
void add_render(CLI::App& app, Selected& selected);
void add_force(CLI::App& app, Selected& selected);
void add_chart(CLI::App& app, Selected& selected);
void add_lab(CLI::App& app, Selected& selected);
void add_bridge(CLI::App& app, Selected& selected);
void add_view(CLI::App& app, Selected& selected);
void add_falcon(CLI::App& app, Selected& selected);
void add_completion(CLI::App& app, Selected& selected);
void add_man(CLI::App& app, Selected& selected);

}  // namespace argil::cli
