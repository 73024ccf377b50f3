// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"

#include "mesh_compact.h"
#include "mesh_edges.h"
#include "mesh_mend.h"
#include "mesh_proof.h"
#include "mesh_seams.h"
#include "mesh_union.h"
#include "mesh_write.h"
#include "nearest_point.h"
#include "no_throw.h"

namespace argil::io {
namespace {

/// Of the diagonal, between surfaces that only touched: a micrometre on 100 mm, a hundred steps of
/// float.
constexpr double kGap = 1e-5;
constexpr double kVoxelsAlong = 512.0;

class Repair {
 public:
  Repair(const TriangleMesh& input, const RepairOptions& options, const Progress& progress)
      : input_(rounded_to_float(input)), options_(options), progress_(progress), mesh_(input_) {
    mesh_.normals.clear();
  }

  Result<RepairedMesh> run();

 private:
  Result<void> go_on(std::string_view stage, double fraction) const {
    if (!progress_ || progress_(stage, fraction)) return {};
    return Error{ErrorKind::interrupted, "interrupted while repairing a mesh"};
  }
  bool is_printable() {
    report_.verdict = check_mesh(mesh_);
    return report_.verdict.printable;
  }
  /// Of the way through the field.
  double voxel_mm() const {
    if (options_.voxel_mm > 0.0) return options_.voxel_mm;
    const Vec3 sides = used_bounds(input_).size();
    const double usual = std::max({sides.x, sides.y, sides.z}) / kVoxelsAlong;
    return std::clamp(usual, kLeastVoxelMm, kMostVoxelMm);
  }
  void join_seams();
  Result<void> close();
  void part_where_touching();
  void refill_crossings();
  void judge_slivers();
  Result<void> mend();
  Result<void> make_anew();
  void measure_change();

  const TriangleMesh input_;
  const RepairOptions& options_;
  const Progress& progress_;
  TriangleMesh mesh_;
  double size_ = 0.0;  ///< of the box of what triangles name
  RepairReport report_;
};

void Repair::join_seams() {
  double near = kNearRims * size_;
  mesh_ = compacted(mesh_);
  const std::size_t given = mesh_.positions.size();
  mesh_ = welded(mesh_);  // a soup of loose triangles would be all rims
  report_.joined_vertices += static_cast<std::int64_t>(given - mesh_.positions.size());
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  const RimsJoined joined = join_rims_as_needed(mesh_, near, kFarRims * size_);
  near = std::max(near, joined.near_mm);
  report_.joined_vertices += joined.vertices > 0 ? joined.vertices : join_rims(mesh_, near);
  report_.closing.dropped_triangles += drop_repeated(mesh_);
  constexpr int kMostPasses = 16;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::int64_t split = split_at_rims(mesh_, near);
    report_.split_edges += split;
    if (split == 0) break;
  }
  report_.dropped_fins = drop_fins(mesh_);
}

/// The first closing is the one that is told of; a later one closes what was opened on the way.
Result<void> Repair::close() {
  auto closed = close_mesh(mesh_);
  if (!closed) return closed.error();
  if (report_.closing.parts == 0) {
    closed.value().report.dropped_triangles += report_.closing.dropped_triangles;
    report_.closing = closed.value().report;
  }
  mesh_ = rounded_to_float(std::move(closed.value().mesh));
  return {};
}

void Repair::part_where_touching() {
  const double gap = kGap * size_;
  const std::int64_t parted = part_touching(mesh_, gap);
  if (parted <= 0) return;
  report_.parted_vertices = parted;
  report_.gap_mm = gap;
  mesh_ = rounded_to_float(std::move(mesh_));
}

/// Takes out the triangles that cross and rings around them, more each time, and fills the holes.
/// Not where that would make more parts or cut much away, as with a tube that goes through itself.
void Repair::refill_crossings() {
  constexpr int kMostRings = 5;
  constexpr double kLeastShare = 0.9;  // of the volume, which counts twice what lies in itself
  if (report_.verdict.self_intersections == 0) return;
  const double least_mm3 = kLeastShare * report_.verdict.volume_mm3;
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

/// What was made new is rounded to float, which may fold a few slivers.
void Repair::judge_slivers() {
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds && !is_printable(); ++round) {
    if (collapse_folded(mesh_) == 0) return;
  }
}

/// All that changes no more than where the mesh is broken; the verdict says whether it did.
Result<void> Repair::mend() {
  if (auto on = go_on("mend", 0.0); !on) return on;
  report_.way = RepairWay::local;
  join_seams();
  if (auto closed = close(); !closed) return closed;
  if (is_printable()) return {};
  report_.crossings = report_.verdict.self_intersections;
  if (auto on = go_on("mend", 0.3); !on) return on;
  if (!report_.verdict.manifold) {
    part_where_touching();
    if (is_printable()) return {};
  }
  // Crossings are mended pair by pair: where nobody counted them all, the field is the way.
  if (report_.verdict.self_intersections == kMostCrossings) return {};
  if (auto on = go_on("mend", 0.5); !on) return on;
  report_.united_parts = unite_parts(mesh_);
  if (report_.united_parts > 0) judge_slivers();
  if (report_.verdict.printable) return {};
  if (auto on = go_on("mend", 0.8); !on) return on;
  refill_crossings();
  is_printable();
  return {};
}

/// Whether all triangles lie in the plane of the largest, so that nothing is inside.
bool is_flat(const TriangleMesh& mesh) {
  constexpr double kMostOff = 1e-9;  // of the diagonal
  Vec3 normal;
  Vec3 origin;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.positions[a];
    const Vec3 twice = cross(mesh.positions[b] - p, mesh.positions[c] - p);
    if (length(twice) <= length(normal)) continue;
    normal = twice;
    origin = p;
  }
  normal = normalized(normal);
  const double most = kMostOff * length(used_bounds(mesh).size());
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return std::abs(dot(mesh.positions[v] - origin, normal)) <= most;
    });
  });
}

Result<void> Repair::make_anew() {
  if (is_flat(mesh_)) {
    return Error{ErrorKind::bad_input,
                 "the mesh is flat: it encloses nothing; give it a thickness where it was made"};
  }
  const double voxel = voxel_mm();
  auto imported = import_mesh(mesh_, {.voxel_mm = voxel}, progress_);
  if (!imported) return imported.error();
  report_.way = RepairWay::field;
  report_.voxel_mm = voxel;
  mesh_ = extract_surface(imported.value().clay);
  mesh_.normals.clear();
  mesh_ = rounded_to_float(std::move(mesh_));
  judge_slivers();
  return {};
}

/// Corners by their places, the first one the least, so that equal triangles compare equal.
std::array<std::array<double, 3>, 3> places_of(const TriangleMesh& mesh, const Triangle& t) {
  std::array<std::array<double, 3>, 3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = mesh.positions[t[k]];
    places[k] = {p.x, p.y, p.z};
  }
  std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
  return places;
}

void Repair::measure_change() {
  std::vector<std::array<std::array<double, 3>, 3>> before;
  before.reserve(input_.triangles.size());
  for (const Triangle& t : input_.triangles) before.push_back(places_of(input_, t));
  std::sort(before.begin(), before.end());
  std::vector<bool> is_kept(mesh_.positions.size(), false);
  for (const Triangle& t : mesh_.triangles) {
    if (!std::binary_search(before.begin(), before.end(), places_of(mesh_, t))) continue;
    ++report_.kept_triangles;
    for (const std::uint32_t v : t) is_kept[v] = true;
  }
  std::vector<Vec3> moved;
  for (const Triangle& t : mesh_.triangles) {
    for (const std::uint32_t v : t) {
      if (is_kept[v]) continue;
      is_kept[v] = true;
      moved.push_back(mesh_.positions[v]);
    }
  }
  report_.max_change_mm = farthest_from(input_, moved);
}

Result<RepairedMesh> Repair::run() {
  if (!is_printable()) {
    const bool is_usable = !report_.verdict.marks.empty();
    if (!is_usable) {
      return Error{
          ErrorKind::bad_input,
          "the mesh has no triangles, or a vertex that is missing, not finite or beyond what "
          "a float holds (3.4e38); export it again"};
    }
    size_ = length(used_bounds(mesh_).size());
    if (auto mended = mend(); !mended) return mended.error();
  }
  if (!report_.verdict.printable) {
    if (auto made = make_anew(); !made) return made.error();
  }
  measure_change();
  return RepairedMesh{std::move(mesh_), std::move(report_)};
}

}  // namespace

Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh_mm, const RepairOptions& options,
                                 const Progress& progress) {
  if (!(options.voxel_mm >= 0.0)) {
    return Error{ErrorKind::bad_input, "the voxel is " + std::to_string(options.voxel_mm) +
                                           " mm; must be greater than 0, or 0 for the usual one"};
  }
  return no_throw("repairing the mesh", [&] { return Repair(mesh_mm, options, progress).run(); });
}

}  // namespace argil::io
