// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "argil/core/progress.h"
#include "argil/core/result.h"

namespace argil::cli {

using Json = nlohmann::ordered_json;

/// What a finished subcommand has to say.
struct Outcome {
  Json json;         ///< the object of --json
  std::string text;  ///< the same for a person, with line ends
  int status = 0;    ///< 0 done, 1 the thing checked is not so
};

using Work = std::function<Result<Outcome>(const Progress&)>;

/// What the command line chose: filled while it is parsed, run after.
struct Selected {
  std::string command;
  Work work;
  bool json = false;
  bool quiet = false;
  bool ends_itself = false;    ///< an interrupt is its usual end, and it has something to save
  int threads = 0;             ///< 0: as many as the machine has
  double max_memory_gb = 0.0;  ///< 0: a quarter of the machine's, but 2 GB at least
};

// Each adds one subcommand with its options to `app`.
void add_import(CLI::App& app, Selected& selected);
void add_info(CLI::App& app, Selected& selected);
void add_sculpt(CLI::App& app, Selected& selected);
void add_edit(CLI::App& app, Selected& selected);
void add_export(CLI::App& app, Selected& selected);
void add_check(CLI::App& app, Selected& selected);
void add_repair(CLI::App& app, Selected& selected);
void add_render(CLI::App& app, Selected& selected);
void add_force(CLI::App& app, Selected& selected);
void add_chart(CLI::App& app, Selected& selected);
void add_lab(CLI::App& app, Selected& selected);
void add_bridge(CLI::App& app, Selected& selected);
void add_view(CLI::App& app, Selected& selected);
void add_falcon(CLI::App& app, Selected& selected);
void add_completion(CLI::App& app, Selected& selected);
void add_man(CLI::App& app, Selected& selected);

/// How a command takes an interrupt. Most write nothing but their result: they end within a second,
/// wherever they are.
enum class OnInterrupt { ends_within_a_second, ends_itself };

/// From here on the command that runs ends within a second of an interrupt, wherever it is; of one
/// that had come already, within a second of now. For one that ends itself, as soon as an end
/// anywhere harms nothing: no device is driven, nothing is left to save. Again: nothing.
/// Threads  any.
void end_within_a_second();

/// A subcommand with the options that all share; `work` runs when it was chosen.
CLI::App* add_command(CLI::App& app, Selected& selected, const std::string& name,
                      const std::string& description, Work work,
                      OnInterrupt on_interrupt = OnInterrupt::ends_within_a_second);

}  // namespace argil::cli
