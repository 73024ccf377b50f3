// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run_argil.h"

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/built.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

/// In the child, which must not allocate (spawn.h): no stdin, both outputs to files, limits as
/// asked, then the program.
[[noreturn]] void become_argil(const std::filesystem::path& out, const std::filesystem::path& err,
                               const std::vector<char*>& argv, const RunOptions& options) {
  const int out_handle = ::open(out.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  const int err_handle = ::open(err.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  const int in_handle = ::open("/dev/null", O_RDONLY);
  ::dup2(in_handle, STDIN_FILENO);
  ::dup2(out_handle, STDOUT_FILENO);
  ::dup2(err_handle, STDERR_FILENO);
  if (options.largest_file_bytes > 0) {
    const auto bytes = static_cast<rlim_t>(options.largest_file_bytes);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);  // write() then fails with EFBIG instead
  }
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

nlohmann::json Ended::json() const {
  const nlohmann::json parsed = nlohmann::json::parse(out, nullptr, false);
  EXPECT_TRUE(parsed.is_object()) << "stdout is not one JSON object: " << out << "\n" << err;
  return parsed;
}

Ended run_argil(const std::vector<std::string>& arguments, const RunOptions& options) {
  const ScratchFolder folder;
  const std::filesystem::path out = folder / "out";
  const std::filesystem::path err = folder / "err";
  std::vector<std::string> words{argil_program()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) become_argil(out, err, argv, options);
  if (options.interrupt_after_ms >= 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(options.interrupt_after_ms));
    ::kill(child, SIGINT);
  }
  if (options.interrupt_when) {
    for (int n = 0; n < 60'000 && !options.interrupt_when(); ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(child, options.signal);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  Ended run;
  if (WIFEXITED(state)) run.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) run.signal = WTERMSIG(state);
  run.out = content_of(out);
  run.err = content_of(err);
  return run;
}

}  // namespace argil::test
