// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/file_looks.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/render.h"

#include "support/scratch.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

auto look_in(const PicturePlaces& places) {
  return [places](const fs::path& file) { return look_at_file(places, file); };
}

class FileLooksTest : public testing::Test {
 protected:
  FileLooksTest() {
    for (int n = 0; n < 20; ++n) {
      files_.push_back(folder_ / (std::to_string(n) + ".vdb"));
      test::fill(files_.back(), std::string(static_cast<std::size_t>(n), 'x'));
    }
  }
  std::vector<FileLook> all_that_come(FileLooks& looks) {
    std::vector<FileLook> all;
    while (!looks.is_idle()) {
      for (FileLook& look : looks.take()) all.push_back(std::move(look));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
  }

  test::ScratchFolder folder_;
  std::vector<fs::path> files_;
};

TEST_F(FileLooksTest, ComeInTheOrderOfTheListWithNews) {
  std::atomic<int> news = 0;
  FileLooks looks(look_in({}), [&] { ++news; });
  EXPECT_TRUE(looks.is_idle());
  looks.want(files_);
  const std::vector<FileLook> all = all_that_come(looks);
  ASSERT_EQ(all.size(), files_.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    EXPECT_EQ(all[n].file, files_[n]);
    EXPECT_EQ(all[n].bytes, n);
  }
  EXPECT_EQ(news, static_cast<int>(files_.size()));
  EXPECT_FALSE(looks.has_news());
}

TEST_F(FileLooksTest, OfAListThatIsClosedOrAnotherOneNoneCome) {
  FileLooks looks(look_in({}), [] {});
  const std::vector<fs::path> last{files_[3]};
  for (int n = 0; n < 50; ++n) {
    looks.want(files_);
    if (n % 2 == 0) std::this_thread::yield();
    looks.want(n % 5 == 0 ? std::vector<fs::path>() : last);
    const std::vector<FileLook> all = all_that_come(looks);
    ASSERT_EQ(all.size(), n % 5 == 0 ? 0U : 1U);
    EXPECT_TRUE(all.empty() || all[0].file == files_[3]);
  }
}

/// While its picture is unpacked, which takes longer than to close the list.
TEST_F(FileLooksTest, OfAFileThatIsBeingLookedAtWhenTheListIsClosedNoneComes) {
  const PicturePlaces places{folder_ / "large", {}};
  Image noise{1024, 1024, {}};
  std::uint32_t state = 1;
  for (int n = 0; n < 3 * 1024 * 1024; ++n) {
    state = 1664525 * state + 1013904223;
    noise.rgb.push_back(static_cast<std::uint8_t>(state >> 24U));
  }
  const fs::path& file = files_[7];
  ASSERT_TRUE(write_picture(places.saved, file, stamp_of(file).value(), noise).ok());
  FileLooks looks(look_in(places), [] {});
  for (int n = 0; n < 10; ++n) {
    looks.want({file});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    looks.want({});
    EXPECT_TRUE(all_that_come(looks).empty());
  }
  looks.want({file});
  EXPECT_TRUE(all_that_come(looks).at(0).picture);
}

TEST_F(FileLooksTest, AreAsTheFilesAreWhenTheyAreWantedAgain) {
  FileLooks looks(look_in({}), [] {});
  looks.want({files_[5]});
  EXPECT_EQ(all_that_come(looks).at(0).bytes, 5U);
  test::fill(files_[5], "changed meanwhile");
  looks.want({files_[5]});
  EXPECT_EQ(all_that_come(looks).at(0).bytes, 17U);
  fs::remove(files_[5]);
  looks.want({files_[5]});
  EXPECT_FALSE(all_that_come(looks).at(0).is_there);
}

TEST_F(FileLooksTest, EndWhileADiskDoesNotAnswer) {
  struct Disk {
    std::atomic<bool> is_asked{false};
    std::promise<void> answer;
    std::promise<void> was_heard;
  };
  const auto disk = std::make_shared<Disk>();
  std::atomic<int> news = 0;
  const auto begin = std::chrono::steady_clock::now();
  {
    FileLooks looks(
        [disk](const fs::path& file) {
          disk->is_asked = true;
          disk->answer.get_future().wait();
          disk->was_heard.set_value_at_thread_exit();
          FileLook look;
          look.file = file;
          return look;
        },
        [&] { ++news; });
    looks.want(files_);
    while (!disk->is_asked) std::this_thread::yield();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  disk->answer.set_value();
  disk->was_heard.get_future().wait();
  EXPECT_EQ(news, 0) << "nobody is told when it answers at last";
}

TEST_F(FileLooksTest, EndWhileFilesAreStillWanted) {
  for (int n = 0; n < 20; ++n) {
    FileLooks looks(look_in({}), [] {});
    looks.want(files_);
  }
}

}  // namespace
}  // namespace argil::viewer
