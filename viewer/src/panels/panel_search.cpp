// SPDX-License-Identifier: GPL-3.0-or-later
// The search of commands: a line to type into, and what it finds, with keys.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "commands/command.h"
#include "commands/command_search.h"
#include "commands/favourite_choice.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kSearchWidth = 420.0F;  // units
constexpr std::size_t kSearchRows = 12;
constexpr float kStarLeft = 396.0F;

/// What was typed, with a caret: keys and letters come by way of the gestures (search_takes), so
/// that none is lost before a field has the keyboard.
void draw_search_text(const SearchChoice& choice) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x;
  const float high = ImGui::GetFrameHeight();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + wide, low.y + high}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                     3.0F * unit());
  const ImVec2 at{low.x + 6.0F * unit(), low.y + 0.5F * (high - ImGui::GetFontSize())};
  const float end = at.x + ImGui::CalcTextSize(choice.text.c_str()).x;
  list.PushClipRect(low, {low.x + wide, low.y + high}, true);
  list.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), choice.text.c_str());
  if (choice.text.empty()) {
    list.AddText({at.x + 4.0F * unit(), at.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                 "a command, a tool or a view");
  }
  list.AddLine({end + unit(), at.y}, {end + unit(), at.y + ImGui::GetFontSize()},
               ImGui::GetColorU32(ImGuiCol_CheckMark), 1.4F * unit());
  list.PopClipRect();
  ImGui::Dummy({wide, high});
}

/// True when it is clicked; `is_starred` when its star is.
bool draw_search_row(const SearchEntry& entry, bool is_marked, bool is_possible_now,
                     bool is_favourite, bool& is_starred) {
  const ImGuiCol color = is_possible_now ? ImGuiCol_Text : ImGuiCol_TextDisabled;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(color));
  const std::string label = entry.title + "##found" + entry.place;
  // Weak letters are not read on the mark's colour.
  const ImGuiCol mark = is_possible_now ? ImGuiCol_Header : ImGuiCol_FrameBg;
  ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(mark));
  // One row is marked: the one that Enter means.
  ImGui::PushStyleColor(ImGuiCol_HeaderHovered,
                        ImGui::GetStyleColorVec4(is_marked ? mark : ImGuiCol_FrameBg));
  // As far as the star, which takes its own clicks.
  const bool is_clicked =
      choice(label.c_str(), is_marked, static_cast<double>((kStarLeft - 14.0F) * unit()));
  ImGui::PopStyleColor(3);
  const ImVec4 beside = ImGui::GetStyleColorVec4(is_marked ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  ImGui::SameLine(220.0F * unit());
  ImGui::TextColored(beside, "%s", entry.place.c_str());
  ImGui::SameLine(300.0F * unit());
  ImGui::TextColored(beside, "%s", entry.chord.c_str());
  ImGui::SameLine(kStarLeft * unit());
  const std::string star_label = "star " + entry.title + "##" + entry.place;
  is_starred = star(star_label.c_str(), is_favourite);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(is_favourite ? "a favourite; Ctrl+Enter: no more"
                                   : "make it a favourite: Ctrl+Enter");
  }
  return is_clicked;
}

}  // namespace

void draw_search(UiState& ui, DocumentThread& document) {
  SearchChoice& search = ui.search;
  if (!search.is_open) return;
  const std::vector<SearchEntry> found = found_entries(search, ui.keys);
  search.at = std::min(search.at, found.empty() ? 0 : found.size() - 1);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * screen.x, ImGui::GetFrameHeight() + 24.0F * unit()},
                          ImGuiCond_Always, {0.5F, 0.0F});
  ImGui::SetNextWindowSize({kSearchWidth * unit(), 0.0F});
  keep_on_screen(kSearchWidth);
  ImGui::Begin(
      "##search", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  draw_search_text(search);
  // As many as fit, those around the mark.
  const std::size_t first = search.at < kSearchRows ? 0 : search.at - kSearchRows + 1;
  const std::size_t last = std::min(found.size(), first + kSearchRows);
  if (found.empty()) ImGui::TextDisabled("no command has that name");
  std::optional<SearchEntry> chosen;
  for (std::size_t n = first; n < last; ++n) {
    const Favourite favourite = favourite_of(found[n].aim);
    bool is_starred = false;
    const bool is_clicked = draw_search_row(found[n], n == search.at, is_possible(found[n], ui),
                                            place_of(favourite, ui).has_value(), is_starred);
    if (is_clicked) chosen = found[n];
    if (is_starred) toggle_favourite(favourite, ui);
  }
  if (found.size() > last) {
    ImGui::TextDisabled("and %d more", static_cast<int>(found.size() - last));
  }
  // Whoever clicks elsewhere goes on there.
  if (ImGui::IsMouseClicked(0) &&
      !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
    search.is_open = false;
  ImGui::End();
  if (chosen) do_found(*chosen, ui, document);
}

}  // namespace argil::viewer
