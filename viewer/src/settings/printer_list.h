// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/result.h"
#include "argil/mesh/printer.h"

namespace argil::viewer {

/// The profiles of `printers/`, as they were when the program was built: file name and content.
using ProfileText = std::pair<std::string_view, std::string_view>;
const std::vector<ProfileText>& built_in_profiles();

/// The printers that can be chosen, by name, of which none is there twice: a file's name in
/// brackets tells those apart that have one name. What lies in HOME/printers, where the built-in
/// profiles are put that are not there yet, so that users can change them and add more.
struct PrinterList {
  std::vector<mesh::Printer> printers;
  std::vector<Error> problems;  ///< of files that are no profile, or could not be written
};
PrinterList read_printers(const std::filesystem::path& home);

}  // namespace argil::viewer
