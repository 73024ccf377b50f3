// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of displace(). Included by rows_impl.h.

/// How much the distance rises along an axis, per voxel: from as many sides as are known.
ARGIL_ROWS float rise_of(const float* at, int stride, float band) {
  const float here = *at;
  const float low = at[-stride];
  const float high = at[stride];
  const bool is_low = magnitude(low) < band;  // not so for NaN
  const bool is_high = magnitude(high) < band;
  const float one_sided = is_high ? high - here : (is_low ? here - low : 0.0F);
  return is_low & is_high ? 0.5F * (high - low) : one_sided;
}

/// True where some node is within the band. A foot is the node itself where the field does not
/// tell, in the middle of something thin.
ARGIL_ROWS bool feet_of_row(const float* __restrict from, float i, float j, float voxel, float band,
                            float* __restrict x, float* __restrict y, float* __restrict z) {
  float in_band = 0.0F;
  for (int k = 0; k < kRowNodes; ++k) {
    in_band = magnitude(from[k]) < band ? 1.0F : in_band;
  }
  if (in_band == 0.0F) return false;
  const float inverse = 1.0F / voxel;
  const float least = 0.5F * voxel;
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = from + k;
    const float rise_x = rise_of(at, kStride[0], band);
    const float rise_y = rise_of(at, kStride[1], band);
    const float rise_z = rise_of(at, kStride[2], band);
    const float steep = __builtin_sqrtf(rise_x * rise_x + rise_y * rise_y + rise_z * rise_z);
    const float back = steep < least ? 0.0F : *at * inverse / steep;
    x[k] = i - back * rise_x;
    y[k] = j - back * rise_y;
    z[k] = static_cast<float>(k) - back * rise_z;
  }
  return true;
}

void find_feet(const HaloBlock& from, float voxel, float band, FeetBlock& feet) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int row = kRowNodes * i + j;
      const int n = kRowNodes * row;
      feet.has_band[row] = feet_of_row(from.value + HaloBlock::index(i, j, 0),
                                       static_cast<float>(i), static_cast<float>(j), voxel, band,
                                       feet.at.x + n, feet.at.y + n, feet.at.z + n);
    }
  }
}

/// In the place of the squares of distances in radii: how far each of fall_off() leaves a height.
ARGIL_ROWS void fall_off_row(Falloff falloff, float height, float* __restrict row) {
  // The squares or the distances from the rim, inward.
  const bool is_of_square = falloff == Falloff::smooth || falloff == Falloff::sphere ||
                            falloff == Falloff::inverse_square || falloff == Falloff::constant;
  if (is_of_square) {
    for (int k = 0; k < kRowNodes; ++k) row[k] = greater(1.0F - row[k], 0.0F);
  } else {
    for (int k = 0; k < kRowNodes; ++k) row[k] = greater(1.0F - __builtin_sqrtf(row[k]), 0.0F);
  }
  switch (falloff) {
    case Falloff::smooth:
    case Falloff::sharp:
      for (int k = 0; k < kRowNodes; ++k) row[k] = height * (row[k] * row[k]);
      return;
    case Falloff::smoother:
      for (int k = 0; k < kRowNodes; ++k) {
        const float p = row[k];
        row[k] = height * (p * p * p * (p * (6.0F * p - 15.0F) + 10.0F));
      }
      return;
    case Falloff::sphere:
    case Falloff::root:
      for (int k = 0; k < kRowNodes; ++k) row[k] = height * __builtin_sqrtf(row[k]);
      return;
    case Falloff::sharper:
      for (int k = 0; k < kRowNodes; ++k) {
        const float square = row[k] * row[k];
        row[k] = height * (square * square);
      }
      return;
    case Falloff::linear:
    case Falloff::inverse_square:
      for (int k = 0; k < kRowNodes; ++k) row[k] = height * row[k];
      return;
    case Falloff::constant:
      for (int k = 0; k < kRowNodes; ++k) row[k] = row[k] > 0.0F ? height : 0.0F;
      return;
  }
}

ARGIL_ROWS void pull_of_row(const PullJob& job, const float* __restrict x,
                            const float* __restrict y, const float* __restrict z,
                            float* __restrict pull) {
  for (int k = 0; k < kRowNodes; ++k) {
    float from[3];
    for (int a = 0; a < 3; ++a) {
      from[a] =
          job.first[a] + job.along[0][a] * x[k] + job.along[1][a] * y[k] + job.along[2][a] * z[k];
    }
    const float on_path = from[0] * job.path[0] + from[1] * job.path[1] + from[2] * job.path[2];
    const float fraction = lesser(greater(on_path * job.inverse_square, 0.0F), 1.0F);
    float square = 0.0F;
    for (int a = 0; a < 3; ++a) {
      const float off = from[a] - fraction * job.path[a];
      square += off * off;
    }
    pull[k] = square;
  }
  fall_off_row(job.falloff, job.height, pull);
}

ARGIL_ROWS bool any_positive(const float* row) {
  float most = 0.0F;
  for (int k = 0; k < kRowNodes; ++k) most = greater(most, row[k]);
  return most > 0.0F;
}

void pull(const PullJob& job, FeetBlock& feet) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    feet.at.is_asked[row] = false;
    if (!feet.has_band[row]) continue;
    const int n = kRowNodes * row;
    pull_of_row(job, feet.at.x + n, feet.at.y + n, feet.at.z + n, feet.pull + n);
    feet.at.is_asked[row] = any_positive(feet.pull + n);
  }
}

ARGIL_ROWS void draw_row(const PlaneJob& job, const float* __restrict x, const float* __restrict y,
                         const float* __restrict z, const float* __restrict pull,
                         float* __restrict moves) {
  for (int k = 0; k < kRowNodes; ++k) {
    const float distance =
        job.first + job.along[0] * x[k] + job.along[1] * y[k] + job.along[2] * z[k];
    const float drawn = lesser(greater(distance, job.least), job.most);
    const float part = job.weight * pull[k];
    const float facing = lesser(greater(moves[k], 0.0F), 1.0F);
    moves[k] = part / (job.steps - job.step * part) * drawn * facing;
  }
}

void draw_to_plane(const PlaneJob& job, const FeetBlock& feet, float* moves) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    if (!feet.at.is_asked[row]) continue;
    const int n = kRowNodes * row;
    draw_row(job, feet.at.x + n, feet.at.y + n, feet.at.z + n, feet.pull + n, moves + n);
  }
}

float displace(const float* moves, const bool* is_asked, float band, float most,
               float* values) noexcept {
  float farthest[kRowNodes] = {};
  for (int row = 0; row < kLeafRows; ++row) {
    if (!is_asked[row]) continue;
    float* const value = values + kRowNodes * row;
    for (int k = 0; k < kRowNodes; ++k) {
      const float move = magnitude(value[k]) < band ? moves[kRowNodes * row + k] : 0.0F;
      farthest[k] = greater(farthest[k], magnitude(move));
      const float moved = value[k] + lesser(greater(move, -most), most);
      value[k] = lesser(greater(moved, -band), band);
    }
  }
  float all = 0.0F;
  for (int k = 0; k < kRowNodes; ++k) all = greater(all, farthest[k]);
  return all;
}

/// Splits a coordinate into a node, with another after it, and a fraction.
ARGIL_ROWS int node_below(float at, int count, float& fraction) {
  const float inside = lesser(greater(at, 0.0F), static_cast<float>(count - 1));
  const int whole = static_cast<int>(inside);
  const int node = whole < count - 2 ? whole : count - 2;
  fraction = inside - static_cast<float>(node);
  return node;
}

ARGIL_ROWS float between(float a, float b, float fraction) { return a + fraction * (b - a); }

ARGIL_ROWS void read_row(const FieldJob& job, const float* __restrict x, const float* __restrict y,
                         const float* __restrict z, float* __restrict out) {
  const int stride_y = job.count[2];
  const int stride_x = job.count[1] * stride_y;
  int node[kRowNodes];
  float fx[kRowNodes];
  float fy[kRowNodes];
  float fz[kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    node[k] = node_below(job.first[0] + job.scale * x[k], job.count[0], fx[k]) * stride_x +
              node_below(job.first[1] + job.scale * y[k], job.count[1], fy[k]) * stride_y +
              node_below(job.first[2] + job.scale * z[k], job.count[2], fz[k]);
  }
  float corner[8][kRowNodes];
  for (int k = 0; k < kRowNodes; ++k) {
    const float* at = job.value + node[k];
    corner[0][k] = at[0];
    corner[1][k] = at[1];
    corner[2][k] = at[stride_y];
    corner[3][k] = at[stride_y + 1];
    corner[4][k] = at[stride_x];
    corner[5][k] = at[stride_x + 1];
    corner[6][k] = at[stride_x + stride_y];
    corner[7][k] = at[stride_x + stride_y + 1];
  }
  for (int k = 0; k < kRowNodes; ++k) {
    const float low = between(between(corner[0][k], corner[1][k], fz[k]),
                              between(corner[2][k], corner[3][k], fz[k]), fy[k]);
    const float high = between(between(corner[4][k], corner[5][k], fz[k]),
                               between(corner[6][k], corner[7][k], fz[k]), fy[k]);
    out[k] = between(low, high, fx[k]);
  }
}

void read(const FieldJob& job, const PointBlock& points, float* out) noexcept {
  for (int row = 0; row < kLeafRows; ++row) {
    if (!points.is_asked[row]) continue;
    const int n = kRowNodes * row;
    read_row(job, points.x + n, points.y + n, points.z + n, out + n);
  }
}
