// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/outline.h"

#include <chrono>
#include <cmath>
#include <map>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

using Pixel = Camera::Pixel;

/// With y up, as loops are oriented.
double loop_area(const std::vector<Pixel>& loop) {
  double twice = 0.0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Pixel& a = loop[n];
    const Pixel& b = loop[(n + 1) % loop.size()];
    twice += a.y * b.x - a.x * b.y;
  }
  return 0.5 * twice;
}

double side_of(const Pixel& a, const Pixel& b, const Pixel& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether two pieces that are no neighbours cross.
bool crosses_itself(const std::vector<Pixel>& loop) {
  const std::size_t count = loop.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;
      const Pixel &a = loop[i], &b = loop[(i + 1) % count], &c = loop[j],
                  &d = loop[(j + 1) % count];
      constexpr double kTouch = 1e-9;
      if (side_of(a, b, c) * side_of(a, b, d) < -kTouch &&
          side_of(c, d, a) * side_of(c, d, b) < -kTouch) {
        return true;
      }
    }
  }
  return false;
}

TEST(SimpleLoops, LeaveAPlainOutlineAsItIs) {
  const auto loops = simple_loops({{0, 0}, {0, 10}, {20, 10}, {20, 0}});
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].size(), 4U);
  EXPECT_DOUBLE_EQ(loop_area(loops[0]), 200.0);
  // The other way round it is the same.
  const auto back = simple_loops({{20, 0}, {20, 10}, {0, 10}, {0, 0}});
  ASSERT_EQ(back.size(), 1U);
  EXPECT_DOUBLE_EQ(loop_area(back[0]), 200.0);
}

TEST(SimpleLoops, PartAnEightIntoTwo) {
  const auto loops = simple_loops({{0, 0}, {20, 20}, {20, 0}, {0, 20}});
  ASSERT_EQ(loops.size(), 2U);
  for (const auto& loop : loops) EXPECT_NEAR(loop_area(loop), 100.0, 1e-9);
}

TEST(SimpleLoops, KeepWhatAPigtailGoesAround) {
  // A square whose right side makes a small loop to the outside.
  const auto loops = simple_loops(
      {{0, 0}, {100, 0}, {100, 60}, {140, 60}, {140, 40}, {80, 40}, {80, 100}, {0, 100}});
  double sum = 0.0;
  for (const auto& loop : loops) {
    EXPECT_FALSE(crosses_itself(loop));
    sum += loop_area(loop);
  }
  EXPECT_EQ(loops.size(), 2U);
  EXPECT_GT(sum, 8000.0);
}

TEST(SimpleLoops, OfARandomScribbleNeverCrossThemselves) {
  unsigned state = 7;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return 500.0 * (state >> 8U) / double(1U << 24U);
  };
  for (int scene = 0; scene < 40; ++scene) {
    std::vector<Pixel> scribble;
    scribble.reserve(30);
    for (int n = 0; n < 30; ++n) scribble.push_back({random(), random()});
    const auto loops = simple_loops(scribble);
    EXPECT_FALSE(loops.empty());
    for (const auto& loop : loops) {
      EXPECT_FALSE(crosses_itself(loop)) << scene;
      EXPECT_GT(loop_area(loop), 0.0);
    }
  }
}

TEST(SimpleLoops, LeaveOutWhatHasNoAreaAndPointsThatSayNothing) {
  EXPECT_TRUE(simple_loops({}).empty());
  EXPECT_TRUE(simple_loops({{1, 1}, {50, 50}}).empty());
  EXPECT_TRUE(simple_loops({{1, 1}, {50, 50}, {99, 99}}).empty());
  std::vector<Pixel> circle;
  for (int n = 0; n < 3000; ++n) {
    const double turn = 2.0 * 3.14159265358979 * n / 3000.0;
    circle.push_back({200.0 + 100.0 * std::cos(turn), 200.0 + 100.0 * std::sin(turn)});
  }
  const auto loops = simple_loops(circle);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_LT(loops[0].size(), 80U);
  EXPECT_NEAR(loop_area(loops[0]), 3.14159265 * 1e4, 0.012 * 3.14159265 * 1e4);
}

// ---- what they do to the clay ------------------------------------------------------------------

/// A camera that looks at the origin from the front, 100 pixels for some 30 mm.
WindowPart from_the_front(bool is_parallel) {
  WindowPart part;
  part.camera.resize(200, 160);
  part.camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
  Box3 box;
  box.include({-12.0, -12.0, -12.0});
  box.include({12.0, 12.0, 12.0});
  part.camera.frame(box);
  part.camera.set_parallel(is_parallel);
  return part;
}

/// Where a point of the plane y = 0 is seen.
Pixel pixel_at(const Camera& camera, double x, double z) {
  const double mm = camera.pixel_mm_at({0.0, 0.0, 0.0});
  return {0.5 * camera.width() + x / mm, 0.5 * camera.height() - z / mm};
}

OutlineDrag drag_of(DragForm form, bool is_parallel,
                    const std::vector<std::pair<double, double>>& points) {
  OutlineDrag drag;
  drag.form = form;
  drag.is_trim = true;
  drag.part = from_the_front(is_parallel);
  for (const auto& [x, z] : points) drag.points.push_back(pixel_at(drag.part.camera, x, z));
  return drag;
}

/// As the document's thread does it to clay within these bounds.
std::optional<io::ScriptStep> step_of(const OutlineDrag& drag, const Box3& bounds_mm) {
  const auto wanted = request_of(drag, false);
  if (!wanted) return std::nullopt;
  if (const auto* step = std::get_if<DoStep>(&*wanted)) return step->step;
  auto combine = combine_of(std::get<TrimPiece>(*wanted).trim, bounds_mm);
  if (!combine) return std::nullopt;
  return io::ScriptStep(Operation(std::move(*combine)));
}

constexpr double kTrimVoxelMm = 0.4;
Clay trimmed(const OutlineDrag& drag) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = kTrimVoxelMm}).value();
  const auto step = step_of(drag, clay.bounds_mm());
  EXPECT_TRUE(step && io::apply_step(clay, *step).ok());
  return clay;
}

class Trims : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Views, Trims, testing::Bool(), [](const auto& named) {
  return std::string(named.param ? "parallel" : "perspective");
});

TEST_P(Trims, SolidsAreClosedAndReachThroughTheClay) {
  const OutlineDrag drag =
      drag_of(DragForm::lasso, GetParam(), {{-4, -4}, {4, -4}, {4, 4}, {1, 4}, {1, -1}, {-4, -1}});
  Box3 box;
  box.include({-10.0, -10.0, -10.0});
  box.include({10.0, 10.0, 10.0});
  const auto step = step_of(drag, box);
  ASSERT_TRUE(step);
  const TriangleMesh& mesh = *std::get<Combine>(std::get<Operation>(*step)).mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t n = 0; n < 3; ++n) {
      ++edges[{t[n], t[(n + 1) % 3]}];
      --edges[{t[(n + 1) % 3], t[n]}];
    }
  }
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 0);
  EXPECT_GT(signed_volume(mesh), 0.0) << "it faces outward";
  EXPECT_LT(bounds(mesh).min.y, -10.0);
  EXPECT_GT(bounds(mesh).max.y, 10.0);
}

TEST_P(Trims, ABoxCutsThroughTheClayAsItIsSeen) {
  const OutlineDrag drag = drag_of(DragForm::box, GetParam(), {{2.0, -20.0}, {20.0, 20.0}});
  const Clay clay = trimmed(drag);
  const Camera& camera = drag.part.camera;
  const double eye = camera.distance_mm();
  for (const double y : {-8.0, -3.0, 0.0, 3.0, 8.0}) {
    // The box's left side where it is seen at that depth.
    const double side = GetParam() ? 2.0 : 2.0 * (eye + y) / eye;
    EXPECT_NEAR(clay.distance_at({side, y, 0.0}), 0.0, 0.1 * kTrimVoxelMm) << y;
    EXPECT_LT(clay.distance_at({side - 1.0, y, 0.0}), 0.0) << y;
    EXPECT_GT(clay.distance_at({side + 1.0, y, 0.0}), 0.0) << y;
  }
  // What the box does not show keeps its place.
  EXPECT_NEAR(clay.distance_at({-10.0, 0.0, 0.0}), 0.0, 0.02 * kTrimVoxelMm);
}

TEST_P(Trims, ALassoThatIsInvertedKeepsWhatIsWithinIt) {
  OutlineDrag drag = drag_of(DragForm::lasso, GetParam(), {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}});
  drag.is_inverse = true;
  const Clay clay = trimmed(drag);
  EXPECT_LT(clay.distance_at({0.0, 9.0, 0.0}), 0.0);
  EXPECT_LT(clay.distance_at({3.5, 0.0, -3.5}), 0.0);
  EXPECT_GT(clay.distance_at({5.0, 0.0, 0.0}), 0.0);
  EXPECT_NEAR(clay.distance_at({0.0, -10.0, 0.0}), 0.0, 0.02 * kTrimVoxelMm);
}

TEST_P(Trims, ALineTakesWhatLiesToItsRight) {
  // From left to right: what is below goes. Ctrl keeps it instead.
  OutlineDrag drag = drag_of(DragForm::line, GetParam(), {{-15.0, 3.0}, {15.0, 3.0}});
  const Clay top = trimmed(drag);
  EXPECT_LT(top.distance_at({0.0, 0.0, 5.0}), 0.0);
  EXPECT_GT(top.distance_at({0.0, 0.0, 1.0}), 0.0);
  drag.is_inverse = true;
  const Clay rest = trimmed(drag);
  EXPECT_GT(rest.distance_at({0.0, 0.0, 5.0}), 0.0);
  EXPECT_LT(rest.distance_at({0.0, 0.0, 1.0}), 0.0);
  EXPECT_NEAR(rest.distance_at({0.0, 0.0, 3.0}), 0.0, 0.05 * kTrimVoxelMm);
}

TEST_P(Trims, OverAllOfTheClayAreRefusedByTheEngineAndBesideItAreNothing) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = kTrimVoxelMm}).value();
  const auto all =
      step_of(drag_of(DragForm::box, GetParam(), {{-30, -30}, {30, 30}}), clay.bounds_mm());
  ASSERT_TRUE(all);
  EXPECT_FALSE(io::apply_step(clay, *all).ok());
  EXPECT_FALSE(step_of(drag_of(DragForm::box, GetParam(), {{25, 25}, {28, 28}}), clay.bounds_mm()));
  EXPECT_FALSE(step_of(drag_of(DragForm::box, GetParam(), {{3, 3}}), clay.bounds_mm()));
  EXPECT_FALSE(step_of(drag_of(DragForm::line, GetParam(), {{3, 3}, {3, 3.1}}), clay.bounds_mm()));
}

// ---- by the mouse ------------------------------------------------------------------------------

class OutlineGestures : public GesturesTest {
 protected:
  OutlineGestures() {
    document_.send(NewClay{{io::StartShape::Kind::ball, {10.0, 0.0, 0.0}, {.voxel_mm = 0.5}}});
    settle();
    ui_.camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
    ui_.camera.frame(ui_.clay.bounds_mm);
  }
  void settle() {
    while (!document_.is_idle()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::vector<double> inputs;
      document_.take_blocks(inputs);
    }
    ui_.clay = document_.state();
  }
  void drag(const std::vector<Pixel>& points, const Modifiers& held = {}) {
    InputEvent event;
    event.kind = InputEvent::Kind::press;
    event.modifiers = held;
    for (const Pixel& at : points) {
      event.x = at.x;
      event.y = at.y;
      gestures_.on(event, false);
      event.kind = InputEvent::Kind::move;
    }
    event.kind = InputEvent::Kind::release;
    gestures_.on(event, false);
    settle();
  }
  std::vector<std::string> steps() const { return ui_.clay.steps->names; }
};

TEST_F(OutlineGestures, ABoxMasksAndWithCtrlFrees) {
  ui_.brush.action = Action::mask;
  ui_.outlines.mask = DragForm::box;
  drag({{10, 10}, {40, 40}});
  EXPECT_EQ(steps(), (std::vector<std::string>{"Masked within"}));
  EXPECT_TRUE(ui_.clay.has_mask);
  drag({{5, 5}, {50, 50}}, {.ctrl = true});
  EXPECT_EQ(steps().back(), "Unmasked within");
  EXPECT_FALSE(ui_.clay.has_mask);
  EXPECT_FALSE(ui_.outline);
}

TEST_F(OutlineGestures, ALassoTrimsAsOneStepThatUndoTakesBack) {
  ui_.brush.action = Action::trim;
  ui_.outlines.trim = DragForm::lasso;
  const double before = ui_.clay.bounds_mm.max.x;
  drag({{45, 0}, {64, 0}, {64, 64}, {45, 64}});
  ASSERT_EQ(steps().size(), 1U);
  EXPECT_LT(ui_.clay.bounds_mm.max.x, before - 1.0);
  document_.send(DoStep{io::HistoryStep::undo});
  settle();
  EXPECT_EQ(ui_.clay.bounds_mm.max.x, before);
}

TEST_F(OutlineGestures, ControlAndShiftMaskByALassoWhateverTheTool) {
  ui_.brush.action = Action::inflate;
  drag({{10, 10}, {40, 10}, {40, 40}}, {.shift = true, .ctrl = true});
  EXPECT_EQ(steps(), (std::vector<std::string>{"Masked within"}));
}

TEST_F(OutlineGestures, TheWheelLeavesTheCameraWhileOneIsDrawn) {
  ui_.brush.action = Action::trim;
  ui_.outlines.trim = DragForm::lasso;
  const Lens lens = ui_.camera.lens({});
  InputEvent wheel;
  wheel.kind = InputEvent::Kind::scroll;
  wheel.steps = 1.0;
  mouse_at(InputEvent::Kind::press, {10, 10});
  gestures_.on(wheel, false);
  EXPECT_EQ(ui_.camera.lens({}), lens);
  mouse_at(InputEvent::Kind::release, {10, 10});
  gestures_.on(wheel, false);
  EXPECT_NE(ui_.camera.lens({}), lens);
}

TEST_F(OutlineGestures, EscapeLeavesItAndAClickIsNone) {
  ui_.brush.action = Action::trim;
  ui_.outlines.trim = DragForm::box;
  mouse_at(InputEvent::Kind::press, {10, 10});
  mouse_at(InputEvent::Kind::move, {40, 40});
  EXPECT_TRUE(ui_.outline);
  key(kKeyEscape);
  EXPECT_FALSE(ui_.outline);
  mouse_at(InputEvent::Kind::release, {40, 40});
  drag({{20, 20}});
  settle();
  EXPECT_TRUE(steps().empty());
}

/// What is drawn over a piece that is turned is meant as it is seen.
TEST(OutlineSteps, OfATurnedPieceAreInItsFrame) {
  const Placement piece{{3.0, -4.0, 5.0}, normalized(Quat{0.5, 0.1, -0.7, 0.3})};
  OutlineDrag drag;
  drag.form = DragForm::line;
  drag.part.camera.resize(400, 300);
  drag.points = {{120.0, 40.0}, {260.0, 210.0}};
  const Box3 bounds{{-20.0, -20.0, -20.0}, {20.0, 20.0, 20.0}};
  const auto cut_of = [&] {
    return std::get<Cut>(std::get<Operation>(step_of(drag, bounds).value()));
  };
  const Cut plain = cut_of();
  drag.piece = piece;
  const Cut own = cut_of();
  EXPECT_LT(length(placed(piece, own.point_mm) - plain.point_mm), 1e-9);
  EXPECT_LT(length(turned(piece, own.normal) - plain.normal), 1e-9);
  drag.form = DragForm::box;
  const auto outline = std::get<MaskOutline>(step_of(drag, bounds).value());
  const Lens lens = drag.part.camera.lens({});
  EXPECT_LT(length(placed(piece, outline.view.eye_mm) - lens.eye_mm), 1e-9);
  const Vec3 right = rotate(outline.view.orientation, {1.0, 0.0, 0.0});
  EXPECT_LT(length(turned(piece, right) - lens.right), 1e-9);
}

// ---- a curve -----------------------------------------------------------------------------------

bool is_in_loop(const std::vector<Camera::Pixel>& loop, double x, double y) {
  bool is_inside = false;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Camera::Pixel& a = loop[n];
    const Camera::Pixel& b = loop[(n + 1) % loop.size()];
    if ((a.y > y) == (b.y > y)) continue;
    if (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) > x) is_inside = !is_inside;
  }
  return is_inside;
}

TEST(OutlineCurve, TakesAllOfTheWindowToItsRight) {
  OutlineDrag drag;
  drag.form = DragForm::curve;
  drag.is_trim = true;
  drag.part.camera.resize(400, 300);
  // Upward in the middle: right is right.
  drag.points = {{200, 250}, {200, 150}, {200, 50}};
  const auto up = outline_of(drag);
  for (double y = 1.0; y < 300.0; y += 17.0) {
    for (double x = 3.0; x < 400.0; x += 13.0) {
      EXPECT_EQ(is_in_loop(up, x, y), x > 200.0) << x << " " << y;
    }
  }
  // Downward: right is left.
  drag.points = {{200, 50}, {200, 150}, {200, 250}};
  const auto down = outline_of(drag);
  EXPECT_TRUE(is_in_loop(down, 5.0, 5.0));
  EXPECT_FALSE(is_in_loop(down, 395.0, 295.0));
  // A valley that opens upward, from left to right: all below is taken, and nothing in it.
  drag.points = {{100, 40}, {130, 180}, {200, 220}, {270, 180}, {300, 40}};
  const auto valley = outline_of(drag);
  EXPECT_FALSE(is_in_loop(valley, 200.0, 100.0));
  EXPECT_TRUE(is_in_loop(valley, 200.0, 280.0));
  EXPECT_TRUE(is_in_loop(valley, 20.0, 150.0));
  EXPECT_TRUE(is_in_loop(valley, 380.0, 150.0));
  EXPECT_EQ(simple_loops(valley).size(), 1U);
  for (const Camera::Pixel& point : drag.points) {
    EXPECT_TRUE(std::any_of(valley.begin(), valley.end(), [&](const Camera::Pixel& p) {
      return std::hypot(p.x - point.x, p.y - point.y) < 1e-9;
    })) << "through each point";
  }
}

TEST_F(OutlineGestures, ACurveTrimsWithEnterAndIsGivenUpWithEscape) {
  ui_.brush.action = Action::trim;
  ui_.outlines.trim = DragForm::curve;
  const auto click = [&](const Camera::Pixel& at) {
    mouse_at(InputEvent::Kind::press, at);
    mouse_at(InputEvent::Kind::move, {at.x + 1.0, at.y});
    mouse_at(InputEvent::Kind::release, at);
  };
  const Lens lens = ui_.camera.lens({});
  for (const Camera::Pixel& at : {Camera::Pixel{5, 40}, Camera::Pixel{32, 25},
                                  Camera::Pixel{58, 40}, Camera::Pixel{60, 60}}) {
    click(at);
  }
  ASSERT_TRUE(ui_.outline);
  EXPECT_EQ(ui_.outline->points.size(), 4U);
  key(kKeyBackspace);
  EXPECT_EQ(ui_.outline->points.size(), 3U);
  mouse_at(InputEvent::Kind::press, {30, 30});
  key('X');
  EXPECT_FALSE(ui_.brush.mirror.x) << "nothing else is heard";
  EXPECT_EQ(ui_.camera.lens({}), lens);
  key(kKeyEscape);
  EXPECT_FALSE(ui_.outline);
  settle();
  EXPECT_TRUE(steps().empty());
  for (const Camera::Pixel& at :
       {Camera::Pixel{5, 40}, Camera::Pixel{32, 25}, Camera::Pixel{58, 40}}) {
    click(at);
  }
  key(kKeyEnter);
  EXPECT_FALSE(ui_.outline);
  settle();
  EXPECT_EQ(steps().size(), 1U);
  // Another tool forgets the points.
  click({5, 40});
  ui_.brush.action = Action::inflate;
  gestures_.tick(1.0);
  EXPECT_FALSE(ui_.outline);
}

}  // namespace
}  // namespace argil::viewer
