// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::viewer {

/// Where a dialog stands: in the middle, or at the right edge, over panels that wait meanwhile and
/// not over the clay that it is about.
struct DialogLayout {
  bool is_beside = false;
  float width = 380.0F;  ///< in units (layout.h), as the height
  float height = 0.0F;   ///< 0: as its content needs
};

/// A window that has to be answered first: nothing behind it reacts. True while it is open: then
/// its content follows, and end_dialog(). `is_open` becomes false when it is closed; null
/// where it can only be answered. One dialog at a time (open_dialog).
bool begin_dialog(const char* title, bool is_wanted, bool* is_open,
                  const DialogLayout& layout = {});
void end_dialog();

}  // namespace argil::viewer
