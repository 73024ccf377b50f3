// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of move_matter(). Included by rows_impl.h.

/// The weights of the four nodes around a point that lies at `t`, 0 to 1, from the second to the
/// third: those of nodes themselves are 0 and 1, so that a node reads its own value.
ARGIL_ROWS void catmull_rom(float t, float weight[4]) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  weight[0] = 0.5F * (2.0F * t2 - t - t3);
  weight[1] = 0.5F * (2.0F - 5.0F * t2 + 3.0F * t3);
  weight[2] = 0.5F * (t + 4.0F * t2 - 3.0F * t3);
  weight[3] = 0.5F * (t3 - t2);
}

ARGIL_ROWS void cubic_row(const FieldJob& job, const float* __restrict x, const float* __restrict y,
                          const float* __restrict z, float* __restrict out) {
  const int stride_y = job.count[2];
  const int stride_x = job.count[1] * stride_y;
  for (int lane = 0; lane < kRowNodes; ++lane) {
    const float at_x = job.first[0] + job.scale * x[lane];
    const float at_y = job.first[1] + job.scale * y[lane];
    const float at_z = job.first[2] + job.scale * z[lane];
    const int low_x = static_cast<int>(at_x);
    const int low_y = static_cast<int>(at_y);
    const int low_z = static_cast<int>(at_z);
    float weight_x[4];
    float weight_y[4];
    float weight_z[4];
    catmull_rom(at_x - static_cast<float>(low_x), weight_x);
    catmull_rom(at_y - static_cast<float>(low_y), weight_y);
    catmull_rom(at_z - static_cast<float>(low_z), weight_z);
    const int first = (low_x - 1) * stride_x + (low_y - 1) * stride_y + low_z - 1;
    float sum = 0.0F;
    for (int i = 0; i < 4; ++i) {
      float plane = 0.0F;
      for (int j = 0; j < 4; ++j) {
        const int row = first + i * stride_x + j * stride_y;
        float along = weight_z[0] * job.value[row];
        for (int k = 1; k < 4; ++k) along += weight_z[k] * job.value[row + k];
        plane += weight_y[j] * along;
      }
      sum += weight_x[i] * plane;
    }
    out[lane] = sum;
  }
}

void read_cubic(const FieldJob& job, const PointBlock& points, float* out) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    if (!points.is_asked[row]) continue;
    const int n = kRowNodes * row;
    cubic_row(job, points.x + n, points.y + n, points.z + n, out + n);
  }
}

ARGIL_ROWS void pinch_row(const PinchJob& job, float i, float j, float* __restrict x,
                          float* __restrict y, float* __restrict z, float* __restrict pull) {
  float node_x[kRowNodes];
  float node_y[kRowNodes];
  float node_z[kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    node_x[k] = i;
    node_y[k] = j;
    node_z[k] = static_cast<float>(k);
  }
  pull_of_row(job.pull, node_x, node_y, node_z, pull);
  const float from_x = job.first[0] + i;
  const float from_y = job.first[1] + j;
  for (int k = 0; k < kRowNodes; ++k) {
    const float from_z = job.first[2] + node_z[k];
    const float along = job.normal[0] * from_x + job.normal[1] * from_y + job.normal[2] * from_z;
    const float inward = pull[k] * job.inward;
    const float down = pull[k] * job.down - inward * along;
    x[k] += inward * from_x + down * job.normal[0];
    y[k] += inward * from_y + down * job.normal[1];
    z[k] += inward * from_z + down * job.normal[2];
  }
}

void add_pinch(const PinchJob& job, PointBlock& points) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int row = kRowNodes * i + j;
      const int n = kRowNodes * row;
      float pull[kRowNodes];
      pinch_row(job, static_cast<float>(i), static_cast<float>(j), points.x + n, points.y + n,
                points.z + n, pull);
      points.is_asked[row] |= any_positive(pull);
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
