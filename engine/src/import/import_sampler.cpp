// SPDX-License-Identifier: GPL-3.0-or-later
// With cones over its open edges every mesh is closed, so that its crossings with lattice lines
// tell its winding number, and w is that less the cones'.
#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "import/import_field.h"

namespace argil {
namespace {

/// They are few, so that little is saved by less.
constexpr double kConeFarRadii = 6.0;
// Where gaps are all over, w is asked at each node and is a guess within a hundredth.
constexpr double kManyConesFarRadii = 2.5;
constexpr double kClearFraction = 0.25;
constexpr double kHalfDiagonal = 0.5 * (kLeafSide - 1) * 1.7320508075688773;

/// Of more open edges none are summed: each question would take longer than what it saves.
constexpr std::size_t kMostRims = 2048;

double distance_from_edge(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return length(p - (a + along * t));
}

template <class Item>
std::vector<Item> joined(std::vector<Item> items, const std::vector<Item>& more) {
  items.insert(items.end(), more.begin(), more.end());
  return items;
}

}  // namespace

ImportSampler::ImportSampler(const ImportInput& input) : input_(input) {
  if (input.closed) {
    lattice_.emplace(input.positions, joined(input.triangles, input.flat), input.center,
                     input.voxel_mm);
    return;
  }
  std::vector<Vec3> positions = input.positions;
  cone_triangles_ = boundary_cones(positions, joined(input.triangles, input.flat));
  apexes_.assign(positions.begin() + static_cast<std::ptrdiff_t>(input.positions.size()),
                 positions.end());
  lattice_.emplace(positions, joined(joined(input.triangles, input.flat), cone_triangles_),
                   input.center, input.voxel_mm);
  const bool has_many = cone_triangles_.size() > kMostRims;
  cones_.emplace(positions, cone_triangles_, has_many ? kManyConesFarRadii : kConeFarRadii);
  if (has_many) return;
  for (const Triangle& t : cone_triangles_) rims_.push_back({positions[t[0]], positions[t[1]]});
}

bool ImportSampler::is_clear(const Coord& origin) const noexcept {
  if (!cones_) return true;
  const double half = 0.5 * (kLeafSide - 1) * voxel();
  const Vec3 middle = position(origin) + Vec3{half, half, half};
  return cones_->most_within(middle, kHalfDiagonal * voxel()) < kClearFraction;
}

/// The gradient of a solid angle is the integral of dl x r / r^3 along the rim of what is seen.
double ImportSampler::most_change(const Vec3& center, double radius) const noexcept {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (rims_.empty() || cones_->comes_within(center, radius)) return kUnknown;
  double slope = 0.0;
  for (const auto& [a, b] : rims_) {
    const double nearest = distance_from_edge(center, a, b) - radius;
    if (nearest <= 0.0) return kUnknown;
    slope += length(b - a) / (nearest * nearest);
  }
  return slope * radius / (4.0 * std::numbers::pi);
}

void ImportSampler::build_trees() {
  if (distance_) return;
  distance_.emplace(input_.positions, input_.triangles);
  columns_.emplace(joined(input_.positions, apexes_),
                   joined(joined(input_.triangles, input_.flat), cone_triangles_), input_.center,
                   input_.voxel_mm);
}

}  // namespace argil
