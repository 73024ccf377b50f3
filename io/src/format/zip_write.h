// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/result.h"

#include "file/file_bytes.h"

struct z_stream_s;  // zlib's, kept out of this header

namespace argil::io {

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
};

}  // namespace argil::io
