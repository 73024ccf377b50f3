// SPDX-License-Identifier: GPL-3.0-or-later
#include "operation/scaled_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>

#include "argil/engine/clay_options.h"

#include "field/mask.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// One level's values times a factor. Beyond the band they are the band, whatever rounding made of
/// it, and what was within it does not come to lie on it.
class ScaledValues {
 public:
  ScaledValues(float from_band, float to_band, double factor)
      : from_band_(from_band),
        to_band_(to_band),
        most_(std::nextafter(to_band, 0.0F)),
        factor_(factor) {}

  float operator()(float value) const noexcept {
    if (std::abs(value) >= from_band_) return std::copysign(to_band_, value);
    const auto scaled = static_cast<float>(static_cast<double>(value) * factor_);
    return std::clamp(scaled, -most_, most_);
  }

 private:
  float from_band_;
  float to_band_;
  float most_;
  double factor_;
};

/// False: asked to stop.
bool scale_level(const LevelStack& from, int level, LevelStack& to, const Progress& progress) {
  constexpr std::size_t kLeavesAtOnce = 8192;
  const ScaledValues scaled(from.band_mm(level), to.band_mm(level),
                            to.voxel_mm(level) / from.voxel_mm(level));
  const std::vector<Coord> origins = from.sorted_origins(level);
  std::vector<LeafValues> values(std::min(kLeavesAtOnce, origins.size()));
  for (std::size_t begin = 0; begin < origins.size(); begin += kLeavesAtOnce) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (progress && !progress("scale", done)) return false;
    const std::size_t count = std::min(kLeavesAtOnce, origins.size() - begin);
    for_each_leaf(count, [&](std::size_t n) {
      const float* source = values_of(*from.leaf(level, origins[begin + n]));
      std::transform(source, source + kLeafNodes, values[n].begin(), scaled);
    });
    for (std::size_t n = 0; n < count; ++n) {
      to.set_leaf(level, origins[begin + n], values[n].data());
    }
  }
  return true;
}

std::shared_ptr<Mask> scaled_mask(const Mask& from, double voxel_mm) {
  auto mask = std::make_shared<Mask>(voxel_mm, from.elsewhere());
  for (const Coord& origin : from.sorted_origins()) {
    if (const float* kept = from.leaf(origin)) {
      LeafValues values;
      std::copy_n(kept, kLeafNodes, values.begin());
      mask->put(origin, values);
    } else {
      mask->put(origin, from.constant(origin));
    }
  }
  return mask;
}

}  // namespace

std::unique_ptr<LevelStack> scaled_levels(const LevelStack& from, double voxel_mm,
                                          const Progress& progress) {
  assert(voxel_mm >= kLeastVoxelMm && voxel_mm <= kMostVoxelMm);
  auto to = std::make_unique<LevelStack>(voxel_mm, from.count());
  for (int level = from.top(); level >= 0; --level) {
    if (!scale_level(from, level, *to, progress)) return nullptr;
  }
  openvdb::tools::signedFloodFill(to->grid(to->top()).tree());
  if (from.mask() != nullptr) {
    to->exchange_mask(scaled_mask(*from.mask(), kMaskVoxels * voxel_mm));
  }
  return to;
}

}  // namespace argil
