// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/io/certificate.h"

namespace argil::io {

/// How far to go. A count or a bound must be given; with both, whichever is reached first.
struct DecimateOptions {
  std::int64_t triangles = 0;  ///< to so many or one fewer; 0: as few as the bound allows
  double max_error_mm = 0.0;   ///< never farther from the clay than this, both ways; 0: no bound
  TriangleMesh left_out{};     ///< as for measure_error
};

struct DecimateReport {
  int rounds = 0;  ///< runs of the collapse; more than one where places had to be locked
  std::int64_t collapses = 0;        ///< in the last round
  std::int64_t locked_vertices = 0;  ///< of the surface, kept as they were
};

struct Decimated {
  TriangleMesh mesh;  ///< coordinates are floats; no normals
  DecimateReport report;
};

/// Fewer triangles for the surface of a clay, large where it is flat and small where it curves.
/// Every step is held against the clay's field, never against the mesh before it.
///
/// Shapes       surface: closed, two-manifold, as extract_surface gives it, crumbs left out or not.
/// Returns      closed and two-manifold like `surface`, no self-intersection and no triangle
///              without area (proved with exact predicates after rounding to float). Has at most
///              the triangles asked for.
/// Errors       bad_input  nothing asked; a count below what can be reached without folding, named;
///                         a bound below what the surface itself misses the clay by, named;
///                         a surface that is not closed and two-manifold.
///              interrupted.
/// Accuracy     max_error_mm is kept both ways, as measured by measure_error with 5 % in hand.
/// Determinism  same bits for any number of threads.
/// Threads      as Clay.
/// Cost         about 5 us of CPU time for each triangle of `surface`; with a bound several times
///              that.
/// Source       M. Garland, P. Heckbert, "Surface simplification using quadric error metrics",
///              1997; P. Trettner, L. Kobbelt, "Fast and robust QEF minimization using
///              probabilistic quadrics", 2020, of which the isotropic term is taken. Ours differs:
///              each step also pays for the field's own distance at the new triangles, steps run
///              by classes of cost in the order of memory, and the vertices that remain are fitted
///              to the field by least squares.
Result<Decimated> decimate(const TriangleMesh& surface, const Clay& clay,
                           const DecimateOptions& options, const Progress& progress = {});

/// How far `mesh` and the clay lie apart; `surface` is the clay's surface as extract_surface gives
/// it, without the parts that `mesh` shall not have, such as crumbs: those are `left_out`, where
/// the clay has places that do not count.
///
/// Accuracy     within 5 % of dense sampling, also at sharp rims (ErrorCertificateSlow.*): places
/// are
///              few where the error is small and dense where it may exceed the greatest found so
///              far.
/// Errors       bad_input without triangles; interrupted.
/// Determinism  same bits for any number of threads.
/// Cost         about 5 us for each triangle of `surface`, 2 us where `mesh` has the same ones.
Result<MeshError> measure_error(const TriangleMesh& mesh, const TriangleMesh& surface,
                                const Clay& clay, const TriangleMesh& left_out = {},
                                const Progress& progress = {});

}  // namespace argil::io
