// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of out_of_gradient_bounds(). Included by rows_impl.h.

/// Sets flags of the nodes of one row and returns whether any is set.
ARGIL_ROWS bool bounds_row(const float* __restrict from, const GradientBounds& bounds, float voxel,
                           int* __restrict is_out) {
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = from + k;
    const float here = *at;
    const float side = here < 0.0F ? -1.0F : 1.0F;
    float rise_square = 0.0F;
    float fall_square = 0.0F;
    bool is_decided = magnitude(here) < bounds.within_voxels * voxel;
    for (const int stride : kStride) {
      const float low = at[-stride];
      const float high = at[stride];
      const bool is_low_alike = (low < 0.0F) == (here < 0.0F);
      const bool is_high_alike = (high < 0.0F) == (here < 0.0F);
      const bool is_known = (low == low) & (high == high);
      is_decided = is_decided & is_low_alike & is_high_alike & is_known;
      const float rise = 0.5F * (high - low);
      rise_square += rise * rise;
      const float fall = greater(side * here - lesser(side * low, side * high), 0.0F);
      fall_square += fall * fall;
    }
    // Beside a sharp corner only the central difference sees it, on a ridge only the upwind one.
    const float upwind = __builtin_sqrtf(fall_square) / voxel;
    const float either = greater(upwind, __builtin_sqrtf(rise_square) / voxel);
    is_out[k] = is_decided & ((either < bounds.least) | (upwind > bounds.most)) ? 1 : 0;
  }
  int any = 0;
  for (int k = 0; k < kRowNodes; ++k) any |= is_out[k];
  return any != 0;
}

void find_out_of_bounds(const HaloBlock& from, const GradientBounds& bounds, float voxel,
                        unsigned char* rows) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      int is_out[kRowNodes];
      unsigned bits = 0;
      if (bounds_row(from.value + HaloBlock::index(i, j, 0), bounds, voxel, is_out)) {
        for (int k = 0; k < kRowNodes; ++k) bits |= is_out[k] != 0 ? 1U << k : 0U;
      }
      rows[kRowNodes * i + j] = static_cast<unsigned char>(bits);
    }
  }
}
