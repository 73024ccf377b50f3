// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// The corners of triangles at each vertex, ascending: corner k of triangle t is 3 t + k.
class CornersAround {
 public:
  explicit CornersAround(const TriangleMesh& mesh) : first_(mesh.positions.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t) ++first_[v + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    corners_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    std::uint32_t corner = 0;
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t) corners_[next[v]++] = corner++;
    }
    assert(corner == corners_.size());
  }
  std::span<const std::uint32_t> of(std::size_t v) const noexcept {
    assert(v + 1 < first_.size());
    return {corners_.data() + first_[v], first_[v + 1] - first_[v]};
  }

 private:
  std::vector<std::uint32_t> first_;  ///< per vertex into corners_, and one more at the end
  std::vector<std::uint32_t> corners_;
};

}  // namespace argil::mesh
