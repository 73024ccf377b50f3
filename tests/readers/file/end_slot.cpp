// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/end_slot.h"

#include <csignal>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/engine/clay.h"
#include "argil/io/safe_file.h"
#include "argil/io/session.h"

#include "support/scratch.h"

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
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGINT;
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

Stroke slot_stroke() {
  Stroke stroke;
  stroke.samples = {{0.0, {8.0, 0.0, 0.0}, {}, 1.0}};
  return stroke;
}

void record_slot_stroke(Session& session) {
  ASSERT_TRUE(session.clay().apply(slot_stroke()).ok());
  session.record(slot_stroke());
  ASSERT_TRUE(session.flush().ok());
}

/// As `argil sculpt`: what a forced end leaves of a session in this folder.
void sculpt_until_forced(const fs::path& project, bool is_all_or_nothing) {
  ASSERT_TRUE(is_forced_after([&] {
    SessionOptions options;
    options.is_all_or_nothing = is_all_or_nothing;
    static auto session =
        fs::exists(project)
            ? Session::open(project, options)
            : Session::create(project, Clay::ball(8.0, {0.5, 0.1}).value(), options);
    ASSERT_TRUE(session) << session.error().message;
    record_slot_stroke(session.value());
  }));
}

TEST(ForcedSession, ThatIsAllOrNothingLeavesNothing) {
  const ScratchFolder folder;
  sculpt_until_forced(folder / "p.vdb", true);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ForcedSession, ThatIsAllOrNothingLeavesTheStrokesThatWereThere) {
  const ScratchFolder folder;
  sculpt_until_forced(folder / "p.vdb", false);
  EXPECT_THAT(folder.names(), UnorderedElementsAre("p.journal.jsonl", "p.vdb"));
  const std::string before = slot_file_text(folder / "p.journal.jsonl");
  EXPECT_EQ(left_steps(folder / "p.vdb").value()->steps, 1U);
  sculpt_until_forced(folder / "p.vdb", true);
  EXPECT_THAT(folder.names(), UnorderedElementsAre("p.journal.jsonl", "p.vdb"));
  EXPECT_EQ(slot_file_text(folder / "p.journal.jsonl"), before);
}

}  // namespace
}  // namespace argil::io
