// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/triangle_walk.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <unordered_set>

#include "argil/core/closest_on_triangle.h"

namespace argil::mesh {

void TriangleWalk::begin(std::uint32_t vertex) {
  at_ = mesh_.any_from(vertex);
  assert(at_ != CollapseMesh::kGone);
  relied_on_.clear();
}

double TriangleWalk::distance_of(const Vec3& point, HalfEdge h) const noexcept {
  const Vec3& a = mesh_.position(mesh_.from(h));
  const Vec3& b = mesh_.position(mesh_.to(h));
  const Vec3& c = mesh_.position(mesh_.to(next_in_triangle(h)));
  return length(closest_on_triangle(point, a, b, c) - point);
}

bool TriangleWalk::look_at(const Vec3& point, HalfEdge h) noexcept {
  const double distance = distance_of(point, h);
  if (distance >= least_) return false;
  least_ = distance;
  at_ = h;
  return true;
}

bool TriangleWalk::look_across(const Vec3& point) noexcept {
  const HalfEdge second = next_in_triangle(at_);
  bool is_nearer = false;
  for (const HalfEdge side : {at_, second, next_in_triangle(second)}) {
    is_nearer = look_at(point, mesh_.twin(side)) || is_nearer;
  }
  return is_nearer;
}

bool TriangleWalk::look_around(const Vec3& point) noexcept {
  const HalfEdge second = next_in_triangle(at_);
  bool is_nearer = false;
  for (const HalfEdge corner : {at_, second, next_in_triangle(second)}) {
    HalfEdge h = mesh_.next_around(corner);
    for (; h != corner; h = mesh_.next_around(h)) is_nearer = look_at(point, h) || is_nearer;
  }
  return is_nearer;
}

void TriangleWalk::rely() {
  if (relied_on_.empty() || relied_on_.back() != at_) relied_on_.push_back(at_);
}

double TriangleWalk::distance_mm(const Vec3& point_mm, double enough_mm) {
  least_ = distance_of(point_mm, at_);
  while (least_ > enough_mm && (look_across(point_mm) || look_around(point_mm))) {
  }
  rely();
  return least_;
}

/// Goes on over triangles that are not nearer, out to twice the distance that is enough.
double TriangleWalk::distance_far_mm(const Vec3& point_mm, double enough_mm) {
  constexpr std::size_t kMostReached = 1000;
  if (distance_mm(point_mm, enough_mm) <= enough_mm) return least_;
  const double reach = 2.0 * std::max(least_, enough_mm);
  std::unordered_set<std::size_t> met{triangle_of(at_)};
  reached_.assign(1, at_);
  for (std::size_t i = 0; i < reached_.size() && least_ > enough_mm; ++i) {
    const HalfEdge second = next_in_triangle(reached_[i]);
    for (const HalfEdge side : {reached_[i], second, next_in_triangle(second)}) {
      const HalfEdge across = mesh_.twin(side);
      if (!met.insert(triangle_of(across)).second) continue;
      look_at(point_mm, across);
      if (reached_.size() < kMostReached && distance_of(point_mm, across) <= reach) {
        reached_.push_back(across);
      }
    }
  }
  rely();
  return least_;
}

void SheetWalks::begin(std::uint32_t vertex) {
  count_ = 0;
  begin_also(vertex);
}

void SheetWalks::begin_also(std::uint32_t vertex) {
  if (count_ == walks_.size()) walks_.emplace_back(mesh_);
  walks_[count_++].begin(vertex);
}

double SheetWalks::distance_mm(const Vec3& point_mm, double enough_mm) {
  assert(count_ > 0);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < count_ && least > enough_mm; ++w) {
    least = std::min(least, walks_[w].distance_mm(point_mm, enough_mm));
  }
  return least;
}

/// Far only where no sheet is near enough, since that takes long.
double SheetWalks::distance_far_mm(const Vec3& point_mm, double enough_mm) {
  double least = distance_mm(point_mm, enough_mm);
  for (std::size_t w = 0; w < count_ && least > enough_mm; ++w) {
    least = std::min(least, walks_[w].distance_far_mm(point_mm, enough_mm));
  }
  return least;
}

}  // namespace argil::mesh
