// SPDX-License-Identifier: GPL-3.0-or-later
// The loop that extends a distance beyond its band. Included by rows_impl.h after layer_impl.h and
// sweep_impl.h, whose notation and equations it has; as far from the surface all values have one
// sign, so it takes none.

/// Rows by x + y and by x - y: those with the same sum read none of one another, so that the
/// machine may solve them at once.
struct RowOrders {
  unsigned char row[2][kLeafRows];
};
constexpr RowOrders row_orders() {
  RowOrders orders{};
  for (int which = 0; which < 2; ++which) {
    int count = 0;
    for (int sum = 0; sum < 2 * kRowNodes - 1; ++sum) {
      for (int x = 0; x < kRowNodes; ++x) {
        const int y = which == 0 ? sum - x : x + kRowNodes - 1 - sum;
        if (y < 0 || y >= kRowNodes) continue;
        orders.row[which][count++] = static_cast<unsigned char>(kRowNodes * x + y);
      }
    }
  }
  return orders;
}
constexpr RowOrders kRowOrders = row_orders();

/// An axis's nearer neighbours, and what their differences start from.
ARGIL_ROWS void axis_of_eight(const float* at, int stride, float steepest, EightFloats& near,
                              EightFloats& from) {
  EightFloats low;
  EightFloats high;
  EightFloats behind_low;
  EightFloats behind_high;
  load_eight(at - stride, low);
  load_eight(at + stride, high);
  load_eight(at - 2 * stride, behind_low);
  load_eight(at + 2 * stride, behind_high);
  const EightFloats farther = behind_low < behind_high ? behind_high : behind_low;
  const EightFloats behind = low < high ? behind_low : (high < low ? behind_high : farther);
  near = low < high ? low : high;
  const EightInts is_second = (behind < near) & (near - behind <= steepest);
  from = is_second ? (4.0F * near - behind) * (1.0F / 3.0F) : near;
}

ARGIL_ROWS void order_eight(EightFloats& near_a, EightFloats& from_a, EightFloats& near_b,
                            EightFloats& from_b) {
  const EightInts swaps = near_b < near_a;
  const EightFloats near = swaps ? near_a : near_b;
  const EightFloats from = swaps ? from_a : from_b;
  near_a = swaps ? near_b : near_a;
  from_a = swaps ? from_b : from_a;
  near_b = near;
  from_b = from;
}

/// Of an axis: only a second difference starts beyond the neighbour.
ARGIL_ROWS void weights_of_eight(const EightFloats& near, const EightFloats& from,
                                 EightFloats& weight) {
  weight = from > near ? EightFloats{} + 2.25F : EightFloats{} + 1.0F;
}

ARGIL_ROWS bool deepen_row(float* at, unsigned kept, float voxel, float limit, float settled) {
  EightFloats near[3];
  EightFloats from[3];
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    axis_of_eight(at, kStride[axis], kSteepestVoxels * voxel, near[axis], from[axis]);
  }
  order_eight(near[0], from[0], near[1], from[1]);
  order_eight(near[1], from[1], near[2], from[2]);
  order_eight(near[0], from[0], near[1], from[1]);
  EightFloats weight[3];
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) weights_of_eight(near[axis], from[axis], weight[axis]);
  const EightFloats a2 = weight[0] + weight[1];
  const EightFloats a3 = a2 + weight[2];
  const EightFloats inverse2 = 1.0F / a2;
  const EightFloats inverse3 = 1.0F / a3;
  const EightFloats y = from[1] - from[0];
  const EightFloats z = from[2] - from[0];
  const EightFloats b2 = weight[1] * y;
  const EightFloats c2 = b2 * y - voxel * voxel;
  const EightFloats b3 = b2 + weight[2] * z;
  const EightFloats c3 = c2 + weight[2] * z * z;
  const EightFloats square2 = b2 * b2 - a2 * c2;
  const EightFloats square3 = b3 * b3 - a3 * c3;
  EightFloats root2;
  EightFloats root3;
  roots(square2, root2);
  roots(square3, root3);
  const EightFloats one =
      from[0] + (from[0] > near[0] ? EightFloats{} + voxel * (1.0F / 1.5F) : EightFloats{} + voxel);
  const EightFloats two = from[0] + (b2 + root2) * inverse2;
  const EightFloats three = from[0] + (b3 + root3) * inverse3;
  EightFloats now = (square2 >= 0.0F) & (two >= near[1]) ? two : one;
  now = (square3 >= 0.0F) & (three >= near[2]) ? three : now;
  now = now < limit ? now : EightFloats{} + limit;
  const EightInts bit = {1, 2, 4, 8, 16, 32, 64, 128};
  EightFloats before;
  load_eight(at, before);
  now = (bit & static_cast<int>(kept)) != 0 ? before : now;
  __builtin_memcpy(at, &now, sizeof now);
  const EightFloats apart = now < before ? before - now : now - before;
  return lane_bits(apart > settled) != 0;
}

/// Whether a row and all that it is solved from is unknown: it stays so.
ARGIL_ROWS bool is_unreached(const float* at, float limit) {
  EightFloats nearest;
  load_eight(at, nearest);
#pragma GCC unroll 3
  for (const int stride : kStride) {
    EightFloats low;
    EightFloats high;
    load_eight(at - stride, low);
    load_eight(at + stride, high);
    nearest = low < nearest ? low : nearest;
    nearest = high < nearest ? high : nearest;
  }
  return lane_bits(nearest < limit) == 0;
}

std::uint64_t deepen(HaloBlock& block, const unsigned char* kept, float voxel, float limit,
                     float settled, std::uint64_t rows, int pass) noexcept {
  const unsigned char* const order = kRowOrders.row[pass >> 1 & 1];
  const bool is_backward = (pass & 1) != 0;
  std::uint64_t moved = 0;
  for (int i = 0; i < kLeafRows; ++i) {
    const int n = order[is_backward ? kLeafRows - 1 - i : i];
    if ((rows >> n & 1U) == 0 || kept[n] == 0xff) continue;
    float* const row = block.value + HaloBlock::index(n / kRowNodes, n % kRowNodes, 0);
    if (is_unreached(row, limit)) continue;
    if (deepen_row(row, kept[n], voxel, limit, settled)) moved |= std::uint64_t{1} << n;
  }
  return moved;
}
