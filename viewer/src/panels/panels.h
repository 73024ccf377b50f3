// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "document/message_log.h"
#include "picture/renderer.h"

namespace argil::viewer {

class HapticControl;

/// What the status line says of the last frame that drew the clay.
struct FrameState {
  double frame_ms = 0.0;
  RendererCounts counts;
  /// From an input to the end of the frame that shows its dab, of the last strokes: median and p99.
  /// Nothing where it is not asked for, or nothing was drawn yet.
  std::optional<std::pair<double, double>> latency_ms;
};

/// While the pointer is over the widget made last: the key that does the same, if one does.
void say_key(const KeyAim& aim, const UiState& ui);

// Each draws from the state and writes choices into it. What they do goes through commands and
// requests.
void draw_outline(const UiState& ui);
void draw_guide(const UiState& ui);
void draw_menu(UiState& ui, DocumentThread& document);
void draw_tools(UiState& ui);
/// What the panels that are always in their places leave free; after they were drawn.
void note_free_room(UiState& ui);
void draw_brush(UiState& ui, DocumentThread& document);
void draw_mask_edits(UiState& ui, DocumentThread& document);
void draw_alphas(UiState& ui, DocumentThread& document);
void draw_pressure(UiState& ui);
void draw_view(UiState& ui);
void draw_info(UiState& ui);
void draw_history(UiState& ui, DocumentThread& document);
void draw_haptics(UiState& ui, HapticControl& control, DocumentThread& document);
void draw_print(UiState& ui, DocumentThread& document);
void draw_still(UiState& ui);
void draw_references(UiState& ui);
void draw_dropped_image(UiState& ui);
void draw_pieces(UiState& ui, DocumentThread& document);
void draw_switch_hint(const UiState& ui);
/// Numbers and ends of what was measured, over the picture.
void draw_measure_marks(const UiState& ui);
void draw_measures(UiState& ui, DocumentThread& document);
void draw_search(UiState& ui, DocumentThread& document);
void draw_help(UiState& ui);
void draw_keys(UiState& ui);
void draw_presets(UiState& ui);
void draw_favourites(UiState& ui);
/// The ring of favourites, over all else.
void draw_pie(const UiState& ui);
void draw_thickness(const UiState& ui);
void draw_status(const UiState& ui, const FrameState& frame);
void draw_toasts(MessageLog& log);
void draw_messages(UiState& ui, MessageLog& log);
void draw_task(const UiState& ui, DocumentThread& document);
void draw_new_dialog(UiState& ui, DocumentThread& document);
void draw_operations(UiState& ui, DocumentThread& document);
void draw_recent(UiState& ui, DocumentThread& document);
void draw_import(UiState& ui, DocumentThread& document);
void draw_export(UiState& ui);
void draw_save_question(UiState& ui, DocumentThread& document);
void draw_left_question(UiState& ui, DocumentThread& document);

}  // namespace argil::viewer
