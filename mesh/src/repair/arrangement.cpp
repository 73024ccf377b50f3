// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/arrangement.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>

#include "argil/mesh/edges.h"

#include "repair/cgal.h"

namespace argil::mesh {
namespace {

constexpr std::uint32_t kUnnumbered = std::numeric_limits<std::uint32_t>::max();

struct PointNumber {
  std::uint32_t value = kUnnumbered;
};
using CutVertex = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, Exact>;
using CutCells =
    CGAL::Triangulation_data_structure_2<CutVertex,
                                         CGAL::Constrained_triangulation_face_base_2<Exact>>;
using CutPlane =
    CGAL::Constrained_Delaunay_triangulation_2<Exact, CutCells, CGAL::Exact_intersections_tag>;
using SeenPlace = Exact::Point_2;

/// Seen along one axis, so that nothing is seen edge on.
class Projection {
 public:
  explicit Projection(const std::array<ExactPoint, 3>& corners);

  SeenPlace operator()(const ExactPoint& p) const {
    return {p[static_cast<int>(u_)], p[static_cast<int>(v_)]};
  }
  /// The point of the plane that is seen there.
  ExactPoint back(const SeenPlace& p) const;

 private:
  std::size_t u_ = 0;
  std::size_t v_ = 1;
  ExactPoint origin_;
  std::array<Exact::FT, 3> normal_;
};

Projection::Projection(const std::array<ExactPoint, 3>& corners) : origin_(corners[0]) {
  const Exact::Vector_3 normal =
      CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
  std::size_t axis = 3;
  double most = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    normal_[k] = normal[static_cast<int>(k)];
    const double size = std::abs(CGAL::to_double(normal_[k]));
    if (size <= most || CGAL::is_zero(normal_[k])) continue;
    most = size;
    axis = k;
  }
  assert(axis < 3);  // a triangle without area would be seen from nowhere
  u_ = (axis + 1) % 3;
  v_ = (axis + 2) % 3;
}

ExactPoint Projection::back(const SeenPlace& p) const {
  std::array<Exact::FT, 3> at;
  const std::size_t axis = 3 - u_ - v_;
  at[u_] = p.x();
  at[v_] = p.y();
  const auto from = [&](std::size_t k) { return at[k] - origin_[static_cast<int>(k)]; };
  at[axis] = origin_[static_cast<int>(axis)] -
             (normal_[u_] * from(u_) + normal_[v_] * from(v_)) / normal_[axis];
  return {at[0], at[1], at[2]};
}

/// A triangle in its plane, from which it is taken which faces it covers.
struct SeenTriangle {
  std::array<SeenPlace, 3> corners;
  CGAL::Bbox_2 box;
  bool is_forward;  ///< counterclockwise

  /// Of a point that is on none of its sides.
  bool covers(const SeenPlace& p) const {
    if (!CGAL::do_overlap(box, p.bbox())) return false;
    const auto turn = is_forward ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN;
    for (std::size_t k = 0; k < 3; ++k) {
      if (CGAL::orientation(corners[k], corners[(k + 1) % 3], p) != turn) return false;
    }
    return true;
  }
};

}  // namespace

/// What triangles have in common with others: points by number; a segment has two.
struct Arrangement::Lines {
  explicit Lines(std::size_t triangles) : of(triangles), planes(triangles) {}
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> of;
  DisjointSets planes;  ///< triangles that lie on one another
};

/// Triangles that lie on one another, or one alone.
struct Arrangement::Plane {
  std::vector<std::uint32_t> triangles;
};

ExactPoint Arrangement::point(std::uint32_t number) const {
  if (number < mesh_.positions.size()) return exact_point_of(mesh_.positions[number]);
  return added_[number - mesh_.positions.size()];
}

Vec3 Arrangement::rounded_point(std::uint32_t number) const {
  if (number < mesh_.positions.size()) return mesh_.positions[number];
  return nearest_doubles(added_[number - mesh_.positions.size()]);
}

std::uint32_t Arrangement::number_of(const ExactPoint& p) {
  const auto [at, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points()));
  if (is_new) added_.push_back(p);
  return at->second;
}

void Arrangement::meet(const TrianglePair& pair, Lines& lines) {
  const auto exact = [&](std::uint32_t t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    return Exact::Triangle_3(point(a), point(b), point(c));
  };
  const auto common = CGAL::intersection(exact(pair.first), exact(pair.second));
  if (!common) return;
  const auto add = [&](const ExactPoint& p, const ExactPoint& q) {
    const std::pair<std::uint32_t, std::uint32_t> line{number_of(p), number_of(q)};
    lines.of[pair.first].push_back(line);
    lines.of[pair.second].push_back(line);
  };
  if (const auto* p = held<ExactPoint>(*common)) add(*p, *p);
  if (const auto* s = held<Exact::Segment_3>(*common)) add(s->source(), s->target());
  // Where they overlap, the sides of the one cut the other: they are cut together.
  if (held<Exact::Triangle_3>(*common) != nullptr ||
      held<std::vector<ExactPoint>>(*common) != nullptr) {
    lines.planes.unite(pair.first, pair.second);
  }
}

void Arrangement::cut(const Plane& plane, const Lines& lines) {
  const auto corners_of = [&](std::uint32_t t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    return std::array<ExactPoint, 3>{point(a), point(b), point(c)};
  };
  const Projection seen(corners_of(plane.triangles.front()));
  CutPlane cells;
  std::map<std::uint32_t, CutPlane::Vertex_handle> vertices;
  const auto vertex = [&](std::uint32_t number) {
    auto [at, is_new] = vertices.try_emplace(number);
    if (is_new) {
      at->second = cells.insert(seen(point(number)));
      at->second->info().value = number;
    }
    return at->second;
  };
  std::vector<SeenTriangle> covers;
  for (const std::uint32_t t : plane.triangles) {
    const std::array<ExactPoint, 3> at = corners_of(t);
    SeenTriangle one{{seen(at[0]), seen(at[1]), seen(at[2])}, {}, false};
    one.box = one.corners[0].bbox() + one.corners[1].bbox() + one.corners[2].bbox();
    one.is_forward =
        CGAL::orientation(one.corners[0], one.corners[1], one.corners[2]) == CGAL::LEFT_TURN;
    covers.push_back(one);
    for (const std::uint32_t v : mesh_.triangles[t]) vertex(v);
    for (const auto& [p, q] : lines.of[t]) vertex(p), vertex(q);
  }
  for (const std::uint32_t t : plane.triangles) {
    const auto& [a, b, c] = mesh_.triangles[t];
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      cells.insert_constraint(vertex(p), vertex(q));
    }
    for (const auto& [p, q] : lines.of[t]) {
      if (p != q) cells.insert_constraint(vertex(p), vertex(q));
    }
  }
  for (auto f = cells.finite_faces_begin(); f != cells.finite_faces_end(); ++f) {
    ArrangedFace face{{}, 0};
    for (int k = 0; k < 3; ++k) {
      PointNumber& number = f->vertex(k)->info();
      // Where lines cross within the plane.
      if (number.value == kUnnumbered) number.value = number_of(seen.back(f->vertex(k)->point()));
      face.corners[static_cast<std::size_t>(k)] = number.value;
    }
    const SeenPlace middle =
        CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    for (const SeenTriangle& one : covers) {
      if (one.covers(middle)) face.jump += one.is_forward ? 1 : -1;
    }
    if (face.jump < 0) {
      std::swap(face.corners[1], face.corners[2]);
      face.jump = -face.jump;
    }
    if (face.jump > 0) faces_.push_back(face);
  }
}

Arrangement::Arrangement(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs,
                         const Pace& pace)
    : mesh_(mesh) {
  constexpr std::size_t kAtATime = 256;
  Lines lines(mesh.triangles.size());
  std::vector<bool> meets(mesh.triangles.size(), false);
  for (const auto& [a, b] : pairs) meets[a] = meets[b] = true;
  for (std::uint32_t t = 0; t < meets.size(); ++t) {
    if (!meets[t]) {
      faces_.push_back({mesh.triangles[t], 1});
      continue;
    }
    for (const std::uint32_t v : mesh.triangles[t]) numbers_.try_emplace(point(v), v);
  }
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (n % kAtATime == 0) {
      pace.at(0.5 * static_cast<double>(n) / static_cast<double>(pairs.size()));
    }
    meet(pairs[n], lines);
  }
  std::map<std::uint32_t, Plane> planes;  // by their first triangle
  for (std::uint32_t t = 0; t < meets.size(); ++t) {
    if (meets[t]) planes[lines.planes.find(t)].triangles.push_back(t);
  }
  std::size_t done = 0;
  for (const auto& [first, plane] : planes) {
    if (done++ % kAtATime == 0) {
      pace.at(0.5 + 0.5 * static_cast<double>(done) / static_cast<double>(planes.size()));
    }
    cut(plane, lines);
  }
}

}  // namespace argil::mesh
