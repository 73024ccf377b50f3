// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/gestures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "argil/io/path_file.h"

#include "commands/command.h"
#include "commands/command_search.h"
#include "commands/key_choice.h"
#include "commands/measure.h"
#include "commands/preset_choice.h"
#include "gestures/pie_gestures.h"
#include "keys/mouse_habit.h"
#include "picture/stereo.h"

namespace argil::viewer {
namespace {

constexpr double kZoomStep = 1.15;
// Of a 3D mouse at its stop: widths of the picture, and powers of e, a second.
constexpr double kPuckWidths = 0.7;
constexpr double kPuckZoom = 1.5;

/// Heard also while a text field has the keyboard: leaving a dialog, and the emergency stop where
/// there is a force.
bool is_for_everybody(const InputEvent& event, const UiState& ui) {
  const bool has_force = ui.haptics.device != DeviceChoice::mouse;
  return event.key == kKeyEscape || (event.key == kKeySpace && has_force);
}

/// The key of the numpad that one of the number row stands for, where that was chosen.
int key_meant(int key, const Settings& settings) {
  const bool is_number = key >= '0' && key <= '9';
  return settings.has_number_views && is_number ? kKeyPad0 + (key - '0') : key;
}

Camera::Pixel pixel_of(const InputEvent& event) { return {event.x, event.y}; }

/// The brush when it paints the mask whatever it was chosen for.
Brush masking(const Brush& brush) {
  Brush mask = brush;
  mask.action = Action::mask;
  mask.is_stamp = mask.is_inverted = false;
  mask.stroke_mode = StrokeMode::space;
  return mask;
}

}  // namespace

void Gestures::on(const InputEvent& told, bool is_taken) {
  InputEvent event = told;
  event.pressure = shaped_pressure(ui_.settings.pressure, told.pressure);
  const bool is_asked = open_dialog(ui_) != Dialog::none;
  if (is_asked) ui_.search.is_open = false;
  if (pie_takes(event, !is_taken, ui_, document_)) return;
  if (!is_taken && search_takes(event, ui_, document_)) return;
  switch (event.kind) {
    case InputEvent::Kind::press:
      // The click that ends a change of the brush may be anywhere.
      if (touch_.has_view()) break;
      if ((!is_taken && !is_asked) || ui_.brush_drag) press(event);
      break;
    case InputEvent::Kind::move:
      if (stroke_) note_pressure(told.pressure);
      move(event);
      break;
    case InputEvent::Kind::release:
      release(event);
      break;
    case InputEvent::Kind::scroll:
      // A handle that is held stays where the camera saw it, and so does an outline.
      if (!is_taken && !is_asked && drag_ != Drag::piece && !ui_.outline && drag_ != Drag::line) {
        ui_.camera.zoom(std::pow(kZoomStep, event.steps),
                        between_eyes(ui_.camera, ui_.show.is_stereo, pixel_of(event)));
      }
      break;
    case InputEvent::Kind::puck:
      puck(event);
      break;
    case InputEvent::Kind::finger_down:
    case InputEvent::Kind::finger_move:
    case InputEvent::Kind::finger_up:
      take_finger(event, is_taken || is_asked);
      break;
    case InputEvent::Kind::key_down:
      if (!is_taken || is_for_everybody(event, ui_)) key(event, is_asked);
      break;
    case InputEvent::Kind::key_up:
      if (event.key == kClutchKey) ui_.is_clutched = false;
      break;
    default:
      break;
  }
}

/// For the picture of the curve.
void Gestures::note_pressure(double pressure) {
  std::vector<float>& all = ui_.pressures;
  if (all.size() >= kMostPressures) all.erase(all.begin());
  all.push_back(static_cast<float>(pressure));
}

// ---- keys --------------------------------------------------------------------------------------

void Gestures::key(const InputEvent& event, bool is_asked) {
  if (!is_asked && (key_choice_takes(event, ui_) || preset_key_takes(event, ui_))) return;
  if (event.key == kKeySpace) {
    if (!event.is_repeat) perform(Command::emergency_stop, ui_, document_);
    return;
  }
  if (event.key == kKeyEscape) return escape();
  if (is_asked) return;
  // A stroke is ended by the hand: a key that would change the clay meanwhile was hit by mistake.
  if (drag_ == Drag::stroke || drag_ == Drag::piece || drag_ == Drag::outline) return;
  if (drag_ == Drag::line || drag_ == Drag::measure) return;
  if (ui_.outline) return key_of_curve(event);
  if (ui_.guide && (event.key == kKeyEnter || event.key == kKeyPadEnter)) return apply_curve(event);
  if (ui_.guide && event.key == kKeyBackspace) {
    ui_.guide->places_mm.pop_back();
    if (ui_.guide->places_mm.empty()) ui_.guide.reset();
    return;
  }
  // Whoever measures, or has chosen one in the list, means a measurement, and not the piece that
  // Delete removes else.
  const bool is_measuring = ui_.measures.tool || ui_.measures.chosen;
  if (is_measuring && event.key == kKeyDelete && event.modifiers == Modifiers{}) {
    return measures_.remove();
  }
  if (event.key == kClutchKey && event.modifiers == Modifiers{}) {
    ui_.is_clutched = true;
    return;
  }
  if (drag_ == Drag::hand) return;  // as a stroke, but that the hand may let go of the tool
  do_key(event);
}

void Gestures::do_key(const InputEvent& event) {
  // A digit that was given to something is that; else it may stand for one of the numpad.
  auto aim = ui_.keys.aim_of({event.key, event.modifiers});
  if (!aim) {
    const BrushPreset* preset = preset_of({event.key, event.modifiers}, ui_);
    if (preset != nullptr) return choose_preset(*preset, ui_);
    aim = ui_.keys.aim_of({key_meant(event.key, ui_.settings), event.modifiers});
  }
  if (!aim) return;
  if (const auto* tool = std::get_if<const ToolInfo*>(&*aim)) return choose_tool(**tool, ui_);
  const Command command = std::get<Command>(*aim);
  if (event.is_repeat && !goes_on_while_held(command)) return;
  perform(command, ui_, document_);
  if (command == Command::favourites) hold_pie(event, ui_);
  // The letter that is told after the key would be typed into the search.
  if (command == Command::search && types_letter({event.key, event.modifiers})) {
    constexpr double kLetterS = 0.002;  // the window system tells it at once
    ui_.search.skips_until_s = event.time_s + kLetterS;
  }
}

/// Ends one thing: what is being done, else a dialog, else the tool that measures.
void Gestures::escape() {
  const bool ends = pieces_.cancel() || measures_.cancel() || leave_outline() || leave_guide() ||
                    ui_.brush_drag || drag_ == Drag::stroke || ui_.places_drain || ui_.draws_path ||
                    ui_.turntable_left > 0;
  ui_.places_drain = false;
  leave_path();
  ui_.turntable_left = 0;
  if (ui_.brush_drag) ui_.brush = ui_.brush_drag->before;
  ui_.brush_drag.reset();
  if (drag_ == Drag::stroke) cancel_stroke();
  if (drag_ == Drag::stroke || drag_ == Drag::piece || drag_ == Drag::measure) drag_ = Drag::none;
  if (ends || std::exchange(ui_.asks_to_drop, false)) return;
  const bool was_asked = ui_.clay.left.has_value();
  if (was_asked) document_.send(ForgetQuestion{});
  if (!close_dialogs(ui_) && !was_asked) leave_measuring(ui_.measures);
}

void Gestures::cancel_stroke() {
  assert(stroke_);
  // A dab that was never laid is no stroke: the one before would be taken back.
  const bool is_begun = !has_one_dab(*stroke_) || stroke_->is_laid;
  stroke_.reset();
  if (is_begun) document_.send(CancelStroke{});
}

// ---- the mouse ---------------------------------------------------------------------------------

void Gestures::press(const InputEvent& event) {
  // Whoever goes on with the clay no longer means the key that a panel waits for.
  ui_.key_choice.waiting.reset();
  ui_.key_choice.wanted.reset();
  ui_.preset_choice.waits_for_key = false;
  if (ui_.brush_drag) {
    // Left takes the new size or strength, any other button goes back, as in Blender.
    if (event.button != MouseButton::left) ui_.brush = ui_.brush_drag->before;
    ui_.brush_drag.reset();
    return;
  }
  if (drag_ != Drag::none) return;
  if (ui_.places_drain && event.button == MouseButton::left && !event.modifiers.alt) {
    place_drain(event);
    return;
  }
  button_ = event.button;
  pressed_s_ = event.time_s;
  outline_before_ = ui_.outline;
  guide_before_ = ui_.guide;
  if (ui_.draws_path && event.button == MouseButton::left && !event.modifiers.alt) {
    begin_path(event);
    return;
  }
  drag_ = drag_of(event);
}

/// What a press begins.
Gestures::Drag Gestures::drag_of(const InputEvent& event) {
  // Between two clicks of a trim's curve: it lies over the picture as the first one found it.
  if (ui_.outline) {
    if (event.button == MouseButton::left) ui_.outline->points.push_back(pixel_of(event));
    return Drag::none;
  }
  const PressMeaning meaning = meaning_of(ui_.keys.set(), event.button, event.modifiers);
  if (meaning.what == PressMeaning::What::move) return Drag::pan;
  if (meaning.what == PressMeaning::What::turn) return Drag::orbit;
  InputEvent meant = event;
  meant.modifiers = meaning.held;
  // The other end of a pen does the opposite, as Ctrl; with Shift either end smooths.
  if (event.is_eraser && !meant.modifiers.shift) meant.modifiers.ctrl = !meant.modifiers.ctrl;
  paints_mask_ = meaning.is_mask;
  return work_of(meant, meaning.beside == PressMeaning::What::move ? Drag::pan : Drag::orbit);
}

/// What a press of the left button begins that is no turn of the view; `beside` where it is beside
/// the clay.
Gestures::Drag Gestures::work_of(const InputEvent& event, Drag beside) {
  if (pieces_.press(event)) return Drag::piece;
  if (ui_.measures.tool) return measure(event);
  ui_.measures.chosen.reset();  // back to the clay
  if (ui_.is_hand_led) return Drag::hand;
  if (begin_outline(event)) {
    return ui_.outline->form == DragForm::curve ? Drag::none : Drag::outline;
  }
  switch (begin_stroke(event)) {
    case Met::stroke:
      return Drag::stroke;
    case Met::other_piece:
      // Neither a stroke, which would surprise, nor a turn of the view.
      pieces_.press_on_other(event);
      return Drag::none;
    case Met::line:
      return Drag::line;
    case Met::point:
      return Drag::none;
    case Met::nothing:
      break;
  }
  return beside;
}

/// Beside the clay the left button turns the view, as with any other tool.
Gestures::Drag Gestures::measure(const InputEvent& event) {
  const SurfaceProbe probe = probe_(pixel_of(event));
  const bool is_on_clay = ui_.clay.has_clay && !ui_.task.is_running &&
                          (probe.at(pixel_of(event), 0.0) || probe.is_other_at(pixel_of(event)));
  return measures_.press(event, is_on_clay) ? Drag::measure : Drag::orbit;
}

void Gestures::place_drain(const InputEvent& event) {
  assert(ui_.places_drain);
  const double radius = 0.5 * ui_.operation.drain_mm;
  const auto hit = probe_(pixel_of(event)).at(pixel_of(event), radius);
  if (!hit) return;
  const Placement at = shown_placement(ui_);
  ui_.operation.drains.push_back(
      {unplaced(at, hit->point_mm), turned_back(at, -1.0 * hit->normal), radius});
  ui_.places_drain = false;
}

// ---- a path of guidance ------------------------------------------------------------------------

void Gestures::begin_path(const InputEvent& event) {
  assert(ui_.draws_path);
  if (!ui_.clay.has_clay) return;
  path_probe_.emplace(probe_(pixel_of(event)));
  drag_ = Drag::path;
  extend_path(event);
}

/// Beside the clay there is nothing to follow: the path goes straight on where it comes back.
void Gestures::extend_path(const InputEvent& event) {
  constexpr double kLeastStepMm = 0.25;
  assert(path_probe_);
  const auto hit = path_probe_->at(pixel_of(event), 0.0);
  if (!hit) return;
  const Vec3 point = unplaced(shown_placement(ui_), hit->point_mm);
  const bool is_near =
      !ui_.drawn_path_mm.empty() && length(point - ui_.drawn_path_mm.back()) < kLeastStepMm;
  if (!is_near) ui_.drawn_path_mm.push_back(point);
}

/// A drag beside the clay is none, and another may follow.
void Gestures::end_path() {
  if (ui_.drawn_path_mm.empty()) return;
  // As long as it may be: what is guided takes a thousand points, at wider steps.
  ui_.haptics.guidance.path_mm = io::thinned_path(std::move(ui_.drawn_path_mm));
  if (ui_.haptics.guidance.kind == haptics::GuidanceKind::none) {
    ui_.haptics.guidance.kind = haptics::GuidanceKind::direct;
  }
  leave_path();
}

void Gestures::leave_path() {
  if (drag_ == Drag::path) drag_ = Drag::none;
  path_probe_.reset();
  ui_.drawn_path_mm.clear();
  ui_.draws_path = false;
}

// ---- outlines of masks and trims ---------------------------------------------------------------

/// Whether the drag draws one: as chosen for the tool, or with Ctrl and Shift a lasso that masks,
/// as in Blender.
bool Gestures::begin_outline(const InputEvent& event) {
  if (!ui_.clay.has_clay || ui_.task.is_running) return false;
  const Modifiers& held = event.modifiers;
  OutlineDrag drag;
  if (!(held.ctrl && held.shift)) {
    if (held.shift) return false;  // smooths
    drag.form = drag_form_of(ui_);
    drag.is_trim = ui_.brush.action == Action::trim;
  }
  if (drag.form == DragForm::brush || paints_mask_) return false;
  drag.is_inverse = !held.shift && held.ctrl != ui_.brush.is_inverted;
  drag.part = part_at(ui_.camera, ui_.show.is_stereo, pixel_of(event));
  drag.key = active_key(ui_.clay);
  drag.piece = shown_placement(ui_);
  drag.points = {pixel_of(event)};
  ui_.outline = std::move(drag);
  return true;
}

void Gestures::end_outline() {
  assert(ui_.outline);
  if (auto wanted = request_of(*ui_.outline, ui_.outlines.front_only)) {
    document_.send(std::move(*wanted));
  }
  ui_.outline.reset();
}

/// Of a curve that is being clicked together: nothing else is heard meanwhile.
void Gestures::key_of_curve(const InputEvent& event) {
  assert(ui_.outline && ui_.outline->form == DragForm::curve);
  if (event.key == kKeyEnter || event.key == kKeyPadEnter) return end_outline();
  if (event.key != kKeyBackspace) return;
  ui_.outline->points.pop_back();
  if (ui_.outline->points.empty()) ui_.outline.reset();
}

/// True where one was being drawn.
bool Gestures::leave_outline() {
  if (drag_ == Drag::outline) drag_ = Drag::none;
  return std::exchange(ui_.outline, std::nullopt).has_value();
}

void Gestures::move(const InputEvent& event) {
  const double dx = event.x - ui_.pointer.x;
  const double dy = event.y - ui_.pointer.y;
  ui_.pointer = pixel_of(event);
  if (ui_.brush_drag) drag_brush(event);
  if (drag_ == Drag::orbit) ui_.camera.orbit(dx, dy);
  if (drag_ == Drag::pan) ui_.camera.pan(dx, dy);
  if (drag_ == Drag::stroke) extend_stroke(event);
  if (drag_ == Drag::path) extend_path(event);
  if (drag_ == Drag::piece || drag_ == Drag::none) pieces_.move(event);
  if (drag_ == Drag::measure || drag_ == Drag::none) measures_.move(event);
  if (drag_ == Drag::outline) extend(*ui_.outline, pixel_of(event));
  if (drag_ == Drag::line) {
    std::vector<Camera::Pixel>& ends = ui_.guide->ends;
    ends.resize(2);
    ends[1] = line_end(ends[0], pixel_of(event), event.modifiers.alt);
  }
}

void Gestures::release(const InputEvent& event) {
  if (drag_ == Drag::none || event.button != button_) return;
  if (drag_ == Drag::stroke) end_stroke();
  if (drag_ == Drag::path) end_path();
  if (drag_ == Drag::piece) pieces_.release();
  if (drag_ == Drag::outline) end_outline();
  if (drag_ == Drag::measure) measures_.release(event);
  if (drag_ == Drag::line) {
    const StrokeGuide guide = *std::exchange(ui_.guide, std::nullopt);
    if (guide.ends.size() == 2) lay_along(guide.ends, event);
  }
  drag_ = Drag::none;
}

/// As in Blender: to the right is more.
void Gestures::drag_brush(const InputEvent& event) {
  assert(ui_.brush_drag);
  const Brush& before = ui_.brush_drag->before;
  const double dx = event.x - ui_.brush_drag->start_x;
  if (ui_.brush_drag->what == BrushDrag::What::strength) {
    ui_.brush.strength = std::clamp(before.strength + dx / 300.0, kLeastStrength, 1.0);
    return;
  }
  const double factor = std::exp(dx / 200.0);
  ui_.brush.radius_mm = std::clamp(before.radius_mm * factor, kLeastRadiusMm, kMostRadiusMm);
  ui_.brush.radius_pixels = std::clamp(before.radius_pixels * factor, 2.0, 2000.0);
}

/// The piece follows the hand. A stroke reads the picture that it began in.
void Gestures::puck(const InputEvent& event) {
  if (drag_ == Drag::stroke || drag_ == Drag::piece || drag_ == Drag::line) return;
  if (ui_.outline) return;
  Camera& camera = ui_.camera;
  const double pixels = kPuckWidths * camera.width() * event.puck_s;
  camera.pan(pixels * event.puck_shift.x, -pixels * event.puck_shift.y);
  camera.orbit(pixels * event.puck_turn.y, pixels * event.puck_turn.x);
  camera.zoom(std::exp(-kPuckZoom * event.puck_s * event.puck_shift.z),
              {0.5 * camera.width(), 0.5 * camera.height()});
}

void Gestures::take_finger(const InputEvent& event, bool is_taken) {
  const TouchGestures::Answer answer = touch_.on(event, is_taken);
  if (answer.begins_view) let_go(event.time_s);
  if (answer.command && !ui_.outline) perform(*answer.command, ui_, document_);
}

/// A second finger has come: the view is meant. What the first has only just begun is taken back, a
/// stroke that went on for a while stands.
void Gestures::let_go(double now_s) {
  constexpr double kJustBegunS = 0.25;
  const bool has_just_begun = now_s - pressed_s_ <= kJustBegunS;
  if (drag_ == Drag::stroke) {
    if (has_just_begun) {
      cancel_stroke();
    } else {
      end_stroke();
    }
  }
  if (drag_ == Drag::piece) pieces_.cancel();
  if (drag_ == Drag::measure) measures_.cancel();
  if (drag_ == Drag::path) {
    path_probe_.reset();
    ui_.drawn_path_mm.clear();
  }
  // A line, an outline, or a point of one that is clicked together.
  if (drag_ == Drag::line || drag_ == Drag::outline || has_just_begun) {
    ui_.outline = std::exchange(outline_before_, std::nullopt);
    ui_.guide = std::exchange(guide_before_, std::nullopt);
  }
  drag_ = Drag::none;
}

// ---- strokes -----------------------------------------------------------------------------------

Gestures::Met Gestures::begin_stroke(const InputEvent& event) {
  if (!ui_.clay.has_clay || ui_.task.is_running) return Met::nothing;
  assert(!stroke_);
  SurfaceProbe probe = probe_(pixel_of(event));
  if (probe.is_other_at(pixel_of(event))) return Met::other_piece;
  const Brush brush = brush_with(paints_mask_ ? masking(ui_.brush) : ui_.brush, event.modifiers);
  if (mode_of(brush) == StrokeMode::line || mode_of(brush) == StrokeMode::curve) {
    if (!lays_guide_) return begin_guide(event, probe, brush);
  }
  // Twice: how large the brush is on the screen depends on how far away the surface is.
  const auto first = probe.at(pixel_of(event), 0.0);
  if (!first) return Met::nothing;
  const double radius = radius_on(brush, ui_.camera.pixel_mm_at(first->point_mm));
  const auto hit = probe.at(pixel_of(event), radius);
  stroke_.emplace(
      OpenStroke{brush, radius, std::move(probe), hit.value_or(*first), {}, {}, event.time_s});
  if (has_one_dab(*stroke_)) {
    drag_dab(event);
    return Met::stroke;
  }
  document_.send(BeginStroke{tool_of(brush, radius), style_of(brush), brush.is_stamp});
  extend_stroke(event);
  return Met::stroke;
}

/// What is dragged moves in the plane of the picture; every other tool stays on the surface as the
/// stroke found it. In stereo both as the eye sees it in whose half the stroke began: the other
/// half lies beyond that picture's edge.
std::optional<SurfaceHit> Gestures::hit_of(const OpenStroke& stroke,
                                           const InputEvent& event) const {
  if (!info_of(stroke.brush.action).is_dragged) {
    return stroke.probe.at(pixel_of(event), stroke.radius_mm);
  }
  const WindowPart& part = stroke.probe.part();
  const Ray ray = part.ray_at(pixel_of(event));
  const Vec3 back = part.camera.lens({}).back;
  const double along = dot(stroke.grip.point_mm - ray.origin_mm, back) / dot(ray.direction, back);
  return SurfaceHit{ray.origin_mm + along * ray.direction, stroke.grip.normal};
}

void Gestures::extend_stroke(const InputEvent& event) {
  assert(stroke_);
  OpenStroke& stroke = *stroke_;
  if (has_one_dab(stroke)) return drag_dab(event);
  const auto hit = hit_of(stroke, event);
  assert(!hit || std::abs(length(hit->normal) - 1.0) < 1e-6);
  if (!hit) {
    // Across the air there is nothing to work on: what comes behind it is another stroke.
    if (!stroke.is_off) document_.send(EndStroke{});
    stroke.is_off = true;
    return;
  }
  if (stroke.is_off) {
    document_.send(BeginStroke{tool_of(stroke.brush, stroke.radius_mm), style_of(stroke.brush),
                               stroke.brush.is_stamp, true});
    stroke.start_s = event.time_s;
    stroke.last.time_s = 0.0;
    stroke.is_off = false;
  }
  if (stroke.brush.is_stamp && stroke.is_stamped) return;
  stroke.is_stamped = true;
  stroke.hit = *hit;
  // A brush that was held still may have been told of a later time.
  const double time_s = std::max(stroke.last.time_s, event.time_s - stroke.start_s);
  stroke.last = sample_at(stroke.brush, stroke.radius_mm, *hit, time_s, event.pressure);
  document_.send(ExtendStroke{{stroke.last}, event.time_s});
}

void Gestures::end_stroke() {
  assert(stroke_);
  if (has_one_dab(*stroke_)) {
    if (stroke_->is_stale) lay_dab();
    if (stroke_->is_laid) document_.send(EndStroke{});
  } else if (!stroke_->is_off) {
    document_.send(EndStroke{});
  }
  stroke_.reset();
}

std::optional<SurfaceHit> Gestures::tool_hit() const {
  if (!stroke_ || stroke_->is_off) return std::nullopt;
  return stroke_->hit;
}

void Gestures::tick(double now_s) {
  measures_.tick();
  // Another tool or mode was chosen: the points mean nothing to it.
  if (ui_.guide && drag_ != Drag::line && mode_of(ui_.brush) != StrokeMode::curve)
    ui_.guide.reset();
  const bool has_curve = ui_.outline && ui_.outline->form == DragForm::curve;
  if (has_curve && drag_form_of(ui_) != DragForm::curve) ui_.outline.reset();
  // When the clay has done the last one, or so often: of a large tool that takes long, and more
  // would come later and later behind the hand.
  constexpr double kLayEveryS = 0.1;
  const bool is_stale = stroke_ && stroke_->is_stale;
  if (is_stale && (document_.is_idle() || now_s >= stroke_->start_s + kLayEveryS)) {
    lay_dab();
    stroke_->start_s = now_s;
  }
  if (!stroke_ || has_one_dab(*stroke_) || mode_of(stroke_->brush) == StrokeMode::dots) return;
  if (stroke_->is_off || stroke_->brush.is_stamp || stroke_->brush.hold_s <= 0.0) return;
  stroke_->last.time_s = std::max(stroke_->last.time_s, now_s - stroke_->start_s);
  document_.send(ExtendStroke{{stroke_->last}, now_s});
}

// ---- one dab -----------------------------------------------------------------------------------

/// What emboss drags to its size is a stroke of the engine's own.
bool Gestures::has_one_dab(const OpenStroke& stroke) const noexcept {
  const StrokeMode mode = mode_of(stroke.brush);
  const bool is_image = stroke.brush.action == Action::emboss && mode == StrokeMode::anchored;
  return is_one_dab(mode) && !is_image;
}

/// Where the dab is to be from now on; tick() lays it there. An anchored one is not there before
/// the hand has moved: it would have no size.
void Gestures::drag_dab(const InputEvent& event) {
  constexpr double kLeastPixels = 3.0;
  assert(stroke_);
  OpenStroke& stroke = *stroke_;
  stroke.input_s = event.time_s;
  if (mode_of(stroke.brush) == StrokeMode::drag_dot) {
    const auto hit = stroke.probe.at(pixel_of(event), stroke.radius_mm);
    if (!hit) return;  // it stays where it was
    stroke.hit = *hit;
    stroke.last = sample_at(stroke.brush, stroke.radius_mm, *hit, 0.0, event.pressure);
    stroke.is_stale = true;
    return;
  }
  // In the plane of the picture through where it was pressed.
  const WindowPart& part = stroke.probe.part();
  const Ray ray = part.ray_at(pixel_of(event));
  const Vec3 back = part.camera.lens({}).back;
  const double along = dot(stroke.grip.point_mm - ray.origin_mm, back) / dot(ray.direction, back);
  const Vec3 way = ray.origin_mm + along * ray.direction - stroke.grip.point_mm;
  const double far = length(way);
  if (far < kLeastPixels * part.camera.pixel_mm_at(stroke.grip.point_mm)) return;
  stroke.radius_mm = std::clamp(far, kLeastRadiusMm, kMostRadiusMm);
  stroke.last = anchored_sample(stroke.brush, stroke.radius_mm, stroke.grip, way, event.pressure);
  stroke.is_stale = true;
}

/// In the place of the one that was there.
void Gestures::lay_dab() {
  assert(stroke_ && stroke_->is_stale);
  OpenStroke& stroke = *stroke_;
  if (stroke.is_laid) document_.send(CancelStroke{});
  document_.send(BeginStroke{tool_of(stroke.brush, stroke.radius_mm), style_of(stroke.brush)});
  document_.send(ExtendStroke{{stroke.last}, stroke.input_s});
  stroke.is_laid = true;
  stroke.is_stale = false;
}

// ---- lines and curves --------------------------------------------------------------------------

/// The end of a line may lie beside the clay, a point of a curve may not: there the view is turned.
Gestures::Met Gestures::begin_guide(const InputEvent& event, const SurfaceProbe& probe,
                                    const Brush& brush) {
  if (mode_of(brush) == StrokeMode::line) {
    ui_.guide = StrokeGuide{StrokeMode::line, {pixel_of(event)}, {}, probe.part().eye};
    return Met::line;
  }
  const auto hit = probe.at(pixel_of(event), 0.0);
  if (!hit) return Met::nothing;
  if (!ui_.guide) ui_.guide = StrokeGuide{StrokeMode::curve, {}, {}, probe.part().eye};
  ui_.guide->places_mm.push_back(hit->point_mm);
  return Met::point;
}

/// True where one was being drawn.
bool Gestures::leave_guide() {
  if (drag_ == Drag::line) drag_ = Drag::none;
  return std::exchange(ui_.guide, std::nullopt).has_value();
}

void Gestures::apply_curve(const InputEvent& event) {
  assert(ui_.guide && ui_.guide->mode == StrokeMode::curve);
  const StrokeGuide guide = *std::exchange(ui_.guide, std::nullopt);
  InputEvent applied = event;
  applied.pressure = 1.0;  // no pen presses a key
  paints_mask_ = false;
  lay_along(curve_through(pixels_of(guide, ui_.camera, ui_.show.is_stereo)), applied);
}

/// The stroke that the brush makes along a line over the picture: as a hand that follows it.
void Gestures::lay_along(const std::vector<Camera::Pixel>& way, const InputEvent& event) {
  constexpr double kStepPixels = 3.0;
  constexpr double kStepS = 0.004;
  if (!ui_.clay.has_clay || ui_.task.is_running || way.empty() || stroke_) return;
  lays_guide_ = true;
  InputEvent at = event;
  const SurfaceProbe seen = probe_(way.front());
  for (const Camera::Pixel& pixel : close_points(way, kStepPixels)) {
    at.x = pixel.x;
    at.y = pixel.y;
    at.time_s += kStepS;
    if (stroke_) {
      extend_stroke(at);
    } else if (seen.at(pixel, 0.0)) {
      begin_stroke(at);
    }
  }
  if (stroke_) end_stroke();
  lays_guide_ = false;
}

}  // namespace argil::viewer
