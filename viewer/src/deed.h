// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "key_name.h"
#include "ui_state.h"
#include "workshop.h"

namespace argil::viewer {

/// Everything that a key, a menu entry or a button does. Widgets name deeds; what a deed does is
/// here alone.
enum class Deed {
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
  operations,
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
  help,
  screenshot,
  turntable,
  messages,
  red_stop,
  give_force
};

struct DeedInfo {
  Deed deed = Deed::undo;
  const char* menu = "";  ///< the menu it stands in
  const char* title = "";
  const char* chord = "";  ///< "Ctrl+Z"; "" none
};
std::span<const DeedInfo> deed_infos() noexcept;
const DeedInfo& info_of(Deed deed) noexcept;

/// The deed of a chord, and the tool that a letter chooses; null for none.
std::optional<Deed> deed_of(const KeyChord& chord) noexcept;
const ActionInfo* tool_named_by(const KeyChord& chord) noexcept;

/// Whether a key that is held does it again and again, rather than once.
bool goes_on_while_held(Deed deed) noexcept;

/// Does it: changes the state of the window, or asks the clay.
void perform(Deed deed, UiState& ui, Workshop& shop);

/// Whether there is something to do it to now.
bool is_possible(Deed deed, const UiState& ui) noexcept;

/// The dialog that is open: of several that were asked for the first to be answered.
Dialog open_dialog(const UiState& ui) noexcept;

/// Closes what stands in the middle of the picture and asks for something that may be left.
void close_dialogs(UiState& ui) noexcept;

/// Does at once, or asks first whether to save, what puts another clay in the place of this one or
/// ends the program.
void leave_clay(AfterSaving then, UiState& ui, Workshop& shop);
/// What waited for the answer. Without saving, what is being worked on is stopped.
void go_on_after_saving(bool saves, UiState& ui, Workshop& shop);

/// The folder that the next dialog begins in, where there is such a folder.
void remember_folder_of(const std::filesystem::path& file, UiState& ui);

/// A file by its kind: opens a project, imports a mesh, replays a recording.
void open_file(const std::filesystem::path& file, UiState& ui, Workshop& shop);

}  // namespace argil::viewer
