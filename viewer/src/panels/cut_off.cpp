// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/cut_off.h"

#include <optional>

#include <imgui.h>
#include <imgui_internal.h>  // the windows of the last frame

namespace argil::viewer {
namespace {

/// Of sizes that are rounded one by one.
constexpr float kRoundedPixels = 1.5F;
constexpr int kLastingFrames = 3;

bool is_beyond_screen(const ImGuiWindow& window) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const ImVec2 low = window.Pos;
  const ImVec2 high = {low.x + window.Size.x, low.y + window.Size.y};
  return low.x < -kRoundedPixels || low.y < -kRoundedPixels || high.x > screen.x + kRoundedPixels ||
         high.y > screen.y + kRoundedPixels;
}

/// How a window of the last frame is cut off, if it is.
std::optional<std::string> fault_of(const ImGuiWindow& window) {
  const auto has = [&](ImGuiWindowFlags flag) { return (window.Flags & flag) != 0; };
  if (!window.Active || window.Hidden || window.Collapsed) return std::nullopt;
  if (!has(ImGuiWindowFlags_ChildWindow) && is_beyond_screen(window)) {
    return "reaches beyond the screen";
  }
  // What scrolling would have to reach.
  if (window.ScrollMax.x > kRoundedPixels && !has(ImGuiWindowFlags_HorizontalScrollbar)) {
    return "is too narrow";
  }
  const bool scrolls =
      !has(ImGuiWindowFlags_NoScrollbar) || !has(ImGuiWindowFlags_NoScrollWithMouse);
  if (window.ScrollMax.y > kRoundedPixels && !scrolls) return "is too low";
  return std::nullopt;
}

}  // namespace

void CutOff::look() {
  std::map<std::string, int> now;
  const auto note = [&](const std::string& name, const std::string& how) {
    const std::string fault = name + " " + how;
    const auto before = frames_.find(fault);
    now[fault] = before == frames_.end() ? 1 : before->second + 1;
    if (now[fault] >= kLastingFrames) found_.insert(fault);
  };
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (const auto fault = fault_of(*window)) note(window->Name, *fault);
  }
  for (const std::string& label : narrow_buttons()) note(label, "is wider than its button");
  frames_ = std::move(now);
}

}  // namespace argil::viewer
