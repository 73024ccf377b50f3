// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/thumbnail.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "argil/core/pace.h"
#include "argil/io/png.h"
#include "argil/io/safe_file.h"

#include "base/md5.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

// Names of the standard, but for the last.
constexpr const char* kUriKey = "Thumb::URI";
constexpr const char* kTimeKey = "Thumb::MTime";
constexpr const char* kSizeKey = "Thumb::Size";
constexpr const char* kStepsKey = "Argil::Steps";

/// Of the largest kind that the standard has: another program may have made it.
constexpr int kMostThumbnailSide = 1024;

std::chrono::system_clock::time_point clock_of(fs::file_time_type when) {
  return std::chrono::time_point_cast<std::chrono::system_clock::duration>(
      std::chrono::file_clock::to_sys(when));
}

const std::string* text_under(const std::vector<io::PngText>& texts, std::string_view key) {
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [&](const io::PngText& text) { return text.key == key; });
  return found == texts.end() ? nullptr : &found->text;
}

/// Nothing for another text than that of a whole number.
template <class Number>
std::optional<Number> number_under(const std::vector<io::PngText>& texts, std::string_view key) {
  const std::string* text = text_under(texts, key);
  if (text == nullptr) return std::nullopt;
  Number number = 0;
  const char* const end = text->data() + text->size();
  const auto read = std::from_chars(text->data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

/// Whether a picture is of the file as it is. The standard demands URI and time; another program's
/// may have no size.
bool is_of(const std::vector<io::PngText>& texts, const fs::path& file, const FileStamp& stamp) {
  const std::string* uri = text_under(texts, kUriKey);
  if (uri == nullptr || *uri != uri_of(file)) return false;
  if (number_under<std::int64_t>(texts, kTimeKey) != stamp.seconds) return false;
  return text_under(texts, kSizeKey) == nullptr ||
         number_under<std::uintmax_t>(texts, kSizeKey) == stamp.bytes;
}

/// Nothing for whatever reason.
std::optional<io::TextedImage> picture_of(const fs::path& folder, const fs::path& file,
                                          const FileStamp& stamp) {
  if (folder.empty()) return std::nullopt;
  auto read = io::read_small_png(picture_file(folder, file), kMostThumbnailSide);
  if (!read || !is_of(read.value().texts, file, stamp)) return std::nullopt;
  return std::move(read).value();
}

std::shared_ptr<const ReferencePixels> shared_pixels(io::ClearImage&& image) {
  assert(image.width > 0 && image.height > 0);
  const Progress never_stops;
  return with_smaller(image.width, image.height, std::move(image.rgba), Pace(never_stops, "read"));
}

/// For nobody but the user, who alone may look into the folder and those that it needed.
Result<void> make_private_folder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return {};
  if (auto made = make_private_folder(folder.parent_path()); !made) return made;
  const bool is_new = fs::create_directory(folder, error);
  if (is_new) fs::permissions(folder, fs::perms::owner_all, error);
  if (!error) return {};
  return Error{ErrorKind::disk,
               "cannot make the folder '" + folder.string() + "' for pictures: " + error.message()};
}

}  // namespace

PicturePlaces picture_places(const fs::path& home, bool is_named) {
  PicturePlaces places{home / "thumbnails" / "large", home / "sessions"};
  if (is_named) return places;
  // Called before any thread is started, and nothing changes the environment.
  const char* cache = std::getenv("XDG_CACHE_HOME");  // NOLINT(concurrency-mt-unsafe)
  const char* user = std::getenv("HOME");             // NOLINT(concurrency-mt-unsafe)
  const auto has = [](const char* folder) { return folder != nullptr && *folder != '\0'; };
  if (has(cache)) {
    places.saved = fs::path(cache) / "thumbnails" / "large";
  } else if (has(user)) {
    places.saved = fs::path(user) / ".cache" / "thumbnails" / "large";
  }
  return places;
}

std::string uri_of(const fs::path& file) {
  constexpr std::string_view kPlain = "!$&'()*+,-./:=@_~";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::error_code error;
  const fs::path whole = fs::absolute(file, error).lexically_normal();
  std::string uri = "file://";
  for (const char c : whole.string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || kPlain.find(c) != std::string_view::npos;
    if (is_plain) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri.append({'%', kHex[byte >> 4U], kHex[byte & 0xFU]});
  }
  return uri;
}

fs::path picture_file(const fs::path& folder, const fs::path& file) {
  return folder / (md5_of(uri_of(file)) + ".png");
}

std::optional<FileStamp> stamp_of(const fs::path& file) {
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  if (error) return std::nullopt;
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error) return std::nullopt;
  const auto seconds = std::chrono::floor<std::chrono::seconds>(clock_of(changed));
  return FileStamp{seconds.time_since_epoch().count(), bytes};
}

Result<void> write_picture(const fs::path& folder, const fs::path& file, const FileStamp& stamp,
                           const Image& image, std::optional<std::size_t> steps) {
  assert(!folder.empty());
  std::vector<io::PngText> texts{{kUriKey, uri_of(file)},
                                 {kTimeKey, std::to_string(stamp.seconds)},
                                 {kSizeKey, std::to_string(stamp.bytes)},
                                 {"Software", "Argil"}};
  if (steps) texts.push_back({kStepsKey, std::to_string(*steps)});
  const fs::path picture = picture_file(folder, file);
  const auto bytes = io::pack_png(picture.string(), image, texts);
  if (!bytes) return bytes.error();
  if (auto made = make_private_folder(folder); !made) return made;
  return io::replace_file(picture, [&](const fs::path& temporary) -> Result<void> {
    std::ofstream out(temporary, std::ios::binary);
    std::error_code error;
    fs::permissions(temporary, fs::perms::owner_read | fs::perms::owner_write, error);
    out.write(reinterpret_cast<const char*>(bytes.value().data()),
              static_cast<std::streamsize>(bytes.value().size()));
    out.close();
    if (!error && out) return {};
    return Error{ErrorKind::disk, "cannot write '" + picture.string() + "'; make room on the disk"};
  });
}

FileLook look_at_file(const PicturePlaces& places, const fs::path& file) {
  FileLook look;
  look.file = file;
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  const auto stamp = stamp_of(file);
  if (error || !stamp) return look;
  look.is_there = true;
  look.changed = clock_of(changed);
  look.bytes = stamp->bytes;
  if (auto saved = picture_of(places.saved, file, *stamp)) {
    look.picture = shared_pixels(std::move(saved->image));
  }
  auto work = picture_of(places.work, file, *stamp);
  const auto steps = work ? number_under<std::size_t>(work->texts, kStepsKey) : std::nullopt;
  if (steps) look.work = WorkPicture{shared_pixels(std::move(work->image)), *steps};
  return look;
}

bool has_picture(const fs::path& folder, const fs::path& file) {
  const auto stamp = stamp_of(file);
  return stamp && picture_of(folder, file, *stamp).has_value();
}

}  // namespace argil::viewer
