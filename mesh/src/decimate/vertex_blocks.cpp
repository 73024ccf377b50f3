// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/vertex_blocks.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

#include <tbb/parallel_invoke.h>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {
namespace {

class BlockCut {
 public:
  BlockCut(const std::vector<Vec3>& positions, std::size_t most, double fraction)
      : positions_(positions), most_(most), fraction_(fraction) {
    assert(most >= 1 && fraction > 0.0 && fraction < 1.0);
  }

  std::vector<VertexBlock> cut(std::span<std::uint32_t> vertices) const {
    if (vertices.size() <= most_) {
      VertexBlock block(vertices.begin(), vertices.end());
      std::sort(block.begin(), block.end());
      return {std::move(block)};
    }
    const std::size_t axis = longest_axis(vertices);
    const auto share = static_cast<std::size_t>(fraction_ * static_cast<double>(vertices.size()));
    const std::size_t before = std::clamp<std::size_t>(share, 1, vertices.size() - 1);
    // Of equal coordinates the lower number comes first: there is one cut.
    std::nth_element(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(before),
                     vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(positions_[a][axis], a) < std::pair(positions_[b][axis], b);
                     });
    std::vector<VertexBlock> low;
    std::vector<VertexBlock> high;
    tbb::parallel_invoke([&] { low = cut(vertices.first(before)); },
                         [&] { high = cut(vertices.subspan(before)); });
    low.insert(low.end(), std::move_iterator(high.begin()), std::move_iterator(high.end()));
    return low;
  }

 private:
  std::size_t longest_axis(std::span<const std::uint32_t> vertices) const {
    Box3 box;
    for (const std::uint32_t v : vertices) box.include(positions_[v]);
    const Vec3 size = box.size();
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (size[axis] > size[longest]) longest = axis;
    }
    return longest;
  }

  const std::vector<Vec3>& positions_;
  std::size_t most_;
  double fraction_;
};

}  // namespace

std::vector<VertexBlock> vertex_blocks(const std::vector<Vec3>& positions,
                                       std::vector<std::uint32_t> vertices, std::size_t most,
                                       double fraction) {
  if (vertices.empty()) return {};
  return BlockCut(positions, most, fraction).cut(vertices);
}

}  // namespace argil::mesh
