// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/rim_bands.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace argil::mesh {
namespace {

// Of the box around the smaller loop. A lid half a radius away from another has a winding number of
// 3/4, more than half of what lies between two bodies.
constexpr double kMeanBeside = 0.2;
constexpr double kMostBeside = 0.3;

struct Rim {
  std::vector<std::uint32_t> vertices;
  std::uint32_t part = kNoPart;
  Box3 box;

  double size() const { return length(box.size()); }
};

Rim rim_of(const TriangleMesh& mesh, const EdgeTable& edges, const MeshParts& parts,
           const RimLoop& loop) {
  Rim rim;
  rim.part = parts.of_triangle[triangle_of(loop.front())];
  for (const HalfEdge h : loop) {
    rim.vertices.push_back(edges.from(h));
    rim.box.include(mesh.positions[edges.from(h)]);
  }
  return rim;
}

/// Of a point from an edge of a rim: the distance, and the edge's number.
std::pair<double, std::size_t> nearest_edge(const TriangleMesh& mesh, const Vec3& p,
                                            const Rim& rim) {
  std::pair<double, std::size_t> nearest{std::numeric_limits<double>::infinity(), 0};
  const std::size_t count = rim.vertices.size();
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3& a = mesh.positions[rim.vertices[n]];
    const Vec3 along = mesh.positions[rim.vertices[(n + 1) % count]] - a;
    const double square = dot(along, along);
    const double t = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, {length(p - a - t * along), n});
  }
  return nearest;
}

/// How far the vertices of a rim are from another on average; infinite where that is far or one of
/// them is, or where the two do not run against each other, as both sides of a gap do.
double mean_beside(const TriangleMesh& mesh, const Rim& rim, const Rim& other) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double size = std::min(rim.size(), other.size());
  double sum = 0.0;
  double against = 0.0;
  const std::size_t count = rim.vertices.size();
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3& p = mesh.positions[rim.vertices[n]];
    const auto [distance, edge] = nearest_edge(mesh, p, other);
    if (distance > kMostBeside * size) return kFar;
    sum += distance;
    const Vec3 along = mesh.positions[rim.vertices[(n + 1) % count]] - p;
    const Vec3 beside = mesh.positions[other.vertices[(edge + 1) % other.vertices.size()]] -
                        mesh.positions[other.vertices[edge]];
    against -= dot(normalized(along), normalized(beside));
  }
  const double mean = sum / static_cast<double>(count);
  return mean <= kMeanBeside * size && against > 0.0 ? mean : kFar;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> loops_beside(const TriangleMesh& mesh,
                                                              const EdgeTable& edges,
                                                              const MeshParts& parts,
                                                              const std::vector<RimLoop>& loops) {
  constexpr std::size_t kMostCompared = 50'000'000;  // vertices with edges
  std::vector<Rim> rims;
  for (const RimLoop& loop : loops) rims.push_back(rim_of(mesh, edges, parts, loop));
  std::vector<std::tuple<double, std::size_t, std::size_t>> found;
  std::size_t compared = 0;
  for (std::size_t a = 0; a < rims.size(); ++a) {
    for (std::size_t b = a + 1; b < rims.size(); ++b) {
      if (rims[a].part == rims[b].part) continue;
      const double near = kMostBeside * std::min(rims[a].size(), rims[b].size());
      // Boxes of loops beside each other are nearly the same.
      if (length(rims[a].box.min - rims[b].box.min) > 2.0 * near ||
          length(rims[a].box.max - rims[b].box.max) > 2.0 * near) {
        continue;
      }
      compared += 2 * rims[a].vertices.size() * rims[b].vertices.size();
      if (compared > kMostCompared) return {};
      const double mean =
          std::max(mean_beside(mesh, rims[a], rims[b]), mean_beside(mesh, rims[b], rims[a]));
      if (std::isfinite(mean)) found.emplace_back(mean, a, b);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<bool> is_taken(loops.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [mean, a, b] : found) {
    if (is_taken[a] || is_taken[b]) continue;
    is_taken[a] = is_taken[b] = true;
    pairs.emplace_back(a, b);
  }
  return pairs;
}

/// From where the two are nearest on, always along the shorter way across.
std::vector<Triangle> band_between(const TriangleMesh& mesh, const EdgeTable& edges,
                                   const RimLoop& a, const RimLoop& b) {
  assert(!a.empty() && !b.empty());
  std::vector<std::uint32_t> left;
  std::vector<std::uint32_t> right;  // the other way round, so that both run alike
  for (const HalfEdge h : a) left.push_back(edges.from(h));
  for (auto h = b.rbegin(); h != b.rend(); ++h) right.push_back(edges.from(*h));
  const auto across = [&](std::size_t i, std::size_t j) {
    return length(mesh.positions[left[i % left.size()]] - mesh.positions[right[j % right.size()]]);
  };
  std::tuple<double, std::size_t, std::size_t> nearest{across(0, 0), 0, 0};
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      nearest = std::min(nearest, {across(i, j), i, j});
    }
  }
  std::rotate(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(std::get<1>(nearest)),
              left.end());
  std::rotate(right.begin(), right.begin() + static_cast<std::ptrdiff_t>(std::get<2>(nearest)),
              right.end());
  std::vector<Triangle> band;
  for (std::size_t i = 0, j = 0; i < left.size() || j < right.size();) {
    const std::uint32_t from_left = left[i % left.size()];
    const std::uint32_t from_right = right[j % right.size()];
    const bool is_left =
        j == right.size() || (i < left.size() && across(i + 1, j) <= across(i, j + 1));
    const Triangle t = is_left ? Triangle{left[++i % left.size()], from_left, from_right}
                               : Triangle{from_right, right[++j % right.size()], from_left};
    // Where the loops touch.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) band.push_back(t);
  }
  return band;
}

}  // namespace argil::mesh
