// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/measure_marks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "commands/measure.h"
#include "gestures/piece_gestures.h"

namespace argil::viewer {
namespace {

const Vec3 kMeasureColor{0.16, 0.62, 0.95};
const Vec3 kChosenColor{1.0, 0.72, 0.10};

/// From a line to the middle of its number, at a panel scale of 1.
constexpr double kBesidePixels = 18.0;
/// Of the shorter leg of an angle: where its arc is.
constexpr double kArcPart = 0.35;

/// Where a piece is shown; nothing while it is hidden or gone.
std::optional<Placement> placement_shown(PieceKey key, const UiState& ui) {
  if (!ui.clay.pieces) return std::nullopt;
  const PieceList& list = *ui.clay.pieces;
  if (list.active_piece().key == key && list.active_piece().look.is_visible) {
    return shown_placement(ui);  // also while it is dragged
  }
  for (const PieceState& piece : list.pieces) {
    if (piece.key == key && piece.look.is_visible) return piece.look.placement;
  }
  return std::nullopt;
}

/// A measurement as it is drawn, also one that is not complete.
struct ShownMeasure {
  MeasureKind kind = MeasureKind::distance;
  std::vector<Vec3> places;
  std::vector<bool> are_seen;
  bool is_complete = true;
  bool is_chosen = false;
  std::optional<std::size_t> under;  ///< the end under the pointer
  bool is_current = true;
};

std::optional<ShownMeasure> shown_measure(const Measurement& each, const UiState& ui) {
  auto places = places_of(each.points, ui);
  if (!places) return std::nullopt;
  const MeasureChoice& choice = ui.measures;
  ShownMeasure made{each.kind, std::move(*places), {}, true, choice.chosen == each.number,
                    {},        is_current(each)};
  made.are_seen.assign(each.are_seen.begin(),
                       each.are_seen.begin() + static_cast<std::ptrdiff_t>(each.points.size()));
  if (choice.under && choice.under->number == each.number) made.under = choice.under->point;
  return made;
}

/// "12.34 mm", and a question mark where the clay under it is no longer what was measured.
std::string text_of(const ShownMeasure& measure) {
  std::string text = measured_text(measure.kind, measured(measure.kind, measure.places));
  if (!measure.is_current) text += " ?";
  return text;
}

/// Whether two points are nearly one on the screen: no line between them is worth a number.
bool are_near(const Vec3& a, const Vec3& b, const UiState& ui) {
  constexpr double kNearPixels = 6.0;
  const Camera::Pixel one = ui.camera.pixel_of(a);
  const Camera::Pixel other = ui.camera.pixel_of(b);
  return std::hypot(one.x - other.x, one.y - other.y) < kNearPixels * ui.panel_scale;
}

/// The one that is begun, up to what lies under the pointer.
std::optional<ShownMeasure> shown_next_measure(const UiState& ui) {
  const MeasureChoice& choice = ui.measures;
  if (!choice.tool || (choice.under && choice.begun.empty())) return std::nullopt;
  auto places = places_of(choice.begun, ui);
  const auto hover = places_of(choice.hover, ui);
  if (!places || !hover) return std::nullopt;
  if (places->empty() || hover->empty() || !are_near(places->back(), hover->front(), ui)) {
    places->insert(places->end(), hover->begin(), hover->end());
  }
  if (places->empty()) return std::nullopt;
  const std::size_t whole = *choice.tool == MeasureKind::angle ? 3 : 2;
  ShownMeasure made{*choice.tool, std::move(*places), {}, false, true, {}};
  made.is_complete = made.places.size() == whole;
  made.are_seen.assign(made.places.size(), true);
  if (made.kind == MeasureKind::thickness && made.is_complete) made.are_seen[1] = false;
  return made;
}

std::vector<ShownMeasure> all_shown(const UiState& ui) {
  std::vector<ShownMeasure> all;
  if (ui.measures.has_marks) {
    for (const Measurement& each : ui.measures.list) {
      if (auto made = shown_measure(each, ui)) all.push_back(std::move(*made));
    }
  }
  if (auto next = shown_next_measure(ui)) all.push_back(std::move(*next));
  return all;
}

/// From one leg of an angle to the other, about its corner.
std::vector<Vec3> arc_of(const std::vector<Vec3>& places) {
  assert(places.size() == 3);
  const Vec3 one = places[0] - places[1];
  const Vec3 other = places[2] - places[1];
  const double radius = kArcPart * std::min(length(one), length(other));
  const double angle = std::atan2(length(cross(one, other)), dot(one, other));
  const Vec3 along = normalized(one);
  const Vec3 across = normalized(other - dot(other, along) * along);
  if (!(radius > 0.0) || across == Vec3{}) return {};  // no angle, or a straight one
  constexpr int kPieces = 32;
  std::vector<Vec3> arc;
  for (int n = 0; n <= kPieces; ++n) {
    const double a = angle * n / kPieces;
    arc.push_back(places[1] + radius * (std::cos(a) * along + std::sin(a) * across));
  }
  return arc;
}

/// Beside the middle of a line, on its upper side.
Camera::Pixel label_beside(const Camera::Pixel& a, const Camera::Pixel& b, double pixels) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double far = std::hypot(dx, dy);
  Camera::Pixel up{0.0, -1.0};
  if (far > 1.0) up = {dy / far, -dx / far};
  if (up.y > 0.0) up = {-up.x, -up.y};
  // A number is wider than high: beside a steep line it needs more room.
  const double room = pixels * (1.0 + 1.2 * std::abs(up.x));
  return {0.5 * (a.x + b.x) + room * up.x, 0.5 * (a.y + b.y) + room * up.y};
}

/// Where a line that comes from `from` to `at` would go on.
Camera::Pixel label_before(const Camera::Pixel& at, const Camera::Pixel& from, double pixels) {
  const double dx = at.x - from.x;
  const double dy = at.y - from.y;
  const double far = std::hypot(dx, dy);
  if (far < 4.0) return label_beside(at, at, pixels);
  const double room = pixels * (1.0 + 1.2 * std::abs(dx) / far) / far;
  return {at.x + room * dx, at.y + room * dy};
}

/// What of a line lies in a part of the window; nothing where all of it is beside (Liang and
/// Barsky).
std::optional<std::pair<Camera::Pixel, Camera::Pixel>> clipped(const Camera::Pixel& a,
                                                               const Camera::Pixel& b,
                                                               const WindowPart& part) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  double from = 0.0;
  double to = 1.0;
  const std::array<std::pair<double, double>, 4> edges{{{-dx, a.x - part.left},
                                                        {dx, part.left + part.camera.width() - a.x},
                                                        {-dy, a.y},
                                                        {dy, part.camera.height() - a.y}}};
  for (const auto& [across, room] : edges) {
    if (across == 0.0 && room < 0.0) return std::nullopt;
    if (across < 0.0) from = std::max(from, room / across);
    if (across > 0.0) to = std::min(to, room / across);
  }
  if (from > to) return std::nullopt;
  return std::pair{Camera::Pixel{a.x + from * dx, a.y + from * dy},
                   Camera::Pixel{a.x + to * dx, a.y + to * dy}};
}

/// Beside what of its line is in the picture; nothing where none is.
std::optional<Camera::Pixel> label_place(const ShownMeasure& measure, const WindowPart& part,
                                         double pixels) {
  const auto pixel_of = [&](const Vec3& place) {
    Camera::Pixel pixel = part.camera.pixel_of(place);
    pixel.x += part.left;
    return pixel;
  };
  const bool is_angle = measure.kind == MeasureKind::angle;
  const std::vector<Vec3> arc = is_angle ? arc_of(measure.places) : std::vector<Vec3>();
  const Camera::Pixel first = pixel_of(measure.places[is_angle ? 1 : 0]);
  const Camera::Pixel last =
      is_angle && !arc.empty() ? pixel_of(arc[arc.size() / 2]) : pixel_of(measure.places[1]);
  const auto shown = clipped(first, last, part);
  if (!shown) return std::nullopt;
  const bool is_first_in = shown->first.x == first.x && shown->first.y == first.y;
  // Of an angle on the far side of the arc from its corner; of a thickness before its near end.
  if (is_angle) return label_before(shown->second, shown->first, pixels);
  if (measure.kind == MeasureKind::thickness && is_first_in) {
    return label_before(first, last, pixels);
  }
  return label_beside(shown->first, shown->second, pixels);
}

/// Down from where it would lie over another one.
Camera::Pixel free_place(Camera::Pixel at, const std::vector<MeasureLabel>& others, double scale) {
  constexpr double kLabelHeight = 24.0;
  constexpr double kLabelWidth = 78.0;
  constexpr int kMostMoves = 12;
  const auto is_taken = [&](const MeasureLabel& other) {
    return std::abs(other.at.x - at.x) < kLabelWidth * scale &&
           std::abs(other.at.y - at.y) < 0.98 * kLabelHeight * scale;
  };
  for (int n = 0; n < kMostMoves && std::any_of(others.begin(), others.end(), is_taken); ++n) {
    at.y += kLabelHeight * scale;
  }
  return at;
}

}  // namespace

std::optional<std::vector<Vec3>> places_of(std::span<const MeasurePoint> points,
                                           const UiState& ui) {
  std::vector<Vec3> places;
  for (const MeasurePoint& point : points) {
    const auto at = placement_shown(point.piece, ui);
    if (!at) return std::nullopt;
    places.push_back(placed(*at, point.own_mm));
  }
  return places;
}

MeasureMarks measure_marks(const UiState& ui, const WindowPart& part) {
  MeasureMarks marks;
  for (const ShownMeasure& measure : all_shown(ui)) {
    for (std::size_t n = 0; n < measure.places.size(); ++n) {
      Camera::Pixel at = part.camera.pixel_of(measure.places[n]);
      at.x += part.left;
      marks.dots.push_back({at, measure.are_seen[n], measure.is_chosen, measure.under == n});
    }
    if (!measure.is_complete) continue;
    const bool is_seen =
        std::find(measure.are_seen.begin(), measure.are_seen.end(), true) != measure.are_seen.end();
    const auto at = label_place(measure, part, kBesidePixels * ui.panel_scale);
    if (!at) continue;
    marks.labels.push_back({free_place(*at, marks.labels, ui.panel_scale), text_of(measure),
                            is_seen, measure.is_chosen});
  }
  return marks;
}

void add_measure_lines(const UiState& ui, Picture& picture) {
  for (const ShownMeasure& measure : all_shown(ui)) {
    const Vec3& color = measure.is_chosen ? kChosenColor : kMeasureColor;
    if (measure.places.size() > 1) picture.lines.push_back({measure.places, color});
    if (measure.kind != MeasureKind::angle || !measure.is_complete) continue;
    if (auto arc = arc_of(measure.places); !arc.empty()) {
      picture.lines.push_back({std::move(arc), color});
    }
  }
}

}  // namespace argil::viewer
