// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "file/unwritten_bytes.h"

namespace argil::io {

/// The whole content of a regular file.
/// Errors  disk naming the file and the system's reason; memory; interrupted between 16 MB and the
///         next, when interrupted() (safe_file.h) or `progress` says so.
Result<UnwrittenBytes> read_file_bytes(const std::filesystem::path& file,
                                       const Progress& progress = {});

/// A disk error of the form "cannot DOING 'FILE': REASON; REMEDY" for the system error `code`.
Error disk_error(std::string_view doing, const std::filesystem::path& file, int code);

/// A file being written. The first failure sticks: later writes do nothing, `close` reports it.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  bool good() const noexcept { return failed_with_ == 0; }
  void write(const void* data, std::size_t size) noexcept;
  void write(std::string_view text) noexcept { write(text.data(), text.size()); }
  /// Position from the start, for headers that are patched later.
  std::uint64_t position() noexcept;
  void seek(std::uint64_t position) noexcept;

  /// Flushes and closes. Errors  disk, with the reason of the first failure.
  Result<void> close();

 private:
  void note(bool success) noexcept;
  std::filesystem::path file_;
  std::FILE* handle_ = nullptr;
  int failed_with_ = 0;  ///< errno of the first failure
};

}  // namespace argil::io
