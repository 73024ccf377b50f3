// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "argil/engine/clay_worker.h"
#include "argil/engine/sketch.h"

#include "block_news.h"
#include "desk.h"
#include "workshop.h"

namespace argil::viewer {

/// What the workshop's thread works with: the desk with the project, the open stroke, the blocks.
/// Does one command after the other and posts what came of it.
class Bench {
 public:
  explicit Bench(Workshop& shop) : shop_(shop), desk_(shop.options_.home) {}

  void perform(Command command);
  /// Brings blocks, state and slice up to date with the clay, and posts them.
  void show();
  void look(const DisplayView& view) { view_ = view; }
  void cut(const std::optional<Workshop::SlicePlane>& plane);
  Workshop::Answer answer(const Ray& ray, const std::optional<Workshop::Touch>& touch);

  /// What was being shown did not fit into the memory.
  void out_of_memory();

  /// A large stroke is shown as a sketch, and the clay is behind it.
  bool has_backlog() const noexcept { return sketch_.has_value(); }
  /// A dab of it; true when there is something to show.
  bool work_backlog();

  bool is_linked() const noexcept { return link_.has_value(); }
  /// Works with what the hand did meanwhile; true when there is something to show.
  bool step_hand();

 private:
  void on(const BeginStroke& begin);
  void on(const ExtendStroke& extend);
  void on(const EndStroke&);
  void on(const CancelStroke&);
  void on(const DoStep& step);
  void on(const GoToStep& wanted);
  void on(const NewClay& make);
  void on(const OpenFile& open);
  void on(const ForgetQuestion&) { left_.reset(); }
  void on(const DropProject& drop);
  void on(const LoadStamp& load);
  void on(const SaveProject&);
  void on(const SaveProjectAs& save);
  void on(const EndProject& end);
  void on(const ExportMesh& wanted);
  void on(const CheckPrint& check);
  void on(const LinkHaptics& link);
  void on(const UnlinkHaptics&);

  bool has_clay(const char* what);
  std::optional<Pick> pick_at(const Ray& ray);
  void note_mask(const Stroke& stroke);
  bool asks_about_left_steps(const OpenFile& open);
  void end_open_stroke();
  bool apply_history(io::HistoryStep move);
  Result<int> queue(const std::vector<StrokeSample>& samples);
  void drop_sketch();
  void clay_changed_hands();
  void let_go_of_hand();
  void take_hand();
  void post(Notice::Kind kind, std::string text);
  void complain(const Error& error);
  void post_all(const std::vector<std::string>& notes);
  Progress begin_task(const char* name);
  /// One that neither tells how far it is nor can be stopped.
  void begin_silent_task(const char* name);
  void end_task();
  void post_state();
  std::shared_ptr<const StepNames> step_names();
  void post_slice();

  Workshop& shop_;
  Desk desk_;
  BlockFeed feed_;
  std::optional<DisplayView> view_;
  std::optional<Workshop::SlicePlane> plane_;
  bool is_slice_stale_ = false;
  std::optional<Sketch> sketch_;   ///< of the open stroke, where its tool is large
  bool is_sketch_ending_ = false;  ///< the hand is done, the clay is not
  Stroke stroke_;                  ///< the open one, as far as applied
  bool is_stamp_ = false;          ///< what it is called
  int gesture_strokes_ = 0;        ///< steps since the mouse's button went down
  bool skips_next_ = false;        ///< a command that was meant for what could not be saved
  std::vector<double> applied_inputs_s_;
  std::optional<LinkHaptics> link_;
  std::optional<ClayWorker> worker_;
  std::uint64_t shown_hand_dabs_ = 0;
  std::chrono::steady_clock::time_point hand_shown_;
  std::optional<LeftQuestion> left_;
  std::shared_ptr<const PrintReport> report_;
  std::shared_ptr<const Stamp> stamp_;
  std::shared_ptr<const StepNames> step_names_;
  std::int64_t named_changes_ = -1;  ///< changes_ when these were made
  std::string told_problem_;
  std::int64_t dabs_ = 0;
  std::int64_t strokes_ = 0;
  std::int64_t changes_ = 0;
  std::int64_t clays_ = 0;
  double last_dab_ms_ = 0.0;
  double edit_ms_ = 0.0;  ///< of the pieces since the last show
  int new_dabs_ = 0;
};

}  // namespace argil::viewer
