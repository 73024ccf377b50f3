// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "commands/gestures.h"
#include "support/scratch.h"

namespace argil::viewer {

/// Gestures before a wall that fills the picture.
class GesturesTest : public testing::Test {
 protected:
  GesturesTest() {
    ui_.camera.resize(64, 64);
    ui_.clay.has_clay = true;
  }

  SurfaceProbe wall() const {
    DepthMap depth;
    depth.width = depth.height = 64;
    depth.depth_mm.assign(64 * 64, static_cast<float>(ui_.camera.distance_mm()));
    return {depth, ui_.camera};
  }

  void mouse(InputEvent::Kind kind, MouseButton button = MouseButton::left) {
    InputEvent event;
    event.kind = kind;
    event.button = button;
    event.x = event.y = 32.0;
    gestures_.on(event, false);
  }

  void key(int number, bool is_repeat = false, const Modifiers& modifiers = {}) {
    InputEvent event;
    event.kind = InputEvent::Kind::key_down;
    event.key = number;
    event.is_repeat = is_repeat;
    event.modifiers = modifiers;
    gestures_.on(event, false);
  }

  test::ScratchFolder folder_;
  UiState ui_;
  DocumentThread document_{DocumentThreadOptions{folder_.path()}};
  Gestures gestures_{ui_, document_, [this] { return wall(); }};
};

}  // namespace argil::viewer
