// SPDX-License-Identifier: GPL-3.0-or-later
// How a drag becomes a stroke: lines and curves over the picture, dots, and dabs that are dragged.
#include "commands/stroke_mode.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

using Pixel = Camera::Pixel;

TEST(StrokeLine, EndsAtThePointerOrInStepsOf15Degrees) {
  const Pixel from{10.0, 20.0};
  EXPECT_EQ(line_end(from, {50.0, 27.0}, false).y, 27.0);
  for (int n = 0; n < 48; ++n) {
    const double angle = 2.0 * std::numbers::pi * (n + 0.3) / 48.0;
    const Pixel end =
        line_end(from, {from.x + 30.0 * std::cos(angle), from.y + 30.0 * std::sin(angle)}, true);
    const double met = std::atan2(end.y - from.y, end.x - from.x) * 12.0 / std::numbers::pi;
    EXPECT_NEAR(met, std::round(met), 1e-9) << n;
    EXPECT_NEAR(std::hypot(end.x - from.x, end.y - from.y), 30.0, 1e-9) << "as far as the hand";
    EXPECT_LE(std::hypot(end.x - from.x - 30.0 * std::cos(angle),
                         end.y - from.y - 30.0 * std::sin(angle)),
              30.0 * 2.0 * std::sin(std::numbers::pi / 48.0) + 1e-9)
        << "the nearest";
  }
}

TEST(StrokeCurve, PassesThroughItsPointsSmoothlyAndStaysNearThem) {
  const std::vector<Pixel> points{{0, 0}, {100, 10}, {110, 90}, {20, 95}, {20, 95}, {60, 300}};
  const std::vector<Pixel> curve = curve_through(points);
  for (const Pixel& point : points) {
    double nearest = 1e9;
    for (const Pixel& on : curve)
      nearest = std::min(nearest, std::hypot(on.x - point.x, on.y - point.y));
    EXPECT_LT(nearest, 1e-9);
  }
  EXPECT_EQ(curve.front().x, 0.0);
  EXPECT_EQ(curve.back().y, 300.0);
  for (std::size_t n = 1; n + 1 < curve.size(); ++n) {
    const Pixel in{curve[n].x - curve[n - 1].x, curve[n].y - curve[n - 1].y};
    const Pixel out{curve[n + 1].x - curve[n].x, curve[n + 1].y - curve[n].y};
    const double turn = std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
    EXPECT_LT(std::abs(turn), 0.35) << "no corner at " << curve[n].x << " " << curve[n].y;
    EXPECT_LT(std::hypot(out.x, out.y), 7.0);
  }
  // A circle's points give the circle to a hundredth of its radius.
  std::vector<Pixel> circle;
  circle.reserve(13);
  for (int n = 0; n <= 12; ++n) {
    circle.push_back(
        {50.0 * std::cos(n * std::numbers::pi / 6), 50.0 * std::sin(n * std::numbers::pi / 6)});
  }
  const std::vector<Pixel> round = curve_through(circle);
  for (std::size_t n = round.size() / 4; n < 3 * round.size() / 4; ++n) {
    EXPECT_NEAR(std::hypot(round[n].x, round[n].y), 50.0, 0.5);
  }
  EXPECT_EQ(curve_through({{1, 1}, {5, 1}}).size(), 2U);
  EXPECT_EQ(curve_through({{1, 1}, {1, 1}}).size(), 1U);
  EXPECT_TRUE(curve_through({}).empty());
}

TEST(StrokeCurve, IsFollowedInSmallSteps) {
  const std::vector<Pixel> close = close_points({{0, 0}, {10, 0}, {10, 1}}, 3.0);
  ASSERT_EQ(close.size(), 6U);
  for (std::size_t n = 1; n < close.size(); ++n) {
    EXPECT_LE(std::hypot(close[n].x - close[n - 1].x, close[n].y - close[n - 1].y), 3.0);
  }
  EXPECT_EQ(close[4].x, 10.0);
}

/// A clay of its own behind the wall that the gestures see.
class StrokeModes : public GesturesTest {
 protected:
  StrokeModes() {
    document_.send(NewClay{{io::StartShape::Kind::block, {60.0, 60.0, 60.0}, {.voxel_mm = 1.0}}});
    settle();
    ui_.clay = document_.state();
    // The wall is the block's front.
    ui_.camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
    ui_.camera.set_target({0.0, -30.0, 0.0});
    ui_.camera.zoom(4.0, {32.0, 32.0});  // tools of a few voxels, which need no preview
    ui_.brush.action = Action::inflate;
    ui_.brush.radius_mm = 6.0;
  }
  void settle() {
    while (!document_.is_idle()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::vector<double> inputs;
      document_.take_blocks(inputs);
    }
  }
  /// What the clay holds then.
  ClayState done() {
    settle();
    return document_.state();
  }
  void drag(const std::vector<Pixel>& way) {
    mouse_at(InputEvent::Kind::press, way.front());
    for (const Pixel& at : way) mouse_at(InputEvent::Kind::move, at);
    mouse_at(InputEvent::Kind::release, way.back());
  }
};

TEST_F(StrokeModes, DotsAreADabForEachMove) {
  ui_.brush.stroke_mode = StrokeMode::dots;
  ui_.brush.hold_s = 0.01;
  mouse_at(InputEvent::Kind::press, {20, 32});
  for (int n = 0; n < 5; ++n) {
    gestures_.tick(1.0 + n);
    mouse_at(InputEvent::Kind::move, {20.0 + n, 32});
  }
  mouse_at(InputEvent::Kind::release, {24, 32});
  const ClayState state = done();
  EXPECT_EQ(state.dabs, 6);
  EXPECT_EQ(state.undo_depth, 1) << "one step to undo";
}

TEST_F(StrokeModes, ADragDotIsOneDabWhereTheHandLetGo) {
  ui_.brush.stroke_mode = StrokeMode::drag_dot;
  mouse_at(InputEvent::Kind::press, {20, 20});
  for (int n = 0; n < 8; ++n) {
    gestures_.tick(n);
    settle();
    mouse_at(InputEvent::Kind::move, {20.0 + 3.0 * n, 20.0 + 2.0 * n});
  }
  ASSERT_TRUE(gestures_.is_stroke_open());
  const Vec3 last = gestures_.tool_hit()->point_mm;
  mouse_at(InputEvent::Kind::release, pointer_);
  const ClayState state = done();
  EXPECT_EQ(state.undo_depth, 1);
  EXPECT_GT(state.dabs, 0);
  ASSERT_TRUE(state.steps);
  EXPECT_EQ(state.steps->names.size(), 1U);
  // As a stroke of that one dab.
  document_.send(DoStep{io::HistoryStep::undo});
  document_.send(BeginStroke{tool_of(ui_.brush, 6.0), style_of(ui_.brush)});
  document_.send(ExtendStroke{{sample_at(ui_.brush, 6.0, {last, {0, -1, 0}}, 0.0, 1.0)}, 0.0});
  document_.send(EndStroke{});
  const ClayState same = done();
  EXPECT_EQ(same.undo_depth, 1);
  EXPECT_EQ(same.bounds_mm.min, state.bounds_mm.min);
}

TEST_F(StrokeModes, EscapeTakesADraggedDabBackAndNothingElse) {
  drag({{20, 20}, {30, 20}});
  ASSERT_EQ(done().undo_depth, 1);
  for (const StrokeMode mode : {StrokeMode::drag_dot, StrokeMode::anchored}) {
    ui_.brush.stroke_mode = mode;
    for (const bool is_moved : {false, true}) {
      mouse_at(InputEvent::Kind::press, {20, 20});
      gestures_.tick(1.0);
      if (is_moved) {
        mouse_at(InputEvent::Kind::move, {40, 30});
        gestures_.tick(2.0);
        settle();
      }
      key(kKeyEscape);
      EXPECT_FALSE(gestures_.is_stroke_open());
      mouse_at(InputEvent::Kind::release, {40, 30});
      EXPECT_EQ(done().undo_depth, 1) << static_cast<int>(mode) << is_moved;
    }
  }
}

TEST_F(StrokeModes, AnAnchoredDabIsAsLargeAsTheDragAndTurnedWithIt) {
  ui_.brush.stroke_mode = StrokeMode::anchored;
  mouse_at(InputEvent::Kind::press, {32, 32});
  mouse_at(InputEvent::Kind::move, {33, 32});
  gestures_.tick(1.0);
  EXPECT_EQ(done().undo_depth, 0) << "too small to be meant";
  mouse_at(InputEvent::Kind::move, {42, 32});
  const double pixel_mm = ui_.camera.pixel_mm_at({0, -30, 0});
  EXPECT_NEAR(gestures_.tool_radius_mm(), 10.0 * pixel_mm, 0.3 * pixel_mm);
  mouse_at(InputEvent::Kind::release, {42, 32});
  EXPECT_EQ(done().undo_depth, 1);
  const SurfaceHit hit{{0, -30, 0}, {0, -1, 0}};
  Brush brush;
  brush.action = Action::inflate;
  for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{-3, 0, 4}}) {
    const StrokeSample sample = anchored_sample(brush, 5.0, hit, way, 0.7);
    EXPECT_LT(length(rotate(sample.orientation, {1, 0, 0}) - normalized(way)), 1e-9);
    EXPECT_LT(length(rotate(sample.orientation, {0, 0, 1}) - hit.normal), 1e-9);
    EXPECT_EQ(sample.position_mm, hit.point_mm);
    EXPECT_EQ(sample.pressure, 0.7);
  }
}

TEST_F(StrokeModes, ALineIsDrawnFirstAndThenTheStrokeOfAHandAlongIt) {
  ui_.brush.stroke_mode = StrokeMode::line;
  mouse_at(InputEvent::Kind::press, {12, 20});
  mouse_at(InputEvent::Kind::move, {30, 60});
  ASSERT_TRUE(ui_.guide);
  mouse_at(InputEvent::Kind::move, {52, 20});
  EXPECT_EQ(done().dabs, 0) << "nothing is on the clay yet";
  EXPECT_FALSE(gestures_.is_stroke_open());
  mouse_at(InputEvent::Kind::release, {52, 20});
  EXPECT_FALSE(ui_.guide);
  const ClayState line = done();
  EXPECT_EQ(line.undo_depth, 1);
  // The hand's own way between its first and last point does not matter.
  document_.send(DoStep{io::HistoryStep::undo});
  ui_.brush.stroke_mode = StrokeMode::space;
  std::vector<Pixel> straight;
  for (int x = 12; x <= 52; x += 2) straight.push_back({1.0 * x, 20});
  drag(straight);
  const ClayState hand = done();
  EXPECT_EQ(hand.undo_depth, 1);
  EXPECT_NEAR(static_cast<double>(hand.dabs - line.dabs), static_cast<double>(line.dabs), 2.0);
  // Given up, nothing happens.
  ui_.brush.stroke_mode = StrokeMode::line;
  mouse_at(InputEvent::Kind::press, {12, 20});
  mouse_at(InputEvent::Kind::move, {30, 60});
  key(kKeyEscape);
  mouse_at(InputEvent::Kind::release, {30, 60});
  EXPECT_FALSE(ui_.guide);
  EXPECT_EQ(done().undo_depth, 1);
}

TEST_F(StrokeModes, ACurveGoesThroughClickedPointsWithEnter) {
  ui_.brush.stroke_mode = StrokeMode::curve;
  for (const Pixel& at : {Pixel{12, 40}, Pixel{25, 20}, Pixel{40, 40}, Pixel{50, 12}}) {
    mouse_at(InputEvent::Kind::press, at);
    mouse_at(InputEvent::Kind::release, at);
  }
  ASSERT_TRUE(ui_.guide);
  ASSERT_EQ(ui_.guide->places_mm.size(), 4U);
  key(kKeyBackspace);
  EXPECT_EQ(ui_.guide->places_mm.size(), 3U);
  const auto pixels = pixels_of(*ui_.guide, ui_.camera, false);
  EXPECT_NEAR(pixels[1].x, 25.0, 0.6);
  EXPECT_NEAR(pixels[1].y, 20.0, 0.6);
  EXPECT_EQ(done().dabs, 0);
  key(kKeyEnter);
  EXPECT_FALSE(ui_.guide);
  const ClayState state = done();
  EXPECT_EQ(state.undo_depth, 1);
  EXPECT_GT(state.dabs, 5);
  // Another mode forgets the points, and so does Esc.
  for (const bool escapes : {true, false}) {
    mouse_at(InputEvent::Kind::press, {20, 20});
    mouse_at(InputEvent::Kind::release, {20, 20});
    ASSERT_TRUE(ui_.guide);
    if (escapes) key(kKeyEscape);
    if (!escapes) ui_.brush.stroke_mode = StrokeMode::space;
    gestures_.tick(1.0);
    EXPECT_FALSE(ui_.guide);
  }
  EXPECT_EQ(done().undo_depth, 1);
}

/// What the pen told is what the panel shows; what the curve makes of it is what the clay gets.
TEST_F(StrokeModes, APenPressesAsItsCurveSays) {
  ui_.brush.pressure_to_strength = 1.0;
  const auto pen = [&](InputEvent::Kind kind, double x, double pressure) {
    InputEvent event;
    event.kind = kind;
    event.x = x;
    event.y = 32.0;
    event.pressure = pressure;
    gestures_.on(event, false);
  };
  const auto height_of = [&](double pressure) {
    pen(InputEvent::Kind::press, 30.0, pressure);
    for (int n = 0; n < 20; ++n) pen(InputEvent::Kind::move, n % 2 == 0 ? 38.0 : 26.0, pressure);
    pen(InputEvent::Kind::release, 26.0, pressure);
    const double height = -30.0 - done().bounds_mm.min.y;
    document_.send(DoStep{io::HistoryStep::undo});
    settle();
    return height;
  };
  ui_.settings.pressure = kSoftPressure;
  const double soft = height_of(0.2);
  EXPECT_EQ(ui_.pressures.back(), 0.2F);
  ui_.settings.pressure = kLinearPressure;
  EXPECT_EQ(height_of(0.5), soft) << "the soft curve passes through (0.2, 0.5)";
  EXPECT_LT(height_of(0.2), soft);
  ui_.pressures.clear();
  pen(InputEvent::Kind::move, 20.0, 0.9);
  EXPECT_TRUE(ui_.pressures.empty()) << "no stroke is open";
  pen(InputEvent::Kind::press, 20.0, 0.25);
  for (int n = 0; n < 300; ++n) pen(InputEvent::Kind::move, 20.0 + 0.1 * n, 0.5);
  pen(InputEvent::Kind::release, 50.0, 0.0);
  EXPECT_EQ(ui_.pressures.size(), kMostPressures);
}

TEST(StrokeModesOf, AreThoseThatAToolCanHave) {
  Brush brush;
  brush.stroke_mode = StrokeMode::anchored;
  for (const Action action : {Action::grab, Action::elastic, Action::twist, Action::slide}) {
    brush.action = action;
    EXPECT_EQ(mode_of(brush), StrokeMode::space) << static_cast<int>(action);
  }
  brush.action = Action::emboss;
  EXPECT_EQ(mode_of(brush), StrokeMode::space) << "emboss has its own";
  chosen_mode(brush) = StrokeMode::anchored;
  EXPECT_EQ(tool_of(brush, 3.0).alpha_mode, AlphaMode::anchored);
  chosen_mode(brush) = StrokeMode::dots;
  EXPECT_EQ(tool_of(brush, 3.0).alpha_mode, AlphaMode::space);
  EXPECT_TRUE(style_of(brush).has_dots);
  brush.action = Action::inflate;
  EXPECT_FALSE(style_of(brush).has_dots);
  const Brush smooth = brush_with(brush, {.shift = true});
  EXPECT_EQ(mode_of(smooth), StrokeMode::space) << "Shift smooths as ever";
}

}  // namespace
}  // namespace argil::viewer
