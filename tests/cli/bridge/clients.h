// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/haptics/bridge/bridge_key.h"
#include "argil/haptics/bridge/bridge_udp.h"

namespace argil::test {

using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A program that runs beside the test; killed with it. What it says goes to a file.
class Beside {
 public:
  Beside(Words words, const std::filesystem::path& said) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    const int out = ::open(said.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Beside() { kill(); }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  /// As by a crash: it can say nothing more.
  void kill() {
    if (child_ > 0) ::kill(child_, SIGKILL);
    wait();
  }
  int wait() {
    int state = -1;
    if (child_ > 0) ::waitpid(child_, &state, 0);
    child_ = -1;
    return state;
  }

 private:
  pid_t child_ = -1;
};

/// A port that nobody listens on.
inline std::string free_port() {
  const auto link = haptics::BridgeUdp::open(0);
  EXPECT_TRUE(link.ok());
  return link ? std::to_string(link.value()->port()) : "0";
}

/// The key of the bridge at that port; nothing until it has made one.
inline std::optional<haptics::BridgeKey> key_of_bridge(const std::string& port) {
  std::ifstream stream(haptics::usual_key_file(static_cast<std::uint16_t>(std::stoi(port))));
  std::string text;
  std::getline(stream, text);
  return haptics::BridgeKey::from_text(text);
}

/// The log of a run as far as it has come: until that has ended, a temporary file beside it.
inline std::filesystem::path growing(const std::filesystem::path& log) {
  std::error_code missing;
  const std::string front = "." + log.stem().string() + ".";
  for (const auto& entry : std::filesystem::directory_iterator(log.parent_path(), missing)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(front) && name.ends_with(log.extension().string())) return entry.path();
  }
  return log;
}

inline Words stand_in(const std::string& port, Words more = {}) {
  Words words{"python3", "examples/blender/stand_in.py", "--port", port};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A Blender that is coupled `times` times, one after the other.
inline Words blender(const std::string& port, const Words& more = {}, int times = 1) {
  Words words{"blender", "-b", "--factory-startup", "--python-exit-code", "3"};
  for (int n = 0; n < times; ++n) {
    for (const char* script : {"init.py", "BoucleCouplage.py", "exit.py"}) {
      words.insert(words.end(), {"--python", std::string("examples/blender/") + script});
    }
  }
  words.insert(words.end(), {"--", "--port", port});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A log by its columns.
using Log = std::map<std::string, std::vector<double>>;
inline Log read_log(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  Words names;
  std::istringstream head(line);
  for (std::string name; std::getline(head, name, ',');) names.push_back(name);
  Log log;
  while (std::getline(stream, line)) {
    std::istringstream row(line);
    std::string word;
    for (const std::string& name : names) {
      std::getline(row, word, ',');
      log[name].push_back(std::strtod(word.c_str(), nullptr));
    }
  }
  return log;
}

}  // namespace argil::test
