// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::cli {

/// The program: parses, runs one subcommand, prints its outcome and returns its exit status
/// (docs/command_line.md). Once in a process.
int run_command_line(int argc, char** argv);

}  // namespace argil::cli
