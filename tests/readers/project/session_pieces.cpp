// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions of several pieces: what was done to any comes back.
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "support/scratch.h"
#include "support/session_life.h"

namespace argil::io {
namespace {

std::vector<ScriptStep> steps_of_pieces() {
  std::mt19937 random(5);
  AddPiece box;
  box.look = {.name = "Box", .placement = {{4.0, 1.0, 0.0}, {0.9, 0.1, 0.2, 0.3}}};
  box.mesh = std::make_shared<const TriangleMesh>(test::box_mesh({3.1, 4.2, 2.3}));
  AddPiece ball;
  ball.look.name = "Ball";
  ball.clay = std::make_shared<const Clay>(Clay::ball(3.5, {0.4, 0.1}).value());
  ChangePiece move{.name = "Ball"};
  move.placement = Placement{{0.0, -5.0, 0.0}, {}};
  return {random_dab(random, 6.0),
          PieceEdit(box),
          random_dab(random, 3.0),
          PieceEdit(ball),
          PieceEdit(move),
          PieceEdit(SelectPiece{"Clay"}),
          random_dab(random, 6.0),
          PieceEdit(CopyPiece{"Ball", "Ball 2"}),
          HistoryStep::undo,
          HistoryStep::redo,
          PieceEdit(MergePiece{"Clay", "Box", CombineKind::subtract, false}),
          PieceEdit(RemovePiece{"Ball 2"}),
          HistoryStep::undo,
          random_dab(random, 3.0)};
}

class SessionPieces : public testing::Test {
 protected:
  static void sculpt(Session& session, const ScriptStep& step) {
    const auto done = apply_step(session.sculpture(), step);
    ASSERT_TRUE(done) << done.error().message;
    session.record(step);
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "p.vdb";
};

TEST_F(SessionPieces, AreRecoveredBitForBitAfterEachStep) {
  const auto steps = steps_of_pieces();
  for (std::size_t count = 1; count <= steps.size(); ++count) {
    std::uint64_t hash = 0;
    int depth = 0;
    {
      SessionOptions options;
      options.autosave_steps = count % 2 == 0 ? 3 : 0;
      auto session = Session::create(file_, test::life_start(), options);
      ASSERT_TRUE(session) << session.error().message;
      for (std::size_t n = 0; n < count; ++n) {
        sculpt(session.value(), steps[n]);
        if (n == 4 && count % 3 == 0) {
          ASSERT_TRUE(session.value().save());
        }
      }
      hash = session.value().sculpture().hash();
      depth = session.value().sculpture().undo_depth();
    }  // as after a kill
    auto opened = Session::open(file_);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened.value().sculpture().hash(), hash) << count;
    EXPECT_LE(opened.value().sculpture().undo_depth(), depth);
    ASSERT_TRUE(opened.value().close());
    const auto loaded = load_sculpture(file_);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().hash(), hash);
    EXPECT_THAT(folder_.names(), testing::ElementsAre("p.vdb")) << "solids stayed";
    std::filesystem::remove(file_);
  }
}

/// What was done is told to be repeated, whatever is locked: by a program that did not ask.
TEST_F(SessionPieces, JournalIsRepeatedOnLockedPieces) {
  std::uint64_t hash = 0;
  {
    auto session = Session::create(file_, test::life_start());
    ASSERT_TRUE(session);
    sculpt(session.value(), PieceEdit(ChangePiece{.name = "Clay", .is_locked = true}));
    std::mt19937 random(3);
    const Stroke stroke = random_dab(random, 6.0);
    ASSERT_TRUE(session.value().clay().apply(stroke));
    session.value().record(stroke);
    hash = session.value().sculpture().hash();
  }
  const auto opened = open_project(file_);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash);
}

TEST_F(SessionPieces, GoOnUnderAnotherNameWithAllThatCanBeUndone) {
  auto session = Session::create(file_, test::life_start());
  ASSERT_TRUE(session);
  const auto steps = steps_of_pieces();
  for (const ScriptStep& step : steps) sculpt(session.value(), step);
  const std::uint64_t hash = session.value().sculpture().hash();
  const int depth = session.value().sculpture().undo_depth();
  const auto saved = session.value().save_as(folder_ / "q.vdb");
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_TRUE(saved.value().keeps_undo);
  EXPECT_EQ(session.value().sculpture().hash(), hash);
  EXPECT_EQ(session.value().sculpture().undo_depth(), depth);
  EXPECT_EQ(load_sculpture(folder_ / "q.vdb").value().hash(), hash);
  sculpt(session.value(), HistoryStep::undo);
  const std::uint64_t undone = session.value().sculpture().hash();
  { const Session ends = std::move(session).value(); }
  EXPECT_EQ(open_project(folder_ / "q.vdb").value().sculpture.hash(), undone);
}

}  // namespace
}  // namespace argil::io
