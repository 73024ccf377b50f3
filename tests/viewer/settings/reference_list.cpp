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

#include "support/bytes/jpeg_maker.h"
#include "support/bytes/png_maker.h"
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
  static ReferenceImage made(const fs::path& file) {
    ReferenceImage image;
    image.file = file;
    image.view = StraightView::left;
    image.width_mm = 61.7;
    image.right_mm = -3.25;
    image.up_mm = 1.0 / 3.0;
    image.opacity = 0.4;
    image.is_over = true;
    image.is_visible = false;
    return image;
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
  EXPECT_EQ(list.images, written);
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
  EXPECT_EQ(list.images[0].file.filename(), "gone.png");
  ASSERT_EQ(list.problems.size(), 7U);
  ASSERT_EQ(list.unread.size(), 7U);
  EXPECT_THAT(list.problems[0].message, HasSubstr("owl.references.txt:2 names no reference"));
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

TEST_F(ReferenceListTest, ReadsThePixelsOfPngAndJpeg) {
  const auto png = read_pixels(image(folder_ / "a.png"));
  ASSERT_TRUE(png) << png.error().message;
  EXPECT_EQ(png.value()->width, 2);
  EXPECT_EQ(png.value()->height, 1);
  EXPECT_EQ(png.value()->rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
  test::JpegMaker maker{16, 8, 1};
  maker.exif = test::JpegMaker::exif_of(6);
  test::fill(folder_ / "a.jpg", maker.jpeg([](unsigned, unsigned, int) { return 90U; }));
  const auto jpeg = read_pixels(folder_ / "a.jpg");
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  EXPECT_EQ(jpeg.value()->width, 8) << "as it is seen";
  EXPECT_EQ(jpeg.value()->rgba[0], 90);
}

TEST_F(ReferenceListTest, RefusesAnImageThatFillsTheMemoryAndANameThatTheListCannotHold) {
  const auto refuses = [](const fs::path& file, const char* message) {
    const auto read = read_pixels(file);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read.error().message, HasSubstr(message));
  };
  // Heads alone: what fits is refused for what is missing behind it, and nothing is unpacked.
  const auto headed = [&](std::uint32_t width, std::uint32_t height) {
    test::fill(folder_ / "head.png", test::PngMaker{width, height, 8, 0}.png_of_rows("few"));
    return folder_ / "head.png";
  };
  refuses(headed(8193, 8192), "8193 by 8192 pixels; it may have 67108864 in all");
  refuses(headed(16385, 1), "16385 by 1 pixels; each side must be from 1 to 16384");
  refuses(headed(2000, 2000), "is damaged");
  refuses(image(folder_ / "two\nlines.png"), "more than a line");
}

}  // namespace
}  // namespace argil::viewer
