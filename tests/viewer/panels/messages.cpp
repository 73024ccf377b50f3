// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "panels/panels.h"
#include "viewer/support/imgui_frames.h"

namespace argil::viewer {
namespace {

/// Where a window stands in the order in which they are drawn; -1 where there is none.
std::ptrdiff_t place_of(const std::string& name) {
  const auto& windows = ImGui::GetCurrentContext()->Windows;
  const auto* found = std::find_if(windows.begin(), windows.end(),
                                   [&](const ImGuiWindow* window) { return window->Name == name; });
  return found == windows.end() ? -1 : found - windows.begin();
}

TEST(Toasts, AreDrawnOverAPanelThatIsWorkedIn) {
  const test::ImGuiFrames frames;
  MessageLog log;
  log.add({Notice::Kind::done, "saved"}, 0.0, "14:00:00");
  for (int frame = 0; frame < 4; ++frame) {
    ImGui::NewFrame();
    ImGui::Begin("panel");
    ImGui::End();
    draw_toasts(log);
    if (frame == 1) ImGui::SetWindowFocus("panel");
    ImGui::EndFrame();
  }
  EXPECT_GE(place_of("panel"), 0);
  EXPECT_GT(place_of("##toast0"), place_of("panel"));
}

}  // namespace
}  // namespace argil::viewer
