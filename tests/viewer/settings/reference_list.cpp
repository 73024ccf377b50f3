// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/reference_list.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/png.h"

#include "support/scratch.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReferenceListTest : public testing::Test {
 protected:
  fs::path image(const fs::path& file) const {
    EXPECT_TRUE(io::write_png(file, {2, 1, {255, 0, 0, 0, 255, 0}}));
    return file;
  }
  ReferenceImage made(const fs::path& file) const {
    auto read = reference_of(file, StraightView::left, 61.7);
    EXPECT_TRUE(read);
    ReferenceImage image = read.value();
    image.right_mm = -3.25;
    image.up_mm = 1.0 / 3.0;
    image.opacity = 0.4;
    image.is_over = true;
    image.is_visible = false;
    return image;
  }
  /// Whether they are the same but for where their pixels lie.
  static void expect_same(const ReferenceImage& a, ReferenceImage b) {
    ASSERT_TRUE(a.pixels && b.pixels);
    EXPECT_EQ(a.pixels->rgba, b.pixels->rgba);
    b.pixels = a.pixels;
    EXPECT_EQ(a, b);
  }

  test::ScratchFolder folder_;
};

TEST_F(ReferenceListTest, IsReadAsItWasWritten) {
  const fs::path project = folder_ / "owl.vdb";
  EXPECT_TRUE(read_references(project).images.empty());
  const std::vector<ReferenceImage> written{made(image(folder_ / "from the left.png")),
                                            made(image(folder_ / "b.png"))};
  ASSERT_TRUE(write_references(project, written));
  EXPECT_TRUE(fs::exists(folder_ / "owl.references.txt"));
  const ReferenceList list = read_references(project);
  EXPECT_TRUE(list.problems.empty());
  ASSERT_EQ(list.images.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) expect_same(list.images[n], written[n]);
  ASSERT_TRUE(write_references(project, {}));
  EXPECT_FALSE(fs::exists(folder_ / "owl.references.txt")) << "no list of nothing";
}

TEST_F(ReferenceListTest, GoesAlongWithItsFolder) {
  const fs::path here = folder_ / "here";
  fs::create_directories(here / "images");
  const fs::path far = image(folder_ / "far.png");
  ASSERT_TRUE(
      write_references(here / "owl.vdb", {made(image(here / "images" / "a.png")), made(far)}));
  fs::rename(here, folder_ / "there");
  const ReferenceList list = read_references(folder_ / "there" / "owl.vdb");
  EXPECT_TRUE(list.problems.empty());
  ASSERT_EQ(list.images.size(), 2U);
  EXPECT_EQ(list.images[0].file, folder_ / "there" / "images" / "a.png");
  EXPECT_EQ(list.images[1].file, far);
}

TEST_F(ReferenceListTest, KeepsWhatCannotBeReadNowAndNamesLinesThatAreNone) {
  const fs::path project = folder_ / "owl.vdb";
  test::fill(folder_ / "owl.references.txt",
             "front 0 0 100 0.5 behind shown gone.png\n"
             "front 0 0 100 0.5 beside shown a.png\n"
             "front 0 0 -1 0.5 behind shown a.png\n"
             "front 0 nan 100 0.5 behind shown a.png\n"
             "front 0 0 100 1.5 behind shown a.png\n"
             "aslant 0 0 100 0.5 behind shown a.png\n"
             "front 0 0 100 0.5 behind shown \n"
             "\n");
  const ReferenceList list = read_references(project);
  ASSERT_EQ(list.images.size(), 1U);
  EXPECT_EQ(list.images[0].pixels, nullptr);
  ASSERT_EQ(list.problems.size(), 8U);
  ASSERT_EQ(list.unread.size(), 7U);
  EXPECT_THAT(list.problems[0].message, HasSubstr("gone.png"));
  EXPECT_THAT(list.problems[1].message, HasSubstr("owl.references.txt:2 names no reference"));
  // They may be of a newer version, or mistyped: they outlive what is changed, and all images.
  ASSERT_TRUE(write_references(project, list.images, list.unread));
  EXPECT_EQ(read_references(project).images.size(), 1U);
  EXPECT_EQ(read_references(project).unread, list.unread);
  ASSERT_TRUE(write_references(project, {}, list.unread));
  EXPECT_TRUE(read_references(project).images.empty());
  EXPECT_EQ(read_references(project).unread, list.unread);
}

/// A link to itself opens for nobody, not even for the one who may read everything.
TEST_F(ReferenceListTest, AListThatCannotBeReadIsToldAndStays) {
  const fs::path project = folder_ / "owl.vdb";
  const fs::path kept = folder_ / "owl.references.txt";
  const std::vector<ReferenceImage> images{made(image(folder_ / "a.png"))};
  fs::create_symlink(kept, kept);
  const auto is_refused = [&] {
    const ReferenceList list = read_references(project);
    ASSERT_EQ(list.problems.size(), 1U);
    EXPECT_THAT(list.problems[0].message, HasSubstr("cannot read"));
    for (const auto& written : {write_references(project, images), write_references(project, {})}) {
      ASSERT_FALSE(written);
      EXPECT_EQ(written.error().kind, ErrorKind::disk);
    }
  };
  is_refused();
  EXPECT_TRUE(fs::is_symlink(kept));
  fs::remove(kept);
  fs::create_directory(kept);
  is_refused();
  EXPECT_TRUE(fs::is_directory(kept));
}

TEST_F(ReferenceListTest, RefusesAnImageThatTakesLongAndANameThatTheListCannotHold) {
  const auto refuses = [](const fs::path& file, const char* message) {
    const auto read = reference_of(file, StraightView::left, 10.0);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read.error().message, HasSubstr(message));
  };
  constexpr int kWide = 5000;
  constexpr int kHigh = static_cast<int>(kMostReferencePixels / kWide);
  const auto image_of_height = [&](const char* name, int height) {
    const std::size_t bytes = std::size_t{3} * kWide * static_cast<std::size_t>(height);
    EXPECT_TRUE(io::write_png(folder_ / name,
                              {kWide, height, std::vector<std::uint8_t>(bytes, std::uint8_t{9})}));
    return folder_ / name;
  };
  refuses(image_of_height("more.png", kHigh + 1), "5000 x 2501 pixels");
  EXPECT_TRUE(reference_of(image_of_height("most.png", kHigh), StraightView::left, 10.0));
  refuses(image(folder_ / "two\nlines.png"), "more than a line");
}

}  // namespace
}  // namespace argil::viewer
