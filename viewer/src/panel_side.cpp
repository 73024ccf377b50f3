// SPDX-License-Identifier: GPL-3.0-or-later
// The panels at the sides: tools, brush, view, what the clay is.
#include <algorithm>
#include <cstdio>

#include <imgui.h>

#include "deed.h"
#include "panels.h"

namespace argil::viewer {
namespace {

constexpr float kToolsWidth = 124.0F;
constexpr float kSideWidth = 290.0F;
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_AlwaysAutoResize;

float below_menu() { return ImGui::GetFrameHeight() + 6.0F; }

void say(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(110.0F);
  ImGui::TextUnformatted(value.c_str());
}

std::string with_unit(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

}  // namespace

std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

void draw_tools(UiState& ui) {
  if (!ui.panels.has_tools) return;
  ImGui::SetNextWindowPos({6.0F, below_menu()});
  ImGui::SetNextWindowSize({kToolsWidth, 0.0F});
  ImGui::Begin("Tools", nullptr, kFixed);
  for (const ActionInfo& info : action_infos()) {
    if (choice(info.title, ui.brush.action == info.action)) ui.brush.action = info.action;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.about);
    if (info.key != 0) {
      ImGui::SameLine(kToolsWidth - 30.0F);
      ImGui::TextDisabled("%c", info.key);
    }
  }
  ImGui::End();
}

void draw_brush(UiState& ui) {
  if (!ui.panels.has_brush) return;
  Brush& brush = ui.brush;
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - kSideWidth - 6.0F, below_menu()});
  ImGui::SetNextWindowSize({kSideWidth, 0.0F});
  ImGui::Begin("Brush", nullptr, kFixed);
  ImGui::PushItemWidth(150.0F);
  if (brush.is_screen_size) {
    slide("Size", brush.radius_pixels, 2.0, 500.0, "%.0f px", true);
  } else {
    slide("Size", brush.radius_mm, 0.05, 100.0, "%.2f mm", true);
  }
  check("Size on screen", brush.is_screen_size);
  slide("Strength", brush.strength, kLeastStrength, 1.0, "%.2f");
  check("Invert", brush.is_inverted);
  int shape = brush.shape == Shape::box ? 1 : 0;
  if (pick_one("Shape", shape, {"Ball", "Box"}))
    brush.shape = shape == 1 ? Shape::box : Shape::ball;
  if (ImGui::CollapsingHeader("Symmetry", ImGuiTreeNodeFlags_DefaultOpen)) {
    check("X##mirror", brush.mirror.x);
    ImGui::SameLine();
    check("Y##mirror", brush.mirror.y);
    ImGui::SameLine();
    check("Z##mirror", brush.mirror.z);
    slide("Around", brush.radial.count, 1, 64);
    int axis = static_cast<int>(brush.radial.axis);
    if (pick_one("Axis", axis, {"x", "y", "z"})) brush.radial.axis = static_cast<std::size_t>(axis);
  }
  const bool has_stroke = ImGui::CollapsingHeader("Stroke");
  note_widget("Stroke");
  if (has_stroke) {
    slide("Spacing", brush.spacing, 0.05, 2.0, "%.2f");
    slide("Steady", brush.steady_mm, 0.0, 20.0, "%.1f mm");
    slide("Hold still", brush.hold_s, 0.0, 1.0, "%.2f s");
    slide("Pressure: strength", brush.pressure_to_strength, 0.0, 1.0, "%.2f");
    slide("Pressure: size", brush.pressure_to_size, 0.0, 1.0, "%.2f");
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_view(UiState& ui) {
  if (!ui.panels.has_view) return;
  const float bottom = ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() - 8.0F;
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - kSideWidth - 6.0F, bottom},
                          ImGuiCond_Always, {0.0F, 1.0F});
  ImGui::SetNextWindowSize({kSideWidth, 0.0F});
  ImGui::Begin("View", nullptr, kFixed);
  ImGui::PushItemWidth(150.0F);
  int shading = static_cast<int>(ui.show.shading);
  if (pick_one("Shading", shading, {"Clay", "Plain", "Curvature", "Detail"})) {
    ui.show.shading = static_cast<Shading>(shading);
  }
  check("Wireframe", ui.show.has_wires);
  ImGui::SameLine();
  check("Occlusion", ui.show.has_occlusion);
  check("Stereo", ui.show.is_stereo);
  ImGui::SameLine();
  check("Planes", ui.show.has_planes);
  ImGui::SameLine();
  check("Marks", ui.show.has_pins);
  check("Slice", ui.show.has_slice);
  if (ui.show.has_slice) {
    pick_one("Across", ui.show.slice_axis, {"x", "y", "z"});
    slide("Place", ui.show.slice_place, -1.0, 1.0, "%.2f");
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_info(UiState& ui) {
  if (!ui.panels.has_info) return;
  ImGui::SetNextWindowSize({kSideWidth + 60.0F, 0.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowPos({6.0F, 0.42F * ImGui::GetIO().DisplaySize.y}, ImGuiCond_FirstUseEver);
  ImGui::Begin("Clay", &ui.panels.has_info, ImGuiWindowFlags_NoSavedSettings);
  const ClayState& clay = ui.clay;
  if (clay.has_clay) {
    const Vec3 size = clay.bounds_mm.size();
    char text[96];
    std::snprintf(text, sizeof text, "%.4g x %.4g x %.4g mm", size.x, size.y, size.z);
    say("Size", text);
    say("Finest voxel", with_unit(clay.voxel_mm, "mm"));
    say("Triangles", grouped(clay.display.triangles));
    say("Memory", with_unit(static_cast<double>(clay.use.level_bytes) / 1048576.0, "MB"));
    say("Undo", std::to_string(clay.undo_depth) + " steps, " +
                    with_unit(static_cast<double>(clay.use.undo_bytes) / 1048576.0, "MB"));
    say("Strokes", grouped(clay.strokes) + " (" + grouped(clay.dabs) + " dabs)");
    say("Last dab", with_unit(clay.last_dab_ms, "ms"));
    ImGui::Separator();
    for (const LevelStats& level : clay.levels) {
      std::snprintf(text, sizeof text, "level %d: %.3g mm, %s voxels", level.level, level.voxel_mm,
                    grouped(level.active_voxels).c_str());
      ImGui::TextUnformatted(text);
    }
  } else {
    ImGui::TextUnformatted("no clay");
  }
  ImGui::End();
}

}  // namespace argil::viewer
