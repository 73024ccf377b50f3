// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of MovedLevel. Included by rows_impl.h.

ARGIL_ROWS void within(const EightFloats& low, const EightFloats& high, EightFloats& value) {
  value = value < low ? low : value;
  value = high < value ? high : value;
}

/// The sizes of eight nodes that the clay tells, joined with what feet say.
ARGIL_ROWS void join_sizes(const JoinJob& job, const EightFloats& size, EightFloats& far) {
  const EightFloats none = {};
  EightFloats held = far;
  within(size / job.stretch, size * job.stretch, held);
  held = far < job.limit ? held : size;
  far = size < job.known ? held : far;
  EightFloats share = (job.high - size) / (job.high - job.low);
  within(none, none + 1.0F, share);
  far = share * size + (1.0F - share) * far;
  far = far < job.low ? none + job.low : far;
}

void join_told(const JoinJob& job, float* out) noexcept {
  const EightFloats none = {};
  for (int n = 0; n < kLeafRows * kRowNodes; n += kRowNodes) {
    EightFloats near;
    load_eight(job.near + n, near);
    const EightInts is_inside = near < 0.0F;
    const EightFloats size = is_inside ? -near : near;
    EightFloats joined = near;
    for (int side = 0; side < 2; ++side) {
      if (job.told[side] == nullptr) continue;
      const EightInts is_joined = (is_inside == -side) & (size > job.low);
      if (lane_bits(is_joined) == 0) continue;
      EightFloats far;
      load_eight(job.told[side] + n, far);
      join_sizes(job, size, far);
      joined = is_joined ? (side == 1 ? -far : far) : joined;
    }
    joined -= job.offset;
    within(none - job.band, none + job.band, joined);
    joined += 0.0F;
    __builtin_memcpy(out + n, &joined, sizeof joined);
  }
}
