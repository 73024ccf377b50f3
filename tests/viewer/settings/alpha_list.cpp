// SPDX-License-Identifier: GPL-3.0-or-later
// The palette of images: those of the program, those of a person, and what is no image.
#include "settings/alpha_list.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/alpha_file.h"

#include "support/bytes/jpeg_maker.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string bytes_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const AlphaChoice* named(const AlphaList& list, const std::string& name) {
  const auto found = std::find_if(list.alphas.begin(), list.alphas.end(),
                                  [&](const AlphaChoice& alpha) { return alpha.name == name; });
  return found == list.alphas.end() ? nullptr : &*found;
}

TEST(AlphaPalette, HasTheTenImagesOfTheRepositoryAtTheFirstStart) {
  const test::ScratchFolder home;
  const AlphaList list = read_alphas(home.path());
  EXPECT_TRUE(list.problems.empty());
  EXPECT_EQ(list.alphas.size(), 10U);
  for (const auto& entry : fs::directory_iterator("examples/alphas")) {
    if (entry.path().extension() != ".png") continue;
    const AlphaChoice* alpha = named(list, entry.path().stem().string());
    ASSERT_NE(alpha, nullptr) << entry.path();
    EXPECT_EQ(bytes_in(alpha->file), bytes_in(entry.path()));
    // The picture shows something, and what the image shows there.
    const auto [least, most] = std::minmax_element(alpha->thumb.begin(), alpha->thumb.end());
    EXPECT_GT(*most - *least, 60) << alpha->name;
  }
  EXPECT_TRUE(
      std::is_sorted(list.alphas.begin(), list.alphas.end(),
                     [](const AlphaChoice& a, const AlphaChoice& b) { return a.name < b.name; }));
}

TEST(AlphaPalette, LeavesOutWhatAPersonRemovedAndNamesWhatIsNoImage) {
  const test::ScratchFolder home;
  ASSERT_EQ(read_alphas(home.path()).alphas.size(), 10U);
  fs::remove(home.path() / "alphas" / "weave.png");
  std::ofstream(home.path() / "alphas" / "broken.png") << "no image";
  std::ofstream(home.path() / "alphas" / "notes.txt") << "no image";
  const AlphaList list = read_alphas(home.path());
  EXPECT_EQ(list.alphas.size(), 9U);
  EXPECT_EQ(named(list, "weave"), nullptr);
  ASSERT_EQ(list.problems.size(), 1U);
  EXPECT_THAT(list.problems[0].message, HasSubstr("broken.png"));
}

TEST(AlphaPalette, ShowsAnImageUpright) {
  const test::ScratchFolder home;
  // White above, black below; wider than high.
  std::vector<std::uint16_t> pixels(40 * 20, 0);
  std::fill_n(pixels.begin(), 40 * 10, std::uint16_t{65535});
  const auto image = AlphaImage::make(40, 20, pixels);
  ASSERT_TRUE(io::write_alpha(home / "flag.png", *image.value()).ok());
  ASSERT_TRUE(add_alpha(home.path(), home / "flag.png").ok());
  const AlphaList list = read_alphas(home.path());
  EXPECT_EQ(list.alphas.size(), 11U) << "beside the ten of the first start";
  const AlphaChoice* flag = named(list, "flag");
  ASSERT_NE(flag, nullptr);
  const auto at = [&](std::size_t row, std::size_t column) {
    return static_cast<int>(flag->thumb[row * kThumbSide + column]);
  };
  EXPECT_EQ(at(1, 12), 0) << "above the image";
  EXPECT_GT(at(8, 12), 230);
  EXPECT_GT(at(8, 1), 230) << "to its left end";
  EXPECT_LT(at(15, 12), 25);
}

TEST(AlphaPalette, TakesAnotherImageOfTheSameNameBesideTheFirst) {
  const test::ScratchFolder home;
  const auto first = add_alpha(home.path(), "examples/alphas/stars.png");
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first.value().filename(), "stars.png") << "it is there already";
  fs::copy_file("examples/alphas/weave.png", home / "stars.png");
  for (int times = 0; times < 2; ++times) {
    const auto second = add_alpha(home.path(), home / "stars.png");
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(second.value().filename(), "stars 2.png");
  }
  EXPECT_EQ(read_alphas(home.path()).alphas.size(), 11U);
  std::ofstream(home / "no.png") << "no image";
  const auto refused = add_alpha(home.path(), home / "no.png");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("no.png"));
  EXPECT_EQ(read_alphas(home.path()).alphas.size(), 11U);
}

TEST(AlphaPalette, TakesJpegsAndListsThoseThatWereCopiedThere) {
  const test::ScratchFolder home;
  const auto bright = [](unsigned x, unsigned, int) { return 16 * x; };
  test::fill(home / "photo.JPG", test::JpegMaker{16, 16, 1}.jpeg(bright));
  const auto added = add_alpha(home.path(), home / "photo.JPG");
  ASSERT_TRUE(added.ok()) << added.error().message;
  EXPECT_EQ(added.value().filename(), "photo.png");
  fs::copy_file(home / "photo.JPG", home.path() / "alphas" / "copied.Jpeg");
  const AlphaList list = read_alphas(home.path());
  EXPECT_TRUE(list.problems.empty());
  EXPECT_EQ(list.alphas.size(), 12U);
  ASSERT_NE(named(list, "photo"), nullptr);
  ASSERT_NE(named(list, "copied"), nullptr);
  EXPECT_EQ(named(list, "photo")->thumb, named(list, "copied")->thumb);
}

TEST(AlphaPalette, EndsWhereItIsToldToStop) {
  const test::ScratchFolder home;
  ASSERT_EQ(read_alphas(home.path()).alphas.size(), 10U);
  int left = 400;  // rows: one image and a half
  const AlphaList list =
      read_alphas(home.path(), [&](std::string_view, double) { return --left > 0; });
  EXPECT_LT(list.alphas.size(), 3U);
  EXPECT_TRUE(list.problems.empty()) << "nothing is wrong with the rest";
  EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace argil::viewer
