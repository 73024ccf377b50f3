// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of a pen's pressure, whose points are dragged, over what the pen told in its last
// strokes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <imgui.h>

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kCurveWide = 262.0F;  // units
constexpr float kCurveHigh = 96.0F;
constexpr std::size_t kPressureBins = 32;

/// Where pressures are drawn: from the lower left corner to the right and up.
struct CurveFrame {
  ImVec2 low;  ///< the upper left corner
  ImVec2 size;
  ImVec2 at(double x, double y) const {
    return {low.x + size.x * static_cast<float>(x),
            low.y + size.y * (1.0F - static_cast<float>(y))};
  }
};

/// How often each pressure came, and the last one.
void draw_told(const std::vector<float>& pressures, const CurveFrame& frame, ImDrawList& list) {
  if (pressures.empty()) return;
  std::array<int, kPressureBins> counts{};
  for (const float pressure : pressures) {
    const auto bin = static_cast<std::size_t>(std::clamp(pressure, 0.0F, 1.0F) *
                                              (static_cast<float>(kPressureBins) - 0.01F));
    ++counts[bin];
  }
  const double most = *std::max_element(counts.begin(), counts.end());
  for (std::size_t n = 0; n < kPressureBins; ++n) {
    if (counts[n] == 0) continue;
    const double bins = kPressureBins;
    list.AddRectFilled(frame.at(static_cast<double>(n) / bins, 0.9 * counts[n] / most),
                       frame.at((static_cast<double>(n) + 0.9) / bins, 0.0),
                       IM_COL32(150, 96, 66, 150));
  }
  const auto last = static_cast<double>(pressures.back());
  list.AddLine(frame.at(last, 0.0), frame.at(last, 1.0), ImGui::GetColorU32(ImGuiCol_CheckMark));
}

void draw_curve(const PressureCurve& curve, const CurveFrame& frame, ImDrawList& list) {
  const ImU32 color = ImGui::GetColorU32(ImGuiCol_PlotLines);
  constexpr int kSteps = 48;
  std::array<ImVec2, kSteps + 1> line;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const double p = static_cast<double>(n) / kSteps;
    line[n] = frame.at(p, shaped_pressure(curve, p));
  }
  list.AddPolyline(line.data(), static_cast<int>(line.size()), color, ImDrawFlags_None,
                   2.0F * unit());
  for (const ImVec2& point :
       {frame.at(0.0, curve.start), frame.at(curve.points[0].x, curve.points[0].y),
        frame.at(curve.points[1].x, curve.points[1].y)}) {
    list.AddCircleFilled(point, 4.5F * unit(), color);
  }
}

/// The point nearest to the pointer follows it, for as long as the button is held.
void drag_curve(PressureCurve& curve, const CurveFrame& frame) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double x = static_cast<double>((mouse.x - frame.low.x) / frame.size.x);
  const double y = static_cast<double>(1.0F - (mouse.y - frame.low.y) / frame.size.y);
  static std::size_t held = 0;  // as Dear ImGui, of which there is one
  if (ImGui::IsItemActivated()) {
    const std::array<PressureCurve::Point, 3> handles{
        {{0.0, curve.start}, curve.points[0], curve.points[1]}};
    const auto far = [&](const PressureCurve::Point& p) { return std::hypot(p.x - x, p.y - y); };
    held = 0;
    for (std::size_t n = 1; n < handles.size(); ++n) {
      if (far(handles[n]) < far(handles[held])) held = n;
    }
  }
  constexpr double kApart = PressureCurve::kLeastApart;
  auto& [first, second] = curve.points;
  if (held == 0) curve.start = std::clamp(y, 0.0, first.y);
  if (held == 1)
    first = {std::clamp(x, kApart, second.x - kApart), std::clamp(y, curve.start, second.y)};
  if (held == 2)
    second = {std::clamp(x, first.x + kApart, 1.0 - kApart), std::clamp(y, first.y, 1.0)};
  curve = in_range(curve);
}

}  // namespace

void draw_pressure(UiState& ui) {
  PressureCurve& curve = ui.settings.pressure;
  ImGui::TextUnformatted("Pen's pressure");
  ImGui::SameLine();
  if (button("Soft")) curve = kSoftPressure;
  ImGui::SameLine();
  if (button("Linear")) curve = kLinearPressure;
  ImGui::SameLine();
  if (button("Firm")) curve = kFirmPressure;
  const float u = unit();
  // Less than usual beside a bar to scroll by.
  const float wide = std::min(kCurveWide * u, ImGui::GetContentRegionAvail().x);
  tile("Pressure curve", static_cast<double>(wide), static_cast<double>(kCurveHigh * u));
  const CurveFrame frame{ImGui::GetItemRectMin(), {wide, kCurveHigh * u}};
  if (ImGui::IsItemActive()) drag_curve(curve, frame);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("to the right: how hard the pen is pressed; up: what it counts as");
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(frame.low, ImGui::GetItemRectMax(), ImGui::GetColorU32(ImGuiCol_FrameBg));
  list.PushClipRect(frame.low, ImGui::GetItemRectMax(), true);
  draw_told(ui.pressures, frame, list);
  draw_curve(curve, frame, list);
  list.PopClipRect();
}

}  // namespace argil::viewer
