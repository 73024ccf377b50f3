// SPDX-License-Identifier: GPL-3.0-or-later
// `argil sculpt` killed at a call that changes a file: what it left, and what the next command
// makes of it.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/session.h"

#include "cli/run_argil.h"
#include "support/built.h"
#include "support/scratch.h"
#include "support/stroke_script_file.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Forty small strokes on a ball.
io::StrokeScript many_strokes() {
  io::StrokeScript script;
  script.start = io::StartShape{io::StartShape::Kind::ball, {8.0, 0.0, 0.0}, {0.5, 0.1}};
  for (int n = 0; n < 40; ++n) {
    Stroke stroke;
    stroke.tool.action = n % 2 == 0 ? Action::add : Action::carve;
    stroke.tool.radii_mm = {1.5, 1.5, 1.5};
    stroke.samples.push_back({0.0, {0.4 * (n - 20), n % 3 - 1.0, 8.0 - 0.01 * n * n}, {}, 1.0});
    script.steps.push_back(stroke);
  }
  return script;
}

class KilledSculpt : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(test::write_stroke_script(path("s.jsonl"), script));
    Clay clay = Clay::ball(8.0, script.start->options).value();
    hashes.push_back(clay.hash());
    for (const io::ScriptStep& step : script.steps) {
      ASSERT_TRUE(io::apply_step(clay, step));
      hashes.push_back(clay.hash());
    }
  }

  std::string path(const std::string& name) const { return (folder / name).string(); }

  Ended killed_at(int call, const std::vector<std::string>& arguments) const {
    // NOLINTBEGIN(concurrency-mt-unsafe): this test has one thread
    ::setenv("LD_PRELOAD", faulty_disk_library(), 1);
    ::setenv("ARGIL_FAULT_KILL_AT", std::to_string(call).c_str(), 1);
    Ended run = run_argil(arguments);
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("ARGIL_FAULT_KILL_AT");
    // NOLINTEND(concurrency-mt-unsafe)
    EXPECT_TRUE(run.signal == SIGKILL || run.status == 0) << run.err;
    return run;
  }

  /// After how many strokes the clay had the hash that `argil info` tells; -1: never.
  long steps_of(const std::string& file, long& recovered) const {
    const Ended run = run_argil({"info", file, "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const json info = run.json();
    recovered = info.value("recovered_strokes", -1L);
    if (recovered > 0) {
      EXPECT_THAT(run.err, HasSubstr("note: 'q.vdb': recovered"));
    }
    const auto hash = std::stoull(info.at("hash").get<std::string>(), nullptr, 16);
    const auto found = std::find(hashes.begin(), hashes.end(), hash);
    return found == hashes.end() ? -1 : found - hashes.begin();
  }

  void remove_all_but_the_script() const {
    for (const std::string& name : folder.names()) {
      if (name != "s.jsonl") std::filesystem::remove(folder / name);
    }
  }

  io::StrokeScript script = many_strokes();
  std::vector<std::uint64_t> hashes;
  ScratchFolder folder;
};

// How many calls a run makes, and at which its first stroke is in the journal, depends on how many
// lines the journal's thread writes at once. So a test kills at one after the other until a run is
// not killed any more, and again at others where none of them met the strokes in the journal.
constexpr int kRounds = 5;

TEST_F(KilledSculpt, LeavesItsStrokesToTheNextCommand) {
  long most = 0;
  int kills = 0;
  for (int round = 0; round < kRounds && most == 0; ++round) {
    bool was_killed = true;
    for (int call = 1 + round; was_killed; call += kRounds) {
      const Ended run =
          killed_at(call, {"sculpt", "--strokes", path("s.jsonl"), "-o", path("q.vdb")});
      was_killed = run.signal == SIGKILL;
      kills += was_killed ? 1 : 0;
      if (std::filesystem::exists(path("q.vdb"))) {
        long recovered = 0;
        const long steps = steps_of(path("q.vdb"), recovered);
        EXPECT_GE(steps, 0) << "killed at call " << call;
        most = std::max(most, recovered);
      }
      remove_all_but_the_script();
    }
  }
  EXPECT_GE(kills, 4);
  EXPECT_GT(most, 0);
}

TEST_F(KilledSculpt, IsGoneOnWith) {
  long recovered = 0;
  long before = 0;
  for (int round = 0; round < kRounds && recovered == 0; ++round) {
    bool was_killed = true;
    for (int call = 20 + round; was_killed && recovered == 0; call += kRounds) {
      remove_all_but_the_script();
      const Ended run =
          killed_at(call, {"sculpt", "--strokes", path("s.jsonl"), "-o", path("q.vdb")});
      was_killed = run.signal == SIGKILL;
      if (std::filesystem::exists(path("q.vdb"))) before = steps_of(path("q.vdb"), recovered);
    }
  }
  ASSERT_GT(recovered, 0);
  const Ended run = run_argil({"sculpt", path("q.vdb"), "--strokes", path("s.jsonl"), "-o",
                               path("q.vdb"), "--undo-all", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("recovered_strokes"), recovered);
  EXPECT_EQ(run.json().at("undone"), 40);
  EXPECT_THAT(folder.names(), testing::UnorderedElementsAre("s.jsonl", "q.vdb"));
  EXPECT_EQ(steps_of(path("q.vdb"), recovered), before);
  EXPECT_EQ(recovered, 0);
}

TEST_F(KilledSculpt, OfAnExistingFileLeavesTheOldOneWhole) {
  // A run makes some of these calls before the first project is renamed over the file; from then on
  // that is whole.
  int left_old = 0;
  for (const int call : {1, 2, 3, 4, 6, 8, 12}) {
    fill(folder / "q.vdb", "old");
    killed_at(call, {"sculpt", "--strokes", path("s.jsonl"), "-o", path("q.vdb")});
    const bool is_old = content_of(folder / "q.vdb") == "old";
    left_old += is_old ? 1 : 0;
    long recovered = 0;
    EXPECT_TRUE(is_old || steps_of(path("q.vdb"), recovered) >= 0) << call;
    for (const std::string& name : folder.names()) {
      if (name != "s.jsonl") std::filesystem::remove(folder / name);
    }
  }
  EXPECT_GE(left_old, 3);
}

TEST_F(KilledSculpt, LeavesNothingWhenAStrokeIsRefused) {
  Stroke far_away = std::get<Stroke>(script.steps[0]);
  far_away.samples[0].position_mm.x = 9e5;
  script.steps.push_back(far_away);
  ASSERT_TRUE(test::write_stroke_script(path("s.jsonl"), script));
  const Ended run = run_argil({"sculpt", "--strokes", path("s.jsonl"), "-o", path("q.vdb")});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("stroke 41: "));
  EXPECT_THAT(folder.names(), testing::ElementsAre("s.jsonl"));
}

}  // namespace
}  // namespace argil::test
