// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/display_block.h"
#include "argil/engine/stroke.h"

namespace argil {

/// What a stroke with a large tool will look and feel like, at once: a copy of the clay's coarser
/// levels that takes the stroke first, while the clay itself does so behind, an edit at a time.
///
///     // errors left out; an empty optional: the tool is small, apply the stroke as ever
///     std::optional<Preview> preview = Preview::begin(clay, tool, style).value();
///     clay.begin_stroke(tool, style);
///     // for every piece of the hand's path
///     preview->extend(samples);                            // either thread, or the same one
///     clay.queue_stroke(samples);
///     preview->update_surface();                           // upload changed(), drop gone()
///     publisher.publish(preview->clay(), request);         // and what the hand feels
///     // whenever there is time
///     clay.work_stroke();
///     // at the end
///     preview->end();
///     clay.end_stroke();                                   // applies what still waits
///     preview.reset();                                     // the clay's own surface again
///
/// Nothing of the clay depends on a preview, nor on when its dabs are worked off: its bits, its
/// undo step and its report are those of the stroke alone (PreviewBacklog*). A preview is of one
/// stroke.
///
/// Level        of the tool, `level_of`: the preview holds it and all coarser ones; a node there
///              holds the average of what is finer. Levels keep the numbers they have in the clay.
/// Accuracy     its surface lies within a voxel of that level of what the same samples make of the
///              clay; flatten and scrape, which fit a plane to what they left, within 1.5, borders
///              of a mask, which is as coarse, within two (PreviewAccuracy*). Finer detail under
///              the tool is smoothed away while the preview is shown. docs/sessions.md, "Large
///              tools".
/// Determinism  as Clay: same clay and samples, same bits
///              (Preview.HasTheSameBitsForAnyThreadCount).
/// Threads      `begin` on the clay's thread; then it shares nothing with the clay and belongs to
///              one thread at a time, any.
/// Memory       its levels, from a quarter of the clay's down, and the open stroke's record.
class Preview {
 public:
  /// Voxels from centre to edge up to which a tool is worked as it comes: the usual `tool_voxels`.
  static constexpr double kToolVoxels = 32.0;

  /// The finest level of which the tool's largest radius spans `tool_voxels` at most, though none
  /// whose voxels are coarser than 1/8 of its smallest one, where the clay itself writes the tool,
  /// and none that the clay has not. 0: the tool is small enough for the clay itself. `tool` as
  /// validate_tool wants it.
  static int level_of(const Clay& clay, const Tool& tool,
                      double tool_voxels = kToolVoxels) noexcept;

  /// Previews a stroke on the clay as it stands, its mask included. Nothing where level_of is 0.
  /// `tool_voxels` 8 to 1000: half of it costs a third to a half less and shows half the detail.
  ///
  /// Errors  bad_input as Clay::begin_stroke, so also while a stroke is open on the clay: begin the
  ///         preview first; and for tool_voxels.
  ///         memory when the copy does not fit into what the clay's limits leave: go on without.
  /// Cost    a copy of these levels: bench_preview, docs/sessions.md.
  static Result<std::optional<Preview>> begin(const Clay& clay, const Tool& tool,
                                              const StrokeStyle& style = {},
                                              double tool_voxels = kToolVoxels);

  Preview(Preview&&) noexcept;
  Preview& operator=(Preview&&) noexcept;
  ~Preview();

  /// As Clay::extend_stroke and Clay::end_stroke. What it may take is what the clay's limits left
  /// at the beginning; memory: the preview is the clay before the stroke, so drop it.
  Result<int> extend(std::span<const StrokeSample> samples);
  Result<StrokeReport> end();

  /// Its finest level, as the clay counts them: 1 or more.
  int level() const noexcept;

  /// For whatever reads a clay: `pick`, `read_window`, WindowPublisher, distance_at. Its own
  /// numbers start with 0 for `level()`. A window whose spacing is a quarter of the tool's radius
  /// has, before the first dab, the clay's bits (Preview.IsFeltAsTheClayIs).
  const Clay& clay() const noexcept;

  /// Brings the blocks up to date with the preview. Only blocks are made that a dab changed, or
  /// that look at what it changed. Returns how many were extracted now. Errors  memory: no block is
  /// left, and none of the clay's is replaced; drop the preview.
  Result<std::int64_t> update_surface();

  /// What the last update did to blocks with triangles, named with the clay's levels: those to
  /// upload and those to drop, as of DisplaySurface.
  std::span<const BlockId> changed() const noexcept;
  std::span<const BlockId> gone() const noexcept;

  /// One block; empty spans when it has no triangles or is not there. Until the next update.
  DisplayBlock block(const BlockId& id) const;

  /// Whether a block of the clay's own DisplaySurface is not to be drawn as long as the preview is
  /// shown, and what was uploaded from the preview is drawn instead. True from the update on that
  /// saw to that block first. Every cell is then drawn once (PreviewSurface.DrawsEveryCellOnce), if
  /// the clay's blocks are those of the stroke's beginning: keep back what its `changed` and `gone`
  /// list until the preview is dropped. Its view must hide none of the levels from `level()` on
  /// under the tool.
  ///
  /// The two surfaces meet with a step: less than a voxel of `level()`, where the tool reaches no
  /// more but a block does (PreviewSurface.MeetsTheClayWithinAVoxel).
  bool replaces(const BlockId& of_clay) const noexcept;

 private:
  struct State;
  explicit Preview(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace argil
