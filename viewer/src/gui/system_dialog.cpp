// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/system_dialog.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: POSIX gives it no other way

namespace argil::viewer {
namespace {

/// Whether a program of this name is found by PATH.
bool is_program(const std::string& name) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody changes it
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access(folder.append("/").append(name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

/// "*.vdb *.obj", as both programs take them.
std::string patterns(const FileQuestion& question) {
  std::string all;
  for (const std::string& ending : question.endings) {
    if (!all.empty()) all += ' ';
    all += '*';
    all += ending;
  }
  return all;
}

}  // namespace

std::vector<std::string> zenity_words(const FileQuestion& question) {
  std::vector<std::string> words{"zenity",       "--file-selection", "--title",
                                 question.title, "--filename",       question.start.string()};
  if (question.is_new) words.insert(words.end(), {"--save", "--confirm-overwrite"});
  words.insert(words.end(), {"--file-filter", patterns(question)});
  return words;
}

std::vector<std::string> kdialog_words(const FileQuestion& question) {
  return {"kdialog",
          "--title",
          question.title,
          question.is_new ? "--getsavefilename" : "--getopenfilename",
          question.start.string(),
          patterns(question)};
}

bool SystemDialog::is_there() { return is_program("zenity") || is_program("kdialog"); }

SystemDialog::~SystemDialog() { close(); }

void SystemDialog::close() {
  if (process_ > 0) ::kill(process_, SIGTERM);
  end();
}

void SystemDialog::end() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  // It was told to end, or closed its pipe: waiting leaves no zombie and takes no time.
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
  process_ = 0;
}

bool SystemDialog::ask(const FileQuestion& question) {
  close();  // a former question whose answer is not wanted any more
  assert(!is_open());
  std::vector<std::string> words =
      is_program("zenity") ? zenity_words(question) : kdialog_words(question);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // O_CLOEXEC: the dialog inherits its own output alone. posix_spawn, since fork would copy the
  // page tables of a large clay.
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  const int failed =
      ::posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  pipe_ = ends[0];
  said_.clear();
  if (failed != 0) {
    process_ = 0;
    end();
    return false;
  }
  // The window asks once a frame and must not wait.
  ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
  return true;
}

std::optional<std::filesystem::path> SystemDialog::answer() {
  if (!is_open()) return std::nullopt;
  std::array<char, 512> block{};
  ssize_t got = 0;
  while ((got = ::read(pipe_, block.data(), block.size())) > 0) {
    said_.append(block.data(), static_cast<std::size_t>(got));
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  end();  // the pipe is at its end: a file was chosen, or the dialog closed
  while (!said_.empty() && said_.back() == '\n') said_.pop_back();
  return std::filesystem::path(std::exchange(said_, {}));
}

}  // namespace argil::viewer
