// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <unordered_map>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// What is wrong with the way the triangles of a mesh hang together; all zero for a closed,
/// oriented two-manifold. By indices alone: positions are not looked at.
struct MeshFaults {
  std::int64_t repeated_half_edges = 0;  ///< directed edges used more than once
  std::int64_t open_half_edges = 0;      ///< directed edges without their opposite
  std::int64_t pinched_vertices = 0;     ///< vertices with more than one fan of triangles
  std::int64_t degenerate = 0;           ///< triangles with a repeated index
  std::int64_t unused_vertices = 0;
  friend bool operator==(const MeshFaults&, const MeshFaults&) = default;
};

inline std::ostream& operator<<(std::ostream& out, const MeshFaults& f) {
  return out << "{repeated " << f.repeated_half_edges << ", open " << f.open_half_edges
             << ", pinched " << f.pinched_vertices << ", degenerate " << f.degenerate << ", unused "
             << f.unused_vertices << "}";
}

/// Looks up the triangle on the left of a directed edge.
class HalfEdges {
 public:
  explicit HalfEdges(const TriangleMesh& mesh) {
    triangle_of_.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto key = key_of(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
        if (!triangle_of_.emplace(key, t).second) ++repeated_;
      }
    }
  }
  std::int64_t repeated() const { return repeated_; }
  std::int64_t open() const {
    std::int64_t count = 0;
    for (const auto& [key, triangle] : triangle_of_) {
      count += triangle_of_.contains(key << 32 | key >> 32) ? 0 : 1;
    }
    return count;
  }
  /// The triangle left of a -> b, or -1.
  std::int64_t left_of(std::uint32_t a, std::uint32_t b) const {
    const auto found = triangle_of_.find(key_of(a, b));
    return found == triangle_of_.end() ? -1 : static_cast<std::int64_t>(found->second);
  }

 private:
  static std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(a) << 32 | b;
  }
  std::unordered_map<std::uint64_t, std::size_t> triangle_of_;
  std::int64_t repeated_ = 0;
};

/// How many triangles the fan around vertex v has that starts with triangle `first`.
inline std::int64_t fan_length(const TriangleMesh& mesh, const HalfEdges& edges, std::uint32_t v,
                               std::size_t first) {
  std::int64_t count = 0;
  auto at = static_cast<std::int64_t>(first);
  do {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(at)];
    const auto corner = static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
    at = edges.left_of(v, t[(corner + 2) % 3]);
    ++count;
  } while (at >= 0 && at != static_cast<std::int64_t>(first) &&
           count <= static_cast<std::int64_t>(mesh.triangles.size()));
  return count;
}

inline MeshFaults find_mesh_faults(const TriangleMesh& mesh) {
  MeshFaults faults;
  const HalfEdges edges(mesh);
  faults.repeated_half_edges = edges.repeated();
  faults.open_half_edges = edges.open();
  std::vector<std::int64_t> uses(mesh.positions.size(), 0);
  std::vector<std::size_t> first(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) ++faults.degenerate;
    for (const std::uint32_t v : t) {
      ++uses[v];
      first[v] = i;
    }
  }
  for (std::uint32_t v = 0; v < uses.size(); ++v) {
    if (uses[v] == 0) {
      ++faults.unused_vertices;
    } else if (fan_length(mesh, edges, v, first[v]) != uses[v]) {
      ++faults.pinched_vertices;
    }
  }
  return faults;
}

/// Vertices - edges + triangles of a closed mesh: 2 for each ball, 0 for each torus.
inline std::int64_t euler_characteristic(const TriangleMesh& mesh) {
  const auto triangles = static_cast<std::int64_t>(mesh.triangles.size());
  return static_cast<std::int64_t>(mesh.positions.size()) - triangles / 2;
}

}  // namespace argil::test
