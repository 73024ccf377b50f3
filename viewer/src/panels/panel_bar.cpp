// SPDX-License-Identifier: GPL-3.0-or-later
// What lies along the edges: the menu, the status line, the progress of long work; and the help.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "keys/mouse_habit.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr double kSweepS = 1.5;  // of a bar that only says that something goes on

constexpr const char* kMenus[] = {"File", "Edit",    "Piece",  "Brush", "Mask",
                                  "View", "Measure", "Device", "Help"};

/// Whether the menu shows a tick beside a command.
bool is_on(Command command, const UiState& ui) {
  switch (command) {
    case Command::symmetry_x:
      return ui.brush.mirror.x;
    case Command::symmetry_y:
      return ui.brush.mirror.y;
    case Command::symmetry_z:
      return ui.brush.mirror.z;
    case Command::view_parallel:
      return ui.camera.is_parallel();
    case Command::wires:
      return ui.show.has_wires;
    case Command::slice:
      return ui.show.has_slice;
    case Command::stereo:
      return ui.show.is_stereo;
    case Command::panels:
      return ui.panels.has_tools;
    case Command::history:
      return ui.panels.has_history;
    case Command::pieces:
      return ui.panels.has_pieces;
    case Command::piece_gizmo:
      return ui.pieces.has_gizmo;
    case Command::messages:
      return ui.panels.has_messages;
    case Command::help:
      return ui.panels.has_help;
    case Command::presets:
      return ui.panels.has_presets;
    case Command::favourite_list:
      return ui.panels.has_favourites;
    case Command::keys:
      return ui.panels.has_keys;
    case Command::figures:
      return ui.panels.has_info;
    case Command::print:
      return ui.panels.has_print;
    case Command::references:
      return ui.panels.has_references;
    case Command::device:
      return ui.panels.has_haptics;
    case Command::measure_distance:
      return ui.measures.tool == MeasureKind::distance;
    case Command::measure_angle:
      return ui.measures.tool == MeasureKind::angle;
    case Command::measure_thickness:
      return ui.measures.tool == MeasureKind::thickness;
    case Command::measure_list:
      return ui.panels.has_measures;
    default:
      return false;
  }
}

/// What killed windows left before their clay had a name.
void draw_left(UiState& ui, DocumentThread& document) {
  if (ui.left_projects.empty() || !begin_menu("Never saved")) return;
  std::optional<std::filesystem::path> chosen;
  for (const LeftProject& left : ui.left_projects) {
    if (menu_item(left.text.c_str(), nullptr, false, true)) chosen = left.file;
  }
  ImGui::EndMenu();
  if (chosen) open_file(*chosen, ui, document);
}

/// Files that can be opened again, above Quit.
void draw_files(UiState& ui, DocumentThread& document) {
  ImGui::Separator();
  draw_left(ui, document);
  ImGui::Separator();
}

/// What the hand does in the mode at hand; empty for what needs no words.
std::string words_of_drawing(const UiState& ui) {
  if (ui.outline && ui.outline->form == DragForm::curve) {
    return words_of(StrokeMode::curve, ui.outline->points.size());
  }
  const bool has_device = ui.haptics.device != DeviceChoice::mouse;
  if (has_device || drag_form_of(ui) != DragForm::brush) return {};
  return words_of(mode_of(ui.brush), ui.guide ? ui.guide->places_mm.size() : 0);
}

/// What the buttons of the mouse do now.
std::string buttons_of(const UiState& ui) {
  const std::string others = std::string(", ") + mouse_words(ui.keys.set()).status_line;
  if (ui.pie.is_open) {
    return ui.pie.held_key != 0 ? "Let go: choose, in the middle: nothing"
                                : "Left: choose, right or Esc: close";
  }
  if (!ui.clay.has_clay) return "";
  if (ui.places_drain) return std::string("Left: place the drain") + others;
  if (ui.draws_path) return std::string("Left: draw the path") + others;
  if (ui.is_hand_led && !ui.measures.tool) return std::string("Left: press the tool in") + others;
  if (ui.measures.tool) return std::string(next_pick(ui.measures)) + others;
  for (const ToolInfo& info : tool_infos()) {
    if (!is_chosen(ui.brush, info)) continue;
    return std::string("Left: ") + info.title + others;
  }
  return "";
}

/// At the right end of the status line: that the force is stopped, else what the mouse does and
/// where help is, as far as there is room.
void draw_hint(const UiState& ui, float screen_width) {
  ImGui::SameLine();
  const auto left_of = [&](const std::string& text) {
    return screen_width - ImGui::CalcTextSize(text.c_str()).x - 20.0F * unit();
  };
  if (!ui.is_force_stopped) {
    const std::string& key = ui.keys.text_of(Command::help);
    const std::string help = key.empty() ? std::string("Help > Keys") : key + ": all keys";
    const std::string buttons = buttons_of(ui);
    const std::string whole = buttons.empty() ? help : buttons + "   |   " + help;
    // Over other text nothing could be read.
    for (const std::string& text : {whole, help}) {
      if (ImGui::GetCursorPosX() > left_of(text)) continue;
      ImGui::SameLine(left_of(text));
      ImGui::TextDisabled("%s", text.c_str());
      return;
    }
    return;
  }
  const char* const text = "FORCE STOPPED";
  ImGui::SameLine(left_of(text));  // even over other text
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::CalcTextSize(text);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {low.x - 8.0F * unit(), low.y - unit()},
      {low.x + size.x + 8.0F * unit(), low.y + size.y + unit()}, ImGui::GetColorU32(kStopColor),
      3.0F * unit());
  ImGui::TextColored(kOnStopColor, "%s", text);
}

/// The project's name, with a star where it was changed since it was saved.
std::string file_text(const ClayState& clay) {
  const std::string name = clay.is_untitled ? "not saved yet" : clay.file.filename().string();
  return name + (clay.is_changed ? " *" : "");
}

/// Triangles are the renderer's: as many as are shown at this distance.
void draw_figures(const UiState& ui, const FrameState& frame) {
  const ClayState& clay = ui.clay;
  char text[320];
  const bool has_others = clay.pieces && clay.pieces->pieces.size() > 1;
  const std::string piece = has_others ? "   |   " + clay.pieces->active_piece().look.name : "";
  std::snprintf(text, sizeof text,
                "%s%s%s   |   %s triangles   |   %.3g mm finest voxel   |   dab %.1f ms   |   "
                "frame %.0f ms   |   undo %zu",
                clay.is_untitled ? "not saved yet" : clay.file.filename().string().c_str(),
                clay.is_changed ? " *" : "", piece.c_str(), grouped(frame.counts.triangles).c_str(),
                clay.voxel_mm, clay.last_dab_ms, frame.frame_ms, undo_count(clay));
  ImGui::TextUnformatted(text);
  if (!frame.latency_ms) return;
  ImGui::SameLine(0.0F, 0.0F);
  ImGui::Text("   |   input to screen %.0f ms, p99 %.0f", frame.latency_ms->first,
              frame.latency_ms->second);
}

/// Whether the menu leaves no room for STOP behind it.
bool is_bar_narrow() { return ImGui::GetWindowWidth() < 530.0F * unit(); }

/// At the right end of the menu, where no panel opens over it, while there is a force to stop; at
/// its left end in a narrow window.
void draw_bar_stop(std::optional<Command>& chosen, const UiState& ui) {
  if (ui.haptics.device == DeviceChoice::mouse) return;
  const float width = ImGui::CalcTextSize("STOP").x + 2.0F * ImGui::GetStyle().FramePadding.x;
  if (!is_bar_narrow()) {
    ImGui::SetCursorPosX(
        std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - width - 6.0F * unit()));
  }
  ImGui::PushStyleColor(ImGuiCol_Button, kStopColor);
  ImGui::PushStyleColor(ImGuiCol_Text, kOnStopColor);
  if (button("STOP")) chosen = Command::emergency_stop;
  ImGui::PopStyleColor(2);
}

}  // namespace

void draw_menu(UiState& ui, DocumentThread& document) {
  if (!ImGui::BeginMainMenuBar()) return;
  std::optional<Command> chosen;
  if (is_bar_narrow()) draw_bar_stop(chosen, ui);
  for (const char* menu : kMenus) {
    if (!begin_menu(menu)) continue;
    for (const CommandInfo& info : command_infos()) {
      if (std::string_view(info.menu) != menu) continue;
      if (info.command == Command::quit) draw_files(ui, document);
      if (info.command == Command::figures) ImGui::Separator();
      if (menu_item(info.title, ui.keys.text_of(info.command).c_str(), is_on(info.command, ui),
                    is_possible(info.command, ui))) {
        chosen = info.command;
      }
    }
    ImGui::EndMenu();
  }
  if (!is_bar_narrow()) draw_bar_stop(chosen, ui);
  ImGui::EndMainMenuBar();
  // After the bar is drawn: a command may change what it shows.
  if (chosen) perform(*chosen, ui, document);
}

void draw_status(const UiState& ui, const FrameState& frame) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float high = ImGui::GetFrameHeight();
  ImGui::SetNextWindowPos({0.0F, screen.y - high - 2.0F});
  ImGui::SetNextWindowSize({screen.x, high + 2.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0F * unit(), 3.0F * unit()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});  // else more than a line of text
  ImGui::Begin("Status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const ClayState& clay = ui.clay;
  if (!clay.has_clay) {
    ImGui::TextUnformatted("No clay: File > New, or drop a file here");
  } else if (ui.measures.tool) {
    ImGui::Text("%s   |   Measuring: Delete removes what is chosen, Esc leaves",
                file_text(clay).c_str());
  } else if (const std::string words = words_of_drawing(ui); !words.empty()) {
    ImGui::Text("%s   |   %s", file_text(clay).c_str(), words.c_str());
  } else {
    draw_figures(ui, frame);
  }
  draw_hint(ui, screen.x);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

/// Beside the pointer, as a number on a drawing.
void draw_thickness(const UiState& ui) {
  if (!ui.chord || ui.measures.tool == MeasureKind::thickness) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.2f mm", length(ui.chord->to_mm - ui.chord->from_mm));
  const ImVec2 at{static_cast<float>(ui.pointer.x) + 16.0F * unit(),
                  static_cast<float>(ui.pointer.y) + 12.0F * unit()};
  const ImVec2 size = ImGui::CalcTextSize(text);
  const float margin = 4.0F * unit();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({at.x - margin, at.y - margin},
                     {at.x + size.x + margin, at.y + size.y + margin},
                     ImGui::GetColorU32(ImGuiCol_PopupBg), margin);
  list.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text);
}

void draw_task(const UiState& ui, DocumentThread& document) {
  if (!ui.task.is_running) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * screen.x, 0.12F * screen.y}, ImGuiCond_Always, {0.5F, 0.0F});
  ImGui::SetNextWindowSize({360.0F * unit(), 0.0F});
  // Without focus: it may appear in the frame in which a dialog does, and Dear ImGui 1.86 takes no
  // window then that wants it.
  ImGui::Begin("##task", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(ui.task.name.c_str());
  if (ui.task.has_progress) {
    ImGui::ProgressBar(static_cast<float>(ui.task.fraction), {-1.0F, 0.0F});
    if (button("Stop this")) document.cancel_task();
  } else {
    // Nobody knows how far: only that it goes on.
    const double turns = ImGui::GetTime() / kSweepS;
    ImGui::ProgressBar(static_cast<float>(turns - std::floor(turns)), {-1.0F, 0.0F}, "");
  }
  ImGui::End();
}

namespace {

void draw_key(const char* what, const char* how) {
  ImGui::TextDisabled("%s", how);
  ImGui::SameLine(114.0F * unit());
  ImGui::TextUnformatted(what);
}

void draw_heading(const char* text) { colored_text(shown_colors().heading, text); }

/// What the mouse does, which no menu lists, and the keys of the tools.
void draw_mouse_keys(const KeyMap& keys) {
  const MouseWords words = mouse_words(keys.set());
  draw_heading("Mouse");
  draw_key("sculpt", "Left");
  draw_key("the opposite", words.opposite);
  draw_key("smooth", "Shift+Left");
  if (*words.mask != '\0') draw_key("mask", words.mask);
  draw_key("mask by a lasso", "Ctrl+Shift+Left");
  draw_key("turn", words.turn);
  draw_key("turn", words.turn_too);
  if (keys.set() != KeySet::zbrush) draw_key("turn", "Left beside it");
  draw_key("move", words.move);
  draw_key("move", words.move_too);
  draw_key("nearer, farther", "Wheel");
  draw_key("sculpt another piece", "Double click");
  draw_key("take a stroke back", "Esc");
  draw_key("clutch of the device", "V (held)");
  draw_key("close a dialog", "Esc");
  ImGui::Spacing();
  draw_heading("Tools");
  for (const ToolInfo& info : tool_infos()) {
    const std::string& key = keys.text_of(&info);
    if (!key.empty()) draw_key(info.title, key.c_str());
  }
}

void draw_menu_keys(const char* menu, const KeyMap& keys) {
  draw_heading(menu);
  for (const CommandInfo& info : command_infos()) {
    const std::string& key = keys.text_of(info.command);
    if (std::string_view(info.menu) == menu && !key.empty()) draw_key(info.title, key.c_str());
  }
  ImGui::Spacing();
}

/// What mouse and keys do while something is measured.
void draw_measure_keys() {
  draw_key("put a point", "Left");
  draw_key("move an end", "Left on it");
  draw_key("remove what is chosen", "Delete");
  draw_key("give up, leave", "Esc");
}

}  // namespace

void draw_help(UiState& ui) {
  if (!ui.panels.has_help) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * screen.x, 0.5F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize(
      {std::min(860.0F * unit(), 0.94F * screen.x), std::min(620.0F * unit(), 0.86F * screen.y)});
  ImGui::Begin("Keys and mouse", &ui.panels.has_help,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
  // Side by side as far as the longest line of each fits.
  const int columns =
      std::clamp(static_cast<int>(ImGui::GetWindowWidth() / (280.0F * unit())), 1, 3);
  if (ImGui::BeginTable("keys", columns)) {
    ImGui::TableNextColumn();
    draw_mouse_keys(ui.keys);
    ImGui::TableNextColumn();
    for (const char* menu : {"File", "Edit", "Piece", "Mask", "Device", "Help"})
      draw_menu_keys(menu, ui.keys);
    ImGui::TableNextColumn();
    for (const char* menu : {"View", "Brush", "Measure"}) draw_menu_keys(menu, ui.keys);
    draw_measure_keys();
    ImGui::EndTable();
  }
  if (button("Change them...")) {
    ui.panels.has_help = false;
    ui.panels.has_keys = true;
  }
  ImGui::End();
}

}  // namespace argil::viewer
