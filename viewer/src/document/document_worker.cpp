// SPDX-License-Identifier: GPL-3.0-or-later
// One request after the other. Whatever else changes or stores the clay ends the open stroke first,
// so that each step that is recorded stands alone. Nothing here holds a lock: what the window may
// see goes through the outbox.
#include "document/document_worker.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "argil/engine/path_on_clay.h"
#include "argil/io/alpha_file.h"
#include "argil/io/mesh_file.h"

#include "base/text.h"
#include "document/coarse_view.h"
#include "document/scene_distance.h"
#include "document/touch.h"
#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string file_in_quotes(const fs::path& file) { return in_quotes(file.filename().string()); }

bool is_project(const fs::path& file) { return extension_of(file) == ".vdb"; }

}  // namespace

// ---- words to the window -----------------------------------------------------------------------

void DocumentWorker::post(Notice::Kind kind, std::string text) {
  outbox_.post({kind, std::move(text)});
}

void DocumentWorker::complain(const Error& error) { outbox_.post(notice_of(error)); }

void DocumentWorker::post_all(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) post(Notice::Kind::warning, note);
}

void DocumentWorker::post_state() {
  ClayState state;
  state.left = left_;
  state.stamp = stamp_;
  state.alpha = alpha_;
  state.offer = offer_;
  state.dabs = dabs_;
  state.strokes = strokes_;
  state.changes = changes_;
  state.last_dab_ms = last_dab_ms_;
  // Collected without the lock, so that the window never waits for the clay's figures.
  if (document_.has_project()) {
    const Clay& clay = document_.clay();
    state.has_clay = true;
    state.number = clays_;
    state.file = document_.file();
    state.is_untitled = document_.is_untitled();
    state.is_changed = document_.is_changed();
    state.undo_depth = document_.sculpture().undo_depth();
    state.has_older_steps = document_.has_older_steps();
    state.pieces_added = pieces_added_;
    state.steps = step_names();
    state.has_mask = clay.has_mask();
    state.is_stroke_open = clay.is_stroke_open();
    state.bounds_mm = clay.bounds_mm();
    state.surface_mm = surface_of_active();
    state.voxel_mm = clay.options().voxel_mm;
    state.levels = clay.level_stats();
    state.use = clay.use();
    state.display = feed_.active(document_.sculpture()).stats();
    post_pieces(state);
  }
  outbox_.post_state(std::move(state), report_);
}

/// Shared with the states that were posted: made anew when it changes, never altered.
std::shared_ptr<const StepNames> DocumentWorker::step_names() {
  // Copied once a change and not once a frame: a long history has thousands of names.
  if (named_changes_ == changes_) return step_names_;
  auto names = std::make_shared<StepNames>();
  names->names = document_.history().names();
  names->done = document_.history().done();
  names->has_unread = document_.has_unread_steps();
  const auto held = static_cast<std::size_t>(document_.sculpture().undo_depth());
  if (document_.has_older_steps()) names->older = names->done - std::min(names->done, held);
  names->kept = document_.history_size();
  named_changes_ = changes_;
  return step_names_ = std::move(names);
}

// ---- what the window shows ---------------------------------------------------------------------

/// The view for the next update. A clay that has just come is first shown by its coarse levels, in
/// less time than a frame of a large one takes; then as the window sees it, and in that nothing
/// counts as hidden before.
SceneFeed::ViewOf DocumentWorker::view_to_show() {
  const bool was_sketched = std::exchange(is_sketched_, false);
  if (was_sketched) looks_at_all_ = true;
  std::optional<DisplayView> view = view_;
  if (was_sketched && view) view->hysteresis = 0.0;
  return [this, view, is_new = std::exchange(is_new_, false)](const Clay& clay) {
    const auto coarse = is_new ? coarse_view(clay) : std::nullopt;
    if (coarse) is_sketched_ = true;
    return coarse ? coarse : view;
  };
}

void DocumentWorker::show() {
  // A problem of the disk is told once, not with every frame while it lasts.
  if (const auto problem = document_.problem();
      !problem && problem.error().message != told_problem_) {
    told_problem_ = problem.error().message;
    complain(problem.error());
  }
  SceneNews news;
  if (document_.has_project()) {
    const auto start = Clock::now();
    const Sculpture& sculpture = document_.sculpture();
    const auto update = [&] {
      const SceneFeed::ViewOf view = view_to_show();
      return feed_.update(sculpture, view, std::exchange(looks_at_all_, false));
    };
    auto updated = preview_ ? feed_.update(sculpture, *preview_) : update();
    if (updated) {
      news = std::move(updated).value();
    } else {
      complain(updated.error());
      drop_preview();
    }
    if (new_dabs_ > 0) last_dab_ms_ = (edit_ms_ + ms_since(start)) / new_dabs_;
    edit_ms_ = 0.0;
    new_dabs_ = 0;
  } else {
    // No clay: the window drops all blocks that it has.
    news = feed_.drop_all();
  }
  if (!news.empty()) is_slice_stale_ = true;
  outbox_.post_blocks(std::move(news), applied_inputs_s_);
  applied_inputs_s_.clear();
  post_state();
  post_slice();
}

void DocumentWorker::out_of_memory() {
  feed_.restart();
  is_sketched_ = false;
  complain({ErrorKind::memory,
            "not enough memory to show the clay; close other programs, or save and open it again"});
}

void DocumentWorker::cut(const std::optional<SlicePlane>& plane) {
  plane_ = plane;
  is_slice_stale_ = true;
}

/// Some 150 000 distances for the window's 384 x 384: only for a new plane or a clay that changed.
void DocumentWorker::post_slice() {
  if (!is_slice_stale_ || !plane_ || !document_.has_project()) return;
  assert(plane_->columns > 1 && plane_->rows > 1);
  is_slice_stale_ = false;
  const SceneDistance scene(document_.sculpture());
  SlicePicture slice{plane_->corner_mm, plane_->along_mm, plane_->down_mm,
                     plane_->columns,   plane_->rows,     {}};
  slice.distance_mm.reserve(static_cast<std::size_t>(slice.columns) *
                            static_cast<std::size_t>(slice.rows));
  for (int row = 0; row < slice.rows; ++row) {
    const Vec3 start =
        slice.corner_mm + (static_cast<double>(row) / (slice.rows - 1)) * slice.down_mm;
    for (int column = 0; column < slice.columns; ++column) {
      const Vec3 p = start + (static_cast<double>(column) / (slice.columns - 1)) * slice.along_mm;
      slice.distance_mm.push_back(static_cast<float>(scene.at(p)));
    }
  }
  outbox_.post_slice(std::move(slice));
}

std::optional<ScenePick> DocumentWorker::pick_at(const Ray& ray) {
  if (!document_.has_project()) return std::nullopt;
  const Sculpture& sculpture = document_.sculpture();
  if (!preview_) return feed_.pick(sculpture, ray);
  // While a preview is shown the pointer is over it and not over the clay: its field is whole.
  const auto picked = pick(preview_->clay(), unplaced(active_look().placement, ray));
  if (!picked || !picked.value()) return std::nullopt;
  return ScenePick{sculpture.active(), placed(active_look().placement, *picked.value())};
}

PointerAnswer DocumentWorker::answer(const Ray& ray, const std::optional<Touch>& touch) {
  PointerAnswer answer;
  answer.ray = ray;
  if (document_.has_project()) {
    answer.piece = feed_.active_key(document_.sculpture());
    answer.placement = active_look().placement;
  }
  const auto picked = pick_at(ray);
  if (!picked) return answer;
  const Sculpture& sculpture = document_.sculpture();
  if (picked->piece != sculpture.active()) {
    answer.other = sculpture.look(picked->piece).name;
    return answer;
  }
  answer.pick = picked->pick;
  // A preview has no field to feel.
  if (!touch || preview_) return answer;
  const Placement& at = active_look().placement;
  answer.felt =
      feel(sculpture.clay(),
           {unplaced(at, picked->pick.point_mm), turned_back(at, picked->pick.normal)}, *touch);
  if (answer.felt) {
    answer.felt->tool_mm = placed(at, answer.felt->tool_mm);
    answer.felt->force_n = turned(at, answer.felt->force_n);
  }
  return answer;
}

void DocumentWorker::perform(Request request) {
  // The hand's stroke ends before something else is done to the clay, and the clay may be another
  // one after it.
  let_go_of_hand();
  if (!std::exchange(skips_next_, false)) {
    std::visit([this](const auto& wanted) { on(wanted); }, request);
  }
  take_hand();
}

// ---- the hand of a device ----------------------------------------------------------------------

void DocumentWorker::on(const LinkHaptics& link) { link_ = link; }

void DocumentWorker::on(const UnlinkHaptics&) {
  if (link_) link_->heartbeat->alive = false;
  link_.reset();
}

/// Ends the stroke of the hand, and with it the worker, which refers to the clay.
void DocumentWorker::let_go_of_hand() {
  if (!hand_worker_) return;
  if (auto ended = hand_worker_->finish(); !ended) complain(ended.error());
  hand_worker_.reset();
}

/// Makes a worker for the clay as it is now. Its samples wait in the ring meanwhile; what does not
/// fit is dropped there.
void DocumentWorker::take_hand() {
  if (!link_) return;
  link_->heartbeat->alive = document_.has_project();
  assert(!hand_worker_);
  // While the mouse draws a stroke the hand waits: it would end that one as its own.
  if (!document_.has_project() || document_.clay().is_stroke_open()) return;
  // Until the window has started the device anew for the piece that is active now.
  if (!check_is_active(link_->piece)) return;
  ClayWorkerOptions options;
  options.may_begin = [this] { return check_may_be_worked().ok(); };
  options.tool = link_->tool;
  options.style = link_->style;
  options.on_stroke = [this](const Stroke& stroke) {
    ++strokes_;
    ++changes_;
    gesture_strokes_ = 0;  // undo would take this one
    document_.record(stroke);
  };
  hand_worker_.emplace(document_.clay(), options, *link_->ring, *link_->channel);
  shown_hand_dabs_ = 0;
}

bool DocumentWorker::step_hand() {
  if (!hand_worker_) return false;
  link_->heartbeat->beats.fetch_add(1, std::memory_order_relaxed);
  if (auto stepped = hand_worker_->step(); !stepped) complain(stepped.error());
  const std::uint64_t dabs = hand_worker_->counts().dabs;
  // No more often than a screen is drawn: the surface of each dab would take longer than the dab.
  constexpr auto kShowEvery = std::chrono::milliseconds(16);
  if (dabs == shown_hand_dabs_ || Clock::now() - hand_shown_ < kShowEvery) return false;
  dabs_ += static_cast<std::int64_t>(dabs - shown_hand_dabs_);
  new_dabs_ += static_cast<int>(dabs - shown_hand_dabs_);
  shown_hand_dabs_ = dabs;
  hand_shown_ = Clock::now();
  if (is_painted(link_->tool.action)) {
    feed_.active(document_.sculpture()).touch_mask_everywhere();
  }
  return true;
}

// ---- strokes of the mouse ----------------------------------------------------------------------

/// Complains where there is no clay to do something to.
bool DocumentWorker::has_clay(const char* what) {
  if (document_.has_project()) return true;
  complain({ErrorKind::bad_input,
            std::string("there is no clay to ") + what + "; make or open one first"});
  return false;
}

void DocumentWorker::on(const BeginStroke& begin) {
  if (!has_clay("sculpt")) return;
  // One whose dabs the clay still works off, or a clay of which only coarse levels are shown: a
  // preview begins with what is drawn of the clay.
  const bool was_behind = is_behind();
  end_open_stroke();
  // Also where it is refused: Escape takes back nothing of the gesture before.
  if (!begin.goes_on) gesture_strokes_ = 0;
  if (auto may = check_may_be_worked(); !may) return complain(may.error());
  if (was_behind) show();
  is_stamp_ = begin.is_stamp;
  // Without memory for it the clay itself is shown.
  BlockFeed& feed = feed_.active(document_.sculpture());
  if (auto preview = feed.begin_preview(document_.clay(), begin.tool, begin.style)) {
    preview_ = std::move(preview).value();
  }
  if (auto begun = document_.clay().begin_stroke(begin.tool, begin.style); !begun) {
    complain(begun.error());
    drop_preview();
    return;
  }
  // Kept beside the clay, whose own stroke has no samples: the journal records it at its end.
  static_cast<StrokeStyle&>(stroke_) = begin.style;
  stroke_.tool = begin.tool;
  stroke_.samples.clear();
}

void DocumentWorker::on(const ExtendStroke& extend) {
  if (!document_.has_project() || !document_.clay().is_stroke_open() || is_preview_ending_) return;
  const auto start = Clock::now();
  std::vector<StrokeSample> samples;
  samples.reserve(extend.samples.size());
  for (const StrokeSample& sample : extend.samples) {
    samples.push_back(unplaced(active_look().placement, sample));
  }
  if (preview_) {
    if (auto drawn = preview_->extend(samples); !drawn) drop_preview();
  }
  const Result<int> dabs = preview_ ? queue(samples) : document_.clay().extend_stroke(samples);
  // Of a previewed stroke this is the time of the preview, which is what the user waits for.
  edit_ms_ += ms_since(start);
  applied_inputs_s_.push_back(extend.input_s);
  if (!dabs) {
    complain(dabs.error());
    end_open_stroke();
    return;
  }
  stroke_.samples.insert(stroke_.samples.end(), samples.begin(), samples.end());
  dabs_ += dabs.value();
  new_dabs_ += dabs.value();
  if (is_painted(stroke_.tool.action)) note_mask(stroke_);
}

/// Queues dabs behind a preview. Returns how many were added.
Result<int> DocumentWorker::queue(const std::vector<StrokeSample>& samples) {
  const int before = document_.clay().waiting_dabs();
  const auto queued = document_.clay().queue_stroke(samples);
  if (!queued) return queued.error();
  return queued.value() - before;
}

bool DocumentWorker::has_backlog() {
  if (preview_) return is_preview_ending_ || has_dabs_to_work();
  return is_sketched_ || document_.has_unread_steps() || wants_picture();
}

/// What the end of the stroke does anew is not worked before: that would only keep the preview, and
/// then the end, waiting.
bool DocumentWorker::has_dabs_to_work() {
  return !can_be_carried(stroke_.tool.action) && document_.clay().waiting_dabs() > 0;
}

/// The clay itself changes here out of sight: there is something to show only when the stroke is
/// done and the preview goes.
bool DocumentWorker::work_backlog() {
  if (!preview_ && !is_sketched_ && document_.has_unread_steps()) {
    document_.read_steps();
    named_changes_ = -1;
    return true;
  }
  if (!preview_ && !is_sketched_ && wants_picture()) document_.take_picture();
  if (!preview_) return is_sketched_;
  if (has_dabs_to_work()) {
    const auto worked = document_.clay().work_stroke();
    if (worked) return false;
    complain(worked.error());
    end_open_stroke();
    return true;
  }
  if (!is_preview_ending_) return false;
  end_open_stroke();
  return true;
}

void DocumentWorker::drop_preview() {
  if (!preview_) return;
  preview_.reset();
  is_preview_ending_ = false;
  feed_.active(document_.sculpture()).drop_preview();
}

/// Where the last dabs may have painted, images included.
void DocumentWorker::note_mask(const Stroke& stroke) {
  // A step of the spacing before the piece may still have been waiting for it: look a little back.
  constexpr std::size_t kLast = 16;
  Stroke tail = stroke;
  if (tail.samples.size() > kLast) {
    tail.samples.erase(tail.samples.begin(), tail.samples.end() - kLast);
  }
  const double reach =
      1.2 * largest_radius(stroke.tool) + 4.0 * document_.clay().options().voxel_mm;
  for (const Dab& dab : dabs_of(tail)) {
    Box3 box;
    box.include(dab.from.position_mm);
    box.include(dab.at.position_mm);
    box.min -= Vec3{reach, reach, reach};
    box.max += Vec3{reach, reach, reach};
    feed_.active(document_.sculpture()).touch_mask(box);
  }
}

void DocumentWorker::on(const EndStroke&) {
  if (!document_.has_project()) return;
  if (preview_) {
    is_preview_ending_ = true;  // the clay follows
  } else {
    end_open_stroke();
  }
}

/// Ends the stroke that is open, if one is, and records it as a step unless it did nothing.
void DocumentWorker::end_open_stroke() {
  Clay& clay = document_.clay();
  if (!clay.is_stroke_open()) {
    drop_preview();  // of one that was taken back for want of memory
    return;
  }
  const Result<StrokeReport> report = clay.end_stroke();
  assert(!clay.is_stroke_open());
  drop_preview();
  if (!report) {
    complain(report.error());
    return;
  }
  if (report.value().dabs == 0) return;
  ++strokes_;
  ++changes_;
  ++gesture_strokes_;
  document_.record(stroke_, is_stamp_);
}

void DocumentWorker::on(const CancelStroke&) {
  if (!document_.has_project()) return;
  document_.clay().cancel_stroke();
  drop_preview();
  // Strokes before this one of the same gesture were ended when the pointer left the clay.
  for (; gesture_strokes_ > 0; --gesture_strokes_) {
    if (!apply_history(io::HistoryStep::undo)) break;
  }
  // All of it would be sent again: too much for a dab that is dragged, which is taken back again
  // and again.
  if (is_painted(stroke_.tool.action)) {
    feed_.active(document_.sculpture()).touch_mask_everywhere();
  }
}

/// Undo or redo. Where it comes to steps of before the project was opened, they are repeated first,
/// on a second clay: that may be long.
Result<StrokeReport> DocumentWorker::move_in_history(io::HistoryStep move) {
  auto done = io::apply_step(document_.sculpture(), move);
  if (done || !document_.has_older_steps()) return done;
  if (document_.has_unread_steps()) document_.read_steps();
  const StepHistory& history = document_.history();
  const bool may_be_there =
      move == io::HistoryStep::undo || history.done() < history.steps().size();
  if (!may_be_there) return done;
  const Progress progress = outbox_.begin_task("read the history");
  const auto deepened = document_.deepen(progress);
  outbox_.end_task();
  named_changes_ = -1;
  if (!deepened) return deepened.error();
  return io::apply_step(document_.sculpture(), move);
}

/// One undo or redo, recorded; false where the clay refused.
bool DocumentWorker::apply_history(io::HistoryStep move) {
  if (auto done = move_in_history(move); !done) {
    if (done.error().kind != ErrorKind::interrupted) complain(done.error());
    return false;
  }
  document_.record(move);
  ++changes_;
  piece_list_changed();
  return true;
}

/// That there is nothing is no fault, nor that the user stopped it.
void DocumentWorker::complain_about(io::HistoryStep move, const Error& error) {
  if (error.kind == ErrorKind::interrupted) return;
  const bool is_nothing = error.message.starts_with("there is nothing to ");
  if (!is_nothing) return complain(error);
  const bool is_undo = move == io::HistoryStep::undo;
  post(Notice::Kind::warning, is_undo ? "there is nothing to undo" : "there is nothing to redo");
}

void DocumentWorker::on(const DoStep& wanted) {
  if (!has_clay("change")) return;
  end_open_stroke();
  gesture_strokes_ = 0;  // what Escape would undo now is this step
  if (auto may = check_step(wanted); !may) return complain(may.error());
  const auto* move = std::get_if<io::HistoryStep>(&wanted.step);
  const bool is_history = move != nullptr;
  const bool may_mask = may_touch_mask(wanted.step);
  const std::size_t pieces_before = document_.sculpture().piece_count();
  if (is_history) {
    if (auto done = move_in_history(*move); !done) return complain_about(*move, done.error());
  } else {
    const Progress progress = outbox_.begin_task("change the clay");
    const auto done = io::apply_step(document_.sculpture(), wanted.step, progress);
    outbox_.end_task();
    if (!done) {
      if (done.error().kind != ErrorKind::interrupted) complain(done.error());
      return;
    }
  }
  document_.record(wanted.step);
  ++changes_;
  piece_list_changed();
  is_slice_stale_ = true;
  if (const auto* edit = std::get_if<PieceEdit>(&wanted.step)) post_edit(*edit, pieces_before);
  if (may_mask) feed_.touch_masks();
}

/// The bounds are those that the steps before left, which the window may not have seen yet.
void DocumentWorker::on(const TrimPiece& trim) {
  if (!has_clay("trim")) return;
  end_open_stroke();
  if (auto is_active = check_is_active(trim.piece); !is_active) {
    return complain(is_active.error());
  }
  auto combine = combine_of(trim.trim, document_.clay().bounds_mm());
  if (combine) on(DoStep{Operation(std::move(*combine)), trim.piece});
}

void DocumentWorker::on(const GoToStep& wanted) {
  if (!has_clay("change")) return;
  end_open_stroke();
  gesture_strokes_ = 0;
  // By a list that is not whole yet nobody can tell which step is meant.
  if (document_.has_unread_steps()) return;
  // The window may have counted steps that are gone meanwhile.
  const std::size_t most = document_.history().steps().size();
  const std::size_t aim = std::min(wanted.done, most);
  while (document_.history().done() != aim) {
    const io::HistoryStep move =
        document_.history().done() > aim ? io::HistoryStep::undo : io::HistoryStep::redo;
    if (!apply_history(move)) break;
  }
  is_slice_stale_ = true;
  feed_.touch_masks();
}

// ---- files -------------------------------------------------------------------------------------

/// The clay was replaced, or there is none any more: nothing of the old one may be shown.
void DocumentWorker::clay_changed_hands() {
  gesture_strokes_ = 0;
  preview_.reset();
  is_preview_ending_ = false;
  feed_.restart();
  piece_list_changed();
  is_new_ = document_.has_project();
  is_sketched_ = false;
  ++clays_;
  ++changes_;
  report_.reset();
  left_.reset();
  is_slice_stale_ = true;
}

/// The former clay goes only once the new one is made: what fails leaves it open.
void DocumentWorker::on(const NewClay& make) {
  if (document_.has_project()) end_open_stroke();
  outbox_.begin_silent_task("make clay");
  const auto started = document_.start(make.start, make.saves_former);
  outbox_.end_task();
  if (!started) return complain(started.error());
  clay_changed_hands();
}

void DocumentWorker::on(const OpenFile& open) {
  left_.reset();
  if (document_.has_project()) end_open_stroke();
  const bool is_clay = is_project(open.file);
  if (is_clay && asks_about_left_steps(open)) return;
  if (is_clay && open.left == OpenFile::Left::put_aside) {
    auto aside = io::put_left_steps_aside(open.file);
    if (!aside) return complain(aside.error());
    post_all(aside.value());
  }
  // Recovering repeats every step that was left, and importing works out a field: both may be long.
  const Progress progress = outbox_.begin_task(is_clay ? "open" : "import");
  auto opened = is_clay ? document_.open(open.file, open.saves_former, progress)
                        : document_.import(open.file, {}, open.saves_former, progress);
  outbox_.end_task();
  if (!opened) return complain(opened.error());
  clay_changed_hands();
  post_all(opened.value());
  post(Notice::Kind::done, (is_clay ? "opened " : "imported ") + file_in_quotes(open.file));
}

/// The dialog says meanwhile that it is read. What cannot be read is an offer without a file, which
/// closes the dialog. What nobody waits for any more ends at once and is not spoken of.
void DocumentWorker::on(const LookAtMesh& look) {
  if (!outbox_.is_look_wanted(look.number)) return;
  const Progress task = outbox_.begin_task("look at the mesh");
  auto seen = look_at_mesh(look.file, [&](std::string_view stage, double fraction) {
    return task(stage, fraction) && outbox_.is_look_wanted(look.number);
  });
  outbox_.end_task();
  if (!outbox_.is_look_wanted(look.number)) return;
  if (!seen) complain(seen.error());
  MeshOffer offer = seen ? std::move(seen).value() : MeshOffer();
  offer.number = look.number;
  offer_ = std::make_shared<const MeshOffer>(std::move(offer));
}

void DocumentWorker::on(const ImportMesh& wanted) {
  left_.reset();
  if (document_.has_project()) end_open_stroke();
  const Progress progress = outbox_.begin_task("import");
  auto imported = document_.import(wanted.file, wanted.how, wanted.saves_former, progress);
  outbox_.end_task();
  if (!imported) return complain(imported.error());
  clay_changed_hands();
  post_all(imported.value());
  post(Notice::Kind::done, "imported " + file_in_quotes(wanted.file));
}

void DocumentWorker::on(const LoadStamp& load) {
  outbox_.begin_silent_task("read the stamp");
  const auto mesh = io::read_mesh(load.file);
  auto made =
      mesh ? ToolMesh::make(mesh.value()) : Result<std::shared_ptr<const ToolMesh>>(mesh.error());
  outbox_.end_task();
  if (!made) return complain(made.error());
  stamp_ =
      std::make_shared<const Stamp>(Stamp{load.file.filename().string(), std::move(made).value()});
}

void DocumentWorker::on(const LoadAlpha& load) {
  auto image = io::read_alpha(load.file, outbox_.begin_task("read the image"));
  outbox_.end_task();
  if (!image) {
    if (image.error().kind != ErrorKind::interrupted) complain(image.error());
    return;
  }
  alpha_ =
      std::make_shared<const Alpha>(Alpha{load.file.filename().string(), std::move(image).value()});
}

/// A warning only: the path is drawn, so that whoever sees it can tell what is wrong.
void DocumentWorker::on(const CheckPath& check) {
  if (!document_.has_project()) return;
  if (!check_is_active(check.piece)) return;
  const auto on_clay = check_path_on_clay(document_.clay(), check.path_mm);
  if (!on_clay) post(Notice::Kind::warning, on_clay.error().message);
}

void DocumentWorker::on(const SendBlocksAgain&) {
  if (document_.has_project()) end_open_stroke();  // its preview is drawn by the blocks before
  feed_.restart();
}

void DocumentWorker::on(const ForgetHistory&) {
  if (!has_clay("forget the history of")) return;
  end_open_stroke();
  gesture_strokes_ = 0;
  if (auto forgotten = document_.forget_history(); !forgotten) return complain(forgotten.error());
  ++changes_;
  post(Notice::Kind::done, "forgot the history of " + file_in_quotes(document_.file()));
}

void DocumentWorker::on(const SaveProject&) {
  if (!has_clay("save")) return;
  end_open_stroke();
  outbox_.begin_silent_task("save");
  const auto saved = document_.save();
  outbox_.end_task();
  if (!saved) return complain(saved.error());
  named_changes_ = -1;  // what is kept of them has another size
  post(Notice::Kind::done, "saved " + file_in_quotes(document_.file()));
}

void DocumentWorker::on(const SaveProjectAs& save) {
  if (!has_clay("save")) return;
  end_open_stroke();
  outbox_.begin_silent_task("save");
  const auto saved = document_.save_as(save.file);
  outbox_.end_task();
  // Whoever quits or opens another file after saving would lose what could not be saved: the
  // request behind this one is left out.
  skips_next_ = !saved && save.goes_on;
  if (!saved) return complain(saved.error());
  feed_.restart();
  piece_list_changed();
  ++changes_;  // what undo can reach may be less
  post_all(saved.value());
  post(Notice::Kind::done, "saved " + file_in_quotes(save.file));
}

void DocumentWorker::on(const EndProject& end) {
  if (!document_.has_project()) return;
  end_open_stroke();
  outbox_.begin_silent_task(end.saves ? "save" : "close");
  const auto ended = document_.end(end.saves);
  outbox_.end_task();
  if (!ended) return complain(ended.error());
  clay_changed_hands();
}

void DocumentWorker::on(const ExportMesh& wanted) {
  if (!has_clay("export")) return;
  end_open_stroke();
  // A single piece that was placed, coloured or named keeps that where the format can tell it.
  const bool is_together = !document_.sculpture().is_plain() && !wanted.options.parts &&
                           extension_of(wanted.file) == ".3mf";
  if (is_together) return export_pieces(wanted);
  const Progress progress = outbox_.begin_task("export");
  auto exported = io::export_mesh(wanted.file, document_.clay(), wanted.options, progress);
  outbox_.end_task();
  if (!exported) return complain(exported.error());
  // Posted as a new object: the window may still show the former one.
  auto report = std::make_shared<PrintReport>();
  report->changes = changes_;
  report->piece = feed_.active_key(document_.sculpture());
  report->verdict = exported.value().verdict;
  report->exported = std::move(exported).value();
  const bool good = report->verdict.printable;
  report_ = std::move(report);
  std::string how;
  if (document_.sculpture().piece_count() > 1) how += in_quotes(active_look().name) + " alone ";
  if (!are_same(active_look().placement, {})) how += "in its own frame ";
  post(good ? Notice::Kind::done : Notice::Kind::warning,
       "exported " + how + (how.empty() ? "" : "to ") + file_in_quotes(wanted.file) +
           (good ? ": printable" : ": not printable, see Print"));
}

/// A check that fails or is stopped leaves the former report, whose `changes` tell its age.
void DocumentWorker::on(const CheckPrint& check) {
  if (!has_clay("check")) return;
  end_open_stroke();
  const Progress progress = outbox_.begin_task("check");
  auto judged = judge(check.printer, progress);
  outbox_.end_task();
  if (!judged) return complain(judged.error());
  auto report = std::make_shared<PrintReport>();
  report->changes = changes_;
  report->piece = feed_.active_key(document_.sculpture());
  report->verdict = std::move(judged).value();
  report->printer = check.printer.name;
  report_ = std::move(report);
}

}  // namespace argil::viewer
