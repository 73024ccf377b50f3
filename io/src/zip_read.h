// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
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
/// Errors  bad_input when it is not a ZIP, is cut off, or points outside itself.
/// Source  PKWARE, APPNOTE.TXT 6.3.
Result<std::vector<ZipEntry>> zip_directory(std::span<const std::byte> archive,
                                            const std::string& name);

/// The content of an entry, checked against its size and CRC.
/// Errors  bad_input when damaged, encrypted or packed by another method.
/// Cost    memory grows as data comes out: at most about 1032 times the packed bytes, whatever the
///         directory says.
Result<std::vector<std::byte>> zip_extract(std::span<const std::byte> archive,
                                           const ZipEntry& entry, const std::string& name);

}  // namespace argil::io
