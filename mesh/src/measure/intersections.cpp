// SPDX-License-Identifier: GPL-3.0-or-later
// Exact answers by CGAL. Its kernel computes with doubles and a bound of their error, and
// with exact numbers only where that does not decide the sign. What flat fans and separating planes
// decide in doubles, bounded alike, is most of a surface and does not come so far.
#include "argil/mesh/intersections.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <tbb/parallel_for.h>

#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "measure/apart.h"
#include "measure/crossing_pairs.h"
#include "measure/flat_fans.h"
#include "measure/triangle_grid.h"

namespace argil::mesh {
namespace {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Epick::Point_3;

std::vector<Point> points_of(const TriangleMesh& mesh) {
  std::vector<Point> points;
  points.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  return points;
}

Point exact_point(const Vec3& p) { return {p.x, p.y, p.z}; }

/// The pairwise test, by index: what two triangles share is not an intersection.
class PairTest {
 public:
  PairTest(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_flat)
      : mesh_(mesh), is_flat_(is_flat) {}

  const std::vector<std::uint8_t>& is_flat() const noexcept { return is_flat_; }

  bool operator()(std::uint32_t a, std::uint32_t b) const {
    const Triangle& p = mesh_.triangles[a];
    const Triangle& q = mesh_.triangles[b];
    std::array<std::size_t, 3> shared_p{};
    std::array<std::size_t, 3> shared_q{};
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::find(q.begin(), q.end(), p[i]);
      if (found == q.end()) continue;
      shared_p[shared] = i;
      shared_q[shared++] = static_cast<std::size_t>(found - q.begin());
    }
    assert(shared <= 3);
    for (std::size_t i = 0; i < shared; ++i) {
      if (is_flat_[p[shared_p[i]]] != 0) return false;
    }
    // Neighbours meet in the vertices they share, which is no crossing. With all three in common
    // they are duplicates, which are counted elsewhere.
    if (shared == 0) {
      return !are_apart(corners_of(mesh_, a), corners_of(mesh_, b)) &&
             CGAL::do_intersect(triangle(p), triangle(q));
    }
    if (shared == 1) return meet_beyond_vertex(p, shared_p[0], q, shared_q[0]);
    if (shared == 2)
      return folded_over_edge(p, 3 - shared_p[0] - shared_p[1], q, 3 - shared_q[0] - shared_q[1]);
    return false;
  }

 private:
  Point at(const Triangle& c, std::size_t i) const {
    return exact_point(mesh_.positions[c[i % 3]]);
  }
  Epick::Triangle_3 triangle(const Triangle& c) const { return {at(c, 0), at(c, 1), at(c, 2)}; }

  /// One shared vertex: does the side opposite to it in one triangle touch the other?
  bool meet_beyond_vertex(const Triangle& p, std::size_t i, const Triangle& q,
                          std::size_t j) const {
    const Epick::Segment_3 opposite_p(at(p, i + 1), at(p, i + 2));
    const Epick::Segment_3 opposite_q(at(q, j + 1), at(q, j + 2));
    return CGAL::do_intersect(triangle(p), opposite_q) ||
           CGAL::do_intersect(triangle(q), opposite_p);
  }

  /// A shared edge: both lie in one plane and on the same side of it? `i` and `j` are the corners
  /// that are not shared.
  bool folded_over_edge(const Triangle& p, std::size_t i, const Triangle& q, std::size_t j) const {
    const Point a = at(p, i + 1);
    const Point b = at(p, i + 2);
    return CGAL::coplanar(a, b, at(p, i), at(q, j)) &&
           CGAL::coplanar_orientation(a, b, at(p, i), at(q, j)) == CGAL::POSITIVE;
  }

  const TriangleMesh& mesh_;
  const std::vector<std::uint8_t>& is_flat_;
};

using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

constexpr auto kMostPairs = static_cast<std::size_t>(kMostCrossings);

class EnoughPairs : public std::exception {
 public:
  const char* what() const noexcept override { return "enough pairs"; }
};

/// Triangles by where they begin along one axis, to be looked at slab by slab: a pair is found in
/// the slab in which the later of the two begins, so that memory goes with the largest slab.
class Slabs {
 public:
  Slabs(const TriangleMesh& mesh, const std::vector<std::uint32_t>& left_out,
        const PairTest& meets);

  std::size_t count() const noexcept { return first_.size() - 1; }
  /// The pairs of one slab, kMostPairs at most, found in the same order each time.
  std::vector<TrianglePair> pairs(std::size_t slab) const;

 private:
  /// Along the axis, from where to where.
  std::pair<double, double> extent(std::uint32_t t) const noexcept {
    const auto& [a, b, c] = mesh_.triangles[t];
    return std::minmax(
        {mesh_.positions[a][axis_], mesh_.positions[b][axis_], mesh_.positions[c][axis_]});
  }
  Box box_of(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {exact_point(mesh_.positions[a]).bbox() + exact_point(mesh_.positions[b]).bbox() +
                exact_point(mesh_.positions[c]).bbox(),
            t};
  }
  void sort(const Box3& box);
  void find_reach();
  template <class Use>
  void sweep(const std::vector<std::uint32_t>& numbers, const Use& use) const;

  const TriangleMesh& mesh_;
  const PairTest& meets_;
  std::size_t axis_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> first_;                 ///< of each slab in order_, one more at the end
  std::vector<std::vector<std::uint32_t>> reach_;  ///< what began before each slab and reaches it
};

Slabs::Slabs(const TriangleMesh& mesh, const std::vector<std::uint32_t>& left_out,
             const PairTest& meets)
    : mesh_(mesh), meets_(meets) {
  assert(std::is_sorted(left_out.begin(), left_out.end()));
  const Box3 box = bounds(mesh);
  const Vec3 size = box.size();
  for (std::size_t k = 1; k < 3; ++k) axis_ = size[k] > size[axis_] ? k : axis_;
  order_.reserve(mesh.triangles.size());
  auto next = left_out.begin();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (next != left_out.end() && *next == t) {
      ++next;
    } else {
      order_.push_back(t);
    }
  }
  sort(box);
  find_reach();
}

/// Into slices much thinner than a slab, of which slabs are made.
void Slabs::sort(const Box3& box) {
  constexpr std::size_t kTriangles = 131'072;  // a slab takes some 10 MB
  constexpr std::size_t kSlices = 4096;
  if (order_.size() <= kTriangles) {
    first_ = {0, order_.size()};
    return;
  }
  const double low = box.min[axis_];
  const double per_mm = kSlices / (box.max[axis_] - low);
  const auto slice_of = [&](std::uint32_t t) {
    return std::min(kSlices - 1, static_cast<std::size_t>((extent(t).first - low) * per_mm));
  };
  std::vector<std::size_t> begin(kSlices + 1, 0);
  for (const std::uint32_t t : order_) ++begin[slice_of(t) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  first_.push_back(0);
  for (const std::size_t at : begin) {
    if (at - first_.back() >= kTriangles) first_.push_back(at);
  }
  if (first_.back() != order_.size()) first_.push_back(order_.size());
  std::vector<std::uint32_t> sorted(order_.size());
  for (const std::uint32_t t : order_) sorted[begin[slice_of(t)]++] = t;
  order_ = std::move(sorted);
}

void Slabs::find_reach() {
  std::vector<double> begins(count(), std::numeric_limits<double>::infinity());
  for (std::size_t slab = 0; slab < count(); ++slab) {
    for (std::size_t i = first_[slab]; i < first_[slab + 1]; ++i) {
      begins[slab] = std::min(begins[slab], extent(order_[i]).first);
    }
  }
  assert(std::is_sorted(begins.begin(), begins.end()));
  reach_.resize(count());
  std::size_t reaching = 0;
  for (std::size_t slab = 0; slab < count(); ++slab) {
    for (std::size_t i = first_[slab]; i < first_[slab + 1]; ++i) {
      const double end = extent(order_[i]).second;
      for (std::size_t to = slab + 1; to < reach_.size() && begins[to] <= end; ++to) {
        reach_[to].push_back(order_[i]);
        ++reaching;
      }
      // Where most reach through many slabs one slab is less work than all of them.
      if (reaching > order_.size()) {
        first_ = {0, order_.size()};
        reach_.assign(1, {});
        return;
      }
    }
  }
}

/// As TriangleGrid::for_each_pair, whatever sizes the triangles have.
template <class Use>
void Slabs::sweep(const std::vector<std::uint32_t>& numbers, const Use& use) const {
  constexpr std::ptrdiff_t kCutoff = 2000;  // below this many scanning beats splitting further
  std::vector<Box> boxes;
  boxes.reserve(numbers.size());
  for (const std::uint32_t t : numbers) boxes.push_back(box_of(t));
  std::vector<Box*> pointers;
  pointers.reserve(boxes.size());
  for (Box& box : boxes) pointers.push_back(&box);
  const auto place = [&](const Box* box) { return static_cast<std::size_t>(box - boxes.data()); };
  CGAL::box_self_intersection_d(
      pointers.begin(), pointers.end(),
      [&](const Box* a, const Box* b) { use(place(a), place(b)); }, kCutoff);
}

std::vector<TrianglePair> Slabs::pairs(std::size_t slab) const {
  assert(slab < count());
  const std::size_t own = reach_[slab].size();
  std::vector<std::uint32_t> numbers = reach_[slab];
  numbers.insert(numbers.end(), order_.begin() + static_cast<std::ptrdiff_t>(first_[slab]),
                 order_.begin() + static_cast<std::ptrdiff_t>(first_[slab + 1]));
  std::vector<TrianglePair> pairs;
  const auto look_at = [&](std::size_t i, std::size_t j) {
    if (i < own && j < own) return;  // found in a slab before
    const auto [low, high] = std::minmax(numbers[i], numbers[j]);
    if (!meets_(low, high)) return;
    pairs.emplace_back(low, high);
    if (pairs.size() == kMostPairs) throw EnoughPairs();
  };
  try {
    const TriangleGrid grid(mesh_, numbers, meets_.is_flat());
    if (grid.fits()) {
      grid.for_each_pair(look_at);
    } else {
      sweep(numbers, look_at);
    }
  } catch (const EnoughPairs&) {  // the only way out of CGAL's loops
  }
  return pairs;
}

}  // namespace

std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh) {
  const std::vector<Point> points = points_of(mesh);
  std::vector<std::uint32_t> degenerate;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (CGAL::collinear(points[a], points[b], points[c])) degenerate.push_back(t);
  }
  return degenerate;
}

std::vector<TrianglePair> crossing_pairs(const TriangleMesh& mesh,
                                         const std::vector<std::uint32_t>& left_out,
                                         const std::vector<std::uint8_t>& is_flat,
                                         const Pace& pace) {
  // Slabs in memory at once, some 40 MB; between them a person may interrupt.
  constexpr std::size_t kAtATime = 4;
  const PairTest meets(mesh, is_flat);
  const Slabs slabs(mesh, left_out, meets);
  std::vector<TrianglePair> pairs;
  for (std::size_t first = 0; first < slabs.count() && pairs.size() < kMostPairs;
       first += kAtATime) {
    pace.at(static_cast<double>(first) / static_cast<double>(slabs.count()));
    std::array<std::vector<TrianglePair>, kAtATime> found;
    tbb::parallel_for(first, std::min(first + kAtATime, slabs.count()),
                      [&](std::size_t slab) { found[slab - first] = slabs.pairs(slab); });
    for (const auto& of : found) pairs.insert(pairs.end(), of.begin(), of.end());
  }
  // Cut off in the order of the slabs, not of the threads.
  pairs.resize(std::min(pairs.size(), kMostPairs));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<TrianglePair> self_intersections(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& left_out,
                                             const Pace& pace) {
  const std::vector<std::uint8_t> is_flat = flat_fans(mesh, pace.part(0.0, 0.2));
  return crossing_pairs(mesh, left_out, is_flat, pace.part(0.2, 1.0));
}

std::vector<TrianglePair> self_intersections(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& left_out) {
  const Progress nobody;
  return self_intersections(mesh, left_out, Pace(nobody, ""));
}

namespace {

using Surface = CGAL::Surface_mesh<Point>;

/// Nothing where CGAL takes a face for not two-manifold.
std::optional<Surface> surface_of(const TriangleMesh& mesh) {
  Surface surface;
  surface.reserve(static_cast<unsigned>(mesh.positions.size()),
                  static_cast<unsigned>(3 * mesh.triangles.size() / 2),
                  static_cast<unsigned>(mesh.triangles.size()));
  using VertexIndex = Surface::Vertex_index;
  for (const Point& p : points_of(mesh)) surface.add_vertex(p);
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(VertexIndex(a), VertexIndex(b), VertexIndex(c)) == surface.null_face()) {
      return std::nullopt;
    }
  }
  return surface;
}

}  // namespace

bool bounds_a_volume(const TriangleMesh& mesh) {
  // CGAL asks where every vertex lies, also those of no triangle.
  const std::optional<Surface> surface = surface_of(compacted(mesh));
  return surface && CGAL::Polygon_mesh_processing::does_bound_a_volume(*surface);
}

std::vector<bool> wrongly_turned(const TriangleMesh& mesh) {
  std::vector<bool> wrong(mesh.triangles.size(), false);
  const TriangleMesh used = compacted(mesh);
  std::optional<Surface> surface = surface_of(used);
  if (!surface) return wrong;
  assert(surface->number_of_faces() == wrong.size());
  CGAL::Polygon_mesh_processing::orient_to_bound_a_volume(*surface);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    // Behind the first corner comes the second, or where it was turned the third.
    auto h = surface->halfedge(Surface::Face_index(static_cast<Surface::size_type>(t)));
    const Triangle& corners = used.triangles[t];
    while (static_cast<std::uint32_t>(surface->target(h)) != corners[0]) h = surface->next(h);
    wrong[t] = static_cast<std::uint32_t>(surface->target(surface->next(h))) != corners[1];
  }
  return wrong;
}

}  // namespace argil::mesh
