// SPDX-License-Identifier: GPL-3.0-or-later
// Brushes with names: the palette, and how they are saved, given keys and removed.
#include <algorithm>
#include <string>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "commands/favourite_choice.h"
#include "commands/preset_choice.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "gui/tool_picture.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kPresetsWidth = 252.0F;  // units
constexpr float kPresetTile = 76.0F;
constexpr int kPresetColumns = 3;
constexpr int kPresetRows = 4;  // without scrolling

const ToolInfo* tool_of_preset(const BrushPreset& preset) {
  for (const ToolInfo& info : tool_infos()) {
    if (is_chosen(preset.brush, info)) return &info;
  }
  return nullptr;
}

/// Its tool's picture with the name below and its key in the corner.
void draw_preset(const BrushPreset& preset, UiState& ui) {
  const float u = unit();
  const float side = kPresetTile * u;
  if (tile(preset.name.c_str(), static_cast<double>(side), static_cast<double>(0.8F * side))) {
    choose_preset(preset, ui);
  }
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) toggle_favourite(preset.name, ui);
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 low = ImGui::GetItemRectMin();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_on = ui.preset_choice.chosen == preset.name;
  if (is_on || ImGui::IsItemHovered()) {
    const ImGuiCol color = is_on ? ImGuiCol_Header : ImGuiCol_ButtonHovered;
    list.AddRectFilled(low, ImGui::GetItemRectMax(), ImGui::GetColorU32(color), 3.0F * u);
  }
  const std::string key = preset_key_text(preset, ui);
  if (const ToolInfo* tool = tool_of_preset(preset)) {
    draw_tool_picture(tool->picture, list, {low.x + 11.0F * u, low.y + 3.0F * u}, 54.0F * u);
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s, %s%s%s", preset.name.c_str(), tool->title, key.empty() ? "" : "\n",
                        key.c_str());
    }
  }
  const float letters = ImGui::GetFontSize();
  const float small = 0.74F * letters;
  const float key_width =
      ImGui::GetFont()->CalcTextSizeA(small, side, 0.0F, key.c_str()).x + 13.0F * u;
  list.AddText(ImGui::GetFont(), small, {low.x + side - key_width, low.y + 3.0F * u},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), key.c_str());
  const std::string name = fitted(preset.name, side - 4.0F * u);
  const float width = ImGui::CalcTextSize(name.c_str()).x;
  list.AddText({low.x + 0.5F * (side - width), low.y + 0.8F * side - letters - 2.0F * u},
               ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
}

/// What is done to the one that was chosen last.
void draw_chosen_preset(UiState& ui) {
  PresetChoice& choice = ui.preset_choice;
  const BrushPreset* preset = preset_named(choice.chosen, ui);
  if (preset == nullptr) return;
  ImGui::Separator();
  const Favourite favourite = preset->name;
  const bool is_favourite = place_of(favourite, ui).has_value();
  if (star("star of the brush", is_favourite)) toggle_favourite(favourite, ui);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(is_favourite ? "a favourite; a click: no more" : "make it a favourite");
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(fitted(preset->name, 200.0F * unit()).c_str());
  const std::string key = preset_key_text(*preset, ui);
  const std::string shown = choice.waits_for_key ? "press a key..." : key.empty() ? "no key" : key;
  if (button("preset key", shown, static_cast<double>(110.0F * unit()))) {
    choice.waits_for_key = true;
    choice.refused.clear();
  }
  ImGui::SameLine();
  // A built-in one cannot be removed: it would be back at the next start.
  ImGui::BeginDisabled(preset->is_built_in);
  if (button("Remove##preset")) remove_preset(choice.chosen, ui);
  ImGui::EndDisabled();
}

}  // namespace

void draw_presets(UiState& ui) {
  if (!ui.panels.has_presets) return;
  put_beside(kPiecesPanelLeft, kPresetsWidth);
  ImGui::SetNextWindowSize({kPresetsWidth * unit(), 0.0F});
  keep_on_screen(kPresetsWidth);
  ImGui::Begin("Presets", &ui.panels.has_presets, ImGuiWindowFlags_NoSavedSettings);
  const int count = static_cast<int>(ui.presets.size());
  const int rows = std::clamp((count + kPresetColumns - 1) / kPresetColumns, 1, kPresetRows);
  ImGui::BeginChild("##presets",
                    {0.0F, static_cast<float>(rows) * (0.8F * kPresetTile + 4.0F) * unit()});
  int column = 0;
  for (const BrushPreset& preset : ui.presets) {
    if (column > 0) ImGui::SameLine(0.0F, 2.0F * unit());
    draw_preset(preset, ui);
    column = (column + 1) % kPresetColumns;
  }
  ImGui::EndChild();
  draw_chosen_preset(ui);
  ImGui::Separator();
  PresetChoice& choice = ui.preset_choice;
  ImGui::SetNextItemWidth(130.0F * unit());
  const bool is_entered = text_field("##preset name", choice.name);
  ImGui::SameLine();
  const bool is_pressed = button("Save brush");
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("the brush as it is now, under this name;\none of that name is replaced");
  }
  if (is_entered || is_pressed) save_preset(ui);
  if (!choice.refused.empty()) {
    ImGui::PushTextWrapPos(0.0F);
    colored_text(shown_colors().warning, choice.refused);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  if (!ui.panels.has_presets) choice.waits_for_key = false;
}

}  // namespace argil::viewer
