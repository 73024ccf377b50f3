// SPDX-License-Identifier: GPL-3.0-or-later
// A tree over the triangles; far clusters count as dipole and quadrupole, near triangles exactly.
// The angles of near triangles are multiplied as complex numbers, with turns counted, and one arc
// tangent is taken at the end.
#include "argil/core/winding_number.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "argil/core/closest_on_triangle.h"

namespace argil {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr int kMaxDepth = 64;  // halving 2^32 triangles takes 32

/// atan t for |t| <= tan(pi/16): the series to t^19, error below 1e-15.
double small_atan(double t) noexcept {
  const double s = t * t;
  double sum = 0.0;
  for (int k = 19; k >= 1; k -= 2) sum = 1.0 / k - s * sum;
  return t * sum;
}

/// A running product of unit complex numbers that remembers how often its angle passed pi.
class AngleSum {
 public:
  void add(const HalfAngle& f) noexcept {
    const double re = re_ * f.re - im_ * f.im;
    const double im = re_ * f.im + im_ * f.re;
    if (f.im > 0.0 && im_ >= 0.0 && im < 0.0) ++turns_;
    if (f.im < 0.0 && im_ < 0.0 && im >= 0.0) --turns_;
    const double size = std::abs(re) + std::abs(im);
    // Only the direction matters. Left alone, the size of a product of thousands would underflow.
    const double scale = size > 0.0 ? 1.0 / size : 1.0;
    re_ = re * scale;
    im_ = im * scale;
  }
  /// The sum in turns of 2 pi.
  double turns() const noexcept {
    return turns_ + polar_angle(re_, im_) / (2.0 * std::numbers::pi);
  }

 private:
  double re_ = 1.0;
  double im_ = 0.0;
  int turns_ = 0;
};

Vec3 centroid(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return (a + b + c) / 3.0; }

}  // namespace

double polar_angle(double x, double y) noexcept {
  const double r = std::sqrt(x * x + y * y);
  if (!(r > 0.0)) return 0.0;
  if (x < 0.0) {  // turn by half a turn, so that the half-angle below is well conditioned
    const double turned = polar_angle(-x, -y);
    return y < 0.0 ? turned - std::numbers::pi : turned + std::numbers::pi;
  }
  double t = y / (x + r);                  // tan of a half, |t| <= 1
  t = t / (1.0 + std::sqrt(1.0 + t * t));  // a quarter
  t = t / (1.0 + std::sqrt(1.0 + t * t));  // an eighth, |t| <= tan(pi/16)
  return 8.0 * small_atan(t);
}

/// Scaled to |re| + |im| = 1, so that products of many keep their exponents small. (0, 0) comes
/// from a point on an edge or corner, where the angle is not defined; it counts as 0.
HalfAngle half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  // A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", 1983.
  const double la = length(a);
  const double lb = length(b);
  const double lc = length(c);
  const double im = dot(a, cross(b, c));
  const double re = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  const double size = std::abs(re) + std::abs(im);
  if (!(size > 0.0)) return {};
  return {re / size, im / size};
}

WindingNumber::WindingNumber(const std::vector<Vec3>& positions,
                             const std::vector<Triangle>& triangles, double far_radii)
    : far_radii_(far_radii) {
  assert(far_radii >= 1.5 && far_radii <= 10.0);
  std::vector<Corners> all;
  all.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Corners corners{positions[t[0]], positions[t[1]], positions[t[2]]};
    const Vec3 twice_area = cross(corners.b - corners.a, corners.c - corners.a);
    if (dot(twice_area, twice_area) > 0.0)
      all.push_back(corners);  // the others are seen as nothing
  }
  std::vector<std::uint32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0U);
  triangles_.resize(all.size());
  if (all.empty()) return;
  nodes_.reserve(2 * all.size() / (kLeafTriangles / 2) + 1);
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(all.size()), order, all);
}

void WindingNumber::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
                          std::vector<std::uint32_t>& order, const std::vector<Corners>& all) {
  assert(begin < end && end <= all.size());
  nodes_[node].first = begin;
  nodes_[node].count = end - begin;
  if (end - begin <= kLeafTriangles) {
    for (std::uint32_t i = begin; i < end; ++i) triangles_[i] = all[order[i]];
    summarize(nodes_[node]);
    return;
  }
  const auto middle_of = [&](std::uint32_t i) { return centroid(all[i].a, all[i].b, all[i].c); };
  Box3 box;
  for (std::uint32_t i = begin; i < end; ++i) box.include(middle_of(order[i]));
  const Vec3 size = box.size();
  const std::size_t axis =
      size.x >= size.y ? (size.x >= size.z ? 0U : 2U) : (size.y >= size.z ? 1U : 2U);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](std::uint32_t i, std::uint32_t j) {
                     const double u = middle_of(i)[axis];
                     const double v = middle_of(j)[axis];
                     // A total order: which triangles are in which half does not depend
                     // on the library.
                     return u != v ? u < v : i < j;
                   });
  nodes_.emplace_back();
  build(node + 1, begin, middle, order, all);
  const auto second = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].second = second;
  nodes_.emplace_back();
  build(second, middle, end, order, all);
  summarize(nodes_[node]);
}

void WindingNumber::summarize(Node& node) const noexcept {
  const auto begin = triangles_.begin() + node.first;
  const auto end = begin + node.count;
  Vec3 weighted;
  double total = 0.0;
  for (auto t = begin; t != end; ++t) {
    const double area = length(cross(t->b - t->a, t->c - t->a));
    weighted += centroid(t->a, t->b, t->c) * area;
    total += area;
  }
  assert(total > 0.0);  // triangles without area were left out
  // Weighted by area: about this centre the quadrupole of flat, even pieces vanishes.
  node.center = weighted / total;
  double radius2 = 0.0;
  for (auto& row : node.quadrupole) std::fill(std::begin(row), std::end(row), 0.0);
  for (auto t = begin; t != end; ++t) {
    const Vec3 area_normal = cross(t->b - t->a, t->c - t->a) * 0.5;
    const Vec3 offset = centroid(t->a, t->b, t->c) - node.center;
    node.dipole += area_normal;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) node.quadrupole[i][j] += area_normal[i] * offset[j];
    }
    for (const Vec3& corner : {t->a, t->b, t->c}) {
      radius2 = std::max(radius2, dot(corner - node.center, corner - node.center));
    }
  }
  node.far2 = far_radii_ * far_radii_ * radius2;
  node.radius = std::sqrt(radius2);
  node.area = 0.5 * total;
}

namespace {

/// Calls opens(node) for the nodes of a tree from its root on, and for the two below one where it
/// returns true, which it must not for a leaf.
template <class Nodes, class Opens>
void walk(const Nodes& nodes, const Opens& opens) {
  if (nodes.empty()) return;
  std::uint32_t stack[kMaxDepth];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    if (!opens(nodes[index])) continue;
    assert(nodes[index].second != 0 && depth + 2 <= kMaxDepth);
    stack[depth++] = nodes[index].second;
    stack[depth++] = index + 1;
  }
}

}  // namespace

double WindingNumber::at(const Vec3& point) const noexcept {
  assert(is_finite(point));
  AngleSum near;
  double far = 0.0;
  walk(nodes_, [&](const Node& node) {
    const Vec3 r = node.center - point;
    const double r2 = dot(r, r);
    if (r2 > node.far2) {
      // The field of the dipole at `point`, and its change as the dipoles leave `center`.
      const double inverse_r3 = 1.0 / (r2 * std::sqrt(r2));
      double trace = 0.0;
      double along = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        trace += node.quadrupole[i][i];
        for (std::size_t j = 0; j < 3; ++j) along += r[i] * node.quadrupole[i][j] * r[j];
      }
      far += (dot(node.dipole, r) + trace - 3.0 * along / r2) * inverse_r3;
      return false;
    }
    if (node.second != 0) return true;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[i];
      near.add(half_solid_angle(t.a - point, t.b - point, t.c - point));
    }
    return false;
  });
  return near.turns() + far / (4.0 * std::numbers::pi);
}

double WindingNumber::most_within(const Vec3& center, double radius) const noexcept {
  assert(is_finite(center) && radius >= 0.0);
  // Of an area at a distance d at most area / d^2 is seen, in the measure of a sphere of radius 1.
  constexpr double kSphere = 4.0 * std::numbers::pi;
  constexpr double kFarRadii = 2.0;  // nearer clusters are opened
  double most = 0.0;
  walk(nodes_, [&](const Node& node) {
    const double gap = length(node.center - center) - node.radius - radius;
    const bool is_leaf = node.second == 0;
    if (gap <= kFarRadii * node.radius && !is_leaf) return true;
    const double whole = 0.5 * node.count;
    most += gap > 0.0 ? std::min(whole, node.area / (kSphere * gap * gap)) : whole;
    return false;
  });
  return most;
}

bool WindingNumber::comes_within(const Vec3& center, double radius) const noexcept {
  assert(is_finite(center) && radius >= 0.0);
  bool comes = false;
  walk(nodes_, [&](const Node& node) {
    if (comes || length(node.center - center) > node.radius + radius) return false;
    if (node.second != 0) return true;
    for (std::uint32_t i = node.first; i < node.first + node.count && !comes; ++i) {
      const Corners& t = triangles_[i];
      comes = length(closest_on_triangle(center, t.a, t.b, t.c) - center) <= radius;
    }
    return false;
  });
  return comes;
}

namespace {

/// A net boundary edge: the soup runs `times` more often from -> to than back.
struct OpenEdge {
  std::uint32_t from;
  std::uint32_t to;
  int times;
};

/// Edges sorted by their ends, so that all runs along one stand together and cancel.
std::vector<OpenEdge> open_edges(const std::vector<Triangle>& triangles) {
  std::vector<OpenEdge> runs;
  runs.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      if (from != to) runs.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(runs.begin(), runs.end(), [](const OpenEdge& a, const OpenEdge& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::vector<OpenEdge> open;
  for (std::size_t i = 0; i < runs.size();) {
    OpenEdge edge = runs[i];
    for (++i; i < runs.size() && runs[i].from == edge.from && runs[i].to == edge.to; ++i) {
      edge.times += runs[i].times;
    }
    if (edge.times < 0) edge = {edge.to, edge.from, -edge.times};
    if (edge.times > 0) open.push_back(edge);
  }
  return open;
}

/// Closed walks along net boundary edges, each of which visits a vertex once, so that the holes of
/// a mesh that lacks many triangles are loops of their own although they touch.
class BoundaryLoops {
 public:
  BoundaryLoops(std::vector<OpenEdge> edges, std::size_t vertices)
      : edges_(std::move(edges)), first_(vertices + 1, 0), place_(vertices, kNowhere) {
    std::sort(edges_.begin(), edges_.end(), [](const OpenEdge& a, const OpenEdge& b) {
      return a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    for (const OpenEdge& e : edges_) ++first_[e.from + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    next_.assign(first_.begin(), first_.end() - 1);
  }

  /// Calls use(loop) for each, as its vertices in order.
  template <class Use>
  void for_each(const Use& use) {
    for (std::size_t start = 0; start < edges_.size(); ++start) {
      while (edges_[start].times > 0) walk(edges_[start].from, use);
    }
  }

 private:
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;

  /// As many edges leave a vertex as arrive at it, so the walk comes back to where it began.
  template <class Use>
  void walk(std::uint32_t vertex, const Use& use) {
    std::vector<std::uint32_t> path{vertex};
    place_[vertex] = 0;
    while (!path.empty() && has_more(path.back())) {
      const std::uint32_t to = take(path.back());
      const std::uint32_t place = place_[to];
      if (place == kNowhere) {
        place_[to] = static_cast<std::uint32_t>(path.size());
        path.push_back(to);
        continue;
      }
      use(std::span(path).subspan(place));
      for (std::size_t n = place + 1; n < path.size(); ++n) place_[path[n]] = kNowhere;
      path.resize(place + 1);
    }
    assert(path.size() == 1);
    place_[vertex] = kNowhere;
  }

  bool has_more(std::uint32_t vertex) {
    std::uint32_t& next = next_[vertex];
    while (next < first_[vertex + 1] && edges_[next].times == 0) ++next;
    return next < first_[vertex + 1];
  }
  std::uint32_t take(std::uint32_t vertex) {
    OpenEdge& edge = edges_[next_[vertex]];
    --edge.times;
    return edge.to;
  }

  std::vector<OpenEdge> edges_;
  std::vector<std::uint32_t> first_;  ///< edge that leaves each vertex, one more at the end
  std::vector<std::uint32_t> next_;   ///< of these, the first that may be left
  std::vector<std::uint32_t> place_;  ///< of each vertex in the path
};

}  // namespace

std::vector<Triangle> boundary_cones(std::vector<Vec3>& positions,
                                     const std::vector<Triangle>& triangles) {
  std::vector<Triangle> cones;
  BoundaryLoops loops(open_edges(triangles), positions.size());
  loops.for_each([&](std::span<const std::uint32_t> loop) {
    Vec3 sum;
    for (const std::uint32_t v : loop) sum += positions[v];
    const auto apex = static_cast<std::uint32_t>(positions.size());
    positions.push_back(sum / static_cast<double>(loop.size()));
    for (std::size_t n = 0; n < loop.size(); ++n) {
      cones.push_back({loop[(n + 1) % loop.size()], loop[n], apex});
    }
  });
  return cones;
}

}  // namespace argil
