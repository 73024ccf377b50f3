// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/file_picture.h"

#include <algorithm>
#include <cassert>
#include <cstdio>

#include "base/text.h"
#include "gui/dear_imgui.h"
#include "gui/layout.h"

namespace argil::viewer {
namespace {

std::string size_text(std::uintmax_t bytes) {
  char text[32];
  const auto size = static_cast<double>(bytes);
  if (size < 1e6) {
    std::snprintf(text, sizeof text, "%.0f kB", size < 1e3 ? 1.0 : size / 1e3);
  } else if (size < 1e9) {
    std::snprintf(text, sizeof text, "%.1f MB", size / 1e6);
  } else {
    std::snprintf(text, sizeof text, "%.1f GB", size / 1e9);
  }
  return text;
}

}  // namespace

const ShownFile* known_file(const UiState& ui, const std::filesystem::path& file) {
  const auto found = ui.shelf.known.find(file);
  return found == ui.shelf.known.end() ? nullptr : &found->second;
}

void draw_picture_in(const ShownPicture& picture, ImDrawList& list, const ImVec2& low,
                     const ImVec2& high, const char* word) {
  const ImVec2 room{high.x - low.x, high.y - low.y};
  const float rounding = 3.0F * unit();
  if (picture.number == 0) {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
    const ImVec2 size = ImGui::CalcTextSize(word);
    list.AddText({low.x + 0.5F * (room.x - size.x), low.y + 0.5F * (room.y - size.y)},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), word);
    return;
  }
  assert(picture.width > 0 && picture.height > 0);
  const auto width = static_cast<float>(picture.width);
  const auto height = static_cast<float>(picture.height);
  const float scale = std::min(room.x / width, room.y / height);
  const ImVec2 margin{0.5F * (room.x - scale * width), 0.5F * (room.y - scale * height)};
  list.AddImageRounded(texture_id(picture.number), {low.x + margin.x, low.y + margin.y},
                       {high.x - margin.x, high.y - margin.y}, {0.0F, 0.0F}, {1.0F, 1.0F},
                       IM_COL32_WHITE, rounding);
}

std::string words_of_look(const FileLook& look) {
  return clock_text(look.changed, "%d %B %Y, %H:%M") + ", " + size_text(look.bytes);
}

}  // namespace argil::viewer
