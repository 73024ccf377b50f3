// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/orient.h"

#include <cassert>
#include <span>
#include <vector>

namespace argil::mesh {

std::int64_t orient_alike(TriangleMesh& mesh, const EdgeTable& edges, const MeshParts& parts) {
  assert(parts.of_triangle.size() == mesh.triangles.size());
  enum : std::uint8_t { kUnseen, kAsIs, kTurned };
  std::vector<std::uint8_t> state(mesh.triangles.size(), kUnseen);
  std::vector<std::int64_t> balance(parts.count, 0);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (state[seed] != kUnseen) continue;
    state[seed] = kAsIs;
    // The first triangle decides nothing: the majority of the part does, below.
    queue.assign(1, seed);
    while (!queue.empty()) {
      const std::uint32_t t = queue.back();
      queue.pop_back();
      balance[parts.of_triangle[t]] += state[t] == kAsIs ? 1 : -1;
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        const std::span<const HalfEdge> uses = edges.uses(edges.edge_of(h));
        if (uses.size() != 2) continue;
        const HalfEdge other = uses[0] == h ? uses[1] : uses[0];
        std::uint8_t& theirs = state[triangle_of(other)];
        if (theirs != kUnseen) continue;
        const bool alike = edges.forward(h) != edges.forward(other);
        theirs = (state[t] == kAsIs) == alike ? kAsIs : kTurned;
        queue.push_back(other / 3);
      }
    }
  }
  std::int64_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool most_as_is = balance[parts.of_triangle[t]] >= 0;
    if ((state[t] == kAsIs) == most_as_is) continue;
    turn_over(mesh.triangles[t]);
    ++turned;
  }
  return turned;
}

}  // namespace argil::mesh
