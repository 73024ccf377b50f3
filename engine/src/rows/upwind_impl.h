// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of redistance_shortened(). Included by rows_impl.h.

/// Bits of the nodes of a row: which are told by others, which of them rise too slowly, and by
/// which of the six beside them they are told.
struct UpwindBits {
  unsigned told;
  unsigned slow;
  unsigned by[6];
};

ARGIL_ROWS void load_side(const float* from, float side, EightFloats& out) {
  load_eight(from, out);
  out *= side;
}

ARGIL_ROWS void upwind_row(const float* from, const UpwindJob& job, UpwindBits& bits) {
  EightFloats here;
  load_side(from, job.side, here);
  EightInts is_told = (here > 0.0F) & (here < job.band);
  EightFloats squares = {};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats low;
    EightFloats high;
    load_side(from - kStride[axis], job.side, low);
    load_side(from + kStride[axis], job.side, high);
    is_told &= (low > 0.0F) & (high > 0.0F);
    const EightInts by_low = low < here;
    const EightFloats nearer = by_low ? low : here;
    const EightInts by_high = high < nearer;
    const EightFloats rise = (here - (by_high ? high : nearer)) / job.voxel;
    squares += rise * rise;
    const EightInts counts = rise >= job.least_rise;
    bits.by[2 * axis] = lane_bits(by_low & ~by_high & counts);
    bits.by[2 * axis + 1] = lane_bits(by_high & counts);
  }
  bits.told = lane_bits(is_told);
  bits.slow = lane_bits(is_told & (squares < job.least_slope * job.least_slope));
}

void find_upwind(const HaloBlock& from, const UpwindJob& job, UpwindRows& out) noexcept {
  for (int n = 0; n < kLeafRows; ++n) {
    UpwindBits bits;
    upwind_row(from.value + HaloBlock::index(n / kRowNodes, n % kRowNodes, 0), job, bits);
    out.told[n] = static_cast<unsigned char>(bits.told);
    out.slow[n] = static_cast<unsigned char>(bits.slow);
    for (int by = 0; by < 6; ++by) {
      out.by[by][n] = static_cast<unsigned char>(bits.by[by] & bits.told);
    }
  }
}
