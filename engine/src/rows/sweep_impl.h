// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of sweep_distances(). Included by rows_impl.h.
//
// Notation: a node's frame is that of its own sign, so that T, the value sought, is positive and
// values beyond the surface are negative. `near` is the smaller of the two neighbours along an
// axis.

constexpr float kLeastSeedVoxels = 1e-4F;  // no seed is nearer to the surface: its sign is safe
constexpr float kLeastVoxels = 1e-3F;      // nor any other node than this
constexpr float kSteepestVoxels = 1.25F;   // of a second difference, as in fast_march()
constexpr float kMostBend = 0.25F;         // of the gradient along a voxel, where it is smooth

/// What one axis contributes to weight * (T - from)^2, summed over the axes: voxel^2.
struct AxisTerm {
  float near;
  float from;    ///< near, or (4 near - behind) / 3 of the second-order difference
  float weight;  ///< 1, or (3/2)^2
};

/// `steepest` below 0: no second difference.
ARGIL_ROWS AxisTerm axis_term(const float* at, int stride, float sign, float steepest) {
  const float low = sign * at[-stride];
  const float high = sign * at[stride];
  const float behind_low = sign * at[-2 * stride];
  const float behind_high = sign * at[2 * stride];
  const float near = lesser(low, high);
  // Of two that are alike neither side is preferred.
  const float either = greater(behind_low, behind_high);
  const float behind = low < high ? behind_low : (high < low ? behind_high : either);
  const bool is_second = (behind <= near) & (near - behind <= steepest);
  return {near, is_second ? (4.0F * near - behind) * (1.0F / 3.0F) : near,
          is_second ? 2.25F : 1.0F};
}

ARGIL_ROWS void order(AxisTerm& a, AxisTerm& b) {
  const bool swaps = b.near < a.near;
  const AxisTerm first{swaps ? b.near : a.near, swaps ? b.from : a.from,
                       swaps ? b.weight : a.weight};
  b = {swaps ? a.near : b.near, swaps ? a.from : b.from, swaps ? a.weight : b.weight};
  a = first;
}

/// T of a node: the larger root over as many axes, the nearest first, as it lies above all of.
/// Solved for the difference to the first, so that large distances do not cancel.
ARGIL_ROWS float solved(AxisTerm x, AxisTerm y, AxisTerm z, float voxel) {
  order(x, y);
  order(y, z);
  order(x, y);
  const float one = x.from + voxel * (x.weight > 1.0F ? 1.0F / 1.5F : 1.0F);
  const float dy = y.from - x.from;
  const float dz = z.from - x.from;
  const float a2 = x.weight + y.weight;
  const float b2 = y.weight * dy;
  const float c2 = b2 * dy - voxel * voxel;
  const float root2 = b2 * b2 - a2 * c2;
  const float two = x.from + (b2 + __builtin_sqrtf(greater(root2, 0.0F))) / a2;
  const float a3 = a2 + z.weight;
  const float b3 = b2 + z.weight * dz;
  const float c3 = c2 + z.weight * dz * dz;
  const float root3 = b3 * b3 - a3 * c3;
  const float three = x.from + (b3 + __builtin_sqrtf(greater(root3, 0.0F))) / a3;
  const float fewer = (root2 >= 0.0F) & (two >= y.near) ? two : one;
  return (root3 >= 0.0F) & (three >= z.near) ? three : fewer;
}

/// One row, in which the nodes of `kept` stay and those of `plain` have no second differences.
/// Returns whether a node moved farther than `settled`; `moves` says which.
ARGIL_ROWS bool sweep_row(const float* __restrict from, float* __restrict to, unsigned kept,
                          unsigned plain, float voxel, float band, float settled,
                          int* __restrict moves) {
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = from + k;
    const float sign = *at < 0.0F ? -1.0F : 1.0F;
    const float steepest = (plain >> k & 1U) != 0 ? -1.0F : kSteepestVoxels * voxel;
    const float t =
        solved(axis_term(at, kStride[0], sign, steepest), axis_term(at, kStride[1], sign, steepest),
               axis_term(at, kStride[2], sign, steepest), voxel);
    const float now = sign * lesser(greater(t, kLeastVoxels * voxel), band);
    const float stays = (kept >> k & 1U) != 0 ? *at : now;
    moves[k] = magnitude(stays - *at) > settled ? 1 : 0;
    to[k] = stays;
  }
  int any = 0;
  for (int k = 0; k < kRowNodes; ++k) any |= moves[k];
  return any != 0;
}

/// Whether a row and all that its nodes are solved from are as far from the surface as values go:
/// it stays so.
ARGIL_ROWS bool is_far(const float* from, float band) {
  float least[kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    float nearest = magnitude(from[k]);
    for (const int stride : kStride) {
      const float* at = from + k;
      nearest = lesser(nearest, lesser(magnitude(at[-stride]), magnitude(at[stride])));
      nearest = lesser(nearest, lesser(magnitude(at[-2 * stride]), magnitude(at[2 * stride])));
    }
    least[k] = nearest;
  }
  float all = band;
  for (int k = 0; k < kRowNodes; ++k) all = lesser(all, least[k]);
  return all >= band;
}

std::uint64_t sweep(const HaloBlock& from, const unsigned char* kept, float voxel, float band,
                    float settled, std::uint64_t rows, unsigned char* plain, float* out) noexcept {
  std::uint64_t moved = 0;
  for (int n = 0; n < kLeafRows; ++n) {
    const float* row = from.value + HaloBlock::index(n / kRowNodes, n % kRowNodes, 0);
    float* const to = out + kRowNodes * n;
    if ((rows >> n & 1U) == 0 || kept[n] == 0xff || is_far(row, band)) {
      for (int k = 0; k < kRowNodes; ++k) to[k] = row[k];
      continue;
    }
    int moves[kRowNodes];
    const unsigned is_plain = plain != nullptr ? plain[n] : 0U;
    if (!sweep_row(row, to, kept[n], is_plain, voxel, band, settled, moves)) continue;
    moved |= std::uint64_t{1} << n;
    if (plain == nullptr) continue;
    for (int k = 0; k < kRowNodes; ++k) {
      if (moves[k] != 0) plain[n] = static_cast<unsigned char>(plain[n] | 1U << k);
    }
  }
  return moved;
}

ARGIL_ROWS void seed_row(const float* __restrict from, const int* __restrict anew, float voxel,
                         int* __restrict kept, float* __restrict to) {
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = from + k;
    const float here = *at;
    const bool is_inside = here < 0.0F;
    const float depth = magnitude(here);
    float rise_square = 0.0F;
    float bend = 0.0F;
    float inverse_square = 0.0F;
    for (const int stride : kStride) {
      const float low = at[-stride];
      const float high = at[stride];
      const float rise = 0.5F * (high - low);
      rise_square += rise * rise;
      bend = greater(bend, magnitude(low + high - 2.0F * here));
      const bool cuts_low = (low < 0.0F) != is_inside;
      const bool cuts_high = (high < 0.0F) != is_inside;
      const float low_cut = greater(depth / (depth + magnitude(low)), kLeastSeedVoxels);
      const float high_cut = greater(depth / (depth + magnitude(high)), kLeastSeedVoxels);
      const float cut = lesser(cuts_low ? low_cut : 2.0F, cuts_high ? high_cut : 2.0F);
      inverse_square += cut < 2.0F ? 1.0F / (cut * cut) : 0.0F;
    }
    const float rise = __builtin_sqrtf(rise_square);
    const bool is_smooth = (rise > 0.0F) & (bend <= kMostBend * rise);
    const float by_cuts = voxel / __builtin_sqrtf(inverse_square);
    const float by_rise = voxel * greater(depth / rise, kLeastSeedVoxels);
    const float distance = is_smooth ? by_rise : by_cuts;
    const bool is_cut = inverse_square > 0.0F;
    const bool is_off = (depth > 2.0F * by_cuts) | (by_cuts > 2.0F * depth);
    const float seed = is_inside ? -distance : distance;
    to[k] = is_cut & (kept[k] == 0) & ((anew[k] != 0) | is_off) ? seed : here;
    kept[k] = is_cut | (kept[k] != 0) ? 1 : 0;
  }
}

void seed(const HaloBlock& from, const NodeFlags& anew, float voxel, NodeFlags& kept,
          float* out) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int n = kRowNodes * (kRowNodes * i + j);
      seed_row(from.value + HaloBlock::index(i, j, 0), anew.is_set + n, voxel, kept.is_set + n,
               out + n);
    }
  }
}
