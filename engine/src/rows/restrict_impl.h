// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of restrict_leaf(). Included by rows_impl.h.
//
// Notation: the fine nodes that decide a coarse leaf's are a block of 17^3 that starts one node
// below it. Rows lie so that the nodes of the two leaves it covers begin at multiples of 8; what is
// before the first node, at kFineFirst, is never used.

constexpr int kFineSide = 2 * kRowNodes + 1;
constexpr int kFineRow = 3 * kRowNodes;
constexpr int kFineFirst = kRowNodes - 1;

/// Which of three leaves, and which of its nodes along an axis, node i of the block is.
ARGIL_ROWS constexpr int fine_leaf(int i) { return (i + kRowNodes - 1) / kRowNodes; }
ARGIL_ROWS constexpr int fine_node(int i) { return (i + kRowNodes - 1) % kRowNodes; }

ARGIL_ROWS float weighted(float before, float here, float after) {
  return 0.5F * here + 0.25F * (before + after);
}

/// Row (i, j) of the block; NaN outside the band.
ARGIL_ROWS void fine_row(const RestrictJob& job, int i, int j, float* __restrict row) {
  const float* const* leaves = job.leaves + 9 * fine_leaf(i) + 3 * fine_leaf(j);
  const int offset = kRowNodes * (kRowNodes * fine_node(i) + fine_node(j));
  for (int n = 0; n < 3; ++n) {
    const float* from = leaves[n] + offset;
    float* to = row + kRowNodes * n;
    for (int k = 0; k < kRowNodes; ++k) {
      to[k] = magnitude(from[k]) < job.band ? from[k] : __builtin_nanf("");
    }
  }
}

ARGIL_ROWS void weigh_row(const float* __restrict before, const float* __restrict here,
                          const float* __restrict after, float* __restrict to) {
  for (int k = 0; k < kFineRow; ++k) to[k] = weighted(before[k], here[k], after[k]);
}

ARGIL_ROWS unsigned packed(const int* flags) {
  unsigned bits = 0;
  for (int k = 0; k < kRowNodes; ++k) bits |= static_cast<unsigned>(flags[k]) << k;
  return bits;
}

/// The coarse nodes of a row, from the mean along x and y and the fine row at the same place.
ARGIL_ROWS void coarse_row(const float* __restrict mean, const float* __restrict same, float voxel,
                           float* __restrict value, unsigned char* decided,
                           unsigned char* averaged) {
  float even[kRowNodes + 1];
  float odd[kRowNodes];
  float at_same[kRowNodes];
  for (int k = 0; k <= kRowNodes; ++k) even[k] = mean[kFineFirst + 2 * k];
  for (int k = 0; k < kRowNodes; ++k) odd[k] = mean[kFineFirst + 2 * k + 1];
  for (int k = 0; k < kRowNodes; ++k) at_same[k] = same[kFineFirst + 2 * k + 1];
  int is_decided[kRowNodes];
  int is_averaged[kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    const float average = weighted(even[k], odd[k], even[k + 1]);
    // A mean of distances whose rounding says nothing: where a flat wall lies on nodes, less than
    // this would put them on either side by chance.
    const float rounded = magnitude(average) < 1e-5F * voxel ? 0.0F : average;
    const bool is_known = rounded == rounded;
    value[k] = is_known ? rounded : at_same[k];
    is_averaged[k] = is_known ? 1 : 0;
    is_decided[k] = at_same[k] == at_same[k] ? 1 : 0;
  }
  *decided = static_cast<unsigned char>(packed(is_decided));
  *averaged = static_cast<unsigned char>(packed(is_averaged));
}

void restrict_leaf(const RestrictJob& job, float* value, unsigned char* decided,
                   unsigned char* averaged) noexcept {
  alignas(64) float fine[3][kFineSide * kFineRow];  // of three planes across x
  alignas(64) float along_x[kFineSide * kFineRow];
  alignas(64) float mean[kFineRow];
  for (int j = 0; j < kFineSide; ++j) fine_row(job, 0, j, fine[0] + kFineRow * j);
  for (int i = 0; i < kRowNodes; ++i) {
    // The last plane of one coarse node is the first of the next.
    float* before = fine[2 * i % 3];
    float* here = fine[(2 * i + 1) % 3];
    float* after = fine[(2 * i + 2) % 3];
    for (int j = 0; j < kFineSide; ++j) {
      const int row = kFineRow * j;
      fine_row(job, 2 * i + 1, j, here + row);
      fine_row(job, 2 * i + 2, j, after + row);
      weigh_row(before + row, here + row, after + row, along_x + row);
    }
    for (int j = 0; j < kRowNodes; ++j) {
      const float* rows = along_x + kFineRow * 2 * j;
      weigh_row(rows, rows + kFineRow, rows + 2 * kFineRow, mean);
      const int n = kRowNodes * i + j;
      coarse_row(mean, here + kFineRow * (2 * j + 1), job.voxel, value + kRowNodes * n, decided + n,
                 averaged + n);
    }
  }
}
