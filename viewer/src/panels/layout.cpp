// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/layout.h"

#include <algorithm>
#include <cassert>

namespace argil::viewer {

void keep_on_screen(float width) {
  assert(width > 0.0F);
  // Between the menu and the status line, and one height of air.
  const float most = ImGui::GetIO().DisplaySize.y - 3.0F * ImGui::GetFrameHeight();
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, most});
}

void put_beside(float left, float width) {
  assert(left >= 0.0F && width > 0.0F);
  const float most = std::max(0.0F, ImGui::GetIO().DisplaySize.x - width);
  ImGui::SetNextWindowPos({std::min(left, most), ImGui::GetFrameHeight() + 12.0F},
                          ImGuiCond_FirstUseEver);
}

}  // namespace argil::viewer
