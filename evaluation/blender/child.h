// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "common/scratch_folder.h"

namespace argil::evaluation {

/// What keeps programs from being run here, each with its package: "Blender: ... is not installed";
/// "" when all are there.
struct NeededProgram {
  const char* program;
  const char* package;
};
std::string blender_obstacle(std::span<const NeededProgram> needed);

/// Writes numbers as the scripts read them, one after the other with the machine's bits.
/// Errors  disk.
template <class T>
Result<void> write_values(const std::filesystem::path& file, const std::vector<T>& values) {
  std::ofstream out(file, std::ios::binary);
  const auto bytes = std::as_bytes(std::span(values));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as a stream has them
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  if (out.flush()) return {};
  return Error{ErrorKind::disk,
               "cannot write '" + file.string() + "'; is the disk of TMPDIR full?"};
}

/// The numbers in a file, as a script wrote them; none where it cannot be read.
template <class T>
std::vector<T> read_values(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::vector<T> values(error ? 0 : size / sizeof(T));
  std::ifstream in(file, std::ios::binary);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as a stream has them
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!in) values.clear();
  return values;
}

/// The text of a file; "" where there is none.
std::string text_in(const std::filesystem::path& file);

/// A file that a child writes to.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();
  int handle() const noexcept { return handle_; }

 private:
  int handle_;
};

/// One start of Blender.
struct BlenderCall {
  const cli::ScratchFolder& scratch;  ///< its home, with all that it writes
  std::string script;                 ///< file in there that it runs
  std::string job;                    ///< file in there that the script gets
  std::string display;                ///< X display of its window; "": it has none (blender -b)
  double patience_s = 0.0;            ///< how long it may take; 0: as long as it does
  std::function<double()> done;       ///< how far it is, from 0 to 1
};

/// Waits for Blender's end, however it ends; what it says goes to the file `said`. It ends with
/// this call.
/// Errors  interrupted; internal where it took longer than it may.
Result<void> run_blender_child(const BlenderCall& call, const Progress& progress);

/// The last line that it said.
std::string last_said(const cli::ScratchFolder& scratch);

}  // namespace argil::evaluation
