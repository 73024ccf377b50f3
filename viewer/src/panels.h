// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <imgui.h>

#include "gui.h"
#include "message_log.h"
#include "system_dialog.h"
#include "ui_state.h"
#include "workshop.h"

namespace argil::viewer {

class HapticDesk;

/// What the status line says of the last frame that drew the clay.
struct FrameState {
  double frame_ms = 0.0;
  RendererCounts counts;
};

/// Asks for a file while ui.file_wish does: by the desktop's own dialog where there is one, else by
/// a list of a folder's files.
class FileList {
 public:
  /// `has_system`: whether the desktop's may be asked.
  explicit FileList(bool has_system) : has_system_(has_system) {}

  /// Draws the dialog while ui.file_wish asks for a file, and does what was wished.
  void draw(UiState& ui, Workshop& shop);

 private:
  void start(UiState& ui);
  void draw_waiting(UiState& ui, Workshop& shop, bool& is_open);
  void draw_list(UiState& ui, Workshop& shop, bool& is_open);
  void read_folder();
  std::filesystem::path chosen() const;
  void finish(UiState& ui, Workshop& shop);
  void take(std::filesystem::path file, UiState& ui, Workshop& shop);
  void give_up(UiState& ui);

  bool has_system_;
  SystemDialog system_;
  FileWish wish_ = FileWish::none;
  std::filesystem::path folder_;
  std::string name_;
  std::vector<std::filesystem::path> folders_;
  std::vector<std::filesystem::path> files_;
};

/// Of what stops the force, and says that it is stopped.
inline const ImVec4 kStopColor{0.75F, 0.10F, 0.08F, 1.0F};

/// Where panels begin that open beside the tools.
inline constexpr float kBesideTools = 162.0F;

/// Where panels that are opened begin, each at a place of its own: from the tools to the brush.
inline constexpr float kDevicePlace = kBesideTools;
inline constexpr float kPrintPlace = kDevicePlace + 308.0F;
inline constexpr float kHistoryPlace = kPrintPlace + 288.0F;

/// Below the menu, when it is opened first; farther left where the screen ends.
void put_beside(float left, float width);

/// Of the next panel, as wide as its content asks for: what does not fit below it scrolls.
void keep_on_screen(float width);

/// 1 234 567.
std::string grouped(std::int64_t number);
/// Of the local clock, as strftime writes it.
std::string clock_text(std::chrono::system_clock::time_point when, const char* format);

// Each draws from the state and writes choices into it; what they do goes through deeds.
void draw_menu(UiState& ui, Workshop& shop);
void draw_tools(UiState& ui);
void draw_brush(UiState& ui, Workshop& shop);
void draw_view(UiState& ui);
void draw_info(UiState& ui);
void draw_history(UiState& ui, Workshop& shop);
void draw_haptics(UiState& ui, HapticDesk& desk, Workshop& shop);
void draw_print(UiState& ui, Workshop& shop);
void draw_help(UiState& ui);
void draw_status(const UiState& ui, const FrameState& frame);
void draw_toasts(MessageLog& log);
void draw_messages(UiState& ui, MessageLog& log);
void draw_task(const UiState& ui, Workshop& shop);
void draw_new_dialog(UiState& ui, Workshop& shop);
void draw_operations(UiState& ui, Workshop& shop);
void draw_export(UiState& ui);
void draw_save_question(UiState& ui, Workshop& shop);
void draw_left_question(UiState& ui, Workshop& shop);

}  // namespace argil::viewer
