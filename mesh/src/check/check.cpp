// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a mesh as a surface, kind by kind. Degenerate and crossing triangles are
// found by exact predicates (argil/mesh/intersections.h); most of the rest follows from the vertex
// numbers alone.
#include "argil/mesh/check.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <tbb/task_group.h>

#include "argil/core/no_throw.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/triangle_geometry.h"

#include "check/print_check.h"
#include "measure/crossing_pairs.h"
#include "measure/flat_fans.h"
#include "topology/repeated_triangles.h"

namespace argil::mesh {
namespace {

/// Runs `other` on a thread of its own while `own` runs on this one; what either throws is thrown
/// when both have ended.
template <class Other, class Own>
void run_beside(const Other& other, const Own& own) {
  tbb::task_group group;
  group.run(other);
  std::exception_ptr thrown;
  try {
    own();
  } catch (...) {
    thrown = std::current_exception();
  }
  group.wait();
  if (thrown) std::rethrow_exception(thrown);
}

class MeshCheck {
 public:
  explicit MeshCheck(const TriangleMesh& mesh) : mesh_(mesh) {}

  MeshVerdict judge(const Printer& printer, std::int64_t file_bytes, const WallMeasure& walls,
                    const Pace& pace);

 private:
  bool usable();
  void judge_edges(const EdgeTable& edges);
  void judge_vertices(const EdgeTable& edges);
  /// Triangles that are wrong by themselves or with others.
  struct Faults {
    std::vector<std::uint32_t> degenerate;
    std::vector<std::uint32_t> duplicate;
    std::vector<TrianglePair> crossing;
  };
  Faults find_faults(const Pace& pace) const;
  void tell(const Faults& faults);
  void judge_outward(const PartsAndVolumes& all);
  void tell_inward(const MeshParts& parts);
  void tell(const PrintFindings& found);
  void add(const std::string& kind, const Vec3& at_mm, double size_mm);
  void mark(std::size_t triangle, Mark as) noexcept;
  void add_intersection(std::size_t a, std::size_t b);

  const TriangleMesh& mesh_;
  /// Vertices about which nothing is wrong, so that edges and vertices there need no look.
  std::vector<std::uint8_t> is_flat_;
  MeshVerdict verdict_;
  std::map<std::string, int> kinds_;
};

void MeshCheck::add(const std::string& kind, const Vec3& at_mm, double size_mm) {
  // Counts are complete; the list of problems is for people, and a broken scan has millions.
  constexpr int kMostOfAKind = 100;
  if (++kinds_[kind] <= kMostOfAKind) verdict_.problems.push_back({kind, at_mm, size_mm});
}

void MeshCheck::mark(std::size_t triangle, Mark as) noexcept {
  assert(triangle < verdict_.marks.size());
  verdict_.marks[triangle] = std::max(verdict_.marks[triangle], as);
}

/// Whether every triangle names vertices that exist and are finite: everything else needs that.
bool MeshCheck::usable() {
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    if (*std::max_element(t.begin(), t.end()) >= mesh_.positions.size()) {
      add("missing_vertex", {}, 0.0);
    } else if (!is_finite(middle(corners_of(mesh_, i)))) {
      add("not_finite", {}, 0.0);
    }
  }
  return kinds_.empty() && !mesh_.triangles.empty();
}

void MeshCheck::judge_edges(const EdgeTable& edges) {
  const auto count = static_cast<HalfEdge>(3 * mesh_.triangles.size());
  for (HalfEdge h = 0; h < count; ++h) {
    if (is_flat_[edges.from(h)] != 0 || is_flat_[edges.to(h)] != 0) continue;
    const std::size_t edge = edges.edge_of(h);
    // Triangles that name a vertex twice have no edges; every other edge is looked at once, from
    // the first half-edge along it.
    if (edge >= edges.size() || edges.uses(edge)[0] != h) continue;
    const std::span<const HalfEdge> uses = edges.uses(edge);
    const Vec3& a = mesh_.positions[edges.from(h)];
    const Vec3& b = mesh_.positions[edges.to(h)];
    const bool is_right = uses.size() == 2 && edges.forward(uses[0]) != edges.forward(uses[1]);
    if (is_right) continue;
    for (const HalfEdge use : uses) mark(triangle_of(use), Mark::broken);
    if (uses.size() == 1) {
      ++verdict_.boundary_edges;
      add("boundary_edge", (a + b) / 2.0, length(b - a));
    } else if (uses.size() > 2) {
      ++verdict_.nonmanifold_edges;
      add("nonmanifold_edge", (a + b) / 2.0, length(b - a));
    } else {
      ++verdict_.misoriented_edges;
      add("misoriented_edge", (a + b) / 2.0, length(b - a));
    }
  }
}

/// A vertex is manifold when the triangles around it hang together by edges through it: the corners
/// at it, joined over every edge, form one set, as they do where they are flat. Also counts what
/// Euler's number needs.
void MeshCheck::judge_vertices(const EdgeTable& edges) {
  DisjointSets corners(3 * mesh_.triangles.size());
  const auto corner_at = [&](HalfEdge h, std::uint32_t v) {
    return edges.from(h) == v ? h : next_in_triangle(h);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::span<const HalfEdge> uses = edges.uses(e);
    for (const HalfEdge h : uses.subspan(1)) {
      for (const std::uint32_t v : {edges.from(h), edges.to(h)}) {
        if (is_flat_[v] == 0) corners.unite(corner_at(uses[0], v), corner_at(h, v));
      }
    }
  }
  std::vector<std::uint32_t> fans(mesh_.positions.size(), 0);
  std::int64_t triangles = 0;
  for (HalfEdge h = 0; h < 3 * mesh_.triangles.size(); ++h) {
    if (!edges.takes_part(triangle_of(h))) continue;
    triangles += h % 3 == 0 ? 1 : 0;
    if (is_flat_[edges.from(h)] != 0) {
      fans[edges.from(h)] = 1;
      continue;
    }
    if (corners.find(h) == h && ++fans[edges.from(h)] == 2) {
      ++verdict_.nonmanifold_vertices;
      mark(triangle_of(h), Mark::broken);
      add("nonmanifold_vertex", mesh_.positions[edges.from(h)], 0.0);
    }
  }
  const std::int64_t vertices =
      std::count_if(fans.begin(), fans.end(), [](auto n) { return n > 0; });
  // V - E + F: 2 less twice the handles for each closed part.
  verdict_.euler = vertices - static_cast<std::int64_t>(edges.size()) + triangles;
}

/// Where the boxes of two triangles overlap is where they meet, near enough to find it.
void MeshCheck::add_intersection(std::size_t a, std::size_t b) {
  mark(a, Mark::broken);
  mark(b, Mark::broken);
  std::array<Box3, 2> boxes;
  for (const std::uint32_t v : mesh_.triangles[a]) boxes[0].include(mesh_.positions[v]);
  for (const std::uint32_t v : mesh_.triangles[b]) boxes[1].include(mesh_.positions[v]);
  Box3 common = boxes[0];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    common.min[axis] = std::max(boxes[0].min[axis], boxes[1].min[axis]);
    common.max[axis] = std::min(boxes[0].max[axis], boxes[1].max[axis]);
  }
  add("self_intersection", common.center(), length(common.size()));
}

MeshCheck::Faults MeshCheck::find_faults(const Pace& pace) const {
  Faults faults;
  faults.degenerate = degenerate_triangles(mesh_);
  assert(std::is_sorted(faults.degenerate.begin(), faults.degenerate.end()));
  faults.duplicate = repeated_triangles(mesh_);
  faults.crossing = crossing_pairs(mesh_, faults.degenerate, is_flat_, pace);
  assert(std::is_sorted(faults.crossing.begin(), faults.crossing.end()));
  return faults;
}

void MeshCheck::tell(const Faults& faults) {
  const auto tell_each = [&](const std::vector<std::uint32_t>& triangles, const char* kind) {
    for (const std::uint32_t t : triangles) {
      mark(t, Mark::broken);
      add(kind, middle(corners_of(mesh_, t)), longest_side(corners_of(mesh_, t)));
    }
    return static_cast<std::int64_t>(triangles.size());
  };
  verdict_.degenerate = tell_each(faults.degenerate, "degenerate");
  verdict_.duplicate = tell_each(faults.duplicate, "duplicate");
  verdict_.self_intersections = static_cast<std::int64_t>(faults.crossing.size());
  for (const auto& [a, b] : faults.crossing) add_intersection(a, b);
}

void MeshCheck::judge_outward(const PartsAndVolumes& all) {
  const auto& [parts, volumes] = all;
  verdict_.components = parts.count;
  const bool whole = verdict_.closed && verdict_.manifold && verdict_.misoriented_edges == 0;
  // CGAL's test asks for closed parts that do not cross; of a single part the sign of its volume
  // says as much.
  if (!whole || parts.count == 1 || verdict_.self_intersections + verdict_.degenerate > 0) {
    verdict_.outward = verdict_.misoriented_edges == 0 && verdict_.volume_mm3 > 0.0;
  } else {
    // The part that reaches farthest along x lies in no other; CGAL judges the rest against it.
    std::size_t farthest = 0;
    double reach = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      for (const std::uint32_t v : mesh_.triangles[i]) {
        if (mesh_.positions[v].x > reach) {
          reach = mesh_.positions[v].x;
          farthest = parts.of_triangle[i];
        }
      }
    }
    verdict_.outward = volumes[farthest] > 0.0 && bounds_a_volume(mesh_);
  }
  if (verdict_.outward) return;
  if (!whole || verdict_.self_intersections + verdict_.degenerate > 0) {
    add("inward", used_bounds(mesh_).center(), length(used_bounds(mesh_).size()));
  } else {
    tell_inward(parts);
  }
}

/// Each part that faces the wrong way.
void MeshCheck::tell_inward(const MeshParts& parts) {
  const std::vector<bool> wrong = wrongly_turned(mesh_);
  assert(wrong.size() == mesh_.triangles.size());
  std::vector<Box3> boxes(parts.count);
  std::vector<bool> is_wrong(parts.count, false);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    if (!wrong[t]) continue;
    mark(t, Mark::broken);
    is_wrong[parts.of_triangle[t]] = true;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      boxes[parts.of_triangle[t]].include(mesh_.positions[v]);
    }
  }
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    if (is_wrong[p]) add("inward", boxes[p].center(), length(boxes[p].size()));
  }
  // A verdict that is not good says where, also should CGAL not say which part it is.
  if (std::none_of(is_wrong.begin(), is_wrong.end(), [](bool is) { return is; })) {
    add("inward", used_bounds(mesh_).center(), length(used_bounds(mesh_).size()));
  }
}

void MeshCheck::tell(const PrintFindings& found) {
  verdict_.cavities = found.cavities;
  verdict_.small_components = found.small_components;
  verdict_.overhang_mm2 = found.overhang_mm2;
  verdict_.min_wall_mm = found.min_wall_mm;
  verdict_.min_gap_mm = found.min_gap_mm;
  for (const auto& [triangle, as] : found.marks) mark(triangle, as);
  for (const MeshProblem& p : found.problems) add(p.kind, p.at_mm, p.size_mm);
  verdict_.printable = verdict_.printable && found.prints;
}

MeshVerdict MeshCheck::judge(const Printer& printer, std::int64_t file_bytes,
                             const WallMeasure& walls, const Pace& pace) {
  if (!usable()) return verdict_;
  pace.at(0.0);
  verdict_.marks.resize(mesh_.triangles.size(), Mark::none);
  std::optional<EdgeTable> table;
  PartsAndVolumes parts;
  Faults faults;
  // Edges are for one thread alone, so that they go beside what takes as long on several.
  run_beside(
      [&] {
        table.emplace(mesh_);
        parts.parts = mesh_parts(mesh_, *table, false);
        parts.volumes = part_volumes(mesh_, parts.parts);
      },
      [&] {
        is_flat_ = flat_fans(mesh_, pace.part(0.0, 0.2));
        faults = find_faults(pace.part(0.2, 0.8));
      });
  const EdgeTable& edges = *table;
  judge_edges(edges);
  judge_vertices(edges);
  tell(faults);
  verdict_.volume_mm3 = signed_volume(mesh_);
  verdict_.area_mm2 = surface_area(mesh_);
  verdict_.closed = verdict_.boundary_edges == 0;
  verdict_.manifold = verdict_.nonmanifold_edges + verdict_.nonmanifold_vertices == 0;
  judge_outward(parts);
  verdict_.printable = verdict_.closed && verdict_.manifold && verdict_.outward &&
                       verdict_.self_intersections + verdict_.degenerate + verdict_.duplicate == 0;
  verdict_.size_mm = used_bounds(mesh_).size();
  pace.at(0.9);
  tell(print_findings(mesh_, edges, parts, printer, file_bytes, walls, pace.part(0.9, 1.0)));
  return verdict_;
}

}  // namespace

MeshVerdict check_mesh(const TriangleMesh& mesh_mm, double min_wall_mm) {
  Printer printer;
  printer.min_wall_mm = min_wall_mm;
  const Progress nobody;
  try {
    return judge_mesh(mesh_mm, printer, 0, wall_thickness, Pace(nobody, "check"));
  } catch (const std::exception&) {
    MeshVerdict verdict;
    verdict.problems.push_back({"not_checked", {}, 0.0});
    return verdict;
  }
}

Result<MeshVerdict> check_print(const TriangleMesh& mesh_mm, const Printer& printer,
                                std::int64_t file_bytes, const Progress& progress) {
  return no_throw("the mesh", [&]() -> Result<MeshVerdict> {
    return judge_mesh(mesh_mm, printer, file_bytes, wall_thickness, Pace(progress, "check"));
  });
}

MeshVerdict judge_mesh(const TriangleMesh& mesh_mm, const Printer& printer, std::int64_t file_bytes,
                       const WallMeasure& walls, const Pace& pace) {
  return MeshCheck(mesh_mm).judge(printer, file_bytes, walls, pace);
}

}  // namespace argil::mesh
