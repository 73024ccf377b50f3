// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of files: where they lie, whose they are, and what is not shown as if it were true.
#include "settings/thumbnail.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#include "argil/io/png.h"

#include "support/bytes/png_maker.h"
#include "support/scratch.h"
#include "support/setting.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

/// Another shade for each, so that one is not taken for another.
Image shade(std::uint8_t grey, int width = kThumbnailWidth, int height = kThumbnailHeight) {
  Image image{width, height, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey);
  return image;
}

class ThumbnailTest : public testing::Test {
 protected:
  PicturePlaces places() const { return {folder_ / "cache/large", folder_ / "sessions"}; }
  /// A file with its picture.
  fs::path pictured(const std::string& name, std::uint8_t grey) const {
    fs::path file = folder_ / name;
    test::fill(file, "a project");
    const auto written = write_picture(places().saved, file, stamp_of(file).value(), shade(grey));
    EXPECT_TRUE(written.ok()) << written.error().message;
    return file;
  }
  fs::path saved_picture(const fs::path& file) const { return picture_file(places().saved, file); }
  /// The grey of the picture that is shown of a file; -1: none is.
  int shown(const fs::path& file) const {
    const FileLook look = look_at_file(places(), file);
    EXPECT_TRUE(look.is_there);
    EXPECT_EQ(has_picture(places().saved, file), look.picture != nullptr);
    return look.picture ? look.picture->rgba.at(0) : -1;
  }

  test::ScratchFolder folder_;
};

/// All bytes but the slash, as g_filename_to_uri of GLib 2.74 gives them.
TEST_F(ThumbnailTest, UrisAreThoseOfFileManagers) {
  std::string name;
  for (int byte = 1; byte < 256; ++byte) {
    if (byte != '/') name += static_cast<char>(byte);
  }
  EXPECT_EQ(
      uri_of(std::string("/") + name),
      "file:///%01%02%03%04%05%06%07%08%09%0A%0B%0C%0D%0E%0F%10%11%12%13%14%15%16%17%18%19%1A%1B%1C"
      "%1D%1E%1F%20!%22%23$%25&'()*+,-.0123456789:%3B%3C=%3E%3F@ABCDEFGHIJKLMNOPQRSTUVWXYZ%5B%5C%5D"
      "%5E_%60abcdefghijklmnopqrstuvwxyz%7B%7C%7D~%7F%80%81%82%83%84%85%86%87%88%89%8A%8B%8C%8D%8E"
      "%8F%90%91%92%93%94%95%96%97%98%99%9A%9B%9C%9D%9E%9F%A0%A1%A2%A3%A4%A5%A6%A7%A8%A9%AA%AB%AC"
      "%AD%AE%AF%B0%B1%B2%B3%B4%B5%B6%B7%B8%B9%BA%BB%BC%BD%BE%BF%C0%C1%C2%C3%C4%C5%C6%C7%C8%C9%CA"
      "%CB%CC%CD%CE%CF%D0%D1%D2%D3%D4%D5%D6%D7%D8%D9%DA%DB%DC%DD%DE%DF%E0%E1%E2%E3%E4%E5%E6%E7%E8"
      "%E9%EA%EB%EC%ED%EE%EF%F0%F1%F2%F3%F4%F5%F6%F7%F8%F9%FA%FB%FC%FD%FE%FF");
  EXPECT_EQ(uri_of("/a/../b/./c.vdb"), "file:///b/c.vdb");
}

/// The example of the standard, in its section on names.
TEST_F(ThumbnailTest, PicturesLieWhereTheStandardHasThem) {
  EXPECT_EQ(picture_file("/cache", "/home/jens/photos/me.png"),
            "/cache/c6ee772d9e49320e97ec29a7eb5b1697.png");
}

TEST_F(ThumbnailTest, PlacesAreTheDesktopsAndThoseOfAHomeThatWasNamed) {
  const test::Setting home("HOME", "/home/u");
  {
    const test::Setting cache("XDG_CACHE_HOME", "/var/c");
    EXPECT_EQ(picture_places("/h", false).saved, "/var/c/thumbnails/large");
  }
  const test::Setting none("XDG_CACHE_HOME", "");
  EXPECT_EQ(picture_places("/h", false).saved, "/home/u/.cache/thumbnails/large");
  EXPECT_EQ(picture_places("/h", false).work, "/h/sessions");
  EXPECT_EQ(picture_places("/h", true).saved, "/h/thumbnails/large");
}

TEST_F(ThumbnailTest, APictureIsFoundWhateverItsFileIsCalled) {
  std::map<fs::path, int> files;
  for (const char* name : {"plain.vdb", "two words.vdb", "50%.vdb", "%20.vdb",
                           "Tonfigur \xC3\xA4\xC3\xB6\xE2\x98\x85.vdb", "\xE9 of Latin-1.vdb",
                           "a#b?c;d.vdb", "'quotes\".vdb", "new\nline.vdb", "-.vdb"}) {
    const int grey = static_cast<int>(10 * (files.size() + 1));
    files[pictured(name, static_cast<std::uint8_t>(grey))] = grey;
  }
  for (const auto& [file, grey] : files) EXPECT_EQ(shown(file), grey) << file;
  const FileLook look = look_at_file(places(), files.begin()->first);
  EXPECT_EQ(look.picture->width, kThumbnailWidth);
  EXPECT_EQ(look.picture->height, kThumbnailHeight);
  EXPECT_EQ(look.bytes, 9U);
  EXPECT_LT(std::chrono::system_clock::now() - look.changed, std::chrono::minutes(10));
  // Nothing lies beside the files.
  std::size_t beside = 0;
  for (const std::string& name : folder_.names()) beside += name != "cache" ? 1 : 0;
  EXPECT_EQ(beside, files.size());
}

TEST_F(ThumbnailTest, APictureOfWhatTheFileWasBeforeIsNotShown) {
  const fs::path file = pictured("p.vdb", 40);
  const auto then = fs::last_write_time(file);
  fs::last_write_time(file, then + std::chrono::seconds(1));
  EXPECT_EQ(shown(file), -1) << "written since";
  fs::last_write_time(file, then - std::chrono::seconds(1));
  EXPECT_EQ(shown(file), -1) << "an older copy put back";
  fs::last_write_time(file, then);
  EXPECT_EQ(shown(file), 40);
  test::fill(file, "another one");
  fs::last_write_time(file, then);
  EXPECT_EQ(shown(file), -1) << "another size within the same second";
}

TEST_F(ThumbnailTest, APictureOfAnotherFileIsNotShown) {
  const fs::path one = pictured("one.vdb", 40);
  const fs::path other = pictured("other.vdb", 80);
  fs::last_write_time(other, fs::last_write_time(one));
  fs::copy_file(saved_picture(one), saved_picture(other), fs::copy_options::overwrite_existing);
  EXPECT_EQ(shown(one), 40);
  EXPECT_EQ(shown(other), -1);
}

TEST_F(ThumbnailTest, AFileThatIsGoneOrHasNoPictureIsNoFault) {
  const fs::path file = pictured("p.vdb", 40);
  fs::remove(saved_picture(file));
  EXPECT_EQ(shown(file), -1);
  EXPECT_FALSE(look_at_file(places(), file).work);
  fs::remove(file);
  EXPECT_FALSE(look_at_file(places(), file).is_there);
  EXPECT_FALSE(has_picture(places().saved, file));
  EXPECT_FALSE(look_at_file({}, file).is_there);
}

TEST_F(ThumbnailTest, ABrokenPictureIsNotShown) {
  const fs::path file = pictured("p.vdb", 40);
  const fs::path picture = saved_picture(file);
  const std::string whole = test::content_of(picture);
  // libpng has the pixels without the last chunk.
  for (std::size_t length = 0; length + 12 < whole.size(); length += 1 + length / 40) {
    test::fill(picture, whole.substr(0, length));
    EXPECT_EQ(shown(file), -1) << length;
  }
  test::fill(picture, "no picture");
  EXPECT_EQ(shown(file), -1);
  fs::remove(picture);
  fs::create_directory(picture);
  EXPECT_EQ(shown(file), -1) << "a folder";
  fs::remove(picture);
  ASSERT_EQ(::mkfifo(picture.c_str(), 0600), 0);
  EXPECT_EQ(shown(file), -1) << "a pipe, which nobody waits for";
  fs::remove(picture);
  fs::create_symlink(picture, picture);
  EXPECT_EQ(shown(file), -1) << "a link to itself";
}

TEST_F(ThumbnailTest, AGiantPictureIsNotUnpacked) {
  const fs::path file = pictured("p.vdb", 40);
  const FileStamp stamp = stamp_of(file).value();
  ASSERT_TRUE(write_picture(places().saved, file, stamp, shade(90, 1024, 20)).ok());
  EXPECT_EQ(shown(file), 90) << "as large as the standard has them";
  ASSERT_TRUE(write_picture(places().saved, file, stamp, shade(90, 1025, 20)).ok());
  EXPECT_EQ(shown(file), -1);
  ASSERT_TRUE(write_picture(places().saved, file, stamp, shade(90, 2000, 2000)).ok());
  EXPECT_EQ(shown(file), -1);
}

/// By another program: other pixels, other texts, and no size of the file.
TEST_F(ThumbnailTest, APictureThatAFileManagerMadeIsShown) {
  const fs::path file = folder_ / "p.vdb";
  test::fill(file, "a project");
  test::PngMaker maker;
  maker.width = 128;
  maker.height = 100;
  const auto packed = [&](const std::string& time) {
    std::string png = maker.png([](unsigned, unsigned, int) { return 77U; });
    std::string texts =
        test::PngMaker::chunk("tEXt", std::string("Thumb::URI\0", 11) + uri_of(file));
    texts += test::PngMaker::chunk("tEXt", std::string("Thumb::MTime\0", 13) + time);
    return png.insert(33, texts);  // behind the header
  };
  fs::create_directories(places().saved);
  const std::string time = std::to_string(stamp_of(file)->seconds);
  test::fill(saved_picture(file), packed(time));
  EXPECT_EQ(shown(file), 77);
  for (const std::string& wrong : {std::string(), time + "0", time + ".5", "x" + time}) {
    test::fill(saved_picture(file), packed(wrong));
    EXPECT_EQ(shown(file), -1) << wrong;
  }
}

/// The other way: what other programs look for, read by libpng.
TEST_F(ThumbnailTest, FileManagersFindWhatTheyLookForInIt) {
  const fs::path file = pictured("p.vdb", 40);
  std::FILE* const stream = std::fopen(saved_picture(file).c_str(), "rb");
  ASSERT_NE(stream, nullptr);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream);
  png_read_info(png, info);
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(png, info, &texts, &count);
  std::map<std::string, std::string> found;
  for (int n = 0; n < count; ++n) found[texts[n].key] = texts[n].text;
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(stream);
  EXPECT_EQ(found["Thumb::URI"], uri_of(file));
  EXPECT_EQ(found["Thumb::MTime"], std::to_string(stamp_of(file)->seconds));
  EXPECT_EQ(found["Thumb::Size"], "9");
  struct stat info_of_file {};
  ASSERT_EQ(::stat(file.c_str(), &info_of_file), 0);
  EXPECT_EQ(found["Thumb::MTime"], std::to_string(info_of_file.st_mtime));
}

TEST_F(ThumbnailTest, NobodyElseMayLookIntoPictures) {
  const fs::path file = pictured("p.vdb", 40);
  EXPECT_EQ(fs::status(places().saved).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(places().saved.parent_path()).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(saved_picture(file)).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(ThumbnailTest, AnUnwritableCacheIsAnErrorAndNothingElse) {
  const fs::path file = folder_ / "p.vdb";
  test::fill(file, "a project");
  test::fill(folder_ / "cache", "a file in the place of the folder");
  const auto refused = write_picture(places().saved, file, stamp_of(file).value(), shade(1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::disk);
  EXPECT_EQ(shown(file), -1);
  if (::geteuid() == 0) return;  // who may write everywhere
  fs::remove(folder_ / "cache");
  fs::create_directories(places().saved);
  fs::permissions(places().saved, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_FALSE(write_picture(places().saved, file, stamp_of(file).value(), shade(1)));
  EXPECT_EQ(shown(file), -1);
  EXPECT_TRUE(fs::is_empty(places().saved));
  fs::permissions(places().saved, fs::perms::owner_all);
}

TEST_F(ThumbnailTest, WorkIsPicturedWithItsStepsAndNotInTheCache) {
  const fs::path file = pictured("p.vdb", 40);
  const FileStamp stamp = stamp_of(file).value();
  ASSERT_TRUE(write_picture(places().work, file, stamp, shade(120), 14).ok());
  const FileLook look = look_at_file(places(), file);
  ASSERT_TRUE(look.work);
  EXPECT_EQ(look.work->steps, 14U);
  EXPECT_EQ(look.work->pixels->rgba.at(0), 120);
  EXPECT_EQ(shown(file), 40);
  // One without a number says nothing.
  ASSERT_TRUE(write_picture(places().work, file, stamp, shade(120)).ok());
  EXPECT_FALSE(look_at_file(places(), file).work);
}

}  // namespace
}  // namespace argil::viewer
