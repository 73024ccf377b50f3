// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay_options.h"
#include "argil/engine/operation.h"
#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"

namespace argil {

class LevelStack;   // private to the engine
struct ClayAccess;  // private to the engine

/// What one level holds.
struct LevelStats {
  int level = 0;  ///< 0 is the finest
  double voxel_mm = 0.0;
  std::int64_t active_voxels = 0;
  std::int64_t leaves = 0;
  std::int64_t bytes = 0;
};

/// What the images of a stroke are to each other when it ends (docs/actions.md).
enum class StrokeSymmetry {
  none,     ///< there are none, or no lattice is their image
  exact,    ///< the same in every bit
  unlike,   ///< each its own: the clay or its mask was not symmetric there before
  withheld  ///< the same within the tolerance: in every bit would have broken an invariant
};

struct StrokeReport {
  int dabs = 0;
  int level = 0;  ///< the level the tool was written at
  StrokeSymmetry symmetry = StrokeSymmetry::none;
  /// Thread CPU time per dab, in order; of dabs that are one edit (DabFeeder) each its share.
  std::vector<double> dab_cpu_ms;
};

/// What a clay may take of the machine's memory. Changed at any time; takes effect with the next
/// edit.
struct ClayLimits {
  /// What undo and redo may hold; when it is passed the oldest steps are forgotten, the last one
  /// never. 0 or more.
  std::int64_t undo_bytes = std::int64_t{1} << 30;

  /// Levels, undo and the edit at hand together. An edit that would pass it is refused (memory) and
  /// the clay stays as it was. 0: three quarters of the machine's memory, or of what its control
  /// group allows.
  std::int64_t memory_bytes = 0;
};

/// What it takes.
struct ClayUse {
  std::int64_t level_bytes = 0;      ///< leaves of all levels
  std::int64_t undo_bytes = 0;       ///< steps to undo and redo
  std::int64_t steps_forgotten = 0;  ///< undo steps given up so far to stay within undo_bytes
  std::int64_t mask_bytes = 0;       ///< of the mask
  std::int64_t free_bytes = 0;       ///< what the next edit may take
};

/// The sculpture: nested narrow-band level sets, level 0 the finest, h_L = h_0 * 2^L.
///
/// Threads  one thread owns a Clay; nothing here may be called from another meanwhile. Inside,
///          work is spread with TBB. Same input, same bits, for any number of threads.
/// Errors   a failed call leaves the clay as it was.
class Clay {
 public:
  /// A ball, or a block with sharp edges, about the origin; stored no finer than its shape needs.
  /// Errors  bad_input for sizes or options out of range; memory when it would not fit.
  static Result<Clay> ball(double radius_mm, const ClayOptions& options);
  static Result<Clay> block(const Vec3& size_mm, const ClayOptions& options);

  /// Clay from a formula: the signed distance in mm, negative inside, of a surface that lies within
  /// `bounds_mm`. Every band is the formula's own value, but for nodes with finer ones around them,
  /// which hold the average that forces read. Where the formula is not a distance (its slope is
  /// not 1), neither is the clay. What is its own mirror image across a plane through the origin,
  /// within the tolerance, becomes so to the bit.
  ///
  /// Units    mm; each side of bounds_mm at least 8 voxels, no coordinate beyond kMaxNode - 64
  ///          voxels or kMaxReachMm.
  /// Errors   bad_input for options or bounds out of range, no formula, or a formula that gives a
  ///          value that is not finite; memory when it would not fit.
  /// Threads  `distance_mm` is called from several threads at once and must not throw.
  /// Cost     the formula at up to 56^3 nodes of the coarsest level, then about 5000 times for each
  ///          leaf that is kept.
  static Result<Clay> from_distance(const std::function<double(const Vec3&)>& distance_mm,
                                    const Box3& bounds_mm, const ClayOptions& options);

  Clay(Clay&&) noexcept;
  Clay& operator=(Clay&&) noexcept;
  ~Clay();

  const ClayOptions& options() const noexcept;
  int level_count() const noexcept;
  std::vector<LevelStats> level_stats() const;

  /// xxh64 over all levels: voxel sizes, then every leaf in sorted order with its origin, active
  /// mask and values; then the mask, if there is one. Independent of threads and build type, and of
  /// how the clay came to hold these values. Linear in what is stored.
  std::uint64_t hash() const;

  /// Signed distance in mm at a point: trilinear in the finest level present there; clamped to the
  /// coarsest band (+-kHalfWidthVoxels * h_top) far away.
  double distance_at(const Vec3& point_mm) const;

  /// The bounds in mm of all nodes in or next to the clay; empty when there is no clay. Up to a
  /// voxel of the coarsest level larger than the surface. Visits all leaves, and the nodes of those
  /// that reach out: not for each frame.
  Box3 bounds_mm() const;

  /// Applies a stroke: all its dabs, then prunes, and redistances what is out of gradient bounds.
  /// One undo step.
  ///
  /// Errors   bad_input as validate_stroke, a pose beyond kMaxNode, or a stroke that is open;
  ///          interrupted between dabs (the stroke is taken back whole).
  Result<StrokeReport> apply(const Stroke& stroke, const Progress& progress = {});

  /// Changes the clay as a whole (operation.h). One undo step.
  ///
  /// Errors   bad_input for a number out of its range, named with the remedy; for a result without
  ///          any clay; while a stroke is open. memory, interrupted: nothing was changed either
  ///          (OperationFailure.LeavesTheHashAsItWas).
  /// Accuracy volumes within 0.5 % of exact ones (OperationVolume.*), a hollow's wall within a
  ///          voxel (OperationHollow.WallIsAsThickAsAsked).
  /// Cost     docs/operations.md. Cut, Combine and drains pay for what they change; Offset, Hollow
  ///          and a Resample to other than a power of two measure the whole surface.
  Result<OperationReport> apply(const Operation& operation, const Progress& progress = {});

  /// Changes the mask as a whole. One undo step, also where nothing changes.
  /// Errors   bad_input while a stroke is open or for a number that is no MaskEdit; memory: the
  ///          mask is as it was.
  /// Cost     linear in what the mask keeps: nothing for each leaf that is masked whole.
  Result<void> apply(MaskEdit edit);

  /// How firmly matter is masked at a point: 0 free, 1 does not move (Masked.*). Trilinear between
  /// nodes two finest voxels apart; where no surface is near, constant over boxes of 16. Belongs to
  /// space, not to matter: what is half masked and moves, leaves it behind. Operations ignore and
  /// keep it.
  double mask_at(const Vec3& point_mm) const;
  /// False where it is 0 everywhere: then nothing is stored and edits have the bits they have
  /// without masks.
  bool has_mask() const noexcept;

  /// The same stroke while it is made: begin, extend any number of times, end. In whatever pieces
  /// its samples come, dabs and bits are those of `apply` (LiveStroke.*). One undo step, made by
  /// the end; none for a stroke without samples.
  ///
  /// While a stroke is open everything that reads (hash, distance_at, windows, surface) sees the
  /// clay as it stands; `validate` may find slopes that only the end puts right; `undo` and `redo`
  /// do nothing and return false.
  ///
  /// Errors   bad_input: a stroke is open already (begin, apply) or none is (extend, end); numbers
  ///          as validate_brush and validate_samples have them, a tool smaller than .05 of the
  ///          finest voxel, a tool or pose out of reach, time that runs backwards since the last
  ///          piece. Nothing of that call was applied then and an open stroke stays open. memory:
  ///          the stroke was taken back whole and is closed; but when the dabs of a piece would
  ///          not fit in it, nothing of that piece was applied and the stroke stays open.
  /// Returns  extend: how many dabs were applied now, mirror images and what waited included. Those
  ///          that are joined to dabs still to come (DabFeeder) are not among them.
  /// Cost     extend: its dabs; of `layer` all dabs so far again. end: pruning and redistancing
  ///          under the whole stroke; of `grab` and `twist` all dabs again, from the clay as it was
  ///          when the stroke began: what extend shows of them is resampled with each piece.
  Result<void> begin_stroke(const Tool& tool, const StrokeStyle& style = {});
  Result<int> extend_stroke(std::span<const StrokeSample> samples);
  Result<StrokeReport> end_stroke();

  /// The same in bounded pieces, for a tool so large that a dab takes longer than a frame: queue
  /// what the hand did, then work an edit at a time between other duties. `extend` and `end` first
  /// apply what waits, `cancel` forgets it; dabs, bits and undo step are those of `apply` whenever
  /// they are worked off (PreviewBacklog*). A Preview shows meanwhile what will come.
  ///
  /// Returns  queue: how many dabs wait now, mirror images included. work: whether one did.
  /// Errors   as extend_stroke.
  /// Cost     queue: none worth naming, about 200 bytes for each dab. work: one dab, or those that
  ///          are joined to it, with their mirror images; of anchored actions all that waits, at
  ///          the cost of one extend.
  Result<int> queue_stroke(std::span<const StrokeSample> samples);
  Result<bool> work_stroke();
  int waiting_dabs() const noexcept;

  /// Takes an open stroke back bit for bit and closes it. False when none is open.
  bool cancel_stroke();
  bool is_stroke_open() const noexcept;

  /// Takes back, or repeats, the last stroke bit for bit. False when there is none, or while a
  /// stroke is open: end or cancel it first. Throws bad_alloc where there is no memory for it; the
  /// clay and what can be taken back are as they were then (ScarceMemory.*).
  bool undo();
  bool redo();
  int undo_depth() const noexcept;

  /// Errors  bad_input for negative numbers.
  Result<void> set_limits(const ClayLimits& limits);
  const ClayLimits& limits() const noexcept;
  ClayUse use() const;

  /// Checks the invariants of docs/field.md. Empty when all hold, else one line for each kind of
  /// violation with a count and the first node. Cost: linear in all voxels, slow; for tests.
  std::vector<std::string> validate() const;

 private:
  friend struct ClayAccess;
  struct State;
  explicit Clay(std::unique_ptr<State> state);
  static Clay from_levels(std::unique_ptr<LevelStack> levels, const ClayOptions& options);
  const LevelStack& levels() const noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace argil
