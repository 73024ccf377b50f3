// SPDX-License-Identifier: GPL-3.0-or-later
// Runs argil's command lines in children of a process that has its libraries loaded already: a
// start of the program costs forty milliseconds of relocation, a child one.
//
// Reads a JSON object a line from stdin: "argv" (of argil; or of what reads one kind of file,
// below), "out" and "err" (files for what it prints), "data_bytes" and "cpu_s" (its limits),
// "wall_s". Writes a line for each: "status" (-1: ended by a signal), "signal", "cpu_s", "wall_s",
// "peak_bytes".
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/haptics/bridge/bridge_mesh.h"
#include "argil/haptics/bridge/bridge_message.h"
#include "argil/haptics/servo/recording.h"

#include "command_line.h"
#include "file/file_seal.h"
#include "settings/settings.h"

namespace argil::torture {
namespace {

using Json = nlohmann::json;

std::string bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int ended(const Result<void>& result) {
  if (result) return 0;
  std::fprintf(stderr, "argil: %s\n", result.error().message.c_str());
  return 3;
}

/// What no command reads from a file alone.
int run_other(const std::string& kind, const std::string& file) {
  if (kind == "seal") return ended(io::seal_file(file));
  if (kind == "settings") {
    const auto home = std::filesystem::path(file).parent_path();
    viewer::read_settings(home);
    viewer::read_recent(home);
    return 0;
  }
  if (kind == "recording") {
    const auto read = haptics::read_recording(file);
    return read ? 0 : ended(read.error());
  }
  const std::string bytes = bytes_of(file);
  const auto span = std::as_bytes(std::span(bytes));
  if (kind == "datagram") return haptics::decode(span) ? 0 : 1;
  if (kind == "clay-message") return haptics::decode_mesh(span) ? 0 : 1;
  return 2;
}

void redirect(const std::string& file, int to) {
  const int handle = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  ::dup2(handle, to);
  ::close(handle);
}

/// Without what destructors would do: threads of libraries, which they wait for, stayed in the
/// parent.
[[noreturn]] void leave(int status) {
  std::cout.flush();
  std::fflush(nullptr);
  ::_exit(status);
}

[[noreturn]] void work(const Json& task) {
  redirect(task.at("out"), STDOUT_FILENO);
  redirect(task.at("err"), STDERR_FILENO);
  const auto cpu_s = task.at("cpu_s").get<rlim_t>();
  const rlimit cpu{cpu_s, cpu_s};
  ::setrlimit(RLIMIT_CPU, &cpu);
#if !defined(__SANITIZE_ADDRESS__)
  const auto data = task.at("data_bytes").get<rlim_t>();
  const rlimit limit{data, data};
  ::setrlimit(RLIMIT_DATA, &limit);
#endif
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  auto words = task.at("argv").get<std::vector<std::string>>();
  if (words.size() == 3 && words[0] == "other") leave(run_other(words[1], words[2]));
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  leave(cli::run_command_line(static_cast<int>(words.size()), argv.data()));
}

Json run(const Json& task) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    work(task);
  }
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  int state = 0;
  rusage used{};
  while (::wait4(child, &state, WNOHANG, &used) == 0) {
    if (seconds() > task.at("wall_s").get<double>()) ::kill(child, SIGKILL);
    ::usleep(500);
  }
  const auto time_s = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {{"status", WIFEXITED(state) ? WEXITSTATUS(state) : -1},
          {"signal", WIFSIGNALED(state) ? WTERMSIG(state) : 0},
          {"cpu_s", time_s(used.ru_utime) + time_s(used.ru_stime)},
          {"wall_s", seconds()},
          {"peak_bytes", 1024 * used.ru_maxrss}};
}

}  // namespace
}  // namespace argil::torture

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::cout << argil::torture::run(nlohmann::json::parse(line)).dump() << std::endl;
  }
}
