// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/sculpture.h"

#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/surface.h"

#include "support/shapes.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::HasSubstr;

Clay small_ball(double radius_mm = 5.0) { return Clay::ball(radius_mm, {0.35, 0.1}).value(); }

std::shared_ptr<const Clay> shared_ball(double radius_mm) {
  return std::make_shared<const Clay>(small_ball(radius_mm));
}

AddPiece ball_piece(const std::string& name, const Vec3& at, double radius_mm = 3.0) {
  AddPiece add;
  add.look.name = name;
  add.look.placement.position_mm = at;
  add.clay = shared_ball(radius_mm);
  return add;
}

Stroke dab_on_piece(unsigned seed) {
  std::mt19937 random(seed);
  return random_dab(random, 5.0);
}

/// A head with a nose, the nose active.
Sculpture head_with_nose() {
  Sculpture sculpture(small_ball(), {.name = "Head"});
  EXPECT_TRUE(sculpture.apply(ball_piece("Nose", {0.0, -6.0, 0.0})));
  return sculpture;
}

/// All edits that change something, each possible after the one before.
std::vector<PieceEdit> many_edits() {
  ChangePiece move{.name = "Ear"};
  move.placement = Placement{{1.0, 2.0, 3.0}, {0.5, 0.5, 0.5, 0.5}};
  move.color = Rgb8{200, 120, 40};
  ChangePiece hide{.name = "Ear"};
  hide.new_name = "Left ear";
  hide.is_visible = false;
  return {ball_piece("Nose", {0.0, -6.0, 0.0}),
          CopyPiece{"Nose", "Ear"},
          move,
          hide,
          PlacePieces{{{"Nose", {{0.0, -7.0, 0.5}, {}}}, {"Left ear", {{2.0, 0.0, 0.0}, {}}}}},
          ScalePiece{"Nose", 1.25, Vec3{0.0, 0.0, 0.5}},
          MergePiece{"Head", "Nose", CombineKind::unite, true},
          MergePiece{"Head", "Left ear", CombineKind::subtract, false},
          RemovePiece{"Nose"}};
}

TEST(Sculpture, OfOnePlainPieceHasTheHashOfItsClay) {
  const std::uint64_t hash = small_ball().hash();
  Sculpture sculpture(small_ball());
  EXPECT_TRUE(sculpture.is_plain());
  EXPECT_EQ(sculpture.hash(), hash);
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Clay", .is_visible = false}));
  EXPECT_FALSE(sculpture.is_plain());
  EXPECT_NE(sculpture.hash(), hash);
  EXPECT_EQ(sculpture.clay().hash(), hash);
}

TEST(Sculpture, HashTellsEveryPartOfALook) {
  std::set<std::uint64_t> hashes;
  const auto take = [&](const ChangePiece& change) {
    Sculpture sculpture = head_with_nose();
    EXPECT_TRUE(sculpture.apply(change));
    EXPECT_TRUE(hashes.insert(sculpture.hash()).second);
  };
  take({.name = "Head"});
  take({.name = "Head", .new_name = "Skull"});
  take({.name = "Nose", .new_name = "Snout"});
  take({.name = "Head", .placement = Placement{{1.0, 0.0, 0.0}, {}}});
  take({.name = "Head", .placement = Placement{{}, {0.0, 1.0, 0.0, 0.0}}});
  take({.name = "Head", .is_visible = false});
  take({.name = "Head", .is_locked = true});
  take({.name = "Head", .color = Rgb8{1, 2, 3}});
  take({.name = "Head", .color = Rgb8{1, 2, 4}});
  Sculpture other = head_with_nose();
  ASSERT_TRUE(other.apply(SelectPiece{"Head"}));
  EXPECT_TRUE(hashes.insert(other.hash()).second) << "which is active";
}

TEST(Sculpture, UndoesAndRepeatsEditsBitForBit) {
  Sculpture sculpture(small_ball(), {.name = "Head"});
  std::vector<std::uint64_t> hashes{sculpture.hash()};
  for (const PieceEdit& edit : many_edits()) {
    const auto done = sculpture.apply(edit);
    ASSERT_TRUE(done) << done.error().message;
    hashes.push_back(sculpture.hash());
  }
  EXPECT_EQ(sculpture.undo_depth(), static_cast<int>(hashes.size()) - 1);
  for (std::size_t n = hashes.size() - 1; n-- > 0;) {
    ASSERT_TRUE(sculpture.undo()) << n;
    EXPECT_EQ(sculpture.hash(), hashes[n]) << n;
  }
  EXPECT_FALSE(sculpture.undo());
  for (std::size_t n = 1; n < hashes.size(); ++n) {
    ASSERT_TRUE(sculpture.redo()) << n;
    EXPECT_EQ(sculpture.hash(), hashes[n]) << n;
  }
  EXPECT_FALSE(sculpture.redo());
}

TEST(Sculpture, UndoesStrokesOfAllPiecesInTheirOrder) {
  Sculpture sculpture = head_with_nose();
  std::vector<std::uint64_t> hashes;
  const auto hash_of_both = [&] {
    return sculpture.clay(0).hash() ^ (sculpture.clay(1).hash() * 3);
  };
  for (unsigned n = 0; n < 9; ++n) {
    hashes.push_back(hash_of_both());
    ASSERT_TRUE(sculpture.apply(SelectPiece{n % 3 == 0 ? "Head" : "Nose"}));
    ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(n)));
  }
  // Whatever is active: it stays active.
  ASSERT_TRUE(sculpture.apply(SelectPiece{"Head"}));
  EXPECT_EQ(sculpture.undo_depth(), 10);  // and the nose
  for (std::size_t n = hashes.size(); n-- > 0;) {
    ASSERT_TRUE(sculpture.undo());
    EXPECT_EQ(hash_of_both(), hashes[n]) << n;
  }
  EXPECT_EQ(sculpture.look(sculpture.active()).name, "Head");
  ASSERT_TRUE(sculpture.redo());
  // What is new cuts off what could be repeated, also of other pieces.
  ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(77)));
  EXPECT_FALSE(sculpture.redo());
}

TEST(Sculpture, RemovedPieceComesBackWithAllThatCanBeUndone) {
  Sculpture sculpture = head_with_nose();
  const std::uint64_t fresh = sculpture.clay().hash();
  ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(1)));
  const std::uint64_t worked = sculpture.clay().hash();
  ASSERT_TRUE(sculpture.apply(RemovePiece{"Nose"}));
  EXPECT_EQ(sculpture.look(sculpture.active()).name, "Head");
  EXPECT_EQ(sculpture.undo_depth(), 3);
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.clay(1).hash(), worked);
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.clay(1).hash(), fresh);
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.piece_count(), 1U);
  EXPECT_EQ(sculpture.undo_depth(), 0);
}

/// Whoever undoes and repeats goes on as if nothing had been.
TEST(Sculpture, UndoAndRedoAreNoChange) {
  for (std::size_t steps = 1; steps <= many_edits().size(); ++steps) {
    Sculpture sculpture(small_ball(), {.name = "Head"});
    for (std::size_t n = 0; n < steps; ++n) {
      ASSERT_TRUE(sculpture.apply(many_edits()[n]));
    }
    const std::uint64_t hash = sculpture.hash();  // which piece is active included
    EXPECT_EQ(sculpture.redo_depth(), 0);
    ASSERT_TRUE(sculpture.undo());
    EXPECT_EQ(sculpture.redo_depth(), 1);
    ASSERT_TRUE(sculpture.redo());
    EXPECT_EQ(sculpture.hash(), hash) << steps;
  }
}

TEST(Sculpture, ForgottenRedoIsNoStep) {
  Sculpture sculpture = head_with_nose();
  for (unsigned n = 0; n < 3; ++n) {
    ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(n)));
  }
  ASSERT_TRUE(sculpture.undo() && sculpture.undo());
  ASSERT_TRUE(sculpture.set_limits({.undo_bytes = 0}));
  EXPECT_EQ(sculpture.undo_depth(), 2);
  EXPECT_TRUE(sculpture.undo());
  EXPECT_TRUE(sculpture.undo()) << "the nose";
  EXPECT_EQ(sculpture.piece_count(), 1U);
}

/// Zeros have a sign, and squares of tiny numbers none at all.
TEST(Sculpture, PlacementsAreOfOneForm) {
  Sculpture sculpture = head_with_nose();
  ChangePiece change{.name = "Head"};
  change.placement = Placement{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  ASSERT_TRUE(sculpture.apply(change));
  const std::uint64_t still = sculpture.hash();
  change.placement = Placement{{0.0, -0.0, 0.0}, {2.0, -0.0, 0.0, -0.0}};
  ASSERT_TRUE(sculpture.apply(change));
  EXPECT_EQ(sculpture.hash(), still);
  for (const double size : {1e-170, 1e-161, 1.0, 1e200}) {
    change.placement = Placement{{}, {size, 1.3 * size, 0.7 * size, 0.0}};
    ASSERT_TRUE(sculpture.apply(change)) << size;
    const Quat q = sculpture.look(0).placement.orientation;
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y, 1.0, 1e-15) << size;
    // Another change leaves it alone to the bit.
    ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Head", .is_visible = size > 1.0}));
    EXPECT_EQ(sculpture.look(0).placement.orientation, q);
  }
}

TEST(Sculpture, PiecesShareOneLimitOfMemory) {
  Sculpture sculpture(small_ball(), {.name = "Head"});
  const ClayUse one = sculpture.clay().use();
  ASSERT_TRUE(sculpture.set_limits({.memory_bytes = 3 * one.level_bytes}));
  ASSERT_TRUE(sculpture.apply(CopyPiece{"Head", "A"}));
  ASSERT_TRUE(sculpture.apply(CopyPiece{"Head", "B"}));
  const std::uint64_t hash = sculpture.hash();
  const auto more = sculpture.apply(CopyPiece{"Head", "C"});
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().kind, ErrorKind::memory);
  EXPECT_EQ(sculpture.hash(), hash);
  ASSERT_TRUE(sculpture.apply(RemovePiece{"A"}));
  EXPECT_FALSE(sculpture.apply(CopyPiece{"Head", "C"})) << "it can still be taken back";
}

TEST(Sculpture, UndoDepthCountsWhatEachClayStillRemembers) {
  Sculpture sculpture = head_with_nose();
  ASSERT_TRUE(sculpture.set_limits({.undo_bytes = 0}));  // the last step of each clay stays
  for (unsigned n = 0; n < 3; ++n) ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(n)));
  EXPECT_EQ(sculpture.undo_depth(), 1);
  EXPECT_TRUE(sculpture.undo());
  EXPECT_FALSE(sculpture.undo());
}

TEST(Sculpture, ForgetsRemovedPiecesBeyondTheLimit) {
  Sculpture sculpture(small_ball(), {.name = "Head"});
  for (const char* name : {"A", "B", "C"}) {
    ASSERT_TRUE(sculpture.apply(ball_piece(name, {})));
    ASSERT_TRUE(sculpture.apply(RemovePiece{name}));
  }
  EXPECT_EQ(sculpture.undo_depth(), 6);
  ASSERT_TRUE(sculpture.set_limits({.undo_bytes = 1}));
  EXPECT_EQ(sculpture.undo_depth(), 1);
  ASSERT_TRUE(sculpture.undo());
  EXPECT_TRUE(sculpture.find("C"));
}

TEST(Sculpture, PieceOfAMeshIsWhatAnImportMakesOfIt) {
  Sculpture sculpture(small_ball());
  AddPiece add;
  add.look.name = "Box";
  add.mesh = std::make_shared<const TriangleMesh>(test::box_mesh({4.0, 4.0, 4.0}));
  ASSERT_TRUE(sculpture.apply(add));
  EXPECT_NEAR(signed_volume(extract_surface(sculpture.clay())), 64.0, 1.0);
  EXPECT_EQ(sculpture.clay().options().voxel_mm, 0.35);
  add.look.name = "Fine box";
  add.voxel_mm = 0.2;
  ASSERT_TRUE(sculpture.apply(add));
  EXPECT_EQ(sculpture.clay().options().voxel_mm, 0.2);
}

/// Volumes say where the pieces stood: two balls that only meet as placed.
TEST(Sculpture, MergesPiecesWhereTheyStand) {
  constexpr double kBig = 4.0 / 3.0 * 3.14159265 * 125.0;
  constexpr double kSmall = 4.0 / 3.0 * 3.14159265 * 27.0;
  const auto volume = [](const Sculpture& s, std::size_t n) {
    return signed_volume(extract_surface(s.clay(n)));
  };
  for (const CombineKind kind :
       {CombineKind::unite, CombineKind::subtract, CombineKind::intersect}) {
    Sculpture sculpture(small_ball(), {.name = "Big"});
    // Both far away and turned, the small one within the big one's rim.
    const Placement there{{100.0, -40.0, 7.0}, {0.6, 0.0, 0.8, 0.0}};
    ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Big", .placement = there}));
    ASSERT_TRUE(sculpture.apply(ball_piece("Small", placed(there, {0.0, 0.0, 20.0}))));
    const auto apart = sculpture.apply(MergePiece{"Big", "Small", kind, true});
    if (kind == CombineKind::unite) {
      EXPECT_NEAR(volume(sculpture, 0), kBig + kSmall, 4.0);
    } else if (kind == CombineKind::subtract) {
      EXPECT_NEAR(volume(sculpture, 0), kBig, 4.0);
    } else {
      EXPECT_FALSE(apart) << "nothing would be left";
    }
    if (kind != CombineKind::intersect) {
      ASSERT_TRUE(sculpture.undo());
    }
    ChangePiece inside{.name = "Small"};
    inside.placement = Placement{there.position_mm, {}};
    ASSERT_TRUE(sculpture.apply(inside));
    ASSERT_TRUE(sculpture.apply(MergePiece{"Big", "Small", kind, false}));
    EXPECT_EQ(sculpture.piece_count(), 1U);
    const double wanted = kind == CombineKind::unite      ? kBig
                          : kind == CombineKind::subtract ? kBig - kSmall
                                                          : kSmall;
    EXPECT_NEAR(volume(sculpture, 0), wanted, 4.0);
    EXPECT_THAT(sculpture.clay(0).validate(), testing::IsEmpty());
  }
}

TEST(Sculpture, SurfaceIsOfWhatIsVisibleWhereItStands) {
  Sculpture sculpture(small_ball(), {.name = "Head"});
  const Placement there{{100.0, 0.0, 0.0}, normalized(Quat{1.0, 0.0, 1.0, 0.0})};
  ASSERT_TRUE(sculpture.apply(ball_piece("Nose", {})));
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Nose", .placement = there}));
  const auto both = extract_surface(sculpture);
  ASSERT_TRUE(both);
  EXPECT_EQ(both.value().triangles.size(), extract_surface(sculpture.clay(0)).triangles.size() +
                                               extract_surface(sculpture.clay(1)).triangles.size());
  const Box3 box = bounds(both.value());
  EXPECT_NEAR(box.min.x, -5.0, 0.05);
  EXPECT_NEAR(box.max.x, 103.0, 0.05);
  EXPECT_NEAR(signed_volume(both.value()),
              signed_volume(extract_surface(sculpture.clay(0))) +
                  signed_volume(extract_surface(sculpture.clay(1))),
              1e-6);
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Head", .is_visible = false}));
  const auto nose = extract_surface(sculpture);
  ASSERT_TRUE(nose);
  EXPECT_NEAR(bounds(nose.value()).min.x, 97.0, 0.05);
  const auto stopped = extract_surface(sculpture, [](std::string_view, double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
}

TEST(Sculpture, PlacedAndUnplacedAreInverse) {
  const Placement placement{{1.0, 2.0, 3.0}, normalized(Quat{0.3, -0.4, 0.5, 0.7})};
  const Vec3 p{-4.0, 0.5, 9.0};
  EXPECT_LT(length(unplaced(placement, placed(placement, p)) - p), 1e-12);
  EXPECT_GT(length(placed(placement, p) - p), 1.0);
}

struct RefusedEdit {
  const char* what;
  PieceEdit edit;
  const char* message;
};

std::vector<RefusedEdit> refused_edits() {
  const Placement nowhere{{}, {0.0, 0.0, 0.0, 0.0}};
  const Placement far{{2e6, 0.0, 0.0}, {}};
  return {
      RefusedEdit{"select", SelectPiece{"Ear"}, "there are 'Head', 'Nose'"},
      RefusedEdit{"taken", ball_piece("Head", {}), "already"},
      RefusedEdit{"empty", ball_piece("", {}), "no name"},
      RefusedEdit{"blank", ball_piece(" Ear", {}), "blanks"},
      RefusedEdit{"control", ball_piece("E\nar", {}), "plain text"},
      RefusedEdit{"cut letter", ball_piece("E\xC3", {}), "plain text"},
      RefusedEdit{"surrogate", ball_piece("\xED\xA0\x80", {}), "plain text"},
      RefusedEdit{"turns the line about", ball_piece("a\xE2\x80\xAE", {}), "plain text"},
      RefusedEdit{"escape", ball_piece("a\xC2\x9B", {}), "plain text"},
      RefusedEdit{"overlong", ball_piece("\xC0\xAF", {}), "plain text"},
      RefusedEdit{"long", ball_piece(std::string(64, 'a'), {}), "63"},
      RefusedEdit{"nothing", AddPiece{}, "give one of them"},
      RefusedEdit{"voxel",
                  AddPiece{{.name = "Ear"},
                           nullptr,
                           std::make_shared<const TriangleMesh>(test::box_mesh({4.0, 4.0, 4.0})),
                           -1.0},
                  "voxel"},
      RefusedEdit{"copied name", CopyPiece{"Head", "Nose"}, "already"},
      RefusedEdit{"locked", RemovePiece{"Nose"}, "locked"},
      RefusedEdit{"moves locked", ChangePiece{.name = "Nose", .placement = Placement{}}, "locked"},
      RefusedEdit{"nowhere", ChangePiece{.name = "Head", .placement = nowhere}, "quaternion"},
      RefusedEdit{"far", ChangePiece{.name = "Head", .placement = far}, "1 km"},
      RefusedEdit{"renamed", ChangePiece{.name = "Head", .new_name = "Nose"}, "already"},
      RefusedEdit{"merged locked", MergePiece{"Head", "Nose"}, "locked"},
      RefusedEdit{"itself", MergePiece{"Head", "Head", CombineKind::unite, true}, "itself"}};
}

TEST(Sculpture, RefusedEditsLeaveEverythingAsItWas) {
  Sculpture sculpture = head_with_nose();
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Nose", .is_locked = true}));
  const std::uint64_t hash = sculpture.hash();
  const int depth = sculpture.undo_depth();
  for (const RefusedEdit& refused : refused_edits()) {
    SCOPED_TRACE(refused.what);
    const auto done = sculpture.apply(refused.edit);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(done.error().message, HasSubstr(refused.message));
    EXPECT_EQ(sculpture.hash(), hash);
    EXPECT_EQ(sculpture.undo_depth(), depth);
  }
}

TEST(Sculpture, LastPieceStays) {
  Sculpture sculpture(small_ball());
  const auto removed = sculpture.apply(RemovePiece{"Clay"});
  ASSERT_FALSE(removed);
  EXPECT_THAT(removed.error().message, HasSubstr("last one"));
}

TEST(Sculpture, RefusesEditsWhileAStrokeIsOpen) {
  Sculpture sculpture = head_with_nose();
  ASSERT_TRUE(sculpture.clay().begin_stroke(dab_on_piece(1).tool));
  EXPECT_FALSE(sculpture.apply(SelectPiece{"Head"}));
  EXPECT_FALSE(sculpture.undo());
  sculpture.clay().cancel_stroke();
  EXPECT_TRUE(sculpture.apply(SelectPiece{"Head"}));
}

TEST(Sculpture, FindsNamesThatAreFree) {
  Sculpture sculpture = head_with_nose();
  EXPECT_EQ(sculpture.free_name("Ear"), "Ear");
  EXPECT_EQ(sculpture.free_name("Nose"), "Nose 2");
  ASSERT_TRUE(sculpture.apply(ball_piece("Nose 2", {})));
  EXPECT_EQ(sculpture.free_name("Nose"), "Nose 3");
  // A name of full length keeps room for its number and is not cut within a letter.
  const std::string umlauts = "a" + [] {
    std::string text;
    for (int n = 0; n < 31; ++n) text += "\xC3\xA4";
    return text;
  }();
  ASSERT_TRUE(sculpture.apply(ball_piece(umlauts, {})));
  const std::string free = sculpture.free_name(umlauts);
  EXPECT_TRUE(validate_look({.name = free}));
  EXPECT_THAT(free, testing::EndsWith(" 2"));
}

TEST(SculptureCopy, HasTheBitsOfTheSculptureThatWentOn) {
  for (const std::size_t leaves : {1U, 50U, 100000U}) {
    Sculpture sculpture = head_with_nose();
    SculptureCopy copy(sculpture);
    unsigned n = 0;
    for (; !copy.advance(sculpture, leaves) && n < 400; ++n) {
      ASSERT_TRUE(sculpture.apply(SelectPiece{n % 5 < 2 ? "Head" : "Nose"}));
      ASSERT_TRUE(sculpture.clay().apply(dab_on_piece(n)));
      // Another list of pieces, another look.
      if (n == 3) {
        ASSERT_TRUE(sculpture.apply(ball_piece("Ear", {5.0, 0.0, 0.0})));
      }
      if (n == 4) {
        ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Ear", .is_visible = false}));
      }
    }
    EXPECT_EQ(std::move(copy).take().hash(), sculpture.hash()) << n << " strokes meanwhile";
  }
}

TEST(Sculpture, OfRefusesWhatCannotBe) {
  const auto made = [](std::vector<std::string> names, std::size_t active) {
    std::vector<Sculpture::ReadyPiece> pieces;
    for (std::string& name : names) pieces.push_back({{.name = std::move(name)}, small_ball()});
    return Sculpture::of(std::move(pieces), active).ok();
  };
  EXPECT_TRUE(made({"A", "B"}, 1));
  EXPECT_FALSE(made({}, 0));
  EXPECT_FALSE(made({"A", "B"}, 2));
  EXPECT_FALSE(made({"A", "A"}, 0));
  EXPECT_FALSE(made({"A", ""}, 0));
}

}  // namespace
}  // namespace argil
