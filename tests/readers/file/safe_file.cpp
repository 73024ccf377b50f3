// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/safe_file.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file/file_bytes.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;

Result<void> write_text(const fs::path& file, const std::string& text) {
  OutputFile out(file);
  out.write(text);
  return out.close();
}

/// Runs `work` in a child process, which leaves with what it returns; its raw wait status.
template <class Work>
int in_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Saves 16 MB over `file`; 0 when that fails as a disk error should, else what was wrong.
int save_too_much(const fs::path& file) {
  const Result<void> saved = replace_file(file, [](const fs::path& temporary) {
    OutputFile out(temporary);
    const std::string block(1 << 20, 'x');
    for (int i = 0; i < 16; ++i) out.write(block);
    return out.close();
  });
  if (saved.ok()) return 1;
  if (saved.error().kind != ErrorKind::disk) return 2;
  return saved.error().message.find("free some space") == std::string::npos ? 3 : 0;
}

TEST(ReplaceFile, PutsTheNewContentInPlaceAndLeavesNothingElse) {
  const ScratchFolder folder;
  fill(folder / "piece.txt", "old");
  ASSERT_TRUE(replace_file(folder / "piece.txt", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), fs::canonical(folder.path()));
    EXPECT_EQ(temporary.extension(), ".txt");
    EXPECT_EQ(content_of(folder / "piece.txt"), "old");
    return write_text(temporary, "new");
  }));
  EXPECT_EQ(content_of(folder / "piece.txt"), "new");
  EXPECT_THAT(folder.names(), ElementsAre("piece.txt"));
}

TEST(ReplaceFile, KeepsTheOldFileWhenWritingFails) {
  const ScratchFolder folder;
  fill(folder / "piece.txt", "old");
  const Result<void> result =
      replace_file(folder / "piece.txt", [&](const fs::path& temporary) -> Result<void> {
        EXPECT_TRUE(write_text(temporary, "half of the n"));
        return Error{ErrorKind::bad_input, "no"};
      });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "no");
  EXPECT_EQ(content_of(folder / "piece.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("piece.txt"));
}

TEST(ReplaceFile, TurnsAnExceptionOfTheWriterIntoAnError) {
  const ScratchFolder folder;
  const Result<void> result = replace_file(
      folder / "piece.txt", [](const fs::path&) -> Result<void> { throw std::bad_alloc(); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::memory);
  EXPECT_THAT(folder.names(), ElementsAre());
}

TEST(ReplaceFile, KeepsModeAndFollowsLinks) {
  const ScratchFolder folder;
  fill(folder / "piece.txt", "old");
  fs::permissions(folder / "piece.txt", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("piece.txt", folder / "link.txt");
  ASSERT_TRUE(replace_file(folder / "link.txt",
                           [](const fs::path& temporary) { return write_text(temporary, "new"); }));
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(content_of(folder / "piece.txt"), "new");
  EXPECT_EQ(fs::status(folder / "piece.txt").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ReplaceFile, NamesTheReasonForAFolderThatIsMissing) {
  const ScratchFolder folder;
  const Result<void> result = replace_file(
      folder / "no/piece.txt", [](const fs::path& path) { return write_text(path, "new"); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::disk);
  EXPECT_THAT(result.error().message, HasSubstr("No such file or directory"));
  EXPECT_THAT(result.error().message, HasSubstr("no/piece.txt"));
}

TEST(ReplaceFile, RefusesWhatIsNotARegularFile) {
  const auto never = [](const fs::path&) -> Result<void> {
    ADD_FAILURE() << "must not be called";
    return {};
  };
  EXPECT_EQ(replace_file("/dev/null", never).error().kind, ErrorKind::disk);
  EXPECT_EQ(replace_file(ScratchFolder().path(), never).error().kind, ErrorKind::disk);
}

TEST(ReplaceFile, LeavesTheOldFileWholeAtTheSizeLimit) {
  const ScratchFolder folder;
  fill(folder / "piece.txt", "old");
  const int status = in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);  // then a write beyond the limit fails with EFBIG
    const rlimit limit{1 << 20, 1 << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    return save_too_much(folder / "piece.txt");
  });
  EXPECT_EQ(status, 0) << "exit code " << WEXITSTATUS(status);
  EXPECT_EQ(content_of(folder / "piece.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("piece.txt"));
}

TEST(ReplaceFile, LeavesTheOldFileWholeOnAFullDisk) {
  const ScratchFolder folder;
  if (::mount("argil", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) {
    GTEST_SKIP() << "mounting a small tmpfs needs root; LeavesTheOldFileWholeAtTheSizeLimit ran";
  }
  fill(folder / "piece.txt", "old");
  EXPECT_EQ(save_too_much(folder / "piece.txt"), 0);
  EXPECT_EQ(content_of(folder / "piece.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("piece.txt"));
  ::umount(folder.path().c_str());
}

// A child that saves slowly: says through the pipe that its temporary file exists, then writes
// until it is stopped.
class InterruptedSave : public testing::Test {
 protected:
  void SetUp() override {
    fill(file(), "old");
    ASSERT_EQ(::pipe(pipe_), 0);
  }

  fs::path file() const { return folder_ / "piece.txt"; }

  pid_t start(bool heeds_first_signal, double ends_within_s = 0.0) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(save_slowly(heeds_first_signal, ends_within_s));
    char ready = 0;
    EXPECT_EQ(::read(pipe_[0], &ready, 1), 1);
    EXPECT_EQ(folder_.names().size(), 2U);
    return child;
  }

  int save_slowly(bool heeds_first_signal, double ends_within_s) {
    install_interrupt_cleanup();
    if (ends_within_s > 0.0) end_within(ends_within_s, pipe_[1], "enough");
    const Result<void> saved = replace_file(file(), [&](const fs::path& temporary) {
      OutputFile out(temporary);
      out.write("half");
      if (::write(pipe_[1], "r", 1) != 1) ::_exit(90);
      while (!heeds_first_signal || !interrupted()) ::usleep(1000);
      return out.close();
    });
    return !saved && saved.error().kind == ErrorKind::interrupted ? 7 : 8;
  }

  int wait_for(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(content_of(file()), "old");
    EXPECT_THAT(folder_.names(), ElementsAre("piece.txt"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ScratchFolder folder_;
  int pipe_[2] = {-1, -1};
};

TEST_F(InterruptedSave, StopsAtTheFirstSignalAndKeepsTheOldFile) {
  const pid_t child = start(true);
  ::kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 7);
}

TEST_F(InterruptedSave, RemovesTheTemporaryFileAtTheSecondSignal) {
  const pid_t child = start(false);
  ::kill(child, SIGINT);
  ::usleep(50'000);  // two signals sent at once may be delivered as one
  ::kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 128 + SIGTERM);
}

/// Work that asks nobody, as in a library, ends all the same, with its last words and nothing left.
TEST_F(InterruptedSave, EndsByItselfSomeTimeAfterTheFirstSignal) {
  const pid_t child = start(false, 0.2);
  const auto begin = std::chrono::steady_clock::now();
  ::kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 128 + SIGTERM);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(waited.count(), 0.2);
  std::array<char, 7> words{};
  EXPECT_EQ(::read(pipe_[0], words.data(), words.size()), 6);
  EXPECT_STREQ(words.data(), "enough");
}

TEST_F(InterruptedSave, HasItsTimeWhereItHeedsTheSignal) {
  const pid_t child = start(true, 60.0);
  ::kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 7);
}

TEST_F(InterruptedSave, ATerminalThatHangsUpTwiceAndAClosedPipeLetItEndInOrder) {
  for (const int signal : {SIGHUP, SIGPIPE}) {
    const pid_t child = start(false);
    for (int n = 0; n < 3; ++n) {
      ::kill(child, signal);
      ::usleep(50'000);
      EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << signal;
    }
    ::kill(child, SIGTERM);
    ::usleep(50'000);
    EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << signal;
    ::kill(child, SIGTERM);
    EXPECT_EQ(wait_for(child), 128 + SIGTERM) << signal;
  }
}

TEST_F(InterruptedSave, AClosedPipeIsAnInterruption) {
  const pid_t child = start(true);
  ::kill(child, SIGPIPE);
  EXPECT_EQ(wait_for(child), 7);
}

}  // namespace
}  // namespace argil::io
