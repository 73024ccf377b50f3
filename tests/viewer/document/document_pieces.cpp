// SPDX-License-Identifier: GPL-3.0-or-later
// Sculptures of several pieces on the document's thread: what is asked in the sculpture's frame is
// done in that of the piece, and what only moves is no news for a renderer.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/assembly.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"

#include "picture/piece_frame.h"
#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

class DocumentPiecesTest : public DocumentThreadTest {
 protected:
  /// A ball of 20 mm, another beside it, and the first is the active one again.
  void open_two() {
    thread_.send(NewClay{ball(20.0)});
    thread_.send(AddBallPiece{});
    edit(SelectPiece{"Clay"});
    settle_all();
  }
  void edit(const PieceEdit& step) { thread_.send(DoStep{step}); }
  void place(const std::string& name, const Placement& placement) {
    ChangePiece change{name};
    change.placement = placement;
    edit(change);
  }
  const PieceState& piece(const std::string& name) {
    state_ = thread_.state();
    const auto& all = state_.pieces->pieces;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const PieceState& p) { return p.look.name == name; });
    EXPECT_NE(found, all.end()) << name;
    return found == all.end() ? all.front() : *found;
  }
  std::string active() {
    state_ = thread_.state();
    return state_.pieces->active_piece().look.name;
  }
  Sculpture saved() {
    thread_.send(SaveProjectAs{folder_ / "p.vdb"});
    settle_all();
    return io::load_sculpture(folder_ / "p.vdb").value();
  }
  PointerAnswer asked(const Ray& ray) {
    thread_.ask(ray);
    settle_all();
    return thread_.answer().value();
  }

  /// What a view from the front shows to the right of the middle.
  static OutlineTrim right_half() {
    const double half = std::sqrt(0.5);
    const ViewFrame view{{0.0, -100.0, 0.0}, {half, half, 0.0, 0.0}, true};
    return {view, {{{0.0, -90.0}, {90.0, -90.0}, {90.0, 90.0}, {0.0, 90.0}}}, false};
  }

  const Placement turned_place_{{3.0, -7.0, 11.0}, normalized(Quat{0.6, 0.3, -0.5, 0.4})};
  ClayState state_;
};

TEST_F(DocumentPiecesTest, AStrokeOnATurnedPieceLandsWhereThePointerWas) {
  thread_.send(NewClay{ball(20.0)});
  place("Clay", turned_place_);
  settle_all();
  Stroke own;
  own.tool = small_tool();
  for (int n = 0; n <= 10; ++n) {
    own.samples.push_back(at(0.01 * n, {-4.0 + 0.8 * n, 0.0, 20.0}));
  }
  thread_.send(BeginStroke{own.tool, {}});
  for (const StrokeSample& sample : own.samples) {
    StrokeSample seen = sample;
    seen.position_mm = placed(turned_place_, sample.position_mm);
    seen.orientation = turned_place_.orientation;
    thread_.send(ExtendStroke{{seen}, 0.0});
  }
  thread_.send(EndStroke{});
  const Sculpture sculpture = saved();
  Clay wanted = Clay::ball(20.0, {}).value();
  ASSERT_TRUE(wanted.apply(own).ok());
  // There and back again rounds, and whether a leaf stays fine may depend on it: the same surface
  // to a twentieth of a voxel.
  for (int n = 0; n < 400; ++n) {
    const Vec3 p{-6.0 + 0.03 * n, 1.5 * std::sin(n), 20.0 + 2.0 * std::cos(0.7 * n)};
    const double distance = wanted.distance_at(p);
    if (std::abs(distance) > 0.4) continue;
    EXPECT_NEAR(sculpture.clay().distance_at(p), distance, 0.02);
  }
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentPiecesTest, ThePointerFindsTheNearestPieceAndTheActiveOneAtItsPlace) {
  open_two();
  const Vec3 beside = piece("Ball").look.placement.position_mm;
  const PointerAnswer on_active = asked({{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}});
  ASSERT_TRUE(on_active.pick);
  EXPECT_NEAR(on_active.pick->point_mm.y, -20.0, 0.05);
  const PointerAnswer on_other = asked({{beside.x, -100.0, beside.z}, {0.0, 1.0, 0.0}});
  EXPECT_FALSE(on_other.pick);
  EXPECT_EQ(on_other.other, "Ball");
  thread_.send(SelectPieceAt{on_other.ray});
  settle_all();
  EXPECT_EQ(active(), "Ball");
  const PointerAnswer now = asked(on_other.ray);
  ASSERT_TRUE(now.pick);
  EXPECT_EQ(now.piece, piece("Ball").key);
  EXPECT_EQ(now.placement.position_mm, beside) << "where a device would meet it";
  EXPECT_NEAR(now.pick->point_mm.y, beside.y - 40.0 / 6.0, 0.1);
  EXPECT_LT(length(now.pick->normal - Vec3{0.0, -1.0, 0.0}), 0.05);
  // From the other side the first one is in front of it.
  EXPECT_EQ(asked({{-100.0, 0.0, beside.z}, {1.0, 0.0, 0.0}}).other, "Clay");
}

TEST_F(DocumentPiecesTest, WhatOnlyMovesOrChangesLooksSendsNoBlocks) {
  open_two();
  Tool mask = small_tool();
  mask.action = Action::mask;
  stroke({20.0, -3.0, 0.0}, {20.0, 3.0, 0.0}, mask);
  settle_all();
  place("Clay", turned_place_);
  ChangePiece look{"Clay"};
  look.new_name = "Body";
  look.color = std::optional<std::optional<Rgb8>>(Rgb8{1, 2, 3});
  edit(look);
  edit(SelectPiece{"Ball"});
  thread_.send(DoStep{io::HistoryStep::undo});
  thread_.send(DoStep{io::HistoryStep::undo});
  thread_.send(DoStep{io::HistoryStep::redo});
  EXPECT_TRUE(settle_all().empty());
  EXPECT_EQ(piece("Clay").look.placement.position_mm, turned_place_.position_mm);
  // A stroke on one sends blocks of that one.
  const Vec3 ball = piece("Ball").look.placement.position_mm;
  const Vec3 top = ball + Vec3{0.0, 0.0, 40.0 / 6.0};
  stroke(top - Vec3{2.0, 0.0, 0.0}, top + Vec3{2.0, 0.0, 0.0});
  const SceneNews news = settle_all();
  ASSERT_EQ(news.pieces.size(), 1U);
  EXPECT_EQ(news.pieces.begin()->first, piece("Ball").key);
  EXPECT_FALSE(news.pieces.begin()->second.is_fresh);
}

TEST_F(DocumentPiecesTest, TheListIsUndoneAndRedoneStepByStep) {
  open_two();
  thread_.send(DuplicatePiece{});
  settle_all();
  EXPECT_EQ(active(), "Clay 2");
  edit(RemovePiece{"Ball"});
  edit(MergePiece{"Clay 2", "Clay", CombineKind::intersect, false});
  const SceneNews news = settle_all();
  EXPECT_EQ(news.gone.size(), 2U);
  EXPECT_EQ(thread_.state().pieces->pieces.size(), 1U);
  const std::vector<std::string> names{"Ball added", "Clay duplicated", "Ball removed",
                                       "Clay 2 cut to Clay"};
  EXPECT_EQ(thread_.state().steps->names, names);
  for (int n = 0; n < 3; ++n) thread_.send(DoStep{io::HistoryStep::undo});
  const SceneNews back = settle_all();
  EXPECT_EQ(thread_.state().pieces->pieces.size(), 2U);
  EXPECT_EQ(active(), "Clay");
  std::set<PieceKey> here;
  for (const PieceState& piece : thread_.state().pieces->pieces) here.insert(piece.key);
  for (const auto& [key, blocks] : back.pieces) EXPECT_TRUE(here.contains(key));
  EXPECT_EQ(back.pieces.size(), 2U) << "both came back, and all of their blocks are sent";
  for (int n = 0; n < 3; ++n) thread_.send(DoStep{io::HistoryStep::redo});
  settle_all();
  EXPECT_EQ(thread_.state().pieces->pieces.size(), 1U);
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentPiecesTest, APieceStandsOnTheBedWithItsLowestPoint) {
  thread_.send(NewClay{{io::StartShape::Kind::block, {30.0, 20.0, 12.0}, {}}});
  place("Clay", turned_place_);
  thread_.send(StandPiece{StandPiece::Where::bed});
  thread_.send(StandPiece{StandPiece::Where::middle});
  const Sculpture sculpture = saved();
  TriangleMesh mesh = extract_surface(sculpture.clay());
  argil::place(sculpture.look(0).placement, mesh);
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  EXPECT_NEAR(box.min.z, 0.0, 1e-9);
  EXPECT_NEAR(box.center().x, 0.0, 1e-9);
  EXPECT_NEAR(box.center().y, 0.0, 1e-9);
  EXPECT_EQ(sculpture.look(0).placement.orientation, turned_place_.orientation);
  const auto steps = thread_.state().steps->names.size();
  thread_.send(StandPiece{StandPiece::Where::middle});
  settle_all();
  EXPECT_EQ(thread_.state().steps->names.size(), steps) << "it stands there already";
}

TEST_F(DocumentPiecesTest, APieceIsLaidOnTheLargestSideThatItCanRestOn) {
  thread_.send(NewClay{{io::StartShape::Kind::block, {30.0, 20.0, 12.0}, {}}});
  place("Clay", turned_place_);
  thread_.send(StandPiece{StandPiece::Where::flat});
  const Sculpture sculpture = saved();
  TriangleMesh mesh = extract_surface(sculpture.clay());
  argil::place(sculpture.look(0).placement, mesh);
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  EXPECT_NEAR(box.min.z, 0.0, 1e-9);
  EXPECT_NEAR(box.size().z, 12.0, 0.02);
  const auto steps = thread_.state().steps->names.size();
  thread_.send(StandPiece{StandPiece::Where::flat});
  settle_all();
  EXPECT_EQ(thread_.state().steps->names.size(), steps) << "it lies so already";
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentPiecesTest, AllPiecesDropToTheBedTogether) {
  open_two();
  place("Clay", {{0.0, 0.0, 50.0}, {}});
  place("Ball", {{40.0, 0.0, 90.0}, {}});
  thread_.send(StandPiece{StandPiece::Where::all_on_bed});
  settle_all();
  EXPECT_NEAR(piece("Clay").look.placement.position_mm.z, 20.0, 0.02);
  EXPECT_EQ(thread_.state().steps->names.back(), "2 pieces moved");
  thread_.send(DoStep{io::HistoryStep::undo});
  settle_all();
  EXPECT_EQ(piece("Clay").look.placement.position_mm.z, 50.0) << "all of it in one step";
  EXPECT_EQ(piece("Ball").look.placement.position_mm.z, 90.0);
  thread_.send(DoStep{io::HistoryStep::redo});
  settle_all();
  EXPECT_NEAR(
      piece("Ball").look.placement.position_mm.z - piece("Clay").look.placement.position_mm.z, 40.0,
      1e-9);
  // What is hidden stays, and what is locked is not torn from the others.
  ChangePiece lock{"Ball"};
  lock.is_locked = true;
  edit(lock);
  place("Clay", {{0.0, 0.0, 70.0}, {}});
  thread_.send(StandPiece{StandPiece::Where::all_on_bed});
  settle_all();
  EXPECT_EQ(piece("Clay").look.placement.position_mm.z, 70.0);
  const std::vector<std::string> told = errors();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("'Ball' is locked"), std::string::npos) << told[0];
  ChangePiece hide{"Ball"};
  hide.is_visible = false;
  edit(hide);
  thread_.send(StandPiece{StandPiece::Where::all_on_bed});
  settle_all();
  EXPECT_NEAR(piece("Clay").look.placement.position_mm.z, 20.0, 0.02);
}

/// The hand of a device asks for the piece's number as soon as undo has brought it back, before the
/// window was told of it.
TEST_F(DocumentPiecesTest, APieceThatComesBackHasTheNumberThatItHad) {
  open_two();
  edit(SelectPiece{"Ball"});
  settle_all();
  const PieceKey ball = piece("Ball").key;
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayHeartbeat heartbeat;
  thread_.send(LinkHaptics{&ring, &channel, &heartbeat, small_tool(), {}, ball});
  edit(RemovePiece{"Ball"});
  settle_all();
  thread_.send(DoStep{io::HistoryStep::undo});
  settle_all();
  EXPECT_EQ(active(), "Ball");
  EXPECT_EQ(piece("Ball").key, ball) << "or what was measured on it is lost";
  thread_.send(UnlinkHaptics{});
  settle_all();
}

/// Of another size it is the same piece, in one step, with all its blocks sent anew.
TEST_F(DocumentPiecesTest, AScaledPieceIsAsLargeAsWasAskedAndStandsWhereItStood) {
  thread_.send(NewClay{{io::StartShape::Kind::block, {30.0, 20.0, 12.0}, {}}});
  place("Clay", {{5.0, 0.0, 6.0}, {}});
  settle_all();
  state_ = thread_.state();
  EXPECT_NEAR(state_.surface_mm.size().x, 30.0, 0.02);
  EXPECT_NEAR(state_.surface_mm.size().z, 12.0, 0.02);
  const PieceKey key = piece("Clay").key;
  edit(ScalePiece{"Clay", 0.5, Vec3{5.0, 0.0, 0.0}});
  EXPECT_FALSE(settle_all().pieces.at(key).changed.empty());
  state_ = thread_.state();
  EXPECT_EQ(state_.steps->names.back(), "Clay scaled to 50 %");
  EXPECT_EQ(piece("Clay").key, key);
  EXPECT_NEAR(state_.surface_mm.size().x, 15.0, 0.02);
  EXPECT_EQ(state_.voxel_mm, 0.125);
  const Vec3 at = piece("Clay").look.placement.position_mm;
  EXPECT_EQ(at, (Vec3{5.0, 0.0, 3.0})) << "its foot stayed";
  // A stroke lands where the pointer is, and undo leads back.
  thread_.send(DoStep{io::HistoryStep::undo});
  settle_all();
  EXPECT_NEAR(thread_.state().surface_mm.size().x, 30.0, 0.02);
  EXPECT_EQ(thread_.state().voxel_mm, 0.25);
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentPiecesTest, APieceIsSplitIntoItsPartsInOneStep) {
  open_two();
  edit(MergePiece{"Clay", "Ball"});
  edit(SplitPiece{"Clay"});
  settle_all();
  state_ = thread_.state();
  ASSERT_EQ(state_.pieces->pieces.size(), 2U);
  EXPECT_EQ(state_.pieces->pieces[1].look.name, "Clay 2");
  EXPECT_EQ(active(), "Clay");
  EXPECT_EQ(state_.steps->names.back(), "Clay split");
  thread_.send(DoStep{io::HistoryStep::undo});
  const SceneNews back = settle_all();
  EXPECT_EQ(thread_.state().pieces->pieces.size(), 1U);
  EXPECT_EQ(back.gone.size(), 1U);
  EXPECT_TRUE(errors().empty());
  edit(SplitPiece{"Clay"});
  edit(SplitPiece{"Clay"});
  settle_all();
  const std::vector<std::string> told = errors();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("is one solid"), std::string::npos) << told[0];
}

TEST_F(DocumentPiecesTest, AHiddenPieceIsNotSculptedAndComesBackAsItIs) {
  open_two();
  ChangePiece hide{"Clay"};
  hide.is_visible = false;
  edit(hide);
  stroke({20.0, -3.0, 0.0}, {20.0, 3.0, 0.0});
  settle_all();
  const std::vector<std::string> told = errors();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("'Clay' is hidden"), std::string::npos) << told[0];
  EXPECT_LT(thread_.state().all_bounds_mm.size().x, 20.0) << "of the other alone";
  EXPECT_FALSE(asked({{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}}).pick);
  hide.is_visible = true;
  edit(hide);
  EXPECT_TRUE(settle_all().empty()) << "its blocks were kept";
}

TEST_F(DocumentPiecesTest, EscapeAfterARefusedStrokeTakesNothingBack) {
  open_two();
  stroke({20.0, -3.0, 0.0}, {20.0, 3.0, 0.0});
  ChangePiece lock{"Clay"};
  lock.is_locked = true;
  edit(lock);
  thread_.send(BeginStroke{small_tool(), {}});
  thread_.send(ExtendStroke{{at(0.0, {20.0, 0.0, 0.0})}, 0.0});
  thread_.send(CancelStroke{});
  settle_all();
  EXPECT_EQ(errors().size(), 1U) << "of the stroke";
  EXPECT_TRUE(piece("Clay").look.is_locked);
  const auto steps = thread_.state().steps;
  EXPECT_EQ(steps->done, steps->names.size());
}

TEST_F(DocumentPiecesTest, NothingIsDoneToAHiddenPieceNorMergedWithIt) {
  open_two();
  ChangePiece hide{"Clay"};
  hide.is_visible = false;
  edit(hide);
  settle_all();
  const auto steps = thread_.state().steps->names.size();
  const std::vector<Request> requests{DoStep{MaskEdit::fill},
                                      DoStep{Operation(Offset{1.0})},
                                      TrimPiece{right_half(), {}},
                                      DoStep{PieceEdit{MergePiece{"Ball", "Clay"}}},
                                      DoStep{PieceEdit{MergePiece{"Clay", "Ball"}}},
                                      DoStep{PieceEdit{ScalePiece{"Clay", 2.0}}},
                                      DoStep{PieceEdit{SplitPiece{"Clay"}}}};
  for (const Request& request : requests) thread_.send(request);
  settle_all();
  const std::vector<std::string> told = errors();
  EXPECT_EQ(told.size(), requests.size());
  for (const std::string& text : told) {
    EXPECT_NE(text.find("'Clay' is hidden"), std::string::npos) << text;
  }
  EXPECT_EQ(thread_.state().steps->names.size(), steps);
  thread_.send(DoStep{io::HistoryStep::undo});
  settle_all();
  EXPECT_TRUE(piece("Clay").look.is_visible) << "undo is for all";
}

TEST_F(DocumentPiecesTest, WhatWasMeantForAPieceIsNotDoneToAnother) {
  open_two();
  const PieceKey clay = piece("Clay").key;
  edit(SelectPiece{"Ball"});
  thread_.send(DoStep{MaskEdit::fill, clay});
  thread_.send(TrimPiece{right_half(), clay});
  thread_.send(CheckPath{{{100.0, 0.0, 0.0}, {110.0, 0.0, 0.0}}, clay});
  settle_all();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_FALSE(thread_.state().has_mask);
  edit(SelectPiece{"Clay"});
  thread_.send(DoStep{MaskEdit::fill, clay});
  settle_all();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(thread_.state().has_mask);
}

/// The window had not seen yet how far it grew.
TEST_F(DocumentPiecesTest, ATrimGoesThroughTheClayAsItIsByThen) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(DoStep{Operation(Offset{8.0})});
  thread_.send(TrimPiece{right_half(), {}});
  const Sculpture sculpture = saved();
  EXPECT_TRUE(errors().empty());
  for (const double y : {-27.0, -10.0, 10.0, 27.0}) {
    EXPECT_GT(sculpture.clay().distance_at({2.0, y, 0.0}), 0.0) << y;
    EXPECT_LT(sculpture.clay().distance_at({-2.0, y, 0.0}), 0.0) << y;
  }
}

TEST_F(DocumentPiecesTest, TheHandOfADeviceWaitsWhileAnotherPieceIsActive) {
  open_two();
  const PieceKey clay = piece("Clay").key;
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayHeartbeat heartbeat;
  thread_.send(LinkHaptics{&ring, &channel, &heartbeat, small_tool(), {}, clay});
  edit(SelectPiece{"Ball"});
  settle_all();
  const auto beats = [&] {
    const std::uint64_t before = heartbeat.beats.load();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return heartbeat.beats.load() - before;
  };
  EXPECT_EQ(beats(), 0U);
  edit(SelectPiece{"Clay"});
  settle_all();
  EXPECT_GT(beats(), 0U);
  thread_.send(UnlinkHaptics{});
  settle_all();
}

TEST_F(DocumentPiecesTest, ASinglePieceThatWasPlacedIsExportedWhereItStands) {
  thread_.send(NewClay{ball(20.0)});
  place("Clay", turned_place_);
  thread_.send(ExportMesh{folder_ / "one.3mf", {}});
  thread_.send(ExportMesh{folder_ / "one.stl", {}});
  settle_all();
  std::string told;
  for (const Notice& notice : thread_.take_notices()) told += notice.text + "\n";
  EXPECT_NE(told.find("in its own frame to 'one.stl'"), std::string::npos) << told;
  EXPECT_EQ(told.find("in its own frame to 'one.3mf'"), std::string::npos) << told;
  const auto read = io::read_assembly(folder_ / "one.3mf");
  ASSERT_TRUE(read.ok());
  const std::vector<io::PlacedPart> parts = io::placed_parts(read.value().assembly);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_LT(length(parts[0].to_mm.rows[3] - turned_place_.position_mm), 1e-4);
}

TEST_F(DocumentPiecesTest, VisiblePiecesAreExportedByNameWhereTheyStand) {
  open_two();
  ChangePiece change{"Ball"};
  change.new_name = "Nose";
  change.color = std::optional<std::optional<Rgb8>>(Rgb8{200, 30, 40});
  edit(change);
  thread_.send(DuplicatePiece{});
  ChangePiece hide{"Clay 2"};
  hide.is_visible = false;
  edit(hide);
  edit(SelectPiece{"Nose"});
  thread_.send(ExportMesh{folder_ / "all.3mf", {}});
  settle_all();
  EXPECT_TRUE(errors().empty());
  const auto read = io::read_assembly(folder_ / "all.3mf");
  ASSERT_TRUE(read.ok());
  const std::vector<io::PlacedPart> parts = io::placed_parts(read.value().assembly);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "Clay");
  EXPECT_EQ(parts[1].name, "Nose");
  EXPECT_LT(length(parts[1].to_mm.rows[3] - piece("Nose").look.placement.position_mm), 1e-4);
  EXPECT_EQ(read.value().assembly.objects[parts[1].object].color, (Rgb8{200, 30, 40}));
  const auto report = thread_.report();
  ASSERT_TRUE(report && report->exported);
  EXPECT_EQ(report->piece, piece("Nose").key);
  EXPECT_TRUE(report->verdict.printable);
}

TEST_F(DocumentPiecesTest, AMeshBecomesAnotherPieceByTheNameOfItsFile) {
  ASSERT_TRUE(
      io::write_mesh(folder_ / "Lid.stl", extract_surface(Clay::ball(5.0, {}).value())).ok());
  thread_.send(NewClay{ball(20.0)});
  thread_.send(ImportPiece{folder_ / "Lid.stl"});
  settle_all();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(active(), "Lid");
  EXPECT_NEAR(piece("Lid").bounds_mm.size().x, 10.0, 0.3);
  EXPECT_EQ(thread_.state().pieces_added, 1);
  thread_.send(DoStep{io::HistoryStep::undo});
  settle_all();
  EXPECT_EQ(active(), "Clay");
}

/// A table on one leg: what leans out is another side of it once it stands on its head.
TEST_F(DocumentPiecesTest, ATurnedPieceIsJudgedAsItStands) {
  thread_.send(NewClay{{io::StartShape::Kind::block, {30.0, 30.0, 4.0}, {}}});
  Tool leg = small_tool();
  leg.radii_mm = {3.0, 3.0, 3.0};
  stroke({0.0, 0.0, 1.0}, {0.0, 0.0, 14.0}, leg);
  mesh::Printer printer;
  printer.max_overhang_deg = 60.0;
  const auto overhang = [&] {
    thread_.send(CheckPrint{printer});
    settle_all();
    const auto report = thread_.report();
    return report ? std::count_if(report->verdict.problems.begin(), report->verdict.problems.end(),
                                  [](const mesh::MeshProblem& p) {
                                    return p.kind.find("overhang") != std::string::npos;
                                  })
                  : -1;
  };
  EXPECT_EQ(overhang(), 0);
  place("Clay", {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}});
  EXPECT_GT(overhang(), 0);
  for (const mesh::MeshProblem& problem : thread_.report()->verdict.problems) {
    if (problem.kind.find("overhang") == std::string::npos) continue;
    EXPECT_GT(problem.at_mm.z, 1.0) << "in the piece's own frame: its upper side";
  }
}

}  // namespace
}  // namespace argil::viewer
