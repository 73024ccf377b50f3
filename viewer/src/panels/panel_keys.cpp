// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of all commands and tools, to be changed by pressing them.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "commands/key_choice.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kKeysWidth = 400.0F;  // units
constexpr float kKeyButtonWidth = 130.0F;

const char* group_of(const KeyAim& aim) {
  const auto* command = std::get_if<Command>(&aim);
  return command != nullptr ? info_of(*command).menu : "Tools";
}

/// A button of this text that a script finds by the name of the aim: "key undo".
bool aim_button(const char* what, const std::string& text, const KeyAim& aim, float width) {
  const std::string id = std::string(what) + " " + std::string(name_of(aim));
  return button(id, text, static_cast<double>(width));
}

/// What it is, its key, and ways to be without one or to have that of the set again.
void draw_aim(const KeyAim& aim, UiState& ui) {
  const bool is_waiting = ui.key_choice.waiting == aim;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title_of(aim));
  ImGui::SameLine(170.0F * unit());
  ImGui::BeginDisabled(is_fixed(aim));
  if (is_waiting) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
  const std::string text = is_waiting ? "press a key..." : ui.keys.text_of(aim);
  if (aim_button("key", text, aim, kKeyButtonWidth * unit())) wait_for_key(aim, ui);
  if (is_waiting) ImGui::PopStyleColor();
  ImGui::EndDisabled();
  if (is_fixed(aim)) return;
  if (ui.keys.chord_of(aim)) {
    ImGui::SameLine();
    if (aim_button("no", "x", aim, 0.0F)) ui.keys.give(aim, std::nullopt);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("no key");
  }
  if (!ui.keys.is_own(aim)) return;
  ImGui::SameLine();
  if (aim_button("set", "reset", aim, 0.0F)) ui.keys.reset(aim);
  if (ImGui::IsItemHovered()) {
    const auto built_in = built_in_chord(ui.keys.set(), aim);
    ImGui::SetTooltip("as %s has it: %s", kKeySetTitles[static_cast<std::size_t>(ui.keys.set())],
                      built_in ? text_of(*built_in).c_str() : "no key");
  }
}

/// Below the list: what became of the last key.
void draw_key_question(UiState& ui) {
  KeyChoice& choice = ui.key_choice;
  ImGui::PushTextWrapPos(0.0F);
  if (!choice.waiting) {
    ImGui::TextDisabled("Click a key, then press the new one.");
  } else if (choice.wanted) {
    const auto owner = ui.keys.aim_of(*choice.wanted);
    ImGui::Text("%s is the key of %s.", text_of(*choice.wanted).c_str(),
                owner ? in_quotes(title_of(*owner)).c_str() : "something else");
  } else if (!choice.refused.empty()) {
    ImGui::TextUnformatted((choice.refused + ".").c_str());
  } else {
    ImGui::Text("Press the key for %s; Esc leaves it as it is.",
                in_quotes(title_of(*choice.waiting)).c_str());
  }
  ImGui::PopTextWrapPos();
  if (!choice.waiting || !choice.wanted) return;
  if (button("Take it from there")) {
    answer_key_question(true, ui);
    return;
  }
  ImGui::SameLine();
  if (button("Leave it there")) answer_key_question(false, ui);
}

/// Whose keys, and how many are the user's own.
void draw_key_set(UiState& ui) {
  int set = static_cast<int>(ui.keys.set());
  ImGui::SetNextItemWidth(kKeyButtonWidth * unit());
  if (pick_one("Keys and mouse of", set, {kKeySetTitles.begin(), kKeySetTitles.end()})) {
    ui.keys.choose(static_cast<KeySet>(set));
    ui.key_choice.waiting.reset();
  }
  const std::size_t own = ui.keys.own_count();
  if (own == 0) return;
  ImGui::TextDisabled("%d of your own", static_cast<int>(own));
  ImGui::SameLine();
  if (!ui.key_choice.asks_to_reset) {
    ui.key_choice.asks_to_reset = button("Reset all...");
    return;
  }
  // They cannot be brought back.
  if (button("Forget my keys")) {
    ui.keys.reset();
    ui.key_choice.asks_to_reset = false;
  }
  ImGui::SameLine();
  if (button("Keep them")) ui.key_choice.asks_to_reset = false;
}

}  // namespace

void say_key(const KeyAim& aim, const UiState& ui) {
  const std::string& key = ui.keys.text_of(aim);
  if (!key.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", key.c_str());
}

void draw_keys(UiState& ui) {
  if (!ui.panels.has_keys) return;
  put_beside(kPiecesPanelLeft, kKeysWidth);
  ImGui::SetNextWindowSize({kKeysWidth * unit(), 0.0F});
  keep_on_screen(kKeysWidth);
  ImGui::Begin("Change keys", &ui.panels.has_keys,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  draw_key_set(ui);
  ImGui::SetNextItemWidth(kKeyButtonWidth * unit());
  text_field("Find", ui.key_choice.filter);
  const float room = ImGui::GetIO().DisplaySize.y - 14.0F * ImGui::GetFrameHeight();
  ImGui::BeginChild("all keys", {0.0F, std::clamp(room, 80.0F * unit(), 420.0F * unit())}, true);
  std::string_view group;
  for (const KeyAim& aim : all_key_aims()) {
    if (!is_meant_by(ui.key_choice.filter, aim, ui.keys)) continue;
    if (group != group_of(aim)) {
      group = group_of(aim);
      ImGui::TextDisabled("%s", group_of(aim));
    }
    draw_aim(aim, ui);
  }
  ImGui::EndChild();
  draw_key_question(ui);
  ImGui::End();
  if (!ui.panels.has_keys) ui.key_choice = {};
}

}  // namespace argil::viewer
