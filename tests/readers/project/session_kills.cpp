// SPDX-License-Identifier: GPL-3.0-or-later
// A sculpting program is killed at every kind of moment, on a disk that fails, and what it left
// must hold every finished stroke. ARGIL_KILL_RUNS says how often in SessionKillsSlow (100).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "support/built.h"
#include "support/scratch.h"
#include "support/session_life.h"
#include "support/spawn.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// What one life is to suffer.
struct Fate {
  unsigned seed = 0;
  const char* way = "steps";  ///< of life: "steps", "hand" or "moves"
  long kill_at = 0;           ///< call; 0: none
  long kill_us = -1;          ///< >= 0: the test kills it after so long
  long percent = 0;           ///< of the disk's time it is full
};

Fate draw_fate(std::mt19937& random, unsigned seed, const char* way) {
  Fate fate;
  fate.seed = seed;
  fate.way = way;
  switch (random() % 4) {
    case 0:
      fate.kill_at = 1 + static_cast<long>(random() % 60);
      break;
    case 1:
      fate.kill_us = static_cast<long>(random() % 400'000);
      break;
    default:
      fate.kill_at = 1 + static_cast<long>(random() % 300);
  }
  if (random() % 2 == 0) fate.percent = 10 + static_cast<long>(random() % 40);
  return fate;
}

struct Death {
  std::uint32_t reported = 0;  ///< steps it was told are on the disk
  bool killed = false;
  int status = -1;
};

std::string setting(const char* name, long value) { return name + ("=" + std::to_string(value)); }

pid_t start_child(const fs::path& project, const Fate& fate, int pipe) {
  return test::spawn(
      test::session_child_program(),
      {project.string(), std::to_string(fate.seed), std::to_string(pipe), fate.way},
      {setting("ARGIL_FAULT_KILL_AT", fate.kill_at), setting("ARGIL_FAULT_PERCENT", fate.percent),
       setting("ARGIL_FAULT_SEED", fate.seed), setting("ARGIL_FAULT_PIPE", pipe),
       std::string("LD_PRELOAD=") + test::faulty_disk_library()});
}

Death live_and_die(const fs::path& project, const Fate& fate) {
  int pipe[2] = {-1, -1};
  EXPECT_EQ(::pipe(pipe), 0);
  const pid_t child = start_child(project, fate, pipe[1]);
  ::close(pipe[1]);
  if (fate.kill_us >= 0) {
    ::usleep(static_cast<useconds_t>(fate.kill_us));
    ::kill(child, SIGKILL);
  }
  Death death;
  std::uint32_t reported = 0;
  while (::read(pipe[0], &reported, sizeof reported) == sizeof reported) death.reported = reported;
  ::close(pipe[0]);
  int state = 0;
  ::waitpid(child, &state, 0);
  death.killed = WIFSIGNALED(state) && WTERMSIG(state) == SIGKILL;
  if (WIFEXITED(state)) death.status = WEXITSTATUS(state);
  EXPECT_TRUE(death.killed || death.status == 0 || death.status == 3 || death.status == 4)
      << "status " << death.status << ", wait state " << state;
  return death;
}

/// The hash after 0, 1, 2, ... steps of a life that starts from `sculpture`.
std::vector<std::uint64_t> hashes_of(Sculpture sculpture, const Fate& fate) {
  std::vector<std::uint64_t> hashes{sculpture.hash()};
  const auto live = [&](const ScriptStep& step) {
    const int depth = sculpture.undo_depth();
    const auto done = apply_step(sculpture, step);
    // A stroke that meets nothing is no undo step, and a worker does not tell it.
    const bool told = fate.way != std::string("hand") || sculpture.undo_depth() > depth;
    if (done && told) hashes.push_back(sculpture.hash());
  };
  if (fate.way == std::string("hand")) {
    for (const Stroke& stroke : test::hand_strokes(fate.seed)) live(stroke);
    return hashes;
  }
  for (int turn = 0; turn < test::kLifeTurns; ++turn) {
    if (const auto step = test::life_step(fate.seed, turn)) live(*step);
  }
  return hashes;
}

class SessionKills : public testing::Test {
 protected:
  fs::path project() const { return folder_ / "piece.vdb"; }

  /// One life; false when there is no project yet.
  bool one_life(const Fate& fate) {
    SCOPED_TRACE(testing::Message()
                 << fate.way << ", seed " << fate.seed << ", killed at call " << fate.kill_at
                 << " or after " << fate.kill_us << " us, full " << fate.percent << " %");
    const bool is_first = !fs::exists(project());
    auto before = is_first ? OpenedProject{Sculpture(test::life_start()), 0, {}}
                           : std::move(open_project(project())).value();
    const std::vector<std::uint64_t> hashes = hashes_of(std::move(before.sculpture), fate);
    const Death death = live_and_die(project(), fate);
    kills_ += death.killed ? 1 : 0;
    reported_ += death.reported;
    if (!fs::exists(project())) {
      EXPECT_TRUE(is_first);
      EXPECT_EQ(death.reported, 0U);
      return false;
    }
    judge(hashes, death.reported);
    return true;
  }

  /// The project alone loads, and with its journal it is a life's state at or after the last
  /// report.
  void judge(const std::vector<std::uint64_t>& hashes, std::uint32_t reported) {
    const auto alone = load_sculpture(project());
    ASSERT_TRUE(alone) << alone.error().message;
    const auto opened = open_project(project());
    ASSERT_TRUE(opened) << opened.error().message;
    recovered_ += opened.value().recovered_steps;
    const auto first = hashes.begin() + static_cast<std::ptrdiff_t>(reported);
    EXPECT_NE(std::find(first, hashes.end(), opened.value().sculpture.hash()), hashes.end())
        << reported << " steps were reported durable";
  }

  /// The next program goes on as if nothing had been, can take back every step of a history that
  /// was kept, and without that leaves only the project.
  void close_well(unsigned seed) {
    const auto opened = open_project(project());
    ASSERT_TRUE(opened) << opened.error().message;
    auto session = Session::open(project());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(session.value().sculpture().hash(), opened.value().sculpture.hash());
    const auto closed = session.value().close();
    ASSERT_TRUE(closed) << closed.error().message;
    drop_history(project(), test::keeps_history(seed));
    EXPECT_THAT(folder_.names(), testing::ElementsAre("piece.vdb"));
    const auto loaded = load_sculpture(project());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().hash(), opened.value().sculpture.hash());
    for (std::size_t n = 0; n < loaded.value().piece_count(); ++n) {
      EXPECT_THAT(loaded.value().clay(n).validate(), testing::IsEmpty());
    }
  }

  /// Reads the history of a project that was closed, which leads to the clay as it is or is none,
  /// and forgets it.
  void drop_history(const fs::path& file, bool is_kept) {
    auto session = Session::open(file);
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(session.value().recovered_steps(), 0);
    if (!is_kept) {
      EXPECT_FALSE(session.value().has_older_steps());
    }
    const std::uint64_t hash = session.value().sculpture().hash();
    if (session.value().has_older_steps()) {
      const auto deepened = session.value().deepen();
      ASSERT_TRUE(deepened) << deepened.error().message;
      ++deepened_;
    }
    EXPECT_EQ(session.value().sculpture().hash(), hash);
    while (session.value().sculpture().undo()) ++taken_back_;
    ASSERT_TRUE(session.value().discard());
    session = Session::open(file);
    ASSERT_TRUE(session && session.value().sculpture().hash() == hash);
    ASSERT_TRUE(session.value().forget_history());
    ASSERT_TRUE(session.value().close());
  }

  /// So many projects, each with up to three lives on end; more where the kills came too late, and
  /// where few of them left nothing to recover.
  void run(int runs, const char* way) {
    const unsigned seed = 20261121;
    std::mt19937 random(seed);
    int lives = 0;
    int run = 0;
    const bool is_few = runs < 7;
    const auto is_enough = [&] {
      return run >= runs && kills_ > runs / 2 && (!is_few || recovered_ > runs);
    };
    for (; !is_enough() && run < std::max(4 * runs, 12) && !HasFailure(); ++run) {
      bool exists = false;
      const auto most = 1 + random() % 3;
      for (unsigned life = 0; life < most && !HasFailure(); ++life, ++lives) {
        exists = one_life(draw_fate(random, static_cast<unsigned>(run) * 10U + life, way));
      }
      if (exists) close_well(static_cast<unsigned>(run) * 10U);
      for (const std::string& name : folder_.names()) fs::remove(folder_ / name);
    }
    std::printf(
        "seed %u: %d runs, %d lives, %d killed, %lld steps reported, %lld recovered, %d histories "
        "read and %d of their steps taken back\n",
        seed, run, lives, kills_, static_cast<long long>(reported_),
        static_cast<long long>(recovered_), deepened_, taken_back_);
    EXPECT_GT(kills_, runs / 2);
    EXPECT_GT(recovered_, runs);
  }

  /// Twice as many lives as `runs`, of which more than half must be killed; more where the kills
  /// came too late.
  void run_moves(int runs);

  test::ScratchFolder folder_;
  int kills_ = 0;
  std::int64_t reported_ = 0;
  std::int64_t recovered_ = 0;
  int deepened_ = 0;
  int taken_back_ = 0;
};

/// The state after so many steps that a project has with its journal; nothing where there is no
/// such file, or it is what lay there before.
std::optional<std::size_t> state_of(const fs::path& file, std::uint64_t former,
                                    const std::vector<std::uint64_t>& hashes) {
  if (!fs::exists(file)) return std::nullopt;
  const auto alone = load_sculpture(file);
  EXPECT_TRUE(alone) << alone.error().message;
  const auto opened = open_project(file);
  EXPECT_TRUE(opened) << opened.error().message;
  if (!opened || opened.value().sculpture.hash() == former) return std::nullopt;
  const auto last = std::find(hashes.rbegin(), hashes.rend(), opened.value().sculpture.hash());
  EXPECT_NE(last, hashes.rend()) << file << " is none of the states";
  return static_cast<std::size_t>(hashes.rend() - last) - 1;
}

void SessionKills::run_moves(int runs) {
  const Clay other = Clay::ball(5.0, {0.4, 0.1}).value();
  const fs::path moved = test::moved_name(project());
  std::mt19937 random(20261122);
  const auto is_enough = [&](int run) { return run >= 2 * runs && kills_ > runs; };
  for (int run = 0; !is_enough(run) && run < std::max(2 * runs, 12) && !HasFailure(); ++run) {
    Fate fate;
    fate.way = "moves";
    fate.seed = static_cast<unsigned>(run) * 10U + 1U;  // does not close
    fate.kill_at = 1 + static_cast<long>(random() % 250);
    SCOPED_TRACE(testing::Message() << "seed " << fate.seed << ", killed at " << fate.kill_at);
    ASSERT_TRUE(save_project(project(), test::life_start()));
    if (run % 2 == 1) {
      ASSERT_TRUE(save_project(moved, other));
    }
    const std::vector<std::uint64_t> hashes = hashes_of(Sculpture(test::life_start()), fate);
    const Death death = live_and_die(project(), fate);
    kills_ += death.killed ? 1 : 0;
    const auto here = state_of(project(), 0, hashes);
    const auto there = state_of(moved, other.hash(), hashes);
    ASSERT_TRUE(here) << "the project is gone";
    EXPECT_GE(std::max(*here, there.value_or(0)), death.reported);
    // The next programs find nothing that they would have to keep aside.
    for (const fs::path& file : {project(), moved}) {
      if (!fs::exists(file)) continue;
      auto session = Session::open(file);
      ASSERT_TRUE(session && session.value().close());
      drop_history(file, test::keeps_history(fate.seed));
    }
    // But for a history that was being replaced, with what its steps work with.
    const std::vector<std::string> names = folder_.names();
    const bool has_replaced =
        test::keeps_history(fate.seed) && std::any_of(names.begin(), names.end(), [](auto& name) {
          return name.find(".replaced-") != std::string::npos;
        });
    for (const std::string& name : names) {
      EXPECT_TRUE(has_replaced || name == "piece.vdb" || name == "moved.vdb" || !fs::exists(moved))
          << name;
      fs::remove(folder_ / name);
    }
  }
  EXPECT_GT(kills_, runs);
}

#ifndef __SANITIZE_ADDRESS__  // which wants to be loaded before the library that makes the disk
                              // fail
TEST_F(SessionKills, LoseNothingWhileItIsSavedUnderAnotherName) { run_moves(1); }
TEST_F(SessionKills, LoseNoFinishedStrokeAndNoProject) { run(1, "steps"); }
TEST_F(SessionKills, LoseNoFinishedStrokeOfAHand) { run(1, "hand"); }
#endif

class SessionKillsSlow : public SessionKills {
 protected:
  static int runs_asked() {
    const char* asked = std::getenv("ARGIL_KILL_RUNS");
    return asked != nullptr ? std::atoi(asked) : 100;
  }
};

TEST_F(SessionKillsSlow, LoseNothingWhileItIsSavedUnderAnotherName) { run_moves(runs_asked()); }

TEST_F(SessionKillsSlow, LoseNoFinishedStrokeAndNoProject) { run(runs_asked(), "steps"); }

TEST_F(SessionKillsSlow, LoseNoFinishedStrokeOfAHand) {
  // Half as many, as each is longer; of fewer than seven too few are killed.
  run(std::max(7, 1 + runs_asked() / 2), "hand");
}

}  // namespace
}  // namespace argil::io
