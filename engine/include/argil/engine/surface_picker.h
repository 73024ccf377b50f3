// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "argil/core/result.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/pick.h"

namespace argil {

/// What a SurfacePicker keeps.
struct SurfacePickerStats {
  std::int64_t cubes = 0;        ///< of 64^3 nodes of a level, in which blocks are
  std::int64_t empty_cubes = 0;  ///< kept for blocks to come: at most a fourth of all and 16
  std::int64_t blocks = 0;       ///< with triangles
  std::int64_t commits = 0;  ///< how often the tree over the cubes was built, since the beginning
  std::int64_t bytes = 0;    ///< what cubes take; Embree's tree, some 100 bytes a cube, left out
};

/// Picks on the surface that is drawn: its triangles, where `pick` answers with the field. Several
/// times faster than `pick`, for what a user points at (docs/surface.md, "Picking", says which to
/// ask when).
///
///     surface.update(clay, view);                // as ever
///     picker.update(surface);                    // what changed, or all that was missed
///     auto under = picker.pick(surface, ray);    // as often as wanted
///
/// Embree holds one geometry, the cubes; in a cube the blocks' boxes and their triangles are tested
/// here. So a dab writes a few pointers, and Embree's tree is built again only when a cube comes or
/// many went, at the first pick after it.
///
/// Threads      of the surface, one at a time.
/// Determinism  the answer depends on the drawn surface and the ray alone, to the bit: not on what
///              updates led there, other rays, threads or instruction sets
///              (SurfacePickerProperty.DoesNotDependOnHistory).
/// Cost         docs/surface.md, `bench_pick`. 2 bytes for each vertex of the surface.
/// Source       docs/surface.md, "Picking".
class SurfacePicker {
 public:
  SurfacePicker();
  SurfacePicker(SurfacePicker&&) noexcept;
  SurfacePicker& operator=(SurfacePicker&&) noexcept;
  ~SurfacePicker();

  /// Takes in what the surface's last update changed; when it missed one before, or another surface
  /// is given, all blocks. Nothing to do when the surface was not updated since.
  /// Errors  memory: it holds nothing, and the next call starts over.
  Result<void> update(const DisplaySurface& surface);

  /// The first triangle that a ray meets from its front, after an `update` where one is due: a ray
  /// that starts in the clay first leaves it. Nothing when there is none.
  ///
  /// In the Pick, `level` is that of the block, which may be coarser than the clay is there, as the
  /// surface is; `normal` lies between those of the triangle's corners, or is -direction where they
  /// cancel out.
  ///
  /// Errors    as `pick`; memory.
  /// Accuracy  the point is on the triangle to 1e-3 voxel of level 0 for clay of up to 4 000
  /// voxels.
  ///           With everything shown it is within 0.05 voxel of that of `pick` and the normals
  ///           within 3 degrees, but for one ray in a hundred (SurfacePicker.AgreesWithTheWalk*).
  ///           No ray passes between two triangles (SurfacePicker.LosesNoRayAt*).
  Result<std::optional<Pick>> pick(const DisplaySurface& surface, const Ray& ray);

  SurfacePickerStats stats() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
