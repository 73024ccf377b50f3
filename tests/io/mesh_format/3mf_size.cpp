// SPDX-License-Identifier: GPL-3.0-or-later
// What the text of a 3MF takes is foretold to the byte, so that one that is too large is refused
// before it is written.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "file/file_bytes.h"
#include "format/zip_read.h"
#include "mesh_format/3mf_write.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

const Progress kNobodyListens;

/// A model, and what it is of.
struct SizedModel {
  explicit SizedModel(std::vector<TriangleMesh> of) : meshes(std::move(of)) {
    model.title = "a < b & \"c\"";
    model.metadata = {{"argil:one", "1 < 2"}, {"argil:two", std::string(1000, '&')}};
    AssemblyItem group{"both", {}};
    for (const TriangleMesh& mesh : meshes) {
      const auto number = static_cast<std::uint8_t>(model.objects.size());
      group.placements.push_back({model.objects.size(), {{Vec3{0, 1.0 / 3.0, 0}, {}, {}, {}}}});
      model.objects.push_back({std::string(300, '<'), Srgb{number, 20, 30}, &mesh});
    }
    items = {group, {"", {{0, {}}}}};
    model.items = &items;
  }
  SizedModel(const SizedModel&) = delete;
  SizedModel& operator=(const SizedModel&) = delete;

  std::vector<TriangleMesh> meshes;
  std::vector<AssemblyItem> items;
  ThreemfModel model;
};

/// What the writer makes of it.
std::size_t written_text(const ThreemfModel& model) {
  const test::ScratchFolder folder;
  OutputFile out(folder / "a.3mf");
  EXPECT_TRUE(write_3mf(out, model, kNobodyListens));
  EXPECT_TRUE(out.close());
  const std::string bytes = test::content_of(folder / "a.3mf");
  const auto entries = zip_directory(std::as_bytes(std::span(bytes)), "a.3mf");
  EXPECT_TRUE(entries);
  return entries.value().back().bytes;
}

/// A float of nine digits, a sign and an exponent.
constexpr double kLongest = -1.00006595e-36;

/// Numbers of all lengths.
TriangleMesh wordy_mesh() {
  TriangleMesh mesh = test::ball_mesh(20.0, 4);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 2) {
    mesh.positions[v] = Vec3{kLongest, 0.0, -3.4028234e38};
  }
  return mesh;
}

TEST(ThreemfSize, IsForetoldToTheByte) {
  // Some objects are long and deflated in pieces, some not.
  const SizedModel sized({test::ball_mesh(20.0, 5), test::box_mesh({1, 2, 3}), wordy_mesh()});
  const std::size_t bytes = written_text(sized.model);
  EXPECT_TRUE(check_3mf_size(sized.model, kNobodyListens, bytes + 1));
  const Result<void> refused = check_3mf_size(sized.model, kNobodyListens, bytes);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(refused.error().message, testing::HasSubstr(std::to_string(bytes)));
  EXPECT_THAT(refused.error().message, testing::HasSubstr("write .stl or .ply"));
}

TEST(ThreemfSize, IsWatchedWhileItIsWrittenOnce) {
  const SizedModel sized({test::ball_mesh(20.0, 6), test::ball_mesh(20.0, 6)});
  const std::size_t bytes = written_text(sized.model);
  const auto write_within = [&](std::uint64_t most) {
    const test::ScratchFolder folder;
    OutputFile out(folder / "a.3mf");
    double last = 0.0;
    const Progress listen = [&](std::string_view, double fraction) {
      EXPECT_GE(fraction, last);  // from the start once
      last = fraction;
      return true;
    };
    Result<void> written = write_3mf(out, sized.model, listen, most);
    EXPECT_TRUE(out.close());
    return std::pair(std::move(written), last);
  };
  const auto [whole, all] = write_within(bytes + 1);
  EXPECT_TRUE(whole);
  EXPECT_GT(all, 0.9);
  const auto [refused, nearly_all] = write_within(bytes);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  const auto [early, half] = write_within(bytes / 2);
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(early.error().message, testing::HasSubstr("write .stl or .ply"));
  EXPECT_LT(half, 0.7);
}

TEST(ThreemfSize, IsNeverTakenForLess) {
  // Nearly nothing but the longest lines: what is told without looking must not be less.
  TriangleMesh longest = test::box_mesh({1, 2, 3});
  longest.positions.resize(20'000, Vec3{kLongest, kLongest, kLongest});
  const SizedModel sized({longest});
  const std::size_t bytes = written_text(sized.model);
  EXPECT_GT(bytes, 20'000U * 70);
  EXPECT_FALSE(check_3mf_size(sized.model, kNobodyListens, bytes));
}

TEST(ThreemfSize, IsCountedOnlyWhereItMayBeTooLargeAndStopsWhenAsked) {
  const SizedModel sized({test::ball_mesh(20.0, 6)});
  int asked = 0;
  const Progress stop = [&](std::string_view, double fraction) {
    EXPECT_EQ(fraction, 0.0);
    ++asked;
    return false;
  };
  EXPECT_TRUE(check_3mf_size(sized.model, stop));
  EXPECT_EQ(asked, 0);
  const Result<void> stopped = check_3mf_size(sized.model, stop, 1000);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace argil::io
