// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "argil/core/clay_pulse.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/tool_mesh.h"
#include "argil/haptics/tool_force.h"
#include "argil/io/export.h"
#include "argil/io/mesh_check.h"
#include "argil/io/printer.h"
#include "argil/io/session.h"
#include "argil/io/stroke_script.h"

#include "block_news.h"
#include "renderer.h"

namespace argil::viewer {

// What a person asks of the clay. Done in the order given, on the clay's thread.

/// A stroke while the hand makes it. `input_s` is when its input came, for the latency that is
/// measured; of every clock whose times are given back.
struct BeginStroke {
  Tool tool;
  StrokeStyle style;
  bool is_stamp = false;  ///< is called so among the steps
  bool goes_on = false;   ///< the hand never let go since the stroke before, but crossed the air
};
struct ExtendStroke {
  std::vector<StrokeSample> samples;
  double input_s = 0.0;
};
struct EndStroke {};
/// Takes back all since the hand began, also the strokes before this one that it goes on from.
struct CancelStroke {};

/// Undo, redo, an operation on the whole clay or its mask: one step of the journal.
struct DoStep {
  io::ScriptStep step;
};

/// Undo or redo, as often as it takes until so many of ClayState::steps are done.
struct GoToStep {
  std::size_t done = 0;
};

/// Another clay in the place of this one, which is saved, or forgotten since it was saved last,
/// once the other is there.
struct NewClay {
  io::StartShape start;
  bool saves_former = true;
};
/// A project, or a mesh that becomes clay as `argil import` makes it of 256 voxels.
struct OpenFile {
  std::filesystem::path file;
  bool saves_former = true;
  /// What becomes of steps that a killed session left.
  enum class Left { ask, repeat, put_aside } left = Left::ask;
};
/// A closed mesh to be stamped: ClayState::stamp, when it is there.
struct LoadStamp {
  std::filesystem::path file;
};
/// Drops ClayState::left: what lies on the desk stays there.
struct ForgetQuestion {};
/// Removes what a killed window left, for good, and the question about it.
struct DropProject {
  std::filesystem::path file;
};
struct SaveProject {};
struct SaveProjectAs {
  std::filesystem::path file;
  bool goes_on = false;  ///< the next command is only meant for what was saved
};
/// Ends the session: with its steps saved, or forgotten.
struct EndProject {
  bool saves = true;
};

struct ExportMesh {
  std::filesystem::path file;
  io::ExportOptions options;
};
struct CheckPrint {
  io::Printer printer;
};

/// The hand of a device works the clay as well: its samples come out of the ring, windows to feel
/// go into the channel. All must live until UnlinkHaptics was done.
struct LinkHaptics {
  ToolSampleRing* ring = nullptr;
  WindowChannel* channel = nullptr;
  ClayPulse* pulse = nullptr;
  Tool tool;
  StrokeStyle style;
};
struct UnlinkHaptics {};

using Command =
    std::variant<BeginStroke, ExtendStroke, EndStroke, CancelStroke, DoStep, GoToStep, NewClay,
                 OpenFile, ForgetQuestion, DropProject, LoadStamp, SaveProject, SaveProjectAs,
                 EndProject, ExportMesh, CheckPrint, LinkHaptics, UnlinkHaptics>;

/// A sentence for the person.
struct Notice {
  enum class Kind { done, warning, error } kind = Kind::done;
  std::string text;
  ErrorKind error = ErrorKind::internal;  ///< of Kind::error
};
inline Notice notice_of(const Error& error) {
  return {Notice::Kind::error, error.message, error.kind};
}

/// A project waits for a word: a session that was killed left steps beside it, or it has no name
/// and steps beside it that were put aside.
struct LeftQuestion {
  OpenFile asked;      ///< to be sent again, with a word
  io::LeftSteps left;  ///< no steps where they were put aside
};

/// The steps that undo and redo can reach, by name, oldest first.
struct StepNames {
  std::vector<std::string> names;
  std::size_t done = 0;  ///< of them; the others were taken back
};

/// A mesh to stamp with.
struct Stamp {
  std::string name;
  std::shared_ptr<const ToolMesh> mesh;
};

/// What is known of the clay; a copy.
struct ClayState {
  bool has_clay = false;
  std::int64_t number = 0;     ///< another for each clay; the same after it was saved elsewhere
  std::filesystem::path file;  ///< the project
  bool is_untitled = false;    ///< kept in the workshop's own folder until it is saved
  bool is_changed = false;     ///< since it was saved
  int undo_depth = 0;
  std::shared_ptr<const StepNames> steps;  ///< null without clay
  bool has_mask = false;
  bool is_stroke_open = false;
  Box3 bounds_mm;
  double voxel_mm = 0.0;
  std::vector<LevelStats> levels;
  ClayUse use;
  DisplayStats display;
  std::int64_t dabs = 0;     ///< so far, of all strokes
  std::int64_t strokes = 0;  ///< so far
  std::int64_t changes = 0;  ///< so far: strokes, steps, another clay
  double last_dab_ms = 0.0;  ///< with its surface, wall time
  std::optional<LeftQuestion> left;
  std::shared_ptr<const Stamp> stamp;  ///< the last one that was loaded; null: none
};

/// The verdict on the last CheckPrint or ExportMesh.
struct PrintReport {
  io::MeshVerdict verdict;
  std::optional<io::ExportReport> exported;
  std::string printer;
  std::int64_t changes = 0;  ///< ClayState::changes when it was judged
};

/// Long work on its way.
struct Task {
  bool is_running = false;
  bool has_progress = false;  ///< tells how far it is, and can be stopped
  std::string name;
  double fraction = 0.0;
};

/// All that makes two materials different.
inline std::array<double, 6> numbers_of(const haptics::ForceMaterial& material) noexcept {
  return {material.surface_force_n, material.exponent,          material.skin_mm,
          material.clamp_ratio,     material.viscosity_force_n, material.viscosity_s_per_mm};
}

struct WorkshopOptions {
  std::filesystem::path home;  ///< a folder for what has no name yet
};

/// The clay's side of the window: a thread that owns the clay and its session, does what it is
/// told in order, and answers with blocks to draw and states to show. Nothing here waits for it.
///
/// Threads  all but the constructor and the destructor: any thread, usually the window's.
class Workshop {
 public:
  explicit Workshop(WorkshopOptions options);
  /// Ends the thread; an open session leaves its journal, as after a kill.
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  void send(Command command);

  /// The newest view counts; blocks follow it soon.
  void look(const DisplayView& view);

  /// A tool that is held still, pressed so deep into the clay where the ray meets it. Its place is
  /// not asked for.
  struct Touch {
    haptics::ForceTool tool;
    haptics::ForceMaterial material;
    double press_mm = 0.0;
    friend bool operator==(const Touch& a, const Touch& b) {
      return a.tool.shape == b.tool.shape && a.tool.radii_mm == b.tool.radii_mm &&
             a.press_mm == b.press_mm && numbers_of(a.material) == numbers_of(b.material);
    }
  };
  /// What the clay pushes it with.
  struct Felt {
    Vec3 tool_mm;  ///< its centre
    double radius_mm = 0.0;
    Vec3 force_n;
  };
  /// Where a ray meets the clay, and what would be felt there: the newest question counts.
  void ask(const Ray& ray, const std::optional<Touch>& touch = {});
  struct Answer {
    Ray ray;
    std::optional<Pick> pick;
    std::optional<Felt> felt;
  };
  std::optional<Answer> answer() const;

  /// What a slice through the clay shows; nothing when a plane was never asked for.
  struct SlicePlane {
    Vec3 corner_mm, along_mm, down_mm;
    int columns = 0;
    int rows = 0;
    friend bool operator==(const SlicePlane&, const SlicePlane&) = default;
  };
  void cut(const std::optional<SlicePlane>& plane);
  /// The newest slice, once.
  std::optional<SlicePicture> take_slice();

  /// What a renderer has to take, once; with the input times whose dabs it shows.
  BlockNews take_blocks(std::vector<double>& shown_inputs_s);
  std::vector<Notice> take_notices();
  ClayState state() const;
  std::shared_ptr<const PrintReport> report() const;

  Task task() const;
  void cancel_task() noexcept { cancels_ = true; }

  /// All that was sent is done and taken.
  bool is_idle() const;

 private:
  friend class Bench;  // the thread's own
  void run();

  WorkshopOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Command> commands_;
  bool is_ending_ = false;
  bool is_busy_ = false;
  bool has_backlog_ = false;
  std::optional<DisplayView> view_;
  bool has_new_view_ = false;
  struct Question {
    Ray ray;
    std::optional<Touch> touch;
  };
  std::optional<Question> question_;
  std::optional<Answer> answer_;
  std::optional<SlicePlane> plane_;
  bool has_new_plane_ = false;
  std::optional<SlicePicture> slice_;
  BlockNews news_;
  std::vector<double> shown_inputs_s_;
  std::vector<Notice> notices_;
  ClayState state_;
  std::shared_ptr<const PrintReport> report_;
  Task task_;
  std::atomic<bool> cancels_{false};
  std::thread thread_;
};

}  // namespace argil::viewer
