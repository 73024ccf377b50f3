// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/mesh/printer.h"

namespace argil::io {

/// Reads a printer profile, a JSON object with "argil_printer": 1, a "name" and any of the numbers
/// of `Printer` by their names (docs/printing.md; three generic ones are in `printers/`).
///
/// Errors  bad_input naming the file, and the key with its value and range where it is at fault:
///         not JSON, a key that is unknown or out of its range, another format; disk when it cannot
///         be read.
Result<mesh::Printer> read_printer(const std::filesystem::path& file);

}  // namespace argil::io
