// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions whose steps are more than strokes of plain tools: operations, other solids, mesh tools,
// and strokes that a ClayWorker made.
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay_worker.h"
#include "argil/engine/tool_mesh.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "support/alpha_maker.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/session_life.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Combine subtract_box() {
  Combine with;
  with.kind = CombineKind::subtract;
  with.mesh = std::make_shared<const TriangleMesh>(test::box_mesh({2.0, 1.0 / 3.0, 3.0}));
  with.placement.position_mm = {0.0, 0.0, 5.5};
  return with;
}

Combine unite_ball() {
  Combine with;
  with.clay = std::make_shared<const Clay>(Clay::ball(3.5, {0.4, 0.1}).value());
  with.placement.position_mm = {0.0, 5.0, 0.0};
  return with;
}

Stroke emboss_letter() {
  Stroke stroke;
  stroke.tool.action = Action::emboss;
  stroke.tool.radii_mm = {3.0, 3.0, 3.0};
  stroke.tool.alpha = test::letter_image();
  stroke.tool.mid_level = 0.2;
  stroke.samples.push_back({0.0, {0.0, 0.0, -6.0}, {}, 1.0});
  return stroke;
}

/// Each possible after the one before.
std::vector<ScriptStep> many_steps() {
  std::mt19937 random(1);
  return {test::rod_stroke(random),  Operation(Offset{0.3}),
          Operation(unite_ball()),   HistoryStep::undo,
          HistoryStep::redo,         Operation(subtract_box()),
          test::rod_stroke(random),  Operation(Resample{0.5}),
          test::rod_stroke(random),  Operation(Cut{{0.0, 0.0, -4.0}, {0.0, 0.2, -1.0}, false}),
          HistoryStep::undo,         HistoryStep::undo,
          HistoryStep::undo,         emboss_letter(),
          Operation(Hollow{1.5, {}})};
}

class SessionSteps : public testing::Test {
 protected:
  fs::path file(const std::string& name = "piece.vdb") const { return folder_ / name; }

  Session create(int autosave_steps = 0) const {
    SessionOptions options;
    options.autosave_steps = autosave_steps;
    auto session = Session::create(file(), test::life_start(), options);
    EXPECT_TRUE(session) << session.error().message;
    return std::move(session).value();
  }

  static void sculpt(Session& session, const ScriptStep& step) {
    const auto done = apply_step(session.sculpture(), step);
    ASSERT_TRUE(done) << done.error().message;
    session.record(step);
  }

  /// Names of files that begin with `front`.
  std::vector<std::string> names(const std::string& front) const {
    std::vector<std::string> found;
    for (const std::string& name : folder_.names()) {
      if (name.starts_with(front)) found.push_back(name);
    }
    return found;
  }
  std::vector<std::string> solids() const { return names(".piece.solid-"); }

  test::ScratchFolder folder_;
};

TEST_F(SessionSteps, AreRecoveredBitForBitAfterEachOfThem) {
  const auto steps = many_steps();
  const std::size_t stride = test::effort(4U, 1U);  // usually after some, the last among them
  for (std::size_t count = (steps.size() - 1) % stride + 1; count <= steps.size();
       count += stride) {
    std::uint64_t hash = 0;
    int depth = 0;
    {
      Session session = create();
      for (std::size_t n = 0; n < count; ++n) sculpt(session, steps[n]);
      ASSERT_TRUE(session.flush());
      hash = session.clay().hash();
      depth = session.clay().undo_depth();
    }
    auto opened = Session::open(file());
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened.value().clay().hash(), hash) << count;
    EXPECT_EQ(opened.value().clay().undo_depth(), depth) << count;
    EXPECT_EQ(opened.value().recovered_steps(), static_cast<std::int64_t>(count));
    ASSERT_TRUE(opened.value().close());
    EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
    EXPECT_EQ(load_project(file()).value().hash(), hash);
    fs::remove(file());
  }
}

TEST_F(SessionSteps, OutliveTheMeshTheyWereReadFrom) {
  ASSERT_TRUE(write_mesh(file("rod.stl"), test::box_mesh({1.0, 1.0, 8.0})));
  fill(file("a.strokes.jsonl"),
       "{\"argil_strokes\":1}\n"
       R"({"tool":"add","shape":"mesh","mesh":"rod.stl","radii_mm":[1,1,4],"poses":[[0,0,0,5]]})"
       "\n"
       R"({"operation":"difference","with":"rod.stl","position_mm":[5,0,0]})");
  const auto script = read_stroke_script(file("a.strokes.jsonl"));
  ASSERT_TRUE(script) << script.error().message;
  std::uint64_t hash = 0;
  {
    Session session = create();
    for (const ScriptStep& step : script.value().steps) sculpt(session, step);
    ASSERT_TRUE(session.flush());
    hash = session.clay().hash();
  }
  ASSERT_TRUE(write_mesh(file("rod.stl"), test::ball_mesh(2.0, 1)));
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash);
  fs::remove(file("rod.stl"));
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash);
}

TEST_F(SessionSteps, StoreASolidOnceAndRemoveItAtTheEnd) {
  Session session = create();
  std::mt19937 random(3);
  for (int n = 0; n < 20; ++n) sculpt(session, test::rod_stroke(random));  // of two tools
  ASSERT_TRUE(session.flush());
  EXPECT_EQ(solids().size(), 2U);
  ASSERT_TRUE(session.save());
  EXPECT_EQ(solids().size(), 2U) << "undo may reach behind a save";
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
}

TEST_F(SessionSteps, OfADiscardedSessionLeaveNoSolid) {
  std::mt19937 random(3);
  {
    Session session = create();
    sculpt(session, Operation(subtract_box()));
    ASSERT_TRUE(session.flush());
  }
  const auto before = folder_.names();
  auto opened = Session::open(file());
  ASSERT_TRUE(opened);
  sculpt(opened.value(), Operation(subtract_box()));
  sculpt(opened.value(), test::rod_stroke(random));
  ASSERT_TRUE(opened.value().flush());
  EXPECT_EQ(solids().size(), 2U);
  ASSERT_TRUE(opened.value().discard());
  EXPECT_THAT(folder_.names(), testing::UnorderedElementsAreArray(before));
}

TEST_F(SessionSteps, TellAndKeepWhatNeedsASolidThatIsGoneOrChanged) {
  std::uint64_t first = 0;
  {
    Session session = create();
    sculpt(session, Operation(Offset{0.2}));
    first = session.clay().hash();
    sculpt(session, Operation(subtract_box()));
    ASSERT_TRUE(session.flush());
  }
  const std::string journal = content_of(file("piece.journal.jsonl"));
  const fs::path solid = file(solids().at(0));
  const std::string mesh = content_of(solid);
  std::string changed = mesh;
  changed[changed.find("end_header\n") + 13] ^= 1;
  fill(solid, changed);
  auto read = open_project(file());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().sculpture.hash(), first);
  EXPECT_THAT(read.value().notes.at(1),
              AllOf(HasSubstr("is damaged"), HasSubstr("key 'with' cannot be used"),
                    HasSubstr("it was changed")));
  fs::remove(solid);
  {
    auto session = Session::open(file());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(session.value().clay().hash(), first);
    EXPECT_THAT(testing::PrintToString(session.value().notes()),
                AllOf(HasSubstr("is not there; put it back"),
                      HasSubstr("is kept as 'piece.journal.jsonl.damaged-1'")));
    sculpt(session.value(), Operation(subtract_box()));
    ASSERT_TRUE(session.value().close());
  }
  // The journal that was kept names the solid, so it stays as long.
  EXPECT_EQ(content_of(file("piece.journal.jsonl.damaged-1")), journal);
  EXPECT_EQ(content_of(file(solids().at(0))), mesh);
  fs::remove(file("piece.journal.jsonl.damaged-1"));
  auto session = Session::open(file());
  ASSERT_TRUE(session);
  ASSERT_TRUE(session.value().close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
}

TEST_F(SessionSteps, WaitForTheirSolidAndKeepTheirOrder) {
  std::string name;
  {
    Session session = create();
    sculpt(session, Operation(subtract_box()));
    ASSERT_TRUE(session.flush());
    name = solids().at(0);
    ASSERT_TRUE(session.discard());
  }
  fs::create_directories(file(name) / "in the way");
  Session session = create();
  sculpt(session, Operation(Offset{0.2}));
  const std::uint64_t first = session.clay().hash();
  sculpt(session, Operation(subtract_box()));
  sculpt(session, Operation(Offset{-0.2}));
  const auto blocked = session.flush();
  ASSERT_FALSE(blocked);
  EXPECT_EQ(blocked.error().kind, ErrorKind::disk);
  EXPECT_THAT(blocked.error().message, HasSubstr(name));
  EXPECT_FALSE(session.problem());
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), first);
  fs::remove_all(file(name));
  ASSERT_TRUE(session.flush());
  EXPECT_TRUE(session.problem());
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), session.clay().hash());
}

TEST_F(SessionSteps, CanBeInterruptedWhileTheyAreRepeated) {
  {
    Session session = create();
    sculpt(session, Operation(Offset{0.2}));
    ASSERT_TRUE(session.flush());
  }
  const auto before = folder_.names();
  int calls = 0;
  double last = 0.0;
  const auto opened = Session::open(file(), {}, [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return ++calls < 3;
  });
  ASSERT_FALSE(opened) << "within the operation";
  EXPECT_EQ(opened.error().kind, ErrorKind::interrupted);
  EXPECT_THAT(folder_.names(), testing::UnorderedElementsAreArray(before));
}

TEST_F(SessionSteps, ThatAreSlowToRepeatAreAutosavedAtOnce) {
  std::uint64_t hash = 0;
  {
    Session session = create(500);
    sculpt(session, Operation(Cut{{0.0, 0.0, 5.0}, {0.0, 0.0, 1.0}, false}));
    sculpt(session, Operation(Offset{0.3}));
    for (int n = 0; n < 2000 && !fs::exists(file(".piece.autosave.vdb")); ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(session.flush());
    hash = session.clay().hash();
  }
  ASSERT_TRUE(fs::exists(file(".piece.autosave.vdb")));
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash);
  EXPECT_EQ(opened.value().recovered_steps, 2);
  EXPECT_EQ(opened.value().sculpture.clay().undo_depth(), 0) << "something was repeated";
}

TEST_F(SessionSteps, AfterAnAutosaveUndoAndRedoReachBehindIt) {
  Session session = create(500);
  std::vector<std::uint64_t> hashes{session.clay().hash()};
  const auto both = [&](const ScriptStep& step) {
    sculpt(session, step);
    hashes.push_back(session.clay().hash());
    ASSERT_TRUE(session.flush());
    EXPECT_EQ(open_project(file()).value().sculpture.hash(), hashes.back());
  };
  both(Operation(Offset{0.3}));
  both(Operation(unite_ball()));
  both(HistoryStep::undo);
  both(HistoryStep::undo);
  EXPECT_EQ(hashes[4], hashes[0]);
  both(HistoryStep::redo);
  EXPECT_EQ(hashes[5], hashes[1]);
}

TEST_F(SessionSteps, OfAWorkerAreRecovered) {
  constexpr unsigned kSeed = 4;
  Session session = create();
  ClayWorkerOptions options;
  options.tool = test::hand_tool(kSeed);
  options.on_stroke = [&](const Stroke& stroke) { session.record(stroke); };
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayWorker worker(session.clay(), options, ring, channel);
  for (std::uint64_t n = 0; n < test::kHandRuns * test::kHandRun; ++n) {
    ASSERT_TRUE(ring.push(test::hand_sample(kSeed, n)));
    if (n % 5 == 0) {
      ASSERT_TRUE(worker.step());
    }
  }
  ASSERT_TRUE(worker.step());
  ASSERT_TRUE(worker.finish());
  EXPECT_EQ(session.step_count(), worker.counts().strokes);
  ASSERT_GT(session.step_count(), 5U);
  ASSERT_TRUE(session.flush());
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), session.clay().hash());
  EXPECT_EQ(opened.value().sculpture.clay().undo_depth(), session.clay().undo_depth());
}

}  // namespace
}  // namespace argil::io
