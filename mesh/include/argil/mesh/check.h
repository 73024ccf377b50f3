// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/printer.h"
#include "argil/mesh/wall_thickness.h"

namespace argil::mesh {

/// One thing wrong with a mesh and where.
struct MeshProblem {
  /// "boundary_edge", "nonmanifold_edge", "misoriented_edge", "nonmanifold_vertex", "degenerate",
  /// "duplicate", "self_intersection", "inward", "thin_wall"; of a printer "trapped_volume",
  /// "overhang", "narrow_gap", "crumb", "too_large", "too_many_triangles", "file_too_large"; or
  /// what kept the mesh from being judged: "missing_vertex", "not_finite", "not_checked" (out of
  /// memory).
  std::string kind;
  Vec3 at_mm;  ///< middle of the edge, triangle, overlap, cavity or part; the vertex; the whole's
               ///< middle; of an overhang the middle of its triangle that looks down most; where a
               ///< triangle's wall or gap is least
  /// Length of the edge, longest side, the wall's or gap's width, a diagonal (overlap, cavity,
  /// part), the side of a square with an overhang's area, or by how much the part is larger than
  /// the bed.
  double size_mm = 0.0;
};

/// What is wrong with a triangle; the worst counts, which is the last of these.
enum class Mark : std::uint8_t {
  none,
  overhang,         ///< needs support
  narrow_gap,       ///< closes in printing
  small_component,  ///< of one too small to print
  thin_wall,
  trapped,  ///< wall of a cavity without a drain
  broken    ///< open, doubled, without area, crossing, or not manifold
};

/// What a print service would ask. Counts are over the whole mesh. Of one that cannot be judged, as
/// one without triangles, all is false and 0, `marks` is empty, and `problems` says why where there
/// is a reason to name.
struct MeshVerdict {
  bool printable = false;  ///< closed, manifold, outward, nothing crossing, flat, doubled or thin
  bool closed = false;     ///< no boundary edges
  bool manifold = false;   ///< no non-manifold edges or vertices
  bool outward = false;    ///< outer shells face outward, cavities in them inward
  std::int64_t boundary_edges = 0;        ///< edges of one triangle
  std::int64_t nonmanifold_edges = 0;     ///< edges of three or more
  std::int64_t misoriented_edges = 0;     ///< of two triangles that face in opposite directions
  std::int64_t nonmanifold_vertices = 0;  ///< where triangles meet that share no edge through it
  /// Pairs of triangles, exact predicates. kMostCrossings means at least so many: no more are
  /// looked for, and `problems` and `marks` are of those that were found.
  std::int64_t self_intersections = 0;
  std::int64_t degenerate = 0;  ///< triangles with a repeated vertex or no area
  std::int64_t duplicate = 0;   ///< triangles that repeat another's three vertices
  std::int64_t components = 0;  ///< parts that hang together by edges
  std::int64_t euler = 0;       ///< vertices - edges + triangles; 2 for a ball
  double volume_mm3 = 0.0;      ///< signed; positive when facing outward
  double area_mm2 = 0.0;
  double min_wall_mm = -1.0;          ///< thinnest wall (infinite: none); -1: not asked
  double min_gap_mm = -1.0;           ///< narrowest gap (infinite: none); -1: not asked
  std::int64_t cavities = 0;          ///< closed parts that face inward: what is in them stays in
  std::int64_t small_components = 0;  ///< smaller than the printer's least
  double overhang_mm2 = 0.0;          ///< area that looks down more than the printer allows
  Vec3 size_mm{};                     ///< of the bounding box
  std::vector<MeshProblem> problems;  ///< at most 100 of each kind, each kind in triangle order
  std::vector<Mark> marks;            ///< of each triangle; empty where it could not be judged
};

/// Judges a mesh as given, by index: nothing is welded, moved or repaired before.
/// min_wall_mm > 0 also measures walls and reports those thinner (kind "thin_wall") where they hang
/// together over at least its square, or half the surface of their part; smaller specks are creases
/// of a scan.
///
/// Shapes       any triangle soup, in mm; one that cannot be judged has a verdict that says why.
///              Vertices of no triangle are passed over.
/// Errors       none: out of memory is a verdict with the problem "not_checked".
/// Accuracy     self-intersection and degeneracy by CGAL's exact predicates on the given
///              coordinates (CheckMesh.CountsCrossingPairsExactly).
/// Determinism  same verdict for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         about 0.5 us per triangle, on one core (bench `mesh_check`); walls another 1 to 3
/// us.
MeshVerdict check_mesh(const TriangleMesh& mesh_mm, double min_wall_mm = 0.0);

/// The same for a printer. `printable` then also says that the part fits its bed, that walls are
/// thick enough and cavities drained where it asks for that, and that there are not too many
/// triangles or bytes (`file_bytes`; 0 for no file). Overhangs, narrow gaps and small components
/// are told of and do not count: supports are made by the slicer, a crease may close, and small
/// components can be left off.
///
/// An overhang is what leans out more than `max_overhang_deg` from the vertical, but for what lies
/// on the bed: the lowest 0.1 mm.
///
/// Errors       memory; interrupted.
/// Threads      any thread; spreads over TBB. `progress` is called on the one that called this.
/// Cost         that of check_mesh, and walls where the printer asks for any.
Result<MeshVerdict> check_print(const TriangleMesh& mesh_mm, const Printer& printer,
                                std::int64_t file_bytes = 0, const Progress& progress = {});

/// check_print with its walls measured by `walls`, for work that is longer than the check alone.
/// `walls` is asked once, with `mesh_mm`, and only by a printer with a least wall.
///
/// Errors       throws Interrupted and what libraries throw: to be called within no_throw.
MeshVerdict judge_mesh(const TriangleMesh& mesh_mm, const Printer& printer, std::int64_t file_bytes,
                       const WallMeasure& walls, const Pace& pace);

}  // namespace argil::mesh
