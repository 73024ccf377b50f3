// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/layout.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "gui/gui.h"

namespace argil::viewer {
namespace {

/// A byte of UTF-8 that goes on with the letter of the one before.
bool is_inside_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

bool fits_into(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str()).x <= width;
}

}  // namespace

float unit() { return ImGui::GetFontSize() / kLetterPixels; }

double scale_of_panels(double content_scale, int percent, int width, int height) {
  // The menu needs so much, and the brush above what is shown.
  constexpr double kRoomWidth = 640.0;
  constexpr double kRoomHeight = 400.0;
  constexpr double kLeastScale = 0.75;  // smaller letters cannot be read
  const double room = std::min(width / kRoomWidth, height / kRoomHeight);
  const double wanted = content_scale * percent / 100.0;
  return std::max(kLeastScale, std::min(wanted, room));
}

std::string fitted(std::string text, float width) {
  if (fits_into(text, width)) return text;
  while (!text.empty() && !fits_into(text + "...", width)) {
    while (text.size() > 1 && is_inside_letter(text.back())) text.pop_back();
    text.pop_back();
  }
  return std::move(text) + "...";
}

std::string fitted_end(std::string text, float width) {
  if (fits_into(text, width)) return text;
  std::size_t from = 0;
  const auto end_from = [&](std::size_t at) { return std::string("...") + text.substr(at); };
  while (from < text.size() && !fits_into(end_from(from), width)) {
    ++from;
    while (from < text.size() && is_inside_letter(text[from])) ++from;
  }
  return end_from(from);
}

void keep_on_screen(float width) {
  assert(width > 0.0F);
  // Between the menu and the status line, and one height of air.
  const float most = ImGui::GetIO().DisplaySize.y - 3.0F * ImGui::GetFrameHeight();
  ImGui::SetNextWindowSizeConstraints({width * unit(), 0.0F}, {width * unit(), most});
}

void put_beside(float left, float width) {
  assert(left >= 0.0F && width > 0.0F);
  const float most = std::max(0.0F, ImGui::GetIO().DisplaySize.x - width * unit());
  ImGui::SetNextWindowPos({std::min(left * unit(), most), ImGui::GetFrameHeight() + 12.0F * unit()},
                          ImGuiCond_FirstUseEver);
}

}  // namespace argil::viewer
