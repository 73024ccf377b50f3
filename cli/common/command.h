// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "common/outcome.h"

namespace argil::cli {

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

/// How a command takes an interrupt. Most write nothing but their result: they end within a second,
/// wherever they are.
enum class OnInterrupt { ends_within_a_second, ends_itself };

/// From here on the command that runs ends within a second of an interrupt, wherever it is; of one
/// that had come already, within a second of now. For one that ends itself, as soon as an end
/// anywhere harms nothing: no device is driven, nothing is left to save. Again: nothing.
/// Threads  any.
void end_within_a_second();

/// What end_within_a_second says, where the work does not end by itself, and where: as JSON on the
/// descriptor `out`, or else in a line on stderr. Before end_within_a_second.
void say_interrupted_on(bool json, int out);

/// A subcommand with the options that all share; `work` runs when it was chosen.
CLI::App* add_command(CLI::App& app, Selected& selected, const std::string& name,
                      const std::string& description, Work work,
                      OnInterrupt on_interrupt = OnInterrupt::ends_within_a_second);

}  // namespace argil::cli
