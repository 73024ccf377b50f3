// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/repair.h"

namespace argil::io {

/// How far a repair had to go.
enum class RepairPath : std::uint8_t {
  nothing,  ///< it was printable
  local,    ///< welded, cut, turned, filled or parted where that was needed
  field     ///< rebuilt from a level set: no triangle is as it was
};

struct RepairOptions {
  /// Of the level set, where all else fails: > 0, or 0 for a 512th of the largest side, up to a
  /// 220th where that would put more than 220 000 voxels on the surface.
  double voxel_mm = 0.0;
  mesh::Thickening thickening = {};  ///< of sheets; by default none
};

struct RepairPlace {
  Vec3 at_mm;
  double distance_mm = 0.0;  ///< of the result from what was given there, or the other way round
};

/// What of the given surface is neither within a tolerance of the result nor inside it, where parts
/// were united. Found by samples, of which each stands for an area of the tolerance squared, or
/// 4096 in a triangle.
struct RepairLoss {
  /// More is too much, and so is any place farther off than so many tolerances.
  static constexpr double kMostShare = 0.01;
  static constexpr double kMostTolerances = 2.0;

  double tolerance_mm = 0.0;
  double share = 0.0;               ///< of the given area
  std::int64_t parts = 0;           ///< of which next to nothing is left
  std::vector<RepairPlace> places;  ///< the farthest first, at most 10
  std::int64_t samples = 0;
  /// Between the result and given surface that lies within it, nearer than the tolerance: where
  /// patches lie on one another, which of them was meant is a guess. Where this is more than
  /// 0.5 % of the volume and nothing else is lost, `places` has its deepest.
  double covered_mm3 = 0.0;
};

/// What of the result nobody gave: surface farther than a tolerance from all that was given, where
/// that does not tell of a surface either. The winding number of what was given is 1/2 on a lid
/// that closes an opening; where it is below 1/4 or above 3/4 the lid is at the wrong place. Found
/// by samples, as what is lost is. Of a level set so is what is farther than
/// RepairLoss::kMostTolerances, wherever it is.
struct RepairGuess {
  double tolerance_mm = 0.0;
  double share = 0.0;               ///< of the area of the result
  std::vector<RepairPlace> places;  ///< the farthest first, at most 10
  std::int64_t samples = 0;
};

/// What was mended; the verdict is of the result.
struct RepairReport : mesh::MendReport {
  RepairPath path = RepairPath::nothing;
  double voxel_mm = 0.0;            ///< of the level set; 0: none was needed
  std::int64_t kept_triangles = 0;  ///< of the input, with every bit of its corners
  /// No point of the result is farther from the input, but for the rounding of doubles.
  double max_change_mm = 0.0;
  double max_change_slack_mm = 0.0;  ///< by how much that may be too much
  RepairLoss loss;
  RepairGuess guess;
  Vec3 given_size_mm;  ///< of the input's bounding box
  /// What the input encloses; nothing where it is open, crosses itself or faces both ways.
  std::optional<double> given_volume_mm3;

  /// Whether a part, more than RepairLoss::kMostShare of the area or as much of the volume is gone,
  /// or any place is farther off than RepairLoss::kMostTolerances, through a level set than one,
  /// or more than 0.5 % of the volume is covered.
  bool lost_too_much() const noexcept;
  bool covered_too_much() const noexcept;
  /// Whether there is any such place.
  bool guessed_too_much() const noexcept { return !guess.places.empty(); }
};

struct RepairedMesh {
  TriangleMesh mesh;
  RepairReport report;
};

/// Makes a mesh printable by the least change that works: first the surface is mended where it is
/// broken (mesh::mend_mesh), and only when that does not do is it rebuilt through a level set.
///
/// Shapes       any triangle soup with finite positions, in mm.
/// Errors       as mend_mesh; bad_input where there is nothing inside (an open sheet); memory: the
///              level set would not fit, the message names the voxel that does.
/// Returns      also where it lost too much or is not printable: the report says so.
/// Accuracy     as mend_mesh; through the field a voxel (MeshRepair.*). `max_change_mm` is a bound
///              (RepairBound.*).
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         mend_mesh's; the field as an import at its voxel; some microseconds for each
///              triangle that changed, to compare.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh_mm, const RepairOptions& options = {},
                                 const Progress& progress = {});

}  // namespace argil::io
