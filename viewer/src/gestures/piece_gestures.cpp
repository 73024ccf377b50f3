// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/piece_gestures.h"

#include <cmath>
#include <utility>

#include "picture/stereo.h"

namespace argil::viewer {
namespace {

WindowPart part_under_pointer(const UiState& ui, const Camera::Pixel& pixel) {
  return part_at(ui.camera, ui.show.is_stereo, pixel);
}

}  // namespace

Placement shown_placement(const UiState& ui) {
  if (!ui.clay.pieces) return {};
  const PieceState& active = ui.clay.pieces->active_piece();
  const std::optional<PieceDrag>& drag = ui.pieces.drag;
  return drag && drag->piece == active.key ? drag->placement : active.look.placement;
}

double shown_factor(const UiState& ui) {
  const std::optional<PieceDrag>& drag = ui.pieces.drag;
  const bool is_dragged =
      drag && ui.clay.pieces && drag->piece == ui.clay.pieces->active_piece().key;
  return is_dragged ? drag->factor : 1.0;
}

bool is_drag_done(const UiState& ui, bool is_idle) {
  const std::optional<PieceDrag>& drag = ui.pieces.drag;
  if (!drag || !ui.clay.pieces) return false;
  const PieceState& active = ui.clay.pieces->active_piece();
  if (drag->piece != active.key) return true;
  // Of another size it is the clay that changes, and not only where it stands.
  const bool is_there = drag->factor == 1.0 ? are_same(drag->placement, active.look.placement)
                                            : drag->changes != ui.clay.changes;
  return drag->is_sent && (is_there || is_idle);
}

Box3 shown_bounds(const UiState& ui) {
  Box3 all = ui.clay.all_bounds_mm;
  if (!ui.pieces.drag) return all;
  const double factor = shown_factor(ui);
  Box3 own = ui.clay.bounds_mm;
  if (!own.empty()) own = {factor * own.min, factor * own.max};
  const Box3 dragged = placed(shown_placement(ui), own);
  if (dragged.empty()) return all;
  all.include(dragged.min);
  all.include(dragged.max);
  return all;
}

std::optional<Gizmo> shown_gizmo(const UiState& ui, const Camera& camera) {
  if (!ui.pieces.has_gizmo || !ui.clay.pieces || ui.clay.bounds_mm.empty()) return std::nullopt;
  const PieceLook& look = ui.clay.pieces->active_piece().look;
  if (!look.is_visible || look.is_locked) return std::nullopt;
  const Vec3 middle = shown_factor(ui) * ui.clay.bounds_mm.center();
  return gizmo_at(placed(shown_placement(ui), middle), camera);
}

std::optional<Placement> judged_placement(const UiState& ui) {
  if (!ui.report || !ui.clay.pieces) return std::nullopt;
  const PieceList& list = *ui.clay.pieces;
  if (list.active_piece().key == ui.report->piece) return shown_placement(ui);
  for (const PieceState& piece : list.pieces) {
    if (piece.key == ui.report->piece && piece.look.is_visible) return piece.look.placement;
  }
  return std::nullopt;
}

void place_active(const Placement& placement, const UiState& ui, DocumentThread& document) {
  if (!ui.clay.pieces) return;
  const PieceLook& look = ui.clay.pieces->active_piece().look;
  if (are_same(placement, look.placement)) return;
  ChangePiece change{look.name};
  change.placement = placement;
  document.send(DoStep{PieceEdit{change}});
}

void scale_active(double factor, const Vec3& about_mm, const UiState& ui,
                  DocumentThread& document) {
  if (!ui.clay.pieces || factor == 1.0) return;
  document.send(
      DoStep{PieceEdit{ScalePiece{ui.clay.pieces->active_piece().look.name, factor, about_mm}}});
}

std::optional<Vec3> foot_of_active(const UiState& ui) {
  const Box3 box = placed(shown_placement(ui), ui.clay.surface_mm);
  if (box.empty()) return std::nullopt;
  return Vec3{box.center().x, box.center().y, box.min.z};
}

bool PieceGestures::press(const InputEvent& event) {
  // One that the document has not done yet is still shown.
  if (ui_.pieces.drag || ui_.task.is_running) return false;
  const WindowPart part = part_under_pointer(ui_, {event.x, event.y});
  const Camera::Pixel pixel = part.inside({event.x, event.y});
  const auto gizmo = shown_gizmo(ui_, part.camera);
  const auto handle = gizmo ? part_under(*gizmo, part.camera, pixel) : std::nullopt;
  if (!handle) return false;
  const Placement before = shown_placement(ui_);
  middle_mm_ = gizmo->center_mm;
  drag_.emplace(*gizmo, *handle, part.camera, pixel, before);
  drag_part_ = part;
  ui_.pieces.drag = PieceDrag{ui_.clay.pieces->active_piece().key, before};
  ui_.pieces.handle = handle;
  return true;
}

void PieceGestures::move(const InputEvent& event) {
  constexpr double kNearPixels = 40.0;
  const auto& refused = ui_.pieces.refused_at;
  if (refused && std::hypot(event.x - refused->x, event.y - refused->y) > kNearPixels) {
    ui_.pieces.refused_at.reset();
  }
  if (drag_ && ui_.pieces.drag) {
    // In stereo the hand may leave the half of the eye that it began in.
    const Camera::Pixel pixel = drag_part_.inside({event.x, event.y});
    ui_.pieces.drag->placement = drag_->to(pixel, event.modifiers.ctrl);
    ui_.pieces.drag->factor = drag_->factor();
    return;
  }
  const WindowPart part = part_under_pointer(ui_, {event.x, event.y});
  const Camera::Pixel pixel = part.inside({event.x, event.y});
  const auto gizmo = shown_gizmo(ui_, part.camera);
  ui_.pieces.handle = gizmo ? part_under(*gizmo, part.camera, pixel) : std::nullopt;
}

void PieceGestures::release() {
  if (!drag_) return;
  drag_.reset();
  if (!ui_.pieces.drag) return;
  PieceDrag& drag = *ui_.pieces.drag;
  const bool is_scaled = drag.factor != 1.0;
  if (!ui_.clay.pieces || ui_.clay.pieces->active_piece().key != drag.piece ||
      (!is_scaled && are_same(drag.placement, ui_.clay.pieces->active_piece().look.placement))) {
    ui_.pieces.drag.reset();
    return;
  }
  drag.is_sent = true;
  drag.changes = ui_.clay.changes;
  if (is_scaled) return scale_active(drag.factor, middle_mm_, ui_, document_);
  place_active(drag.placement, ui_, document_);
}

bool PieceGestures::cancel() {
  if (!drag_) return false;
  drag_.reset();
  ui_.pieces.drag.reset();
  return true;
}

void PieceGestures::press_on_other(const InputEvent& event) {
  constexpr double kTwiceS = 0.4;
  constexpr double kTwicePixels = 6.0;
  const bool is_second =
      last_press_ && event.time_s - last_press_->time_s < kTwiceS &&
      std::hypot(event.x - last_press_->x, event.y - last_press_->y) < kTwicePixels;
  ui_.pieces.refused_at = Camera::Pixel{event.x, event.y};
  if (!is_second) {
    last_press_ = event;
    return;
  }
  last_press_.reset();
  const Camera::Pixel pixel{event.x, event.y};
  document_.send(SelectPieceAt{part_under_pointer(ui_, pixel).ray_at(pixel)});
}

}  // namespace argil::viewer
