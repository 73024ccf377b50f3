// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/measure_gestures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "commands/measure.h"
#include "gestures/measure_marks.h"

namespace argil::viewer {
namespace {

// Numbers of questions: what lies under the pointer, then one for each point that is put or held;
// below zero those about what the clay hides.
constexpr std::int64_t kHoverQuestion = 0;
constexpr std::int64_t kPointsOfEach = 4;  // more than any measurement has

constexpr double kEndPixels = 9.0;    // around an end that take it
constexpr double kClickPixels = 5.0;  // that a click may move
constexpr double kTwicePixels = 3.0;  // between two points that are one

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
  // From before all clay, as Camera::ray_at: the eye's plane may lie within it.
  const double before = 100.0 * camera.distance_mm() - dot(from_eye, lens.back);
  return {point_mm + before * lens.back, -1.0 * lens.back};
}

}  // namespace

// ---- the mouse ---------------------------------------------------------------------------------

bool MeasureGestures::press(const InputEvent& event, bool is_on_clay) {
  assert(ui_.measures.tool);
  MeasureChoice& choice = ui_.measures;
  const Camera::Pixel pixel{event.x, event.y};
  pressed_at_ = pixel;
  // What completes a measurement does not begin the next one by a slip of the hand.
  may_drag_ = choice.begun.size() + waiting_.size() + 1 < picks_of(*choice.tool);
  if (const auto end = end_under(pixel)) {
    const Measurement* of = find_measurement(choice, end->number);
    assert(of != nullptr);
    if (!choice.begun.empty()) {
      add_point(of->points[end->point]);
      return true;
    }
    held_ = Held{++last_question_, *end, of->points, of->kind == MeasureKind::thickness};
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
  if (is_click(pixel)) return;
  pressed_at_.reset();
  held_->chord = ask(held_->question, pixel);
}

void MeasureGestures::release(const InputEvent& event) {
  const Camera::Pixel pixel{event.x, event.y};
  const bool is_click = this->is_click(pixel);
  const bool was_pressed = std::exchange(pressed_at_, std::nullopt).has_value();
  if (held_) {
    if (was_pressed) {
      click_on(*std::exchange(held_, std::nullopt), pixel);
      return;
    }
    // Another number, so that an answer to the question before is not taken for the last one.
    held_->question = ++last_question_;
    held_->is_let_go = true;
    held_->chord = ask(held_->question, pixel);
    return;
  }
  if (was_pressed && !is_click && may_drag_ && ui_.measures.tool) put(pixel);
}

/// Whether the pointer is still about where the button was pressed.
bool MeasureGestures::is_click(const Camera::Pixel& pixel) const {
  return pressed_at_ && pixels_between(*pressed_at_, pixel) <= kClickPixels * ui_.panel_scale;
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
  if (held_ && held_->is_let_go) return false;  // it is done, but for its last answer
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
  if (choice.begun.size() == 1 && choice.chosen) {
    // A click on an end chose its measurement, and began another one there.
    const Measurement* of = find_measurement(choice, *choice.chosen);
    const auto& points = of->points;
    const bool is_there = std::find(points.begin(), points.end(), choice.begun[0]) != points.end();
    if (is_there) choice.begun.clear();
  }
  if (!choice.begun.empty()) {
    choice.begun.pop_back();
  } else if (choice.chosen && !held_) {
    remove_measurement(*choice.chosen, choice);
  }
}

/// The end of a measurement that is drawn nearest to a pixel. One behind clay is not meant: the
/// clay before it is.
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
      if (!each.are_seen[n]) continue;
      const double far = pixels_between(part.camera.pixel_of((*places)[n]), part.inside(pixel));
      if (far > least) continue;
      least = far;
      nearest = MeasureEnd{each.number, n};
    }
  }
  return nearest;
}

// ---- what the document thread tells -------------------------------------------------------------

/// Returns the shortest line there through the material that a slice shows, where a thickness is
/// asked for.
std::optional<Chord> MeasureGestures::ask(std::int64_t question, const Camera::Pixel& pixel) {
  const bool is_of_tool = ui_.measures.tool == MeasureKind::thickness;
  const bool wants_far_side = held_ ? held_->is_thickness : is_of_tool;
  const Ray ray = part_at(ui_.camera, ui_.show.is_stereo, pixel).ray_at(pixel);
  document_.measure({question, ray, ui_.measures.seen, wants_far_side});
  if (!wants_far_side || ui_.measures.slice == nullptr) return std::nullopt;
  return shortest_chord(*ui_.measures.slice, ray);
}

void MeasureGestures::put(const Camera::Pixel& pixel) {
  const std::int64_t question = ++last_question_;
  waiting_.push_back({question, *ui_.measures.tool, ask(question, pixel)});
}

void MeasureGestures::take(const MeasureAnswer& answer) {
  if (answer.number < 0) return take_sight(answer);
  if (answer.number == kHoverQuestion) {
    ui_.measures.hover.clear();
    if (!ui_.measures.tool) return;
    const bool has_across = ui_.measures.tool == MeasureKind::thickness;
    ui_.measures.hover = points_of(answer, hover_chord_, has_across);
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
    ui_.notices.push_back({Notice::Kind::warning,
                           answer.point ? "the clay is too thin there to be measured"
                                        : "no clay lies there; point a little beside its edge"});
    return;
  }
  if (is_thickness) {
    add_measurement(std::move(points));
  } else {
    add_point(points.front());
  }
}

/// Whether a point was begun with that is, on the screen, the same: the second of a double click.
bool MeasureGestures::is_last(const MeasurePoint& point) const {
  if (ui_.measures.begun.empty()) return false;
  const auto places = places_of(std::array{ui_.measures.begun.back(), point}, ui_);
  if (!places) return false;
  return pixels_between(ui_.camera.pixel_of((*places)[0]), ui_.camera.pixel_of((*places)[1])) <
         kTwicePixels * ui_.panel_scale;
}

/// The next point of what was begun; the same twice is none.
void MeasureGestures::add_point(const MeasurePoint& point) {
  MeasureChoice& choice = ui_.measures;
  assert(choice.tool && picks_of(*choice.tool) > 1);
  if (is_last(point)) return;
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
  std::vector<MeasurePoint> points = points_of(answer, held_->chord, held_->is_thickness);
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
  of->are_seen[end.point] = !answer.point || answer.distance_mm >= answer.far_enough_mm;
  of->are_kept[end.point] = answer.is_kept;
}

void MeasureGestures::tick() {
  for (const MeasureAnswer& answer : document_.take_measured()) take(answer);
  if (!ui_.clay.has_clay) return;
  if (std::exchange(clay_, ui_.clay.number) != ui_.clay.number) {
    cancel();
    clear_measurements(ui_.measures);
    ui_.measures.last_number = ui_.measures.listed = 0;
  }
  // Its piece is hidden, or gone.
  if (!places_of(ui_.measures.begun, ui_)) ui_.measures.begun.clear();
  if (!ui_.measures.tool && ui_.measures.list.empty()) return;
  Looked now{ui_.camera.lens({}),    ui_.show.is_stereo,      ui_.clay.changes,
             ui_.clay.pieces,        ui_.measures.seen,       ui_.measures.tool,
             ui_.measures.has_marks, ui_.measures.last_number};
  const bool is_new = looked_ != now;
  const bool is_other_clay =
      !looked_ || looked_->changes != now.changes || looked_->pieces != now.pieces;
  looked_ = std::move(now);
  ask_hover(is_new);
  ask_sight(is_new, is_other_clay);
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
  hover_chord_ = ask(kHoverQuestion, ui_.pointer);
}

/// Of those that are in the picture; once the clay is another one, of all, also whether it still
/// lies there.
void MeasureGestures::ask_sight(bool is_new, bool is_other_clay) {
  if (!is_new && asked_moves_ == moves_) return;
  asked_moves_ = moves_;
  if (!ui_.measures.has_marks && !is_other_clay) return;
  const Camera& camera = ui_.camera;
  for (const Measurement& each : ui_.measures.list) {
    const auto places = places_of(each.points, ui_);
    if (!places) continue;
    for (std::size_t n = 0; n < places->size(); ++n) {
      const Vec3& place = (*places)[n];
      const Camera::Pixel at = camera.pixel_of(place);
      const bool is_inside =
          at.x >= 0.0 && at.y >= 0.0 && at.x <= camera.width() && at.y <= camera.height();
      if (!is_inside && !ui_.show.is_stereo && !is_other_clay) continue;
      const Ray ray = sight_of(camera, place);
      // A surface seen from its edge is met beside the point.
      const double slack = 2.0 * camera.pixel_mm_at(place) + ui_.clay.voxel_mm;
      document_.measure({sight_question({each.number, n}), ray, ui_.measures.seen, false,
                         length(place - ray.origin_mm) - slack, each.points[n]});
    }
  }
}

}  // namespace argil::viewer
