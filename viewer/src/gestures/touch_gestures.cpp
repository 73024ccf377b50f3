// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/touch_gestures.h"

#include <algorithm>
#include <cmath>

#include "picture/stereo.h"

namespace argil::viewer {
namespace {

/// A tap is no longer and no farther than this; pixels of a screen of usual letters.
constexpr double kTapS = 0.3;
constexpr double kTapPixels = 12.0;

Camera::Pixel place_of(const InputEvent& event) { return {event.x, event.y}; }

}  // namespace

TouchGestures::Answer TouchGestures::on(const InputEvent& event, bool is_taken) {
  switch (event.kind) {
    case InputEvent::Kind::finger_down:
      return {press(event, is_taken), std::nullopt};
    case InputEvent::Kind::finger_move:
      move(event);
      return {};
    case InputEvent::Kind::finger_up:
      return {false, lift(event)};
    default:
      return {};
  }
}

bool TouchGestures::press(const InputEvent& event, bool is_taken) {
  if (fingers_.empty()) {
    first_s_ = event.time_s;
    most_ = 0;
    has_moved_ = is_of_panel_ = false;
  }
  fingers_[event.finger] = {place_of(event), place_of(event)};
  most_ = std::max(most_, fingers_.size());
  const bool is_second = fingers_.size() == 2 && !has_view_ && !is_of_panel_;
  is_of_panel_ = is_of_panel_ || (is_second && is_taken);
  const bool begins_view = is_second && !is_taken;
  has_view_ = has_view_ || begins_view;
  return begins_view;
}

bool TouchGestures::is_beyond_tap(const Finger& finger) const {
  return std::hypot(finger.at.x - finger.down.x, finger.at.y - finger.down.y) >
         kTapPixels * std::max(ui_.panel_scale, 1.0);
}

TouchGestures::Spread TouchGestures::spread() const {
  Spread all;
  const auto count = static_cast<double>(fingers_.size());
  for (const auto& [number, finger] : fingers_) {
    all.middle.x += finger.at.x / count;
    all.middle.y += finger.at.y / count;
  }
  for (const auto& [number, finger] : fingers_) {
    all.radius += std::hypot(finger.at.x - all.middle.x, finger.at.y - all.middle.y) / count;
  }
  return all;
}

/// An outline lies over the picture as it was.
void TouchGestures::move(const InputEvent& event) {
  const auto found = fingers_.find(event.finger);
  if (found == fingers_.end()) return;
  const Spread before = spread();
  found->second.at = place_of(event);
  if (!has_view_ || fingers_.size() < 2) return;
  if (!has_moved_) {
    has_moved_ = is_beyond_tap(found->second);  // from there on, so that the view does not jump
    return;
  }
  if (ui_.outline) return;
  const Spread now = spread();
  ui_.camera.pan(now.middle.x - before.middle.x, now.middle.y - before.middle.y);
  // Of fingers that lie on each other the ratio would be anything.
  constexpr double kLeastPixels = 4.0;
  if (std::min(before.radius, now.radius) < kLeastPixels) return;
  ui_.camera.zoom(now.radius / before.radius,
                  between_eyes(ui_.camera, ui_.show.is_stereo, now.middle));
}

std::optional<Command> TouchGestures::lift(const InputEvent& event) {
  if (fingers_.erase(event.finger) == 0 || !fingers_.empty()) return std::nullopt;
  const bool is_tap = has_view_ && !has_moved_ && event.time_s - first_s_ <= kTapS;
  has_view_ = false;
  if (is_tap && most_ == 2) return Command::undo;
  if (is_tap && most_ == 3) return Command::redo;
  return std::nullopt;
}

}  // namespace argil::viewer
