// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/result.h"

#include "file/file_bytes.h"

struct z_stream_s;  // zlib's, kept out of this header

namespace argil::io {

/// The CRC-32 of a ZIP archive.
std::uint32_t crc_of(std::string_view data) noexcept;

/// Deflates texts, each by itself, for ZipWriter::write_deflated.
///
/// Threads  one; others may deflate theirs beside it.
class Deflater {
 public:
  Deflater();
  ~Deflater();
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Until the next call. The same text gives the same bytes.
  std::string_view packed(std::string_view text);

 private:
  std::unique_ptr<z_stream_s> stream_;
  std::string packed_;
};

/// Writes a ZIP archive of deflated entries, one after the other. Every entry is dated 1 January
/// 1980, so that the same content gives the same bytes. Disk errors stay in the OutputFile.
class ZipWriter {
 public:
  explicit ZipWriter(OutputFile& out);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  void begin(const std::string& name);
  void write(std::string_view data);
  /// Goes on with `bytes` that were deflated elsewhere, with their CRC-32: blocks that refer to
  /// nothing before them, end at a byte, and are not the last.
  void write_deflated(std::string_view packed, std::size_t bytes, std::uint32_t crc);
  /// Of the entry that was begun last, before it is deflated.
  std::uint64_t entry_bytes() const noexcept {
    assert(!entries_.empty());
    return entries_.back().bytes;
  }
  /// Errors  bad_input when the entry is 4 GB or more, which needs an extension not written here.
  Result<void> end();
  /// Writes the directory; the archive is complete.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t at = 0;
    std::uint64_t bytes = 0;
    std::uint64_t packed_bytes = 0;
    std::uint32_t crc = 0;
  };
  void deflate_input(int flush);
  OutputFile& out_;
  std::vector<Entry> entries_;
  std::unique_ptr<z_stream_s> stream_;
  std::vector<unsigned char> packed_;
  bool is_at_byte_ = false;  ///< nothing that was given is not written yet, to a whole byte
};

}  // namespace argil::io
