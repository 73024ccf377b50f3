// SPDX-License-Identifier: GPL-3.0-or-later
// What the document thread does with pieces: their list, and printing all of them. Where they
// stand: worker_stand.cpp.
#include <algorithm>
#include <cassert>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "argil/engine/surface.h"
#include "argil/io/clay_check.h"
#include "argil/io/piece_export.h"
#include "argil/io/prepared_mesh.h"
#include "argil/mesh/check.h"

#include "base/text.h"
#include "document/document_worker.h"
#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

/// The names of pieces whose clay an edit changes or takes in.
std::vector<std::string> worked_pieces(const PieceEdit& edit) {
  if (const auto* merge = std::get_if<MergePiece>(&edit)) return {merge->name, merge->other};
  if (const auto* scale = std::get_if<ScalePiece>(&edit)) return {scale->name};
  if (const auto* split = std::get_if<SplitPiece>(&edit)) return {split->name};
  return {};
}

}  // namespace

/// Of the active piece.
const PieceLook& DocumentWorker::active_look() {
  const Sculpture& sculpture = document_.sculpture();
  return sculpture.look(sculpture.active());
}

/// Errors  bad_input: the active piece is locked, or nobody would see what is done to it.
Result<void> DocumentWorker::check_may_be_worked() {
  if (auto free = document_.sculpture().check_unlocked(); !free) return free;
  if (active_look().is_visible) return {};
  return Error{ErrorKind::bad_input, "the piece " + in_quotes(active_look().name) +
                                         " is hidden; show it, or choose another"};
}

/// Errors  bad_input: another piece is the active one by now.
Result<void> DocumentWorker::check_is_active(std::optional<PieceKey> piece) {
  if (!piece || feed_.active_key(document_.sculpture()) == *piece) return {};
  return Error{ErrorKind::bad_input, "this was meant for another piece than " +
                                         in_quotes(active_look().name) +
                                         ", which is the one that is worked now; do it again"};
}

/// Errors  bad_input: it was meant for another piece, or nobody would see what it does.
Result<void> DocumentWorker::check_step(const DoStep& wanted) {
  if (std::holds_alternative<io::HistoryStep>(wanted.step)) return {};
  const Sculpture& sculpture = document_.sculpture();
  if (const auto* edit = std::get_if<PieceEdit>(&wanted.step)) {
    for (const std::string& name : worked_pieces(*edit)) {
      const auto at = sculpture.find(name);
      if (!at || sculpture.look(*at).is_visible) continue;  // that there is none is said later
      return Error{ErrorKind::bad_input,
                   "the piece " + in_quotes(name) + " is hidden; show it before it is " +
                       (std::holds_alternative<MergePiece>(*edit) ? "merged" : "changed")};
    }
    return {};
  }
  if (auto is_active = check_is_active(wanted.piece); !is_active) return is_active;
  return check_may_be_worked();
}

// ---- the list ----------------------------------------------------------------------------------

/// The list is made anew when a step may have changed it, and then shared; of the active piece,
/// which strokes change, the bounds are in the state itself.
void DocumentWorker::post_pieces(ClayState& state) {
  const Sculpture& sculpture = document_.sculpture();
  if (std::exchange(is_list_stale_, false) || !pieces_) {
    auto list = std::make_shared<PieceList>();
    list->active = sculpture.active();
    for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
      const Clay& clay = sculpture.clay(n);
      list->pieces.push_back({feed_.key_of(sculpture, n), sculpture.look(n), clay.bounds_mm()});
    }
    pieces_ = std::move(list);
  }
  state.pieces = pieces_;
  const auto include = [&](bool is_wanted, std::size_t n) {
    const PieceState& piece = pieces_->pieces[n];
    const Box3& own = n == pieces_->active ? state.bounds_mm : piece.bounds_mm;
    const Box3 box = placed(piece.look.placement, own);
    if (!is_wanted || box.empty()) return;
    state.all_bounds_mm.include(box.min);
    state.all_bounds_mm.include(box.max);
  };
  for (std::size_t n = 0; n < pieces_->pieces.size(); ++n) {
    include(pieces_->pieces[n].look.is_visible, n);
  }
  // Where nothing is seen there is still something to look at.
  if (state.all_bounds_mm.empty()) include(true, pieces_->active);
}

/// Whether a step may change a mask: blocks whose mask may differ are sent again.
bool DocumentWorker::may_touch_mask(const io::ScriptStep& step) const {
  if (const auto* move = std::get_if<io::HistoryStep>(&step)) {
    const StepHistory& history = document_.history();
    const bool is_undo = *move == io::HistoryStep::undo;
    const std::size_t at = history.done() - (is_undo ? 1 : 0);
    // One that the list does not know may be anything.
    return at >= history.steps().size() || may_touch_mask(history.steps()[at]);
  }
  const auto* edit = std::get_if<PieceEdit>(&step);
  return edit == nullptr || std::holds_alternative<MergePiece>(*edit) ||
         std::holds_alternative<ScalePiece>(*edit) || std::holds_alternative<SplitPiece>(*edit);
}

void DocumentWorker::on(const SelectPieceAt& wanted) {
  if (!document_.has_project()) return;
  end_open_stroke();
  const auto picked = pick_at(wanted.ray);
  const Sculpture& sculpture = document_.sculpture();
  if (!picked || picked->piece == sculpture.active()) return;
  on(DoStep{PieceEdit{SelectPiece{sculpture.look(picked->piece).name}}});
}

/// How many there are now, of a piece that was split; or which one is gone: the window may have
/// chosen it.
void DocumentWorker::post_edit(const PieceEdit& edit, std::size_t pieces_before) {
  if (const auto* split = std::get_if<SplitPiece>(&edit)) {
    const std::size_t more = document_.sculpture().piece_count() - pieces_before;
    post(Notice::Kind::done, in_quotes(split->name) + " is " + std::to_string(more + 1) +
                                 " pieces now; crumbs stayed with the largest");
  }
  const auto* merge = std::get_if<MergePiece>(&edit);
  if (merge == nullptr || merge->keeps_other) return;
  post(Notice::Kind::done, in_quotes(merge->other) + " was combined with " +
                               in_quotes(merge->name) + " and is gone; undo brings it back");
}

/// The window looks at all pieces once there is one more.
void DocumentWorker::add_piece(const AddPiece& add) {
  const std::size_t before = document_.sculpture().piece_count();
  on(DoStep{PieceEdit{add}});
  if (document_.sculpture().piece_count() > before) ++pieces_added_;
}

void DocumentWorker::on(const AddBallPiece&) {
  if (!has_clay("add a piece to")) return;
  end_open_stroke();
  constexpr double kPart = 1.0 / 6.0;  // its radius, of the largest side of what is there
  constexpr double kLeastVoxels = 8.0;
  ClayState state;
  state.bounds_mm = document_.clay().bounds_mm();
  post_pieces(state);
  const Box3& all = state.all_bounds_mm;
  const ClayOptions& options = document_.clay().options();
  const double side = std::max({all.size().x, all.size().y, all.size().z});
  const double radius = std::max(kPart * side, kLeastVoxels * options.voxel_mm);
  auto ball = Clay::ball(radius, options);
  if (!ball) return complain(ball.error());
  AddPiece add;
  add.look.name = document_.sculpture().free_name("Ball");
  add.look.placement.position_mm = {all.max.x + 1.1 * radius, all.center().y, all.min.z + radius};
  add.clay = std::make_shared<const Clay>(std::move(ball).value());
  add_piece(add);
}

void DocumentWorker::on(const ImportPiece& import) {
  if (!has_clay("add a piece to")) return;
  end_open_stroke();
  outbox_.begin_silent_task("read the mesh");
  auto prepared = io::read_prepared_mesh(import.file);
  outbox_.end_task();
  if (!prepared) return complain(prepared.error());
  post_all(io::frame_doubts(import.file, prepared.value().frame));
  post_all(closing_notes(prepared.value().closing));
  AddPiece add;
  // A file may be called what no piece can.
  const std::string name = io::piece_names({import.file.stem().string()}).front();
  add.look.name = document_.sculpture().free_name(name);
  add.voxel_mm = prepared.value().largest_side_mm / io::kUsualResolution;
  add.mesh = std::make_shared<const TriangleMesh>(std::move(prepared.value().mesh));
  add_piece(add);
}

void DocumentWorker::on(const DuplicatePiece&) {
  if (!has_clay("duplicate")) return;
  end_open_stroke();
  const std::string& name = active_look().name;
  on(DoStep{PieceEdit{CopyPiece{name, document_.sculpture().free_name(name)}}});
}

// ---- printing ----------------------------------------------------------------------------------

/// The visible pieces as named parts of one file, each measured and judged by itself.
void DocumentWorker::export_pieces(const ExportMesh& wanted) {
  const Progress progress = outbox_.begin_task("export");
  auto exported = io::export_pieces(wanted.file, document_.sculpture(), wanted.options, progress);
  outbox_.end_task();
  if (!exported) return complain(exported.error());
  const std::vector<io::PieceExport>& parts = exported.value();
  auto report = std::make_shared<PrintReport>();
  report->changes = changes_;
  std::string bad;
  for (const io::PieceExport& part : parts) {
    if (!part.report.verdict.printable) bad += (bad.empty() ? "" : ", ") + in_quotes(part.name);
  }
  // The panel shows one: the active piece's, where it is among them.
  const auto own = std::find_if(parts.begin(), parts.end(), [this](const io::PieceExport& part) {
    return part.name == active_look().name;
  });
  const io::PieceExport& shown = own == parts.end() ? parts.front() : *own;
  const auto at = document_.sculpture().find(shown.name);
  assert(at);
  report->piece = feed_.key_of(document_.sculpture(), *at);
  report->verdict = shown.report.verdict;
  report->exported = shown.report;
  report_ = std::move(report);
  const std::string count =
      parts.size() > 1 ? std::to_string(parts.size()) + " pieces, " : std::string();
  const std::string what = "exported " + in_quotes(wanted.file.filename().string()) + ": " + count;
  if (bad.empty()) return post(Notice::Kind::done, what + "printable");
  post(Notice::Kind::warning, what + "not printable: " + bad);
}

/// Of the active piece as it stands, with problems in its own frame. One that is turned leans
/// elsewhere than its clay does: its mesh is judged, whose walls are measured between triangles.
Result<mesh::MeshVerdict> DocumentWorker::judge(const mesh::Printer& printer,
                                                const Progress& progress) {
  const Placement at = active_look().placement;
  if (at.orientation == Quat{}) {
    auto judged = io::check_clay(document_.clay(), printer, progress);
    if (!judged) return judged.error();
    return std::move(judged.value().verdict);
  }
  auto surface = extract_surface(document_.clay(), progress);
  if (!surface) return surface.error();
  place(at, surface.value());
  auto judged = mesh::check_print(surface.value(), printer, 0, progress);
  if (!judged) return judged.error();
  for (mesh::MeshProblem& problem : judged.value().problems) {
    problem.at_mm = unplaced(at, problem.at_mm);
  }
  return judged;
}

}  // namespace argil::viewer
