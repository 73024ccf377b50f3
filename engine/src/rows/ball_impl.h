// SPDX-License-Identifier: GPL-3.0-or-later
// The distances of PosedTool to a ball that moves along a straight path. Included by rows_impl.h.

void ball_distances(const BallJob& job, float* out) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      float* row = out + kRowNodes * (kRowNodes * i + j);
      const float x = job.x[i];
      const float y = job.y[j];
      for (int k = 0; k < kRowNodes; ++k) {
        const float z = job.z + job.step * static_cast<float>(k);
        const float dot = x * job.axis[0] + y * job.axis[1] + z * job.axis[2];
        const float along = lesser(greater(dot, 0.0F), job.path);
        const float dx = x - along * job.axis[0];
        const float dy = y - along * job.axis[1];
        const float dz = z - along * job.axis[2];
        row[k] = __builtin_sqrtf(dx * dx + dy * dy + dz * dz) - job.radius;
      }
    }
  }
}
