// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/document.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "argil/engine/import.h"
#include "argil/io/prepared_mesh.h"
#include "argil/io/project_file.h"

#include "base/text.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

/// Also where the folder is there already.
Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return Error{ErrorKind::disk, "cannot make the folder " + in_quotes(folder.string()) + " (" +
                                    error.message() + "); name another with --home"};
}

/// Whether the window itself gave a file its name: only those may be removed unsaved.
bool has_untitled_name(const fs::path& file) {
  return file.extension() == ".vdb" && file.filename().string().starts_with("Untitled-");
}

/// The first name that no project has, nor another window is just giving to one.
fs::path free_untitled(const fs::path& folder) {
  for (int n = 1;; ++n) {
    fs::path file = folder / ("Untitled-" + std::to_string(n) + ".vdb");
    std::error_code error;
    if (!fs::exists(file, error) && !io::is_in_session(file)) return file;
  }
}

/// Also where one of them does not exist, and through symbolic links.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

Result<Clay> clay_of(const io::StartShape& shape) {
  if (shape.kind == io::StartShape::Kind::ball) return Clay::ball(shape.size_mm.x, shape.options);
  return Clay::block(shape.size_mm, shape.options);
}

/// Undo goes on after a project was closed.
const io::SessionOptions kSessionOptions{.keeps_history = true};

/// Ends a session without saving: under its name it is what was saved there last; what has no name
/// goes, with whatever was recovered for it.
Result<void> leave(io::Session session, const fs::path& file, bool is_untitled) {
  if (!is_untitled || has_steps_aside(file)) return session.discard();
  if (auto closed = session.close(); !closed) return closed;
  return io::remove_project(file);
}

/// Of work that is not saved: at least so long between two pictures, and so many times as long as
/// the last copy took, for which the hand may have had to wait.
constexpr std::chrono::seconds kPictureEvery(15);
constexpr int kPictureShare = 500;

void add_count(std::int64_t n, const char* what, std::vector<std::string>& notes) {
  if (n > 0) notes.push_back(std::to_string(n) + " " + what);
}

/// What was repaired on import, in sentences.
std::vector<std::string> told(const mesh::CloseReport& closing, const ImportReport& import) {
  std::vector<std::string> notes = closing_notes(closing);
  if (import.winding_bridged) notes.emplace_back("open gaps of the mesh were bridged");
  add_count(import.lost_vertices, "vertices on tips or sheets thinner than two voxels were lost",
            notes);
  return notes;
}

/// What a mesh became.
struct Imported {
  Sculpture sculpture;
  std::vector<std::string> notes;
};

double voxel_for(const MeshImport& how, double largest_side_mm) {
  return how.voxel_mm > 0.0 ? how.voxel_mm : largest_side_mm / io::kUsualResolution;
}

/// Guesses about a frame are told where nobody has chosen one.
void add_doubts(const fs::path& mesh, io::FrameReport frame, const MeshImport& how,
                std::vector<std::string>& notes) {
  if (how.preparation.size_mm > 0.0) frame.unit_looks_like.reset();
  for (std::string& doubt : io::frame_doubts(mesh, frame)) notes.push_back(std::move(doubt));
}

Result<Imported> clay_of(const fs::path& mesh, const MeshImport& how, const Progress& progress) {
  const auto prepared = io::read_prepared_mesh(mesh, how.preparation);
  if (!prepared) return prepared.error();
  ClayOptions options;
  options.voxel_mm = voxel_for(how, prepared.value().largest_side_mm);
  auto imported = import_mesh(prepared.value().mesh, options, progress);
  if (!imported) return imported.error();
  auto notes = told(prepared.value().closing, imported.value().report);
  add_doubts(mesh, prepared.value().frame, how, notes);
  return Imported{Sculpture(std::move(imported.value().clay)), std::move(notes)};
}

Result<Imported> pieces_of(const fs::path& mesh, const MeshImport& how, const Progress& progress) {
  const auto prepared = io::read_prepared_parts(mesh, how.preparation);
  if (!prepared) return prepared.error();
  const std::vector<std::string> names = io::piece_names(prepared.value().names);
  ClayOptions options;
  options.voxel_mm = voxel_for(how, prepared.value().largest_side_mm);
  std::vector<Sculpture::ReadyPiece> pieces;
  std::vector<std::string> notes;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const io::PreparedMesh& part = prepared.value().parts[n];
    auto imported = import_mesh(part.mesh, options, progress);
    if (!imported) {
      return Error{imported.error().kind, in_quotes(names[n]) + ": " + imported.error().message};
    }
    for (const std::string& note : told(part.closing, imported.value().report)) {
      notes.push_back(in_quotes(names[n]) + ": " + note);
    }
    pieces.push_back({{.name = names[n]}, std::move(imported.value().clay)});
  }
  add_doubts(mesh, prepared.value().frame, how, notes);
  auto sculpture = Sculpture::of(std::move(pieces), 0);
  if (!sculpture) return sculpture.error();
  return Imported{std::move(sculpture).value(), std::move(notes)};
}

}  // namespace

std::vector<std::string> closing_notes(const mesh::CloseReport& closing) {
  std::vector<std::string> notes;
  add_count(closing.holes_closed, "holes of the mesh were closed", notes);
  add_count(closing.parts_flipped, "parts of the mesh were turned to face outward", notes);
  return notes;
}

fs::path usual_home() {
  // Called before any thread is started, and nothing changes the environment.
  const char* data = std::getenv("XDG_DATA_HOME");  // NOLINT(concurrency-mt-unsafe)
  const char* home = std::getenv("HOME");           // NOLINT(concurrency-mt-unsafe)
  if (data != nullptr && *data != '\0') return fs::path(data) / "argil";
  if (home != nullptr && *home != '\0') return fs::path(home) / ".local" / "share" / "argil";
  std::error_code error;
  return fs::temp_directory_path(error) / "argil";
}

fs::path journal_of(fs::path project) { return project.replace_extension(".journal.jsonl"); }

bool has_steps_aside(const fs::path& project) {
  const std::string front = journal_of(project).filename().string() + ".left-";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(project.parent_path(), error)) {
    if (entry.path().filename().string().starts_with(front)) return true;
  }
  return false;
}

std::vector<fs::path> left_untitled(const fs::path& home) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(home / "unsaved", error)) {
    const fs::path& file = entry.path();
    if (has_untitled_name(file)) found.push_back(file);
  }
  // A file that was removed meanwhile counts as the oldest.
  const auto age = [](const fs::path& file) {
    std::error_code ignored;
    return fs::last_write_time(file, ignored);
  };
  std::sort(found.begin(), found.end(),
            [&](const fs::path& a, const fs::path& b) { return age(a) > age(b); });
  return found;
}

void Document::record(const io::ScriptStep& step, bool is_stamp) {
  session_->record(step);
  history_.record(step, is_stamp);
  if (session_->has_older_steps()) return;
  history_.keep(static_cast<std::size_t>(sculpture().undo_depth()), history_.steps().size());
}

/// Which piece is at hand is no change of the work, though the file says it.
bool Document::is_changed() const {
  return session_ && (is_only_here_ || saved_state_ != history_.state());
}

void Document::note_saved() {
  saved_steps_ = session_->step_count();
  saved_state_ = history_.state();
}

/// Of the session's, that the file has not.
std::size_t Document::unsaved_steps() const {
  assert(session_ && saved_steps_ <= session_->step_count());
  return session_->step_count() - saved_steps_;
}

bool Document::wants_picture() {
  if (!session_ || !pictures_.are_kept() || clay().is_stroke_open()) return false;
  const std::size_t steps = unsaved_steps();
  return steps > 0 && steps != pictured_steps_ && std::chrono::steady_clock::now() >= next_picture_;
}

void Document::take_picture() {
  assert(has_project());
  using Clock = std::chrono::steady_clock;
  pictured_steps_ = unsaved_steps();
  const Clock::time_point begin = Clock::now();
  if (auto shot = shoot(sculpture(), view_)) {
    pictures_.keep_work(file_, *std::move(shot), pictured_steps_);
  }
  const Clock::time_point end = Clock::now();
  next_picture_ = end + std::max<Clock::duration>(kPictureEvery, kPictureShare * (end - begin));
}

/// Of what is on the disk under file_ now.
void Document::picture_saved() {
  pictured_steps_ = 0;
  if (!pictures_.are_kept()) return;
  pictures_.forget_work(file_);
  if (auto shot = shoot(sculpture(), view_)) pictures_.keep_saved(file_, *std::move(shot));
}

/// Of what the end of the session saves, or has saved without a picture.
std::optional<PictureShot> Document::shot_before_end() {
  if (!pictures_.are_kept()) return std::nullopt;
  if (unsaved_steps() == 0 && pictures_.has_saved(file_)) return std::nullopt;
  return shoot(sculpture(), view_);
}

/// What can be reached no more, from here or after deepen(), leaves the list.
void Document::keep_reachable() {
  if (session_->has_older_steps()) return;
  history_.keep(static_cast<std::size_t>(sculpture().undo_depth()),
                static_cast<std::size_t>(sculpture().redo_depth()));
}

/// By the journal, from the first step; none where it cannot be read.
void Document::read_steps() {
  has_unread_steps_ = false;
  const bool is_as_saved = !is_changed();
  const auto told = session_->told_steps();
  if (!told) return;
  history_.clear();
  saved_state_.reset();
  for (std::size_t n = 0; n <= told.value().size(); ++n) {
    if (n == saved_steps_) saved_state_ = history_.state();
    if (n < told.value().size()) history_.record(told.value()[n]);
  }
  if (is_as_saved) saved_state_ = history_.state();
  keep_reachable();
}

Result<void> Document::deepen(const Progress& progress) {
  assert(has_project());
  if (has_unread_steps_) read_steps();
  auto deepened = session_->deepen(progress);
  keep_reachable();
  return deepened;
}

Result<void> Document::forget_history() {
  assert(has_project());
  if (is_changed()) {
    return Error{ErrorKind::bad_input,
                 "the project has changes that are not saved; save it before its history goes"};
  }
  if (auto forgotten = session_->forget_history(); !forgotten) return forgotten;
  history_.clear();
  has_unread_steps_ = false;
  note_saved();
  return {};
}

/// Asked before the new document is made, which may take long.
Result<void> Document::may_leave(bool saves) const {
  if (!saves || !is_untitled_ || !is_changed()) return {};
  return Error{ErrorKind::bad_input, "the project has no name yet; save it under one"};
}

Result<void> Document::problem() const {
  if (!left_behind_) return left_behind_;
  return session_ ? session_->problem() : Result<void>();
}

/// Whether it lies in the folder of what has no name yet.
bool Document::is_among_untitled(const fs::path& file) const {
  std::error_code error;
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  return fs::equivalent(folder, home_ / "unsaved", error) && !error;
}

bool Document::is_without_name(const fs::path& project) const {
  return has_untitled_name(project) && is_among_untitled(project);
}

/// Puts a session in place of the one that is open. The order matters: the former is ended first,
/// and where that fails the new one goes and the former stays.
Result<void> Document::take(io::Session session, fs::path file, bool is_untitled, bool saves) {
  assert(!file.empty());
  if (auto ended = end(saves); !ended) {
    // As if it had never been made or opened. What the disk refuses now it has just reported.
    static_cast<void>(session.discard().ok());
    return ended;
  }
  session_.emplace(std::move(session));
  history_.clear();
  file_ = std::move(file);
  // Of work that is here now, or was put aside.
  pictures_.forget_work(file_);
  pictured_steps_ = 0;
  next_picture_ = {};
  is_untitled_ = is_untitled;
  is_only_here_ = false;
  note_saved();
  // Recovered steps are not in the file, so they count as changes.
  saved_steps_ -= static_cast<std::size_t>(session_->recovered_steps());
  if (session_->recovered_steps() > 0) saved_state_.reset();
  has_unread_steps_ = session_->step_count() > 0;
  return {};
}

Result<void> Document::start_untitled(Sculpture sculpture, bool saves_former) {
  const fs::path folder = home_ / "unsaved";
  if (auto made = make_folder(folder); !made) return made;
  const fs::path file = free_untitled(folder);
  auto session = io::Session::create(file, std::move(sculpture), kSessionOptions);
  if (!session) return session.error();
  return take(std::move(session).value(), file, true, saves_former);
}

Result<void> Document::start(const io::StartShape& shape, bool saves_former) {
  if (auto may = may_leave(saves_former); !may) return may;
  auto clay = clay_of(shape);
  if (!clay) return clay.error();
  return start_untitled(Sculpture(std::move(clay).value()), saves_former);
}

Result<std::vector<std::string>> Document::open(const fs::path& project, bool saves_former,
                                                const Progress& progress) {
  if (auto may = may_leave(saves_former); !may) return may.error();
  if (session_ && is_same_file(project, file_)) {
    return Error{ErrorKind::bad_input, in_quotes(project.string()) +
                                           " is open in this window already; undo goes back to "
                                           "what it was"};
  }
  auto session = io::Session::open(project, kSessionOptions, progress);
  if (!session) return session.error();
  const bool is_untitled = is_without_name(project);
  std::vector<std::string> notes = session.value().notes();
  auto taken = take(std::move(session).value(), project, is_untitled, saves_former);
  if (!taken) return taken.error();
  is_only_here_ = is_untitled;
  // What was recovered shall be seen at once; what was kept can wait.
  if (session_->recovered_steps() > 0) read_steps();
  return notes;
}

Result<std::vector<std::string>> Document::import(const fs::path& mesh, const MeshImport& how,
                                                  bool saves_former, const Progress& progress) {
  if (auto may = may_leave(saves_former); !may) return may.error();
  auto made = how.keeps_parts ? pieces_of(mesh, how, progress) : clay_of(mesh, how, progress);
  if (!made) return made.error();
  if (auto started = start_untitled(std::move(made.value().sculpture), saves_former); !started) {
    return started.error();
  }
  is_only_here_ = true;
  return std::move(made.value().notes);
}

Result<void> Document::save() {
  assert(has_project());
  if (is_untitled_) {
    return Error{ErrorKind::bad_input, "the project has no name yet; save it under one"};
  }
  // A session that knows of no change writes nothing, and needs the file that was there.
  std::error_code error;
  if (!fs::exists(file_, error)) {
    if (auto written = io::save_sculpture(file_, sculpture()); !written) return written;
  }
  if (auto saved = session_->save(); !saved) return saved;
  note_saved();
  picture_saved();
  return {};
}

Result<std::vector<std::string>> Document::save_as(const fs::path& file) {
  assert(has_project());
  if (is_among_untitled(file)) {
    return Error{
        ErrorKind::bad_input,
        in_quotes(file.string()) + " would lie among what has no name yet; choose another folder"};
  }
  if (is_same_file(file, file_)) {
    if (auto saved = save(); !saved) return saved.error();
    return std::vector<std::string>();
  }
  auto saved = session_->save_as(file);
  if (!saved) return saved.error();
  // The session of the new file may have had to start without the steps of before.
  if (!saved.value().keeps_undo) history_.clear();
  left_behind_ = {};
  if (is_untitled_ && !has_steps_aside(file_)) left_behind_ = io::remove_project(file_);
  pictures_.forget_work(file_);
  file_ = file;
  is_untitled_ = false;
  is_only_here_ = false;
  note_saved();
  picture_saved();
  return std::move(saved).value().notes;
}

Result<void> Document::end(bool saves) {
  if (!session_) return {};
  if (auto may = may_leave(saves); !may) return may;
  left_behind_ = {};
  // Without saving a named project stays as it was saved last, and one without a name is removed.
  if (saves && !is_untitled_) {
    auto shot = shot_before_end();
    if (auto closed = session_->close(); !closed) return closed;
    if (shot) pictures_.keep_saved(file_, *std::move(shot));
  } else {
    left_behind_ = leave(std::move(*session_), file_, is_untitled_);
  }
  pictures_.forget_work(file_);
  session_.reset();
  history_.clear();
  file_.clear();
  is_untitled_ = false;
  is_only_here_ = false;
  has_unread_steps_ = false;
  saved_steps_ = 0;
  saved_state_.reset();
  return {};
}

}  // namespace argil::viewer
