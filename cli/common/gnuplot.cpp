// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot in a scratch folder, where the one file that a script writes is its picture.
#include "common/gnuplot.h"

#include <cassert>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "argil/io/safe_file.h"

#include "common/child_program.h"
#include "common/scratch_folder.h"

namespace argil::cli {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The one file in the folder, as long as it has its end.
Result<Picture> picture_in(const fs::path& folder, const std::string& script) {
  std::error_code error;
  const fs::directory_iterator first(folder, error);
  if (error || first == fs::directory_iterator()) {
    return Error{ErrorKind::internal, "gnuplot made no picture of '" + script + "'"};
  }
  Picture picture{first->path().filename().string(), bytes_of(first->path())};
  const std::string_view svg(picture.svg);
  // gnuplot does not say when the disk was full.
  if (svg.substr(0, svg.find_last_not_of(" \n") + 1).ends_with("</svg>")) return picture;
  return Error{ErrorKind::disk,
               "the picture '" + picture.name + "' was cut off; is the disk of TMPDIR full?"};
}

/// Makes in the scratch folder: an empty one to draw in, and a link to where the script lies.
std::error_code prepare_to_draw(const ScratchFolder& scratch, const fs::path& script) {
  std::error_code error;
  const fs::path data = fs::absolute(script, error).parent_path();
  if (!error) fs::create_directory(scratch / "drawn", error);
  if (!error) fs::create_directory_symlink(data, scratch / "data", error);
  return error;
}

}  // namespace

bool has_gnuplot() { return has_program("gnuplot"); }

Result<void> draw_plot(const fs::path& picture, const std::string& script,
                       const std::string& data) {
  if (!has_gnuplot()) {
    return Error{ErrorKind::bad_input,
                 "--plot needs gnuplot; install the package gnuplot-nox, or leave it out"};
  }
  const auto scratch = ScratchFolder::make();
  if (!scratch) return scratch.error();
  if (!data.empty()) {
    if (auto written = io::replace_text(scratch.value() / "run.dat", data); !written) {
      return written;
    }
  }
  const fs::path file = scratch.value() / "run.gp";
  if (auto written = io::replace_text(file, script); !written) return written;
  const auto drawn = drawn_by_gnuplot(file);
  if (!drawn) return drawn.error();
  return io::replace_text(picture, drawn.value().svg);
}

Result<Picture> drawn_by_gnuplot(const fs::path& script) {
  assert(script.has_filename());
  const auto scratch = ScratchFolder::make();
  if (!scratch) return scratch.error();
  const std::string name = script.filename().string();
  const std::error_code error = prepare_to_draw(scratch.value(), script);
  const fs::path said = scratch.value() / "said";
  const int handle = ::open(said.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (error || handle < 0) {
    const int failed_with = error ? error.value() : errno;
    if (handle >= 0) ::close(handle);
    return Error{ErrorKind::disk, "cannot draw '" + name + "' (" +
                                      std::generic_category().message(failed_with) +
                                      "); is the disk of TMPDIR full?"};
  }
  // Where a script's data is looked for; by its own path it would be two folders if that had a
  // colon.
  // It has nothing to save: its folder goes with the scratch folder.
  const int status =
      ChildProgram(scratch.value() / "drawn",
                   {"gnuplot", "-e", "set loadpath '../data'", "../data/" + name}, {handle, handle})
          .wait();
  ::close(handle);
  // Then gnuplot was killed: that it failed means nothing.
  if (io::interrupted()) return Error{ErrorKind::interrupted, "interrupted; no picture was drawn"};
  if (status == 0) return picture_in(scratch.value() / "drawn", name);
  return Error{ErrorKind::internal, "gnuplot failed on '" + name + "' (" + bytes_of(said) + ")"};
}

}  // namespace argil::cli
