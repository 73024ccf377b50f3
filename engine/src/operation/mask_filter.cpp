// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of the mask that look at the surface: what they may be, and by curvature.
#include "argil/engine/mask_filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/core/no_throw.h"
#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "edit/edit.h"
#include "field/bad_input.h"
#include "field/mask_reach.h"
#include "field/parallel.h"
#include "operation/mask_surface.h"
#include "operation/prepared_operation.h"

namespace argil {
namespace {

constexpr double kMostFactor = 100.0;
constexpr double kLeastCavityVoxels = 2.0;

/// Directions over which the mean of a field is that over a ball's surface, for polynomials up to
/// the fifth degree: 6 along the axes and 8 along the diagonals.
/// Source  V. Lebedev, "Quadratures on a sphere", USSR Comp. Math. 16 (1976): 14 points.
constexpr double kAxisWeight = 1.0 / 15.0;
constexpr double kDiagonalWeight = 3.0 / 40.0;

double mean_around(FieldSampler& field, const Vec3& p, double radius_mm) {
  double axes = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = radius_mm;
    axes += field.distance_mm(p + step) + field.distance_mm(p - step);
  }
  const double part = radius_mm / std::sqrt(3.0);
  double diagonals = 0.0;
  for (int n = 0; n < 8; ++n) {
    const auto side = [&](int bit) { return (n >> bit & 1) != 0 ? part : -part; };
    diagonals += field.distance_mm(p + Vec3{side(2), side(1), side(0)});
  }
  return kAxisWeight * axes + kDiagonalWeight * diagonals;
}

Error out_of_range(const std::string& name, double value, const std::string& range) {
  return bad_input(name + " is " + number_text(value) + "; must be " + range);
}

Result<void> check_filter(const MaskGrow& grow) {
  const double size = std::abs(grow.by_mm);
  if (size > 0.0 && size <= kMaxReachMm) return {};
  return out_of_range("by_mm of the mask", grow.by_mm, "a number of mm that is not 0");
}

Result<void> check_filter(const MaskCavity& cavity) {
  if (!(cavity.radius_mm > 0.0 && cavity.radius_mm <= kMaxReachMm)) {
    return out_of_range("radius_mm of the cavities", cavity.radius_mm, "a positive number of mm");
  }
  const double size = std::abs(cavity.factor);
  if (size > 0.0 && size <= kMostFactor) return {};
  return out_of_range("factor of the cavities", cavity.factor, "from -100 to 100 and not 0");
}

Result<void> check_for(const Clay& clay, const MaskGrow& grow) {
  const double least = 0.05 * clay.options().voxel_mm;
  const double most = longest_side_mm(clay);
  const double size = std::abs(grow.by_mm);
  if (size >= least && size <= most) return {};
  return out_of_range("by_mm of the mask", grow.by_mm,
                      "from " + number_text(least) + " (a twentieth of the clay's voxel) to " +
                          number_text(most) + " (its longest side), or the negative of that");
}

Result<void> check_for(const Clay& clay, const MaskCavity& cavity) {
  const LevelStack& stack = levels_of(clay);
  const double least = kLeastCavityVoxels * stack.voxel_mm(0);
  const double most = static_cast<double>(stack.band_mm(stack.top()));
  if (cavity.radius_mm >= least && cavity.radius_mm <= most) return {};
  return out_of_range("radius_mm of the cavities", cavity.radius_mm,
                      "from " + number_text(least) + " (two voxels of the clay) to " +
                          number_text(most) + " (four of its coarsest level)");
}

/// Halves a cube of the mask's nodes down to its leaves, leaving out what is far from the surface.
void add_leaves_near(const LevelStack& stack, const Coord& low, int side, std::vector<Coord>& out) {
  assert(side >= kLeafSide && is_leaf_origin(low));
  if (side == kLeafSide) {
    if (is_near_surface(stack, low)) out.push_back(low);
    return;
  }
  static_assert(kMaskVoxels == 2);
  const Coord middle = low.offsetBy(side / 2) << 1;
  // From its middle to a corner, what is_near_surface adds to that, and what the field may miss.
  constexpr double kSlack = 24.0;
  const double voxel = stack.voxel_mm(0);
  const double most = (std::sqrt(3.0) * side + kSlack) * voxel + stack.voxel_mm(stack.top());
  if (std::abs(static_cast<double>(stack.node_value(0, middle))) > most) return;
  for (int part = 0; part < 8; ++part) {
    const auto step = [&](int bit) { return (part >> bit & 1) * side / 2; };
    add_leaves_near(stack, low.offsetBy(step(2), step(1), step(0)), side / 2, out);
  }
}

}  // namespace

std::optional<SurfacePlace> surface_near(FieldSampler& field, const Vec3& from, double near_mm) {
  constexpr int kMostSteps = 6;
  constexpr double kLeastSlope = 0.3;
  Vec3 p = from;
  for (int step = 0; step < kMostSteps; ++step) {
    const FieldValue at = field.value(p);
    const double slope = length(at.gradient);
    if (slope < kLeastSlope) return std::nullopt;
    if (std::abs(at.distance_mm) <= 0.02 * near_mm) {
      return SurfacePlace{p, at.gradient / slope};
    }
    p -= (at.distance_mm / (slope * slope)) * at.gradient;
  }
  return std::nullopt;
}

/// The coarsest level covers the whole surface.
std::vector<Coord> mask_leaves_near_surface(const LevelStack& stack) {
  const std::vector<Coord> covers = stack.sorted_origins(stack.top());
  std::vector<std::vector<Coord>> parts(covers.size());
  tbb::parallel_for(std::size_t{0}, covers.size(), [&](std::size_t n) {
    if (stack.top() == 0) {
      const Coord origin = leaf_origin(coarser(covers[n]));
      if (is_near_surface(stack, origin)) parts[n].push_back(origin);
    } else {
      const int shift = stack.top() - 1;
      add_leaves_near(stack, covers[n] << shift, kLeafSide << shift, parts[n]);
    }
  });
  std::vector<Coord> origins;
  for (const auto& part : parts) origins.insert(origins.end(), part.begin(), part.end());
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

void change_mask_leaves(const std::vector<Coord>& origins, Mask& mask, std::int64_t free_bytes,
                        const Pace& pace, const std::function<void(MaskLeaf&)>& work) {
  assert(are_sorted_origins(origins));
  constexpr std::size_t kAtOnce = 1024;
  for (std::size_t begin = 0; begin < origins.size(); begin += kAtOnce) {
    pace.at(static_cast<double>(begin) / static_cast<double>(origins.size()));
    std::vector<MaskLeaf> leaves(std::min(kAtOnce, origins.size() - begin));
    for_each_leaf(leaves.size(), [&](std::size_t n) {
      leaves[n].origin = origins[begin + n];
      work(leaves[n]);
    });
    for (const MaskLeaf& leaf : leaves) {
      if (leaf.is_changed) mask.put(leaf.origin, leaf.values);
    }
    if (mask.bytes() > free_bytes) throw OverLimit(mask.bytes());
  }
}

/// By the field's mean over a ball of the radius r about a point of the surface: r^2/6 times the
/// sum of its second derivatives, which of a distance are the curvatures.
std::shared_ptr<Mask> cavity_mask(const Clay& clay, const MaskCavity& cavity,
                                  std::int64_t free_bytes, const Pace& pace) {
  const LevelStack& stack = levels_of(clay);
  const double voxel = kMaskVoxels * stack.voxel_mm(0);
  const float elsewhere = cavity.is_inverted ? 1.0F : 0.0F;
  auto mask = std::make_shared<Mask>(voxel, elsewhere);
  const auto work = [&](MaskLeaf& leaf) {
    FieldSampler field(clay);
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      const Vec3 node = node_mm(node_of(leaf.origin, n), voxel);
      const auto place = surface_near(field, node, stack.voxel_mm(0));
      double held = 0.0;
      if (place) {
        held = -6.0 * cavity.factor * mean_around(field, place->at, cavity.radius_mm) /
               cavity.radius_mm;
      }
      const auto share = static_cast<float>(std::clamp(held, 0.0, 1.0));
      leaf.values[n] = cavity.is_inverted ? 1.0F - share : share;
      leaf.is_changed = leaf.is_changed || leaf.values[n] != elsewhere;
    }
  };
  change_mask_leaves(mask_leaves_near_surface(stack), *mask, free_bytes, pace, work);
  return mask->is_nothing() ? nullptr : mask;
}

Result<void> validate_filter(const MaskFilter& filter) {
  return std::visit([](const auto& chosen) { return check_filter(chosen); }, filter);
}

Result<void> filter_mask(Clay& clay, const MaskFilter& filter, const Progress& progress) {
  if (auto valid = validate_filter(filter); !valid) return valid;
  auto fits = std::visit([&](const auto& chosen) { return check_for(clay, chosen); }, filter);
  if (!fits) return fits;
  return no_throw("the mask", [&] {
    const Pace pace(progress, "mask");
    return ClayAccess::change_mask(clay, [&](const LevelStack& stack, std::int64_t free_bytes) {
      if (const auto* cavity = std::get_if<MaskCavity>(&filter)) {
        return cavity_mask(clay, *cavity, free_bytes, pace);
      }
      const Mask nothing(kMaskVoxels * stack.voxel_mm(0), 0.0F);
      const Mask& before = stack.mask() != nullptr ? *stack.mask() : nothing;
      return grown_mask(clay, before, std::get<MaskGrow>(filter), free_bytes, pace);
    });
  });
}

}  // namespace argil
