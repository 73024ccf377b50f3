// SPDX-License-Identifier: GPL-3.0-or-later
// The panels at the sides: tools, brush, view, what the clay is.
#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <iterator>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "commands/favourite_choice.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "gui/tool_picture.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kTileWidth = 62.0F;
constexpr float kTileHeight = 60.0F;
constexpr int kMostToolColumns = 8;
constexpr float kSideWidth = 290.0F;  // units
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_AlwaysAutoResize;

/// Where panels at the top begin, in pixels.
float below_menu() { return ImGui::GetFrameHeight() + 6.0F * unit(); }

/// A line of the clay's figures: name and value.
void say(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(110.0F * unit());
  ImGui::TextUnformatted(value.c_str());
}

std::string with_unit(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

/// A tool as its picture, with its name below and its key in the corner.
void draw_tool(const ToolInfo& info, UiState& ui) {
  const float u = unit();
  const ImVec2 size{kTileWidth * u, kTileHeight * u};
  if (tile(info.title, static_cast<double>(size.x), static_cast<double>(size.y))) {
    choose_tool(info, ui);
  }
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) toggle_favourite(&info, ui);
  // While something is measured the brush rests.
  const bool is_on = is_chosen(ui.brush, info) && !ui.measures.tool;
  const ImVec2 low = ImGui::GetItemRectMin();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_on || ImGui::IsItemHovered()) {
    const ImGuiCol color = is_on ? ImGuiCol_Header : ImGuiCol_ButtonHovered;
    list.AddRectFilled(low, ImGui::GetItemRectMax(), ImGui::GetColorU32(color), 3.0F * u);
  }
  const std::string& key = ui.keys.text_of(&info);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(key.empty() ? "%s" : "%s\n%s", info.help, key.c_str());
  }
  draw_tool_picture(info.picture, list, {low.x + 4.0F * u, low.y + 3.0F * u}, 54.0F * u);
  const float letters = ImGui::GetFontSize();
  const float small = 0.74F * letters;
  const float key_width = ImGui::GetFont()->CalcTextSizeA(small, FLT_MAX, 0.0F, key.c_str()).x;
  const float key_left = low.x + size.x - std::max(small, key_width) - 2.0F * u;
  list.AddText(ImGui::GetFont(), small, {key_left, low.y + 3.0F * u},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), key.c_str());
  const float width = ImGui::CalcTextSize(info.title).x;
  list.AddText({low.x + 0.5F * (size.x - width), low.y + size.y - letters - 2.0F * u},
               ImGui::GetColorU32(ImGuiCol_Text), info.title);
}

/// In the order of the list; what does not add or carve takes only the first two.
constexpr Shape kShapes[] = {Shape::ball, Shape::ellipsoid, Shape::box, Shape::capsule,
                             Shape::mesh};

void draw_shape(UiState& ui) {
  Brush& brush = ui.brush;
  std::vector<std::string> names{"Ball", "Ellipsoid"};
  if (is_solid(brush)) names.insert(names.end(), {"Box", "Capsule", "Mesh"});
  const Shape shown = is_solid(brush) ? brush.shape : shape_of(brush);
  int at = static_cast<int>(std::find(std::begin(kShapes), std::end(kShapes), shown) - kShapes);
  assert(static_cast<std::size_t>(at) < names.size());
  if (pick_one("Shape", at, names)) {
    // A mesh becomes the shape once it is read: whoever chooses no file keeps the former shape.
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

/// Those that the tool takes.
void draw_falloff(Brush& brush) {
  if (info_of(brush.action).curves == Curves::none) return;
  std::vector<Falloff> taken;
  std::vector<std::string> names;
  int at = 0;
  for (std::size_t n = 0; n < kFalloffNames.size(); ++n) {
    const auto each = static_cast<Falloff>(n);
    if (!takes(brush.action, each)) continue;
    if (each == brush.falloff) at = static_cast<int>(taken.size());
    taken.push_back(each);
    std::string name(kFalloffNames[n]);
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    std::replace(name.begin(), name.end(), '_', ' ');
    names.push_back(name);
  }
  if (pick_one("Falloff", at, names)) brush.falloff = taken[static_cast<std::size_t>(at)];
}

void draw_alpha(UiState& ui, DocumentThread& document) {
  Brush& brush = ui.brush;
  draw_alphas(ui, document);
  if (button("Choose an image...")) ui.file_wish = FileWish::alpha;
  ImGui::SameLine();
  ImGui::TextDisabled("%s", ui.clay.alpha ? ui.clay.alpha->name.c_str() : "white");
  // That an image is dragged to its size is a mode of strokes.
  const bool is_dragged = brush.emboss_mode == StrokeMode::anchored;
  int mode = static_cast<int>(is_dragged ? AlphaMode::anchored : brush.alpha_mode);
  if (pick_one("Image", mode, {"Along the stroke", "Dragged", "Tiled"})) {
    const auto chosen = static_cast<AlphaMode>(mode);
    const bool drags = chosen == AlphaMode::anchored;
    if (drags) brush.emboss_mode = StrokeMode::anchored;
    if (!drags) brush.alpha_mode = chosen;
    if (!drags && is_dragged) brush.emboss_mode = StrokeMode::space;
  }
  slide("Amplitude", brush.amplitude, 0.01, 1.0, "%.2f radii");
  slide("Mid level", brush.mid_level, 0.0, 1.0, "%.2f");
  slide("Angle", brush.angle_deg, -180.0, 180.0, "%.0f degrees");
  if (!is_dragged && brush.alpha_mode == AlphaMode::space) check("Rake", brush.use_rake);
  if (brush.alpha_mode == AlphaMode::tiled) slide("Tile", brush.tile, 0.1, 4.0, "%.2f radii");
  slide("Tip roundness", brush.tip_roundness, 0.05, 1.0, "%.2f");
}

/// What the chosen tool alone reads.
void draw_tool_options(UiState& ui, DocumentThread& document) {
  Brush& brush = ui.brush;
  switch (brush.action) {
    case Action::clay_strips:
      slide("Tip roundness", brush.tip_roundness, 0.05, 1.0, "%.2f");
      [[fallthrough]];
    case Action::flatten:
    case Action::scrape:
    case Action::fill:
    case Action::clay:
    case Action::trim:
      slide("Plane offset", brush.plane_offset, -1.0, 1.0, "%.2f radii");
      return;
    case Action::elastic:
      slide("Volume kept", brush.volume_preservation, 0.0, 1.0, "%.2f");
      return;
    case Action::snake_hook:
      slide("Magnify", brush.crease_pinch_factor, 0.0, 1.0, "%.2f");
      return;
    case Action::emboss:
      draw_alpha(ui, document);
      return;
    case Action::noise:
      slide("Wavelength", brush.wavelength, 0.1, 2.0, "%.2f radii");
      slide("Seed", brush.seed, 0, 99);
      return;
    default:
      return;
  }
}

/// How a drag becomes a stroke, of tools that may choose.
void draw_stroke_mode(Brush& brush) {
  if (!takes_modes(brush)) return;
  StrokeMode& mode = chosen_mode(brush);
  int at = static_cast<int>(mode);
  if (pick_one("Method", at, {kStrokeModeNames.begin(), kStrokeModeNames.end()})) {
    mode = static_cast<StrokeMode>(at);
  }
}

void draw_symmetry(UiState& ui) {
  Brush& brush = ui.brush;
  check("X##mirror", brush.mirror.x);
  say_key(Command::symmetry_x, ui);
  ImGui::SameLine();
  check("Y##mirror", brush.mirror.y);
  say_key(Command::symmetry_y, ui);
  ImGui::SameLine();
  check("Z##mirror", brush.mirror.z);
  say_key(Command::symmetry_z, ui);
  slide("Around", brush.radial.count, 1, 64);
  int axis = static_cast<int>(brush.radial.axis);
  if (pick_one("Axis", axis, {"x", "y", "z"})) brush.radial.axis = static_cast<std::size_t>(axis);
}

/// Whether the tool paints or cuts as a brush, or by an outline that is drawn over the picture.
void draw_drag_form(UiState& ui) {
  const bool is_mask = is_painted(ui.brush.action);
  if (!is_mask && ui.brush.action != Action::trim) return;
  DragForm& form = is_mask ? ui.outlines.mask : ui.outlines.trim;
  std::vector<std::string> names{"Brush", "Lasso", "Box"};
  if (!is_mask) names.insert(names.end(), {"Line", "Curve"});
  int at = static_cast<int>(form);
  if (pick_one("Drawn by", at, names)) form = static_cast<DragForm>(at);
  if (is_mask && form != DragForm::brush) check("Front faces only", ui.outlines.front_only);
}

/// How large panels and letters are, on top of what the screen asks for.
void draw_size_choice(Settings& settings) {
  std::vector<std::string> names;
  int at = 0;
  for (const int percent : kPanelPercents) {
    if (percent <= settings.panel_percent) at = static_cast<int>(names.size());
    names.push_back(std::to_string(percent) + " %");
  }
  if (pick_one("Size of panels", at, names)) {
    settings.panel_percent = kPanelPercents[static_cast<std::size_t>(at)];
  }
}

}  // namespace

void draw_tools(UiState& ui) {
  if (!ui.panels.has_tools) return;
  const float u = unit();
  ImGui::SetNextWindowPos({6.0F * u, below_menu()});
  ImGui::Begin("Tools", nullptr, kFixed);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2.0F * u, 2.0F * u});
  // As many beside each other as the height of the window asks for, two at least.
  const auto count = static_cast<float>(tool_infos().size());
  const float room = ImGui::GetIO().DisplaySize.y - 4.0F * ImGui::GetFrameHeight();
  int columns = 2;
  while (std::ceil(count / static_cast<float>(columns)) * (kTileHeight + 2.0F) * u > room &&
         columns < kMostToolColumns) {
    ++columns;
  }
  int column = 0;
  for (const ToolInfo& info : tool_infos()) {
    if (column > 0) ImGui::SameLine();
    draw_tool(info, ui);
    column = (column + 1) % columns;
  }
  ImGui::PopStyleVar();
  ui.panels.tools_right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
  ImGui::End();
}

void note_free_room(UiState& ui) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const double line = static_cast<double>(ImGui::GetFrameHeight());
  const bool has_side = ui.panels.has_brush || ui.panels.has_view;
  FreeRoom room{0.0, line, static_cast<double>(screen.x), static_cast<double>(screen.y) - line};
  if (ui.panels.has_tools) room.left = static_cast<double>(ui.panels.tools_right);
  if (has_side) room.right -= static_cast<double>((kSideWidth + 6.0F) * unit());
  ui.panels.room = room;
}

void draw_brush(UiState& ui, DocumentThread& document) {
  if (!ui.panels.has_brush) return;
  Brush& brush = ui.brush;
  ImGui::SetNextWindowPos(
      {ImGui::GetIO().DisplaySize.x - (kSideWidth + 6.0F) * unit(), below_menu()});
  ImGui::SetNextWindowSize({kSideWidth * unit(), 0.0F});
  // What does not fit above the other panel scrolls.
  const float end = ui.panels.has_view ? ui.panels.view_top : ImGui::GetIO().DisplaySize.y;
  const float room = std::max(end - below_menu() - 4.0F * unit(), 4.0F * ImGui::GetFrameHeight());
  ImGui::SetNextWindowSizeConstraints({kSideWidth * unit(), 0.0F}, {kSideWidth * unit(), room});
  ImGui::Begin("Brush", nullptr, kFixed);
  ImGui::PushItemWidth(150.0F * unit());
  if (brush.is_screen_size) {
    slide("Size", brush.radius_pixels, 2.0, 500.0, "%.0f px", true);
  } else {
    slide("Size", brush.radius_mm, 0.05, 100.0, "%.2f mm", true);
  }
  say_key(Command::brush_size, ui);
  check("Size on screen", brush.is_screen_size);
  slide("Strength", brush.strength, kLeastStrength, 1.0, "%.2f");
  say_key(Command::brush_strength, ui);
  check("Invert", brush.is_inverted);
  draw_shape(ui);
  if (is_profiled(brush.action)) {
    slide("Sharpness", brush.sharpness, 0.0, 1.0, "%.2f");
    slide("Width", brush.width, 0.3, 1.0, "%.2f");
  }
  draw_falloff(brush);
  draw_tool_options(ui, document);
  draw_drag_form(ui);
  if (is_painted(brush.action)) draw_mask_edits(ui, document);
  if (ImGui::CollapsingHeader("Symmetry", ImGuiTreeNodeFlags_DefaultOpen)) draw_symmetry(ui);
  const bool has_stroke = ImGui::CollapsingHeader("Stroke");
  note_widget("Stroke");
  if (has_stroke) {
    draw_stroke_mode(brush);
    slide("Spacing", brush.spacing, 0.05, 2.0, "%.2f");
    slide("Steady", brush.steady_mm, 0.0, 20.0, "%.1f mm");
    slide("Hold still", brush.hold_s, 0.0, 1.0, "%.2f s");
    slide("Pen: strength", brush.pressure_to_strength, 0.0, 1.0, "%.2f");
    slide("Pen: size", brush.pressure_to_size, 0.0, 1.0, "%.2f");
    draw_pressure(ui);
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_view(UiState& ui) {
  if (!ui.panels.has_view) return;
  const float bottom = ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() - 8.0F * unit();
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - (kSideWidth + 6.0F) * unit(), bottom},
                          ImGuiCond_Always, {0.0F, 1.0F});
  ImGui::SetNextWindowSize({kSideWidth * unit(), 0.0F});
  ImGui::Begin("View", nullptr, kFixed);
  // The brush's panel, above it, ends there in the next frame.
  ui.panels.view_top = ImGui::GetWindowPos().y;
  ImGui::PushItemWidth(150.0F * unit());
  int shading = static_cast<int>(ui.show.shading);
  if (pick_one("Shading", shading, {"Clay", "Plain", "Curvature", "Detail"})) {
    ui.show.shading = static_cast<Shading>(shading);
  }
  say_key(Command::shading_next, ui);
  check("Wireframe", ui.show.has_wires);
  say_key(Command::wires, ui);
  ImGui::SameLine();
  check("Occlusion", ui.show.has_occlusion);
  check("Stereo", ui.show.is_stereo);
  say_key(Command::stereo, ui);
  ImGui::SameLine();
  check("Planes", ui.show.has_planes);
  ImGui::SameLine();
  check("Marks", ui.show.has_pins);
  check("Slice", ui.show.has_slice);
  say_key(Command::slice, ui);
  if (ui.show.has_slice) {
    pick_one("Across", ui.show.slice_axis, {"x", "y", "z"});
    slide("Place", ui.show.slice_position, -1.0, 1.0, "%.2f");
  }
  draw_size_choice(ui.settings);
  check("Number row as numpad", ui.settings.has_number_views);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("1, 3, 5, 7 look as the numpad's keys do");
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_info(UiState& ui) {
  if (!ui.panels.has_info) return;
  ImGui::SetNextWindowSize({(kSideWidth + 60.0F) * unit(), 0.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowPos({kBesideTools * unit(), 0.5F * ImGui::GetIO().DisplaySize.y},
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
