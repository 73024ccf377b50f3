// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/reference_list.h"

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
  EXPECT_THAT(list.problems[0].message, HasSubstr("gone.png"));
  EXPECT_THAT(list.problems[1].message, HasSubstr("owl.references.txt:2 names no reference"));
  ASSERT_TRUE(write_references(project, list.images));
  EXPECT_EQ(read_references(project).images.size(), 1U);
}

}  // namespace
}  // namespace argil::viewer
