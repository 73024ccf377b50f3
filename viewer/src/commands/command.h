// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "keys/command_info.h"
#include "keys/key_map.h"

namespace argil::viewer {

/// The brush works with this tool from now on, and nothing is measured any more.
void choose_tool(const ToolInfo& tool, UiState& ui);

/// Does what was asked for by its name. Whoever names a tool wants it, also where it is the one
/// that is chosen, which its key would leave.
void do_named(const KeyAim& aim, UiState& ui, DocumentThread& document);

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
