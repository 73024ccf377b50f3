// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "argil/core/result.h"
#include "argil/engine/render.h"

#include "picture/reference_image.h"

namespace argil::viewer {

// Small pictures of projects. That of what was saved lies where the desktop keeps those of all
// files, so that file managers show it, too: by the Thumbnail Managing Standard of freedesktop.org
// (0.9), as HOME/.cache/thumbnails/large/MD5.png of the file's URI. That of work which is not saved
// is for Argil alone. Neither lies beside the project.

/// The sides of these pictures in pixels; the standard allows 256 at most.
inline constexpr int kThumbnailWidth = 256;
inline constexpr int kThumbnailHeight = 192;

/// Folders that pictures are kept in; "" none are kept.
struct PicturePlaces {
  std::filesystem::path saved;
  std::filesystem::path work;
};

/// The folder of the desktop ($XDG_CACHE_HOME/thumbnails, else ~/.cache/thumbnails), and
/// HOME/sessions. Of a home that the user named, HOME/thumbnails instead: nothing is left outside
/// of it.
PicturePlaces picture_places(const std::filesystem::path& home, bool is_named);

/// A file's URI, with its path as it is named and not as links lead: "file:///a%20b.vdb". What is
/// no letter of ASCII is escaped as GLib does, by which file managers go.
std::string uri_of(const std::filesystem::path& file);

/// Where the picture of a file lies in one of these folders.
std::filesystem::path picture_file(const std::filesystem::path& folder,
                                   const std::filesystem::path& file);

/// What a file was when its picture was made: any of it is another when it was written since.
struct FileStamp {
  std::int64_t seconds = 0;  ///< of its last change, since 1970
  std::uintmax_t bytes = 0;
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
/// Nothing where there is no such file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

/// Keeps the picture of a project as it was saved, or, with `steps`, with so many steps that are
/// not. Makes the folder. Others of the machine may not look into either (as the standard asks).
/// Errors  as io::replace_file, io::pack_png; disk for the folder.
Result<void> write_picture(const std::filesystem::path& folder, const std::filesystem::path& file,
                           const FileStamp& stamp, const Image& image,
                           std::optional<std::size_t> steps = std::nullopt);

/// A picture of work that was not saved.
struct WorkPicture {
  std::shared_ptr<const ReferencePixels> pixels;
  std::size_t steps = 0;  ///< that the project has not, of those that it shows
};

/// A project in a list.
struct FileLook {
  std::filesystem::path file;
  bool is_there = false;
  std::chrono::system_clock::time_point changed;
  std::uintmax_t bytes = 0;
  /// As it was saved. Null where there is none, none of this state of the file, or one that cannot
  /// be read: too large, broken, or of another file.
  std::shared_ptr<const ReferencePixels> picture;
  std::optional<WorkPicture> work;  ///< likewise
};

/// Reads what is known of a file. Cost  a few ms, for two pictures; whatever its disk takes.
FileLook look_at_file(const PicturePlaces& places, const std::filesystem::path& file);

/// Whether a picture of the file as it is now is kept in the folder.
bool has_picture(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace argil::viewer
