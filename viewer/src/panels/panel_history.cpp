// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to the clay, step by step.
#include <algorithm>
#include <cassert>

#include <imgui.h>

#include "panels/gui.h"
#include "panels/layout.h"
#include "panels/panels.h"

namespace argil::viewer {

void draw_history(UiState& ui, DocumentThread& document) {
  if (!ui.panels.has_history) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = 220.0F * unit();
  // In the lower half, since the panel for printing is wide.
  const float left = std::min(kHistoryPanelLeft * unit(), std::max(0.0F, screen.x - width));
  ImGui::SetNextWindowPos({left, 0.5F * screen.y}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, std::min(360.0F * unit(), 0.45F * screen.y)},
                           ImGuiCond_FirstUseEver);
  ImGui::Begin("History", &ui.panels.has_history, ImGuiWindowFlags_NoSavedSettings);
  if (!ui.clay.steps) {
    ImGui::TextUnformatted("no clay");
    ImGui::End();
    return;
  }
  const StepNames& steps = *ui.clay.steps;
  assert(steps.done <= steps.names.size());
  // A stroke changes the list when it ends.
  const bool may_go = !ui.task.is_running && !ui.clay.is_stroke_open;
  for (std::size_t n = 0; n <= steps.names.size(); ++n) {
    // The number makes labels unique: Dear ImGui tells widgets apart by them.
    const std::string label =
        n == 0 ? std::string("Start") : std::to_string(n) + ": " + steps.names[n - 1];
    const bool is_current = n == steps.done;
    const ImVec4 color =
        ImGui::GetStyleColorVec4(n > steps.done ? ImGuiCol_TextDisabled : ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    if (choice(label.c_str(), is_current) && may_go) document.send(GoToStep{n});
    ImGui::PopStyleColor();
    // The newest step stays in sight.
    if (is_current && ui.shown_step != n) {
      ImGui::SetScrollHereY();
      ui.shown_step = n;
    }
  }
  ImGui::End();
}

}  // namespace argil::viewer
