// SPDX-License-Identifier: GPL-3.0-or-later
// meshoptimizer's simplifier, where Argil was built with it.
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rivals/decimators.h"

#ifdef ARGIL_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace argil::evaluation {

#ifdef ARGIL_MESHOPTIMIZER

namespace {

constexpr std::size_t kCorners = 3;

/// The vertices that triangles name, and these by their new numbers.
TriangleMesh compacted(const std::vector<Vec3>& positions, const std::vector<unsigned>& corners) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> number(positions.size(), kUnused);
  TriangleMesh made;
  made.triangles.reserve(corners.size() / kCorners);
  for (std::size_t n = 0; n < corners.size(); n += kCorners) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
      const unsigned vertex = corners[n + corner];
      if (number[vertex] == kUnused) {
        number[vertex] = static_cast<std::uint32_t>(made.positions.size());
        made.positions.push_back(positions[vertex]);
      }
      triangle[corner] = number[vertex];
    }
    made.triangles.push_back(triangle);
  }
  return made;
}

}  // namespace

bool has_meshoptimizer() noexcept { return true; }

TriangleMesh meshoptimizer_decimated(const TriangleMesh& surface, std::int64_t triangles) {
  assert(triangles > 0);
  constexpr float kAnyError = 1.0F;  // a cost, not a bound: as much as the whole mesh is wide
  std::vector<float> places;
  places.reserve(kCorners * surface.positions.size());
  for (const Vec3& p : surface.positions) {
    for (const double along : {p.x, p.y, p.z}) places.push_back(static_cast<float>(along));
  }
  std::vector<unsigned> corners;
  corners.reserve(kCorners * surface.triangles.size());
  for (const Triangle& triangle : surface.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  std::vector<unsigned> left(corners.size());
  left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), places.data(),
                               surface.positions.size(), kCorners * sizeof(float),
                               kCorners * static_cast<std::size_t>(triangles), kAnyError, 0,
                               nullptr));
  return compacted(surface.positions, left);
}

#else

bool has_meshoptimizer() noexcept { return false; }

TriangleMesh meshoptimizer_decimated(const TriangleMesh&, std::int64_t) {
  assert(false);
  return {};
}

#endif

}  // namespace argil::evaluation
