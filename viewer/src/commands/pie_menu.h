// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "picture/camera.h"

namespace argil::viewer {

// Of the ring of favourites, in units of panels (UiState::panel_scale pixels each), from its
// middle.
inline constexpr double kPieMiddle = 30.0;   ///< as far as that it chooses nothing
inline constexpr double kPieReach = 130.0;   ///< its edge
inline constexpr double kPieBeyond = 170.0;  ///< a click out there is meant for what lies there

/// The ring of favourites while it is open.
struct PieMenu {
  bool is_open = false;
  Camera::Pixel opened_at;  ///< the pointer then; the ring stands there, or as near as it fits
  double opened_s = 0.0;    ///< of the window's clock
  int held_key = 0;         ///< that opened it, until it is let go; 0: none
  bool has_left = false;    ///< the pointer was out of the middle since then
  std::optional<std::size_t> marked;  ///< the place that letting go of the key chooses
};

}  // namespace argil::viewer
