// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/touch_gestures.h"

#include <algorithm>
#include <cmath>

#include "commands/command.h"
#include "picture/stereo.h"

namespace argil::viewer {
namespace {

/// A tap is no longer and no farther than this; pixels of a screen of usual letters.
constexpr double kTapS = 0.3;
constexpr double kTapPixels = 12.0;

Camera::Pixel place_of(const InputEvent& event) { return {event.x, event.y}; }

}  // namespace

bool TouchGestures::on(const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::finger_down:
      return press(event);
    case InputEvent::Kind::finger_move:
      move(event);
      return false;
    case InputEvent::Kind::finger_up:
      lift(event);
      return false;
    default:
      return false;
  }
}

bool TouchGestures::press(const InputEvent& event) {
  if (fingers_.empty()) {
    first_s_ = event.time_s;
    most_ = 0;
    has_moved_ = false;
  }
  fingers_[event.finger] = {place_of(event), place_of(event)};
  most_ = std::max(most_, fingers_.size());
  const bool is_second = fingers_.size() == 2 && !has_view_;
  has_view_ = has_view_ || is_second;
  return is_second;
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

/// An outline lies over the picture as it was, and what a dialog asks about stays in sight.
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
  if (ui_.outline || open_dialog(ui_) != Dialog::none) return;
  const Spread now = spread();
  ui_.camera.pan(now.middle.x - before.middle.x, now.middle.y - before.middle.y);
  // Of fingers that lie on each other the ratio would be anything.
  constexpr double kLeastPixels = 4.0;
  if (std::min(before.radius, now.radius) < kLeastPixels) return;
  ui_.camera.zoom(now.radius / before.radius,
                  between_eyes(ui_.camera, ui_.show.is_stereo, now.middle));
}

void TouchGestures::lift(const InputEvent& event) {
  if (fingers_.erase(event.finger) == 0 || !fingers_.empty()) return;
  const bool is_tap = has_view_ && !has_moved_ && event.time_s - first_s_ <= kTapS;
  has_view_ = false;
  if (!is_tap || ui_.outline || open_dialog(ui_) != Dialog::none) return;
  if (most_ == 2) perform(Command::undo, ui_, document_);
  if (most_ == 3) perform(Command::redo, ui_, document_);
}

}  // namespace argil::viewer
