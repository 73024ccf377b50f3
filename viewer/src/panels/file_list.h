// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "gui/system_dialog.h"

namespace argil::viewer {

/// Asks for a file while UiState::file_wish is set: by the desktop's own dialog where there is one,
/// else by a list of a folder's files.
class FileList {
 public:
  /// `has_system`: whether the desktop's dialog may be used.
  explicit FileList(bool has_system) : has_system_(has_system) {}

  /// Draws the dialog, and does what the file was asked for.
  void draw(UiState& ui, DocumentThread& document);
  /// Whether the desktop asks: its answer is looked for by draw().
  bool is_waiting() const noexcept { return system_.is_open(); }

 private:
  void start(UiState& ui);
  void draw_waiting(UiState& ui, DocumentThread& document, bool& is_open);
  void draw_list(UiState& ui, DocumentThread& document, bool& is_open);
  void read_folder();
  std::filesystem::path chosen() const;
  void finish(UiState& ui, DocumentThread& document);
  void take(std::filesystem::path file, UiState& ui, DocumentThread& document);
  void give_up(UiState& ui);

  bool has_system_;
  SystemDialog system_;
  FileWish wish_ = FileWish::none;
  std::filesystem::path folder_;
  std::string name_;
  std::vector<std::filesystem::path> folders_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace argil::viewer
