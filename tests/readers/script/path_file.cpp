// SPDX-License-Identifier: GPL-3.0-or-later
// Paths of guidance: from lines of numbers and from the stroke of a script.
#include "argil/io/path_file.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What is read of such a file, or the error.
Result<std::vector<Vec3>> read_path_text(const std::string& text, const char* name = "path.txt") {
  const test::ScratchFolder folder;
  test::fill(folder / name, text);
  return read_path(folder / name);
}

std::string refusal(const std::string& text, const char* name = "path.txt") {
  const auto path = read_path_text(text, name);
  return path ? "none" : path.error().message;
}

TEST(PathFile, TakesCommasAndBlanksAndLeavesOutWhatIsNoPoint) {
  const std::vector<Vec3> two{{1.0, -2.5, 3.0}, {4.0, 5.0, 6e1}};
  EXPECT_EQ(read_path_text("1 -2.5 3\n4 5 6e1\n").value(), two);
  EXPECT_EQ(read_path_text("# x, y, z\n\n1,-2.5,3\r\n 4 ,\t5, 60\r\n", "path.csv").value(), two);
  EXPECT_EQ(read_path_text("1 -2.5 3\n1 -2.5 3\n4 5 60", "path.xyz").value(), two)
      << "no line end, and a point twice";
  EXPECT_EQ(read_path_text("7 8 9\n").value(), (std::vector<Vec3>{{7.0, 8.0, 9.0}}));
}

TEST(PathFile, TakesTheFirstStrokeOfAScript) {
  const auto path = read_path_text(
      "{\"argil_strokes\":1,\"units\":\"mm\"}\n"
      "{\"operation\":\"offset\",\"distance_mm\":0.5}\n"
      "{\"tool\":\"carve\",\"shape\":\"ball\",\"radius_mm\":4,"
      "\"poses\":[[0,0,-30,5],[0.1,2,-30,6]]}\n"
      "{\"tool\":\"add\",\"shape\":\"ball\",\"radius_mm\":4,\"poses\":[[0,9,9,9]]}\n",
      "two.strokes.JSONL");
  ASSERT_TRUE(path.ok()) << path.error().message;
  EXPECT_EQ(path.value(), (std::vector<Vec3>{{0.0, -30.0, 5.0}, {2.0, -30.0, 6.0}}));
}

TEST(PathFile, SkipsAByteOrderMarkAndKnowsAHeading) {
  EXPECT_EQ(read_path_text("\xEF\xBB\xBF"
                           "1 2 3\n")
                .value(),
            (std::vector<Vec3>{{1.0, 2.0, 3.0}}));
  EXPECT_EQ(read_path_text("\xEF\xBB\xBF# x y z\n1 2 3\n").value().size(), 1U);
  EXPECT_THAT(refusal("\xEF\xBB\xBFx_mm,y_mm,z_mm\n1,2,3\n", "path.csv"),
              HasSubstr("path.csv' line 1 is not three numbers"));
  EXPECT_THAT(refusal("x_mm,y_mm,z_mm\n1,2,3\n", "path.csv"), HasSubstr("remove the heading"));
  EXPECT_THAT(refusal("1 2 3\nx y z\n"), Not(HasSubstr("heading"))) << "not the first";
}

TEST(PathFile, RefusesWhatItCannotFollowByFileAndLine) {
  EXPECT_THAT(refusal("1 2 3\n1 2\n"), HasSubstr("path.txt' line 2"));
  EXPECT_THAT(refusal("1 2 3 4\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("1 2 3mm\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("1 nan 3\n"), HasSubstr("three numbers"));
  EXPECT_THAT(refusal("1e7 0 0\n"), HasSubstr("1e6"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("is empty"));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(refusal("{\"argil_strokes\":1,\"units\":\"mm\"}\n", "none.jsonl"),
              HasSubstr("no stroke"));
  EXPECT_THAT(refusal("{\"argil_strokes\":1}\n{\"tool\":\"melt\"}\n", "bad.jsonl"),
              HasSubstr("bad.jsonl:2"));
  const auto missing = read_path("no/such/path.csv");
  ASSERT_FALSE(missing.ok());
  EXPECT_THAT(missing.error().message, HasSubstr("no/such/path.csv"));
}

/// A circle of 5000 points: a thousand of them lie on it within a fraction of a step.
TEST(PathFile, ThinsOutAPathThatIsTooFine) {
  constexpr int kPoints = 5000;
  std::string text;
  for (int n = 0; n < kPoints; ++n) {
    const double angle = 6.0 * n / kPoints;
    text += std::to_string(20.0 * std::cos(angle)) + " " + std::to_string(20.0 * std::sin(angle)) +
            " 1\n";
  }
  const auto path = read_path_text(text);
  ASSERT_TRUE(path.ok());
  const std::vector<Vec3>& points = path.value();
  EXPECT_EQ(points.size(), kMostPathPoints);
  EXPECT_EQ(points.front(), (Vec3{20.0, 0.0, 1.0}));
  EXPECT_NEAR(points.back().x, 20.0 * std::cos(6.0 * (kPoints - 1) / kPoints), 1e-5);
  const double step = 120.0 / static_cast<double>(kMostPathPoints - 1);
  for (std::size_t n = 1; n < points.size(); ++n) {
    EXPECT_NEAR(std::hypot(points[n].x, points[n].y), 20.0, 1e-3);
    EXPECT_NEAR(length(points[n] - points[n - 1]), step, 0.2 * step);
  }
}

/// Cut at every length it is a shorter path or an error, and nothing else.
TEST(PathFile, ReadsEveryTruncationOfItself) {
  const std::string text = "# a path\n1.5,-2,3\n4 5 6\n\n-7e1, 8,9\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const auto path = read_path_text(text.substr(0, size));
    if (path.ok()) {
      EXPECT_LE(path.value().size(), 3U) << size;
      EXPECT_GE(path.value().size(), 1U) << size;
    } else {
      EXPECT_EQ(path.error().kind, ErrorKind::bad_input) << size;
    }
  }
}

}  // namespace
}  // namespace argil::io
