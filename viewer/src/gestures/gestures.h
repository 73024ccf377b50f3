// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "gestures/measure_gestures.h"
#include "gestures/piece_gestures.h"
#include "gestures/touch_gestures.h"
#include "input/input_event.h"
#include "keys/clutch_key.h"
#include "picture/surface_probe.h"

namespace argil::viewer {

/// Turns events into strokes on the clay, camera moves, changes of the brush and commands.
///
/// Threads  the window's.
class Gestures {
 public:
  /// Reads the surface as the last picture showed it, in the part of the window where a pixel lies.
  using Probe = std::function<SurfaceProbe(const Camera::Pixel&)>;

  /// `probe` is called when a stroke begins.
  Gestures(UiState& ui, DocumentThread& document, Probe probe)
      : ui_(ui),
        document_(document),
        probe_(std::move(probe)),
        pieces_(ui, document),
        measures_(ui, document),
        touch_(ui) {}

  /// `is_taken`: a panel has taken the event, so that it begins nothing here.
  void on(const InputEvent& told, bool is_taken);

  /// Once a frame: a brush that is held still goes on working (Brush::hold_s).
  void tick(double now_s);

  bool is_stroke_open() const noexcept { return stroke_.has_value(); }

  /// Whether the left button is held over the clay while a device works it (UiState::is_hand_led).
  bool is_hand_pressing() const noexcept { return drag_ == Drag::hand; }

  /// Where the open stroke is; nothing without one, or while it is beside the clay.
  std::optional<SurfaceHit> tool_hit() const;
  double tool_radius_mm() const noexcept { return stroke_ ? stroke_->radius_mm : 0.0; }

 private:
  enum class Drag { none, stroke, hand, orbit, pan, path, piece, outline, line, measure };
  /// What a press of the left button meets.
  enum class Met { stroke, other_piece, line, point, nothing };
  struct OpenStroke {
    Brush brush;
    double radius_mm = 1.0;
    SurfaceProbe probe;
    SurfaceHit grip;  ///< of grab: the first point, and the plane it stays in
    SurfaceHit hit;   ///< the newest
    StrokeSample last;
    double start_s = 0.0;
    bool is_off = false;      ///< the pointer has left the clay
    bool is_stamped = false;  ///< of a stamp: it was put on
    // Of one dab (is_one_dab), which is laid again when the clay has come so far.
    bool is_laid = false;
    bool is_stale = false;
    double input_s = 0.0;  ///< when the hand was there
  };

  void note_pressure(double pressure);
  void press(const InputEvent& event);
  void move(const InputEvent& event);
  void release(const InputEvent& event);
  void puck(const InputEvent& event);
  void take_finger(const InputEvent& event, bool is_taken);
  void let_go(double now_s);
  void cancel_stroke();
  void key(const InputEvent& event, bool is_asked);
  void do_key(const InputEvent& event);
  void escape();
  void drag_brush(const InputEvent& event);
  void place_drain(const InputEvent& event);
  void begin_path(const InputEvent& event);
  void extend_path(const InputEvent& event);
  void end_path();
  void leave_path();
  bool begin_outline(const InputEvent& event);
  void end_outline();
  bool leave_outline();
  void key_of_curve(const InputEvent& event);
  Met begin_stroke(const InputEvent& event);
  Drag drag_of(const InputEvent& event);
  Drag work_of(const InputEvent& event, Drag beside);
  Drag measure(const InputEvent& event);
  void extend_stroke(const InputEvent& event);
  void end_stroke();
  bool has_one_dab(const OpenStroke& stroke) const noexcept;
  void drag_dab(const InputEvent& event);
  void lay_dab();
  Met begin_guide(const InputEvent& event, const SurfaceProbe& probe, const Brush& brush);
  bool leave_guide();
  void apply_curve(const InputEvent& event);
  void lay_along(const std::vector<Camera::Pixel>& way, const InputEvent& event);
  std::optional<SurfaceHit> hit_of(const OpenStroke& stroke, const InputEvent& event) const;

  UiState& ui_;
  DocumentThread& document_;
  Probe probe_;
  Drag drag_ = Drag::none;
  MouseButton button_ = MouseButton::left;  ///< that began the drag
  // Of the last press: when it was, and what it may have added to.
  double pressed_s_ = 0.0;
  std::optional<OutlineDrag> outline_before_;
  std::optional<StrokeGuide> guide_before_;
  std::optional<OpenStroke> stroke_;
  bool lays_guide_ = false;   ///< a line or a curve is being made a stroke
  bool paints_mask_ = false;  ///< the stroke that was begun last masks, whatever the tool
  PieceGestures pieces_;
  MeasureGestures measures_;
  TouchGestures touch_;
  std::optional<SurfaceProbe> path_probe_;  ///< of the picture in which a path was begun
};

}  // namespace argil::viewer
