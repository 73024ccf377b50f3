// SPDX-License-Identifier: GPL-3.0-or-later
// Mends a mesh only where it is broken, the mildest repair first; after each the mesh is checked
// again.
#include "argil/mesh/repair.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/core/winding_number.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/rounding.h"

#include "repair/close_soup.h"
#include "repair/crumbs.h"
#include "repair/inner_walls.h"
#include "repair/library_call.h"
#include "repair/loose_sheets.h"
#include "repair/resolve_crossings.h"
#include "repair/seams.h"
#include "repair/thicken.h"

namespace argil::mesh {
namespace {

/// Of the diagonal, between surfaces that only touched: a micrometre on 100 mm, a hundred steps of
/// float.
constexpr double kGap = 1e-5;

class Mend {
 public:
  Mend(const TriangleMesh& input, const Thickening& thickening, const Pace& pace)
      : pace_(pace),
        thickening_(thickening),
        mesh_(rounded_to_float({input.positions, {}, input.triangles})) {}

  Result<MendedMesh> run();

 private:
  /// `done` of all repair.
  bool is_printable(double done) { return is_printable(pace_.part(done, done)); }
  bool is_printable(const Pace& pace) {
    report_.verdict = judge_mesh(mesh_, {}, 0, wall_thickness, pace);
    return report_.verdict.printable;
  }
  void join_seams();
  void split_at_junctions(double near);
  bool cone_the_rest();
  Result<void> close();
  void part_where_touching();
  bool resolve(const Pace& pace);
  void bound_the_inside();
  void drop_crumbs_left();
  Result<void> mend();

  const Pace pace_;
  const Thickening& thickening_;
  TriangleMesh mesh_;
  TriangleMesh facing_;
  double size_ = 0.0;  ///< of the box of what triangles name
  MendReport report_;
};

void Mend::join_seams() {
  assert(size_ >= 0.0);
  double near = kNearRims * size_;
  mesh_ = compacted(mesh_);
  const std::size_t given = mesh_.positions.size();
  mesh_ = welded(mesh_);  // a soup of loose triangles would be all rims
  report_.joined_vertices += static_cast<std::int64_t>(given - mesh_.positions.size());
  pace_.at(0.0);
  report_.interior_faces += drop_interior_faces(mesh_);
  pace_.at(0.0);
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  const RimsJoined joined = join_rims_as_needed(mesh_, near, kFarRims * size_);
  pace_.at(0.0);
  near = std::max(near, joined.near_mm);
  report_.joined_vertices += joined.vertices > 0 ? joined.vertices : join_rims(mesh_, near);
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  pace_.at(0.0);
  split_at_junctions(near);
  pace_.at(0.0);
  report_.dropped_fins = drop_fins(mesh_);
  report_.interior_faces += drop_inner_walls(mesh_, pace_.part(0.0, 0.1));
}

/// Vertices a little beside an edge split it too, the nearer ones first, while there are open
/// edges.
void Mend::split_at_junctions(double near) {
  constexpr double kStep = 8.0;
  constexpr double kFarthest = 1e-4;  // of the diagonal
  // A pass splits one edge of a triangle; a long one may need many.
  constexpr int kMostPasses = 16;
  for (; near <= kFarthest * size_; near *= kStep) {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      pace_.at(0.0);
      const std::int64_t split = split_at_rims(mesh_, near);
      report_.split_edges += split;
      if (split == 0) break;
    }
    if (open_edges(mesh_) == 0) return;
  }
}

/// What holes are left open, those that touch others or run along edges of three triangles, by
/// cones over them, whatever these cross: what is inside is decided afterwards. Not where that
/// would need as much surface as a part has, but for sheets that lie apart from all else, which go.
bool Mend::cone_the_rest() {
  if (report_.closing.closed) return true;
  report_.dropped_sheets = drop_loose_sheets(mesh_, pace_.part(0.3, 0.3));
  TriangleMesh coned = mesh_;
  const std::vector<Triangle> cones = boundary_cones(coned.positions, mesh_.triangles);
  if (has_sheets(mesh_, coned.positions, cones)) return false;
  report_.coned_holes = std::ssize(coned.positions) - std::ssize(mesh_.positions);
  coned.triangles.insert(coned.triangles.end(), cones.begin(), cones.end());
  mesh_ = welded(rounded_to_float(std::move(coned)));
  report_.closing.holes_closed += report_.coned_holes;
  report_.closing.holes_left = 0;
  is_printable(0.3);
  return true;
}

/// The first closing is the one that is reported; a later one closes what was opened meanwhile.
Result<void> Mend::close() {
  auto closed = close_soup(mesh_, true, pace_.part(0.1, 0.1));
  if (!closed) return closed.error();
  if (report_.closing.parts == 0) {
    closed.value().report.dropped_triangles += report_.closing.dropped_triangles;
    report_.closing = closed.value().report;
  }
  pace_.at(0.2);
  mesh_ = rounded_to_float(std::move(closed.value().mesh));
  facing_ = mesh_;
  facing_.triangles.resize(closed.value().given_triangles);
  return {};
}

void Mend::part_where_touching() {
  const double gap = kGap * size_;
  const std::int64_t parted = part_touching(mesh_, gap);
  if (parted <= 0) return;
  report_.parted_vertices = parted;
  report_.gap_mm = gap;
  mesh_ = rounded_to_float(std::move(mesh_));
}

/// Cuts what crosses along the lines in which it does and leaves out what is inside. False where
/// that would take too long, or a library failed.
bool Mend::resolve(const Pace& pace) {
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh_);
  mesh_ = only_triangles(mesh_, [&](std::size_t t) {
    return !std::binary_search(flat.begin(), flat.end(), static_cast<std::uint32_t>(t));
  });
  const auto pairs = self_intersections(mesh_, {});
  std::optional<ResolvedCrossings> resolved;
  is_done_by_library([&] { resolved = resolve_crossings(mesh_, pairs, pace); });
  if (!resolved) return false;
  report_.united_parts += resolved->united_parts;
  mesh_ = std::move(resolved->mesh);
  is_printable(pace.part(1.0, 1.0));
  return true;
}

/// What is new is rounded to float, which may make others cross, touch or lose their area: a few
/// rounds, and what folded slivers are left then shrink.
void Mend::bound_the_inside() {
  constexpr int kMostRounds = 8;
  constexpr double kSliver = 1e-4;  // of the diagonal, that a surface may move by
  double done = 0.3;
  for (int round = 0; round < kMostRounds && !report_.verdict.printable; ++round) {
    const double next = 0.5 * (done + 0.9);  // the first takes longest
    const Pace pace = pace_.part(std::exchange(done, next), next);
    const MeshVerdict& is = report_.verdict;
    const bool only_touches =
        is.self_intersections + is.duplicate + is.degenerate == 0 && !is.manifold;
    if (only_touches) {
      part_where_touching();
      is_printable(pace);
    } else if (!resolve(pace)) {
      return;
    }
  }
  if (!report_.verdict.printable) {
    report_.verdict = check_and_collapse_folded(mesh_, kSliver * size_, pace_.part(0.9, 0.9));
  }
}

void Mend::drop_crumbs_left() {
  report_.dropped_crumbs = drop_crumbs(mesh_, facing_);
  if (report_.dropped_crumbs > 0) is_printable(0.9);
}

/// All that changes no more than where the mesh is broken; the verdict says whether it did.
Result<void> Mend::mend() {
  pace_.at(0.0);
  report_.is_changed = true;
  join_seams();
  if (thickening_.thickness_mm > 0.0) {
    report_.thickened_sheets = thicken_sheets(mesh_, thickening_);
    mesh_ = rounded_to_float(std::move(mesh_));
  }
  if (auto closed = close(); !closed) return closed;
  if (is_printable(0.2)) {
    drop_crumbs_left();
    return {};
  }
  if (!report_.closing.closed && is_open_sheets(mesh_)) {
    return Error{ErrorKind::bad_input,
                 "the mesh encloses nothing: it is flat or an open sheet; give it a thickness with "
                 "--thicken MM"};
  }
  report_.crossings = report_.verdict.self_intersections;
  pace_.at(0.3);
  if (cone_the_rest()) bound_the_inside();
  if (!report_.verdict.printable && !report_.verdict.manifold) part_where_touching();
  if (is_printable(0.9)) drop_crumbs_left();
  return {};
}

Result<MendedMesh> Mend::run() {
  if (is_printable(0.0)) return MendedMesh{std::move(mesh_), {}, std::move(report_)};
  const bool is_usable = !report_.verdict.marks.empty();
  if (!is_usable) {
    return Error{
        ErrorKind::bad_input,
        "the mesh has no triangles, or a vertex that is missing, not finite or beyond what "
        "a float holds (3.4e38); export it again"};
  }
  size_ = length(used_bounds(mesh_).size());
  if (auto mended = mend(); !mended) return mended.error();
  return MendedMesh{std::move(mesh_), std::move(facing_), std::move(report_)};
}

}  // namespace

Result<MendedMesh> mend_mesh(const TriangleMesh& mesh_mm, const Thickening& thickening,
                             const Progress& progress) {
  const double thickness = thickening.thickness_mm;
  if (!(thickness >= 0.0) || !std::isfinite(thickness)) {
    return Error{ErrorKind::bad_input, "the thickness of sheets is " + std::to_string(thickness) +
                                           " mm; must be greater than 0, or 0 for none"};
  }
  return no_throw("repairing the mesh",
                  [&] { return Mend(mesh_mm, thickening, Pace(progress, "mend")).run(); });
}

}  // namespace argil::mesh
