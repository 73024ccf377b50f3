// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay_worker.h"
#include "argil/engine/preview.h"

#include "document/document.h"
#include "document/measure_pick.h"
#include "document/outbox.h"
#include "document/request.h"
#include "document/scene_feed.h"

namespace argil::viewer {

/// What runs on the document thread: owns the document, the open stroke and the blocks to be drawn,
/// does one request after the other and posts the results.
///
/// Threads  the document thread alone.
class DocumentWorker {
 public:
  /// `home`: a folder for what has no name yet. `places`: as of Document.
  DocumentWorker(Outbox& outbox, const std::filesystem::path& home,
                 const PicturePlaces& places = {})
      : outbox_(outbox), document_(home, places) {}

  void perform(Request request);
  /// Brings blocks, state and slice up to date with the clay, and posts them.
  void show();
  void look(const DisplayView& view) {
    view_ = view;
    document_.look_from(view);
    looks_at_all_ = true;
  }
  void cut(const std::optional<SlicePlane>& plane);
  PointerAnswer answer(const Ray& ray, const std::optional<Touch>& touch);
  MeasureAnswer measure(const MeasureQuestion& question);

  /// There was not enough memory for what was being shown: complains, and sends all blocks again.
  void out_of_memory();

  /// What is done when no request waits: a large stroke is shown as a preview, and dabs of the clay
  /// itself still wait; or a clay that has just come is shown by its coarse levels alone; or the
  /// names of its older steps are not read, or its picture is due. While a large tool is held still
  /// there is none.
  bool has_backlog();
  /// Applies one of these dabs, reads the names, or pictures the work; true when there is something
  /// to show.
  bool work_backlog();
  /// Shown in detail it will be as the window sees it: worth waiting for the window to say so.
  bool waits_for_view() const noexcept { return is_sketched_; }

  bool is_linked() const noexcept { return link_.has_value(); }
  /// Applies what the device's hand did meanwhile; true when there is something to show.
  bool step_hand();

 private:
  void on(const BeginStroke& begin);
  void on(const ExtendStroke& extend);
  void on(const EndStroke&);
  void on(const CancelStroke&);
  void on(const DoStep& step);
  void on(const TrimPiece& trim);
  void on(const GoToStep& wanted);
  void on(const SelectPieceAt& wanted);
  void on(const AddBallPiece&);
  void on(const ImportPiece& import);
  void on(const DuplicatePiece&);
  void on(const StandPiece& wanted);
  void on(const NewClay& make);
  void on(const OpenFile& open);
  void on(const LookAtMesh& look);
  void on(const ImportMesh& wanted);
  void on(const ForgetQuestion&) { left_.reset(); }
  void on(const DropProject& drop);
  void on(const LoadStamp& load);
  void on(const LoadAlpha& load);
  void on(const CheckPath& check);
  void on(const SendBlocksAgain&);
  void on(const ForgetHistory&);
  void on(const SaveProject&);
  void on(const SaveProjectAs& save);
  void on(const EndProject& end);
  void on(const ExportMesh& wanted);
  void on(const CheckPrint& check);
  void on(const LinkHaptics& link);
  void on(const UnlinkHaptics&);

  bool has_clay(const char* what);
  const PieceLook& active_look();
  Result<void> check_may_be_worked();
  Result<void> check_is_active(std::optional<PieceKey> piece);
  Result<void> check_step(const DoStep& wanted);
  SceneFeed::ViewOf view_to_show();
  std::optional<ScenePick> pick_at(const Ray& ray);
  void note_mask(const Stroke& stroke);
  bool asks_about_left_steps(const OpenFile& open);
  void end_open_stroke();
  /// What is drawn is not the clay as it is.
  bool is_behind() const noexcept { return preview_.has_value() || is_sketched_; }
  Result<StrokeReport> move_in_history(io::HistoryStep move);
  bool apply_history(io::HistoryStep move);
  Result<int> queue(const std::vector<StrokeSample>& samples);
  bool has_dabs_to_work();
  /// A device's hand does not wait for pictures: what it feels must not grow old.
  bool wants_picture() { return !link_ && document_.wants_picture(); }
  void drop_preview();
  void clay_changed_hands();
  void let_go_of_hand();
  void take_hand();
  void post(Notice::Kind kind, std::string text);
  void complain(const Error& error);
  void complain_about(io::HistoryStep move, const Error& error);
  void post_all(const std::vector<std::string>& notes);
  void post_state();
  void post_pieces(ClayState& state);
  std::shared_ptr<const StepNames> step_names();
  void post_slice();

  void add_piece(const AddPiece& add);
  Result<TriangleMesh> standing_surface(std::size_t piece, const Progress& progress);
  Result<Placement> standing_place(StandPiece::Where where, const Progress& progress);
  Result<PlacePieces> places_on_bed(const Progress& progress);
  Result<Placement> laid_on_most(const TriangleMesh& surface, const Vec3& middle_mm,
                                 const Progress& progress);
  const Box3& surface_of_active();
  void post_edit(const PieceEdit& edit, std::size_t pieces_before);
  bool may_touch_mask(const io::ScriptStep& step) const;
  void piece_list_changed() noexcept { is_list_stale_ = looks_at_all_ = true; }
  void export_pieces(const ExportMesh& wanted);
  Result<mesh::MeshVerdict> judge(const mesh::Printer& printer, const Progress& progress);

  Outbox& outbox_;
  Document document_;
  SceneFeed feed_;
  std::shared_ptr<const PieceList> pieces_;
  std::int64_t pieces_added_ = 0;
  std::optional<DisplayView> view_;
  bool looks_at_all_ = true;   ///< other pieces than the active one may have changed, or the view
  bool is_list_stale_ = true;  ///< pieces_ is not that of the sculpture
  bool is_new_ = false;        ///< the clay has not been shown yet
  bool is_sketched_ = false;   ///< it has been shown, by its coarse levels alone
  std::optional<SlicePlane> plane_;
  bool is_slice_stale_ = false;
  std::optional<Preview> preview_;  ///< of the open stroke, where its tool is large
  bool is_preview_ending_ = false;  ///< the hand is done, the clay is not
  Stroke stroke_;                   ///< the open one, as far as it was applied
  bool is_stamp_ = false;           ///< whether it is listed as a stamp
  int gesture_strokes_ = 0;         ///< steps since the mouse's button went down
  bool skips_next_ = false;         ///< SaveProjectAs::goes_on, and it failed
  std::vector<double> applied_inputs_s_;
  std::optional<LinkHaptics> link_;
  std::optional<ClayWorker> hand_worker_;
  std::uint64_t shown_hand_dabs_ = 0;
  std::chrono::steady_clock::time_point hand_shown_;
  std::optional<LeftQuestion> left_;
  std::shared_ptr<const PrintReport> report_;
  std::shared_ptr<const Stamp> stamp_;
  std::shared_ptr<const Alpha> alpha_;
  std::shared_ptr<const MeshOffer> offer_;
  std::shared_ptr<const StepNames> step_names_;
  std::int64_t named_changes_ = -1;  ///< changes_ when these were made
  Box3 surface_mm_;                  ///< of the active piece
  std::int64_t surface_changes_ = -1;
  PieceKey surface_piece_ = 0;
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
