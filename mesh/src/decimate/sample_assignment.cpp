// SPDX-License-Identifier: GPL-3.0-or-later
// The samples of each triangle are a linked list through `next_`: to hand them on takes no memory
// of its own.
#include "decimate/sample_assignment.h"

#include <cassert>
#include <cstddef>
#include <limits>

#include "argil/core/closest_on_triangle.h"

namespace argil::mesh {

namespace {
constexpr std::uint32_t kEnd = 0xffffffff;
}  // namespace

SampleAssignment::SampleAssignment(const TriangleMesh& surface)
    : samples_(surface.positions),
      first_(surface.triangles.size(), kEnd),
      next_(surface.positions.size(), kEnd) {
  std::vector<bool> is_assigned(samples_.size(), false);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (const std::uint32_t v : surface.triangles[t]) {
      assert(v < samples_.size());
      if (is_assigned[v]) continue;
      is_assigned[v] = true;
      next_[v] = first_[t];
      first_[t] = v;
    }
  }
}

void SampleAssignment::gather(std::span<const std::uint32_t> triangles) {
  gathered_.clear();
  for (const std::uint32_t t : triangles) {
    assert(t < first_.size());
    for (std::uint32_t p = first_[t]; p != kEnd; p = next_[p]) gathered_.push_back(p);
  }
}

bool SampleAssignment::assign(std::span<const NewTriangle> made, double reach_mm) {
  assert(reach_mm > 0.0);
  assigned_.resize(gathered_.size());
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    const Vec3& p = samples_[gathered_[i]];
    double least = std::numeric_limits<double>::infinity();
    for (const NewTriangle& t : made) {
      const Vec3 offset = closest_on_triangle(p, t.a, t.b, t.c) - p;
      const double square = dot(offset, offset);
      if (square >= least) continue;
      least = square;
      assigned_[i] = t.number;
    }
    if (least > reach_mm * reach_mm) return false;
  }
  return true;
}

void SampleAssignment::commit(std::span<const std::uint32_t> replaced) {
  assert(assigned_.size() == gathered_.size());
  for (const std::uint32_t t : replaced) first_[t] = kEnd;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    assert(assigned_[i] < first_.size());
    next_[gathered_[i]] = first_[assigned_[i]];
    first_[assigned_[i]] = gathered_[i];
  }
}

}  // namespace argil::mesh
