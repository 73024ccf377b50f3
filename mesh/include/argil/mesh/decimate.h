// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "argil/core/distance_probe.h"
#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {

/// A piece of a surface phi = 0 in a cube: its points are among those of the cube at which a linear
/// function is near 0.
struct SurfacePiece {
  Vec3 middle_mm;             ///< of the cube
  double half_side_mm = 0.0;  ///< 0 or more
  double phi_mm = 0.0;        ///< the function in the middle
  Vec3 gradient;              ///< and how it changes, in mm per mm; may be zero
  double bend_mm = 0.0;       ///< how far from 0 the function is at points of the surface, at most
};

/// Finds the triangles of a mesh near one point after another, each search from where the last one
/// ended. Distances are never less than from the mesh.
class NearTriangles {
 public:
  virtual ~NearTriangles() = default;
  /// How far a point is from a triangle that is no farther than `enough_mm`, or from the last one
  /// whose neighbours are not nearer.
  virtual double distance_mm(const Vec3& point_mm, double enough_mm) = 0;
  /// As distance_mm, but looks behind triangles that are not nearer too. Some 50 us.
  virtual double distance_far_mm(const Vec3& point_mm, double enough_mm) = 0;
  /// Whether all of a piece of surface lies above or below the inside of the triangle that the
  /// search has come to, within `bound_mm` of it: for certain, by the planes of triangle and piece,
  /// which tell more than the cube around it. No search, some 10 ns; false where the search does
  /// not offer it.
  virtual bool covers(const SurfacePiece& /*piece*/, double /*bound_mm*/) { return false; }
};

/// Proves that a mesh and a field lie within a bound of each other, piece by piece: the field's
/// surface by cells, which are boxes with a part of phi = 0 in each, and the mesh by triangles.
///
/// Accuracy     on the safe side: what is said to be near is, but for the rounding of doubles; what
///              is not may be farther or too near to the bound to tell.
/// Threads      any.
class BoundProof {
 public:
  virtual ~BoundProof() = default;
  virtual std::uint32_t cells() const = 0;
  /// A vertex in or next to the cell, of the surface that the proof was made for.
  virtual std::uint32_t vertex_of(std::uint32_t cell) const = 0;
  /// Where several sheets of that surface pass through the cell, as of a thin wall, a vertex of
  /// each of the others; else none. They stay while this lives.
  virtual std::span<const std::uint32_t> other_vertices_of(std::uint32_t /*cell*/) const {
    return {};
  }
  /// Whether every point with phi = 0 in the cell has a point of the mesh within the bound. `mesh`
  /// begins its search near the cell, on every sheet.
  virtual bool is_near(std::uint32_t cell, NearTriangles& mesh) const = 0;
  /// The same without a look behind triangles that are not nearer: false where that does not tell,
  /// and soon. Most cells are proven from the triangle that the cell before was near.
  virtual bool is_near_at_once(std::uint32_t /*cell*/, NearTriangles& /*mesh*/) const {
    return false;
  }
  /// Sets `is_near[t]` to 1 where |phi| is within the bound all over triangle t, else to 0. Both
  /// have the same size.
  virtual void ask_triangles(std::span<const Corners> triangles,
                             std::span<std::uint8_t> is_near) const = 0;
};

/// What fewer triangles are held against: the field that the surface was extracted from. Decimation
/// sees no more of it than this.
///
/// Threads      from any while nobody changes the field.
class DecimationTarget {
 public:
  virtual ~DecimationTarget() = default;

  /// The field's finest voxel, greater than 0.
  virtual double voxel_mm() const = 0;

  /// Asks the field for one thread; as many as there are threads live at the same time. Never null.
  virtual std::unique_ptr<DistanceProbe> probe() const = 0;

  /// How far the surface and the field lie apart, both ways. Throws Interrupted.
  virtual double own_error_mm(const Pace& pace) const = 0;

  /// A proof by the field, whose surface was extracted, that lives no longer than this. Never null.
  /// Throws Interrupted.
  virtual std::unique_ptr<BoundProof> proof(double bound_mm, const Pace& pace) const = 0;
};

/// How far to go. A count or a bound must be given; with both, whichever is reached first.
struct DecimateOptions {
  /// To so many or one fewer, 4 or more; 0: as few as the bound allows.
  std::int64_t triangles = 0;
  /// Never farther from the field than this, both ways; 0: no bound.
  double max_error_mm = 0.0;
};

struct DecimateReport {
  /// Runs of the collapse, with a bound of the place that was tried most often; more than one where
  /// something was taken back.
  int rounds = 0;
  std::int64_t collapses = 0;        ///< that led to the mesh
  std::int64_t locked_vertices = 0;  ///< of the surface, kept as they were
};

struct Decimated {
  TriangleMesh mesh;  ///< coordinates are floats; no normals
  DecimateReport report;
};

/// Fewer triangles for the surface of a field, large where it is flat and small where it curves.
/// The last steps and the fit are held against the field, never against the mesh before them.
///
/// Shapes       surface: closed, two-manifold, extracted from the field of `target`.
/// Returns      closed and two-manifold like `surface`, no self-intersection and no triangle
///              without area (proved with exact predicates after rounding to float). Has at most
///              the triangles asked for.
/// Errors       bad_input  nothing asked; a count below what can be reached without folding, named;
///                         a bound below what the surface itself misses the field by, named;
///                         a surface that is not closed and two-manifold.
///              interrupted.
/// Accuracy     max_error_mm is kept both ways: all of the mesh and of the field is proven to be
///              within it (BoundProof), or goes back to what it was; with 2 % in hand.
///              Below a twentieth of a voxel nothing is proven, and the bound is refused.
/// Determinism  same bits for any number of threads (DecimateScenes.SameBitsForAnyNumberOfThreads).
/// Threads      any thread; spreads over TBB.
/// Cost         2 to 3 us of CPU time for each triangle of `surface`; with a bound 3 to 4 us, more
///              where much is taken back (bench_decimate).
/// Source       M. Garland, P. Heckbert, "Surface simplification using quadric error metrics",
///              1997; P. Trettner, L. Kobbelt, "Fast and robust QEF minimization using
///              probabilistic quadrics", 2020, of which the isotropic term is taken. Ours differs:
///              the last steps also pay for the field's own distance at the new triangles, steps
///              run by classes of cost in blocks that lie together, and the vertices that remain
///              are fitted to the field by least squares.
Result<Decimated> decimate(const TriangleMesh& surface, const DecimationTarget& target,
                           const DecimateOptions& options, const Progress& progress = {});

}  // namespace argil::mesh
