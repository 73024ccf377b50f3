// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart report: that it repeats to the bit, and that its numbers are those of the reports.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/built.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;

/// What a run here gave, by picture and name.
std::map<std::string, double> numbers_of(const nlohmann::json& report) {
  std::map<std::string, double> numbers;
  for (const nlohmann::json& number : report["numbers"]) {
    const auto key =
        number["picture"].get<std::string>() + ": " + number["name"].get<std::string>();
    EXPECT_TRUE(numbers.emplace(key, number["ours"].get<double>()).second) << key;
  }
  return numbers;
}

void expect_near(const std::map<std::string, double>& numbers, const std::string& key, double value,
                 double tolerance) {
  const auto found = numbers.find(key);
  ASSERT_NE(found, numbers.end()) << key;
  EXPECT_NEAR(found->second, value, tolerance) << key;
}

void expect_numbers(const std::map<std::string, double>& numbers) {
  expect_near(numbers, "report_blanch_4: force on the surface", 3.0, 0.03);
  expect_near(numbers, "report_blanch_4: stiffness on the surface", 750.0, 15.0);
  expect_near(numbers, "report_blanch_4: clamp", 8.0, 1e-6);
  expect_near(numbers, "report_blanch_5: most change of p in a tick of 1 ms", 0.01, 1e-9);
  expect_near(numbers, "report_blanch_6: farthest from the real position, to 3 m/s", 0.24, 0.01);
  expect_near(numbers, "report_falcon_reach: x, least", -50.0, 0.1);
  expect_near(numbers, "report_falcon_reach: x, most", 50.0, 0.1);
  expect_near(numbers, "report_falcon_reach: y, least", -70.0, 0.1);
  expect_near(numbers, "report_falcon_reach: y, most", 80.0, 0.1);
  expect_near(numbers, "report_falcon_1: slope", -800.0, 8.0);
  expect_near(numbers, "report_falcon_3: damping ratio (3.3)", 0.0724, 0.0015);
  expect_near(numbers, "report_falcon_3: omega (3.4)", 41.75, 0.5);
  expect_near(numbers, "report_falcon_3: mass (3.5)", 0.4589, 0.006);
  expect_near(numbers, "report_falcon_4: most force", 8.0, 1e-6);
  const std::string quiet = "report_falcon_coupling: scenes that are quiet, ";
  expect_near(numbers, quiet + "indirect", 10.0, 0.0);
  expect_near(numbers, quiet + "indirect, no friction", 10.0, 0.0);
  EXPECT_LT(numbers.at(quiet + "direct"), 10.0);
  EXPECT_LT(numbers.at(quiet + "direct, no friction"), numbers.at(quiet + "direct"));
  // What the page says of figure 7 and of the click.
  expect_near(numbers, "report_falcon_7: hands that vibrate directly", 0.0, 0.0);
  EXPECT_GE(numbers.at("report_falcon_7: hands that vibrate directly, no friction"), 2.0);
  EXPECT_GT(numbers.at("report_falcon_7: largest chatter directly, no friction"), 0.5);
  expect_near(numbers, "report_falcon_click: force 1 mm into the ball (3.28)", 8.0, 1e-6);
  expect_near(numbers, "report_falcon_click: hands that vibrate directly", 0.0, 0.0);
  EXPECT_GE(numbers.at("report_falcon_click: hands that vibrate directly, no friction"), 2.0);
  // Sections 3.4.2 and 3.4.3.
  for (const std::string wall : {"linear, 8000 N/m", "nonlinear, 1e6 N/m^2"}) {
    EXPECT_GT(numbers.at("report_falcon_damping: swing, " + wall + ", fixed"), 1.0);
    EXPECT_LT(numbers.at("report_falcon_damping: swing, " + wall + ", adaptive"), 0.18);
  }
  EXPECT_GT(numbers.at("report_falcon_4: swing of the handle in the hold"), 0.5);
  EXPECT_LT(numbers.at("report_falcon_6: swing of the handle in the hold"), 0.18);
  // Less damping, more overshoot.
  EXPECT_GT(numbers.at("report_falcon_2: overshoot with c = 1 N s/m"),
            numbers.at("report_falcon_2: overshoot with c = 5 N s/m"));
  EXPECT_GT(numbers.at("report_falcon_2: overshoot with c = 10 N s/m"),
            numbers.at("report_falcon_2: overshoot with c = 20 N s/m"));
}

/// The figures and pictures of a report; returns its numbers.
nlohmann::json make_report(const fs::path& folder, std::vector<std::string> words = {}) {
  words.insert(words.begin(), {"chart", "report", "-o", folder.string(), "--json"});
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.json();
}

/// The line in which gnuplot names itself. Where it is another's, so are the libraries, and the
/// last digits.
std::string gnuplot_of(const fs::path& picture) {
  const std::string text = text_of(picture);
  const std::size_t at = text.find("Produced by GNUPLOT");
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// Every number of a report.csv as the other has it, to a hundredth: cycles without friction are as
/// sensitive as that.
void expect_same_numbers(const fs::path& found, const fs::path& kept) {
  std::istringstream lines(text_of(found));
  std::istringstream kept_lines(text_of(kept));
  std::string line;
  for (std::string kept_line; std::getline(kept_lines, kept_line);) {
    ASSERT_TRUE(std::getline(lines, line)) << kept_line;
    const std::size_t last = kept_line.rfind(',');
    EXPECT_EQ(line.substr(0, line.rfind(',')), kept_line.substr(0, last));
    const double number = std::strtod(kept_line.c_str() + last + 1, nullptr);
    const double here = std::strtod(line.c_str() + line.rfind(',') + 1, nullptr);
    EXPECT_NEAR(here, number, 0.01 * std::abs(number)) << line;
  }
  EXPECT_FALSE(std::getline(lines, line)) << line;
}

/// That it repeats to the bit, and is the one that docs/report shows.
TEST(ChartReport, IsTheOneThatIsKeptAndHasTheNumbersOfTheReports) {
  const ScratchFolder scratch;
  const fs::path kept = fs::path(source_folder()) / "docs/report";
  const nlohmann::json report = make_report(scratch / "report");
  EXPECT_EQ(report["figures"], 19);
  expect_numbers(numbers_of(report));
  const std::string page = text_of(scratch / "report" / "report.html");
  const char* const first_picture = "report_falcon_1.svg";
  const bool is_same_machine =
      gnuplot_of(kept / first_picture) != "" &&
      gnuplot_of(kept / first_picture) == gnuplot_of(scratch / "report" / first_picture);
  std::set<std::string> names;
  for (const nlohmann::json& file : report["files"]) {
    const fs::path path = file.get<std::string>();
    if (path.extension() == ".gp") continue;  // not kept
    names.insert(path.filename());
    EXPECT_TRUE(fs::exists(kept / path.filename())) << path;
    if (is_same_machine) {
      EXPECT_TRUE(text_of(path) == text_of(kept / path.filename()))
          << path << " is not that of docs/report: run 'argil chart report -o docs/report'";
    }
    if (path.extension() != ".svg") continue;
    EXPECT_THAT(page, testing::HasSubstr("<img src=\"" + path.filename().string() + "\""));
  }
  expect_same_numbers(scratch / "report" / "report.csv", kept / "report.csv");
  // gnuplot is one of the packages that the tests need. A page and a table besides.
  EXPECT_EQ(names.size(), 19U + 2U);
  std::set<std::string> kept_names;
  for (const auto& file : fs::directory_iterator(kept)) kept_names.insert(file.path().filename());
  EXPECT_EQ(kept_names, names);
}

/// Fewer hands, the same figures.
TEST(ChartReport, IsQuickWithTwoHands) {
  const ScratchFolder scratch;
  const nlohmann::json report = make_report(scratch / "report", {"--quick"});
  EXPECT_EQ(report["figures"], 19);
  EXPECT_EQ(numbers_of(report).at("report_falcon_coupling: scenes that are quiet, indirect"), 10.0);
}

TEST(ChartReport, HearsAnInterruptAndWritesNothing) {
  const ScratchFolder scratch;
  const fs::path folder = scratch / "report";
  RunOptions options;
  options.interrupt_when = [&] { return fs::is_directory(folder); };
  const Ended run = run_argil({"chart", "report", "-o", folder.string()}, options);
  EXPECT_EQ(run.status, 130);
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace argil::test
