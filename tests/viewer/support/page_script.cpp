// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/page_script.h"

#include <fstream>
#include <regex>

namespace argil::test {

PageScript read_page_script(const std::filesystem::path& page) {
  static const std::regex picture(R"(!\[[^\]]*\]\(([^)]+)\))");
  static const std::regex shot(R"(^\s*shot\s+(\S.*)$)");
  PageScript read;
  bool is_script = false;
  std::ifstream in(page);
  for (std::string line; std::getline(in, line); read.script += '\n') {
    std::smatch found;
    if (line.starts_with("```")) {
      is_script = line == "```script";
    } else if (is_script) {
      read.script += line;
      if (std::regex_match(line, found, shot)) read.shots.emplace_back(found[1].str());
    } else if (std::regex_search(line, found, picture)) {
      read.pictures.emplace_back(found[1].str());
    }
  }
  return read;
}

}  // namespace argil::test
