// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"

namespace argil::io {

/// One file in a ZIP archive, from the archive's directory.
struct ZipEntry {
  std::string name;
  unsigned method = 0;  ///< 0 stored, 8 deflated
  unsigned flags = 0;
  std::uint32_t crc = 0;
  std::uint64_t packed_bytes = 0;
  std::uint64_t bytes = 0;
  std::uint64_t header_at = 0;
};

/// The directory of an archive, ZIP64 included, multi-volume not.
/// Errors  bad_input when it is not a ZIP, is cut off, or points outside itself; where an entry
///         lies within another, so that together they could unpack to more than they hold.
/// Source  PKWARE, APPNOTE.TXT 6.3.
Result<std::vector<ZipEntry>> zip_directory(std::span<const std::byte> archive,
                                            const std::string& name);

/// The content of an entry, unpacked piece by piece, so that memory does not follow its size: a
/// megabyte may unpack to a gigabyte. While a piece is read another thread unpacks the next.
class ZipContent {
 public:
  static constexpr std::size_t kPieceBytes = 256 * 1024;

  /// `archive` and `entry` must outlive it.
  /// Errors  bad_input when the entry has no header, is cut off, encrypted, packed by another
  ///         method, or says that it is larger than what its bytes can unpack to. It never is:
  ///         `entry.bytes` are the most that it gives.
  static Result<ZipContent> open(std::span<const std::byte> archive, const ZipEntry& entry,
                                 const std::string& name);
  ZipContent(ZipContent&&) noexcept;
  ZipContent& operator=(ZipContent&&) noexcept;
  ~ZipContent();

  /// Appends the next piece to `text`. False at the end, and where it is damaged.
  bool take(std::string& text);

  /// Errors  bad_input when what was taken is damaged; at the end, when size or CRC are not the
  /// entry's.
  Result<void> check() const;

 private:
  struct State;
  explicit ZipContent(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace argil::io
