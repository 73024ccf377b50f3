// SPDX-License-Identifier: GPL-3.0-or-later
// What an import lost, filled, added or fused, by sampling both ways. Some thousand points are
// enough to notice a limb or a gap; they are no bound of the error.
#include "argil/io/import_comparison.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/core/winding_number.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/mesh_distance.h"
#include "argil/io/body_parts.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

constexpr std::size_t kComparedTriangles = 2000;

struct ComparedPoint {
  Vec3 at;
  Vec3 normal;
  std::size_t triangle = 0;
};

/// Calls `use(ComparedPoint)` with corners of some triangles and the middles of parts of them, of
/// about as much area each where there are few triangles.
template <class Use>
void for_each_compared_point(const TriangleMesh& mesh, const Use& use) {
  const std::size_t count = mesh.triangles.size();
  const std::size_t compared = std::min(count, kComparedTriangles);
  const double part_mm2 = surface_area(mesh) / kComparedTriangles;
  for (std::size_t n = 0; n < compared; ++n) {
    const std::size_t t = n * count / compared;
    const mesh::Corners c = mesh::corners_of(mesh, t);
    const Vec3 twice = cross(c[1] - c[0], c[2] - c[0]);
    if (twice == Vec3{}) continue;
    const Vec3 normal = normalized(twice);
    const double splits = std::sqrt(0.5 * length(twice) / part_mm2);
    mesh::for_each_sample(std::max(1, static_cast<int>(splits)),
                          [&](const std::array<double, 3>& w) {
                            use(ComparedPoint{w[0] * c[0] + w[1] * c[1] + w[2] * c[2], normal, t});
                          });
    for (const Vec3& corner : c) use(ComparedPoint{corner, normal, t});
  }
}

/// Without triangles that enclose nothing, whatever they point to.
Box3 bounds_of_area(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const mesh::Corners c = mesh::corners_of(mesh, t);
    if (cross(c[1] - c[0], c[2] - c[0]) == Vec3{}) continue;
    for (const Vec3& corner : c) box.include(corner);
  }
  return box;
}

/// Parts that face outward and are larger than a speck.
std::int64_t count_bodies(const TriangleMesh& mesh, double least_mm3) {
  const std::vector<double> volumes =
      mesh::part_volumes(mesh, mesh::mesh_parts(mesh, mesh::EdgeTable(mesh), false));
  return std::count_if(volumes.begin(), volumes.end(),
                       [&](double volume) { return volume >= least_mm3; });
}

double outside_of(double value, double a, double b) {
  return std::max({0.0, std::min(a, b) - value, value - std::max(a, b)});
}

void take_farther(const Vec3& at, double distance, MeasuredPoint& farthest) {
  if (distance > farthest.distance_mm) farthest = {at, distance};
}

/// Whether both sides of the surface come within `reach_mm` of a point.
bool has_surface_near(FieldSampler& field, const Vec3& point, double reach_mm) {
  constexpr int kSteps = 3;
  const bool is_inside = field.distance_mm(point) <= 0.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      for (int k = -kSteps; k <= kSteps; ++k) {
        if (i * i + j * j + k * k > kSteps * kSteps) continue;
        const Vec3 aside = (reach_mm / kSteps) * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        if ((field.distance_mm(point + aside) <= 0.0) != is_inside) return true;
      }
    }
  }
  return false;
}

class ImportComparing {
 public:
  ImportComparing(const PreparedMesh& prepared, const Clay& clay, const TriangleMesh& surface,
                  bool is_bridged)
      : prepared_(prepared),
        clay_(clay),
        surface_(surface),
        is_bridged_(is_bridged),
        voxel_mm_(clay.options().voxel_mm),
        most_mm_(ImportComparison::kMostVoxelsOff * voxel_mm_) {}

  ImportComparison run();

 private:
  /// The mesh with what a repair added, where it did.
  const TriangleMesh& expected() const {
    return prepared_.closing.holes_closed > 0 ? prepared_.mesh : prepared_.given;
  }
  double winding_at(const Vec3& point);
  bool is_inner_wall(const ComparedPoint& point);
  bool is_bridge(const Vec3& point);
  void compare_volumes();
  void compare_boxes();
  void compare_bodies();
  void measure_mesh();
  void measure_point(const ComparedPoint& point, FieldSampler& field);
  void measure_surface();
  std::vector<TriangleMesh> parts_of_mesh();
  std::uint32_t body_around(const TriangleMesh& part,
                            const std::vector<std::uint32_t>& bodies) const;
  void find_fused();
  void say_all_is_lost();

  const PreparedMesh& prepared_;
  const Clay& clay_;
  const TriangleMesh& surface_;
  const bool is_bridged_;
  const double voxel_mm_;
  const double most_mm_;
  std::optional<WindingNumber> winding_;  ///< of the mesh, once it was asked for
  std::optional<MeshDistance> clay_at_;   ///< the clay's surface, likewise
  ImportComparison found_;
};

double ImportComparing::winding_at(const Vec3& point) {
  if (!winding_) winding_.emplace(prepared_.mesh.positions, prepared_.mesh.triangles);
  return winding_->at(point);
}

/// Whether the mesh itself has solid on both sides. Gaps that the import counts as closed are none
/// (docs/import.md, "Walls").
bool ImportComparing::is_inner_wall(const ComparedPoint& point) {
  constexpr double kClosedGapVoxels = 0.05;
  constexpr double kInside = 0.5;
  const Vec3 aside = (kClosedGapVoxels * voxel_mm_) * point.normal;
  return winding_at(point.at + aside) > kInside && winding_at(point.at - aside) > kInside;
}

/// Whether what is open was bridged there: where the winding number is a half.
bool ImportComparing::is_bridge(const Vec3& point) {
  constexpr double kDoubtful = 0.25;  // as ImportReport::bridged_nodes
  return is_bridged_ && std::abs(winding_at(point) - 0.5) < kDoubtful;
}

void ImportComparing::compare_volumes() {
  constexpr double kVoxelFraction = 0.1;
  constexpr double kLeastMargin = 0.005;
  constexpr double kMostMargin = 0.05;
  found_.volume_mm3 = signed_volume(surface_);
  found_.given_volume_mm3 = prepared_.given_volume_mm3;
  if (!found_.given_volume_mm3) return;
  // Rounded edges change the volume by some tenth of a voxel over the whole area.
  const double skin_mm3 = kVoxelFraction * voxel_mm_ * surface_area(prepared_.given);
  const double fraction = skin_mm3 / std::max(*found_.given_volume_mm3, skin_mm3);
  found_.volume_margin = std::clamp(fraction, kLeastMargin, kMostMargin);
}

void ImportComparing::compare_boxes() {
  const Box3 made = bounds(surface_);
  const Box3 given = bounds_of_area(prepared_.given);
  const Box3 repaired = bounds_of_area(expected());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found_.extent_off_mm = std::max(
        {found_.extent_off_mm, outside_of(made.min[axis], given.min[axis], repaired.min[axis]),
         outside_of(made.max[axis], given.max[axis], repaired.max[axis])});
  }
}

void ImportComparing::compare_bodies() {
  // Smaller parts are specks of extraction, not bodies.
  const double speck_mm3 = voxel_mm_ * voxel_mm_ * voxel_mm_;
  found_.bodies = count_bodies(surface_, speck_mm3);
  if (prepared_.closing.closed) found_.given_bodies = count_bodies(prepared_.mesh, speck_mm3);
}

/// Most points have the surface before them. The field itself tells no distance there: of a gap or
/// a sheet that no node hit, the nodes around still say that it is near.
void ImportComparing::measure_point(const ComparedPoint& point, FieldSampler& field) {
  MeasuredPoint& farthest = field.distance_mm(point.at) > 0.0 ? found_.lost : found_.filled;
  const auto on = field.on_surface(point.at);
  const double distance_mm = on ? length(*on - point.at) : std::numeric_limits<double>::infinity();
  if (distance_mm <= most_mm_) return take_farther(point.at, distance_mm, farthest);
  if (has_surface_near(field, point.at, most_mm_)) return;
  if (&farthest == &found_.filled && is_inner_wall(point)) {
    found_.has_inner_walls = true;
    return;
  }
  if (!clay_at_) clay_at_.emplace(surface_.positions, surface_.triangles);
  const auto closest = clay_at_->closest(point.at, std::numeric_limits<double>::infinity());
  take_farther(point.at, closest.distance, farthest);
}

void ImportComparing::measure_mesh() {
  FieldSampler field(clay_);
  for_each_compared_point(prepared_.given,
                          [&](const ComparedPoint& point) { measure_point(point, field); });
}

void ImportComparing::measure_surface() {
  const MeshDistance mesh(expected().positions, expected().triangles);
  const std::size_t count = surface_.triangles.size();
  const std::size_t compared = std::min(count, kComparedTriangles);
  for (std::size_t n = 0; n < compared; ++n) {
    const Vec3 at = mesh::middle(mesh::corners_of(surface_, n * count / compared));
    const double distance = mesh.closest(at, std::numeric_limits<double>::infinity()).distance;
    if (distance > most_mm_ && is_bridge(at)) continue;
    take_farther(at, distance, found_.added);
  }
}

/// The parts that the file names, else the bodies of the mesh.
std::vector<TriangleMesh> ImportComparing::parts_of_mesh() {
  const TriangleMesh& mesh = prepared_.given;
  if (!prepared_.part_names.empty()) {
    found_.part_names = prepared_.part_names;
    return mesh::split_mesh(mesh, prepared_.part_of);
  }
  std::vector<TriangleMesh> bodies = mesh::split_mesh(mesh, bodies_of(mesh));
  for (std::size_t n = 1; n <= bodies.size(); ++n) {
    found_.part_names.push_back("body " + std::to_string(n));
  }
  return bodies;
}

/// The body of the clay's surface that most of some corners of a part are nearest to.
std::uint32_t ImportComparing::body_around(const TriangleMesh& part,
                                           const std::vector<std::uint32_t>& bodies) const {
  constexpr std::size_t kAsked = 15;
  std::map<std::uint32_t, int> votes;
  const std::size_t count = std::min(kAsked, part.triangles.size());
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3 at = mesh::middle(mesh::corners_of(part, n * part.triangles.size() / count));
    const auto closest = clay_at_->closest(at, std::numeric_limits<double>::infinity());
    ++votes[bodies[closest.triangle]];
  }
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Of the pairs that are near, those whose parts have become one body. Nothing has fused where
/// bodies without names meet in the mesh itself.
void ImportComparing::find_fused() {
  constexpr double kReachVoxels = 2.0;
  const std::vector<TriangleMesh> parts = parts_of_mesh();
  if (parts.size() > mesh::kMostParts) return;
  const Progress none;
  const std::vector<mesh::PartGap> gaps =
      mesh::part_gaps(parts, kReachVoxels * voxel_mm_, Pace(none, "gaps"));
  if (gaps.empty()) return;
  if (!clay_at_) clay_at_.emplace(surface_.positions, surface_.triangles);
  const std::vector<std::uint32_t> bodies = mesh::mesh_bodies(surface_).of_triangle;
  std::vector<std::uint32_t> body_of;
  for (const TriangleMesh& part : parts) body_of.push_back(body_around(part, bodies));
  for (const mesh::PartGap& gap : gaps) {
    const bool is_meant = prepared_.part_names.empty() && gap.meet();
    if (body_of[gap.a] == body_of[gap.b] && !is_meant) found_.fused.push_back(gap);
  }
}

/// Of a sheet or a plate so thin that no node came to lie in it.
void ImportComparing::say_all_is_lost() {
  const Box3 given = bounds_of_area(prepared_.given);
  const Vec3 sides = given.max - given.min;
  found_.extent_off_mm = std::max({sides.x, sides.y, sides.z});
  found_.lost = {0.5 * (given.min + given.max), found_.extent_off_mm};
}

ImportComparison ImportComparing::run() {
  assert(is_in_reach(mesh::used_bounds(prepared_.given).min) &&
         is_in_reach(mesh::used_bounds(prepared_.given).max));
  compare_volumes();
  if (surface_.triangles.empty()) {
    say_all_is_lost();
    return found_;
  }
  compare_boxes();
  compare_bodies();
  measure_mesh();
  measure_surface();
  const auto parts = static_cast<std::int64_t>(prepared_.part_names.size());
  if (found_.bodies < std::max(parts, found_.given_bodies.value_or(0))) find_fused();
  if (found_.fused.empty()) found_.part_names.clear();
  return found_;
}

}  // namespace

Result<ImportComparison> compare_import(const PreparedMesh& prepared, const Clay& clay,
                                        const TriangleMesh& surface, bool is_bridged) {
  return no_throw("comparing the clay with the mesh", [&]() -> Result<ImportComparison> {
    return ImportComparing(prepared, clay, surface, is_bridged).run();
  });
}

}  // namespace argil::io
