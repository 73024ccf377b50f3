// SPDX-License-Identifier: GPL-3.0-or-later
// Mends along rims, which are the open edges: those with one triangle only.
#include "repair/seams.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

#include "topology/point_grid.h"
#include "topology/repeated_triangles.h"

namespace argil::mesh {
namespace {

/// The vertices of open edges, ascending.
std::vector<std::uint32_t> rim_vertices(const EdgeTable& edges) {
  std::vector<std::uint32_t> rim;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() != 1) continue;
    rim.push_back(edges.from(edges.uses(e)[0]));
    rim.push_back(edges.to(edges.uses(e)[0]));
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

Vec3 all_along(double length_mm) { return {length_mm, length_mm, length_mm}; }

/// The open edge of a triangle with vertices of others on it, and these in order along it.
struct Split {
  std::uint32_t triangle;
  HalfEdge edge;
  std::vector<std::pair<double, std::uint32_t>> on_it;  ///< distance along it in mm, vertex
};

/// Looks along the edge in pieces of `piece_mm`: the box of a long one that lies askew may hold all
/// vertices.
Split split_of(const TriangleMesh& mesh, const EdgeTable& edges, HalfEdge h, const PointGrid& rim,
               double near_mm, double piece_mm) {
  Split split{static_cast<std::uint32_t>(triangle_of(h)), h, {}};
  const Vec3& a = mesh.positions[edges.from(h)];
  const Vec3& b = mesh.positions[edges.to(h)];
  const std::uint32_t opposite = edges.to(next_in_triangle(h));
  const double whole = length(b - a);
  // Every point of a shorter one is near an end.
  if (!(whole > 2.0 * near_mm)) return split;
  assert(piece_mm > 0.0);
  const double pieces = std::floor(whole / piece_mm) + 1.0;
  for (double piece = 0.0; piece < pieces; ++piece) {
    const double begin = whole * (piece / pieces);
    const double end = whole * ((piece + 1.0) / pieces);
    Box3 box;
    box.include(a + (begin / whole) * (b - a));
    box.include(a + (end / whole) * (b - a));
    rim.for_box(box.min - all_along(near_mm), box.max + all_along(near_mm), [&](std::uint32_t v) {
      if (v == edges.from(h) || v == edges.to(h) || v == opposite) return;
      const Vec3 offset = mesh.positions[v] - a;
      const double along = dot(offset, b - a) / whole;
      if (along < begin || along >= end) return;  // of another piece
      if (along <= near_mm || along >= whole - near_mm) return;
      if (length(offset - (along / whole) * (b - a)) > near_mm) return;
      split.on_it.emplace_back(along, v);
    });
  }
  std::sort(split.on_it.begin(), split.on_it.end());
  return split;
}

/// In place of the triangle a fan from the corner opposite to its split edge.
void append_fan(const TriangleMesh& mesh, const EdgeTable& edges, const Split& split,
                std::vector<Triangle>& to) {
  const std::uint32_t top = edges.to(next_in_triangle(split.edge));
  std::uint32_t last = edges.from(split.edge);
  for (const auto& [along, v] : split.on_it) {
    // Two vertices at one point would make a triangle without area.
    if (mesh.positions[v] == mesh.positions[last]) continue;
    to.push_back({last, v, top});
    last = v;
  }
  to.push_back({last, edges.to(split.edge), top});
}

/// Returns how many went.
std::int64_t keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep) {
  assert(keep.size() == mesh.triangles.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i]) mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  return static_cast<std::int64_t>(keep.size() - kept);
}

/// For each triangle, whether exactly one other has its corners, and that one faces the opposite
/// direction.
std::vector<bool> faces_its_repetition(const TriangleMesh& mesh) {
  struct Named {
    Triangle corners;  ///< ascending
    bool is_turned;    ///< its own order is the other way round
    std::uint32_t triangle;
  };
  std::vector<Named> sorted;
  sorted.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t = mesh.triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    const bool is_turned = t[1] > t[2];
    if (is_turned) std::swap(t[1], t[2]);
    if (t[0] != t[1] && t[1] != t[2]) sorted.push_back({t, is_turned, i});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Named& a, const Named& b) {
    return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
  });
  std::vector<bool> is_paired(mesh.triangles.size(), false);
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && sorted[last].corners == sorted[first].corners) ++last;
    if (last - first != 2 || sorted[first].is_turned == sorted[first + 1].is_turned) continue;
    is_paired[sorted[first].triangle] = is_paired[sorted[first + 1].triangle] = true;
  }
  return is_paired;
}

std::vector<std::uint32_t> paired_at(const EdgeTable& edges, std::size_t edge,
                                     const std::vector<bool>& is_paired) {
  std::vector<std::uint32_t> paired;
  for (const HalfEdge h : edges.uses(edge)) {
    if (is_paired[triangle_of(h)]) paired.push_back(static_cast<std::uint32_t>(triangle_of(h)));
  }
  return paired;
}

}  // namespace

std::int64_t drop_repeated(TriangleMesh& mesh) {
  std::vector<bool> keep(mesh.triangles.size(), true);
  for (const std::uint32_t t : repeated_triangles(mesh)) keep[t] = false;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const auto& [a, b, c] = mesh.triangles[n];
    if (a == b || b == c || c == a) keep[n] = false;
  }
  return keep_triangles(mesh, keep);
}

std::int64_t drop_interior_faces(TriangleMesh& mesh) {
  const std::vector<bool> is_paired = faces_its_repetition(mesh);
  if (std::find(is_paired.begin(), is_paired.end(), true) == is_paired.end()) return 0;
  const EdgeTable edges(mesh);
  DisjointSets walls(mesh.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::vector<std::uint32_t> paired = paired_at(edges, e, is_paired);
    for (const std::uint32_t t : paired) walls.unite(paired.front(), t);
  }
  std::vector<bool> has_rim(mesh.triangles.size(), false);  // of a wall, at its first triangle
  std::vector<bool> has_open_end(mesh.triangles.size(), false);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::vector<std::uint32_t> paired = paired_at(edges, e, is_paired);
    if (paired.empty()) continue;
    // Two others: the solids' own faces go on from here. None: the end of a sheet that is there
    // both ways round.
    const std::size_t others = edges.uses(e).size() - paired.size();
    const std::uint32_t wall = walls.find(paired.front());
    const bool is_one_pair = paired.size() == 2;
    if (others == 2 && is_one_pair) has_rim[wall] = true;
    if (others == 0 && is_one_pair) has_open_end[wall] = true;
    if (others != 0 && others != 2) has_open_end[wall] = true;
  }
  std::vector<bool> keep(mesh.triangles.size(), true);
  for (std::uint32_t t = 0; t < keep.size(); ++t) {
    const std::uint32_t wall = walls.find(t);
    keep[t] = !is_paired[t] || has_open_end[wall] || !has_rim[wall];
  }
  return keep_triangles(mesh, keep);
}

namespace {

/// Joins all vertices of a cube of half the distance, any two of which are near each other, and
/// gives the first few of each such cube: comparing all of a crowd with all would take for ever.
std::vector<std::uint32_t> join_crowds(const TriangleMesh& mesh,
                                       const std::vector<std::uint32_t>& rim, double near_mm,
                                       DisjointSets& sets) {
  if (!(near_mm > 0.0)) return rim;
  constexpr std::size_t kFew = 8;
  using Cube = std::array<double, 3>;
  std::vector<std::pair<Cube, std::uint32_t>> sorted;
  sorted.reserve(rim.size());
  for (const std::uint32_t v : rim) {
    // The diagonal of such a cube is 0.87 of the distance.
    const Vec3 at = mesh.positions[v] * (2.0 / near_mm);
    sorted.push_back({{std::floor(at.x), std::floor(at.y), std::floor(at.z)}, v});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> few;
  std::size_t first = 0;  // of this cube
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[first].first) first = i;
    if (i - first < kFew) {
      few.push_back(sorted[i].second);
    } else {
      sets.unite(sorted[first].second, sorted[i].second);
    }
  }
  std::sort(few.begin(), few.end());
  return few;
}

}  // namespace

std::int64_t join_rims(TriangleMesh& mesh, double near_mm) {
  assert(near_mm >= 0.0);
  const EdgeTable edges(mesh);
  const std::vector<std::uint32_t> rim = rim_vertices(edges);
  DisjointSets sets(mesh.positions.size());
  const std::vector<std::uint32_t> few = join_crowds(mesh, rim, near_mm, sets);
  const PointGrid grid(mesh, few, near_mm);
  for (const std::uint32_t v : few) {
    const Vec3& p = mesh.positions[v];
    grid.for_box(p - all_along(near_mm), p + all_along(near_mm), [&](std::uint32_t other) {
      if (other > v && length(mesh.positions[other] - p) <= near_mm) sets.unite(v, other);
    });
  }
  std::int64_t joined = 0;
  for (const std::uint32_t v : rim) joined += sets.find(v) != v ? 1 : 0;
  if (joined == 0) return 0;
  std::vector<Triangle> kept;
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) v = sets.find(v);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) kept.push_back(t);
  }
  mesh.triangles = std::move(kept);
  return joined;
}

std::int64_t open_edges(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh);
  std::int64_t open = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) open += edges.uses(e).size() == 1 ? 1 : 0;
  return open;
}

namespace {

/// A tenth of the open edges are shorter; 0 where there are none.
double short_rim_mm(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh);
  std::vector<double> lengths;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() != 1) continue;
    lengths.push_back(
        length(mesh.positions[edges.to(uses[0])] - mesh.positions[edges.from(uses[0])]));
  }
  if (lengths.empty()) return 0.0;
  const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
  std::nth_element(lengths.begin(), tenth, lengths.end());
  return *tenth;
}

}  // namespace

RimsJoined join_rims_as_needed(TriangleMesh& mesh, double least_mm, double most_mm) {
  assert(least_mm >= 0.0 && most_mm >= least_mm);
  constexpr double kStep = 4.0;
  constexpr double kOfShortRim = 0.25;    // so that no triangle but a sliver folds
  constexpr std::int64_t kMostLeft = 10;  // one open edge of so many: they were cracks, not holes
  const std::int64_t open = open_edges(mesh);
  if (open == 0) return {};
  const double most = std::min(most_mm, kOfShortRim * short_rim_mm(mesh));
  TriangleMesh best;
  RimsJoined done;
  std::int64_t least_open = open / kMostLeft + 1;
  for (double next = least_mm, near = 0.0; near < most && least_open > 0; next *= kStep) {
    near = std::min(next, most);
    TriangleMesh joined = mesh;
    const std::int64_t vertices = join_rims(joined, near);
    const std::int64_t left = vertices > 0 ? open_edges(joined) : open;
    if (left >= least_open) continue;
    least_open = left;
    done = {vertices, near};
    best = std::move(joined);
  }
  if (done.vertices > 0) mesh = std::move(best);
  return done;
}

namespace {

/// Of the cells in which vertices are looked for along edges: no larger than open edges usually
/// are, so that a dense rim is not all in one, and none where as many cells as vertices do.
double cell_along_rims(const TriangleMesh& mesh, const EdgeTable& edges, std::size_t vertices) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() != 1) continue;
    const HalfEdge h = edges.uses(e)[0];
    sum += length(mesh.positions[edges.to(h)] - mesh.positions[edges.from(h)]);
    ++count;
  }
  if (count == 0.0) return 0.0;
  const double diagonal = length(used_bounds(mesh).size());
  return std::min(sum / count, diagonal / std::cbrt(static_cast<double>(vertices + 1)));
}

}  // namespace

std::int64_t split_at_rims(TriangleMesh& mesh, double near_mm) {
  const EdgeTable edges(mesh);
  const std::vector<std::uint32_t> rim = rim_vertices(edges);
  const double side = std::max(near_mm, cell_along_rims(mesh, edges, rim.size()));
  const PointGrid grid(mesh, rim, side);
  std::vector<Split> splits;
  for (HalfEdge h = 0; h < 3 * mesh.triangles.size(); ++h) {
    const std::size_t edge = edges.edge_of(h);
    if (edge >= edges.size() || edges.uses(edge).size() != 1) continue;
    if (!splits.empty() && splits.back().triangle == triangle_of(h)) continue;
    Split split = split_of(mesh, edges, h, grid, near_mm, side);
    if (!split.on_it.empty()) splits.push_back(std::move(split));
  }
  if (splits.empty()) return 0;
  std::vector<Triangle> triangles;
  auto next = splits.begin();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (next == splits.end() || next->triangle != t) {
      triangles.push_back(mesh.triangles[t]);
    } else {
      append_fan(mesh, edges, *next++, triangles);
    }
  }
  mesh.triangles = std::move(triangles);
  return static_cast<std::int64_t>(splits.size());
}

namespace {

/// A part of the surface, cut where three or more triangles meet.
struct Sheet {
  double area = 0.0;
  bool is_open = false;
  bool stands = false;   ///< on other parts, with one triangle at each edge
  bool carries = false;  ///< something, with more than one
  double largest_beside = 0.0;

  bool is_fin() const noexcept {
    return is_open && stands && !carries && area < 0.5 * largest_beside;
  }
};

std::vector<Sheet> sheets_of(const TriangleMesh& mesh, const EdgeTable& edges,
                             const MeshParts& parts) {
  std::vector<Sheet> sheets(parts.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] == kNoPart) continue;
    sheets[parts.of_triangle[t]].area += triangle_area(corners_of(mesh, t));
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    std::vector<std::uint32_t> here;
    for (const HalfEdge h : uses) here.push_back(parts.of_triangle[triangle_of(h)]);
    if (uses.size() == 1) sheets[here[0]].is_open = true;
    if (uses.size() < 3) continue;
    for (const std::uint32_t part : here) {
      (std::count(here.begin(), here.end(), part) > 1 ? sheets[part].carries
                                                      : sheets[part].stands) = true;
      for (const std::uint32_t other : here) {
        if (other == part) continue;
        sheets[part].largest_beside = std::max(sheets[part].largest_beside, sheets[other].area);
      }
    }
  }
  return sheets;
}

}  // namespace

std::int64_t drop_fins(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  while (true) {
    const EdgeTable edges(mesh);
    const MeshParts parts = mesh_parts(mesh, edges, true);
    // A fin may stand on a fin: the lower one shows when the upper one is gone.
    const std::vector<Sheet> sheets = sheets_of(mesh, edges, parts);
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t part = parts.of_triangle[t];
      if (part == kNoPart || !sheets[part].is_fin()) kept.push_back(mesh.triangles[t]);
    }
    const bool is_done = kept.size() == mesh.triangles.size();
    mesh.triangles = std::move(kept);
    if (is_done) return static_cast<std::int64_t>(before - mesh.triangles.size());
  }
}

namespace {

/// The triangles at an edge in pairs that bound one solid each; false where they do not.
///
/// Seen along the edge from its lower to its higher vertex, a triangle that runs along it that way
/// has its outside at its left, so a solid begins at one that runs the other way and ends at the
/// next one to the left.
bool pair_uses(const TriangleMesh& mesh, const EdgeTable& edges, std::size_t edge,
               std::vector<std::pair<HalfEdge, HalfEdge>>& pairs) {
  const auto uses = edges.uses(edge);
  assert(uses.size() > 2);
  const std::uint32_t low = std::min(edges.from(uses[0]), edges.to(uses[0]));
  const std::uint32_t high = std::max(edges.from(uses[0]), edges.to(uses[0]));
  const Vec3& origin = mesh.positions[low];
  const Vec3 axis = normalized(mesh.positions[high] - origin);
  const auto third = [&](HalfEdge h) {
    const Vec3 offset = mesh.positions[edges.to(next_in_triangle(h))] - origin;
    return offset - dot(offset, axis) * axis;
  };
  const Vec3 x = normalized(third(uses[0]));
  const Vec3 y = cross(axis, x);
  std::vector<std::pair<double, HalfEdge>> around;
  for (const HalfEdge h : uses) {
    const Vec3 outward = third(h);
    around.emplace_back(std::atan2(dot(outward, y), dot(outward, x)), h);
  }
  std::sort(around.begin(), around.end());
  for (std::size_t n = 0; n < around.size(); ++n) {
    const HalfEdge h = around[n].second;
    const HalfEdge next = around[(n + 1) % around.size()].second;
    if (edges.forward(h) == edges.forward(next)) return false;
    if (!edges.forward(h)) pairs.emplace_back(h, next);
  }
  return true;
}

/// The corners of the triangles, joined around vertices as far as they are of one surface.
bool join_corners(const TriangleMesh& mesh, const EdgeTable& edges, DisjointSets& corners) {
  const auto corner_at = [&](HalfEdge h, std::uint32_t v) {
    return edges.from(h) == v ? h : next_in_triangle(h);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    std::vector<std::pair<HalfEdge, HalfEdge>> pairs;
    if (uses.size() == 2) pairs.emplace_back(uses[0], uses[1]);
    if (uses.size() > 2 && !pair_uses(mesh, edges, e, pairs)) return false;
    for (const auto& [a, b] : pairs) {
      for (const std::uint32_t v : {edges.from(a), edges.to(a)}) {
        corners.unite(corner_at(a, v), corner_at(b, v));
      }
    }
  }
  return true;
}

}  // namespace

std::int64_t part_touching(TriangleMesh& mesh, double gap_mm) {
  assert(gap_mm > 0.0);
  const EdgeTable edges(mesh);
  const auto count = static_cast<HalfEdge>(3 * mesh.triangles.size());
  DisjointSets corners(count);
  if (!join_corners(mesh, edges, corners)) return -1;
  std::vector<std::uint32_t> fans(mesh.positions.size(), 0);
  for (HalfEdge h = 0; h < count; ++h) fans[edges.from(h)] += corners.find(h) == h ? 1 : 0;
  // The first fan at a vertex keeps it.
  std::vector<std::uint32_t> vertex_of(count, kNoPart);
  std::vector<Vec3> inward(mesh.positions.size());
  std::vector<bool> taken(mesh.positions.size(), false);
  std::vector<Triangle> triangles = mesh.triangles;
  const std::size_t before = mesh.positions.size();
  for (HalfEdge h = 0; h < count; ++h) {
    const std::uint32_t v = edges.from(h);
    if (fans[v] < 2) continue;
    std::uint32_t& own = vertex_of[corners.find(h)];
    if (own == kNoPart && !taken[v]) {
      taken[v] = true;
      own = v;
    } else if (own == kNoPart) {
      own = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(Vec3(mesh.positions[v]));
      inward.emplace_back();
    }
    const auto& [a, b, c] = mesh.triangles[triangle_of(h)];
    const Vec3& p = mesh.positions[a];
    inward[own] -= normalized(cross(mesh.positions[b] - p, mesh.positions[c] - p));
    triangles[triangle_of(h)][h % 3] = own;
  }
  assert(inward.size() == mesh.positions.size());
  mesh.triangles = std::move(triangles);
  for (std::size_t v = 0; v < inward.size(); ++v) {
    mesh.positions[v] += gap_mm * normalized(inward[v]);
  }
  return static_cast<std::int64_t>(mesh.positions.size() - before);
}

}  // namespace argil::mesh
