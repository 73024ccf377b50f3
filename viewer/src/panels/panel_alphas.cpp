// SPDX-License-Identifier: GPL-3.0-or-later
// The palette of images to emboss with: a small picture of each.
#include <algorithm>
#include <cstddef>

#include <imgui.h>

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kThumbPixels = 48.0F;  // units
constexpr int kPaletteColumns = 5;
constexpr int kRowsShown = 2;  // others are scrolled to

/// Runs of one grey are one rectangle: a picture is a few hundred of them.
void draw_thumb(const AlphaChoice& alpha, ImDrawList& list, const ImVec2& low, float side) {
  constexpr int kGreys = 24;
  const float pixel = side / static_cast<float>(kThumbSide);
  const auto grey_at = [&](std::size_t n) { return alpha.thumb[n] * kGreys / 256; };
  for (std::size_t row = 0; row < kThumbSide; ++row) {
    const float top = low.y + static_cast<float>(row) * pixel;
    for (std::size_t from = 0; from < kThumbSide;) {
      const int grey = grey_at(row * kThumbSide + from);
      std::size_t end = from + 1;
      while (end < kThumbSide && grey_at(row * kThumbSide + end) == grey) ++end;
      const int shade = 20 + grey * 235 / (kGreys - 1);
      list.AddRectFilled({low.x + static_cast<float>(from) * pixel, top},
                         {low.x + static_cast<float>(end) * pixel, top + pixel},
                         IM_COL32(shade, shade, shade, 255));
      from = end;
    }
  }
}

void draw_choice(const AlphaChoice& alpha, bool is_chosen, DocumentThread& document) {
  const float side = kThumbPixels * unit();
  if (tile(alpha.name.c_str(), static_cast<double>(side), static_cast<double>(side))) {
    document.send(LoadAlpha{alpha.file});
  }
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 low = ImGui::GetItemRectMin();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_thumb(alpha, list, low, side);
  if (is_chosen || ImGui::IsItemHovered()) {
    const ImGuiCol color = is_chosen ? ImGuiCol_CheckMark : ImGuiCol_Text;
    list.AddRect(low, ImGui::GetItemRectMax(), ImGui::GetColorU32(color), 0.0F, 0, 2.0F * unit());
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", alpha.name.c_str());
}

}  // namespace

void draw_alphas(UiState& ui, DocumentThread& document) {
  ui.wants_alphas = true;
  if (ui.alphas.empty()) {
    if (ui.reads_alphas) ImGui::TextDisabled("reading the images...");
    return;
  }
  const float u = unit();
  const int rows = (static_cast<int>(ui.alphas.size()) + kPaletteColumns - 1) / kPaletteColumns;
  const float high = (kThumbPixels + 3.0F) * u * static_cast<float>(std::min(rows, kRowsShown));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {3.0F * u, 3.0F * u});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::BeginChild("##alphas", {0.0F, high});
  const std::string chosen = ui.clay.alpha ? ui.clay.alpha->name : "";
  int column = 0;
  for (const AlphaChoice& alpha : ui.alphas) {
    if (column > 0) ImGui::SameLine();
    draw_choice(alpha, alpha.file.filename().string() == chosen, document);
    column = (column + 1) % kPaletteColumns;
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

}  // namespace argil::viewer
