// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "picture/reference_image.h"

namespace argil::viewer {

// Reference images are kept beside their project, in NAME.references.txt: one a line, so that the
// project itself, which other programs read, stays clay alone.

/// Where those of a project are kept.
std::filesystem::path references_file(const std::filesystem::path& project);

struct ReferenceList {
  std::vector<ReferenceImage> images;
  std::vector<std::string> unread;  ///< lines that name no image, without their ends
  std::vector<Error> problems;      ///< of lines that could not be read
};

/// Those of a project, without their pixels; none where it has no such file. A list that cannot be
/// read is a problem.
ReferenceList read_references(const std::filesystem::path& project);

/// Replaces the file whole; removes it where there is nothing to keep. Files in the project's
/// folder are named by their place in it, so that the folder can be moved. `unread` are further
/// lines, of ReferenceList::unread: they may be of a newer version, or mistyped, and follow the
/// images. Errors  disk, also where there is a file that cannot be read, which stays.
Result<void> write_references(const std::filesystem::path& project,
                              const std::vector<ReferenceImage>& images,
                              const std::vector<std::string>& unread = {});

/// The most pixels of a reference image: 358 MB with the smaller ones, here and on the graphics
/// card.
inline constexpr std::int64_t kMostReferencePixels = 64 * 1024 * 1024;

/// The pixels of a file, with its smaller ones.
/// Errors  as io::read_image; bad_input: more pixels than kMostReferencePixels, or a file's name of
///         more than a line.
Result<std::shared_ptr<const ReferencePixels>> read_pixels(const std::filesystem::path& file,
                                                           const Progress& progress = {});

}  // namespace argil::viewer
