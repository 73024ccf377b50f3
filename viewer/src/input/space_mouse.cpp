// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/space_mouse.h"

#include <algorithm>

#include <spnav.h>

namespace argil::viewer {
namespace {

constexpr double kFull = 350.0;    // what the daemon reports for a puck at its stop
constexpr double kLongestS = 0.1;  // of one motion: the first after a rest reports the whole rest
constexpr double kMsToS = 0.001;

/// Each axis as a fraction of its full deflection, -1 to 1.
Vec3 fraction_of_full(int x, int y, int z) {
  const auto fraction_of = [](int value) { return std::clamp(value / kFull, -1.0, 1.0); };
  return {fraction_of(x), fraction_of(y), fraction_of(z)};
}

}  // namespace

std::unique_ptr<SpaceMouse> SpaceMouse::open() {
  if (spnav_open() == -1) return nullptr;
  return std::unique_ptr<SpaceMouse>(new SpaceMouse());
}

SpaceMouse::~SpaceMouse() { spnav_close(); }

std::vector<InputEvent> SpaceMouse::poll() {
  std::vector<InputEvent> events;
  spnav_event came;
  while (spnav_poll_event(&came) != 0) {
    InputEvent event;
    if (came.type == SPNAV_EVENT_MOTION) {
      event.kind = InputEvent::Kind::puck;
      event.puck_shift = fraction_of_full(came.motion.x, came.motion.y, came.motion.z);
      event.puck_turn = fraction_of_full(came.motion.rx, came.motion.ry, came.motion.rz);
      event.puck_s = std::min(kMsToS * came.motion.period, kLongestS);
      // Only the first button: what the others are for differs from model to model.
    } else if (came.type == SPNAV_EVENT_BUTTON && came.button.bnum == 0) {
      event.kind = came.button.press != 0 ? InputEvent::Kind::key_down : InputEvent::Kind::key_up;
      event.key = kKeyHome;
    } else {
      continue;
    }
    events.push_back(event);
  }
  return events;
}

}  // namespace argil::viewer
