// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/surface_near.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "argil/engine/field_sampler.h"
#include "argil/mesh/compact.h"

#include "compare/distance_sums.h"

namespace argil::io {
namespace {

/// Cubes of space around what was left out.
class CubesAround {
 public:
  CubesAround(const TriangleMesh& left_out, const Clay& clay) {
    // Leaves that meet are of levels next to each other.
    constexpr double kCells = 8.0;
    FieldSampler field(clay);
    for (const Vec3& p : left_out.positions) {
      const FieldCell cell = field.cell_at(p);
      if (cell.per_mm > 0.0) side_mm_ = std::max(side_mm_, kCells / cell.per_mm);
    }
    side_mm_ = std::max(side_mm_, kCells * clay.options().voxel_mm);
    for (const Vec3& p : left_out.positions) {
      const Cube at = cube_at(p);
      for (int n = 0; n < 27; ++n) {
        cubes_.insert({at[0] + n / 9 - 1, at[1] + n / 3 % 3 - 1, at[2] + n % 3 - 1});
      }
    }
  }
  bool hold(const Vec3& p) const { return cubes_.count(cube_at(p)) > 0; }

 private:
  using Cube = std::array<std::int64_t, 3>;
  Cube cube_at(const Vec3& p) const {
    assert(is_finite(p));
    Cube cube{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cube[axis] = static_cast<std::int64_t>(std::floor(p[axis] / side_mm_));
    }
    return cube;
  }

  double side_mm_ = 0.0;
  std::set<Cube> cubes_;
};

}  // namespace

TriangleMesh surface_near(const TriangleMesh& surface, const TriangleMesh& left_out,
                          const Clay& clay, const Pace& pace) {
  const CubesAround cubes(left_out, clay);
  std::vector<std::uint8_t> is_near(surface.positions.size(), 0);
  in_blocks(is_near.size(), pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      is_near[v] = cubes.hold(surface.positions[v]) ? 1 : 0;
    }
  });
  return mesh::only_triangles(surface, [&](std::size_t t) {
    const Triangle& of = surface.triangles[t];
    return std::any_of(of.begin(), of.end(), [&](std::uint32_t v) { return is_near[v] != 0; });
  });
}

}  // namespace argil::io
