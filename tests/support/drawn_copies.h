// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/display_surface.h"

namespace argil::test {

/// What a renderer keeps of a block.
struct DrawnCopy {
  std::vector<DisplayVertex> vertices;
  std::vector<Triangle> triangles;
  friend bool operator==(const DrawnCopy&, const DrawnCopy&) = default;
};
using DrawnCopies = std::map<BlockId, DrawnCopy>;

/// One mesh of copies, vertices merged where their positions have the same bits: only then no pixel
/// shows between blocks.
inline TriangleMesh welded(const DrawnCopies& copies) {
  TriangleMesh mesh;
  std::map<std::array<float, 3>, std::uint32_t> known;
  for (const auto& [id, copy] : copies) {
    std::vector<std::uint32_t> to;
    for (const DisplayVertex& v : copy.vertices) {
      const auto& p = v.position_mm;
      const auto fresh = static_cast<std::uint32_t>(mesh.positions.size());
      const auto [at, is_new] = known.try_emplace(p, fresh);
      to.push_back(at->second);
      if (!is_new) continue;
      mesh.positions.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
    }
    for (const Triangle& t : copy.triangles)
      mesh.triangles.push_back({to[t[0]], to[t[1]], to[t[2]]});
  }
  return mesh;
}

/// The triangles by the bits of their corners, in an order of their own.
using Corners = std::array<float, 18>;

inline std::vector<Corners> sorted_triangles(const DrawnCopies& copies) {
  std::vector<Corners> all;
  for (const auto& [id, copy] : copies) {
    for (const Triangle& t : copy.triangles) {
      Corners corners{};
      for (std::size_t i = 0; i < 18; ++i) {
        const DisplayVertex& v = copy.vertices[t[i / 6]];
        corners[i] = i % 6 < 3 ? v.position_mm[i % 3] : v.normal[i % 3];
      }
      all.push_back(corners);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

inline std::vector<Corners> sorted_triangles(const TriangleMesh& mesh) {
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners corners{};
    for (std::size_t i = 0; i < 18; ++i) {
      const std::uint32_t v = t[i / 6];
      const Vec3& from = i % 6 < 3 ? mesh.positions[v] : mesh.normals[v];
      corners[i] = static_cast<float>(from[i % 3]);
    }
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

inline double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

/// Somewhere around the clay; the distance at which voxels of one of the finest levels get too
/// small passes through it.
inline DisplayView random_view(std::mt19937& random, double reach_mm, double voxel_mm) {
  DisplayView view;
  for (std::size_t a = 0; a < 3; ++a) view.eye_mm[a] = uniform(random, -2.0, 2.0) * reach_mm;
  const double limit = length(view.eye_mm) + uniform(random, -0.6, 0.6) * reach_mm;
  const int level = random() % 3 == 0 ? 1 : 0;
  view.pixel_rad = voxel_mm * (1 << level) / std::max(limit, 0.1 * reach_mm);
  view.hysteresis = 0.0;
  view.coarser = 1 + static_cast<int>(random() % 3);
  return view;
}

}  // namespace argil::test
