// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/input_event.h"
#include "picture/slice_chord.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// Points on the clay by the mouse, and what is measured between them. Where a point lies the
/// document thread tells, exactly; it is shown once that is told, a frame later.
///
/// Threads  the window's.
class MeasureGestures {
 public:
  MeasureGestures(UiState& ui, DocumentThread& document) : ui_(ui), document_(document) {}

  /// The left button, while a tool that measures is chosen. True: an end is held, or a point is put
  /// there, on an end exactly in its place. False where neither an end nor, by `is_on_clay`, clay
  /// lies.
  bool press(const InputEvent& event, bool is_on_clay);
  /// Lights the end under the pointer, or moves the one that is held.
  void move(const InputEvent& event);
  /// Lets go of it, and where it was not dragged begins at it; or puts the next point there, where
  /// the pointer was dragged from the one before.
  void release(const InputEvent& event);
  /// What is held goes back, or points that were begun are given up; false where there are none.
  bool cancel();
  /// Removes what is chosen, or takes back the last point of what was begun.
  void remove();

  /// Once a frame: takes what was told, and asks what lies under the pointer and what the clay
  /// hides.
  void tick();

 private:
  /// A question about a point that is put there.
  struct Waiting {
    std::int64_t question = 0;
    MeasureKind tool = MeasureKind::distance;
    std::optional<Chord> chord;  ///< through a slice, where it was asked there
  };
  /// An end that is held.
  struct Held {
    std::int64_t question = 0;
    MeasureEnd end;
    std::vector<MeasurePoint> before;  ///< all points of its measurement
    bool is_thickness = false;
    bool is_let_go = false;           ///< the answer to the last question is under way
    std::optional<Chord> chord = {};  ///< as of Waiting
  };
  /// What the answers depend on.
  struct Looked {
    Lens lens;
    bool is_stereo = false;
    std::int64_t changes = 0;
    std::shared_ptr<const PieceList> pieces;
    std::optional<SeenHalf> seen;
    std::optional<MeasureKind> tool;
    bool has_marks = true;
    std::int64_t last_number = 0;  ///< MeasureChoice::last_number
    bool operator==(const Looked&) const = default;
  };

  std::optional<Chord> ask(std::int64_t question, const Camera::Pixel& pixel);
  void put(const Camera::Pixel& pixel);
  bool is_click(const Camera::Pixel& pixel) const;
  bool is_last(const MeasurePoint& point) const;
  void click_on(const Held& end, const Camera::Pixel& pixel);
  void take(const MeasureAnswer& answer);
  void take_point(const MeasureAnswer& answer, const std::optional<Chord>& chord);
  void add_point(const MeasurePoint& point);
  void add_measurement(std::vector<MeasurePoint> points);
  void take_end(const MeasureAnswer& answer);
  void take_sight(const MeasureAnswer& answer);
  void ask_hover(bool is_new);
  void ask_sight(bool is_new, bool is_other_clay);
  std::optional<MeasureEnd> end_under(const Camera::Pixel& pixel) const;
  std::vector<MeasurePoint> points_of(const MeasureAnswer& answer,
                                      const std::optional<Chord>& chord, bool has_across) const;

  UiState& ui_;
  DocumentThread& document_;
  std::int64_t last_question_ = 0;
  std::vector<Waiting> waiting_;
  std::optional<Held> held_;
  std::optional<Camera::Pixel> pressed_at_;  ///< until the pointer was dragged from there
  bool may_drag_ = false;                    ///< from there to the next point
  std::optional<Chord> hover_chord_;
  std::optional<Looked> looked_;
  Camera::Pixel hovered_;         ///< where it was asked last
  std::int64_t asked_moves_ = 0;  ///< answers that moved an end, when sight was asked last
  std::int64_t moves_ = 0;
  std::int64_t clay_ = 0;  ///< ClayState::number that all this is of
};

}  // namespace argil::viewer
