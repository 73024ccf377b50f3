// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/dialog.h"

#include <algorithm>
#include <cassert>

#include <imgui.h>

#include "gui/layout.h"

namespace argil::viewer {
namespace {

/// Dims what is behind the dialog, unless the dialog stands beside the clay that it is about.
void shade_rest(bool is_beside) {
  ImGui::GetStyle().Colors[ImGuiCol_ModalWindowDimBg] = {0.05F, 0.05F, 0.06F,
                                                         is_beside ? 0.0F : 0.45F};
}

/// Position and size of the window that begins next.
void put_next(const DialogLayout& layout) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (layout.is_beside) {
    const float top = ImGui::GetFrameHeight() + 6.0F * unit();
    ImGui::SetNextWindowPos({screen.x - 6.0F * unit(), top}, ImGuiCond_Always, {1.0F, 0.0F});
  } else {
    ImGui::SetNextWindowPos({0.5F * screen.x, 0.47F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  }
  ImGui::SetNextWindowSize(
      {std::min(layout.width * unit(), screen.x), std::min(layout.height * unit(), screen.y)});
}

}  // namespace

bool begin_dialog(const char* title, bool is_wanted, bool* is_open, const DialogLayout& layout) {
  assert(layout.width > 0.0F && layout.height >= 0.0F);
  if (is_wanted && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  if (!ImGui::IsPopupOpen(title)) return false;
  shade_rest(layout.is_beside);
  put_next(layout);
  if (!ImGui::BeginPopupModal(title, is_open,
                              ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
    return false;
  }
  if (is_wanted) return true;
  // Closed by the program: Dear ImGui does so only from inside.
  ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return false;
}

void end_dialog() { ImGui::EndPopup(); }

}  // namespace argil::viewer
