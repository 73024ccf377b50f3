// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of restrict_leaf(). Included by rows_impl.h.
//
// Notation: the fine nodes that decide a coarse leaf's are a block of 17^3 that starts one node
// below it. Rows lie so that the nodes of the two leaves it covers begin at multiples of 8; what is
// before the first node, at kFineFirst, is never used.

constexpr int kFineSide = 2 * kRowNodes + 1;
constexpr int kFineRow = 3 * kRowNodes;
constexpr int kFineFirst = kRowNodes - 1;

// Vectors of four are those that every set has; what is made of them is not read again at once,
// since a longer read would wait for them.
typedef float Four __attribute__((vector_size(16)));
typedef int FourBits __attribute__((vector_size(16)));
constexpr int kFours = kRowNodes / 4;  // in a row of a leaf
constexpr float kNoValue = __builtin_nanf("");

ARGIL_ROWS float weighted(float before, float here, float after) {
  return 0.5F * here + 0.25F * (before + after);
}

/// A row of the block from the three leaves along it, `offset` nodes from their first; NaN outside
/// the band.
ARGIL_ROWS void fine_row(const float* const* leaves, int offset, float band, float* row) {
  for (int n = 0; n < 3 * kFours; ++n) {
    Four value;
    __builtin_memcpy(&value, leaves[n / kFours] + offset + 4 * (n % kFours), sizeof value);
    const Four size = value < 0.0F ? -value : value;
    value = size < band ? value : Four{kNoValue, kNoValue, kNoValue, kNoValue};
    __builtin_memcpy(row + 4 * n, &value, sizeof value);
  }
}

/// The plane across x with place `i` in the leaves from `leaves` on.
ARGIL_ROWS void fine_plane(const float* const* leaves, int i, float band, float* plane) {
  const int first = kRowNodes * kRowNodes * i;
  fine_row(leaves, first + kRowNodes * (kRowNodes - 1), band, plane);
  for (int n = 1; n < 3; ++n) {
    for (int j = 0; j < kRowNodes; ++j) {
      plane += kFineRow;
      fine_row(leaves + 3 * n, first + kRowNodes * j, band, plane);
    }
  }
}

ARGIL_ROWS void weigh_row(const float* __restrict before, const float* __restrict here,
                          const float* __restrict after, float* __restrict to) {
  for (int k = 0; k < kFineRow; ++k) to[k] = weighted(before[k], here[k], after[k]);
}

/// The coarse nodes of a row, from three rows that are averaged along x, and the fine row at the
/// same place.
ARGIL_ROWS void coarse_row(const float* rows, const float* same, float voxel, float* value,
                           unsigned char* decided, unsigned char* averaged) {
  Four mean[2 * kFours];  // of the nodes after the first
  Four here[2 * kFours];
  for (int n = 0; n < 2 * kFours; ++n) {
    Four row[3];
    for (int j = 0; j < 3; ++j) {
      __builtin_memcpy(row + j, rows + kFineRow * j + kRowNodes + 4 * n, sizeof(Four));
    }
    mean[n] = 0.5F * row[1] + 0.25F * (row[0] + row[2]);
    __builtin_memcpy(here + n, same + kRowNodes + 4 * n, sizeof(Four));
  }
  float previous =
      weighted(rows[kFineFirst], rows[kFineRow + kFineFirst], rows[2 * kFineRow + kFineFirst]);
  unsigned is_decided = 0;
  unsigned is_averaged = 0;
  for (int n = 0; n < kFours; ++n) {
    const Four middle = __builtin_shufflevector(mean[2 * n], mean[2 * n + 1], 0, 2, 4, 6);
    const Four last = __builtin_shufflevector(mean[2 * n], mean[2 * n + 1], 1, 3, 5, 7);
    const Four first = __builtin_shufflevector(last, Four{previous}, 4, 0, 1, 2);
    previous = last[3];
    const Four at_same = __builtin_shufflevector(here[2 * n], here[2 * n + 1], 0, 2, 4, 6);
    const Four average = 0.5F * middle + 0.25F * (first + last);
    // A mean of distances whose rounding says nothing: where a flat wall lies on nodes, less than
    // this would put them on either side by chance.
    const Four size = average < 0.0F ? -average : average;
    const Four rounded = size < 1e-5F * voxel ? Four{} : average;
    const FourBits is_known = rounded == rounded;
    const Four taken = is_known ? rounded : at_same;
    __builtin_memcpy(value + 4 * n, &taken, sizeof taken);
    constexpr FourBits kBits{1, 2, 4, 8};
    const FourBits known = is_known & kBits;
    const FourBits stored = (at_same == at_same) & kBits;
    is_averaged |= static_cast<unsigned>(known[0] | known[1] | known[2] | known[3]) << 4 * n;
    is_decided |= static_cast<unsigned>(stored[0] | stored[1] | stored[2] | stored[3]) << 4 * n;
  }
  *decided = static_cast<unsigned char>(is_decided);
  *averaged = static_cast<unsigned char>(is_averaged);
}

void restrict_leaf(const RestrictJob& job, float* value, unsigned char* decided,
                   unsigned char* averaged) noexcept {
  constexpr int kPlane = kFineSide * kFineRow;
  alignas(64) float planes[3 * kPlane];
  alignas(64) float along_x[kPlane];
  float* before = planes;
  float* here = planes + kPlane;
  float* after = planes + 2 * kPlane;
  fine_plane(job.leaves, kRowNodes - 1, job.band, before);
  for (int i = 0; i < kRowNodes; ++i) {
    const float* const* leaves = job.leaves + (i < kRowNodes / 2 ? 9 : 18);
    const int first = 2 * i % kRowNodes;
    fine_plane(leaves, first, job.band, here);
    fine_plane(leaves, first + 1, job.band, after);
    for (int j = 0; j < kFineSide; ++j) {
      const int row = kFineRow * j;
      weigh_row(before + row, here + row, after + row, along_x + row);
    }
    for (int j = 0; j < kRowNodes; ++j) {
      const int n = kRowNodes * i + j;
      coarse_row(along_x + kFineRow * 2 * j, here + kFineRow * (2 * j + 1), job.voxel,
                 value + kRowNodes * n, decided + n, averaged + n);
    }
    float* const former = before;  // the last plane of one coarse node is the first of the next
    before = after;
    after = former;
  }
}
