// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot in a scratch folder, where the one file that a script writes is its picture.
#include "common/gnuplot.h"

#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/io/safe_file.h"

#include "common/scratch_folder.h"

namespace argil::cli {
namespace {

namespace fs = std::filesystem;

/// How often it is looked whether gnuplot has ended, and whether it shall.
constexpr std::chrono::milliseconds kDrawingLook{5};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// In the child, where after a fork of a program with threads only system calls are safe.
[[noreturn]] void become_gnuplot(const char* folder, int said, pid_t parent, char* const* words) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool goes_with_parent =
      ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent;  // or it ended before
  if (goes_with_parent && ::chdir(folder) == 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
      ::dup2(said, STDOUT_FILENO) >= 0 && ::dup2(said, STDERR_FILENO) >= 0) {
    // Returns only where it failed.
    ::execvp(words[0], words);
  }
  ::_exit(127);
}

/// As waitpid gives it; -1 where gnuplot could not be begun.
int status_of_gnuplot(const fs::path& folder, int said, std::vector<std::string> words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) become_gnuplot(folder.c_str(), said, parent, pointers.data());
  int status = -1;
  if (child < 0) return status;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    // It has nothing to save: its folder goes with the scratch folder.
    if (io::interrupted()) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kDrawingLook);
  }
  return status;
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

bool has_gnuplot() {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): read only
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/gnuplot").c_str(), X_OK) == 0) return true;
  }
  return false;
}

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
  const int status =
      status_of_gnuplot(scratch.value() / "drawn", handle,
                        {"gnuplot", "-e", "set loadpath '../data'", "../data/" + name});
  ::close(handle);
  // At a terminal Ctrl-C ends gnuplot as well: that it failed means nothing then.
  if (io::interrupted()) return Error{ErrorKind::interrupted, "interrupted; no picture was drawn"};
  if (status == 0) return picture_in(scratch.value() / "drawn", name);
  return Error{ErrorKind::internal, "gnuplot failed on '" + name + "' (" + bytes_of(said) + ")"};
}

}  // namespace argil::cli
