// SPDX-License-Identifier: GPL-3.0-or-later
// A cell whose loops would cross is cut into pyramids over its polygons. Each pyramid is convex and
// has at most one cut on an edge, so contouring it needs no test.
#include "surface/contour_pyramid.h"

#include <array>
#include <cassert>
#include <map>

namespace argil {

namespace {

// Spokes are cut well away from both ends, so that no triangle at the apex or at a node is thin.
constexpr double kSpokeClamp = 0.02;
constexpr std::size_t kNoEdge = ~std::size_t{0};

class Pyramids {
 public:
  Pyramids(ContourCell& cell, const PyramidInput& input, ContourMesh& mesh)
      : cell_(cell), input_(input), mesh_(mesh) {}
  void fill();

 private:
  Vec3 node_mm(int node) const;
  LoopCorner base_corner(int a, int b) const;
  const LoopCorner& spoke_corner(int node);
  void open_apex();
  void mean_normal();
  void fill_one(std::span<const std::uint16_t> polygon);
  void fill_loop(std::span<const LoopCorner> loop, std::span<const std::uint16_t> polygon);
  void link_base(std::span<const std::uint16_t> polygon);
  void link_sides(std::span<const std::uint16_t> polygon);
  LoopCorner corner(std::span<const std::uint16_t> polygon, std::size_t edge);
  std::uint32_t side_of(std::span<const std::uint16_t> polygon, std::size_t edge) const;
  LoopBody body(std::span<const std::uint16_t> polygon) const;

  ContourCell& cell_;
  const PyramidInput& input_;
  ContourMesh& mesh_;
  std::map<std::size_t, LoopCorner> cut_at_;  // by low node and axis, as first traced
  std::map<int, LoopCorner> spokes_;          // by node
  std::vector<std::size_t> next_;             // by edge: base edges, then spokes
  std::vector<std::uint32_t> vertices_;       // of a loop
  std::vector<std::uint32_t> planes_;         // likewise
  double apex_value_ = 0.0;
  Vec3 apex_mm_;
  Vec3 normal_;
};

// Both ends, whichever comes first.
std::size_t edge_name(int a, int b) {
  const auto low = static_cast<std::size_t>(a < b ? a : b);
  const auto high = static_cast<std::size_t>(a < b ? b : a);
  return low << 16 | high;
}

Vec3 Pyramids::node_mm(int node) const {
  const Coord p = cell_.position(node);
  const double step = input_.size_mm / (1 << cell_.depth());
  return input_.low_mm + Vec3{p.x() * step, p.y() * step, p.z() * step};
}

void Pyramids::open_apex() {
  const int last = 1 << cell_.depth();
  const int n = last + 1;
  assert(input_.values.size() == static_cast<std::size_t>(n * n * n));
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int node = (((corner >> 2) * n + (corner >> 1 & 1)) * n + (corner & 1)) * last;
    sum += static_cast<double>(input_.values[static_cast<std::size_t>(node)]);
  }
  apex_value_ = sum / 8.0;
  const double half = input_.size_mm / 2.0;
  apex_mm_ = input_.low_mm + Vec3{half, half, half};
}

void Pyramids::mean_normal() {
  Vec3 sum;
  for (const std::uint16_t cut : cell_.loop_cuts()) sum += mesh_.normals[input_.cuts[cut].vertex];
  normal_ = normalized(sum);
  if (dot(normal_, normal_) == 0.0) {
    normal_ = mesh_.normals[input_.cuts[cell_.loop_cuts()[0]].vertex];
  }
}

LoopCorner Pyramids::base_corner(int a, int b) const {
  const auto found = cut_at_.find(edge_name(a, b));
  assert(found != cut_at_.end());
  return found->second;
}

const LoopCorner& Pyramids::spoke_corner(int node) {
  const auto [spoke, fresh] = spokes_.try_emplace(node);
  if (!fresh) return spoke->second;
  const double value = static_cast<double>(input_.values[static_cast<std::size_t>(node)]);
  double t = value / (value - apex_value_);  // a node whose side was changed gives any number
  t = t > kSpokeClamp ? (t < 1.0 - kSpokeClamp ? t : 1.0 - kSpokeClamp) : kSpokeClamp;
  LoopCorner& made = spoke->second;
  const Vec3 from = node_mm(node);
  made.vertex = mesh_.add_vertex(ContourMesh::kNoKey, from + (apex_mm_ - from) * t, normal_);
  return made;
}

void Pyramids::fill() {
  assert(input_.cuts.size() == cell_.cuts().size() && !cell_.loop_cuts().empty());
  mean_normal();
  for (std::size_t i = 0; i < cell_.cuts().size(); ++i) {
    const ContourCut& cut = cell_.cuts()[i];
    cut_at_[edge_name(cut.low, cut.high)] = input_.cuts[i];
  }
  open_apex();
  cell_.drop_lone_hanging_nodes();
  for (std::size_t i = 0; i < cell_.polygon_count(); ++i) fill_one(cell_.polygon(i));
}

void Pyramids::fill_loop(std::span<const LoopCorner> loop, std::span<const std::uint16_t> polygon) {
  vertices_.clear();
  planes_.clear();
  for (const LoopCorner& corner : loop) {
    vertices_.push_back(corner.vertex);
    planes_.push_back(corner.planes);
  }
  const LoopShape shape = shape_of(planes_);
  if (!shape.has_centre()) return fill_plainly(vertices_, shape, mesh_);
  fill_about_centre(vertices_, shape, body(polygon), mesh_);
}

// Base edge i joins polygon nodes i and i+1; spoke i, numbered after them, node i and the apex.
void Pyramids::fill_one(std::span<const std::uint16_t> polygon) {
  next_.assign(2 * polygon.size(), kNoEdge);
  link_base(polygon);
  link_sides(polygon);
  std::vector<LoopCorner> loop;
  for (std::size_t start = 0; start < next_.size(); ++start) {
    if (next_[start] == kNoEdge) continue;
    loop.clear();
    std::size_t edge = start;
    while (next_[edge] != kNoEdge) {
      loop.push_back(corner(polygon, edge));
      const std::size_t following = next_[edge];
      next_[edge] = kNoEdge;
      edge = following;
    }
    if (loop.size() > 2) fill_loop(loop, polygon);
  }
}

void Pyramids::link_base(std::span<const std::uint16_t> polygon) {
  const std::size_t count = polygon.size();
  std::size_t entered = kNoEdge;
  std::size_t first_leave = kNoEdge;
  for (std::size_t i = 0; i < count; ++i) {
    const bool here = cell_.inside(polygon[i]);
    const bool there = cell_.inside(polygon[(i + 1) % count]);
    if (here == there) continue;
    if (there) {
      entered = i;
    } else if (entered == kNoEdge) {
      first_leave = i;
    } else {
      next_[entered] = i;
      entered = kNoEdge;
    }
  }
  if (entered != kNoEdge) next_[entered] = first_leave;
}

// Each side triangle runs node i+1, node i, apex: the base edge backwards, spoke i up, spoke i+1
// down. It has no cut or two, one entered and one left.
void Pyramids::link_sides(std::span<const std::uint16_t> polygon) {
  const std::size_t count = polygon.size();
  const bool apex = apex_value_ < 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    const std::array<bool, 4> in{cell_.inside(polygon[j]), cell_.inside(polygon[i]), apex,
                                 cell_.inside(polygon[j])};
    const std::array<std::size_t, 3> edge{i, count + i, count + j};
    std::size_t enter = kNoEdge;
    std::size_t leave = kNoEdge;
    for (std::size_t k = 0; k < 3; ++k) {
      if (in[k] != in[k + 1]) (in[k + 1] ? enter : leave) = edge[k];
    }
    if (enter != kNoEdge) next_[enter] = leave;
  }
}

// Which of the polygon's four straight sides an edge lies on, as a plane bit (bit 0: the base).
std::uint32_t Pyramids::side_of(std::span<const std::uint16_t> polygon, std::size_t edge) const {
  const Coord step =
      cell_.position(polygon[(edge + 1) % polygon.size()]) - cell_.position(polygon[edge]);
  std::uint32_t bit = 2;
  for (int axis = 0; axis < 3; ++axis, bit <<= 2) {
    if (step[axis] > 0) return bit;
    if (step[axis] < 0) return bit << 1;
  }
  return 0;
}

LoopCorner Pyramids::corner(std::span<const std::uint16_t> polygon, std::size_t edge) {
  const std::size_t count = polygon.size();
  const std::size_t i = edge % count;
  LoopCorner made =
      edge < count ? base_corner(polygon[i], polygon[(i + 1) % count]) : spoke_corner(polygon[i]);
  made.planes = side_of(polygon, i);
  made.planes |= edge < count ? 1U : side_of(polygon, (i + count - 1) % count);
  return made;
}

LoopBody Pyramids::body(std::span<const std::uint16_t> polygon) const {
  Vec3 sum;
  for (const std::uint16_t node : polygon) sum += node_mm(node);
  const double size = input_.size_mm;
  const Vec3 base = sum / static_cast<double>(polygon.size());
  return {input_.low_mm, input_.low_mm + Vec3{size, size, size}, (base + apex_mm_) * 0.5, false};
}

}  // namespace

void fill_by_pyramids(ContourCell& cell, const PyramidInput& input, ContourMesh& mesh) {
  Pyramids(cell, input, mesh).fill();
}

}  // namespace argil
