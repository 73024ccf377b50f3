// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart report: that it repeats to the bit, and that its numbers are those of the reports.
#include <filesystem>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
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
  expect_near(numbers, "report_falcon_coupling: scenes that are quiet, indirect", 10.0, 0.0);
  EXPECT_LT(numbers.at("report_falcon_coupling: scenes that are quiet, direct"), 10.0);
  EXPECT_GT(numbers.at("report_falcon_4: swing of the handle in the hold"), 0.5);
  EXPECT_LT(numbers.at("report_falcon_6: swing of the handle in the hold"), 0.18);
  // Less damping, more overshoot.
  EXPECT_GT(numbers.at("report_falcon_2: overshoot with c = 1 N s/m"),
            numbers.at("report_falcon_2: overshoot with c = 5 N s/m"));
  EXPECT_GT(numbers.at("report_falcon_2: overshoot with c = 10 N s/m"),
            numbers.at("report_falcon_2: overshoot with c = 20 N s/m"));
}

TEST(ChartReport, RepeatsToTheBitAndHasTheNumbersOfTheReports) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "report", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json report = make("first");
  EXPECT_EQ(report["figures"], 17);
  expect_numbers(numbers_of(report));
  make("second");
  const std::string page = text_of(scratch / "first" / "report.html");
  std::size_t pictures = 0;
  for (const nlohmann::json& file : report["files"]) {
    const fs::path path = file.get<std::string>();
    EXPECT_EQ(text_of(path), text_of(scratch / "second" / path.filename())) << path;
    if (path.extension() != ".svg") continue;
    ++pictures;
    EXPECT_THAT(page, testing::HasSubstr("<img src=\"" + path.filename().string() + "\""));
  }
  // gnuplot is one of the packages that the tests need.
  EXPECT_EQ(pictures, 17U);
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
