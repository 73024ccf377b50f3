// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/triangle_walk.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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
  if (least_ <= enough_mm) rely();
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
  if (least_ <= enough_mm) rely();
  return least_;
}

void TriangleWalk::look_at_planes() {
  if (planes_.of == at_) return;
  planes_.of = at_;
  HalfEdge h = at_;
  for (Vec3& corner : planes_.corners) {
    corner = mesh_.position(mesh_.from(h));
    h = next_in_triangle(h);
  }
  const auto& [a, b, c] = planes_.corners;
  planes_.normal = normalized(cross(b - a, c - a));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = planes_.corners[(k + 1) % 3] - planes_.corners[k];
    const Vec3 inward = normalized(cross(planes_.normal, side));
    planes_.inward[k] = inward;
    planes_.wide[k] = std::abs(inward.x) + std::abs(inward.y) + std::abs(inward.z);
  }
}

/// Where all of the cube lies above the triangle's inside, the distance from it is that from its
/// plane, L, which along the surface is what L - s phi is, whatever s: with the s that makes them
/// run most alike nearly one number all over the cube.
bool TriangleWalk::covers(const SurfacePiece& piece, double bound_mm) {
  assert(piece.half_side_mm >= 0.0 && piece.bend_mm >= 0.0);
  constexpr double kLeastSteepness = 1e-3;  // squared; where phi is level it says nothing
  const double steepness = dot(piece.gradient, piece.gradient);
  if (steepness < kLeastSteepness) return false;
  look_at_planes();
  for (std::size_t k = 0; k < 3; ++k) {
    const double within = dot(planes_.inward[k], piece.middle_mm - planes_.corners[k]);
    // Not so where the triangle has no area either: then nothing points inward.
    if (!(within > piece.half_side_mm * planes_.wide[k])) return false;
  }
  const double alike = dot(planes_.normal, piece.gradient) / steepness;
  const double off =
      dot(planes_.normal, piece.middle_mm - planes_.corners[0]) - alike * piece.phi_mm;
  const Vec3 tilt = planes_.normal - alike * piece.gradient;
  const double across = std::abs(tilt.x) + std::abs(tilt.y) + std::abs(tilt.z);
  const double most = std::abs(off) + piece.half_side_mm * across + std::abs(alike) * piece.bend_mm;
  if (most > bound_mm) return false;
  rely();
  return true;
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

bool SheetWalks::go_on() {
  if (count_ == 0) return false;
  count_ = 1;
  walks_.front().go_on();
  return true;
}

bool SheetWalks::covers(const SurfacePiece& piece, double bound_mm) {
  for (std::size_t w = 0; w < count_; ++w) {
    if (walks_[w].covers(piece, bound_mm)) return true;
  }
  return false;
}

}  // namespace argil::mesh
