// SPDX-License-Identifier: GPL-3.0-or-later
// The panels at the sides: tools, brush, view, what the clay is.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include <imgui.h>

#include "deed.h"
#include "panels.h"
#include "tool_picture.h"

namespace argil::viewer {
namespace {

constexpr float kTileWidth = 62.0F;
constexpr float kTileHeight = 60.0F;
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

void keep_on_screen(float width) {
  const float most = ImGui::GetIO().DisplaySize.y - 3.0F * ImGui::GetFrameHeight();
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, most});
}

void put_beside(float left, float width) {
  const float most = std::max(0.0F, ImGui::GetIO().DisplaySize.x - width);
  ImGui::SetNextWindowPos({std::min(left, most), ImGui::GetFrameHeight() + 12.0F},
                          ImGuiCond_FirstUseEver);
}

std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

namespace {

/// A tool as its picture, with its name below and its key in the corner.
void draw_tool(const ActionInfo& info, Brush& brush, float unit) {
  const ImVec2 size{kTileWidth * unit, kTileHeight * unit};
  if (tile(info.title, static_cast<double>(size.x), static_cast<double>(size.y))) {
    choose(brush, info);
  }
  const ImVec2 low = ImGui::GetItemRectMin();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_chosen(brush, info) || ImGui::IsItemHovered()) {
    const ImGuiCol color = is_chosen(brush, info) ? ImGuiCol_Header : ImGuiCol_ButtonHovered;
    list.AddRectFilled(low, ImGui::GetItemRectMax(), ImGui::GetColorU32(color), 3.0F * unit);
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.about);
  draw_tool_picture(info, list, {low.x + 4.0F * unit, low.y + 3.0F * unit}, 54.0F * unit);
  const float letters = ImGui::GetFontSize();
  const float small = 0.74F * letters;
  const char key[2] = {static_cast<char>(info.key), '\0'};
  list.AddText(ImGui::GetFont(), small, {low.x + size.x - small - 2.0F * unit, low.y + 3.0F * unit},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), key);
  const float width = ImGui::CalcTextSize(info.title).x;
  list.AddText({low.x + 0.5F * (size.x - width), low.y + size.y - letters - 2.0F * unit},
               ImGui::GetColorU32(ImGuiCol_Text), info.title);
}

/// What an action takes of these, or what it becomes without them.
constexpr Shape kShapes[] = {Shape::ball, Shape::ellipsoid, Shape::box, Shape::capsule,
                             Shape::mesh};

void draw_shape(UiState& ui) {
  Brush& brush = ui.brush;
  std::vector<std::string> names{"Ball", "Ellipsoid"};
  if (is_solid(brush)) names.insert(names.end(), {"Box", "Capsule", "Mesh"});
  const Shape shown = is_solid(brush) ? brush.shape : shape_of(brush);
  int at = static_cast<int>(std::find(std::begin(kShapes), std::end(kShapes), shown) - kShapes);
  if (pick_one("Shape", at, names)) {
    // A mesh is the shape once it is there: who chooses none keeps the one before.
    const bool needs_mesh = kShapes[at] == Shape::mesh && !brush.mesh;
    if (needs_mesh) ui.file_wish = FileWish::stamp;
    if (!needs_mesh) brush.shape = kShapes[at];
  }
  if (shown == Shape::mesh) {
    if (button("Choose a mesh...")) ui.file_wish = FileWish::stamp;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", ui.clay.stamp ? ui.clay.stamp->name.c_str() : "none yet");
  } else if (shown != Shape::ball) {
    slide("Height", brush.height, shown == Shape::capsule ? 1.0 : kLeastHeight, kMostHeight,
          "%.2f radii");
  }
  if (shown == Shape::mesh || shown == Shape::box) {
    slide("Turned", brush.turn_deg, -180.0, 180.0, "%.0f degrees");
  }
}

void draw_symmetry(Brush& brush) {
  check("X##mirror", brush.mirror.x);
  ImGui::SameLine();
  check("Y##mirror", brush.mirror.y);
  ImGui::SameLine();
  check("Z##mirror", brush.mirror.z);
  slide("Around", brush.radial.count, 1, 64);
  int axis = static_cast<int>(brush.radial.axis);
  if (pick_one("Axis", axis, {"x", "y", "z"})) brush.radial.axis = static_cast<std::size_t>(axis);
}

/// What can be done to all of the mask, where it is painted.
void draw_mask_edits(UiState& ui, Workshop& shop) {
  for (const Deed deed : {Deed::mask_invert, Deed::mask_clear, Deed::mask_blur, Deed::mask_fill}) {
    if (deed != Deed::mask_invert) ImGui::SameLine();
    if (button((std::string(info_of(deed).title) + "##mask").c_str())) perform(deed, ui, shop);
  }
}

}  // namespace

void draw_tools(UiState& ui) {
  if (!ui.panels.has_tools) return;
  const float unit = ImGui::GetFontSize() / kLetterPixels;
  ImGui::SetNextWindowPos({6.0F, below_menu()});
  ImGui::Begin("Tools", nullptr, kFixed);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2.0F * unit, 2.0F * unit});
  // Three beside each other where the window is too low for two.
  const auto count = static_cast<float>(action_infos().size());
  const float room = ImGui::GetIO().DisplaySize.y - 4.0F * ImGui::GetFrameHeight();
  const int columns = std::ceil(0.5F * count) * (kTileHeight + 2.0F) * unit > room ? 3 : 2;
  int column = 0;
  for (const ActionInfo& info : action_infos()) {
    if (column > 0) ImGui::SameLine();
    draw_tool(info, ui.brush, unit);
    column = (column + 1) % columns;
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

void draw_brush(UiState& ui, Workshop& shop) {
  if (!ui.panels.has_brush) return;
  Brush& brush = ui.brush;
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - kSideWidth - 6.0F, below_menu()});
  ImGui::SetNextWindowSize({kSideWidth, 0.0F});
  // What does not fit above the other panel scrolls.
  const float end = ui.panels.has_view ? ui.panels.view_top : ImGui::GetIO().DisplaySize.y;
  const float room = std::max(end - below_menu() - 4.0F, 4.0F * ImGui::GetFrameHeight());
  ImGui::SetNextWindowSizeConstraints({kSideWidth, 0.0F}, {kSideWidth, room});
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
  draw_shape(ui);
  if (brush.action == Action::mask) draw_mask_edits(ui, shop);
  if (ImGui::CollapsingHeader("Symmetry", ImGuiTreeNodeFlags_DefaultOpen)) draw_symmetry(brush);
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
  ui.panels.view_top = ImGui::GetWindowPos().y;
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
  check("Number row as numpad", ui.settings.has_number_views);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("1, 3, 5, 7 look as the numpad's keys do");
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_info(UiState& ui) {
  if (!ui.panels.has_info) return;
  ImGui::SetNextWindowSize({kSideWidth + 60.0F, 0.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowPos({kBesideTools, 0.5F * ImGui::GetIO().DisplaySize.y},
                          ImGuiCond_FirstUseEver);
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
