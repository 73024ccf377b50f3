// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of find_layers, TileFeet and FeetTree. Included by rows_impl.h after layer_impl.h.

/// From a node of a leaf with its faces to the next along each axis.
constexpr int kFacesStride[3] = {100, 10, 1};

/// Eight nodes' points of a layer.
struct RowPoints {
  EightFloats fields[LayerPoints::kFields];
  unsigned found;   ///< bits of those whose cubes the layer crosses
  unsigned inside;  ///< bits of those on that side of the surface
};

/// The slopes of |phi| at a row's nodes along each axis, in voxels per voxel.
struct RowSlopes {
  float below[3][kRowNodes];       ///< from the node before
  float above[3][kRowNodes];       ///< to the node after
  float gradient[3][kRowNodes];    ///< of one side, next to a crease
  unsigned char sided[kRowNodes];  ///< bits of the axes that are creased, where that is so
};

ARGIL_ROWS void magnitudes(const EightFloats& of, EightFloats& out) { out = of < 0.0F ? -of : of; }

/// The bits of the axes along which |phi| falls off to both sides of a node.
ARGIL_ROWS unsigned creased_axes(const RowSlopes& slopes, int lane) {
  // How much a slope falls from one side to the other at a crease, at least.
  constexpr float kCreased = 0.25F;
  unsigned axes = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (slopes.below[axis][lane] - slopes.above[axis][lane] > kCreased) axes |= 1U << axis;
  }
  return axes;
}

/// Next to a crease, where the nearest point of the surface jumps, central differences mix the
/// slopes on both of its sides; there the gradient is that of one side: of all choices of one
/// difference along each creased axis the one whose length is nearest to 1. `least` is how far the
/// square of the mixed one is from that.
ARGIL_ROWS void take_one_side(RowSlopes& slopes, int lane, float least) {
  const unsigned creased = creased_axes(slopes, lane);
  if (creased == 0) return;
  const float mean[3] = {slopes.gradient[0][lane], slopes.gradient[1][lane],
                         slopes.gradient[2][lane]};
  for (unsigned choice = 0; choice < 8; ++choice) {
    if ((choice & ~creased) != 0) continue;
    float gradient[3];
    float square = 0.0F;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const float one_sided =
          (choice >> axis & 1U) != 0 ? slopes.above[axis][lane] : slopes.below[axis][lane];
      gradient[axis] = (creased >> axis & 1U) != 0 ? one_sided : mean[axis];
      square += gradient[axis] * gradient[axis];
    }
    if (!(magnitude(1.0F - square) < least)) continue;
    least = magnitude(1.0F - square);
    for (int axis = 0; axis < 3; ++axis) slopes.gradient[axis][lane] = gradient[axis];
    slopes.sided[lane] = static_cast<unsigned char>(creased);
  }
}

/// Of a row's nodes, the first `at`; `steep` is what a difference of their values is in voxels,
/// away from the surface. Of the lanes that are not asked for, no more than the central gradients.
ARGIL_ROWS void find_slopes(const float* at, const EightFloats& value, const EightFloats& steep,
                            float band, unsigned asked, RowSlopes& slopes) {
  // Gradients above its square are no mixture of the two sides of a crease.
  constexpr float kMixedSquare = 0.9F;
  EightFloats square = {};
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats before;
    EightFloats after;
    load_eight(at - kFacesStride[axis], before);
    load_eight(at + kFacesStride[axis], after);
    // Beyond the band values are cut short, and beyond what is stored not known: straight on.
    const EightInts knows_before = (before < band) & (before > -band);
    const EightInts knows_after = (after < band) & (after > -band);
    const EightFloats below = steep * (value - before);
    const EightFloats above = steep * (after - value);
    const EightFloats none = {};
    const EightFloats known_below = knows_before ? below : (knows_after ? above : none);
    const EightFloats known_above = knows_after ? above : (knows_before ? below : none);
    const EightFloats gradient = 0.5F * (known_below + known_above);
    square += gradient * gradient;
    __builtin_memcpy(slopes.below[axis], &known_below, sizeof known_below);
    __builtin_memcpy(slopes.above[axis], &known_above, sizeof known_above);
    __builtin_memcpy(slopes.gradient[axis], &gradient, sizeof gradient);
  }
  __builtin_memset(slopes.sided, 0, sizeof slopes.sided);
  unsigned bits = asked & lane_bits(square <= kMixedSquare);
  float squares[kRowNodes];
  __builtin_memcpy(squares, &square, sizeof squares);
  while (bits != 0) {
    const int lane = __builtin_ctz(bits);
    bits &= bits - 1;
    take_one_side(slopes, lane, magnitude(1.0F - squares[lane]));
  }
}

/// What the greatest curvature of a layer is above the mean one, by voxel, as far as second
/// differences along the axes tell it: theirs is that of mean curvature and of a difference of both
/// curvatures, turned about the normal; a turn that no axis sees counts for nothing. Where the
/// layer bends around an edge, the rays of its points part across the edge: nodes above them lie
/// off the nearest ray in that direction, and the mean would be too flat for all.
ARGIL_ROWS float edge_bend(const RowSlopes& slopes, int lane, const float* normal, float mean) {
  // Mean curvatures by voxel between which a layer becomes that of an edge, bent one way only.
  constexpr float kRounded = 0.1F;
  constexpr float kEdged = 0.25F;
  constexpr float kUnseen = 0.1F;  // keeps apart what is told from what is not
  if (mean <= kRounded) return 0.0F;
  int least = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (magnitude(normal[axis]) < magnitude(normal[least])) least = axis;
  }
  float a[3];  // a and b span the tangents
  const float scale = 1.0F / __builtin_sqrtf(1.0F - normal[least] * normal[least]);
  for (int axis = 0; axis < 3; ++axis) {
    a[axis] = scale * ((axis == least ? 1.0F : 0.0F) - normal[least] * normal[axis]);
  }
  float uu = kUnseen;
  float uv = 0.0F;
  float vv = kUnseen;
  float ud = 0.0F;
  float vd = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    const float b = normal[next] * a[last] - normal[last] * a[next];
    const float u = a[axis] * a[axis] - b * b;
    const float v = 2.0F * a[axis] * b;
    const float off = slopes.above[axis][lane] - slopes.below[axis][lane] -
                      mean * (1.0F - normal[axis] * normal[axis]);
    uu += u * u;
    uv += u * v;
    vv += v * v;
    ud += u * off;
    vd += v * off;
  }
  const float inverse = 1.0F / (uu * vv - uv * uv);
  const float p = inverse * (vv * ud - uv * vd);
  const float q = inverse * (uu * vd - uv * ud);
  const float share = lesser((mean - kRounded) / (kEdged - kRounded), 1.0F);
  return share * lesser(__builtin_sqrtf(p * p + q * q), mean);
}

/// The mean curvatures by voxel, bent around edges, of a row's points.
ARGIL_ROWS void bends_of(const RowSlopes& slopes, const EightFloats* normals,
                         const EightFloats& means, unsigned found, EightFloats& out) {
  // The tightest bend that a level can hold, by voxel: of a layer around an edge.
  constexpr float kTightest = 0.57F;
  float normal[3][kRowNodes];
  float bends[kRowNodes];
  __builtin_memcpy(normal, normals, sizeof normal);
  __builtin_memcpy(bends, &means, sizeof bends);
  while (found != 0) {
    const int lane = __builtin_ctz(found);
    found &= found - 1;
    const float of_lane[3] = {normal[0][lane], normal[1][lane], normal[2][lane]};
    bends[lane] += edge_bend(slopes, lane, of_lane, bends[lane]);
    bends[lane] = lesser(greater(bends[lane], -kTightest), kTightest);
  }
  load_eight(bends, out);
}

/// Of a row's nodes, the first `at`, whose leaf begins `from` nodes before it.
ARGIL_ROWS void project_row(const float* at, const int* from, const LayerRule& rule,
                            RowPoints& out) {
  // No layer crosses the cube of a node that is farther from it, in voxels: half a diagonal.
  constexpr float kFarthest = 0.87F;
  // A gradient below its square is that of a medial sheet.
  constexpr float kLeastSquare = 0.25F;
  const EightFloats none = {};
  EightFloats value;
  EightFloats size;
  EightFloats missed;
  load_eight(at, value);
  magnitudes(value, size);
  const EightFloats miss = size - rule.layer * rule.voxel;
  magnitudes(miss, missed);
  out.inside = lane_bits(value < 0.0F);
  const unsigned wanted =
      (rule.is_wanted[0] ? ~out.inside : 0U) | (rule.is_wanted[1] ? out.inside : 0U);
  out.found = lane_bits(missed < kFarthest * rule.voxel) & wanted;
  if (out.found == 0) return;
  const float inverse = 1.0F / rule.voxel;
  const EightFloats steep = value < 0.0F ? none - inverse : none + inverse;
  RowSlopes slopes;
  find_slopes(at, value, steep, rule.band, out.found, slopes);
  EightFloats gradient[3];
  EightFloats square = none;
  EightFloats reach = none;
  EightFloats sum = none;
  for (int axis = 0; axis < 3; ++axis) {
    load_eight(slopes.gradient[axis], gradient[axis]);
    square += gradient[axis] * gradient[axis];
    EightFloats length;
    magnitudes(gradient[axis], length);
    reach += length;
    float bent[kRowNodes];
    for (int lane = 0; lane < kRowNodes; ++lane) {
      // A crease is no bend of the layer beside it.
      const bool is_sided = (slopes.sided[lane] >> axis & 1) != 0;
      bent[lane] = is_sided ? 0.0F : slopes.above[axis][lane] - slopes.below[axis][lane];
    }
    EightFloats bends;
    load_eight(bent, bends);
    sum += bends;
  }
  out.found &= lane_bits((square >= kLeastSquare) & (missed <= (0.5F * rule.voxel) * reach));
  if (out.found == 0) return;
  const EightFloats back = (miss - rule.averaged * (inverse * sum)) / square;
  EightFloats steepness;
  roots(square, steepness);
  const EightFloats upward = 1.0F / steepness;
  const EightFloats along = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int axis = 0; axis < 3; ++axis) {
    const EightFloats node = axis == 2 ? along : none + static_cast<float>(from[axis]);
    out.fields[axis] = node * rule.voxel - back * gradient[axis];
    out.fields[3 + axis] = upward * gradient[axis];
  }
  EightFloats bends;
  bends_of(slopes, out.fields + 3, 0.5F * sum, out.found, bends);
  out.fields[6] = inverse * bends;
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
