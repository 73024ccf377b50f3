// SPDX-License-Identifier: GPL-3.0-or-later
// The list of favourites: what each direction of their ring does, moved and removed there.
#include <cstddef>
#include <string>
#include <utility>

#include <imgui.h>

#include "commands/command.h"
#include "commands/favourite_choice.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kFavouritesWidth = 280.0F;  // units
constexpr float kFavouriteNameLeft = 92.0F;
constexpr float kFavouriteButtonsLeft = 210.0F;

/// A place with what it does. Moving swaps it with the next place that way round, be that empty or
/// not.
void draw_place(std::size_t place, UiState& ui) {
  std::optional<Favourite>& favourite = ui.favourites[place];
  const std::string number = std::to_string(place + 1);
  const auto swap_with = [&](std::size_t steps) {
    std::swap(favourite, ui.favourites[(place + steps) % kFavouritePlaces]);
  };
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", kFavouriteDirectionTitles[place]);
  ImGui::SameLine(kFavouriteNameLeft * unit());
  if (!favourite) {
    ImGui::TextDisabled("nothing");
    return;
  }
  const std::string name = favourite_title(*favourite);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float right = low.x + (kFavouriteButtonsLeft - kFavouriteNameLeft - 6.0F) * unit();
  ImGui::PushClipRect(low, {right, low.y + ImGui::GetFrameHeight()}, true);
  ImGui::TextUnformatted(name.c_str());
  ImGui::PopClipRect();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", name.c_str());
  ImGui::SameLine(kFavouriteButtonsLeft * unit());
  const bool is_back = button(("<##back" + number).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a place back, against the clock");
  ImGui::SameLine(0.0F, 3.0F * unit());
  const bool is_on = button((">##on" + number).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a place on, with the clock");
  ImGui::SameLine(0.0F, 3.0F * unit());
  const bool is_gone = button(("x##gone" + number).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("remove");
  if (is_back) swap_with(kFavouritePlaces - 1);
  if (is_on) swap_with(1);
  if (is_gone) favourite.reset();
}

}  // namespace

void draw_favourites(UiState& ui) {
  if (!ui.panels.has_favourites) return;
  put_beside(kPrintPanelLeft, kFavouritesWidth);
  ImGui::SetNextWindowSize({kFavouritesWidth * unit(), 0.0F});
  keep_on_screen(kFavouritesWidth);
  ImGui::Begin("Favourites", &ui.panels.has_favourites, ImGuiWindowFlags_NoSavedSettings);
  for (std::size_t place = 0; place < kFavouritePlaces; ++place) draw_place(place, ui);
  ImGui::Separator();
  const std::string& search_key = ui.keys.text_of(Command::search);
  const std::string search = search_key.empty() ? std::string("the search") : search_key;
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextDisabled(
      "Another one: the star in %s or in the palette of brushes, or a right click on a tool. It "
      "takes the first place that is free.",
      search.c_str());
  ImGui::PopTextWrapPos();
  ImGui::BeginDisabled(ui.favourites == usual_favourites());
  if (button("The usual ones")) ui.favourites = usual_favourites();
  ImGui::EndDisabled();
  ImGui::End();
}

}  // namespace argil::viewer
