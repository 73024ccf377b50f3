// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/key_name.h"

namespace argil::viewer {

/// Everything that a key, a menu entry or a button does. Widgets only name commands; perform() does
/// them.
enum class Command {
  new_clay,
  open,
  import_mesh,
  save,
  save_as,
  export_mesh,
  quit,
  undo,
  redo,
  history,
  mask_invert,
  mask_clear,
  mask_blur,
  mask_fill,
  mask_grow,
  mask_shrink,
  mask_sharpen,
  mask_cavity,
  operations,
  pieces,
  piece_switch,
  piece_gizmo,
  piece_ball,
  piece_import,
  piece_duplicate,
  piece_remove,
  piece_split,
  piece_bed,
  piece_bed_all,
  piece_flat,
  piece_middle,
  piece_unite,
  piece_subtract,
  piece_intersect,
  symmetry_x,
  symmetry_y,
  symmetry_z,
  brush_smaller,
  brush_larger,
  brush_weaker,
  brush_stronger,
  brush_size,
  brush_strength,
  view_front,
  view_back,
  view_right,
  view_left,
  view_top,
  view_bottom,
  view_frame,
  view_parallel,
  shading_next,
  wires,
  slice,
  stereo,
  panels,
  references,
  figures,
  print,
  measure_distance,
  measure_angle,
  measure_thickness,
  measure_clear,
  measure_list,
  device,
  search,
  help,
  screenshot,
  turntable,
  still,
  messages,
  emergency_stop,
  give_force
};

struct CommandInfo {
  Command command = Command::undo;
  const char* menu = "";  ///< the menu that lists it
  const char* title = "";
  const char* chord = "";  ///< "Ctrl+Z"; "" none
};
std::span<const CommandInfo> command_infos() noexcept;
const CommandInfo& info_of(Command command) noexcept;

/// The command of a chord, and the tool that a letter chooses; null for none.
std::optional<Command> command_of(const KeyChord& chord) noexcept;
const ToolInfo* tool_named_by(const KeyChord& chord) noexcept;

/// The brush works with this tool from now on, and nothing is measured any more.
void choose_tool(const ToolInfo& tool, UiState& ui);

/// Whether a key that is held down repeats it.
bool goes_on_while_held(Command command) noexcept;

/// Does it: changes the state of the window, or sends a request.
void perform(Command command, UiState& ui, DocumentThread& document);

/// Whether it can be done now.
bool is_possible(Command command, const UiState& ui) noexcept;

/// The dialog that is open: of several that were asked for, the one to be answered first.
Dialog open_dialog(const UiState& ui) noexcept;

/// Closes every dialog that may be left unanswered, and the help. True where one was open.
bool close_dialogs(UiState& ui) noexcept;

/// Replaces the clay by another or ends the program: at once, or after asking whether to save.
void leave_clay(AfterSaving then, UiState& ui, DocumentThread& document);
/// Does what waited for that answer. Without saving, work under way is stopped.
void go_on_after_saving(bool saves, UiState& ui, DocumentThread& document);

/// Makes the file's folder the one that the next dialog begins in, if it exists.
void remember_folder_of(const std::filesystem::path& file, UiState& ui);

/// Asks how a mesh shall be imported; and does it as it was answered.
void ask_about_mesh(const std::filesystem::path& file, UiState& ui, DocumentThread& document);
void import_as_chosen(UiState& ui, DocumentThread& document);

/// Opens a project, asks about a mesh or replays a recording, by the file's extension.
void open_file(const std::filesystem::path& file, UiState& ui, DocumentThread& document);

}  // namespace argil::viewer
