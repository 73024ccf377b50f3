// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a soup of triangles into a closed mesh that faces outward: welds it, orients each part
// consistently, fills holes, and then turns whole parts by their volumes.
#include "argil/mesh/close.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/point_welder.h"
#include "argil/mesh/triangle_geometry.h"

#include "repair/close_soup.h"
#include "repair/hole_fill.h"
#include "repair/library_call.h"
#include "repair/orient.h"
#include "repair/rim_bands.h"
#include "repair/seams.h"

namespace argil::mesh {
namespace {

// A loop is a hole when its area is less than this part of what it is a hole in. A flat sheet's
// outer rim has 1; the teapot's lid, open below, 0.79.
constexpr double kLargestHole = 0.9;

// A loop with more than this is closed flat: what is missing is more than the curvature of a rim
// can tell.
constexpr double kLargestBulge = 0.2;

/// Of the area to the power of 3/2, the volume of an open part that counts as one. A ball has 0.09.
constexpr double kFlat = 1e-4;

/// Merges equal positions and leaves out triangles that name a vertex twice or repeat another.
TriangleMesh weld(const TriangleMesh& mesh, CloseReport& report) {
  TriangleMesh welded;
  PointWelder welder(welded.positions);
  std::vector<std::uint32_t> number;
  number.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) number.push_back(welder.add(p));
  report.welded_vertices =
      static_cast<std::int64_t>(mesh.positions.size() - welded.positions.size());

  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) v = number[v];
    welded.triangles.push_back(t);
  }
  report.dropped_triangles = drop_repeated(welded);
  const double size = length(used_bounds(welded).size());
  report.joined_vertices = join_rims_as_needed(welded, kNearRims * size, kFarRims * size).vertices;
  if (report.joined_vertices > 0) report.dropped_triangles += drop_repeated(welded);
  return welded;
}

constexpr HalfEdge kNoEdge = 0xffffffff;

/// Finds the boundary half-edge that follows another around its hole.
class AroundHoles {
 public:
  AroundHoles(const TriangleMesh& mesh, const EdgeTable& edges);

  /// One that `is_seen` does not know; kNoEdge when none begins where `h` ends.
  HalfEdge next(HalfEdge h, const std::vector<bool>& is_seen) const;

 private:
  /// By how much the way turns at the end of `h` when it goes on along `out`, through the hole:
  /// from 0 to 2 pi.
  double turn(HalfEdge h, HalfEdge out) const;

  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  std::vector<HalfEdge> leaving_;     ///< boundary half-edges by where they begin
  std::vector<std::uint32_t> first_;  ///< of each vertex in leaving_, one more at the end
};

AroundHoles::AroundHoles(const TriangleMesh& mesh, const EdgeTable& edges)
    : mesh_(mesh), edges_(edges), first_(mesh.positions.size() + 1, 0) {
  const auto for_each_open = [&](const auto& use) {
    for (HalfEdge h = 0; h < 3 * mesh.triangles.size(); ++h) {
      if (edges.uses(edges.edge_of(h)).size() == 1) use(h);
    }
  };
  for_each_open([&](HalfEdge h) { ++first_[edges.from(h) + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  leaving_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_open([&](HalfEdge h) { leaving_[next[edges.from(h)]++] = h; });
}

double AroundHoles::turn(HalfEdge h, HalfEdge out) const {
  const Vec3& at = mesh_.positions[edges_.to(h)];
  const Vec3 back = mesh_.positions[edges_.from(h)] - at;
  const Vec3 on = mesh_.positions[edges_.to(out)] - at;
  Vec3 normal;
  for (const HalfEdge one : {h, out}) {
    const auto& [a, b, c] = mesh_.triangles[triangle_of(one)];
    const Vec3& p = mesh_.positions[a];
    normal += normalized(cross(mesh_.positions[b] - p, mesh_.positions[c] - p));
  }
  // The triangle is to the left of `h`, so from its end the hole is to the left of the way back.
  const double angle = std::atan2(dot(normalized(normal), cross(back, on)), dot(back, on));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

HalfEdge AroundHoles::next(HalfEdge h, const std::vector<bool>& is_seen) const {
  assert(edges_.uses(edges_.edge_of(h)).size() == 1);
  const std::uint32_t v = edges_.to(h);
  HalfEdge found = kNoEdge;
  double least = 0.0;
  for (std::uint32_t n = first_[v]; n < first_[v + 1]; ++n) {
    const HalfEdge out = leaving_[n];
    if (is_seen[out]) continue;
    const double angle = first_[v + 1] - first_[v] == 1 ? 0.0 : turn(h, out);
    if (found != kNoEdge && angle >= least) continue;
    found = out;
    least = angle;
  }
  return found;
}

struct Rims {
  std::vector<std::vector<HalfEdge>> loops;  ///< each visits a vertex once
  std::int64_t broken = 0;                   ///< chains that do not come back to their start
};

/// Cuts a closed chain where it meets a vertex again: holes that touch there are two holes.
/// `position` has a kNoEdge for every vertex, before and after: where in the chain it starts an
/// edge.
void split_at_touches(const EdgeTable& edges, const std::vector<HalfEdge>& chain,
                      std::vector<std::uint32_t>& position, Rims& rims) {
  std::vector<HalfEdge> open;
  for (const HalfEdge h : chain) {
    position[edges.from(h)] = static_cast<std::uint32_t>(open.size());
    open.push_back(h);
    const std::uint32_t first = position[edges.to(h)];
    if (first == kNoEdge) continue;
    rims.loops.emplace_back(open.begin() + first, open.end());
    for (const HalfEdge done : rims.loops.back()) position[edges.from(done)] = kNoEdge;
    open.resize(first);
  }
}

Rims find_rims(const TriangleMesh& mesh, const EdgeTable& edges) {
  Rims rims;
  const AroundHoles around(mesh, edges);
  std::vector<bool> seen(3 * mesh.triangles.size(), false);
  std::vector<std::uint32_t> position(mesh.positions.size(), kNoEdge);
  for (HalfEdge start = 0; start < 3 * mesh.triangles.size(); ++start) {
    if (seen[start] || edges.uses(edges.edge_of(start)).size() != 1) continue;
    std::vector<HalfEdge> chain;
    const std::uint32_t origin = edges.from(start);
    HalfEdge h = start;
    while (h != kNoEdge) {
      seen[h] = true;
      chain.push_back(h);
      if (edges.to(h) == origin) break;
      h = around.next(h, seen);
    }
    if (h != kNoEdge) {
      split_at_touches(edges, chain, position, rims);
    } else {
      ++rims.broken;
    }
  }
  return rims;
}

/// Length of the area vector of a closed polygon: its area when flat, never more than a patch
/// needs.
double loop_area(const TriangleMesh& mesh, const EdgeTable& edges,
                 const std::vector<HalfEdge>& loop) {
  assert(!loop.empty() && edges.from(loop.front()) == edges.to(loop.back()));
  const Vec3 o = mesh.positions[edges.from(loop[0])];
  Vec3 twice;
  for (const HalfEdge h : loop) {
    twice += cross(mesh.positions[edges.from(h)] - o, mesh.positions[edges.to(h)] - o);
  }
  return length(twice) / 2.0;
}

std::vector<double> part_areas(const TriangleMesh& mesh, const MeshParts& parts) {
  std::vector<double> areas(parts.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    areas[parts.of_triangle[i]] += triangle_area(corners_of(mesh, i));
  }
  return areas;
}

/// Adds the patches that do not give an edge a third triangle; how many holes these close.
std::int64_t add_sound(TriangleMesh& mesh, const std::vector<HolePatch>& patches) {
  TriangleMesh filled = mesh;
  std::vector<std::size_t> patch_of(mesh.triangles.size(), patches.size());
  const auto append = [&](const HolePatch& patch, std::size_t number, TriangleMesh& to) {
    const auto old = static_cast<std::uint32_t>(mesh.positions.size());
    const auto base = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), patch.added.begin(), patch.added.end());
    for (Triangle t : patch.triangles) {
      for (std::uint32_t& v : t) v = v < old ? v : v - old + base;
      to.triangles.push_back(t);
      patch_of.push_back(number);
    }
  };
  for (std::size_t i = 0; i < patches.size(); ++i) append(patches[i], i, filled);
  assert(patch_of.size() == filled.triangles.size());
  // The last one stands for the triangles of the mesh itself.
  std::vector<bool> sound(patches.size() + 1, true);
  const EdgeTable edges(filled);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() <= 2) continue;
    for (const HalfEdge h : edges.uses(e)) sound[patch_of[triangle_of(h)]] = false;
  }
  if (std::find(sound.begin(), sound.end() - 1, false) == sound.end() - 1) {
    mesh = std::move(filled);
    return std::accumulate(
        patches.begin(), patches.end(), std::int64_t{0},
        [](std::int64_t sum, const HolePatch& patch) { return sum + patch.holes; });
  }
  TriangleMesh some = mesh;
  std::int64_t added = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!sound[i]) continue;
    append(patches[i], i, some);
    added += patches[i].holes;
  }
  mesh = std::move(some);
  return added;
}

void fill_holes(TriangleMesh& mesh, const MeshParts& parts, bool joins_rims, CloseReport& report,
                const Pace& pace) {
  const EdgeTable edges(mesh);
  const Rims rims = find_rims(mesh, edges);
  std::vector<HolePatch> patches;
  if (!rims.loops.empty()) {
    const std::vector<double> areas = part_areas(mesh, parts);
    HoleFiller filler(mesh, edges);
    std::vector<bool> is_joined(rims.loops.size(), false);
    if (joins_rims) {
      for (const auto& [a, b] : loops_beside(mesh, edges, parts, rims.loops)) {
        is_joined[a] = is_joined[b] = true;
        patches.push_back({{}, band_between(mesh, edges, rims.loops[a], rims.loops[b]), 2});
      }
    }
    for (std::size_t n = 0; n < rims.loops.size(); ++n) {
      pace.at(static_cast<double>(n) / static_cast<double>(rims.loops.size()));
      if (is_joined[n]) continue;
      const RimLoop& loop = rims.loops[n];
      const double part_area = areas[parts.of_triangle[triangle_of(loop[0])]];
      const double area = loop_area(mesh, edges, loop);
      if (area >= kLargestHole * part_area) continue;
      HolePatch patch;
      is_done_by_library([&] { patch = filler.fill(loop, area < kLargestBulge * part_area); });
      if (!patch.triangles.empty()) patches.push_back(std::move(patch));
    }
  }
  report.holes_closed = add_sound(mesh, patches);
  report.holes_left =
      static_cast<std::int64_t>(rims.loops.size()) - report.holes_closed + rims.broken;
}

/// One part of the mesh, for deciding which way it shall face.
struct Shell {
  std::uint32_t number = 0;
  double volume = 0.0;  ///< with cones over what is open
  double area = 0.0;
  bool closed = true;
  bool turn = false;
  Box3 box;
  Vec3 middle;  ///< of its largest triangle
  double largest = -1.0;
};

/// The turns a part makes around a point, in whole turns: 0 outside, +-1 inside when closed.
double winding(const TriangleMesh& mesh, const MeshParts& parts, std::uint32_t part,
               const Vec3& at) {
  double angle = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (parts.of_triangle[i] != part) continue;
    const Vec3 a = mesh.positions[mesh.triangles[i][0]] - at;
    const Vec3 b = mesh.positions[mesh.triangles[i][1]] - at;
    const Vec3 c = mesh.positions[mesh.triangles[i][2]] - at;
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    // The solid angle of A. van Oosterom and J. Strackee, 1983. It is only compared with a half, so
    // that any arc tangent will do.
    angle += 2.0 * std::atan2(dot(a, cross(b, c)),
                              la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

/// Adds cones from the middle of each part's open edges, which close it whatever its loops are.
void close_by_cones(const TriangleMesh& mesh, const EdgeTable& edges, const MeshParts& parts,
                    std::vector<Shell>& shells) {
  std::vector<Vec3> middle(shells.size());
  std::vector<double> count(shells.size(), 0.0);
  const auto each_open = [&](const auto& act) {
    for (HalfEdge h = 0; h < 3 * mesh.triangles.size(); ++h) {
      const std::span<const HalfEdge> uses = edges.uses(edges.edge_of(h));
      const std::uint32_t part = parts.of_triangle[triangle_of(h)];
      int net = 0;  // within the part; two triangles of it that face alike cancel
      for (const HalfEdge use : uses) {
        if (parts.of_triangle[triangle_of(use)] == part) net += edges.forward(use) ? 1 : -1;
      }
      if (net != 0 && edges.forward(h) == (net > 0)) act(part, h);
    }
  };
  each_open([&](std::uint32_t part, HalfEdge h) {
    shells[part].closed = false;
    middle[part] += mesh.positions[edges.from(h)];
    count[part] += 1.0;
  });
  const Vec3 o = bounds(mesh).center();
  each_open([&](std::uint32_t part, HalfEdge h) {
    const Vec3 a = mesh.positions[edges.from(h)] - o;
    const Vec3 b = mesh.positions[edges.to(h)] - o;
    shells[part].volume += dot(middle[part] / count[part] - o, cross(b, a)) / 6.0;
  });
}

std::vector<Shell> shells_of(const TriangleMesh& mesh, const EdgeTable& edges,
                             const MeshParts& parts) {
  std::vector<Shell> shells(parts.count);
  const std::vector<double> volumes = part_volumes(mesh, parts);
  for (std::uint32_t i = 0; i < parts.count; ++i) {
    shells[i].number = i;
    shells[i].volume = volumes[i];
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Shell& shell = shells[parts.of_triangle[i]];
    const Corners corners = corners_of(mesh, i);
    for (const Vec3& p : corners) shell.box.include(p);
    const double area = triangle_area(corners);
    shell.area += area;
    if (area > shell.largest) {
      shell.largest = area;
      shell.middle = middle(corners);
    }
  }
  close_by_cones(mesh, edges, parts, shells);
  return shells;
}

bool contains_box(const Box3& outer, const Box3& inner) noexcept {
  for (std::size_t a = 0; a < 3; ++a) {
    if (inner.min[a] < outer.min[a] || inner.max[a] > outer.max[a]) return false;
  }
  return true;
}

/// Parts that are open where they meet others along edges of three and more triangles, and closed
/// together with these, as one: cavities side by side have a wall in common that is a part of its
/// own. Which side of such a part is out nothing but the others says.
MeshParts joined_where_closed(const EdgeTable& edges, const MeshParts& parts) {
  DisjointSets sets(parts.count);
  // Who runs along an edge more often one way than the other.
  const auto each_net = [&](const auto& number_of, const auto& use) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto uses = edges.uses(e);
      if (uses.size() == 2 && edges.forward(uses[0]) != edges.forward(uses[1])) continue;
      std::vector<std::pair<std::uint32_t, int>> ways;
      for (const HalfEdge h : uses) {
        ways.emplace_back(number_of(triangle_of(h)), edges.forward(h) ? 1 : -1);
      }
      std::sort(ways.begin(), ways.end());
      std::vector<std::uint32_t> open;
      for (std::size_t first = 0, n = 0; n < ways.size(); first = n) {
        int net = 0;
        for (; n < ways.size() && ways[n].first == ways[first].first; ++n) net += ways[n].second;
        if (net != 0) open.push_back(ways[first].first);
      }
      use(open);
    }
  };
  each_net([&](std::size_t t) { return parts.of_triangle[t]; },
           [&](const std::vector<std::uint32_t>& open) {
             for (const std::uint32_t part : open) sets.unite(open.front(), part);
           });
  std::vector<bool> is_closed(parts.count, true);
  each_net([&](std::size_t t) { return sets.find(parts.of_triangle[t]); },
           [&](const std::vector<std::uint32_t>& open) {
             for (const std::uint32_t set : open) is_closed[set] = false;
           });
  MeshParts joined;
  std::vector<std::uint32_t> number(parts.count, kNoPart);
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    const std::uint32_t set = sets.find(part);  // its smallest member
    number[part] = set == part || !is_closed[set] ? joined.count++ : number[set];
  }
  for (const std::uint32_t part : parts.of_triangle) joined.of_triangle.push_back(number[part]);
  return joined;
}

/// Faces every part outward; a closed one inside another follows that one, so that a cavity stays.
void turn_outward(TriangleMesh& mesh, CloseReport& report, const Pace& pace) {
  const EdgeTable edges(mesh);
  pace.at(0.3);
  const MeshParts parts = joined_where_closed(edges, mesh_parts(mesh, edges, true));
  pace.at(0.6);
  std::vector<Shell> shells = shells_of(mesh, edges, parts);
  // The largest first: whatever a part can lie in is judged before it.
  std::stable_sort(shells.begin(), shells.end(), [](const Shell& a, const Shell& b) {
    return std::abs(a.volume) > std::abs(b.volume);
  });
  for (std::size_t i = 0; i < shells.size(); ++i) {
    pace.at(0.9);
    Shell& shell = shells[i];
    // What is open and flat bounds nothing: the file knows best which side is out.
    const double least = shell.closed ? 0.0 : kFlat * std::pow(shell.area, 1.5);
    shell.turn = shell.volume < -least;
    for (std::size_t j = 0; shell.closed && j < i; ++j) {
      // An outward part within one that stays as it is needs no question.
      if (!shells[j].closed || (!shell.turn && !shells[j].turn)) continue;
      if (contains_box(shells[j].box, shell.box) &&
          std::abs(winding(mesh, parts, shells[j].number, shell.middle)) > 0.5) {
        shell.turn = shells[j].turn;
        break;
      }
    }
  }
  std::vector<bool> turn(parts.count, false);
  for (const Shell& shell : shells) turn[shell.number] = shell.turn;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (turn[parts.of_triangle[i]]) turn_over(mesh.triangles[i]);
  }
  assert(shells.size() == parts.count);
  report.parts = parts.count;
  report.parts_flipped = std::count(turn.begin(), turn.end(), true);
}

/// Whether every edge is run along as often one way as the other.
bool balanced(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::size_t forward = 0;
    for (const HalfEdge h : edges.uses(e)) forward += edges.forward(h) ? 1 : 0;
    if (2 * forward != edges.uses(e).size()) return false;
  }
  return true;
}

/// Leaves out triangles without area, which enclose nothing, and vertices nobody names.
void drop_flat(ClosedMesh& closed) {
  TriangleMesh& mesh = closed.mesh;
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh);
  closed.given_triangles -= static_cast<std::size_t>(std::count_if(
      flat.begin(), flat.end(), [&](std::uint32_t t) { return t < closed.given_triangles; }));
  closed.report.dropped_triangles += static_cast<std::int64_t>(flat.size());
  mesh = only_triangles(mesh, [&](std::size_t t) {
    return !std::binary_search(flat.begin(), flat.end(), static_cast<std::uint32_t>(t));
  });
}

}  // namespace

Result<ClosedMesh> close_soup(const TriangleMesh& input, bool joins_rims, const Pace& pace) {
  ClosedMesh result;
  CloseReport& report = result.report;
  TriangleMesh& mesh = result.mesh;
  pace.at(0.0);
  mesh = weld(input, report);
  pace.at(0.2);
  {
    const EdgeTable edges(mesh);
    pace.at(0.3);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      report.boundary_edges += edges.uses(e).size() == 1 ? 1 : 0;
      report.nonmanifold_edges += edges.uses(e).size() > 2 ? 1 : 0;
    }
    const MeshParts parts = mesh_parts(mesh, edges, true);
    pace.at(0.4);
    report.turned_triangles = orient_alike(mesh, edges, parts);
    result.given_triangles = mesh.triangles.size();
    fill_holes(mesh, parts, joins_rims, report, pace.part(0.5, 0.7));
  }
  pace.at(0.7);
  turn_outward(mesh, report, pace.part(0.7, 0.9));
  pace.at(0.9);
  report.closed = !mesh.triangles.empty() && balanced(mesh);
  drop_flat(result);
  if (mesh.triangles.empty()) {
    return Error{ErrorKind::bad_input,
                 "the mesh has no triangle with an area; check the unit it was exported in"};
  }
  return result;
}

Result<ClosedMesh> close_mesh(const TriangleMesh& mesh, const Progress& progress) {
  return no_throw("closing the mesh",
                  [&] { return close_soup(mesh, false, Pace(progress, "close")); });
}

}  // namespace argil::mesh
