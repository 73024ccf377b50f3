// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of find_layers and TileFeet. Included by rows_impl.h after layer_impl.h.

/// From a node of a leaf with its faces to the next along each axis.
constexpr int kFacesStride[3] = {100, 10, 1};

/// Eight nodes' points of a layer.
struct RowPoints {
  EightFloats fields[LayerPoints::kFields];
  unsigned found;   ///< bits of those whose cubes the layer crosses
  unsigned inside;  ///< bits of those on that side of the surface
};

ARGIL_ROWS void magnitudes(const EightFloats& of, EightFloats& out) { out = of < 0.0F ? -of : of; }

/// Of a row's nodes, the first `at`, whose leaf begins `from` nodes before it.
ARGIL_ROWS void project_row(const float* at, const int* from, const LayerRule& rule,
                            RowPoints& out) {
  // No layer crosses the cube of a node that is farther from it, in voxels: half a diagonal.
  constexpr float kFarthest = 0.87F;
  // A gradient below its square is that of a medial sheet.
  constexpr float kLeastSquare = 0.25F;
  // The tightest bend that a level can hold, by voxel.
  constexpr float kTightest = 0.5F;
  const EightFloats none = {};
  EightFloats value;
  EightFloats size;
  load_eight(at, value);
  magnitudes(value, size);
  const EightFloats miss = size - rule.layer * rule.voxel;
  EightFloats missed;
  magnitudes(miss, missed);
  out.found = lane_bits(missed < kFarthest * rule.voxel);
  if (out.found == 0) return;
  const EightFloats side = value < 0.0F ? none - 1.0F : none + 1.0F;
  const float inverse = 1.0F / rule.voxel;
  EightFloats square = none;
  EightFloats reach = none;
  EightFloats sum = none;
  EightFloats gradient[3];
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats low;
    EightFloats high;
    load_eight(at - kFacesStride[axis], low);
    load_eight(at + kFacesStride[axis], high);
    // Beyond the band values are cut short, and beyond what is stored not known: straight on.
    const EightInts is_low = (low < rule.band) & (low > -rule.band);
    const EightInts is_high = (high < rule.band) & (high > -rule.band);
    const EightInts is_both = is_low & is_high;
    low -= value;
    high -= value;
    const EightFloats straight = is_low ? -low : (is_high ? high : none);
    gradient[axis] = inverse * (is_both ? 0.5F * (high - low) : straight);
    square += gradient[axis] * gradient[axis];
    EightFloats steep;
    magnitudes(gradient[axis], steep);
    reach += steep;
    sum += is_both ? low + high : none;
  }
  out.found &= lane_bits((square >= kLeastSquare) & (missed <= (0.5F * rule.voxel) * reach));
  if (out.found == 0) return;
  out.inside = lane_bits(value < 0.0F);
  const EightFloats laplacian = side * sum * (inverse * inverse);
  const EightFloats back = side * (miss - rule.averaged * laplacian) / square;
  EightFloats steepness;
  roots(square, steepness);
  const EightFloats upward = side / steepness;
  const EightFloats along = {0, 1, 2, 3, 4, 5, 6, 7};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    const EightFloats node = axis == 2 ? along : none + static_cast<float>(from[axis]);
    out.fields[axis] = node * rule.voxel - back * gradient[axis];
    out.fields[3 + axis] = upward * gradient[axis];
  }
  const float most = kTightest * inverse;
  EightFloats bend = 0.5F * laplacian;
  bend = bend < -most ? none - most : bend;
  out.fields[6] = bend > most ? none + most : bend;
}

/// Puts a row's points into their clusters, `first` the one of its first four nodes.
ARGIL_ROWS void add_points(const RowPoints& row, int first, LayerPoints& out) {
  float fields[LayerPoints::kFields][kRowNodes];
  __builtin_memcpy(fields, row.fields, sizeof fields);
  unsigned bits = row.found;
  while (bits != 0) {
    const int lane = __builtin_ctz(bits);
    bits &= bits - 1;
    const int side = static_cast<int>(row.inside >> lane & 1U);
    const int cluster = first + (lane >> 2);
    const int to = out.count[side][cluster]++;
    for (int field = 0; field < LayerPoints::kFields; ++field) {
      out.values[side][cluster][field][to] = fields[field][lane];
    }
  }
}

/// The least and the most of some values, as many as fill vectors.
ARGIL_ROWS void bounds_of(const EightFloats& low, const EightFloats& high, float& least,
                          float& most) {
  least = low[0];
  most = high[0];
  for (int lane = 1; lane < kRowNodes; ++lane) {
    least = lesser(low[lane], least);
    most = greater(most, high[lane]);
  }
}

/// Boxes around a cluster's points and those of the surface `down` below them.
ARGIL_ROWS void add_boxes(float down, int cluster, int count, float (*values)[LayerPoints::kMost],
                          ClusterBoxes& feet, ClusterBoxes& surface) {
  constexpr float kInfinity = __builtin_inff();
  for (int axis = 0; axis < 3; ++axis) {
    float* place = values[axis];
    float* normal = values[3 + axis];
    EightFloats low = EightFloats{} + kInfinity;
    EightFloats high = -low;
    EightFloats low_below = low;
    EightFloats high_below = high;
    // The last vector is filled up with the first point.
    for (int n = count; n % kRowNodes != 0; ++n) {
      place[n] = place[0];
      normal[n] = normal[0];
    }
    for (int n = 0; n < count; n += kRowNodes) {
      EightFloats at;
      EightFloats below;
      load_eight(place + n, at);
      load_eight(normal + n, below);
      below = at - down * below;
      low = at < low ? at : low;
      high = high < at ? at : high;
      low_below = below < low_below ? below : low_below;
      high_below = high_below < below ? below : high_below;
    }
    bounds_of(low, high, feet.low[axis][cluster], feet.high[axis][cluster]);
    bounds_of(low_below, high_below, surface.low[axis][cluster], surface.high[axis][cluster]);
  }
}

void project_to_layers(const float* values, const LayerRule& rule, LayerPoints& out) noexcept {
  for (int side = 0; side < 2; ++side) {
    for (int cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
      out.count[side][cluster] = 0;
    }
  }
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int from[2] = {i, j};
      RowPoints row;
      project_row(values + (i + 1) * kFacesStride[0] + (j + 1) * kFacesStride[1] + 1, from, rule,
                  row);
      if (row.found != 0) add_points(row, (i >> 2) * 4 + (j >> 2) * 2, out);
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (int cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
      add_boxes(rule.layer * rule.voxel, cluster, out.count[side][cluster],
                out.values[side][cluster], out.feet[side], out.surface[side]);
    }
  }
}

void measure_clusters(const ClusterJob& job, ClusterSquares& out) noexcept {
  constexpr float kInfinity = __builtin_inff();
  const EightFloats none = {};
  EightFloats nearest = none;
  EightFloats farthest = none;
  EightFloats beyond_outer = none - kInfinity;
  EightFloats beyond_inner = beyond_outer;
  EightFloats before_inner = beyond_outer;
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats low;
    EightFloats high;
    load_eight(job.feet->low[axis], low);
    load_eight(job.feet->high[axis], high);
    low += job.offset[axis];
    high += job.offset[axis];
    const EightFloats above = low - job.half;
    EightFloats off = -job.half - high;
    off = off < above ? above : off;
    off = off < 0.0F ? none : off;
    nearest += off * off;
    EightFloats far_low;
    EightFloats far_high;
    magnitudes(low, far_low);
    magnitudes(high, far_high);
    const EightFloats far = (far_low < far_high ? far_high : far_low) + job.half;
    farthest += far * far;
    // How the points of the surface lie to the cubes: largest differences along the axes, negative
    // where no axis leads out.
    load_eight(job.surface->low[axis], low);
    load_eight(job.surface->high[axis], high);
    low += job.offset[axis];
    high += job.offset[axis];
    const EightFloats near_side = low < -high ? -high : low;
    const EightFloats far_side = -low < high ? high : -low;
    const EightFloats outer = near_side - job.outer;
    const EightFloats inner = near_side - job.inner;
    const EightFloats before = far_side - job.inner;
    beyond_outer = beyond_outer < outer ? outer : beyond_outer;
    beyond_inner = beyond_inner < inner ? inner : beyond_inner;
    before_inner = before_inner < before ? before : before_inner;
  }
  const EightInts is_left_out = (beyond_outer > 0.0F) | (before_inner < 0.0F);
  const EightInts is_cut = beyond_inner < 0.0F;
  nearest = is_left_out ? none + kInfinity : nearest;
  farthest = (is_left_out | is_cut) ? none + kInfinity : farthest;
  __builtin_memcpy(out.nearest, &nearest, sizeof nearest);
  __builtin_memcpy(out.farthest, &farthest, sizeof farthest);
  out.cut = lane_bits(is_cut);
}
