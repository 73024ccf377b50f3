// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "argil/io/clay_check.h"
#include "argil/io/mesh_file.h"

#include "feel.h"
#include "file_ending.h"
#include "in_quotes.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string file_in_quotes(const fs::path& file) { return in_quotes(file.filename().string()); }

bool is_project(const fs::path& file) { return ending_of(file) == ".vdb"; }

}  // namespace

// ---- words to the window -----------------------------------------------------------------------

void Bench::post(Notice::Kind kind, std::string text) {
  const std::lock_guard held(shop_.mutex_);
  shop_.notices_.push_back({kind, std::move(text)});
}

void Bench::complain(const Error& error) {
  const std::lock_guard held(shop_.mutex_);
  shop_.notices_.push_back(notice_of(error));
}

void Bench::post_all(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) post(Notice::Kind::warning, note);
}

Progress Bench::begin_task(const char* name) {
  shop_.cancels_ = false;
  const std::lock_guard held(shop_.mutex_);
  shop_.task_ = {true, true, name, 0.0};
  return [this, name](std::string_view stage, double fraction) {
    const std::lock_guard locked(shop_.mutex_);
    shop_.task_ = {true, true, stage.empty() ? name : std::string(stage), fraction};
    return !shop_.cancels_ && !shop_.is_ending_;
  };
}

void Bench::begin_silent_task(const char* name) {
  const std::lock_guard held(shop_.mutex_);
  shop_.task_ = {true, false, name, 0.0};
}

void Bench::end_task() {
  const std::lock_guard held(shop_.mutex_);
  shop_.task_ = {};
}

void Bench::post_state() {
  ClayState state;
  state.left = left_;
  state.stamp = stamp_;
  state.dabs = dabs_;
  state.strokes = strokes_;
  state.changes = changes_;
  state.last_dab_ms = last_dab_ms_;
  if (desk_.has_project()) {
    const Clay& clay = desk_.clay();
    state.has_clay = true;
    state.number = clays_;
    state.file = desk_.file();
    state.is_untitled = desk_.is_untitled();
    state.is_changed = desk_.is_changed();
    state.undo_depth = clay.undo_depth();
    state.steps = step_names();
    state.has_mask = clay.has_mask();
    state.is_stroke_open = clay.is_stroke_open();
    state.bounds_mm = clay.bounds_mm();
    state.voxel_mm = clay.options().voxel_mm;
    state.levels = clay.level_stats();
    state.use = clay.use();
    state.display = feed_.stats();
  }
  const std::lock_guard held(shop_.mutex_);
  shop_.state_ = std::move(state);
  shop_.report_ = report_;
}

std::shared_ptr<const StepNames> Bench::step_names() {
  if (named_changes_ == changes_) return step_names_;
  auto names = std::make_shared<StepNames>();
  names->names = desk_.history().names();
  names->done = desk_.history().done();
  named_changes_ = changes_;
  return step_names_ = std::move(names);
}

// ---- what the window shows ---------------------------------------------------------------------

void Bench::show() {
  if (const auto problem = desk_.problem(); !problem && problem.error().message != told_problem_) {
    told_problem_ = problem.error().message;
    complain(problem.error());
  }
  BlockNews news;
  if (desk_.has_project()) {
    const auto start = Clock::now();
    auto updated =
        sketch_ ? feed_.update(desk_.clay(), *sketch_) : feed_.update(desk_.clay(), view_);
    if (updated) {
      news = std::move(updated).value();
    } else {
      complain(updated.error());
      drop_sketch();
    }
    if (new_dabs_ > 0) last_dab_ms_ = (edit_ms_ + ms_since(start)) / new_dabs_;
    edit_ms_ = 0.0;
    new_dabs_ = 0;
  } else {
    news.is_fresh = true;
  }
  if (!news.empty()) is_slice_stale_ = true;
  {
    const std::lock_guard held(shop_.mutex_);
    shop_.news_.append(std::move(news));
    shop_.shown_inputs_s_.insert(shop_.shown_inputs_s_.end(), applied_inputs_s_.begin(),
                                 applied_inputs_s_.end());
  }
  applied_inputs_s_.clear();
  post_state();
  post_slice();
}

void Bench::out_of_memory() {
  feed_.restart();
  complain({ErrorKind::memory,
            "not enough memory to show the clay; close other programs, or save and open it again"});
}

void Bench::cut(const std::optional<Workshop::SlicePlane>& plane) {
  plane_ = plane;
  is_slice_stale_ = true;
}

void Bench::post_slice() {
  if (!is_slice_stale_ || !plane_ || !desk_.has_project()) return;
  is_slice_stale_ = false;
  const Clay& clay = desk_.clay();
  SlicePicture slice{
      plane_->corner_mm, plane_->along_mm, plane_->down_mm, plane_->columns, plane_->rows, {}, 1.0};
  slice.skin_mm = kHalfWidthVoxels * clay.level_stats().back().voxel_mm;
  slice.distance_mm.reserve(static_cast<std::size_t>(slice.columns) *
                            static_cast<std::size_t>(slice.rows));
  for (int row = 0; row < slice.rows; ++row) {
    const Vec3 start =
        slice.corner_mm + (static_cast<double>(row) / (slice.rows - 1)) * slice.down_mm;
    for (int column = 0; column < slice.columns; ++column) {
      const Vec3 p = start + (static_cast<double>(column) / (slice.columns - 1)) * slice.along_mm;
      slice.distance_mm.push_back(static_cast<float>(clay.distance_at(p)));
    }
  }
  const std::lock_guard held(shop_.mutex_);
  shop_.slice_ = std::move(slice);
}

std::optional<Pick> Bench::pick_at(const Ray& ray) {
  if (!desk_.has_project()) return std::nullopt;
  const auto picked = pick(sketch_ ? sketch_->clay() : desk_.clay(), ray);
  return picked ? picked.value() : std::nullopt;
}

Workshop::Answer Bench::answer(const Ray& ray, const std::optional<Workshop::Touch>& touch) {
  Workshop::Answer answer{ray, pick_at(ray), {}};
  // A sketch has no field to feel.
  if (answer.pick && touch && !sketch_) {
    answer.felt = feel(desk_.clay(), {answer.pick->point_mm, answer.pick->normal}, *touch);
  }
  return answer;
}

void Bench::perform(Command command) {
  // The hand's stroke ends before something else is done to the clay, and the clay may be another
  // one after it.
  let_go_of_hand();
  if (!std::exchange(skips_next_, false)) {
    std::visit([this](const auto& wanted) { on(wanted); }, command);
  }
  take_hand();
}

// ---- the hand of a device ----------------------------------------------------------------------

void Bench::on(const LinkHaptics& link) { link_ = link; }

void Bench::on(const UnlinkHaptics&) {
  if (link_) link_->pulse->alive = false;
  link_.reset();
}

void Bench::let_go_of_hand() {
  if (!worker_) return;
  if (auto ended = worker_->finish(); !ended) complain(ended.error());
  worker_.reset();
}

void Bench::take_hand() {
  if (!link_) return;
  link_->pulse->alive = desk_.has_project();
  // While the mouse draws a stroke the hand waits: it would end that one as its own.
  if (!desk_.has_project() || desk_.clay().is_stroke_open()) return;
  ClayWorkerOptions options;
  options.tool = link_->tool;
  options.style = link_->style;
  options.on_stroke = [this](const Stroke& stroke) {
    ++strokes_;
    ++changes_;
    gesture_strokes_ = 0;  // undo would take this one
    desk_.record(stroke);
  };
  worker_.emplace(desk_.clay(), options, *link_->ring, *link_->channel);
  shown_hand_dabs_ = 0;
}

bool Bench::step_hand() {
  if (!worker_) return false;
  link_->pulse->beats.fetch_add(1, std::memory_order_relaxed);
  if (auto stepped = worker_->step(); !stepped) complain(stepped.error());
  const std::uint64_t dabs = worker_->counts().dabs;
  constexpr auto kShowEvery = std::chrono::milliseconds(16);
  if (dabs == shown_hand_dabs_ || Clock::now() - hand_shown_ < kShowEvery) return false;
  dabs_ += static_cast<std::int64_t>(dabs - shown_hand_dabs_);
  new_dabs_ += static_cast<int>(dabs - shown_hand_dabs_);
  shown_hand_dabs_ = dabs;
  hand_shown_ = Clock::now();
  if (link_->tool.action == Action::mask) feed_.touch_mask_everywhere();
  return true;
}

// ---- strokes of the mouse ----------------------------------------------------------------------

bool Bench::has_clay(const char* what) {
  if (desk_.has_project()) return true;
  complain({ErrorKind::bad_input,
            std::string("there is no clay to ") + what + "; make or open one first"});
  return false;
}

void Bench::on(const BeginStroke& begin) {
  if (!has_clay("sculpt")) return;
  end_open_stroke();  // one whose dabs the clay still works off
  if (!begin.goes_on) gesture_strokes_ = 0;
  is_stamp_ = begin.is_stamp;
  // Without memory for it the clay itself is shown.
  if (auto sketch = Sketch::begin(desk_.clay(), begin.tool, begin.style)) {
    sketch_ = std::move(sketch).value();
  }
  if (auto begun = desk_.clay().begin_stroke(begin.tool, begin.style); !begun) {
    complain(begun.error());
    drop_sketch();
    return;
  }
  static_cast<StrokeStyle&>(stroke_) = begin.style;
  stroke_.tool = begin.tool;
  stroke_.samples.clear();
}

void Bench::on(const ExtendStroke& extend) {
  if (!desk_.has_project() || !desk_.clay().is_stroke_open() || is_sketch_ending_) return;
  const auto start = Clock::now();
  if (sketch_) {
    if (auto drawn = sketch_->extend(extend.samples); !drawn) drop_sketch();
  }
  const Result<int> dabs =
      sketch_ ? queue(extend.samples) : desk_.clay().extend_stroke(extend.samples);
  edit_ms_ += ms_since(start);
  applied_inputs_s_.push_back(extend.input_s);
  if (!dabs) {
    complain(dabs.error());
    end_open_stroke();
    return;
  }
  stroke_.samples.insert(stroke_.samples.end(), extend.samples.begin(), extend.samples.end());
  dabs_ += dabs.value();
  new_dabs_ += dabs.value();
  if (stroke_.tool.action == Action::mask) note_mask(stroke_);
}

/// As many dabs as it made wait.
Result<int> Bench::queue(const std::vector<StrokeSample>& samples) {
  const int before = desk_.clay().waiting_dabs();
  const auto queued = desk_.clay().queue_stroke(samples);
  if (!queued) return queued.error();
  return queued.value() - before;
}

bool Bench::work_backlog() {
  if (!sketch_) return false;
  Clay& clay = desk_.clay();
  if (clay.waiting_dabs() > 0) {
    if (auto worked = clay.work_stroke(); worked) return false;
    end_open_stroke();  // says what is wrong
    return true;
  }
  if (!is_sketch_ending_) return false;
  end_open_stroke();
  return true;
}

void Bench::drop_sketch() {
  if (!sketch_) return;
  sketch_.reset();
  is_sketch_ending_ = false;
  feed_.drop_sketch();
}

/// Where the last dabs may have painted, images included.
void Bench::note_mask(const Stroke& stroke) {
  // A step of the spacing before the piece may still have been waiting for it: look a little back.
  constexpr std::size_t kLast = 16;
  Stroke tail = stroke;
  if (tail.samples.size() > kLast) {
    tail.samples.erase(tail.samples.begin(), tail.samples.end() - kLast);
  }
  const double reach = 1.2 * largest_radius(stroke.tool) + 4.0 * desk_.clay().options().voxel_mm;
  for (const Dab& dab : dabs_of(tail)) {
    Box3 box;
    box.include(dab.from.position_mm);
    box.include(dab.at.position_mm);
    box.min -= Vec3{reach, reach, reach};
    box.max += Vec3{reach, reach, reach};
    feed_.touch_mask(box);
  }
}

void Bench::on(const EndStroke&) {
  if (!desk_.has_project()) return;
  if (sketch_) {
    is_sketch_ending_ = true;  // the clay follows
  } else {
    end_open_stroke();
  }
}

void Bench::end_open_stroke() {
  Clay& clay = desk_.clay();
  if (!clay.is_stroke_open()) return;
  const Result<StrokeReport> report = clay.end_stroke();
  drop_sketch();
  if (!report) {
    complain(report.error());
    return;
  }
  if (report.value().dabs == 0) return;
  ++strokes_;
  ++changes_;
  ++gesture_strokes_;
  desk_.record(stroke_, is_stamp_);
}

void Bench::on(const CancelStroke&) {
  if (!desk_.has_project()) return;
  desk_.clay().cancel_stroke();
  drop_sketch();
  for (; gesture_strokes_ > 0; --gesture_strokes_) {
    if (!apply_history(io::HistoryStep::undo)) break;
  }
  feed_.touch_mask_everywhere();
}

bool Bench::apply_history(io::HistoryStep move) {
  if (auto done = io::apply_step(desk_.clay(), move); !done) {
    complain(done.error());
    return false;
  }
  desk_.record(move);
  ++changes_;
  return true;
}

void Bench::on(const DoStep& wanted) {
  if (!has_clay("change")) return;
  end_open_stroke();
  const auto* move = std::get_if<io::HistoryStep>(&wanted.step);
  const bool is_history = move != nullptr;
  const Progress progress = is_history ? Progress() : begin_task("change the clay");
  const auto done = io::apply_step(desk_.clay(), wanted.step, progress);
  if (!is_history) end_task();
  if (!done) {
    if (is_history) {
      const bool is_undo = *move == io::HistoryStep::undo;
      post(Notice::Kind::warning,
           is_undo ? "there is nothing to undo" : "there is nothing to redo");
    } else if (done.error().kind != ErrorKind::interrupted) {
      complain(done.error());
    }
    return;
  }
  desk_.record(wanted.step);
  ++changes_;
  feed_.touch_mask_everywhere();
}

void Bench::on(const GoToStep& wanted) {
  if (!has_clay("change")) return;
  end_open_stroke();
  const std::size_t most = desk_.history().steps().size();
  const std::size_t aim = std::min(wanted.done, most);
  while (desk_.history().done() != aim) {
    const io::HistoryStep move =
        desk_.history().done() > aim ? io::HistoryStep::undo : io::HistoryStep::redo;
    if (!apply_history(move)) break;
  }
  feed_.touch_mask_everywhere();
}

// ---- files -------------------------------------------------------------------------------------

void Bench::clay_changed_hands() {
  sketch_.reset();
  is_sketch_ending_ = false;
  feed_.restart();
  ++clays_;
  ++changes_;
  report_.reset();
  left_.reset();
  is_slice_stale_ = true;
}

void Bench::on(const NewClay& make) {
  if (desk_.has_project()) end_open_stroke();
  begin_silent_task("make clay");
  const auto started = desk_.start(make.start, make.saves_former);
  end_task();
  if (!started) return complain(started.error());
  clay_changed_hands();
}

/// True when a person has to say first what becomes of left steps.
bool Bench::asks_about_left_steps(const OpenFile& open) {
  if (open.left != OpenFile::Left::ask) return false;
  if (io::is_in_session(open.file)) return false;  // these are nobody's left steps
  // Looking for them reads the whole project.
  std::error_code error;
  if (!fs::exists(journal_of(open.file), error)) {
    if (!desk_.is_without_name(open.file) || !has_steps_aside(open.file)) return false;
    const auto written = fs::last_write_time(open.file, error);
    left_ = LeftQuestion{open, {0, std::chrono::file_clock::to_sys(written)}};
    return true;
  }
  const auto found = io::left_steps(open.file);
  if (!found || !found.value()) return false;  // opening says what is wrong
  left_ = LeftQuestion{open, *found.value()};
  return true;
}

void Bench::on(const OpenFile& open) {
  left_.reset();
  if (desk_.has_project()) end_open_stroke();
  const bool is_clay = is_project(open.file);
  if (is_clay && asks_about_left_steps(open)) return;
  if (is_clay && open.left == OpenFile::Left::put_aside) {
    auto aside = io::put_left_steps_aside(open.file);
    if (!aside) return complain(aside.error());
    post_all(aside.value());
  }
  const Progress progress = begin_task(is_clay ? "open" : "import");
  auto opened = is_clay ? desk_.open(open.file, open.saves_former, progress)
                        : desk_.import(open.file, open.saves_former, progress);
  end_task();
  if (!opened) return complain(opened.error());
  clay_changed_hands();
  post_all(opened.value());
  post(Notice::Kind::done, (is_clay ? "opened " : "imported ") + file_in_quotes(open.file));
}

void Bench::on(const DropProject& drop) {
  left_.reset();
  begin_silent_task("throw away");
  const auto removed = io::remove_project(drop.file);
  end_task();
  if (!removed) return complain(removed.error());
  post(Notice::Kind::done, "threw away " + file_in_quotes(drop.file));
}

void Bench::on(const LoadStamp& load) {
  begin_silent_task("read the stamp");
  const auto mesh = io::read_mesh(load.file);
  auto made =
      mesh ? ToolMesh::make(mesh.value()) : Result<std::shared_ptr<const ToolMesh>>(mesh.error());
  end_task();
  if (!made) return complain(made.error());
  stamp_ =
      std::make_shared<const Stamp>(Stamp{load.file.filename().string(), std::move(made).value()});
}

void Bench::on(const SaveProject&) {
  if (!has_clay("save")) return;
  end_open_stroke();
  begin_silent_task("save");
  const auto saved = desk_.save();
  end_task();
  if (!saved) return complain(saved.error());
  post(Notice::Kind::done, "saved " + file_in_quotes(desk_.file()));
}

void Bench::on(const SaveProjectAs& save) {
  if (!has_clay("save")) return;
  end_open_stroke();
  begin_silent_task("save");
  const auto saved = desk_.save_as(save.file);
  end_task();
  skips_next_ = !saved && save.goes_on;
  if (!saved) return complain(saved.error());
  feed_.restart();
  ++changes_;  // what undo can reach may be less
  post_all(saved.value());
  post(Notice::Kind::done, "saved " + file_in_quotes(save.file));
}

void Bench::on(const EndProject& end) {
  if (!desk_.has_project()) return;
  end_open_stroke();
  begin_silent_task(end.saves ? "save" : "close");
  const auto ended = desk_.end(end.saves);
  end_task();
  if (!ended) return complain(ended.error());
  clay_changed_hands();
}

void Bench::on(const ExportMesh& wanted) {
  if (!has_clay("export")) return;
  end_open_stroke();
  const Progress progress = begin_task("export");
  auto exported = io::export_mesh(wanted.file, desk_.clay(), wanted.options, progress);
  end_task();
  if (!exported) return complain(exported.error());
  auto report = std::make_shared<PrintReport>();
  report->changes = changes_;
  report->verdict = exported.value().verdict;
  report->exported = std::move(exported).value();
  const bool good = report->verdict.printable;
  report_ = std::move(report);
  post(good ? Notice::Kind::done : Notice::Kind::warning,
       "exported " + file_in_quotes(wanted.file) +
           (good ? ": printable" : ": not printable, see Print"));
}

void Bench::on(const CheckPrint& check) {
  if (!has_clay("check")) return;
  end_open_stroke();
  const Progress progress = begin_task("check");
  auto judged = io::check_clay(desk_.clay(), check.printer, progress);
  end_task();
  if (!judged) return complain(judged.error());
  auto report = std::make_shared<PrintReport>();
  report->changes = changes_;
  report->verdict = std::move(judged.value().verdict);
  report->printer = check.printer.name;
  report_ = std::move(report);
}

}  // namespace argil::viewer
