// SPDX-License-Identifier: GPL-3.0-or-later
// Two half spaces a, b <= 0 moved inward by the radius: where u = a + r and v = b + r are each
// above the other's share, the nearest point of what both leave is their edge, and the distance to
// it less the radius is that to the opened wedge. Opening is idempotent (Serra, Image Analysis and
// Mathematical Morphology, 1982), so dabs over dabs do not wear an edge down as a smooth maximum
// would.
#include "edit/edge_rounding.h"

#include <cassert>
#include <vector>

#include "field/prolongation.h"
#include "field/sampling.h"

namespace argil {
namespace {

/// In voxels: with less it is a saw. Finer leaves have coarser ones around them, which hold where
/// the edge ends.
constexpr double kUsualVoxels = 1.5;
constexpr double kUsualFinerVoxels = 1.0;

/// Of the 4 voxels of a band so many are left for a radius; the rest holds slopes and corners.
constexpr double kWithinBand = 2.0;

/// Of a level's band: what lies farther may be as far as its end, or beyond.
constexpr float kKnown = 0.95F;

/// Calls visit(i, j, k) for all nodes of a halo that are set.
template <class Visit>
void for_each_halo_node(const Visit& visit) {
  constexpr int kHalo = HaloBlock::kHalo;
  const auto own = [](int c) { return c >= 0 && c < kLeafSide ? 1 : 0; };
  for (int i = -kHalo; i < kLeafSide + kHalo; ++i) {
    for (int j = -kHalo; j < kLeafSide + kHalo; ++j) {
      for (int k = -kHalo; k < kLeafSide + kHalo; ++k) {
        if (own(i) + own(j) + own(k) >= 2) visit(i, j, k);
      }
    }
  }
}

}  // namespace

double rounded_max(double a, double b, double cosine, double radius) noexcept {
  assert(cosine >= -1.0 - 1e-6 && cosine <= 1.0 + 1e-6 && radius >= 0.0);
  // A ball in a wedge of angle w stays r / sin(w / 2) away from its tip; sin^2(w / 2) is half of
  // 1 + cosine.
  constexpr double kWholeFrom = 0.5;
  constexpr double kLeastExcess = 0.05;
  const double r = radius * std::clamp((1.0 + cosine) / kWholeFrom, 0.0, 1.0);
  const double u = a + r;
  const double v = b + r;
  const double sine2 = (1.0 - cosine) * (1.0 + cosine);
  // Either body may come first: the same bits.
  // Where little is to do, what is there may be round already, and only the normals are not exact.
  const double least = kLeastExcess * r;
  if (u - cosine * v <= least || v - cosine * u <= least || sine2 < 1e-6) return std::max(a, b);
  return std::sqrt(std::max(0.0, (u * u + v * v - 2.0 * cosine * (u * v)) / sine2)) - r;
}

double edge_radius(const LevelStack& stack, int level, std::optional<double> asked_mm,
                   double smallest_radius_mm) noexcept {
  assert(stack.is_level(level) && smallest_radius_mm > 0.0);
  const double usual = level > 0 ? kUsualFinerVoxels * stack.voxel_mm(level - 1)
                                 : kUsualVoxels * stack.voxel_mm(level);
  return std::min(asked_mm.value_or(usual), 0.5 * smallest_radius_mm);
}

double widest_edge(const LevelStack& stack) noexcept { return 2.0 * stack.voxel_mm(stack.top()); }

bool is_fine_enough(const LevelStack& stack, int level, double radius_mm) noexcept {
  return radius_mm >= kUsualVoxels * stack.voxel_mm(level);
}

bool is_within_band(const LevelStack& stack, int level, double radius_mm) noexcept {
  return radius_mm <= kWithinBand * stack.voxel_mm(level);
}

float distance_beyond_band(const LevelStack& stack, int level, const Coord& node) {
  for (int above = level;; ++above) {
    const float value = interpolated_between(
        node, above - level, [&](const Coord& coarse) { return stack.sample(above, coarse); });
    if (above == stack.top() || std::abs(value) < kKnown * stack.band_mm(above)) return value;
  }
}

void fill_absent(const LevelStack& stack, int level, const Coord& origin, LeafValues& out) {
  if (level < stack.top()) return prolong_leaf(stack, level, origin, out);
  out.fill(stack.grid(level).tree().getValue(origin));
}

/// From the first level whose band holds all that is read, in one block: node by node it would cost
/// more than the edge itself.
void widen(const LevelStack& stack, int level, const Coord& origin, double radius_mm,
           HaloBlock& block) {
  assert(is_leaf_origin(origin));
  int above = level;
  while (above < stack.top() && !is_within_band(stack, above, radius_mm)) ++above;
  const int steps = above - level;
  const Coord low = origin.offsetBy(-HaloBlock::kHalo) >> steps;
  const Coord high = (origin.offsetBy(kLeafSide + HaloBlock::kHalo - 1) >> steps).offsetBy(1);
  const Coord dim = high - low + Coord(1);
  std::vector<float> coarse;
  coarse.reserve(static_cast<std::size_t>(dim.x() * dim.y() * dim.z()));
  for (int x = low.x(); x <= high.x(); ++x) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int z = low.z(); z <= high.z(); ++z) coarse.push_back(stack.sample(above, {x, y, z}));
    }
  }
  const auto at = [&](const Coord& node) {
    const Coord from = node - low;
    return coarse[static_cast<std::size_t>((from.x() * dim.y() + from.y()) * dim.z() + from.z())];
  };
  const float band = kKnown * stack.band_mm(level);
  for_each_halo_node([&](int i, int j, int k) {
    float& value = block.value[HaloBlock::index(i, j, k)];
    if (std::abs(value) >= band) value = interpolated_between(origin.offsetBy(i, j, k), steps, at);
  });
}

}  // namespace argil
