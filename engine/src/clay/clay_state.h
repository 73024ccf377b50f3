// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <vector>

#include "argil/engine/clay.h"

#include "edit/edit.h"
#include "edit/history.h"
#include "edit/redistance.h"
#include "field/leaf_change.h"
#include "field/level_stack.h"

namespace argil {

/// A stroke between its begin and its end.
struct OpenStroke {
  Tool tool;
  DabFeeder feeder;
  UndoStep step;
  UndoStep images;  ///< what making its images alike changes, until that stands
  StrokeReport report;
  std::vector<Dab> waiting;  ///< queued, not applied yet
  std::vector<Dab> path;     ///< all dabs of an anchored action
  bool is_carried = false;   ///< the clay was carried along with the pieces of that path
  MaskStep mask_step;        ///< of actions that paint the mask, and then `step` stays empty
  RedistanceQueue redistance_queue;

  /// Of what it keeps, about.
  std::int64_t bytes() const noexcept {
    constexpr std::size_t kEntry = sizeof(UndoStep::value_type) + 64;
    const std::size_t leaves =
        (kEntry + sizeof(LeafValues)) * (step.size() + images.size() + mask_step.size());
    return static_cast<std::int64_t>(leaves + sizeof(Dab) * (waiting.size() + path.size()));
  }
};

class LatticeSymmetry;

struct Clay::State {
  State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options);

  double tolerance_mm() const { return options.tolerance_voxels * options.voxel_mm; }

  void log_change(const LeafChange& change);

  /// Puts the leaves of a step back; `exchange` also makes it, or returns, the step that undoes
  /// that. exchange(UndoStep&) does all or, when it throws bad_alloc, nothing.
  void restore(const UndoStep& step);
  void exchange(UndoStep& step);
  void restore(const MaskStep& step);
  MaskStep exchange(const MaskStep& step);

  /// Clay without a stroke yet becomes symmetric to the bit across each of the three planes across
  /// which it is so within its tolerance.
  void make_symmetric();

  /// Replaces all levels and returns the former. Whoever keeps something derived from the clay must
  /// see another one: it gets a new identity.
  FormerLevels replace_levels(FormerLevels by);

  /// Applies the inverse of an entry and returns what undoes that.
  UndoEntry swap_back(UndoEntry& entry);

  /// Writes go to the levels and the log of changes; what was there before, to `step`.
  EditTarget target_into(UndoStep& step);

  /// Also forgets what no longer fits.
  void push_undo(UndoEntry entry);

  /// What an edit may still take.
  std::int64_t free_bytes() const;

  /// Runs an edit that is one undo step: `edit` writes to the target, and `step` holds the leaves
  /// as they were, so far. On an error, or when it throws, all is as it was. Returns how many
  /// leaves changed.
  Result<std::int64_t> run(
      const std::function<Result<void>(EditTarget& target, const UndoStep& step)>& edit);

  /// The parts of a stroke, once their input was found good. `apply_dabs` false: `progress` asked
  /// to stop. All may throw bad_alloc with the stroke half done: take_back() then.
  void open_stroke(const Tool& tool, const StrokeStyle& style);
  /// The first that waits with its images; of an anchored action all that wait.
  void apply_next_dab();
  void apply_waiting_dabs();
  bool apply_dabs(const std::vector<Dab>& dabs, const Progress& progress);
  /// Those of an anchored action, which are the whole stroke.
  bool apply_whole_path(const std::vector<Dab>& dabs, const Progress& progress);
  StrokeReport close_stroke();
  void take_back();

  ClayOptions options;
  std::unique_ptr<LevelStack> levels;
  std::optional<OpenStroke> open;
  History history;
  ClayLimits limits;
  std::uint64_t identity = 0;
  std::uint64_t forgotten = 0;  ///< changes no longer in the log
  std::vector<LeafChange> changes;
  std::atomic<std::thread::id> user{};  ///< the thread within a call that changes the clay

 private:
  EditTarget target_of_open_stroke();
  StrokeReport close_mask_stroke();
  /// At the end of a stroke. The symmetry is that of its style, or the part that is left.
  StrokeSymmetry match_images();
  StrokeSymmetry match_images(const LatticeSymmetry& symmetry);
  bool symmetrise_stroke(const LatticeSymmetry& symmetry);
  bool breaks_an_invariant(UndoStep& step);
  void extend_path(const std::vector<Dab>& dabs);
  void finish_path();
  void apply_path_anew();
  EditMemory memory;
};

/// A call that changes a clay: asserts that no other thread is within one.
class ChangingCall {
 public:
  /// `user`: of the clay's state.
  explicit ChangingCall(std::atomic<std::thread::id>& user) noexcept
      : user_(user), outer_(user.exchange(std::this_thread::get_id())) {
    assert(outer_ == std::thread::id() || outer_ == std::this_thread::get_id());
  }
  ~ChangingCall() { user_.store(outer_); }
  ChangingCall(const ChangingCall&) = delete;
  ChangingCall& operator=(const ChangingCall&) = delete;

 private:
  std::atomic<std::thread::id>& user_;
  std::thread::id outer_;  ///< of the call that this one is part of
};

Error stroke_is_open();

/// The error when there is no memory to do `what`, or when the clay's limit allows none.
Error out_of_memory(const char* what);
Error out_of_memory(const std::bad_alloc& fault, const char* what);

}  // namespace argil
