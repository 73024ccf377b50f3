// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "gestures/measure_marks.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

constexpr double kMeasuredBallMm = 10.0;

// Between its nodes the stored distance to a ball of forty voxels is up to a fiftieth of a voxel
// off, and so is each point.

/// A ball of radius 10 about the origin, seen from the front, measured by the mouse.
class MeasureTest : public GesturesTest {
 protected:
  void SetUp() override {
    document_.send(NewClay{{io::StartShape::Kind::ball, {kMeasuredBallMm, 0.0, 0.0}, {}}});
    ui_.camera.resize(200, 200);
    ui_.camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
    Box3 box;
    box.include({-12.0, -12.0, -12.0});
    box.include({12.0, 12.0, 12.0});
    ui_.camera.frame(box);
    ui_.is_pointer_over_clay_view = true;
    settle();
    ASSERT_TRUE(ui_.clay.has_clay);
    voxel_ = ui_.clay.voxel_mm;
  }

  /// Frames until the document has done and told everything.
  void settle() {
    for (int quiet = 0; quiet < 3;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::vector<double> inputs;
      document_.take_blocks(inputs);
      ui_.clay = document_.state();
      gestures_.tick(0.0);
      quiet = document_.is_idle() ? quiet + 1 : 0;
    }
  }

  void click(const Camera::Pixel& pixel) {
    mouse_at(InputEvent::Kind::move, pixel);
    mouse_at(InputEvent::Kind::press, pixel);
    mouse_at(InputEvent::Kind::release, pixel);
    settle();
  }

  /// The front of the ball under a pixel.
  Vec3 on_ball(const Camera::Pixel& pixel) const {
    const Ray ray = ui_.camera.ray_at(pixel);
    const Vec3 d = normalized(ray.direction);
    const double b = dot(ray.origin_mm, d);
    const double c = dot(ray.origin_mm, ray.origin_mm) - kMeasuredBallMm * kMeasuredBallMm;
    return ray.origin_mm + (-b - std::sqrt(b * b - c)) * d;
  }

  double value(std::size_t n) const {
    const Measurement& of = ui_.measures.list.at(n);
    const auto places = places_of(of.points, ui_);
    return places ? measured(of.kind, *places) : -1.0;
  }

  double voxel_ = 0.0;
  const Camera::Pixel left_{60.0, 90.0};
  const Camera::Pixel right_{135.0, 120.0};
  const Camera::Pixel top_{100.0, 50.0};
};

TEST_F(MeasureTest, TwoClicksAreADistanceAndSoIsADrag) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  EXPECT_EQ(ui_.measures.begun.size(), 1U);
  EXPECT_TRUE(ui_.measures.list.empty());
  click(right_);
  ASSERT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_TRUE(ui_.measures.begun.empty());
  const double exact = length(on_ball(left_) - on_ball(right_));
  EXPECT_NEAR(value(0), exact, 0.02 * voxel_);
  mouse_at(InputEvent::Kind::move, top_);
  mouse_at(InputEvent::Kind::press, top_);
  mouse_at(InputEvent::Kind::move, {90.0, 90.0});
  mouse_at(InputEvent::Kind::release, {100.0, 150.0});
  settle();
  ASSERT_EQ(ui_.measures.list.size(), 2U);
  EXPECT_NEAR(value(1), length(on_ball(top_) - on_ball({100.0, 150.0})), 0.02 * voxel_);
  EXPECT_EQ(ui_.measures.chosen, 2) << "the newest";
  EXPECT_EQ(ui_.clay.strokes, 0) << "nothing was sculpted";
}

TEST_F(MeasureTest, ThreeClicksAreAnAngleAtTheSecond) {
  perform(Command::measure_angle, ui_, document_);
  click(left_);
  click(top_);
  click(right_);
  ASSERT_EQ(ui_.measures.list.size(), 1U);
  const Vec3 one = normalized(on_ball(left_) - on_ball(top_));
  const Vec3 other = normalized(on_ball(right_) - on_ball(top_));
  EXPECT_NEAR(value(0), std::acos(dot(one, other)) * 180.0 / 3.14159265358979, 0.02);
  EXPECT_EQ(measured(MeasureKind::angle, std::vector<Vec3>{{1.0, 0.0, 0.0}, {}, {0.0, 2.0, 0.0}}),
            90.0);
  EXPECT_EQ(measured(MeasureKind::angle, std::vector<Vec3>{{1.0, 0.0, 0.0}, {}, {-3.0, 0.0, 0.0}}),
            180.0);
}

TEST_F(MeasureTest, OneClickIsAThicknessThroughTheMiddleOfTheBall) {
  perform(Command::measure_thickness, ui_, document_);
  click(left_);
  ASSERT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_NEAR(value(0), 2.0 * kMeasuredBallMm, 0.05 * voxel_);
  EXPECT_EQ(ui_.measures.hover.size(), 2U) << "it is shown under the pointer as well";
}

TEST_F(MeasureTest, AnEndThatIsDraggedIsMeasuredAnewAndEscapePutsItBack) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  const double before = value(0);
  const auto drag = [&](bool lets_go) {
    mouse_at(InputEvent::Kind::move, {right_.x + 3.0, right_.y - 2.0});
    EXPECT_EQ(ui_.measures.under, (MeasureEnd{1, 1}));
    mouse_at(InputEvent::Kind::press, {right_.x + 3.0, right_.y - 2.0});
    mouse_at(InputEvent::Kind::move, {120.0, 80.0});
    mouse_at(InputEvent::Kind::move, top_);
    settle();
    EXPECT_NEAR(value(0), length(on_ball(left_) - on_ball(top_)), 0.02 * voxel_) << "while held";
    if (lets_go) mouse_at(InputEvent::Kind::release, top_);
  };
  drag(false);
  key(kKeyEscape);
  EXPECT_EQ(value(0), before);
  EXPECT_TRUE(ui_.measures.tool) << "one thing at a time";
  mouse_at(InputEvent::Kind::release, top_);
  settle();
  EXPECT_EQ(value(0), before);
  drag(true);
  settle();
  ASSERT_EQ(ui_.measures.list.size(), 1U) << "no new one";
  EXPECT_NEAR(value(0), length(on_ball(left_) - on_ball(top_)), 0.02 * voxel_);
  // Beside the clay it stays where it was last.
  mouse_at(InputEvent::Kind::move, top_);
  mouse_at(InputEvent::Kind::press, top_);
  mouse_at(InputEvent::Kind::move, {3.0, 3.0});
  mouse_at(InputEvent::Kind::release, {3.0, 3.0});
  settle();
  EXPECT_NEAR(value(0), length(on_ball(left_) - on_ball(top_)), 0.02 * voxel_);
}

TEST_F(MeasureTest, AClickOnAnEndBeginsExactlyThere) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  perform(Command::measure_angle, ui_, document_);
  click({left_.x + 4.0, left_.y});
  ASSERT_EQ(ui_.measures.begun.size(), 1U);
  click(top_);
  click({right_.x, right_.y + 4.0});
  ASSERT_EQ(ui_.measures.list.size(), 2U);
  const auto& distance = ui_.measures.list[0].points;
  const auto& angle = ui_.measures.list[1].points;
  EXPECT_EQ(angle[0], distance[0]);
  EXPECT_EQ(angle[2], distance[1]);
}

/// The far end of a thickness is drawn over the front of the ball, faintly.
TEST_F(MeasureTest, AnEndBehindTheClayIsNotTaken) {
  perform(Command::measure_thickness, ui_, document_);
  click(left_);
  const auto places = places_of(ui_.measures.list.at(0).points, ui_);
  ASSERT_TRUE(places);
  const Camera::Pixel far = ui_.camera.pixel_of((*places)[1]);
  perform(Command::measure_distance, ui_, document_);
  settle();
  click(far);
  click(top_);
  ASSERT_EQ(ui_.measures.list.size(), 2U);
  EXPECT_NEAR(value(1), length(on_ball(far) - on_ball(top_)), 0.03 * voxel_);
}

TEST_F(MeasureTest, InParallelFromBehindAndNearItIsHiddenToo) {
  ui_.camera.set_parallel(true);
  perform(Command::measure_distance, ui_, document_);
  click({97.0, 98.0});
  click({103.0, 102.0});
  for (int n = 0; n < 14; ++n) ui_.camera.zoom(1.15, {100.0, 100.0});
  settle();
  const auto marks = [&] { return measure_marks(ui_, parts_of(ui_.camera, false)[0]); };
  ASSERT_EQ(marks().labels.size(), 1U);
  EXPECT_TRUE(marks().labels[0].is_seen);
  ui_.camera.look_from({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  settle();
  ASSERT_EQ(marks().labels.size(), 1U);
  EXPECT_FALSE(marks().labels[0].is_seen) << "all of the ball lies before it";
}

/// Whatever the pointer was over in the frame before.
TEST_F(MeasureTest, AThicknessInASliceIsThatOfTheVeryPlace) {
  SlicePicture slice{{-12.0, 0.0, 12.0}, {24.0, 0.0, 0.0}, {0.0, 0.0, -24.0}, 193, 193, {}};
  for (int row = 0; row < slice.rows; ++row) {
    for (int column = 0; column < slice.columns; ++column) {
      const double x = -12.0 + column / 8.0;
      const double z = 12.0 - row / 8.0;
      slice.distance_mm.push_back(static_cast<float>(std::hypot(x, z) - kMeasuredBallMm));
    }
  }
  ui_.measures.slice = &slice;
  ui_.measures.seen = SeenHalf{{0.0, 1.0, 0.0}, 0.0};
  ui_.chord = Chord{{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  perform(Command::measure_thickness, ui_, document_);
  click(left_);
  ASSERT_EQ(ui_.measures.list.size(), 1U);
  const Ray ray = ui_.camera.ray_at(left_);
  const Vec3 at = ray.origin_mm - (ray.origin_mm.y / ray.direction.y) * ray.direction;
  const double across = 2.0 * std::sqrt(kMeasuredBallMm * kMeasuredBallMm - dot(at, at));
  EXPECT_NEAR(value(0), across, 0.02);  // of 60 directions none may be the shortest
}

TEST_F(MeasureTest, ASlipOfTheHandMakesNoFurtherPoint) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  mouse_at(InputEvent::Kind::move, right_);
  mouse_at(InputEvent::Kind::press, right_);
  mouse_at(InputEvent::Kind::move, {right_.x + 15.0, right_.y + 5.0});
  mouse_at(InputEvent::Kind::release, {right_.x + 15.0, right_.y + 5.0});
  settle();
  EXPECT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_TRUE(ui_.measures.begun.empty());
  // Nor does a double click.
  click(top_);
  click({top_.x + 1.0, top_.y});
  EXPECT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_EQ(ui_.measures.begun.size(), 1U);
  const MeasureMarks marks = measure_marks(ui_, parts_of(ui_.camera, false)[0]);
  EXPECT_EQ(marks.labels.size(), 1U) << "and no number of a line that is none";
}

TEST_F(MeasureTest, ANumberStaysInThePictureWithWhatIsSeenOfItsLine) {
  perform(Command::measure_distance, ui_, document_);
  click({50.0, 100.0});
  click({150.0, 100.0});
  ui_.camera.pan(-90.0, 0.0);
  settle();
  const MeasureMarks marks = measure_marks(ui_, parts_of(ui_.camera, false)[0]);
  ASSERT_EQ(marks.labels.size(), 1U);
  EXPECT_LT(marks.dots[0].at.x, 0.0) << "one end is outside";
  EXPECT_NEAR(marks.labels[0].at.x, 0.5 * marks.dots[1].at.x, 2.0) << "the middle of what is left";
  ui_.camera.pan(-90.0, 0.0);
  EXPECT_TRUE(measure_marks(ui_, parts_of(ui_.camera, false)[0]).labels.empty());
}

TEST_F(MeasureTest, NumbersDoNotLieOverEachOther) {
  perform(Command::measure_distance, ui_, document_);
  for (const double by : {0.0, 12.0, 24.0}) {
    click({60.0, 90.0 + by});
    click({140.0, 90.0 + by});
  }
  const MeasureMarks marks = measure_marks(ui_, parts_of(ui_.camera, false)[0]);
  ASSERT_EQ(marks.labels.size(), 3U);
  for (std::size_t n = 1; n < 3; ++n) {
    EXPECT_GT(std::abs(marks.labels[n].at.y - marks.labels[n - 1].at.y), 20.0);
  }
}

TEST_F(MeasureTest, WhatIsChosenInTheListIsDeletedWithoutTheTool) {
  perform(Command::measure_thickness, ui_, document_);
  click(left_);
  document_.send(AddBallPiece{});
  settle();
  key(kKeyEscape);
  ASSERT_FALSE(ui_.measures.tool);
  ui_.measures.chosen = 1;  // as a click in the list does
  key(kKeyDelete);
  settle();
  EXPECT_TRUE(ui_.measures.list.empty());
  EXPECT_EQ(ui_.clay.pieces->pieces.size(), 2U);
  key(kKeyDelete);
  settle();
  EXPECT_EQ(ui_.clay.pieces->pieces.size(), 1U) << "now it is the piece";
}

TEST_F(MeasureTest, DeleteRemovesWhatIsChosenAndNoPiece) {
  perform(Command::measure_thickness, ui_, document_);
  click(left_);
  click(right_);
  ASSERT_EQ(ui_.measures.list.size(), 2U);
  key(kKeyDelete);
  ASSERT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_EQ(ui_.measures.list[0].number, 1);
  document_.send(AddBallPiece{});
  settle();
  ASSERT_EQ(ui_.clay.pieces->pieces.size(), 2U);
  key(kKeyDelete);  // nothing is chosen
  settle();
  EXPECT_EQ(ui_.measures.list.size(), 1U);
  EXPECT_EQ(ui_.clay.pieces->pieces.size(), 2U);
  perform(Command::measure_distance, ui_, document_);
  click(top_);
  ASSERT_EQ(ui_.measures.begun.size(), 1U);
  key(kKeyDelete);
  EXPECT_TRUE(ui_.measures.begun.empty());
  perform(Command::measure_clear, ui_, document_);
  EXPECT_TRUE(ui_.measures.list.empty());
}

TEST_F(MeasureTest, EscapeGivesUpWhatWasBegunAndThenLeavesTheTool) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  click(top_);
  key(kKeyEscape);
  EXPECT_TRUE(ui_.measures.begun.empty());
  EXPECT_TRUE(ui_.measures.tool);
  ui_.panels.has_help = true;
  key(kKeyEscape);
  EXPECT_FALSE(ui_.panels.has_help);
  EXPECT_TRUE(ui_.measures.tool);
  key(kKeyEscape);
  EXPECT_FALSE(ui_.measures.tool);
  EXPECT_EQ(ui_.measures.list.size(), 1U) << "it stays in the picture";
  click({100.0, 140.0});
  EXPECT_EQ(ui_.clay.strokes, 1) << "the brush works again";
}

TEST_F(MeasureTest, AMeasurementGoesWithItsPieceAndIsOfOneClayAlone) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  const double before = value(0);
  ChangePiece change{ui_.clay.pieces->active_piece().look.name};
  change.placement = Placement{{3.0, 4.0, 5.0}, normalized(Quat{0.9, 0.1, 0.3, 0.0})};
  document_.send(DoStep{PieceEdit{change}});
  settle();
  EXPECT_NEAR(value(0), before, 1e-9);
  const auto places = places_of(ui_.measures.list[0].points, ui_);
  ASSERT_TRUE(places);
  EXPECT_LT(length((*places)[0] - placed(*change.placement, on_ball(left_))), 0.03 * voxel_);
  ChangePiece hide{change.name};
  hide.is_visible = false;
  document_.send(DoStep{PieceEdit{hide}});
  settle();
  EXPECT_FALSE(places_of(ui_.measures.list[0].points, ui_));
  EXPECT_TRUE(measure_marks(ui_, parts_of(ui_.camera, false)[0]).labels.empty());
  document_.send(NewClay{{io::StartShape::Kind::ball, {5.0, 0.0, 0.0}, {}}, false});
  settle();
  EXPECT_TRUE(ui_.measures.list.empty());
}

TEST_F(MeasureTest, ANumberIsMarkedWhileTheClayUnderItIsNotAsItWas) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  perform(Command::measure_thickness, ui_, document_);
  click(top_);
  ASSERT_EQ(ui_.measures.list.size(), 2U);
  EXPECT_TRUE(is_current(ui_.measures.list[0]));
  const auto carve = [&](const Vec3& place, Action action) {
    Tool tool;
    tool.action = action;
    tool.radii_mm = {2.0, 2.0, 2.0};
    document_.send(BeginStroke{tool, {}});
    document_.send(ExtendStroke{{{0.0, place, {}, 1.0}}, 0.0});
    document_.send(EndStroke{});
    settle();
  };
  carve(on_ball(right_), Action::carve);
  EXPECT_FALSE(is_current(ui_.measures.list[0]));
  EXPECT_TRUE(is_current(ui_.measures.list[1])) << "of other clay";
  const auto labels = measure_marks(ui_, parts_of(ui_.camera, false)[0]).labels;
  EXPECT_EQ(std::count_if(labels.begin(), labels.end(),
                          [](const MeasureLabel& label) { return label.text.ends_with(" ?"); }),
            1);
  document_.send(DoStep{io::HistoryStep::undo});
  settle();
  EXPECT_TRUE(is_current(ui_.measures.list[0]));
  carve(on_ball(left_), Action::add);  // covered
  EXPECT_FALSE(is_current(ui_.measures.list[0]));
}

TEST_F(MeasureTest, AMeasurementComesBackWithItsPieceButNotWithAnotherOne) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  const double before = value(0);
  const std::string name = ui_.clay.pieces->active_piece().look.name;
  document_.send(AddBallPiece{});
  document_.send(DoStep{PieceEdit{RemovePiece{name}}});
  settle();
  EXPECT_FALSE(places_of(ui_.measures.list.at(0).points, ui_));
  document_.send(DoStep{io::HistoryStep::undo});
  settle();
  EXPECT_EQ(value(0), before);
  document_.send(DoStep{io::HistoryStep::redo});
  settle();
  EXPECT_FALSE(places_of(ui_.measures.list.at(0).points, ui_));
  // Another piece of that name.
  ChangePiece rename{ui_.clay.pieces->active_piece().look.name};
  rename.new_name = name;
  document_.send(DoStep{PieceEdit{rename}});
  settle();
  EXPECT_FALSE(places_of(ui_.measures.list.at(0).points, ui_));
}

TEST_F(MeasureTest, AToolOfTheBrushLeavesTheOneThatMeasures) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  key('C');
  EXPECT_FALSE(ui_.measures.tool);
  EXPECT_TRUE(ui_.measures.begun.empty());
  EXPECT_EQ(ui_.brush.action, Action::carve);
  perform(Command::measure_distance, ui_, document_);
  EXPECT_TRUE(ui_.measures.tool);
  perform(Command::measure_distance, ui_, document_);
  EXPECT_FALSE(ui_.measures.tool) << "a second time leaves it";
}

TEST_F(MeasureTest, LabelsStandBesideTheirLineAndAreLighterBehindTheClay) {
  perform(Command::measure_distance, ui_, document_);
  click(left_);
  click(right_);
  mouse_at(InputEvent::Kind::move, {3.0, 3.0});
  settle();
  const auto marks = [&] { return measure_marks(ui_, parts_of(ui_.camera, false)[0]); };
  ASSERT_EQ(marks().labels.size(), 1U);
  ASSERT_EQ(marks().dots.size(), 2U);
  const MeasureLabel near = marks().labels[0];
  EXPECT_TRUE(near.is_seen);
  EXPECT_EQ(near.text, measured_text(MeasureKind::distance, value(0)));
  EXPECT_NEAR(marks().dots[1].at.x, right_.x, 0.1);
  const double beside =
      std::hypot(near.at.x - 0.5 * (left_.x + right_.x), near.at.y - 0.5 * (left_.y + right_.y));
  EXPECT_GT(beside, 10.0);
  EXPECT_LT(beside, 45.0);
  ui_.camera.zoom(0.5, {100.0, 100.0});
  settle();
  const MeasureMarks far = marks();
  const double farther =
      std::hypot(far.labels[0].at.x - 0.5 * (far.dots[0].at.x + far.dots[1].at.x),
                 far.labels[0].at.y - 0.5 * (far.dots[0].at.y + far.dots[1].at.y));
  EXPECT_NEAR(farther, beside, 3.0) << "whatever the distance";
  EXPECT_TRUE(far.labels[0].is_seen);
  ui_.camera.look_from({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  settle();
  ASSERT_EQ(marks().labels.size(), 1U);
  EXPECT_FALSE(marks().labels[0].is_seen);
  EXPECT_FALSE(marks().dots[0].is_seen);
}

TEST(MeasuredText, SaysItsUnitAndThreeDigitsAtLeast) {
  EXPECT_EQ(measured_text(MeasureKind::distance, 20.0), "20.00 mm");
  EXPECT_EQ(measured_text(MeasureKind::thickness, 0.4567), "0.457 mm");
  EXPECT_EQ(measured_text(MeasureKind::angle, 89.96), "90.0\u00b0");
}

}  // namespace
}  // namespace argil::viewer
