// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace argil::test {

/// A page of the documentation whose steps are played: its blocks fenced by ```script are pieces of
/// one input script (viewer/src/input/input_script.h).
struct PageScript {
  /// All blocks in their order. Every other line of the page is an empty one, so that a message
  /// about line 12 of the script is about line 12 of the page.
  std::string script;
  std::vector<std::filesystem::path> shots;     ///< what the script takes, as it names them
  std::vector<std::filesystem::path> pictures;  ///< what the page shows, as it names them
};

/// Reads a page; all empty when there is none.
PageScript read_page_script(const std::filesystem::path& page);

}  // namespace argil::test
