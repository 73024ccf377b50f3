// SPDX-License-Identifier: GPL-3.0-or-later
#include "space_mouse.h"

#include <algorithm>

#include <spnav.h>

namespace argil::viewer {
namespace {

constexpr double kFull = 350.0;    // what the daemon says of a puck at its stop
constexpr double kLongestS = 0.1;  // of one motion: the first after a rest tells of the rest
constexpr double kMsToS = 0.001;

Vec3 share_of_full(int x, int y, int z) {
  const auto share = [](int value) { return std::clamp(value / kFull, -1.0, 1.0); };
  return {share(x), share(y), share(z)};
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
      event.puck_shift = share_of_full(came.motion.x, came.motion.y, came.motion.z);
      event.puck_turn = share_of_full(came.motion.rx, came.motion.ry, came.motion.rz);
      event.puck_s = std::min(kMsToS * came.motion.period, kLongestS);
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
