// SPDX-License-Identifier: GPL-3.0-or-later
// The ring of favourites around the pointer. It is drawn over all panels and is none itself: what
// is chosen depends on directions alone (gestures/pie_gestures.h), also before it was ever drawn.
#include <array>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include <imgui.h>

#include "commands/favourite_choice.h"
#include "commands/preset_choice.h"
#include "document/tool_info.h"
#include "gestures/pie_gestures.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "gui/tool_picture.h"
#include "keys/command_info.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

// Units, as kPieReach.
constexpr float kEntryAway = 86.0F;  // from the middle of the ring to that of an entry
constexpr float kEntryWidth = 72.0F;
constexpr float kPictureWidth = 46.0F;
constexpr float kSmallLetters = 0.82F;  // of the usual ones

float in_pixels(double units) { return static_cast<float>(units) * unit(); }

ImVec2 toward(const ImVec2& middle, double turns, float away) {
  const double angle = 2.0 * std::numbers::pi * turns;  // clockwise from the top
  return {middle.x + away * static_cast<float>(std::sin(angle)),
          middle.y - away * static_cast<float>(std::cos(angle))};
}

float small_width(const std::string& text) {
  return ImGui::GetFont()
      ->CalcTextSizeA(kSmallLetters * ImGui::GetFontSize(), FLT_MAX, 0.0F, text.c_str())
      .x;
}

/// As many letters as fit, as small as entries have them.
std::string cut_small(std::string text, float width) {
  if (small_width(text) <= width) return text;
  while (!text.empty() && small_width(text + "..") > width) {
    // A letter of UTF-8 goes as a whole.
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
      text.pop_back();
    }
    text.pop_back();
  }
  return text + "..";
}

/// One or two lines; the second is empty where one does.
std::array<std::string, 2> two_lines(const std::string& text, float width) {
  if (small_width(text) <= width) return {text, ""};
  std::size_t end = 0;
  for (std::size_t blank = text.find(' '); blank != std::string::npos;
       blank = text.find(' ', blank + 1)) {
    if (small_width(text.substr(0, blank)) <= width) end = blank;
  }
  if (end == 0) return {cut_small(text, width), ""};
  return {text.substr(0, end), cut_small(text.substr(end + 1), width)};
}

/// In the middle of `at.x`, from `at.y` downwards; where the next line begins.
float draw_small(ImDrawList& list, const ImVec2& at, const std::string& text, ImU32 color) {
  if (text.empty()) return at.y;
  const float size = kSmallLetters * ImGui::GetFontSize();
  list.AddText(ImGui::GetFont(), size, {at.x - 0.5F * small_width(text), at.y}, color,
               text.c_str());
  return at.y + size;
}

/// The tool whose picture stands for it.
const ToolInfo* tool_of_favourite(const Favourite& favourite, const UiState& ui) {
  if (const auto* tool = std::get_if<const ToolInfo*>(&favourite)) return *tool;
  const auto* name = std::get_if<std::string>(&favourite);
  const BrushPreset* preset = name == nullptr ? nullptr : preset_named(*name, ui);
  if (preset == nullptr) return nullptr;
  for (const ToolInfo& info : tool_infos()) {
    if (is_chosen(preset->brush, info)) return &info;
  }
  return nullptr;
}

/// What is said above a name that has no picture.
std::string heading_of(const Favourite& favourite) {
  const auto* command = std::get_if<Command>(&favourite);
  return command != nullptr ? info_of(*command).menu : "gone";
}

void draw_entry(ImDrawList& list, const ImVec2& middle, const Favourite& favourite, bool is_marked,
                const UiState& ui) {
  const bool is_strong = is_marked || can_do(favourite, ui);
  const ImU32 text = ImGui::GetColorU32(is_strong ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  const float line = kSmallLetters * ImGui::GetFontSize();
  const auto [first, second] = two_lines(favourite_title(favourite), kEntryWidth * unit());
  const float lines = second.empty() ? 1.0F : 2.0F;
  const ToolInfo* tool = tool_of_favourite(favourite, ui);
  const float above = tool != nullptr ? 0.7F * kPictureWidth * unit() + 2.0F * unit() : line;
  const float top = middle.y - 0.5F * (above + lines * line);
  if (tool != nullptr) {
    draw_tool_picture(tool->picture, list, {middle.x - 0.5F * kPictureWidth * unit(), top},
                      kPictureWidth * unit());
  } else {
    // Weak letters are not read on the mark's colour.
    const ImU32 weak = ImGui::GetColorU32(is_marked ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    draw_small(list, {middle.x, top}, heading_of(favourite), weak);
  }
  const float next = draw_small(list, {middle.x, top + above}, first, text);
  draw_small(list, {middle.x, next}, second, text);
}

/// The part of the ring that is marked, as strips: its sides are no straight ones.
void draw_marked(ImDrawList& list, const ImVec2& middle, std::size_t place, ImU32 color) {
  constexpr int kStrips = 16;
  const float from = in_pixels(kPieMiddle);
  const float to = in_pixels(kPieReach);
  const auto turns = [&](int strip) {
    const double part = static_cast<double>(strip) / kStrips - 0.5;
    return (static_cast<double>(place) + part) / static_cast<double>(kFavouritePlaces);
  };
  // Without smoothed edges, or the seams between the strips would show.
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (int n = 0; n < kStrips; ++n) {
    list.AddQuadFilled(toward(middle, turns(n), from), toward(middle, turns(n), to),
                       toward(middle, turns(n + 1), to), toward(middle, turns(n + 1), from), color);
  }
  list.Flags = flags;
}

}  // namespace

void draw_pie(const UiState& ui) {
  if (!ui.pie.is_open) return;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const Camera::Pixel at = middle_of_pie(ui);
  const ImVec2 middle{static_cast<float>(at.x), static_cast<float>(at.y)};
  const float reach = in_pixels(kPieReach);
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border);
  constexpr int kCorners = 96;
  list.AddCircleFilled(middle, reach, ImGui::GetColorU32(ImGuiCol_PopupBg), kCorners);
  const auto count = static_cast<double>(kFavouritePlaces);
  for (std::size_t place = 0; place < kFavouritePlaces; ++place) {
    const double side = (static_cast<double>(place) + 0.5) / count;
    list.AddLine(toward(middle, side, in_pixels(kPieMiddle)), toward(middle, side, reach), line,
                 unit());
  }
  const std::optional<std::size_t> marked = ui.pie.marked;
  if (marked && ui.favourites[*marked]) {
    const bool works = can_do(ui.favourites[*marked], ui);
    draw_marked(list, middle, *marked,
                ImGui::GetColorU32(works ? ImGuiCol_Header : ImGuiCol_FrameBg));
  }
  for (std::size_t place = 0; place < kFavouritePlaces; ++place) {
    if (!ui.favourites[place]) continue;
    draw_entry(list, toward(middle, static_cast<double>(place) / count, kEntryAway * unit()),
               *ui.favourites[place], marked == place, ui);
  }
  list.AddCircle(middle, reach, line, kCorners, 1.5F * unit());
  list.AddCircle(middle, in_pixels(kPieMiddle), line, 48, 1.5F * unit());
  list.AddCircleFilled(middle, 3.0F * unit(), ImGui::GetColorU32(ImGuiCol_TextDisabled), 16);
}

}  // namespace argil::viewer
