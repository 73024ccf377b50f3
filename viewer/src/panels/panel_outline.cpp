// SPDX-License-Identifier: GPL-3.0-or-later
// The outline of a mask or a trim while it is drawn: behind the panels, over the picture.
#include <cassert>
#include <cmath>
#include <vector>

#include <imgui.h>

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

ImVec2 as_screen(const Camera::Pixel& pixel) {
  return {static_cast<float>(pixel.x), static_cast<float>(pixel.y)};
}

ImU32 faint(ImVec4 color) {
  color.w = 0.16F;
  return ImGui::GetColorU32(color);
}

/// Shades what a line takes away: a strip beside it that leaves the window.
void shade_side(ImDrawList& list, const ImVec2& a, const ImVec2& b, bool is_left, ImU32 color) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0.0F)) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float far = 2.0F * (screen.x + screen.y) / length;
  const ImVec2 along{far * (b.x - a.x), far * (b.y - a.y)};
  // With y down this is the right-hand side of whoever goes from a to b.
  const float side = is_left ? -1.0F : 1.0F;
  const ImVec2 across{-side * along.y, side * along.x};
  const ImVec2 low{a.x - along.x, a.y - along.y};
  const ImVec2 high{b.x + along.x, b.y + along.y};
  list.AddQuadFilled(low, high, {high.x + across.x, high.y + across.y},
                     {low.x + across.x, low.y + across.y}, color);
}

}  // namespace

namespace {

/// A curve that is being clicked together, with ticks to the side that it takes away.
void draw_trim_curve(const OutlineDrag& drag, const UiState& ui, ImU32 line, float width) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  std::vector<Camera::Pixel> points = drag.points;
  for (const Camera::Pixel& point : points) {
    list.AddCircleFilled(as_screen(point), 4.0F * unit(), line);
  }
  if (ui.is_pointer_over_clay_view) points.push_back(ui.pointer);
  const std::vector<Camera::Pixel> curve = curve_through(points);
  const double side = drag.is_inverse ? -1.0 : 1.0;
  for (std::size_t n = 0; n + 1 < curve.size(); ++n) {
    const Camera::Pixel& a = curve[n];
    const Camera::Pixel& b = curve[n + 1];
    list.AddLine(as_screen(a), as_screen(b), line, width);
    const double far = std::hypot(b.x - a.x, b.y - a.y);
    if (n % 4 != 0 || !(far > 0.0)) continue;
    const double tick = side * 10.0 * static_cast<double>(unit()) / far;
    list.AddLine(as_screen(a), as_screen({a.x - tick * (b.y - a.y), a.y + tick * (b.x - a.x)}),
                 line, 0.6F * width);
  }
}

}  // namespace

void draw_outline(const UiState& ui) {
  if (ui.outline && ui.outline->form == DragForm::curve) {
    const ImU32 line = ImGui::GetColorU32(imgui_color(shown_colors().trim_line));
    return draw_trim_curve(*ui.outline, ui, line, 1.6F * unit());
  }
  if (!ui.outline || ui.outline->points.size() < 2) return;
  const OutlineDrag& drag = *ui.outline;
  assert(drag.form != DragForm::brush);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ThemeColors& colors = shown_colors();
  const ImVec4 color = imgui_color(drag.is_trim ? colors.trim_line : colors.mask_line);
  const ImU32 line = ImGui::GetColorU32(color);
  const float width = 1.6F * unit();
  std::vector<ImVec2> points;
  for (const Camera::Pixel& pixel : outline_of(drag)) points.push_back(as_screen(pixel));
  const auto count = static_cast<int>(points.size());
  if (drag.form == DragForm::line) {
    shade_side(list, points[0], points[1], drag.is_inverse, faint(color));
    list.AddLine(points[0], points[1], line, width);
    return;
  }
  // A lasso may be of any shape, which nothing here can fill: a box is shaded.
  if (drag.form == DragForm::box) list.AddRectFilled(points[0], points[2], faint(color));
  list.AddPolyline(points.data(), count, line, ImDrawFlags_None, width);
  list.AddLine(points.back(), points.front(), faint(color) | 0x60000000U, width);
}

}  // namespace argil::viewer
