// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/pie_gestures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "commands/command.h"
#include "commands/favourite_choice.h"
#include "keys/key_map.h"

namespace argil::viewer {
namespace {

constexpr double kFlickS = 0.25;  // a hand sees and aims no sooner

double distance_between(const Camera::Pixel& a, const Camera::Pixel& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

Camera::Pixel place_of_event(const InputEvent& event) { return {event.x, event.y}; }

/// Between what is left and right of it, or in the middle where there is no room.
double kept_within(double at, double margin, double size) {
  return 2.0 * margin >= size ? 0.5 * size : std::clamp(at, margin, size - margin);
}

/// By the direction from where it was opened, or from its middle.
void mark_pie(const Camera::Pixel& pointer, bool is_flick, UiState& ui) {
  const Camera::Pixel from = is_flick ? ui.pie.opened_at : middle_of_pie(ui);
  ui.pie.marked = pie_place(from, pointer, ui.panel_scale);
  if (ui.pie.marked) ui.pie.has_left = true;
}

void choose_in_pie(UiState& ui, DocumentThread& document) {
  const auto marked = std::exchange(ui.pie, PieMenu{}).marked;
  if (marked) do_favourite(*marked, ui, document);
}

/// A short press leaves it open; a way out and back to the middle chooses nothing.
bool release_pie(UiState& ui, DocumentThread& document) {
  ui.pie.held_key = 0;
  if (ui.pie.marked || ui.pie.has_left) {
    choose_in_pie(ui, document);
  } else {
    mark_pie(ui.pointer, false, ui);
  }
  return true;
}

bool press_on_pie(const InputEvent& event, UiState& ui, DocumentThread& document) {
  if (event.button == MouseButton::middle) return false;
  const bool is_here = is_for_pie(event, ui);
  if (!is_here || event.button == MouseButton::right) {
    ui.pie = {};
    return is_here;
  }
  mark_pie(place_of_event(event), false, ui);
  choose_in_pie(ui, document);
  return true;
}

bool key_on_pie(const InputEvent& event, UiState& ui) {
  constexpr int kFirstModifier = 340;  // GLFW's Shift to Super
  constexpr int kLastModifier = 347;
  if (event.is_repeat && event.key == ui.pie.held_key) return true;
  if (event.key >= kFirstModifier && event.key <= kLastModifier) return false;
  const bool is_own = ui.keys.aim_of({event.key, event.modifiers}) == KeyAim(Command::favourites);
  ui.pie = {};
  return is_own || event.key == kKeyEscape;
}

}  // namespace

void hold_pie(const InputEvent& key, UiState& ui) {
  if (!ui.pie.is_open) return;
  ui.pie.held_key = key.key;
  ui.pie.opened_s = key.time_s;
}

Camera::Pixel middle_of_pie(const UiState& ui) {
  constexpr double kAir = 4.0;
  const double margin = (kPieReach + kAir) * ui.panel_scale;
  return {kept_within(ui.pie.opened_at.x, margin, ui.camera.width()),
          kept_within(ui.pie.opened_at.y, margin, ui.camera.height())};
}

std::optional<std::size_t> pie_place(const Camera::Pixel& from, const Camera::Pixel& to,
                                     double scale) {
  assert(scale > 0.0);
  if (distance_between(from, to) < kPieMiddle * scale) return std::nullopt;
  // Clockwise from the top, in parts of a place.
  const double turn = std::atan2(to.x - from.x, from.y - to.y) / (2.0 * std::numbers::pi);
  const auto count = static_cast<long>(kFavouritePlaces);
  const long place = std::lround(turn * static_cast<double>(count));
  return static_cast<std::size_t>((place + count) % count);
}

bool is_for_pie(const InputEvent& event, const UiState& ui) {
  if (!ui.pie.is_open || event.kind != InputEvent::Kind::press) return false;
  if (event.button == MouseButton::middle) return false;
  if (event.button == MouseButton::right) return true;
  const double away = distance_between(middle_of_pie(ui), place_of_event(event));
  return away < kPieBeyond * ui.panel_scale;
}

bool pie_takes(const InputEvent& event, bool has_keyboard, UiState& ui, DocumentThread& document) {
  if (!ui.pie.is_open) return false;
  if (open_dialog(ui) != Dialog::none) {
    ui.pie = {};
    return false;
  }
  switch (event.kind) {
    case InputEvent::Kind::move: {
      const bool is_flick = ui.pie.held_key != 0 && event.time_s - ui.pie.opened_s < kFlickS;
      mark_pie(place_of_event(event), is_flick, ui);
      return false;  // everybody notes where the pointer is
    }
    case InputEvent::Kind::press:
      return press_on_pie(event, ui, document);
    case InputEvent::Kind::key_down:
      return has_keyboard && key_on_pie(event, ui);
    case InputEvent::Kind::key_up:
      if (event.key != ui.pie.held_key || event.key == 0) return false;
      return release_pie(ui, document);
    case InputEvent::Kind::away:
      if (ui.pie.held_key != 0) ui.pie = {};  // whose key goes up then, but chooses nothing
      return false;
    default:
      return false;
  }
}

}  // namespace argil::viewer
