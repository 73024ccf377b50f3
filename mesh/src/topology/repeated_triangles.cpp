// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology/repeated_triangles.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace argil::mesh {
namespace {

/// In the list of its lowest vertex.
struct Listed {
  std::uint32_t middle;
  std::uint32_t high;
  std::uint32_t triangle;
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated_pairs(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) ++first[*std::min_element(t.begin(), t.end()) + 1];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) first[v + 1] += first[v];
  std::vector<Listed> lists(mesh.triangles.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle sorted = mesh.triangles[t];
    std::sort(sorted.begin(), sorted.end());
    lists[next[sorted[0]]++] = {sorted[1], sorted[2], t};
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto begin = lists.begin() + first[v];
    const auto end = lists.begin() + first[v + 1];
    if (end - begin < 2) continue;
    std::sort(begin, end, [](const Listed& a, const Listed& b) {
      return std::tie(a.middle, a.high, a.triangle) < std::tie(b.middle, b.high, b.triangle);
    });
    for (auto at = begin + 1; at != end; ++at) {
      const Listed& before = *(at - 1);
      if (at->middle != before.middle || at->high != before.high) continue;
      repeated.emplace_back(before.triangle, at->triangle);
    }
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

std::vector<std::uint32_t> repeated_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> later;
  for (const auto& [before, triangle] : repeated_pairs(mesh)) later.push_back(triangle);
  std::sort(later.begin(), later.end());
  return later;
}

}  // namespace argil::mesh
