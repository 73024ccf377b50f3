// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/io/session.h"
#include "argil/io/stroke_script.h"
#include "argil/mesh/close.h"

#include "document/mesh_offer.h"
#include "document/project_pictures.h"
#include "document/step_history.h"

namespace argil::viewer {

/// The project that is open: at most one, always in a session, so that nothing finished is lost.
/// One that has no name yet lies in the home folder as `unsaved/Untitled-N.vdb` until it is saved.
///
/// Threads  the document thread.
class Document {
 public:
  /// Pictures of what is saved are kept there, and of work that is not, from time to time; without
  /// places none are.
  explicit Document(std::filesystem::path home, PicturePlaces places = {})
      : home_(std::move(home)), pictures_(std::move(places)) {}

  bool has_project() const noexcept { return session_.has_value(); }
  /// Where has_project().
  Sculpture& sculpture() {
    assert(has_project());
    return session_->sculpture();
  }
  /// Of its active piece.
  Clay& clay() { return sculpture().clay(); }
  const std::filesystem::path& file() const noexcept { return file_; }
  bool is_untitled() const noexcept { return is_untitled_; }
  /// Whether a project is one that has no name yet, of this window or a killed one.
  bool is_without_name(const std::filesystem::path& project) const;
  /// Whether it differs from what was saved, opened or made: undo and redo lead back to that. What
  /// is found nowhere else, an import or what a killed window left without a name, is changed until
  /// it has a name.
  bool is_changed() const;
  /// A step that was just applied to the clay.
  void record(const io::ScriptStep& step, bool is_stamp = false);
  /// What undo and redo can reach, as far as it was read.
  const StepHistory& history() const noexcept { return history_; }

  // Steps of before the project was opened, which its journal kept.

  /// Whether they are not in history() yet. It takes a moment that nobody shall wait for who wants
  /// to see the clay.
  bool has_unread_steps() const noexcept { return has_unread_steps_; }
  void read_steps();
  /// Whether undo or redo can reach them after deepen(), as Session::deepen.
  bool has_older_steps() const noexcept { return session_ && session_->has_older_steps(); }
  Result<void> deepen(const Progress& progress);
  /// Where has_project().
  io::HistorySize history_size() const { return session_->history_size(); }
  /// Errors  as Session::forget_history; bad_input for what has changes that are not saved.
  Result<void> forget_history();

  // Pictures of the project, for lists of files and for who asks what a killed window left.

  /// From where they show it, from now on.
  void look_from(const DisplayView& view) noexcept { view_ = view; }
  /// Whether steps that are not saved are to be pictured now: of the first one at once, then a few
  /// times a minute. Not while a stroke is open.
  bool wants_picture();
  void take_picture();
  /// Of a project that is gone.
  void forget_picture(const std::filesystem::path& project) { pictures_.forget_work(project); }

  /// What the disk last refused: of the session, or of the clean-up behind the one before.
  Result<void> problem() const;

  // Each ends the project that is open once the new one is there: saved, or as it was saved last.
  // What has changes and no name yet is not left to be saved (bad_input), nor what cannot be
  // (disk). Errors change nothing.

  /// Errors  as Clay::ball, Clay::block, Session::create.
  Result<void> start(const io::StartShape& shape, bool saves_former);

  /// A project, its left steps repeated. Errors  as Session::open; bad_input for the one that
  /// is open.
  Result<std::vector<std::string>> open(const std::filesystem::path& project, bool saves_former,
                                        const Progress& progress);

  /// A mesh as clay, or its parts as pieces. What was mended comes back as sentences.
  /// Errors  as read_prepared_mesh, read_prepared_parts, import_mesh.
  Result<std::vector<std::string>> import(const std::filesystem::path& mesh, const MeshImport& how,
                                          bool saves_former, const Progress& progress);

  /// Writes the file also where it was removed meanwhile.
  /// Errors  disk; bad_input for a project that has no name yet.
  Result<void> save();

  /// Over a file that is there, too. The project goes on under the new name, with all that can be
  /// undone and redone; the old one is left as it was saved last, one without a name removed. What
  /// the user should know comes back as sentences.
  /// Errors  as Session::save_as; bad_input in the folder of what has no name: nothing was changed.
  Result<std::vector<std::string>> save_as(const std::filesystem::path& file);

  /// Ends the session: saved, or as it was when it was opened or saved last.
  Result<void> end(bool saves);

 private:
  Result<void> may_leave(bool saves) const;
  bool is_among_untitled(const std::filesystem::path& file) const;
  Result<void> take(io::Session session, std::filesystem::path file, bool is_untitled, bool saves);
  Result<void> start_untitled(Sculpture sculpture, bool saves_former);
  void keep_reachable();
  void note_saved();
  std::size_t unsaved_steps() const;
  std::optional<PictureShot> shot_before_end();
  void picture_saved();

  std::filesystem::path home_;
  ProjectPictures pictures_;  ///< outlives the session, whose journal is whole before it waits
  std::optional<io::Session> session_;
  StepHistory history_;
  std::filesystem::path file_;
  bool is_untitled_ = false;
  bool is_only_here_ = false;  ///< work that no project with a name has
  bool has_unread_steps_ = false;
  std::size_t saved_steps_ = 0;               ///< of the session's, in the file
  std::optional<std::uint64_t> saved_state_;  ///< of history_, in the file; nothing: none of it
  std::optional<DisplayView> view_;
  std::size_t pictured_steps_ = 0;  ///< of unsaved_steps()
  std::chrono::steady_clock::time_point next_picture_;
  Result<void> left_behind_;  ///< whether what was left without saving could be cleaned up
};

/// Where the steps of a session with a project are kept (docs/files.md, "A session").
std::filesystem::path journal_of(std::filesystem::path project);

/// Whether steps that were put aside lie beside a project: without it they would be of no use.
bool has_steps_aside(const std::filesystem::path& project);

/// The projects without a name that a killed window left in the home folder, newest first.
std::vector<std::filesystem::path> left_untitled(const std::filesystem::path& home);

/// What was done to close a mesh before it became clay, in sentences.
std::vector<std::string> closing_notes(const mesh::CloseReport& closing);

/// Where a user's files of Argil are kept: $XDG_DATA_HOME/argil, else ~/.local/share/argil, else a
/// folder for temporary files.
std::filesystem::path usual_home();

}  // namespace argil::viewer
