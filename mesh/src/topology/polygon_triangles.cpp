// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons by CGAL's constrained Delaunay triangulation, in the plane of the two axes that show
// most of their area.
#include "argil/mesh/polygon_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <numeric>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

namespace argil::mesh {
namespace {

constexpr int kNotSeen = -1;

using ExactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanePoint = ExactKernel::Point_2;

class TooManyQuestions : public std::exception {
 public:
  const char* what() const noexcept override { return "too many questions"; }
};

/// A predicate that throws when all together were asked too often: nothing that CGAL does here goes
/// on for long without asking.
template <class Predicate>
class Counted {
 public:
  explicit Counted(std::uint64_t* left) : left_(left) {}

  template <class... Points>
  auto operator()(const Points&... points) const {
    if (left_ != nullptr && (*left_)-- == 0) throw TooManyQuestions();
    return Predicate()(points...);
  }

 private:
  std::uint64_t* left_;  ///< null: as often as wanted
};

struct PlaneKernel : ExactKernel {
  using Orientation_2 = Counted<ExactKernel::Orientation_2>;
  using Side_of_oriented_circle_2 = Counted<ExactKernel::Side_of_oriented_circle_2>;

  PlaneKernel() = default;
  explicit PlaneKernel(std::uint64_t* questions_left) : left(questions_left) {}
  Orientation_2 orientation_2_object() const { return Orientation_2(left); }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const {
    return Side_of_oriented_circle_2(left);
  }

  std::uint64_t* left = nullptr;
};

using CornerBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, PlaneKernel>;
/// How many edges lie between a face and the outside.
using DepthBase = CGAL::Triangulation_face_base_with_info_2<int, PlaneKernel>;
using PlaneFaceBase = CGAL::Constrained_triangulation_face_base_2<PlaneKernel, DepthBase>;
using PlaneStructure = CGAL::Triangulation_data_structure_2<CornerBase, PlaneFaceBase>;
using Crossing = CGAL::No_constraint_intersection_requiring_constructions_tag;
using PlaneTriangles =
    CGAL::Constrained_Delaunay_triangulation_2<PlaneKernel, PlaneStructure, Crossing>;
using CornerHandle = PlaneTriangles::Vertex_handle;
using FaceHandle = PlaneTriangles::Face_handle;
/// How often the polygon goes along an edge of the triangulation, by its corners.
using EdgeUses = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

/// Twice the area as a vector (Newell), from the first corner, which keeps digits of small polygons
/// far away.
Vec3 area_of_polygon(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

/// The two axes that see the polygon counter-clockwise along its normal.
std::pair<std::size_t, std::size_t> axes_of(const Vec3& area) {
  std::size_t away = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    if (std::abs(area[a]) > std::abs(area[away])) away = a;
  }
  const std::size_t first = (away + 1) % 3;
  const std::size_t second = (away + 2) % 3;
  return area[away] > 0.0 ? std::pair{first, second} : std::pair{second, first};
}

std::pair<std::uint32_t, std::uint32_t> edge_name(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

/// Depths of all faces, from the outside inwards.
void count_depths(const PlaneTriangles& plane, const EdgeUses& uses) {
  std::vector<FaceHandle> next{plane.infinite_face()};
  next.front()->info() = 0;
  while (!next.empty()) {
    const FaceHandle face = next.back();
    next.pop_back();
    for (int side = 0; side < 3; ++side) {
      const FaceHandle other = face->neighbor(side);
      if (other->info() != kNotSeen) continue;
      int crossed = 0;
      if (face->is_constrained(side)) {
        const auto found = uses.find(edge_name(face->vertex(PlaneTriangles::ccw(side))->info(),
                                               face->vertex(PlaneTriangles::cw(side))->info()));
        // A corner that lies on another edge halves it: each half is gone along once.
        crossed = found != uses.end() ? found->second : 1;
      }
      other->info() = face->info() + crossed;
      next.push_back(other);
    }
  }
}

std::vector<Triangle> inside_of(const PlaneTriangles& plane) {
  std::vector<Triangle> triangles;
  for (const FaceHandle face : plane.finite_face_handles()) {
    // The even-odd rule.
    if (face->info() % 2 == 0) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

std::vector<PlanePoint> seen_along(const Vec3& area, std::span<const Vec3> corners) {
  const auto [x, y] = axes_of(area);
  std::vector<PlanePoint> points;
  points.reserve(corners.size());
  for (const Vec3& corner : corners) points.emplace_back(corner[x], corner[y]);
  return points;
}

/// For each corner the first one at its point.
std::vector<std::size_t> first_at_point(const std::vector<PlanePoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  std::vector<std::size_t> first(points.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool is_again = n > 0 && points[order[n]] == points[order[n - 1]];
    first[order[n]] = is_again ? first[order[n - 1]] : order[n];
  }
  return first;
}

/// Each corner's vertex, which is named after the first of those at its point. In the order of the
/// polygon some (a parabola's) would each replace all triangles that are there; and one that is
/// there already would ask about all triangles around it, as often as the polygon comes there.
std::vector<CornerHandle> insert_corners(const std::vector<PlanePoint>& points,
                                         PlaneTriangles& plane) {
  using PointMap = CGAL::Pointer_property_map<PlanePoint>::const_type;
  const std::vector<std::size_t> first = first_at_point(points);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == i) order.push_back(i);
  }
  CGAL::spatial_sort(
      order.begin(), order.end(),
      CGAL::Spatial_sort_traits_adapter_2<ExactKernel, PointMap>(CGAL::make_property_map(points)));
  std::vector<CornerHandle> handles(points.size());
  FaceHandle near;
  for (const std::size_t i : order) {
    handles[i] = plane.insert(points[i], near);
    handles[i]->info() = static_cast<std::uint32_t>(i);
    near = handles[i]->face();
  }
  for (std::size_t i = 0; i < points.size(); ++i) handles[i] = handles[first[i]];
  return handles;
}

/// The edges, each once, as vertices of which the first has fewer edges: CGAL looks through the
/// triangles around it.
std::vector<std::pair<CornerHandle, CornerHandle>> edges_of(
    const std::vector<CornerHandle>& handles, EdgeUses& uses) {
  std::vector<std::uint32_t> edges_at(handles.size(), 0);
  for (const CornerHandle corner : handles) ++edges_at[corner->info()];
  std::vector<std::pair<CornerHandle, CornerHandle>> edges;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    CornerHandle from = handles[i];
    CornerHandle to = handles[(i + 1) % handles.size()];
    if (from == to || ++uses[edge_name(from->info(), to->info())] > 1) continue;
    if (edges_at[from->info()] > edges_at[to->info()]) std::swap(from, to);
    edges.emplace_back(from, to);
  }
  return edges;
}

/// Calls `act` with all numbers below `count`, any first few of them far from each other.
template <class Act>
void for_each_scattered(std::size_t count, const Act& act) {
  constexpr double kGolden = 0.6180339887498949;
  auto step = static_cast<std::size_t>(kGolden * static_cast<double>(count)) + 1;
  while (std::gcd(step, count) != 1) ++step;
  for (std::size_t n = 0, i = 0; n < count; ++n, i = (i + step) % count) act(i);
}

/// The triangulation with all edges, depths not yet counted. Throws what CGAL does where they
/// cross, and TooManyQuestions.
EdgeUses insert_polygon(const std::vector<PlanePoint>& points, PlaneTriangles& plane) {
  EdgeUses uses;
  const std::vector<CornerHandle> handles = insert_corners(points, plane);
  const auto edges = edges_of(handles, uses);
  // One beside the other, each edge of a bundle would cross as many triangles as the first.
  for_each_scattered(edges.size(), [&](std::size_t i) {
    plane.insert_constraint(edges[i].first, edges[i].second);
  });
  return uses;
}

}  // namespace

std::vector<Triangle> triangulated(std::span<const Vec3> corners) {
  const Vec3 area = area_of_polygon(corners);
  // No plane in which it has an area.
  if (area == Vec3{}) return {};
  std::uint64_t questions = kQuestionsPerCorner * corners.size();
  PlaneTriangles plane{PlaneKernel(&questions)};
  EdgeUses uses;
  try {
    uses = insert_polygon(seen_along(area, corners), plane);
  } catch (const PlaneTriangles::Intersection_of_constraints_exception&) {
    return {};
  } catch (const TooManyQuestions&) {
    return {};
  }
  if (plane.dimension() < 2) return {};
  for (const FaceHandle face : plane.all_face_handles()) face->info() = kNotSeen;
  count_depths(plane, uses);
  return inside_of(plane);
}

}  // namespace argil::mesh
