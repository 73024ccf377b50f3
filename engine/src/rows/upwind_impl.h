// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of redistance_shortened(). Included by rows_impl.h.

/// A bit for each of eight bytes that are 0 or 1: the product brings the bit of byte k to 56 + k,
/// and no other so high.
ARGIL_ROWS unsigned char bits_of(const unsigned char* flags) {
  unsigned long long bytes = 0;
  __builtin_memcpy(&bytes, flags, sizeof bytes);
  return static_cast<unsigned char>((bytes * 0x0102040810204080ULL) >> 56U);
}

/// The nodes of a row: which are told by others, which of them rise too slowly, and by which of the
/// six beside them they are told. Returns whether any is told.
ARGIL_ROWS bool upwind_row(const float* __restrict from, const UpwindJob& job,
                           unsigned char (*__restrict flags)[kRowNodes]) {
  unsigned char any = 0;
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = from + k;
    const float here = job.side * *at;
    bool is_told = (here > 0.0F) & (here < job.band);
    float squares = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = job.side * at[-kStride[axis]];
      const float high = job.side * at[kStride[axis]];
      is_told = is_told & (low > 0.0F) & (high > 0.0F);
      const bool by_low = low < here;
      const float nearer = by_low ? low : here;
      const bool by_high = high < nearer;
      const float rise = (here - (by_high ? high : nearer)) / job.voxel;
      squares += rise * rise;
      const bool counts = rise >= job.least_rise;
      flags[2 + 2 * axis][k] = by_low & !by_high & counts ? 1 : 0;
      flags[3 + 2 * axis][k] = by_high & counts ? 1 : 0;
    }
    flags[0][k] = is_told ? 1 : 0;
    flags[1][k] = is_told & (squares < job.least_slope * job.least_slope) ? 1 : 0;
    any = static_cast<unsigned char>(any | flags[0][k]);
  }
  return any != 0;
}

void find_upwind(const HaloBlock& from, const UpwindJob& job, UpwindRows& out) noexcept {
  for (int n = 0; n < kLeafRows; ++n) {
    const float* row = from.value + HaloBlock::index(n / kRowNodes, n % kRowNodes, 0);
    unsigned char flags[8][kRowNodes];
    const bool any = upwind_row(row, job, flags);
    const unsigned char told = any ? bits_of(flags[0]) : static_cast<unsigned char>(0);
    out.told[n] = told;
    out.slow[n] = any ? bits_of(flags[1]) : static_cast<unsigned char>(0);
    for (int by = 0; by < 6; ++by) {
      out.by[by][n] = any ? static_cast<unsigned char>(bits_of(flags[2 + by]) & told)
                          : static_cast<unsigned char>(0);
    }
  }
}
