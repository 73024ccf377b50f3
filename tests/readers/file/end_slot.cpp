// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/end_slot.h"

#include <csignal>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/io/safe_file.h"
#include "argil/io/session.h"

#include "support/built.h"
#include "support/scratch.h"
#include "support/spawn.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

void fill_slot_file(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string slot_file_text(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Waits for its end; whether a second interrupt ended it.
bool was_forced(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGINT;
}

/// Ends a child by two signals after `work`; whether they ended it.
bool is_forced_after(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    install_interrupt_cleanup();
    work();
    ::raise(SIGINT);
    ::raise(SIGINT);
    ::_exit(90);
  }
  return was_forced(child);
}

TEST(EndSlot, TakesBackWhatIsHeldAndNothingElse) {
  const ScratchFolder folder;
  for (const char* const name : {"removed", "cut", "kept"})
    fill_slot_file(folder / name, "0123456789");
  EXPECT_TRUE(is_forced_after([&] {
    static EndSlot removed(folder / "removed");
    static EndSlot cut(folder / "cut", 4, folder / "kept");
    static EndSlot missing(folder / "missing");
    const EndSlot over(folder / "kept");
  }));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("cut", "kept"));
  EXPECT_EQ(slot_file_text(folder / "cut"), "0123");
}

TEST(EndSlot, LeavesWhatBelongsToAReplacedWitness) {
  const ScratchFolder folder;
  for (const char* const name : {"journal", "project"}) fill_slot_file(folder / name, "old");
  EXPECT_TRUE(is_forced_after([&] {
    static EndSlot journal(folder / "journal", 0, folder / "project");
    static EndSlot project(folder / "project", 0, folder / "project");
    static_cast<void>(replace_text(folder / "project", "new").ok());
  }));
  EXPECT_EQ(slot_file_text(folder / "journal"), "old");
  EXPECT_EQ(slot_file_text(folder / "project"), "new");
}

TEST(EndSlot, HasRoomForSoManyAndGoesWithoutMore) {
  const ScratchFolder folder;
  std::vector<EndSlot> slots;
  for (std::size_t n = 0; n < EndSlot::kEndSlots + 3; ++n) slots.emplace_back(folder / "file");
  slots.clear();
  fill_slot_file(folder / "file", "old");
  EXPECT_TRUE(is_forced_after([&] { static EndSlot file(folder / "file"); }));
  EXPECT_THAT(folder.names(), IsEmpty());
}

/// As `argil sculpt`: what a forced end leaves of a session in this folder.
void sculpt_until_forced(const fs::path& project, const char* way) {
  int pipe[2] = {-1, -1};
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = test::spawn(test::session_child_program(),
                                  {project.string(), "1", std::to_string(pipe[1]), way});
  ::close(pipe[1]);
  std::uint32_t recorded = 0;
  EXPECT_EQ(::read(pipe[0], &recorded, sizeof recorded), sizeof recorded);
  ::close(pipe[0]);
  EXPECT_TRUE(was_forced(child));
}

TEST(ForcedSession, ThatIsAllOrNothingLeavesNothing) {
  const ScratchFolder folder;
  sculpt_until_forced(folder / "p.vdb", "forced-all-or-nothing");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ForcedSession, ThatIsAllOrNothingLeavesTheStrokesThatWereThere) {
  const ScratchFolder folder;
  sculpt_until_forced(folder / "p.vdb", "forced");
  EXPECT_THAT(folder.names(), UnorderedElementsAre("p.journal.jsonl", "p.vdb"));
  const std::string before = slot_file_text(folder / "p.journal.jsonl");
  EXPECT_EQ(left_steps(folder / "p.vdb").value()->steps, 1U);
  sculpt_until_forced(folder / "p.vdb", "forced-all-or-nothing");
  EXPECT_THAT(folder.names(), UnorderedElementsAre("p.journal.jsonl", "p.vdb"));
  EXPECT_EQ(slot_file_text(folder / "p.journal.jsonl"), before);
}

}  // namespace
}  // namespace argil::io
