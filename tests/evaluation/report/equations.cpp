// SPDX-License-Identifier: GPL-3.0-or-later
// docs/equations.md: that every row says where its equation is computed, what shows it and what
// holds it, that the files and tests are there, and that the commands run.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/built.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;

/// The columns of both tables.
enum Column : std::size_t { kWhat, kFiles, kCommand, kTests, kExpected, kMeasured, kColumns };

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

/// Rows of the page's tables but for their heads; of those under a heading when one is given.
std::vector<std::vector<std::string>> rows_of_page(const std::string& heading = {}) {
  std::ifstream page(fs::path(source_folder()) / "docs/equations.md");
  std::vector<std::vector<std::string>> rows;
  bool is_meant = heading.empty();
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ") && !heading.empty()) is_meant = line == "## " + heading;
    if (!is_meant) continue;
    if (!line.starts_with("| ") || line.starts_with("| equation ")) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(trimmed(cell));
    rows.push_back(cells);
  }
  return rows;
}

/// What stands between ticks.
std::vector<std::string> quoted_in(const std::string& cell) {
  std::vector<std::string> names;
  for (std::size_t at = 0; (at = cell.find('`', at)) != std::string::npos;) {
    const std::size_t end = cell.find('`', at + 1);
    if (end == std::string::npos) break;
    names.push_back(cell.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

/// The first arguments of all TEST() in the tests.
std::set<std::string> suites() {
  std::set<std::string> names;
  for (const fs::directory_entry& file :
       fs::recursive_directory_iterator(fs::path(source_folder()) / "tests")) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream stream(file.path());
    for (std::string line; std::getline(stream, line);) {
      if (!line.starts_with("TEST")) continue;
      const std::size_t begin = line.find('(') + 1;
      names.insert(line.substr(begin, line.find_first_of(",)", begin) - begin));
    }
  }
  return names;
}

/// What stands between ticks, and in brackets behind it.
struct NotedCommand {
  std::string command;
  std::string verdict;  ///< "" none
  friend auto operator<=>(const NotedCommand&, const NotedCommand&) = default;
};

std::vector<NotedCommand> commands_in(const std::string& cell) {
  static const std::regex pattern("`([^`]*)`(?: \\(([a-z ]+)\\))?");
  std::vector<NotedCommand> commands;
  for (std::sregex_iterator at(cell.begin(), cell.end(), pattern), end; at != end; ++at) {
    commands.push_back({(*at)[1], (*at)[2]});
  }
  return commands;
}

/// Of a run of the lab, with a space as in a sentence.
std::string verdict_in(const std::string& text) {
  std::string verdict = nlohmann::json::parse(text)["verdict"];
  std::replace(verdict.begin(), verdict.end(), '_', ' ');
  return verdict;
}

/// Status 0, which a hold that vibrates has too, and the verdict that the row has.
void expect_runs(const NotedCommand& noted, const fs::path& folder) {
  const std::string& command = noted.command;
  std::istringstream words(command);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  ASSERT_GE(arguments.size(), 2U) << command;
  ASSERT_EQ(arguments.front(), "argil") << command;
  arguments.erase(arguments.begin());
  const auto output = std::find(arguments.begin(), arguments.end(), "-o");
  if (output != arguments.end() && output + 1 != arguments.end()) {
    output[1] = (folder / output[1]).string();
  }
  arguments.emplace_back("--json");
  const Ended run = run_argil(arguments);
  ASSERT_EQ(run.status, 0) << command << "\n" << run.err;
  const bool is_judged = arguments.at(0) == "lab" && arguments.at(1) != "trial";
  EXPECT_EQ(noted.verdict, is_judged ? verdict_in(run.out) : "") << command;
}

/// A cell without its sections: "section 3.1", "§§ 3.4.2, 3.4.3". They are no equations.
std::string without_sections(const std::string& cell) {
  static const std::regex pattern(
      "(?:[Ss]ections? |(?:§)+ )\\d\\.[\\d.]*(?:(?:, | and )\\d\\.[\\d.]*)*");
  return std::regex_replace(cell, pattern, "");
}

/// The sections that the first cells name.
std::set<std::string> sections_named(const std::string& heading) {
  static const std::regex number("\\d(?:\\.\\d)+");
  std::set<std::string> sections;
  for (const auto& row : rows_of_page(heading)) {
    const std::string& cell = row.at(kWhat);
    const std::string rest = without_sections(cell);
    std::multiset<std::string> all;
    for (std::sregex_iterator at(cell.begin(), cell.end(), number), end; at != end; ++at) {
      all.insert(at->str());
    }
    for (std::sregex_iterator at(rest.begin(), rest.end(), number), end; at != end; ++at) {
      all.erase(all.find(at->str()));
    }
    sections.insert(all.begin(), all.end());
  }
  return sections;
}

/// Numbers that follow `before` in the first cells: single ones, and ranges such as (3)–(5) or
/// 3.2–3.5 whole.
std::set<int> numbers_named(const std::string& heading, const std::string& before,
                            const std::string& after) {
  const std::string one = before + "(\\d+)" + after;
  const std::regex pattern(one + "(?:–" + one + ")?");
  std::set<int> numbers;
  for (const auto& row : rows_of_page(heading)) {
    const std::string cell = without_sections(row.at(kWhat));
    for (std::sregex_iterator at(cell.begin(), cell.end(), pattern), end; at != end; ++at) {
      const int first = std::stoi((*at)[1]);
      const int last = (*at)[2].matched ? std::stoi((*at)[2]) : first;
      for (int n = first; n <= last; ++n) numbers.insert(n);
    }
  }
  return numbers;
}

std::set<int> all_to(int last) {
  std::set<int> numbers;
  for (int n = 1; n <= last; ++n) numbers.insert(n);
  return numbers;
}

TEST(EquationsPage, HasEveryEquationAndFigure) {
  const std::string falcon = "The Falcon report";
  EXPECT_EQ(numbers_named("Blanch et al. 2004", "\\(", "\\)"), all_to(12));
  EXPECT_EQ(numbers_named("Blanch et al. 2004", "figure ", ""), (std::set<int>{2, 4}));
  EXPECT_EQ(numbers_named(falcon, "\\b3\\.", "(?!\\.\\d)"), all_to(28));
  EXPECT_EQ(numbers_named(falcon, "\\b4\\.", ""), all_to(2));
  EXPECT_EQ(numbers_named(falcon, "figure ", ""), all_to(11));
}

/// Those that claim something which is in none of their equations and figures.
TEST(EquationsPage, HasEverySection) {
  EXPECT_EQ(sections_named("Blanch et al. 2004"), (std::set<std::string>{"4.1"}));
  EXPECT_EQ(
      sections_named("The Falcon report"),
      (std::set<std::string>{"3.1", "3.4.2", "3.4.3", "3.6.4", "3.7.2", "4.1", "4.2", "4.3"}));
}

TEST(EquationsPage, HasNoEmptyRowAndNamesWhatIsThere) {
  const auto rows = rows_of_page();
  ASSERT_GE(rows.size(), 25U);
  const std::set<std::string> tests = suites();
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), kColumns) << row.front();
    SCOPED_TRACE(row[kWhat]);
    for (const std::string& cell : row) EXPECT_FALSE(cell.empty());
    const auto files = quoted_in(row[kFiles]);
    EXPECT_FALSE(files.empty());
    for (const std::string& file : files) {
      EXPECT_TRUE(fs::is_regular_file(fs::path(source_folder()) / file)) << file;
    }
    const auto names = quoted_in(row[kTests]);
    EXPECT_FALSE(names.empty());
    for (const std::string& name : names) EXPECT_TRUE(tests.contains(name)) << name;
    EXPECT_FALSE(quoted_in(row[kCommand]).empty());
  }
}

TEST(EquationsPage, NamesCommandsThatRun) {
  const ScratchFolder scratch;
  std::set<NotedCommand> commands;
  for (const auto& row : rows_of_page()) {
    if (row.size() != kColumns) continue;
    for (const NotedCommand& command : commands_in(row[kCommand])) commands.insert(command);
  }
  ASSERT_FALSE(commands.empty());
  for (const NotedCommand& command : commands) expect_runs(command, scratch.path());
}

}  // namespace
}  // namespace argil::test
