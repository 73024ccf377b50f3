// SPDX-License-Identifier: GPL-3.0-or-later
// The mask's edits with their numbers, in the panel of the brush that paints it.
#include <initializer_list>
#include <string>

#include <imgui.h>

#include "commands/command.h"
#include "gui/gui.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

/// Buttons side by side, named as in the menu.
void draw_mask_row(std::initializer_list<Command> commands, UiState& ui, DocumentThread& document) {
  bool is_first = true;
  for (const Command command : commands) {
    if (!is_first) ImGui::SameLine();
    is_first = false;
    const CommandInfo& info = info_of(command);
    if (button((std::string(info.title) + "##mask").c_str())) perform(command, ui, document);
    say_key(command, ui);
  }
}

}  // namespace

void draw_mask_edits(UiState& ui, DocumentThread& document) {
  draw_mask_row({Command::mask_invert, Command::mask_clear, Command::mask_fill}, ui, document);
  ImGui::SameLine();
  draw_mask_row({Command::mask_blur, Command::mask_sharpen}, ui, document);
  const MaskChoice shown = mask_numbers(ui);
  double by_mm = shown.by_mm;
  if (slide("By##mask", by_mm, 0.01, 50.0, "%.2f mm", true)) ui.mask.by_mm = by_mm;
  draw_mask_row({Command::mask_grow, Command::mask_shrink}, ui, document);
  double cavity_mm = shown.cavity_mm;
  if (slide("Cavity size", cavity_mm, 0.01, 50.0, "%.2f mm", true)) ui.mask.cavity_mm = cavity_mm;
  slide("Cavity factor", ui.mask.cavity_factor, -10.0, 10.0, "%.2f");
  draw_mask_row({Command::mask_cavity}, ui, document);
  ImGui::SameLine();
  check("All but cavities", ui.mask.is_cavity_inverted);
}

}  // namespace argil::viewer
