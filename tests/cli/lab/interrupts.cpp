// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab, interrupted where it is at work on files.
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/run_argil.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

/// A recording that comes when the program has begun to read it.
class PipedRecording {
 public:
  explicit PipedRecording(const std::filesystem::path& file) : file_(file) {
    if (::mkfifo(file.c_str(), 0600) != 0) throw std::runtime_error("no pipe");
  }
  ~PipedRecording() { close(); }
  PipedRecording(const PipedRecording&) = delete;
  PipedRecording& operator=(const PipedRecording&) = delete;

  bool is_being_read() {
    if (handle_ < 0) handle_ = ::open(file_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    return handle_ >= 0;
  }
  /// All of it has been taken when this returns, but for what a pipe holds.
  void write(const std::string& content) {
    ::fcntl(handle_, F_SETFL, 0);  // waits from here on
    const auto usual = ::signal(SIGPIPE, SIG_IGN);
    for (std::size_t at = 0; at < content.size();) {
      const ssize_t count = ::write(handle_, content.data() + at, content.size() - at);
      if (count < 0) throw std::runtime_error("the program reads no more");
      at += static_cast<std::size_t>(count);
    }
    ::signal(SIGPIPE, usual);
    close();
  }

 private:
  void close() {
    if (handle_ >= 0) ::close(handle_);
    handle_ = -1;
  }

  std::filesystem::path file_;
  int handle_ = -1;
};

TEST(LabInterrupt, EndsTheReadingOfARecording) {
  const ScratchFolder scratch;
  const auto file = scratch / "run.csv";
  PipedRecording endless(file);
  RunOptions options;
  options.signal = SIGTERM;
  options.interrupt_when = [&] { return endless.is_being_read(); };
  const Ended run = run_argil({"lab", "clay", "--device", "replay:" + file.string()}, options);
  EXPECT_EQ(run.status, 143);
  EXPECT_THAT(run.err, testing::HasSubstr("interrupted"));
}

/// While the clay is made, the interrupt comes: what is heard is the first look of the replay.
TEST(LabInterrupt, EndsAReplay) {
  const ScratchFolder scratch;
  const auto whole = scratch / "whole.csv";
  // Too short to judge, and kept.
  ASSERT_EQ(run_argil({"lab", "clay", "--seconds", "2", "-o", whole}).status, 1);
  const auto file = scratch / "run.csv";
  PipedRecording piped(file);
  RunOptions options;
  options.interrupt_when = [&] {
    if (!piped.is_being_read()) return false;
    piped.write(content_of(whole));
    return true;
  };
  const Ended run = run_argil({"lab", "clay", "--device", "replay:" + file.string()}, options);
  EXPECT_EQ(run.status, 130);
}

TEST(LabInterrupt, LeavesNothingOfARecordingThatWasBeingWritten) {
  const ScratchFolder scratch;
  RunOptions options;
  options.interrupt_when = [&] { return !scratch.names().empty(); };
  const Ended run =
      run_argil({"lab", "spring", "--seconds", "60", "-o", scratch / "run.csv"}, options);
  EXPECT_EQ(run.status, 130);
  EXPECT_THAT(scratch.names(), testing::IsEmpty());
}

TEST(LabInterrupt, EndsARunInRealTime) {
  const ScratchFolder scratch;
  RunOptions options;
  options.signal = SIGTERM;
  options.interrupt_when = [&] { return !scratch.names().empty(); };
  const Ended run = run_argil(
      {"lab", "spring", "--real-time", "--seconds", "600", "-o", scratch / "run.csv"}, options);
  EXPECT_EQ(run.status, 143);
  EXPECT_THAT(scratch.names(), testing::IsEmpty());
}

}  // namespace
}  // namespace argil::test
