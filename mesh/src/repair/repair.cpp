// SPDX-License-Identifier: GPL-3.0-or-later
// Mends a mesh only where it is broken, the mildest repair first; after each the mesh is checked
// again.
#include "argil/mesh/repair.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/rounding.h"

#include "repair/seams.h"
#include "repair/unite_parts.h"

namespace argil::mesh {
namespace {

/// Of the diagonal, between surfaces that only touched: a micrometre on 100 mm, a hundred steps of
/// float.
constexpr double kGap = 1e-5;

class Mend {
 public:
  Mend(const TriangleMesh& input, const Progress& progress)
      : progress_(progress), mesh_(rounded_to_float({input.positions, {}, input.triangles})) {}

  Result<MendedMesh> run();

 private:
  Result<void> go_on(std::string_view stage, double fraction) const {
    if (!progress_ || progress_(stage, fraction)) return {};
    return Error{ErrorKind::interrupted, "interrupted while repairing a mesh"};
  }
  bool is_printable() {
    report_.verdict = check_mesh(mesh_);
    return report_.verdict.printable;
  }
  void join_seams();
  Result<void> close();
  void part_where_touching();
  void refill_crossings();
  Result<void> mend();

  const Progress& progress_;
  TriangleMesh mesh_;
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
  report_.interior_faces += drop_interior_faces(mesh_);
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  const RimsJoined joined = join_rims_as_needed(mesh_, near, kFarRims * size_);
  near = std::max(near, joined.near_mm);
  report_.joined_vertices += joined.vertices > 0 ? joined.vertices : join_rims(mesh_, near);
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  // A pass splits one edge of a triangle; a long one may need many.
  constexpr int kMostPasses = 16;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::int64_t split = split_at_rims(mesh_, near);
    report_.split_edges += split;
    if (split == 0) break;
  }
  report_.dropped_fins = drop_fins(mesh_);
}

/// The first closing is the one that is reported; a later one closes what was opened meanwhile.
Result<void> Mend::close() {
  auto closed = close_mesh(mesh_);
  if (!closed) return closed.error();
  if (report_.closing.parts == 0) {
    closed.value().report.dropped_triangles += report_.closing.dropped_triangles;
    report_.closing = closed.value().report;
  }
  mesh_ = rounded_to_float(std::move(closed.value().mesh));
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

/// Takes out the triangles that cross and rings around them, more each time, and fills the holes.
/// Not where that would make more parts or cut much away, as with a tube that goes through itself.
void Mend::refill_crossings() {
  constexpr int kMostRings = 5;
  constexpr double kLeastFraction = 0.9;  // of the volume, which counts twice what lies in itself
  if (report_.verdict.self_intersections == 0) return;
  const double least_mm3 = kLeastFraction * report_.verdict.volume_mm3;
  const std::int64_t parts = report_.verdict.components;
  const TriangleMesh before = mesh_;
  for (int rings = 0; rings < kMostRings; ++rings) {
    mesh_ = before;
    std::vector<bool> goes(mesh_.triangles.size(), false);
    std::vector<bool> at_vertex(mesh_.positions.size(), false);
    for (const auto& [a, b] : self_intersections(mesh_, degenerate_triangles(mesh_))) {
      goes[a] = goes[b] = true;
    }
    for (int ring = 0; ring <= rings; ++ring) {
      for (std::size_t t = 0; t < goes.size(); ++t) {
        for (const std::uint32_t v : mesh_.triangles[t]) {
          if (goes[t]) at_vertex[v] = true;
        }
      }
      if (ring == rings) break;
      for (std::size_t t = 0; t < goes.size(); ++t) {
        const Triangle& c = mesh_.triangles[t];
        goes[t] = at_vertex[c[0]] || at_vertex[c[1]] || at_vertex[c[2]];
      }
    }
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < goes.size(); ++t) {
      if (!goes[t]) kept.push_back(mesh_.triangles[t]);
    }
    mesh_.triangles = std::move(kept);
    if (mesh_.triangles.empty() || !close()) break;
    if (!is_printable() || report_.verdict.components > parts) continue;
    if (report_.verdict.volume_mm3 >= least_mm3) return;
  }
  mesh_ = before;
}

/// All that changes no more than where the mesh is broken; the verdict says whether it did.
Result<void> Mend::mend() {
  if (auto on = go_on("mend", 0.0); !on) return on;
  report_.is_changed = true;
  join_seams();
  if (auto closed = close(); !closed) return closed;
  if (is_printable()) return {};
  report_.crossings = report_.verdict.self_intersections;
  if (auto on = go_on("mend", 0.3); !on) return on;
  if (!report_.verdict.manifold) {
    part_where_touching();
    if (is_printable()) return {};
  }
  // Crossings are mended pair by pair: where nobody counted them all, that is hopeless.
  if (report_.verdict.self_intersections == kMostCrossings) return {};
  if (auto on = go_on("mend", 0.5); !on) return on;
  report_.united_parts = unite_parts(mesh_);
  // What was made new is rounded to float, which may fold a few slivers.
  if (report_.united_parts > 0) report_.verdict = check_and_collapse_folded(mesh_);
  if (report_.verdict.printable) return {};
  if (auto on = go_on("mend", 0.8); !on) return on;
  refill_crossings();
  is_printable();
  return {};
}

Result<MendedMesh> Mend::run() {
  if (is_printable()) return MendedMesh{std::move(mesh_), std::move(report_)};
  const bool is_usable = !report_.verdict.marks.empty();
  if (!is_usable) {
    return Error{
        ErrorKind::bad_input,
        "the mesh has no triangles, or a vertex that is missing, not finite or beyond what "
        "a float holds (3.4e38); export it again"};
  }
  size_ = length(used_bounds(mesh_).size());
  if (auto mended = mend(); !mended) return mended.error();
  return MendedMesh{std::move(mesh_), std::move(report_)};
}

}  // namespace

Result<MendedMesh> mend_mesh(const TriangleMesh& mesh_mm, const Progress& progress) {
  return no_throw("repairing the mesh", [&] { return Mend(mesh_mm, progress).run(); });
}

}  // namespace argil::mesh
