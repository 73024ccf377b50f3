// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of move_matter(). Included by rows_impl.h.

using EightFloats = float __attribute__((vector_size(32)));
using EightInts = int __attribute__((vector_size(32)));

/// Of the nodes of a row the nodes that Catmull-Rom reads for each: where the first of 4^3 lies in
/// the field, and their weights along each axis.
struct CubicRow {
  EightFloats x[4];
  EightFloats y[4];
  EightFloats z[4];
  EightInts first;
};

/// The weights of the four nodes around a point that lies at `t`, 0 to 1, from the second to the
/// third: those of nodes themselves are 0 and 1, so that a node reads its own value.
ARGIL_ROWS void catmull_rom(const EightFloats& t, EightFloats* weight) {
  const EightFloats t2 = t * t;
  const EightFloats t3 = t2 * t;
  weight[0] = 0.5F * (2.0F * t2 - t - t3);
  weight[1] = 0.5F * (2.0F - 5.0F * t2 + 3.0F * t3);
  weight[2] = 0.5F * (t + 4.0F * t2 - 3.0F * t3);
  weight[3] = 0.5F * (t3 - t2);
}

ARGIL_ROWS void place_along(const float* points, float first, float scale, EightInts& low,
                            EightFloats* weight) {
  EightFloats at;
  __builtin_memcpy(&at, points, sizeof at);
  at = first + scale * at;
  low = __builtin_convertvector(at, EightInts);
  catmull_rom(at - __builtin_convertvector(low, EightFloats), weight);
}

/// The sums of eight lanes; load(offset, out) gives what lies so far after the first node of each.
template <class Load>
ARGIL_ROWS void cubic_sums(const CubicRow& row, int stride_x, int stride_y, const Load& load,
                           EightFloats& sum) {
  sum = EightFloats{};
  for (int i = 0; i < 4; ++i) {
    EightFloats plane{};
    for (int j = 0; j < 4; ++j) {
      const int offset = i * stride_x + j * stride_y;
      EightFloats value;
      load(offset, value);
      EightFloats along = row.z[0] * value;
      for (int k = 1; k < 4; ++k) {
        load(offset + k, value);
        along += row.z[k] * value;
      }
      plane += row.y[j] * along;
    }
    sum += row.x[i] * plane;
  }
}

/// Neighbours are mostly moved alike, so that they read neighbours: lanes that are as far from each
/// other in the field as in the row are read at once, wherever that stays within the field, up to
/// kMostRuns times.
ARGIL_ROWS void cubic_row(const FieldJob& job, const float* x, const float* y, const float* z,
                          float* out) {
  constexpr int kMostRuns = 4;
  const int stride_y = job.count[2];
  const int stride_x = job.count[1] * stride_y;
  CubicRow row;
  EightInts low_x;
  EightInts low_y;
  EightInts low_z;
  place_along(x, job.first[0], job.scale, low_x, row.x);
  place_along(y, job.first[1], job.scale, low_y, row.y);
  place_along(z, job.first[2], job.scale, low_z, row.z);
  row.first = (low_x - 1) * stride_x + (low_y - 1) * stride_y + low_z - 1;
  const EightInts run = row.first - EightInts{0, 1, 2, 3, 4, 5, 6, 7};
  const int last_run = job.count[0] * stride_x - 3 * (stride_x + stride_y + 1) - kRowNodes;
  EightInts is_left = EightInts{} == EightInts{};
  EightFloats all{};
  int lane = 0;
  for (int runs = 0; lane < kRowNodes && runs < kMostRuns; ++runs) {
    const int begin = run[lane];
    if (begin < 0 || begin > last_run) break;
    const float* const first = job.value + begin;
    EightFloats sum;
    cubic_sums(
        row, stride_x, stride_y,
        [first](int offset, EightFloats& value) __attribute__((always_inline)) {
          __builtin_memcpy(&value, first + offset, sizeof value);
        },
        sum);
    const EightInts is_here = is_left & (run == begin);
    all = is_here ? sum : all;
    is_left &= ~is_here;
    while (lane < kRowNodes && is_left[lane] == 0) ++lane;
  }
  if (lane < kRowNodes) {
    const float* const field = job.value;
    EightFloats sum;
    cubic_sums(
        row, stride_x, stride_y,
        [ field, &row ](int offset, EightFloats& value) __attribute__((always_inline)) {
          for (int k = 0; k < kRowNodes; ++k) value[k] = field[row.first[k] + offset];
        },
        sum);
    all = is_left ? sum : all;
  }
  __builtin_memcpy(out, &all, sizeof all);
}

void read_cubic(const FieldJob& job, const PointBlock& points, float* out) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    if (!points.is_asked[row]) continue;
    const int n = kRowNodes * row;
    cubic_row(job, points.x + n, points.y + n, points.z + n, out + n);
  }
}

/// Returns whether some node of the row is pushed.
ARGIL_ROWS bool pinch_row(const PinchJob& job, float i, float j, float* __restrict x,
                          float* __restrict y, float* __restrict z) {
  float pull[kRowNodes];
  float node_x[kRowNodes];
  float node_y[kRowNodes];
  float node_z[kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    node_x[k] = i;
    node_y[k] = j;
    node_z[k] = static_cast<float>(k);
  }
  pull_of_row(job.pull, node_x, node_y, node_z, pull);
  if (!any_positive(pull)) return false;
  const float from_x = job.first[0] + i;
  const float from_y = job.first[1] + j;
  for (int k = 0; k < kRowNodes; ++k) {
    const float from_z = job.first[2] + node_z[k];
    const float along = job.normal[0] * from_x + job.normal[1] * from_y + job.normal[2] * from_z;
    const float inward = pull[k] * job.inward;
    const float back = inward * along;
    x[k] += inward * from_x - back * job.normal[0];
    y[k] += inward * from_y - back * job.normal[1];
    z[k] += inward * from_z - back * job.normal[2];
  }
  return true;
}

void add_pinch(const PinchJob& job, PointBlock& points) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int row = kRowNodes * i + j;
      const int n = kRowNodes * row;
      points.is_asked[row] |= pinch_row(job, static_cast<float>(i), static_cast<float>(j),
                                        points.x + n, points.y + n, points.z + n);
    }
  }
}

ARGIL_ROWS void drag_row(const DragJob& job, float* __restrict x, float* __restrict y,
                         float* __restrict z, const float* __restrict pull) {
  for (int k = 0; k < kRowNodes; ++k) {
    x[k] -= pull[k] * job.shift[0];
    y[k] -= pull[k] * job.shift[1];
    z[k] -= pull[k] * job.shift[2];
  }
}

void add_drag(const DragJob& job, PointBlock& points) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    const int n = kRowNodes * row;
    float pull[kRowNodes];
    pull_of_row(job.pull, points.x + n, points.y + n, points.z + n, pull);
    if (!any_positive(pull)) continue;
    drag_row(job, points.x + n, points.y + n, points.z + n, pull);
    points.is_asked[row] = true;
  }
}
