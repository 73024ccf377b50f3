// SPDX-License-Identifier: GPL-3.0-or-later
// What was measured: numbers over the picture, behind the panels, and the list of all.
#include <algorithm>
#include <string>
#include <utility>

#include <imgui.h>

#include "commands/command.h"
#include "commands/measure.h"
#include "gestures/measure_marks.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kMeasureWidth = 304.0F;  // units, as all sizes here
constexpr int kMeasureRows = 4;          // without scrolling
constexpr float kHiddenAlpha = 0.45F;    // of what lies behind clay
constexpr float kHiddenText = 0.75F;     // which has to be read all the same
const ImVec4 kEndColor{0.55F, 0.85F, 1.0F, 1.0F};
const ImVec4 kChosenEndColor{1.0F, 0.86F, 0.35F, 1.0F};

ImU32 faded(ImVec4 color, float alpha) {
  color.w *= alpha;
  return ImGui::GetColorU32(color);
}

ImVec4 end_color(bool is_chosen) { return is_chosen ? kChosenEndColor : kEndColor; }

void draw_measure_dot(const MeasureDot& dot, ImDrawList& list) {
  const ImVec2 at{static_cast<float>(dot.at.x), static_cast<float>(dot.at.y)};
  const float alpha = dot.is_seen ? 1.0F : kHiddenAlpha;
  const float radius = (dot.is_under_pointer ? 5.5F : 3.6F) * unit();
  // A dark rim, so that it is seen on light clay as well.
  list.AddCircleFilled(at, radius + 1.6F * unit(), faded({0.0F, 0.0F, 0.0F, 0.7F}, alpha), 20);
  list.AddCircleFilled(at, radius, faded(end_color(dot.is_chosen), alpha), 20);
}

/// Whole, also at the edge of the picture.
void draw_measure_label(const MeasureLabel& label, const WindowPart& part, ImDrawList& list) {
  const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
  const float margin = 4.0F * unit();
  const ImVec2 half{0.5F * size.x + margin, 0.5F * size.y + 0.6F * margin};
  const auto left = static_cast<float>(part.left);
  const auto wide = static_cast<float>(part.camera.width());
  const auto high = static_cast<float>(part.camera.height());
  const float top = ImGui::GetFrameHeight();
  ImVec2 at{static_cast<float>(label.at.x), static_cast<float>(label.at.y)};
  at.x = std::clamp(at.x, left + half.x, std::max(left + half.x, left + wide - half.x));
  at.y = std::clamp(at.y, top + half.y, std::max(top + half.y, high - top - half.y));
  const float alpha = label.is_seen ? 1.0F : kHiddenText;
  const ImVec2 low{at.x - half.x, at.y - half.y};
  const ImVec2 most{at.x + half.x, at.y + half.y};
  list.AddRectFilled(low, most, faded({0.08F, 0.08F, 0.09F, 0.82F}, alpha), margin);
  if (label.is_chosen) {
    list.AddRect(low, most, faded(kChosenEndColor, 0.8F * alpha), margin, 0, 1.2F * unit());
  }
  list.AddText({at.x - 0.5F * size.x, at.y - 0.5F * size.y},
               faded(end_color(label.is_chosen), alpha), label.text.c_str());
}

/// The tools, and what the left button does with the one that is chosen.
void draw_measure_kinds(UiState& ui, DocumentThread& document) {
  constexpr std::pair<MeasureKind, Command> kTools[] = {
      {MeasureKind::distance, Command::measure_distance},
      {MeasureKind::angle, Command::measure_angle},
      {MeasureKind::thickness, Command::measure_thickness}};
  const double width = static_cast<double>(82.0F * unit());
  for (const auto& [kind, command] : kTools) {
    if (kind != MeasureKind::distance) ImGui::SameLine();
    const std::string label = std::string(name_of(kind)) + "##measure";
    if (choice(label.c_str(), ui.measures.tool == kind, width)) perform(command, ui, document);
  }
  if (ui.measures.tool) {
    ImGui::TextDisabled("%s", next_pick(ui.measures));
  } else {
    ImGui::TextDisabled("Choose what to measure");
  }
}

/// One of the list; true where it shall be removed.
bool draw_measure_row(const Measurement& each, UiState& ui) {
  const std::string number = std::to_string(each.number);
  const auto places = places_of(each.points, ui);
  const std::string value =
      places ? measured_text(each.kind, measured(each.kind, *places)) : std::string("not shown");
  const std::string label = number + ": " + name_of(each.kind);
  ImGui::AlignTextToFramePadding();
  if (choice(label.c_str(), ui.measures.chosen == each.number,
             static_cast<double>(104.0F * unit()))) {
    ui.measures.chosen = each.number;
  }
  ImGui::SameLine(118.0F * unit());
  if (places && is_current(each)) {
    ImGui::TextUnformatted(value.c_str());
  } else if (places) {
    ImGui::TextDisabled("%s ?", value.c_str());
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("the clay there is no longer as it was: drag its ends, or measure anew");
    }
  } else {
    ImGui::TextDisabled("%s", value.c_str());
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("its piece is hidden, or was removed: undo brings it back");
  }
  ImGui::SameLine(204.0F * unit());
  ImGui::BeginDisabled(!places);
  if (button(("Copy##" + number).c_str())) ImGui::SetClipboardText(value.c_str());
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool is_removed = button(("x##" + number).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("remove it (Delete)");
  return is_removed;
}

void draw_measure_rows(UiState& ui) {
  const float row = ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("measurements", {0.0F, kMeasureRows * row + 12.0F * unit()}, true);
  if (ui.measures.list.empty()) ImGui::TextDisabled("nothing yet");
  std::optional<std::int64_t> removed;
  for (const Measurement& each : ui.measures.list) {
    if (draw_measure_row(each, ui)) removed = each.number;
    // The newest comes into sight.
    if (each.number > ui.measures.listed) {
      ui.measures.listed = each.number;
      ImGui::SetScrollHereY(1.0F);
    }
  }
  ImGui::EndChild();
  if (removed) remove_measurement(*removed, ui.measures);
}

}  // namespace

void draw_measure_marks(const UiState& ui) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const WindowPart& part : parts_of(ui.camera, ui.show.is_stereo)) {
    const MeasureMarks marks = measure_marks(ui, part);
    const auto left = static_cast<float>(part.left);
    list.PushClipRect(
        {left, 0.0F},
        {left + static_cast<float>(part.camera.width()), static_cast<float>(part.camera.height())},
        true);
    for (const MeasureDot& dot : marks.dots) draw_measure_dot(dot, list);
    for (const MeasureLabel& label : marks.labels) draw_measure_label(label, part, list);
    list.PopClipRect();
  }
}

void draw_measures(UiState& ui, DocumentThread& document) {
  if (!ui.panels.has_measures) return;
  // Over the status line, where no other panel opens.
  const float bottom = ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() - 8.0F * unit();
  const float most = std::max(0.0F, ImGui::GetIO().DisplaySize.x - kMeasureWidth * unit());
  ImGui::SetNextWindowPos({std::min(kPiecesPanelLeft * unit(), most), bottom},
                          ImGuiCond_FirstUseEver, {0.0F, 1.0F});
  ImGui::SetNextWindowSize({kMeasureWidth * unit(), 0.0F});
  keep_on_screen(kMeasureWidth);
  ImGui::Begin("Measure", &ui.panels.has_measures, ImGuiWindowFlags_NoSavedSettings);
  draw_measure_kinds(ui, document);
  draw_measure_rows(ui);
  ImGui::BeginDisabled(!is_possible(Command::measure_clear, ui));
  if (button("Clear all##measure")) perform(Command::measure_clear, ui, document);
  ImGui::EndDisabled();
  ImGui::SameLine();
  check("In the picture", ui.measures.has_marks);
  ImGui::End();
}

}  // namespace argil::viewer
