// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/stroke.h"

namespace argil {

/// What a stroke with a large tool will look and feel like, at once: a copy of the clay's coarser
/// levels that takes the stroke first, while the clay itself does so behind, an edit at a time.
///
///     // errors left out; an empty optional: apply the stroke as ever
///     std::optional<Preview> preview = Preview::begin(clay, surface, tool, style).value();
///     clay.begin_stroke(tool, style);
///     // for every piece of the hand's path
///     preview->extend(samples);                            // either thread, or the same one
///     clay.queue_stroke(samples);
///     preview->update_surface();                           // drop gone(), upload changed()
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
/// Drawn        Of tools that displace the surface (smooth, inflate, flatten, pinch, layer and
///              their like) the clay's own blocks, whose vertices move as that level does:
///              detail stays, under the tool and beside it (PreviewDetail*); of grab and twist
///              the clay's own blocks as well, whose vertices go with their matter
///              (PreviewDrag*). Of those that make surface (add, carve, trim) or drag matter
///              along otherwise (elastic, slide, snake hook) that level's blocks where surface is
///              made, with a seam of triangles to the clay's own around. What is drawn is closed,
///              whatever the stroke (PreviewSurfaceOf*).
/// Accuracy     its surface lies within a voxel of that level of what the same samples make of the
///              clay; flatten and scrape, which fit a plane to what they left, within 1.5, borders
///              of a mask, which is as coarse, within two (PreviewAccuracy*). docs/sessions.md,
///              "Large tools".
/// Determinism  as Clay: same clay and samples, same bits
///              (Preview.HasTheSameBitsForAnyThreadCount).
/// Threads      `begin` on the clay's thread; then it shares nothing with the clay, but reads
///              `shown`, and belongs to one thread at a time, any.
/// Memory       twice its levels, from a quarter of the clay's down, the open stroke's record, and
///              of grab and twist 72 bytes for each vertex that they met.
class Preview {
 public:
  /// Voxels from centre to edge up to which a tool is worked as it comes: of what adds or carves,
  /// and of what displaces or drags, for which the voxels under it are solved anew. What a dab then
  /// takes: bench_preview, docs/sessions.md.
  static constexpr double kStampVoxels = 64.0;
  static constexpr double kOtherVoxels = 32.0;
  /// Which of them: the usual `tool_voxels`.
  static constexpr double usual_voxels(Action action) noexcept {
    return is_stamped(action) ? kStampVoxels : kOtherVoxels;
  }

  /// The finest level of which the tool's largest radius spans `tool_voxels` at most, though none
  /// whose voxels are coarser than 1/8 of its smallest one, where the clay itself writes the tool,
  /// none too coarse for the waves of a noise or the pixels of an image, and none that the clay has
  /// not. 0: the tool is small enough for the clay itself. `tool` as validate_tool wants it;
  /// without `tool_voxels`, the usual.
  static int level_of(const Clay& clay, const Tool& tool,
                      std::optional<double> tool_voxels = {}) noexcept;

  /// Previews a stroke on the clay as it stands, its mask included. Nothing where level_of is 0,
  /// for what paints the mask and moves nothing, and for what makes surface where `shown` hides all
  /// levels that the tool could be written at. `tool_voxels` 8 to 1000: half of it costs a third
  /// to a half less and, of what makes surface, shows half the detail.
  ///
  /// `shown`: the drawn surface of the clay as it stands. It must stay where it is, and without an
  /// update, for as long as the preview is there.
  ///
  /// Errors  bad_input as Clay::begin_stroke, so also while a stroke is open on the clay: begin the
  ///         preview first; and for tool_voxels.
  ///         memory when the copy does not fit into what the clay's limits leave: go on without.
  /// Cost    two copies of these levels, and a look at each block of `shown`: bench_preview,
  ///         docs/sessions.md.
  static Result<std::optional<Preview>> begin(const Clay& clay, const DisplaySurface& shown,
                                              const Tool& tool, const StrokeStyle& style = {},
                                              std::optional<double> tool_voxels = {});

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

  /// Brings what is drawn up to date with the preview. Only blocks are looked at that a dab
  /// changed, or that look at what it changed. Returns how many that were. Errors  memory: drop the
  /// preview, and draw `shown` again. Cost    of moved blocks 0.3 us a vertex, of dragged ones as
  /// much for each dab; else as DisplaySurface for what is extracted.
  Result<std::int64_t> update_surface();

  /// What the last update did to what is drawn, which was `shown` at the beginning: blocks to
  /// upload, and blocks to drop, the clay's own or the preview's, named with the clay's levels. The
  /// seam is one block, with an origin that no other has.
  std::span<const BlockId> changed() const noexcept;
  std::span<const BlockId> gone() const noexcept;

  /// One block that was listed as changed; empty spans when it has no triangles or is not there.
  /// Until the next update.
  DisplayBlock block(const BlockId& id) const;

 private:
  struct State;
  explicit Preview(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace argil
