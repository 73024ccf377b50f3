// SPDX-License-Identifier: GPL-3.0-or-later
// Redistance: what an edit moved or bent becomes a signed distance again. Five situations, one
// module:
//
//   redistance()                 a level whose surface an edit has just changed
//   redistance_marked()          leaves that are nearly a distance, solved together
//   redistance_out_of_bounds()   leaves of the clay whose gradient is out of bounds; repeated by
//                                redistance_until_in_bounds(), redistance_touched() and
//                                redistance_levels() of new levels
//   redistance_shortened()       what an offset left too short beyond the ends of what it shrank
//   RedistanceQueue, flush()     leaves that dabs only displaced, solved later
//
// Determinism  of all: the same bits for any number of threads.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/vec3.h"

#include "edit/edit.h"
#include "edit/history.h"
#include "field/leaf_map.h"
#include "rows/rows.h"

namespace argil {

/// Nodes farther than this from every changed node keep their bits: a band reaches no farther.
inline constexpr int kReach = kHalfWidthVoxels + 1;

/// What becomes of the nodes next to the surface, from which all others are solved.
enum class Seeds {
  keep,       ///< they keep their values unless off by more than a factor 2
  normalise,  ///< they are recomputed, as far as an end of a cut lattice edge of theirs changed:
              ///< the others' distance is no better for being measured again
};

/// Solves the nodes within kReach of a changed node (now != before, or any node of a leaf that is
/// `marked`) outward from the nodes next to a sign change and the restricted ones, which stay;
/// every other node keeps its bits. Signs are those of `now`. Writes only leaves of `edit`.
///
/// Accuracy     that of sweep_distances(); seeds by value / |gradient| where the field is smooth
///              (second differences below a quarter of the gradient), else by 1/d^2 = sum over axes
///              of 1/cut^2: exact for planes, off by h^2 / 2R otherwise.
void redistance(LevelEdit& edit, Seeds seeds);

/// Recomputes every node of the `marked` leaves, seeds included; others stay: for leaves that are a
/// distance nearly, and whose neighbours are. Masked nodes stay too.
/// Accuracy as redistance().
void redistance_marked(LevelEdit& edit);

/// Nodes of a level that a tool with these bounds can change, directly or by redistancing.
openvdb::CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm);

/// What every distance keeps to.
inline constexpr GradientBounds kGradientBounds{3.0F, 0.5F, 2.0F};

/// True when |grad phi| leaves the bounds at some node that the level itself decides: within 3
/// voxels of the surface, the level ends neither at it nor at its six neighbours, which are on the
/// same side, and no finer cell meets it. `where`, when given, becomes that node.
bool out_of_gradient_bounds(const LevelStack& stack, int level, const Coord& origin,
                            Coord* where = nullptr, const GradientBounds& bounds = kGradientBounds);

/// The given leaves and their six neighbours, as far as they are out of gradient bounds. Sorted.
LeafList leaves_out_of_bounds(const LevelStack& stack, const LeafList& leaves);

/// One pass: redistances the leaves that are out of gradient bounds among `touched`, their
/// neighbours and parents. Returns those. What is solved may no longer fit its neighbours: call
/// again with them.
LeafList redistance_out_of_bounds(EditTarget& target, const LeafList& touched);

/// Passes until no leaf near `touched` is out of bounds; appends every leaf that changed to
/// `touched`. False when `progress` asked to stop.
bool redistance_until_in_bounds(EditTarget& target, LeafList& touched, const Progress& progress);

/// Passes until no leaf is out of bounds that an edit of the `touched` ones, or a pass, can have
/// put out of them; at most 8. Returns the leaves that changed.
LeafList redistance_touched(EditTarget& target, LeafList touched);

/// Redistances what is out of bounds on levels that belong to no clay yet, and prunes there. False
/// when `progress` asked to stop.
bool redistance_levels(LevelStack& stack, double tolerance_mm, const Progress& progress);

/// Solves what is too short on one side of new levels whose values are another surface's distance
/// plus a constant: outside of what became smaller, inside of what became larger. Only short nodes
/// (edit/short_nodes.h) change, to what is farther, and never a node beside the surface; a leaf may
/// be without a band then. On levels that belong to no clay yet, before restrict_all(). False when
/// `progress` asked to stop.
///
/// Accuracy  that of sweep_distances() from nodes that are right
///           (OperationOffset.IsADistanceBeyondTheEndsOfWhatItShrank).
/// Cost      1 us a leaf, and 20 where something is too short.
bool redistance_shortened(LevelStack& stack, bool is_outside, const Progress& progress);

/// The leaves whose values were moved with the surface and not measured since, and how far they
/// were moved. A stroke keeps one.
class RedistanceQueue {
 public:
  /// The leaf was moved by this much more.
  void mark(int level, const Coord& origin, float voxels);
  /// The leaf was moved, band and all: it is to be measured once the tool has left it behind, or
  /// at once if it is bent.
  void mark_carried(int level, const Coord& origin, bool is_bent);

  /// Takes the leaf out if it moved too far.
  bool take_if_too_far(int level, const Coord& origin);

  /// Takes out the leaves that moved too far, and those that the tool has left behind.
  LeafList take_due(const std::function<bool(int level, const Coord& origin)>& is_behind);

 private:
  std::vector<LeafMap<float>> moved_;  // by level
};

/// Commits an edit that displaced all levels: the coarser ones get the restriction, what moved is
/// marked in the target's queue, and what moved too far in all is solved at once.
void commit_displaced(EditTarget& target, Edit& edit);

/// Commits an edit that carried matter along on all levels: as commit_displaced(), but a leaf is
/// due at once only where its gradient is no longer within kCarriedBounds. What matter carries with
/// it stays a distance as far as its motion is rigid.
void commit_carried(EditTarget& target, Edit& edit);
inline constexpr GradientBounds kCarriedBounds{3.0F, 0.75F, 1.33F};

/// Redistances what is due in the target's queue: what moved too far or is bent, and what tools
/// with these bounds do not reach any more. Without bounds all of it.
void flush_queue(EditTarget& target, std::span<const Box3> tools_mm);

}  // namespace argil
