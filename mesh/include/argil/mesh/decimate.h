// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/distance_probe.h"
#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/certificate.h"

namespace argil::mesh {

/// A point where mesh and field lie farther apart than they may, and how wide what is wrong there
/// may reach.
struct FarPoint {
  Vec3 at_mm;
  double size_mm = 0.0;
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

  /// How far `mesh` and the field lie apart, both ways. With `bound_mm` > 0 also appends the points
  /// found beyond it to `far`: all kinds of them, but not each one. Throws Interrupted.
  virtual MeshError error_of(const TriangleMesh& mesh, double bound_mm, std::vector<FarPoint>& far,
                             const Pace& pace) const = 0;
};

/// How far to go. A count or a bound must be given; with both, whichever is reached first.
struct DecimateOptions {
  /// To so many or one fewer, 4 or more; 0: as few as the bound allows.
  std::int64_t triangles = 0;
  /// Never farther from the field than this, both ways; 0: no bound.
  double max_error_mm = 0.0;
};

struct DecimateReport {
  int rounds = 0;  ///< runs of the collapse; more than one where vertices had to be locked
  std::int64_t collapses = 0;        ///< in the last round
  std::int64_t locked_vertices = 0;  ///< of the surface, kept as they were
};

struct Decimated {
  TriangleMesh mesh;  ///< coordinates are floats; no normals
  DecimateReport report;
};

/// Fewer triangles for the surface of a field, large where it is flat and small where it curves.
/// Every step is held against the field, never against the mesh before it.
///
/// Shapes       surface: closed, two-manifold, extracted from the field of `target`.
/// Returns      closed and two-manifold like `surface`, no self-intersection and no triangle
///              without area (proved with exact predicates after rounding to float). Has at most
///              the triangles asked for.
/// Errors       bad_input  nothing asked; a count below what can be reached without folding, named;
///                         a bound below what the surface itself misses the field by, named;
///                         a surface that is not closed and two-manifold.
///              interrupted.
/// Accuracy     max_error_mm is kept both ways, as measured by `target`, with 5 % in hand.
/// Determinism  same bits for any number of threads (DecimateScenes.SameBitsForAnyNumberOfThreads).
/// Threads      any thread; spreads over TBB.
/// Cost         about 5 us of CPU time for each triangle of `surface`; with a bound several times
///              that.
/// Source       M. Garland, P. Heckbert, "Surface simplification using quadric error metrics",
///              1997; P. Trettner, L. Kobbelt, "Fast and robust QEF minimization using
///              probabilistic quadrics", 2020, of which the isotropic term is taken. Ours differs:
///              each step also pays for the field's own distance at the new triangles, steps run
///              by classes of cost in the order of memory, and the vertices that remain are fitted
///              to the field by least squares.
Result<Decimated> decimate(const TriangleMesh& surface, const DecimationTarget& target,
                           const DecimateOptions& options, const Progress& progress = {});

}  // namespace argil::mesh
