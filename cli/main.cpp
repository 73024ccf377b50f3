// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

int main(int argc, char** argv) { return argil::cli::run_command_line(argc, argv); }
