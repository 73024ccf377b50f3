// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/cut_off.h"

#include <optional>
#include <utility>

#include <imgui.h>
#include <imgui_internal.h>  // the windows of the last frame

#include "gui/gui.h"

namespace argil::viewer {
namespace {

/// Of sizes that are rounded one by one.
constexpr float kRoundedPixels = 1.5F;
constexpr int kLastingFrames = 3;

bool has_flag(const ImGuiWindow& window, ImGuiWindowFlags flag) {
  return (window.Flags & flag) != 0;
}

bool is_beyond_screen(const ImGuiWindow& window) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const ImVec2 low = window.Pos;
  const ImVec2 high = {low.x + window.Size.x, low.y + window.Size.y};
  return low.x < -kRoundedPixels || low.y < -kRoundedPixels || high.x > screen.x + kRoundedPixels ||
         high.y > screen.y + kRoundedPixels;
}

/// How a window that is shown is cut off, if it is.
std::optional<std::string> fault_of(const ImGuiWindow& window) {
  if (!has_flag(window, ImGuiWindowFlags_ChildWindow) && is_beyond_screen(window)) {
    return "reaches beyond the screen";
  }
  // What would have to be scrolled to. A window without a bar could be by the wheel, but no one
  // knows.
  if (window.ScrollMax.x > kRoundedPixels &&
      !has_flag(window, ImGuiWindowFlags_HorizontalScrollbar)) {
    return "is too narrow";
  }
  // The main menu bar is as high as Dear ImGui makes it, and counts what its menu hides.
  if (window.ScrollMax.y > kRoundedPixels && !has_flag(window, ImGuiWindowFlags_MenuBar) &&
      has_flag(window, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoMouseInputs)) {
    return "is not high enough";
  }
  return std::nullopt;
}

}  // namespace

void CutOff::look() {
  std::map<std::string, int> now;
  const auto note = [&](const std::string& fault) {
    const auto before = frames_.find(fault);
    now[fault] = before == frames_.end() ? 1 : before->second + 1;
    if (now[fault] >= kLastingFrames) found_.insert(fault);
  };
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || window->Hidden || window->Collapsed) continue;
    const std::string name = window->Name;
    if (const auto fault = fault_of(*window)) note(name + " " + *fault);
    const bool has_title = name.find("##") == std::string::npos;
    if (has_title && !has_flag(*window, ImGuiWindowFlags_ChildWindow)) panels_.insert(name);
  }
  for (const std::string& words : narrow_buttons()) note(words + " is wider than its button");
  frames_ = std::move(now);
}

}  // namespace argil::viewer
