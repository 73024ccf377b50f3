// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The triangles around each vertex; 14 bytes a triangle.
class VertexRings {
 public:
  explicit VertexRings(const TriangleMesh& mesh) : begin_(mesh.positions.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t) ++begin_[v + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    triangles_.resize(begin_.back());
    assert(begin_.back() == 3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) triangles_[next[v]++] = t;
    }
  }
  /// In ascending order.
  std::span<const std::uint32_t> of(std::uint32_t v) const noexcept {
    assert(v + 1 < begin_.size());
    return {triangles_.data() + begin_[v], begin_[v + 1] - begin_[v]};
  }

 private:
  std::vector<std::uint32_t> begin_;  ///< per vertex into triangles_, one more at the end
  std::vector<std::uint32_t> triangles_;
};

}  // namespace argil::io
