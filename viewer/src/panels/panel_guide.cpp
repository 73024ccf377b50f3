// SPDX-License-Identifier: GPL-3.0-or-later
// The line or curve that a stroke will follow, while it is drawn: behind the panels, over the
// picture.
#include <vector>

#include <imgui.h>

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

ImVec2 guide_corner(const Camera::Pixel& pixel) {
  return {static_cast<float>(pixel.x), static_cast<float>(pixel.y)};
}

}  // namespace

void draw_guide(const UiState& ui) {
  if (!ui.guide) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 color = ImGui::GetColorU32(imgui_color(shown_colors().guide));
  const std::vector<Camera::Pixel> points = pixels_of(*ui.guide, ui.camera, ui.show.is_stereo);
  std::vector<Camera::Pixel> way = points;
  if (ui.guide->mode == StrokeMode::curve) {
    // To the pointer, where the next point would be.
    if (ui.is_pointer_over_clay_view) way.push_back(ui.pointer);
    way = curve_through(way);
  }
  std::vector<ImVec2> corners;
  corners.reserve(way.size());
  for (const Camera::Pixel& pixel : way) corners.push_back(guide_corner(pixel));
  if (corners.size() > 1) {
    list.AddPolyline(corners.data(), static_cast<int>(corners.size()), color, ImDrawFlags_None,
                     1.8F * unit());
  }
  for (const Camera::Pixel& pixel : points) {
    list.AddCircleFilled(guide_corner(pixel), 4.0F * unit(), color);
  }
}

}  // namespace argil::viewer
