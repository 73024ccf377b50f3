// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/triangle_runs.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "argil/core/closest_on_triangle.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/distance_sums.h"

namespace argil::io {
namespace {

constexpr std::size_t kRun = 8;

double distance_from(const Box3& box, const Vec3& at) noexcept {
  Vec3 beyond;
  for (std::size_t k = 0; k < 3; ++k) {
    beyond[k] = std::max({box.min[k] - at[k], at[k] - box.max[k], 0.0});
  }
  return length(beyond);
}

}  // namespace

TriangleRuns::TriangleRuns(const TriangleMesh& mesh, const Pace& pace) : mesh_(mesh) {
  static_assert(kDistanceBlock % kRun == 0, "no box is of two blocks");
  const std::size_t count = mesh.triangles.size();
  std::vector<Box3> boxes((count + kRun - 1) / kRun);
  in_blocks(count, pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) boxes[t / kRun].include(mesh.positions[v]);
    }
  });
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box3>& below = levels_.back();
    std::vector<Box3> above((below.size() + kRun - 1) / kRun);
    for (std::size_t i = 0; i < below.size(); ++i) {
      above[i / kRun].include(below[i].min);
      above[i / kRun].include(below[i].max);
    }
    levels_.push_back(std::move(above));
  }
}

TriangleRuns::Closest TriangleRuns::closest(const Vec3& at, Closest known) const {
  assert(is_finite(at));
  if (!levels_.back().empty()) search(levels_.size() - 1, 0, at, known);
  return known;
}

/// What a box has that is nearer than known; what is as near may have a lower number.
void TriangleRuns::search(std::size_t level, std::size_t box, const Vec3& at,
                          Closest& known) const {
  if (distance_from(levels_[level][box], at) > known.distance) return;
  if (level == 0) return look_at(box, at, known);
  const std::size_t end = std::min(levels_[level - 1].size(), (box + 1) * kRun);
  for (std::size_t below = box * kRun; below < end; ++below) search(level - 1, below, at, known);
}

void TriangleRuns::look_at(std::size_t run, const Vec3& at, Closest& known) const {
  const std::size_t end = std::min(mesh_.triangles.size(), (run + 1) * kRun);
  for (std::size_t t = run * kRun; t < end; ++t) {
    const auto& [a, b, c] = mesh::corners_of(mesh_, t);
    const double distance = length(at - closest_on_triangle(at, a, b, c));
    const auto number = static_cast<std::uint32_t>(t);
    if (distance < known.distance || (distance == known.distance && number < known.triangle)) {
      known = {distance, number};
    }
  }
}

}  // namespace argil::io
