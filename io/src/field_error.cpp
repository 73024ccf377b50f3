// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "argil/io/decimate.h"

#include "best_first.h"
#include "field_sampler.h"
#include "mesh_distance.h"
#include "no_throw.h"
#include "triangle_samples.h"

namespace argil::io {
namespace {

constexpr std::size_t kBlock = 2048;

/// Distances with the areas they stand for.
struct Sums {
  double area = 0.0;
  double distance = 0.0;
  double square = 0.0;
  double max = 0.0;

  void add(double d, double weight) noexcept {
    area += weight;
    distance += weight * d;
    square += weight * d * d;
    max = std::max(max, d);
  }
  void add(const Sums& s) noexcept {
    area += s.area;
    distance += s.distance;
    square += s.square;
    max = std::max(max, s.max);
  }
  DistanceSummary summary() const noexcept {
    const double least = std::numeric_limits<double>::min();
    return {max, distance / std::max(area, least), std::sqrt(square / std::max(area, least))};
  }
};

/// Runs `work(begin, end)` over blocks of fixed size in any order.
template <class Work>
void in_blocks(std::size_t count, const Work& work) {
  tbb::parallel_for(std::size_t{0}, (count + kBlock - 1) / kBlock, [&](std::size_t block) {
    work(block * kBlock, std::min(count, (block + 1) * kBlock));
  });
}

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

Vec3 middle(const Corners& c) noexcept { return (c[0] + c[1] + c[2]) / 3.0; }

/// |phi| over the mesh.
///
/// First the middles of parts 0.4 voxels long, and the vertices. phi is nearly linear over
/// a part: where |phi| plus all that it varies by between those places exceeds the greatest found
/// so far, the triangle is split in four, and so on down to an eighth of a voxel.
class MeshToField {
 public:
  /// `least_splits` of each side, other than those of the fit: where that looked, the error is
  /// small.
  MeshToField(const TriangleMesh& mesh, const Clay& clay, int least_splits)
      : mesh_(mesh), clay_(clay), least_splits_(least_splits) {}

  DistanceSummary measure(double bound_mm, std::vector<FarPlace>& far);

 private:
  struct Range {
    double low = 0.0;
    double high = 0.0;
    void include(double d) noexcept {
      low = std::min(low, d);
      high = std::max(high, d);
    }
    double worst() const noexcept { return std::max(-low, high); }
    double bound() const noexcept { return worst() + (high - low); }
  };

  void measure_vertices();
  Sums measure_triangles();
  /// The finest at its corners.
  double voxel_of(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return static_cast<double>(
        std::min({voxel_at_vertex_[a], voxel_at_vertex_[b], voxel_at_vertex_[c]}));
  }
  double refined(const Corners& c, const std::array<double, 3>& phi, double found, double voxel_mm,
                 FieldSampler& field) const;

  const TriangleMesh& mesh_;
  const Clay& clay_;
  int least_splits_;
  std::vector<float> at_vertex_;
  std::vector<float> voxel_at_vertex_;
  std::vector<float> worst_;
  std::vector<float> bound_;
};

void MeshToField::measure_vertices() {
  at_vertex_.resize(mesh_.positions.size());
  voxel_at_vertex_.resize(mesh_.positions.size());
  in_blocks(at_vertex_.size(), [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    for (std::size_t v = begin; v < end; ++v) {
      const FieldValue at = field.value(mesh_.positions[v]);
      at_vertex_[v] = static_cast<float>(at.distance_mm);
      voxel_at_vertex_[v] = static_cast<float>(at.voxel_mm);
    }
  });
}

Sums MeshToField::measure_triangles() {
  constexpr int kMostSplits = 64;
  const std::size_t count = mesh_.triangles.size();
  worst_.resize(count);
  bound_.resize(count);
  std::vector<Sums> blocks((count + kBlock - 1) / kBlock);
  in_blocks(count, [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = corners_of(mesh_, t);
      const double first = static_cast<double>(at_vertex_[mesh_.triangles[t][0]]);
      Range range{first, first};
      for (const std::uint32_t v : mesh_.triangles[t]) {
        range.include(static_cast<double>(at_vertex_[v]));
      }
      const int n = std::max(least_splits_,
                             splits_for(longest_side(a, b, c), 0.4 * voxel_of(t), kMostSplits));
      const double area = 0.5 * length(cross(b - a, c - a)) / (n * n);
      for_each_sample(n, [&](const std::array<double, 3>& w) {
        const double d = field.distance_mm(w[0] * a + w[1] * b + w[2] * c);
        range.include(d);
        blocks[begin / kBlock].add(std::abs(d), area);
      });
      blocks[begin / kBlock].max = std::max(blocks[begin / kBlock].max, range.worst());
      worst_[t] = static_cast<float>(range.worst());
      bound_[t] = static_cast<float>(range.bound());
    }
  });
  Sums total;
  for (const Sums& sums : blocks) total.add(sums);
  return total;
}

double MeshToField::refined(const Corners& c, const std::array<double, 3>& phi, double found,
                            double voxel_mm, FieldSampler& field) const {
  Range range{phi[0], phi[0]};
  range.include(phi[1]);
  range.include(phi[2]);
  range.include(field.distance_mm(middle(c)));
  found = std::max(found, range.worst());
  const double side = longest_side(c[0], c[1], c[2]);
  if (side < 0.125 * voxel_mm || (side < voxel_mm && range.bound() <= found)) return found;
  Corners m;
  std::array<double, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    m[k] = 0.5 * (c[k] + c[(k + 1) % 3]);
    at[k] = field.distance_mm(m[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t before = (k + 2) % 3;
    found = refined({c[k], m[k], m[before]}, {phi[k], at[k], at[before]}, found, voxel_mm, field);
  }
  return refined(m, at, found, voxel_mm, field);
}

DistanceSummary MeshToField::measure(double bound_mm, std::vector<FarPlace>& far) {
  measure_vertices();
  const Sums sums = measure_triangles();
  DistanceSummary summary = sums.summary();
  std::vector<std::uint8_t> beyond(mesh_.triangles.size(), 0);
  summary.max_mm = greatest_by_bound(bound_, sums.max, [&](std::uint32_t t, double found) {
    FieldSampler field(clay_);
    const Triangle& tri = mesh_.triangles[t];
    const auto phi = [&](std::size_t k) { return static_cast<double>(at_vertex_[tri[k]]); };
    const double most =
        refined(corners_of(mesh_, t), {phi(0), phi(1), phi(2)}, found, voxel_of(t), field);
    if (bound_mm > 0.0 && most > std::max(found, bound_mm)) beyond[t] = 1;
    return most;
  });
  for (std::size_t t = 0; t < beyond.size() && bound_mm > 0.0; ++t) {
    if (beyond[t] == 0 && static_cast<double>(worst_[t]) <= bound_mm) continue;
    const Corners c = corners_of(mesh_, t);
    far.push_back({middle(c), longest_side(c[0], c[1], c[2])});
  }
  return summary;
}

/// Distance of the places with phi = 0 from the mesh.
///
/// First the vertices of the extracted surface, led onto phi = 0. Between three of them the
/// distance is at most that of the farthest corner from the planes of the triangles nearest to the
/// corners, and how much phi = 0 bulges out of the flat triangle. Where that exceeds the greatest
/// distance found so far the triangle is split in four, and so on.
class FieldToMesh {
 public:
  FieldToMesh(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay)
      : mesh_(mesh),
        surface_(surface),
        clay_(clay),
        nearest_(mesh.positions, mesh.triangles),
        is_surface_(mesh.triangles == surface.triangles),
        voxel_mm_(clay.options().voxel_mm) {}

  DistanceSummary measure(double bound_mm, std::vector<FarPlace>& far);

 private:
  struct Place {
    Vec3 at;
    double distance = 0.0;
    std::uint32_t nearest = kNoTriangle;
    bool is_found = false;
  };

  Place place_near(const Vec3& p, std::uint32_t hint, FieldSampler& field) const;
  void measure_vertices();
  void add_triangle(std::size_t t, FieldSampler& field, Sums& sums) const;
  void add_own_triangle(std::size_t t, FieldSampler& field, Sums& sums) const;
  Sums sums() const;
  void bound_triangles(double found);
  double bound_of(const std::array<Place, 3>& c) const;
  double refined(const std::array<Place, 3>& c, double found, int depth, FieldSampler& field) const;
  std::array<Place, 3> places_of(std::size_t t) const;

  const TriangleMesh& mesh_;
  const TriangleMesh& surface_;
  const Clay& clay_;
  MeshDistance nearest_;
  bool is_surface_;  ///< but for rounding
  double voxel_mm_;
  std::vector<Place> at_vertex_;
  std::vector<float> bound_;
};

/// Where no place of the surface is found, `p` itself with no distance says nothing.
FieldToMesh::Place FieldToMesh::place_near(const Vec3& p, std::uint32_t hint,
                                           FieldSampler& field) const {
  const std::optional<Vec3> on = field.on_surface(p);
  const auto found =
      nearest_.closest(on.value_or(p), std::numeric_limits<double>::infinity(), hint);
  return {on.value_or(p), on ? found.distance : 0.0, found.triangle, on.has_value()};
}

void FieldToMesh::measure_vertices() {
  at_vertex_.resize(surface_.positions.size());
  in_blocks(at_vertex_.size(), [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    std::uint32_t hint = kNoTriangle;
    for (std::size_t v = begin; v < end; ++v) {
      at_vertex_[v] = place_near(surface_.positions[v], hint, field);
      hint = at_vertex_[v].nearest;
    }
  });
}

/// With weights 3/4 in the middle and 1/12 at the corners, exact for what is quadratic over a
/// triangle. Corners alone will not do: the cuts of lattice edges, which they are, lie nearer to
/// the surface that was sampled than phi = 0 does within the cells.
void FieldToMesh::add_triangle(std::size_t t, FieldSampler& field, Sums& sums) const {
  const Corners c = corners_of(surface_, t);
  const double area = 0.5 * length(cross(c[1] - c[0], c[2] - c[0]));
  const std::array<Place, 3> places = places_of(t);
  for (const Place& place : places) {
    if (place.is_found) sums.add(place.distance, area / 12.0);
  }
  const Place centre = place_near(middle(c), places[0].nearest, field);
  if (centre.is_found) sums.add(centre.distance, 0.75 * area);
}

/// Where the mesh is the surface itself both agree at the vertices, and the nearest triangle is the
/// place's own.
void FieldToMesh::add_own_triangle(std::size_t t, FieldSampler& field, Sums& sums) const {
  constexpr int kSplits = 2;
  const auto& [a, b, c] = corners_of(surface_, t);
  const Vec3 area_normal = cross(b - a, c - a);
  const Vec3 normal = normalized(area_normal);
  const double area = 0.5 * length(area_normal) / (kSplits * kSplits);
  for_each_sample(kSplits, [&](const std::array<double, 3>& w) {
    const Vec3 flat = w[0] * a + w[1] * b + w[2] * c;
    if (const auto on = field.on_surface(flat)) sums.add(std::abs(dot(normal, *on - flat)), area);
  });
  for (const Place& place : places_of(t)) sums.max = std::max(sums.max, place.distance);
}

/// Over every triangle, or every so many of them where there are more than the means need.
Sums FieldToMesh::sums() const {
  constexpr std::size_t kEnough = 200'000;
  const std::size_t count = surface_.triangles.size();
  const std::size_t stride = is_surface_ ? 1 : std::max<std::size_t>(1, count / kEnough);
  std::vector<Sums> blocks((count + kBlock - 1) / kBlock);
  in_blocks(count, [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    Sums& sums = blocks[begin / kBlock];
    for (std::size_t t = begin; t < end; ++t) {
      if (is_surface_) {
        add_own_triangle(t, field, sums);
      } else if (t % stride == 0) {
        add_triangle(t, field, sums);
      }
    }
  });
  Sums total;
  for (const Sums& sums : blocks) total.add(sums);
  for (const Place& place : at_vertex_) total.max = std::max(total.max, place.distance);
  return total;
}

std::array<FieldToMesh::Place, 3> FieldToMesh::places_of(std::size_t t) const {
  const auto& [a, b, c] = surface_.triangles[t];
  return {at_vertex_[a], at_vertex_[b], at_vertex_[c]};
}

/// Without the bulge: the distance from the plane of each of the triangles that are nearest, which
/// is linear in between, so that the corners have the greatest.
double FieldToMesh::bound_of(const std::array<Place, 3>& c) const {
  double most = std::max({c[0].distance, c[1].distance, c[2].distance});
  if (c[0].nearest == c[1].nearest && c[1].nearest == c[2].nearest) return most;
  for (const Place& of : c) {
    const Corners t = corners_of(mesh_, of.nearest);
    const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
    for (const Place& place : c) most = std::max(most, std::abs(dot(normal, place.at - t[0])));
  }
  return most;
}

void FieldToMesh::bound_triangles(double found) {
  // How far phi = 0 can bulge: a quarter of a side where it bends by a right angle.
  constexpr double kMostBulge = 0.3;
  constexpr double kBulgeMargin = 1.5;
  bound_.resize(surface_.triangles.size());
  in_blocks(bound_.size(), [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    for (std::size_t t = begin; t < end; ++t) {
      const std::array<Place, 3> c = places_of(t);
      double bound = bound_of(c);
      if (bound + kMostBulge * longest_side(c[0].at, c[1].at, c[2].at) > found) {
        const FieldValue at = field.value(middle({c[0].at, c[1].at, c[2].at}));
        bound += kBulgeMargin * std::abs(at.distance_mm) / std::max(0.25, length(at.gradient));
      }
      bound_[t] = static_cast<float>(bound);
    }
  });
}

double FieldToMesh::refined(const std::array<Place, 3>& c, double found, int depth,
                            FieldSampler& field) const {
  constexpr int kDeepest = 4;
  for (const Place& place : c) found = std::max(found, place.distance);
  const Vec3 flat = middle({c[0].at, c[1].at, c[2].at});
  const Place centre = place_near(flat, c[0].nearest, field);
  found = std::max(found, centre.distance);
  if (bound_of(c) + 1.5 * length(centre.at - flat) <= found || depth == kDeepest) return found;
  std::array<Place, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    m[k] = place_near(0.5 * (c[k].at + c[(k + 1) % 3].at), c[k].nearest, field);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    found = refined({c[k], m[k], m[(k + 2) % 3]}, found, depth + 1, field);
  }
  return refined(m, found, depth + 1, field);
}

DistanceSummary FieldToMesh::measure(double bound_mm, std::vector<FarPlace>& far) {
  measure_vertices();
  const Sums found_first = sums();
  DistanceSummary summary = found_first.summary();
  bound_triangles(found_first.max);
  std::vector<std::uint8_t> beyond(surface_.triangles.size(), 0);
  summary.max_mm = greatest_by_bound(bound_, found_first.max, [&](std::uint32_t t, double found) {
    FieldSampler field(clay_);
    const double most = refined(places_of(t), found, 0, field);
    if (bound_mm > 0.0 && most > std::max(found, bound_mm)) beyond[t] = 1;
    return most;
  });
  for (std::size_t t = 0; t < beyond.size() && bound_mm > 0.0; ++t) {
    const std::array<Place, 3> c = places_of(t);
    const double worst = std::max({c[0].distance, c[1].distance, c[2].distance});
    if (beyond[t] != 0 || worst > bound_mm) far.push_back({c[0].at, worst + 2.0 * voxel_mm_});
  }
  return summary;
}

}  // namespace

MeshError field_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                      double bound_mm, std::vector<FarPlace>& far) {
  MeshError error;
  const int least_splits = mesh.triangles == surface.triangles ? 2 : 5;
  error.mesh_to_field = MeshToField(mesh, clay, least_splits).measure(bound_mm, far);
  error.field_to_mesh = FieldToMesh(mesh, surface, clay).measure(bound_mm, far);
  return error;
}

Result<MeshError> measure_error(const TriangleMesh& mesh, const TriangleMesh& surface,
                                const Clay& clay) {
  return no_throw("measuring the error", [&]() -> Result<MeshError> {
    if (mesh.triangles.empty() || surface.triangles.empty()) {
      return Error{ErrorKind::bad_input, "there are no triangles to measure; give a mesh"};
    }
    std::vector<FarPlace> ignored;
    return field_error(mesh, surface, clay, 0.0, ignored);
  });
}

}  // namespace argil::io
