// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/image_reader.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/png.h"

#include "support/bytes/jpeg_maker.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImageReaderTest : public testing::Test {
 protected:
  ImageReaderTest() { fs::create_directories(home()); }
  fs::path home() const { return folder_ / "home"; }

  fs::path png(const std::string& name, int side = 4) const {
    const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(side * side);
    const Image image{side, side, std::vector<std::uint8_t>(bytes, 50)};
    EXPECT_TRUE(io::write_png(folder_ / name, image));
    return folder_ / name;
  }

  /// All that is told until nothing is left to do.
  ImageReader::News all_of(ImageReader& reader) const {
    ImageReader::News all;
    while (!reader.is_idle()) {
      ImageReader::News news = reader.take_news();
      all.references.insert(all.references.end(), news.references.begin(), news.references.end());
      if (news.alphas) all.alphas = news.alphas;
      all.added.insert(all.added.end(), news.added.begin(), news.added.end());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
  }

  test::ScratchFolder folder_;
  std::atomic<int> told_{0};
  std::unique_ptr<ImageReader> reader_ = made();
  std::unique_ptr<ImageReader> made() {
    return std::make_unique<ImageReader>(home(), [this] { ++told_; });
  }
};

TEST_F(ImageReaderTest, ReadsInTheOrderInWhichItWasAskedAndSaysWhatIsBroken) {
  const fs::path first = png("a.png", 3);
  const fs::path second = folder_ / "b.jpg";
  test::fill(second, test::JpegMaker{5, 7, 1}.jpeg([](unsigned, unsigned, int) { return 9U; }));
  const fs::path broken = folder_ / "c.png";
  test::fill(broken, "no image");
  for (const fs::path& file : {first, second, broken}) reader_->read_reference(file);
  const ImageReader::News news = all_of(*reader_);
  ASSERT_EQ(news.references.size(), 3U);
  EXPECT_EQ(news.references[0].first, first);
  ASSERT_TRUE(news.references[0].second);
  EXPECT_EQ(news.references[0].second.value()->width, 3);
  EXPECT_EQ(news.references[1].first, second);
  ASSERT_TRUE(news.references[1].second);
  EXPECT_EQ(news.references[1].second.value()->height, 7);
  EXPECT_EQ(news.references[2].first, broken);
  ASSERT_FALSE(news.references[2].second);
  EXPECT_THAT(news.references[2].second.error().message, HasSubstr("c.png"));
  EXPECT_EQ(told_, 3);
  EXPECT_FALSE(reader_->has_news());
}

TEST_F(ImageReaderTest, AddsAnImageToThoseThatItLists) {
  reader_->add_alpha(png("mine.png"));
  reader_->add_alpha(folder_ / "gone.png");
  reader_->read_alphas();
  const ImageReader::News news = all_of(*reader_);
  ASSERT_EQ(news.added.size(), 2U);
  ASSERT_TRUE(news.added[0]);
  EXPECT_EQ(news.added[0].value(), home() / "alphas" / "mine.png");
  ASSERT_FALSE(news.added[1]);
  EXPECT_THAT(news.added[1].error().message, HasSubstr("gone.png"));
  ASSERT_TRUE(news.alphas);
  EXPECT_EQ(news.alphas->alphas.size(), 11U);
}

TEST_F(ImageReaderTest, ForgetsWhatNobodyWantsAnyMore) {
  std::vector<fs::path> files;
  files.reserve(4);
  for (int n = 0; n < 4; ++n) files.push_back(png("large" + std::to_string(n) + ".png", 1500));
  const fs::path wanted = png("wanted.png");
  for (const fs::path& file : files) reader_->read_reference(file);
  reader_->read_alphas();
  reader_->read_reference(wanted);
  reader_->forget_reference(wanted);
  reader_->read_reference(wanted);
  reader_->forget_references();
  reader_->read_reference(wanted);
  const ImageReader::News news = all_of(*reader_);
  ASSERT_EQ(news.references.size(), 1U);
  EXPECT_EQ(news.references[0].first, wanted);
  ASSERT_TRUE(news.alphas) << "those are no references";
  EXPECT_EQ(news.alphas->alphas.size(), 10U);
}

TEST_F(ImageReaderTest, ReadsOnceWhatSeveralAskFor) {
  const fs::path file = png("a.png");
  reader_->read_alphas();  // ten files are written first
  for (int n = 0; n < 3; ++n) reader_->read_reference(file);
  EXPECT_EQ(all_of(*reader_).references.size(), 1U);
  reader_->read_reference(file);
  EXPECT_EQ(all_of(*reader_).references.size(), 1U) << "again, as it is now";
}

/// Of a thousand that wait, hardly any is read before it is gone, and of the one under way nothing
/// is told.
TEST_F(ImageReaderTest, EndsWithoutWaiting) {
  const fs::path large = png("large.png", 1200);
  for (int n = 0; n < 1000; ++n) {
    const fs::path file = folder_ / ("large" + std::to_string(n) + ".png");
    fs::create_hard_link(large, file);
    reader_->read_reference(file);
  }
  while (told_ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  reader_.reset();
  EXPECT_LT(told_, 500);
  // One that has nothing to do ends as well, and so does one that was just asked.
  reader_ = made();
  reader_.reset();
  reader_ = made();
  reader_->read_reference(large);
  reader_.reset();
}

}  // namespace
}  // namespace argil::viewer
