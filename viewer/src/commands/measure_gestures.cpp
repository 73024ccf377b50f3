// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/measure_gestures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "commands/measure.h"
#include "commands/measure_marks.h"

namespace argil::viewer {
namespace {

// Numbers of questions: what lies under the pointer, then one for each point that is put or held;
// below zero those about what the clay hides.
constexpr std::int64_t kHoverQuestion = 0;
constexpr std::int64_t kPointsOfEach = 4;  // more than any measurement has

constexpr double kEndPixels = 9.0;    // around an end that take it
constexpr double kClickPixels = 5.0;  // that a click may move

std::int64_t sight_question(const MeasureEnd& end) {
  assert(end.number > 0 && end.point < kPointsOfEach);
  return -(end.number * kPointsOfEach + static_cast<std::int64_t>(end.point));
}

MeasureEnd end_of_sight(std::int64_t question) {
  assert(question < 0);
  return {-question / kPointsOfEach, static_cast<std::size_t>(-question % kPointsOfEach)};
}

double pixels_between(const Camera::Pixel& a, const Camera::Pixel& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The line of sight to a point.
Ray sight_of(const Camera& camera, const Vec3& point_mm) {
  const Lens lens = camera.lens({});
  if (!lens.is_parallel) return {lens.eye_mm, point_mm - lens.eye_mm};
  const Vec3 from_eye = point_mm - lens.eye_mm;
  return {point_mm - dot(from_eye, lens.back) * lens.back, -1.0 * lens.back};
}

}  // namespace

// ---- the mouse ---------------------------------------------------------------------------------

bool MeasureGestures::press(const InputEvent& event, bool is_on_clay) {
  assert(ui_.measures.tool);
  MeasureChoice& choice = ui_.measures;
  const Camera::Pixel pixel{event.x, event.y};
  pressed_at_ = pixel;
  if (const auto end = end_under(pixel)) {
    const Measurement* of = find_measurement(choice, end->number);
    assert(of != nullptr);
    if (!choice.begun.empty()) {
      add_point(of->points[end->point]);
      return true;
    }
    held_ = Held{++last_question_, *end, of->points, of->kind == MeasureKind::thickness, false};
    choice.chosen = end->number;
    choice.under = end;
    return true;
  }
  choice.chosen.reset();
  if (!is_on_clay) return false;
  put(pixel);
  return true;
}

void MeasureGestures::move(const InputEvent& event) {
  const Camera::Pixel pixel{event.x, event.y};
  if (!held_ || held_->is_let_go) {
    ui_.measures.under = ui_.measures.tool ? end_under(pixel) : std::nullopt;
    return;
  }
  if (pressed_at_ && pixels_between(*pressed_at_, pixel) <= kClickPixels) return;
  pressed_at_.reset();
  ask(held_->question, pixel);
}

void MeasureGestures::release(const InputEvent& event) {
  const Camera::Pixel pixel{event.x, event.y};
  const auto pressed = std::exchange(pressed_at_, std::nullopt);
  if (held_) {
    if (pressed) {
      click_on(*std::exchange(held_, std::nullopt), pixel);
      return;
    }
    // Another number, so that an answer to the question before is not taken for the last one.
    held_->question = ++last_question_;
    held_->is_let_go = true;
    ask(held_->question, pixel);
    return;
  }
  if (!pressed || !ui_.measures.tool || picks_of(*ui_.measures.tool) == 1) return;
  if (pixels_between(*pressed, pixel) > kClickPixels) put(pixel);
}

/// An end that was not dragged is where the next measurement begins.
void MeasureGestures::click_on(const Held& end, const Camera::Pixel& pixel) {
  if (!ui_.measures.tool) return;
  if (picks_of(*ui_.measures.tool) > 1) {
    add_point(end.before[end.end.point]);
  } else if (!end.is_thickness) {  // else it is that thickness which was meant
    put(pixel);
  }
}

bool MeasureGestures::cancel() {
  MeasureChoice& choice = ui_.measures;
  const bool had_points = !choice.begun.empty() || !waiting_.empty();
  choice.begun.clear();
  waiting_.clear();
  pressed_at_.reset();
  const auto held = std::exchange(held_, std::nullopt);
  if (!held) return had_points;
  if (Measurement* of = find_measurement(choice, held->end.number)) of->points = held->before;
  return true;
}

void MeasureGestures::remove() {
  MeasureChoice& choice = ui_.measures;
  if (!choice.begun.empty()) {
    choice.begun.pop_back();
  } else if (choice.chosen && !held_) {
    remove_measurement(*choice.chosen, choice);
  }
}

/// The end of a measurement that is drawn nearest to a pixel.
std::optional<MeasureEnd> MeasureGestures::end_under(const Camera::Pixel& pixel) const {
  const MeasureChoice& choice = ui_.measures;
  if (!choice.has_marks) return std::nullopt;
  const WindowPart part = part_at(ui_.camera, ui_.show.is_stereo, pixel);
  std::optional<MeasureEnd> nearest;
  double least = kEndPixels * ui_.panel_scale;
  for (const Measurement& each : choice.list) {
    const auto places = places_of(each.points, ui_);
    if (!places) continue;
    for (std::size_t n = 0; n < places->size(); ++n) {
      const double far = pixels_between(part.camera.pixel_of((*places)[n]), part.inside(pixel));
      if (far > least) continue;
      least = far;
      nearest = MeasureEnd{each.number, n};
    }
  }
  return nearest;
}

// ---- what the document thread tells -------------------------------------------------------------

void MeasureGestures::ask(std::int64_t question, const Camera::Pixel& pixel) {
  const bool is_of_tool = ui_.measures.tool == MeasureKind::thickness;
  const bool wants_far_side = held_ ? held_->is_thickness : is_of_tool;
  document_.measure({question, part_at(ui_.camera, ui_.show.is_stereo, pixel).ray_at(pixel),
                     ui_.measures.seen, wants_far_side});
}

void MeasureGestures::put(const Camera::Pixel& pixel) {
  waiting_.push_back({++last_question_, *ui_.measures.tool, ui_.chord});
  ask(last_question_, pixel);
}

void MeasureGestures::take(const MeasureAnswer& answer) {
  if (answer.number < 0) return take_sight(answer);
  if (answer.number == kHoverQuestion) {
    ui_.measures.hover.clear();
    if (!ui_.measures.tool) return;
    const bool has_across = ui_.measures.tool == MeasureKind::thickness;
    ui_.measures.hover = points_of(answer, ui_.chord, has_across);
    return;
  }
  if (held_ && held_->question == answer.number) {
    take_end(answer);
    if (held_->is_let_go) held_.reset();
    return;
  }
  const auto asked = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& each) {
    return each.question == answer.number;
  });
  if (asked == waiting_.end()) return;
  const Waiting put = *asked;
  waiting_.erase(asked);
  if (put.tool == ui_.measures.tool) take_point(answer, put.chord);
}

/// The point, and of a thickness also the one across; nothing where one is missing.
std::vector<MeasurePoint> MeasureGestures::points_of(const MeasureAnswer& answer,
                                                     const std::optional<Chord>& chord,
                                                     bool has_across) const {
  if (!answer.point) return {};
  if (!has_across) return {*answer.point};
  if (answer.across) return {*answer.point, *answer.across};
  if (!answer.is_on_slice || !chord || !ui_.clay.pieces) return {};
  // In a slice what is thick is the material that it shows: the shortest line there.
  for (const PieceState& piece : ui_.clay.pieces->pieces) {
    if (piece.key != answer.point->piece) continue;
    MeasurePoint from = *answer.point;
    MeasurePoint to = *answer.point;
    from.own_mm = unplaced(piece.look.placement, chord->from_mm);
    to.own_mm = unplaced(piece.look.placement, chord->to_mm);
    return {from, to};
  }
  return {};
}

void MeasureGestures::take_point(const MeasureAnswer& answer, const std::optional<Chord>& chord) {
  const bool is_thickness = ui_.measures.tool == MeasureKind::thickness;
  std::vector<MeasurePoint> points = points_of(answer, chord, is_thickness);
  if (points.empty()) {
    if (is_thickness && answer.point) {
      ui_.notices.push_back({Notice::Kind::warning, "there is no material below that point"});
    }
    return;
  }
  if (is_thickness) {
    add_measurement(std::move(points));
  } else {
    add_point(points.front());
  }
}

/// The next point of what was begun; the same twice is none.
void MeasureGestures::add_point(const MeasurePoint& point) {
  MeasureChoice& choice = ui_.measures;
  assert(choice.tool && picks_of(*choice.tool) > 1);
  if (!choice.begun.empty() && choice.begun.back() == point) return;
  choice.begun.push_back(point);
  if (choice.begun.size() == picks_of(*choice.tool)) {
    add_measurement(std::exchange(choice.begun, {}));
  }
}

void MeasureGestures::add_measurement(std::vector<MeasurePoint> points) {
  MeasureChoice& choice = ui_.measures;
  choice.list.push_back({++choice.last_number, *choice.tool, std::move(points)});
  choice.chosen = choice.last_number;
}

void MeasureGestures::take_end(const MeasureAnswer& answer) {
  Measurement* of = find_measurement(ui_.measures, held_->end.number);
  if (of == nullptr) return;
  std::vector<MeasurePoint> points = points_of(answer, ui_.chord, held_->is_thickness);
  if (points.empty()) return;  // beside the clay it stays where it was
  if (held_->is_thickness) {
    of->points = std::move(points);
  } else {
    of->points[held_->end.point] = points.front();
  }
  ++moves_;
}

/// Whether what was met on the way to a point is that point.
void MeasureGestures::take_sight(const MeasureAnswer& answer) {
  const MeasureEnd end = end_of_sight(answer.number);
  Measurement* of = find_measurement(ui_.measures, end.number);
  if (of == nullptr || end.point >= of->points.size()) return;
  const auto places = places_of(of->points, ui_);
  if (!places) return;
  const Vec3& place = (*places)[end.point];
  const Ray ray = sight_of(ui_.camera, place);
  // A surface seen from its edge is met beside the point.
  const double slack = 2.0 * ui_.camera.pixel_mm_at(place) + ui_.clay.voxel_mm;
  const double distance = length(place - ray.origin_mm);
  of->are_seen[end.point] = !answer.point || answer.distance_mm >= distance - slack;
}

void MeasureGestures::tick() {
  for (const MeasureAnswer& answer : document_.take_measured()) take(answer);
  if (!ui_.clay.has_clay) return;
  if (std::exchange(clay_, ui_.clay.number) != ui_.clay.number) {
    cancel();
    clear_measurements(ui_.measures);
  }
  if (!ui_.measures.tool && ui_.measures.list.empty()) return;
  Looked now{ui_.camera.lens({}), ui_.show.is_stereo, ui_.clay.changes,        ui_.clay.pieces,
             ui_.measures.seen,   ui_.measures.tool,  ui_.measures.last_number};
  const bool is_new = looked_ != now;
  looked_ = std::move(now);
  ask_hover(is_new);
  ask_sight(is_new);
}

void MeasureGestures::ask_hover(bool is_new) {
  if (!ui_.measures.tool) return;
  if (!ui_.is_pointer_over_clay_view || held_ || ui_.task.is_running) {
    ui_.measures.hover.clear();
    hovered_ = {-1.0, -1.0};
    return;
  }
  if (!is_new && pixels_between(hovered_, ui_.pointer) == 0.0) return;
  hovered_ = ui_.pointer;
  ask(kHoverQuestion, ui_.pointer);
}

void MeasureGestures::ask_sight(bool is_new) {
  if (!is_new && asked_moves_ == moves_) return;
  asked_moves_ = moves_;
  for (const Measurement& each : ui_.measures.list) {
    const auto places = places_of(each.points, ui_);
    if (!places) continue;
    for (std::size_t n = 0; n < places->size(); ++n) {
      document_.measure({sight_question({each.number, n}), sight_of(ui_.camera, (*places)[n]),
                         ui_.measures.seen, false});
    }
  }
}

}  // namespace argil::viewer
