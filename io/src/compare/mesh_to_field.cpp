// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/mesh_to_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "argil/mesh/triangle_geometry.h"

#include "compare/best_first.h"

namespace argil::io {

void MeshToField::measure_vertices(const Pace& pace) {
  at_vertex_.resize(mesh_.positions.size());
  voxel_at_vertex_.resize(mesh_.positions.size());
  in_blocks(at_vertex_.size(), pace, [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    for (std::size_t v = begin; v < end; ++v) {
      const FieldValue at = field.value(mesh_.positions[v]);
      at_vertex_[v] = at.distance_mm;
      voxel_at_vertex_[v] = static_cast<float>(at.voxel_mm);
    }
  });
}

DistanceSums MeshToField::measure_triangles(const Pace& pace) {
  assert(at_vertex_.size() == mesh_.positions.size());
  constexpr int kMostSplits = 64;
  const std::size_t count = mesh_.triangles.size();
  bound_.resize(count);
  std::vector<DistanceSums> blocks(block_count(count));
  in_blocks(count, pace, [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay_);
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = mesh::corners_of(mesh_, t);
      const double first = at_vertex_[mesh_.triangles[t][0]];
      Range range{first, first};
      for (const std::uint32_t v : mesh_.triangles[t]) {
        range.include(at_vertex_[v]);
      }
      const int n = std::max(least_splits_, mesh::splits_for(mesh::longest_side(a, b, c),
                                                             0.4 * voxel_of(t), kMostSplits));
      const double area = 0.5 * length(cross(b - a, c - a)) / (n * n);
      mesh::for_each_sample(n, [&](const std::array<double, 3>& w) {
        const double d = field.distance_mm(w[0] * a + w[1] * b + w[2] * c);
        range.include(d);
        blocks[begin / kDistanceBlock].add(std::abs(d), area);
      });
      blocks[begin / kDistanceBlock].max =
          std::max(blocks[begin / kDistanceBlock].max, range.worst());
      bound_[t] = rounded_up(range.bound());
    }
  });
  // In the order of the blocks, so that the sum does not depend on threads.
  DistanceSums total;
  for (const DistanceSums& sums : blocks) total.add(sums);
  return total;
}

double MeshToField::refined(const mesh::Corners& c, const std::array<double, 3>& phi, double found,
                            double voxel_mm, FieldSampler& field) const {
  Range range{phi[0], phi[0]};
  range.include(phi[1]);
  range.include(phi[2]);
  range.include(field.distance_mm(mesh::middle(c)));
  found = std::max(found, range.worst());
  // Triangles longer than a voxel are split whatever their bound is: across voxels phi is not
  // nearly linear.
  const double side = mesh::longest_side(c[0], c[1], c[2]);
  if (side < 0.125 * voxel_mm || (side < voxel_mm && range.bound() <= found)) return found;
  // In four, by the middles of the sides.
  mesh::Corners m;
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

mesh::DistanceSummary MeshToField::measure(const Pace& pace) {
  assert(least_splits_ >= 1);
  measure_vertices(pace.part(0.0, 0.1));
  const DistanceSums sums = measure_triangles(pace.part(0.1, 0.8));
  mesh::DistanceSummary summary = sums.summary();
  summary.max_mm = greatest_by_bound(bound_, sums.max, pace.part(0.8, 1.0), [&] {
    return [this, field = std::make_unique<FieldSampler>(clay_)](std::uint32_t t, double found) {
      const Triangle& tri = mesh_.triangles[t];
      const auto phi = [&](std::size_t k) { return at_vertex_[tri[k]]; };
      return refined(mesh::corners_of(mesh_, t), {phi(0), phi(1), phi(2)}, found, voxel_of(t),
                     *field);
    };
  });
  return summary;
}

}  // namespace argil::io
