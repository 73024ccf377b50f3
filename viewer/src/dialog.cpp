// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialog.h"

#include <algorithm>

#include <imgui.h>

namespace argil::viewer {
namespace {

/// Before the dialog: what it is about stays as bright as it was where it is to be looked at.
void shade_rest(bool is_beside) {
  ImGui::GetStyle().Colors[ImGuiCol_ModalWindowDimBg] = {0.05F, 0.05F, 0.06F,
                                                         is_beside ? 0.0F : 0.45F};
}

void put_next(const DialogPlace& place) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (place.is_beside) {
    const float top = ImGui::GetFrameHeight() + 6.0F;
    ImGui::SetNextWindowPos({screen.x - 6.0F, top}, ImGuiCond_Always, {1.0F, 0.0F});
  } else {
    ImGui::SetNextWindowPos({0.5F * screen.x, 0.47F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  }
  ImGui::SetNextWindowSize({std::min(place.width, screen.x), std::min(place.height, screen.y)});
}

}  // namespace

bool begin_dialog(const char* title, bool is_wanted, bool* is_open, const DialogPlace& place) {
  if (is_wanted && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  if (!ImGui::IsPopupOpen(title)) return false;
  shade_rest(place.is_beside);
  put_next(place);
  if (!ImGui::BeginPopupModal(title, is_open,
                              ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
    return false;
  }
  if (is_wanted) return true;
  ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return false;
}

void end_dialog() { ImGui::EndPopup(); }

}  // namespace argil::viewer
