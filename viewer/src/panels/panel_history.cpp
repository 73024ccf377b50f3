// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to the clay, step by step.
#include <algorithm>
#include <cassert>
#include <cstdio>
#include <string>

#include <imgui.h>

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

/// "214 steps, 36 MB".
std::string words_of_kept(const StepNames& steps) {
  constexpr double kMegabyte = 1e6;
  const std::size_t count = steps.names.size();
  char text[96];
  std::snprintf(text, sizeof text, "%zu %s, %.3g MB", count, count == 1 ? "step" : "steps",
                static_cast<double>(steps.kept.bytes) / kMegabyte);
  return text;
}

/// How much of it the next window will find, and a way to drop that.
void draw_kept(const UiState& ui, const StepNames& steps, DocumentThread& document) {
  const bool may_forget =
      steps.kept.steps > 0 && !ui.task.is_running && !ui.clay.is_changed && !ui.clay.is_untitled;
  ImGui::BeginDisabled(!may_forget);
  if (ImGui::SmallButton("Forget...")) ImGui::OpenPopup("forget");
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::SetTooltip("Drops all steps, also those that the disk keeps.\nSave first.");
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(words_of_kept(steps).c_str());
  // It cannot be taken back; a click beside it, or Esc, keeps them.
  if (!ImGui::BeginPopup("forget")) return;
  ImGui::TextUnformatted("No undo any more, the clay stays.");
  if (button("Forget all steps") && may_forget) {
    document.send(ForgetHistory{});
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace

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
  draw_kept(ui, steps, document);
  ImGui::BeginChild("steps");
  // A stroke changes the list when it ends.
  const bool may_go = !ui.task.is_running && !ui.clay.is_stroke_open && !steps.has_unread;
  if (steps.has_unread) ImGui::TextDisabled("older steps are being read");
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
    // Above it, undo goes on by what the disk keeps.
    if (steps.older > 0 && n == steps.older) ImGui::Separator();
    // The newest step stays in sight.
    if (is_current && ui.shown_step != n) {
      ImGui::SetScrollHereY();
      ui.shown_step = n;
    }
  }
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace argil::viewer
