// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "gestures/gestures.h"
#include "support/scratch.h"

namespace argil::viewer {

/// Gestures before a wall that fills the picture, in stereo one before each eye.
class GesturesTest : public testing::Test {
 protected:
  GesturesTest() {
    ui_.camera.resize(64, 64);
    ui_.clay.has_clay = true;
  }

  /// As far away as the target, where a pixel of the window lies.
  SurfaceProbe wall(const Camera::Pixel& pixel) const {
    const WindowPart part = part_at(ui_.camera, ui_.show.is_stereo, pixel);
    DepthMap depth;
    depth.width = part.camera.width();
    depth.height = part.camera.height();
    depth.depth_mm.assign(
        static_cast<std::size_t>(depth.width) * static_cast<std::size_t>(depth.height),
        static_cast<float>(part.camera.distance_mm()));
    if (is_wall_other_) depth.is_other.assign(depth.depth_mm.size(), 1);
    return {depth, part};
  }

  void mouse(InputEvent::Kind kind, MouseButton button = MouseButton::left) {
    InputEvent event;
    event.kind = kind;
    event.button = button;
    event.x = pointer_.x;
    event.y = pointer_.y;
    gestures_.on(event, false);
  }
  void mouse_at(InputEvent::Kind kind, const Camera::Pixel& pixel) {
    pointer_ = pixel;
    mouse(kind);
  }

  void key(int number, bool is_repeat = false, const Modifiers& modifiers = {}) {
    InputEvent event;
    event.kind = InputEvent::Kind::key_down;
    event.key = number;
    event.is_repeat = is_repeat;
    event.modifiers = modifiers;
    gestures_.on(event, false);
  }

  Camera::Pixel pointer_{32.0, 32.0};
  bool is_wall_other_ = false;  ///< the wall is another piece than the active one
  test::ScratchFolder folder_;
  UiState ui_;
  DocumentThread document_{DocumentThreadOptions{folder_.path()}};
  Gestures gestures_{ui_, document_, [this](const Camera::Pixel& at) { return wall(at); }};
};

}  // namespace argil::viewer
