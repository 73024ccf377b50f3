// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that come of saving, and of work that was not saved; and that neither waits for them.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "settings/thumbnail.h"
#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

class DocumentPicturesTest : public testing::Test {
 protected:
  fs::path home() const { return folder_ / "home"; }
  PicturePlaces places() const { return picture_places(home(), true); }
  void begin(const PicturePlaces& places) {
    thread_ = std::make_unique<DocumentThread>(DocumentThreadOptions{home(), {}, places});
  }
  void begin() { begin(places()); }
  /// As a kill would, but that pictures that were begun are finished.
  void end() { thread_.reset(); }
  void settle() {
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::vector<double> inputs;
      thread_->take_blocks(inputs);
    } while (!thread_->is_idle());
  }
  std::vector<std::string> errors() {
    std::vector<std::string> found;
    for (const Notice& notice : thread_->take_notices()) {
      if (notice.kind == Notice::Kind::error) found.push_back(notice.text);
    }
    return found;
  }
  void dab(const Vec3& at_mm, double radius_mm = 6.0) {
    Tool tool;
    tool.radii_mm = {radius_mm, radius_mm, radius_mm};
    thread_->send(BeginStroke{tool, {}});
    thread_->send(ExtendStroke{{{0.0, at_mm, {}, 1.0}}, 0.0});
    thread_->send(EndStroke{});
    settle();
  }
  /// A ball that was just saved under a name.
  fs::path saved_ball(const std::string& name) {
    fs::path file = folder_ / name;
    thread_->send(NewClay{{io::StartShape::Kind::ball, {15.0, 0.0, 0.0}, {}}});
    thread_->send(SaveProjectAs{file});
    settle();
    return file;
  }
  FileLook look(const fs::path& file) const { return look_at_file(places(), file); }

  /// The share of pixels by which two pictures differ visibly.
  static double difference(const ReferencePixels& a, const ReferencePixels& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    std::size_t differ = 0;
    for (std::size_t n = 0; n < a.rgba.size(); n += 4) {
      differ += std::abs(int{a.rgba[n]} - int{b.rgba[n]}) > 12 ? 1 : 0;
    }
    return 4.0 * static_cast<double>(differ) / static_cast<double>(a.rgba.size());
  }

  test::ScratchFolder folder_;
  std::unique_ptr<DocumentThread> thread_;
};

TEST_F(DocumentPicturesTest, SavingMakesAPictureOfTheFileAsItIs) {
  begin();
  const fs::path file = saved_ball("50% t\xC3\xB6n.vdb");
  end();
  const FileLook first = look(file);
  ASSERT_TRUE(first.picture);
  EXPECT_EQ(first.picture->width, kThumbnailWidth);
  EXPECT_EQ(first.picture->height, kThumbnailHeight);

  begin();
  thread_->send(OpenFile{file});
  settle();
  dab({0.0, -15.0, 0.0});
  thread_->send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  end();
  const FileLook second = look(file);
  ASSERT_TRUE(second.picture);
  // The knob faces the eye.
  EXPECT_GT(difference(*first.picture, *second.picture), 0.005);
  EXPECT_FALSE(second.work);
  // Beside the project lies what a session leaves, and nothing else.
  for (const std::string& name : folder_.names()) {
    EXPECT_TRUE(!name.ends_with(".png")) << name;
  }
}

TEST_F(DocumentPicturesTest, APictureShowsTheSideThatWasLookedAt) {
  begin();
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, 15.0, 0.0});  // at the back
  thread_->send(SaveProject{});
  settle();
  end();
  const FileLook from_the_front = look(file);
  begin();
  thread_->send(OpenFile{file});
  DisplayView from_behind;
  from_behind.eye_mm = {0.0, 200.0, 0.0};
  from_behind.pixel_rad = 0.001;
  thread_->look(from_behind);
  settle();
  dab({15.0, 0.0, 0.0}, 1.0);
  thread_->send(SaveProject{});
  settle();
  end();
  const FileLook behind = look(file);
  ASSERT_TRUE(from_the_front.picture && behind.picture);
  EXPECT_GT(difference(*from_the_front.picture, *behind.picture), 0.02);
}

TEST_F(DocumentPicturesTest, SavingByLeavingMakesOneToo) {
  begin();
  const fs::path one = saved_ball("one.vdb");
  const fs::path other = saved_ball("other.vdb");
  thread_->send(OpenFile{one});
  settle();
  dab({0.0, -15.0, 0.0});
  thread_->send(OpenFile{other});  // one is saved by that
  settle();
  dab({0.0, -15.0, 0.0});
  thread_->send(EndProject{true});
  settle();
  EXPECT_TRUE(errors().empty());
  end();
  const FileLook looks[] = {look(one), look(other)};
  for (const FileLook& each : looks) ASSERT_TRUE(each.picture) << each.file;
  EXPECT_EQ(difference(*looks[0].picture, *looks[1].picture), 0.0);
}

/// As those that were made before there were pictures, or by the command line.
TEST_F(DocumentPicturesTest, AProjectWithoutAPictureHasOneOnceItWasOpen) {
  const fs::path file = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(file, Clay::ball(10.0, {}).value()).ok());
  const auto written = fs::last_write_time(file);
  begin();
  thread_->send(OpenFile{file});
  thread_->send(EndProject{true});
  settle();
  end();
  EXPECT_TRUE(look(file).picture);
  EXPECT_EQ(fs::last_write_time(file), written);
}

TEST_F(DocumentPicturesTest, LeavingWithoutSavingLeavesThePictureOfWhatWasSaved) {
  begin();
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  thread_->send(EndProject{false});
  settle();
  end();
  const FileLook seen = look(file);
  ASSERT_TRUE(seen.picture);
  EXPECT_FALSE(seen.work);
  begin();
  const fs::path same = saved_ball("same.vdb");
  end();
  EXPECT_EQ(difference(*seen.picture, *look(same).picture), 0.0);
}

TEST_F(DocumentPicturesTest, SavingSucceedsWherePicturesCannotBeWritten) {
  test::fill(folder_ / "file", "in the place of folders");
  begin({folder_ / "file" / "large", folder_ / "file" / "work"});
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  thread_->send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(thread_->state().is_changed);
  const std::uint64_t hash = io::load_project(file).value().hash();
  end();
  EXPECT_EQ(hash, io::open_project(file).value().sculpture.hash());
}

TEST_F(DocumentPicturesTest, WorkThatWasNotSavedIsFoundWithItsSteps) {
  begin();
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  dab({0.0, 0.0, 15.0});
  end();
  const auto left = io::left_steps(file);
  ASSERT_TRUE(left.ok() && left.value());
  EXPECT_EQ(left.value()->steps, 2U);
  const FileLook seen = look(file);
  ASSERT_TRUE(seen.picture && seen.work);
  // The first step at once, the next one only some seconds later, which a busy machine may need.
  const std::size_t pictured = seen.work->steps;
  EXPECT_TRUE(pictured == 1 || pictured == 2) << pictured;
  EXPECT_GT(difference(*seen.picture, *seen.work->pixels), 0.005);

  // Recovered, it is pictured as it is now.
  begin();
  thread_->send(OpenFile{file, true, OpenFile::Left::repeat});
  settle();
  end();
  const FileLook recovered = look(file);
  ASSERT_TRUE(recovered.work);
  EXPECT_EQ(recovered.work->steps, 2U);
  EXPECT_EQ(difference(*seen.work->pixels, *recovered.work->pixels) > 0.005, pictured == 1);
}

TEST_F(DocumentPicturesTest, WorkIsPicturedNoMoreOnceItIsSaved) {
  begin();
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  thread_->send(SaveProject{});
  settle();
  end();
  EXPECT_FALSE(fs::exists(picture_file(places().work, file)));
  EXPECT_TRUE(look(file).picture);
}

TEST_F(DocumentPicturesTest, WorkThatIsPutAsideIsPicturedNoMore) {
  begin();
  const fs::path file = saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  end();
  ASSERT_TRUE(look(file).work);
  begin();
  thread_->send(OpenFile{file, true, OpenFile::Left::put_aside});
  settle();
  end();
  EXPECT_FALSE(fs::exists(picture_file(places().work, file)));
  EXPECT_TRUE(look(file).picture);
}

TEST_F(DocumentPicturesTest, WorkWithoutANameIsPicturedUntilItIsThrownAwayOrNamed) {
  begin();
  thread_->send(NewClay{{io::StartShape::Kind::ball, {15.0, 0.0, 0.0}, {}}});
  settle();
  dab({0.0, -15.0, 0.0});
  const fs::path unnamed = thread_->state().file;
  end();
  EXPECT_TRUE(look(unnamed).work);
  EXPECT_FALSE(look(unnamed).picture);
  begin();
  thread_->send(OpenFile{unnamed, true, OpenFile::Left::repeat});
  thread_->send(SaveProjectAs{folder_ / "named.vdb"});
  settle();
  EXPECT_TRUE(errors().empty());
  thread_->send(NewClay{{io::StartShape::Kind::ball, {15.0, 0.0, 0.0}, {}}});
  settle();
  dab({0.0, -15.0, 0.0});
  const fs::path second = thread_->state().file;
  end();
  EXPECT_TRUE(look(folder_ / "named.vdb").picture);
  ASSERT_TRUE(look(second).work);
  begin();
  thread_->send(DropProject{second});
  settle();
  end();
  EXPECT_TRUE(fs::is_empty(places().work));
}

TEST_F(DocumentPicturesTest, TwoWindowsKeepThePicturesOfBoth) {
  begin();
  DocumentThread other{DocumentThreadOptions{home(), {}, places()}};
  const fs::path one = folder_ / "one.vdb";
  const fs::path two = folder_ / "two.vdb";
  const auto idle = [](DocumentThread& thread) {
    std::vector<double> inputs;
    thread.take_blocks(inputs);
    return thread.is_idle();
  };
  for (int n = 0; n < 4; ++n) {
    thread_->send(NewClay{{io::StartShape::Kind::ball, {15.0, 0.0, 0.0}, {}}});
    thread_->send(SaveProjectAs{one});
    other.send(NewClay{{io::StartShape::Kind::block, {10.0, 20.0, 30.0}, {}}});
    other.send(SaveProjectAs{two});
    while (!idle(*thread_) || !idle(other)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  EXPECT_TRUE(errors().empty());
  end();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!look(two).picture && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ASSERT_TRUE(look(one).picture && look(two).picture);
  EXPECT_GT(difference(*look(one).picture, *look(two).picture), 0.1);
}

TEST_F(DocumentPicturesTest, WithoutPlacesNoneAreKept) {
  begin({});
  saved_ball("p.vdb");
  dab({0.0, -15.0, 0.0});
  end();
  EXPECT_FALSE(fs::exists(home() / "thumbnails"));
  EXPECT_FALSE(fs::exists(home() / "sessions"));
}

}  // namespace
}  // namespace argil::viewer
