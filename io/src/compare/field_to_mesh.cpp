// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/field_to_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "argil/core/closest_on_triangle.h"

#include "compare/best_first.h"

namespace argil::io {
namespace {

/// The sides of a box.
constexpr double kSides[] = {0.0, 1.0};

/// Four lines a cell, shifted from cell to cell: what repeats in step with the lattice, such as an
/// edge of a block or the vertices of a mesh, is met everywhere alike.
std::array<double, 4> mean_lines(std::size_t cell) {
  constexpr double kGolden = 0.6180339887498949;
  const double turns = kGolden * static_cast<double>(cell);
  const double shift = turns - std::floor(turns);
  return {0.25 * shift, 0.25 * (shift + 1.0), 0.25 * (shift + 2.0), 0.25 * (shift + 3.0)};
}

}  // namespace

FieldToMesh::FieldToMesh(const TriangleMesh& mesh, ExtractedSurface& surface)
    : mesh_(mesh),
      extracted_(surface),
      surface_(surface.mesh()),
      is_surface_(mesh.triangles == surface.mesh().triangles),
      voxel_mm_(surface.voxel_mm()) {}

void FieldToMesh::find_nearest(const Pace& pace) {
  if (is_surface_) {
    runs_.emplace(mesh_, pace);
  } else {
    nearest_.emplace(mesh_.positions, mesh_.triangles);
  }
}

FieldToMesh::Cell FieldToMesh::cell(std::uint32_t number) const {
  const SurfaceCell& cell = extracted_.cells()[number];
  return {number, cell.low_mm(voxel_mm_), cell.side_mm(voxel_mm_), Trilinear(cell.corners)};
}

/// How far the nearest point of the mesh is, or one nearer than `enough`. Where the mesh is the
/// surface it is on a triangle of the cell, or beside it where vertices were moved aside.
FieldToMesh::Sample FieldToMesh::sample_at(const Vec3& at, const Cell& cell, std::uint32_t hint,
                                           double enough) const {
  if (!is_surface_) {
    const auto found = nearest_->closest(at, std::numeric_limits<double>::infinity(), hint);
    return {at, found.distance, found.triangle};
  }
  TriangleRuns::Closest known{std::numeric_limits<double>::infinity(), kNoTriangle};
  const SurfaceCell& in = extracted_.cells()[cell.number];
  for (std::uint32_t t = in.first; t < in.first + in.count; ++t) {
    const auto& [a, b, c] = mesh::corners_of(mesh_, t);
    const double distance = length(at - closest_on_triangle(at, a, b, c));
    if (distance < known.distance) known = {distance, t};
  }
  if (known.distance > enough) known = runs_->closest(at, known);
  return {at, known.distance, known.triangle};
}

bool FieldToMesh::is_left_out(const Vec3& fraction, const Cell& cell) const {
  return extracted_.is_left_out(cell.number, fraction, 0.0);
}

/// Where phi = 0 near a vertex of the surface, which lies on a side of a cell but for rounding and
/// where it was moved aside to keep triangles from vanishing.
FieldToMesh::Sample FieldToMesh::sample_at_vertex(std::uint32_t v, std::uint32_t hint,
                                                  FieldSampler& field) const {
  const Vec3& p = surface_.positions[v];
  const std::optional<Vec3> on_surface = field.on_surface(p);
  const Vec3 at = on_surface.value_or(p);
  if (is_surface_) return {at, length(at - mesh_.positions[v]), hint};
  const auto found = nearest_->closest(at, std::numeric_limits<double>::infinity(), hint);
  return {at, on_surface ? found.distance : 0.0, found.triangle};
}

void FieldToMesh::measure_vertices(const Pace& pace) {
  at_vertex_.resize(surface_.positions.size());
  in_blocks(at_vertex_.size(), pace, [&](std::size_t begin, std::size_t end) {
    FieldSampler field(extracted_.clay());
    std::uint32_t hint = kNoTriangle;
    for (std::size_t v = begin; v < end; ++v) {
      at_vertex_[v] = sample_at_vertex(static_cast<std::uint32_t>(v), hint, field);
      hint = at_vertex_[v].nearest;
    }
  });
}

/// Without the bulge: the distance from the plane of each of the triangles that are nearest, which
/// is linear in between, so that the corners have the greatest.
double FieldToMesh::bound_of(const std::vector<Sample>& points) const {
  assert(!points.empty());
  double most = 0.0;
  for (const Sample& p : points) most = std::max(most, p.distance);
  std::uint32_t before = points.front().nearest;
  for (std::size_t i = 0; i < points.size() && !is_surface_; ++i) {
    const std::uint32_t of = points[i].nearest;
    if (i > 0 && of == before) continue;
    before = of;
    const mesh::Corners t = mesh::corners_of(mesh_, of);
    const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
    for (const Sample& p : points) most = std::max(most, std::abs(dot(normal, p.at - t[0])));
  }
  return most;
}

namespace {

/// At a right angle up to 0.71 of a side, where the edge of a block runs along a side of the box.
constexpr double kMostBulge = 0.75;

/// How far phi = 0 can bulge out between the sides of a box: as far as an edge between planes with
/// the widest angle of its normals does.
class Bulge {
 public:
  void add(const Vec3& normal) {
    for (const Vec3& n : normals_) least_ = std::min(least_, dot(n, normal));
    normals_.push_back(normal);
  }
  double fraction() const noexcept {
    // The tangent of half the angle.
    return least_ <= 0.0 ? kMostBulge : kMostBulge * std::sqrt((1.0 - least_) / (1.0 + least_));
  }

 private:
  std::vector<Vec3> normals_;
  double least_ = 1.0;
};

/// The same without asking where phi = 0: by the widest angle of the gradients that a cell can
/// have, each component of which lies between the differences along its four edges.
double most_bulge(const std::array<float, 8>& corners) noexcept {
  Vec3 middle;
  Vec3 half;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = std::size_t{4} >> axis;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      if ((corner & step) != 0) continue;
      const double slope =
          static_cast<double>(corners[corner + step]) - static_cast<double>(corners[corner]);
      low = std::min(low, slope);
      high = std::max(high, slope);
    }
    middle[axis] = 0.5 * (low + high);
    half[axis] = 0.5 * (high - low);
  }
  // Seen from 0 the ball around the box of gradients has this sine of half its angle, squared.
  const double square = dot(middle, middle);
  const double sine2 = square > 0.0 ? dot(half, half) / square : 1.0;
  return sine2 >= 0.5 ? kMostBulge : kMostBulge * std::sqrt(sine2 / (1.0 - sine2));
}

}  // namespace

double FieldToMesh::bound_at_vertices(const Cell& cell) const {
  const SurfaceCell& in = extracted_.cells()[cell.number];
  std::vector<Sample> points;
  double most = 0.0;
  const auto add = [&](const Sample& sample) {
    most = std::max(most, sample.distance);
    if (!is_surface_) points.push_back(sample);
  };
  for (std::uint32_t t = in.first; t < in.first + in.count; ++t) {
    for (const std::uint32_t v : surface_.triangles[t]) add(at_vertex_[v]);
  }
  if (!has_all_vertices(in, surface_)) {
    const std::uint32_t hint = at_vertex_[surface_.triangles[in.first][0]].nearest;
    for_each_zero(cell.phi, {}, 1.0, kSides, [&](const FieldZero& zero) {
      if (!is_left_out(zero.fraction, cell))
        add(sample_at(cell.at(zero.fraction), cell, hint, 0.0));
    });
  }
  return is_surface_ ? most : bound_of(points);
}

/// What a cell has of the means.
void FieldToMesh::add_cell(const Cell& cell, std::size_t turn, std::uint32_t& hint,
                           DistanceSums& sums) const {
  const double spacing = 0.25 * cell.side_mm;
  for_each_zero(cell.phi, {}, 1.0, mean_lines(turn), [&](const FieldZero& zero) {
    if (is_left_out(zero.fraction, cell)) return;
    // Neighbours need not be searched for less: it is neither the greatest distance nor, at a
    // twentieth of a cell, much of the mean.
    const double enough = std::min(sums.max, 0.05 * cell.side_mm);
    const Sample found = sample_at(cell.at(zero.fraction), cell, hint, enough);
    hint = found.nearest;
    const Vec3& n = zero.normal;
    const double shown = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    // The sum is 1 at least for a unit normal; where phi is level the normal is zero.
    sums.add(found.distance, spacing * spacing / std::max(1.0, shown));
  });
}

/// Bounds every cell; means are over every cell, or every so many of them where there are more than
/// they need.
DistanceSums FieldToMesh::measure_cells(const Pace& pace) {
  assert(at_vertex_.size() == surface_.positions.size());
  constexpr std::size_t kEnough = 50'000;
  const std::size_t count = extracted_.cells().size();
  const std::size_t stride = std::max<std::size_t>(1, count / kEnough);
  bound_.assign(count, 0.0F);
  std::vector<DistanceSums> blocks(block_count(count));
  in_blocks(count, pace, [&](std::size_t begin, std::size_t end) {
    DistanceSums& sums = blocks[begin / kDistanceBlock];
    std::uint32_t hint = kNoTriangle;
    for (std::size_t c = begin; c < end; ++c) {
      const Cell at = cell(static_cast<std::uint32_t>(c));
      const double bulge = most_bulge(extracted_.cells()[c].corners) * at.side_mm;
      bound_[c] = rounded_up(bound_at_vertices(at) + bulge);
      if (c % stride == 0) add_cell(at, c / stride, hint, sums);
    }
  });
  DistanceSums total;
  for (const DistanceSums& sums : blocks) total.add(sums);
  for (std::size_t v = 0; v < at_vertex_.size() && !is_surface_; ++v) {
    total.max = std::max(total.max, at_vertex_[v].distance);
  }
  return total;
}

/// The greatest distance in a cell, if it exceeds `found`.
double FieldToMesh::greatest_in(std::uint32_t number, double found) const {
  const Cell at = cell(number);
  Bulge bulge;
  for_each_zero(at.phi, {}, 1.0, kSides, [&](const FieldZero& zero) { bulge.add(zero.normal); });
  if (bound_at_vertices(at) + bulge.fraction() * at.side_mm <= found) return found;
  return refined(at, {}, 1.0, found);
}

/// The greatest distance in the box of the cell from `low` to `low + side`, as fractions of the
/// cell.
double FieldToMesh::refined(const Cell& cell, const Vec3& low, double side, double found) const {
  // What can then be missed is 0.012 of a cell, kMostBulge of such a side.
  constexpr double kLeastSide = 1.0 / 64.0;
  std::vector<Sample> points;
  Bulge bulge;
  const std::uint32_t hint =
      at_vertex_[surface_.triangles[extracted_.cells()[cell.number].first][0]].nearest;
  const auto add = [&](const Vec3& fraction) {
    if (is_left_out(fraction, cell)) return false;
    points.push_back(sample_at(cell.at(fraction), cell, hint, found));
    return true;
  };
  for_each_zero(cell.phi, low, side, kSides, [&](const FieldZero& zero) {
    if (add(zero.fraction)) bulge.add(zero.normal);
  });
  if (points.empty()) return found;
  for_each_zero_corner(cell.phi, low, side, add);
  for (const Sample& p : points) found = std::max(found, p.distance);
  const double margin = bulge.fraction() * side * cell.side_mm;
  if (side <= kLeastSide || bound_of(points) + margin <= found) return found;
  const double half = 0.5 * side;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 shift{half * (octant >> 2), half * (octant >> 1 & 1), half * (octant & 1)};
    found = refined(cell, low + shift, half, found);
  }
  return found;
}

mesh::DistanceSummary FieldToMesh::measure(const Pace& pace) {
  extracted_.prepare(pace.part(0.0, 0.15));
  find_nearest(pace.part(0.15, 0.2));
  measure_vertices(pace.part(0.2, 0.4));
  const DistanceSums found_first = measure_cells(pace.part(0.4, 0.75));
  mesh::DistanceSummary summary = found_first.summary();
  summary.max_mm = greatest_by_bound(bound_, found_first.max, pace.part(0.75, 1.0), [&] {
    return [this](std::uint32_t number, double found) { return greatest_in(number, found); };
  });
  return summary;
}

}  // namespace argil::io
