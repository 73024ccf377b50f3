// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_pebbles.h"

#include <algorithm>
#include <cmath>

#include "contact.h"

namespace argil::haptics {
namespace {

constexpr double kMostCell = 1 << 20;  // 21 bits a coordinate

/// The cell of a coordinate; those far away share the outermost ones.
std::int64_t cell_of(double coordinate_mm, double cell_mm) noexcept {
  return static_cast<std::int64_t>(
      std::clamp(std::floor(coordinate_mm / cell_mm), -kMostCell, kMostCell - 1.0));
}

std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) noexcept {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  return ((static_cast<std::uint64_t>(x) & kMask) << 42U) |
         ((static_cast<std::uint64_t>(y) & kMask) << 21U) | (static_cast<std::uint64_t>(z) & kMask);
}

}  // namespace

std::vector<Vec3> pebble_grid(int count_x, int count_y, double spacing_mm, double z_mm) {
  std::vector<Vec3> centers;
  for (int i = 0; i < count_x; ++i) {
    for (int j = 0; j < count_y; ++j) {
      centers.push_back(
          {spacing_mm * (i - 0.5 * (count_x - 1)), spacing_mm * (j - 0.5 * (count_y - 1)), z_mm});
    }
  }
  return centers;
}

PebblesScene::PebblesScene(const PebblesOptions& options) : options_(options) {
  const double cell_mm = 2.0 * options_.radius_mm;
  const auto key = [&](const Vec3& p) {
    return key_of(cell_of(p.x, cell_mm), cell_of(p.y, cell_mm), cell_of(p.z, cell_mm));
  };
  std::vector<Vec3>& centers = options_.centers_mm;
  std::stable_sort(centers.begin(), centers.end(),
                   [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
  for (std::size_t n = 0; n < centers.size(); ++n) {
    Cell& cell = cells_[key(centers[n])];
    if (cell.count++ == 0) cell.first = static_cast<std::uint32_t>(n);
  }
}

/// A ball that touches the place has its centre within a radius, so in one of the eight cells that
/// the cube of that half side around the place meets.
template <class Visit>
void PebblesScene::visit_near(const Vec3& place_mm, const Visit& visit) const noexcept {
  if (!is_finite(place_mm)) return;
  const double cell_mm = 2.0 * options_.radius_mm;
  std::int64_t low[3];
  std::int64_t high[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = cell_of(place_mm[axis] - options_.radius_mm, cell_mm);
    high[axis] = cell_of(place_mm[axis] + options_.radius_mm, cell_mm);
  }
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        const auto found = cells_.find(key_of(x, y, z));
        if (found == cells_.end()) continue;
        for (std::uint32_t n = 0; n < found->second.count; ++n) {
          visit(options_.centers_mm[found->second.first + n]);
        }
      }
    }
  }
}

int PebblesScene::candidates(const Vec3& place_mm) const noexcept {
  int count = 0;
  visit_near(place_mm, [&](const Vec3&) { ++count; });
  return count;
}

SceneForce PebblesScene::force_at(const HandleState& place) const noexcept {
  SceneForce felt;
  visit_near(place.position_mm, [&](const Vec3& center) {
    const Vec3 out = place.position_mm - center;
    const double distance = length(out);
    if (!(distance > 0.0) || distance >= options_.radius_mm) return;
    const SceneForce one =
        one_sided_contact(out / distance, options_.radius_mm - distance, place.velocity_mm_per_s,
                          options_.stiffness_n_per_m, options_.damping_n_s_per_m);
    felt.force_n += one.force_n;
    felt.stiffness_n_per_m += one.stiffness_n_per_m;
  });
  return felt;
}

}  // namespace argil::haptics
