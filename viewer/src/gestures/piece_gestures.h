// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/input_event.h"
#include "picture/gizmo.h"
#include "picture/piece_frame.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// Where the active piece is shown: as it is being dragged, else as the document has it; and how
/// many times as large.
Placement shown_placement(const UiState& ui);
double shown_factor(const UiState& ui);
/// Whether what was dragged is in the document, or is no longer to be shown: the drag is over.
bool is_drag_done(const UiState& ui, bool is_idle);
/// The box around all that is shown, a piece that is being dragged included.
Box3 shown_bounds(const UiState& ui);
/// Around the middle of the active piece; nothing where it is not wanted, or the piece can neither
/// be seen nor moved.
std::optional<Gizmo> shown_gizmo(const UiState& ui, const Camera& camera);
/// Where the piece of the print report is shown; nothing without a report, or where it is gone or
/// hidden.
std::optional<Placement> judged_placement(const UiState& ui);
/// One step: the active piece stands there. Nothing where it does so already.
void place_active(const Placement& placement, const UiState& ui, DocumentThread& document);
/// One step: the active piece becomes so many times as large about that point of the sculpture.
void scale_active(double factor, const Vec3& about_mm, const UiState& ui, DocumentThread& document);
/// The middle of the foot of the box around the active piece's surface: scaled about it, what
/// stands on the bed stays there. Nothing where there is no surface.
std::optional<Vec3> foot_of_active(const UiState& ui);

/// The gizmo under the mouse, and clicks on other pieces than the active one.
///
/// Threads  the window's.
class PieceGestures {
 public:
  PieceGestures(UiState& ui, DocumentThread& document) : ui_(ui), document_(document) {}

  /// True when a handle of the gizmo lies there, which is held from now on.
  bool press(const InputEvent& event);
  /// Lights the handle under the pointer, or moves the piece by the one that is held.
  void move(const InputEvent& event);
  /// Lets go of it: one step of the document.
  void release();
  /// The piece goes back to where it was; false where none is held.
  bool cancel();

  /// A press where another piece is seen. Twice at one place makes it the active one.
  void press_on_other(const InputEvent& event);

 private:
  UiState& ui_;
  DocumentThread& document_;
  std::optional<GizmoDrag> drag_;
  Vec3 middle_mm_;                        ///< of the gizmo when that began
  WindowPart drag_part_;                  ///< in which it began
  std::optional<InputEvent> last_press_;  ///< on another piece
};

}  // namespace argil::viewer
