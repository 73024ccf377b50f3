// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of WindowTiles. Included by rows_impl.h.

using EightFloats = float __attribute__((vector_size(32)));
using EightInts = int __attribute__((vector_size(32)));

ARGIL_ROWS void load_eight(const float* from, EightFloats& out) {
  __builtin_memcpy(&out, from, sizeof out);
}

/// One bit for each lane whose sign bit is set.
ARGIL_ROWS unsigned lane_bits(const EightInts& lanes) {
#if defined(__AVX2__)
  return static_cast<unsigned>(
      __builtin_ia32_movmskps256(reinterpret_cast<const EightFloats&>(lanes)));
#else
  unsigned bits = 0;
  for (int lane = 0; lane < kRowNodes; ++lane) {
    bits |= (static_cast<unsigned>(lanes[lane]) >> 31) << lane;
  }
  return bits;
#endif
}

/// Squares of the distances of eight feet from a point.
ARGIL_ROWS void squares_from(const LayerJob& job, int first, const float* point, EightFloats& out) {
  EightFloats x;
  EightFloats y;
  EightFloats z;
  load_eight(job.foot[0] + first, x);
  load_eight(job.foot[1] + first, y);
  load_eight(job.foot[2] + first, z);
  x -= point[0];
  y -= point[1];
  z -= point[2];
  out = x * x + y * y + z * z;
}

/// A foot nearest to a point, and the square of its distance.
ARGIL_ROWS int nearest_foot(const LayerJob& job, const float* point, float& square) {
  constexpr float kFar = 1e37F;
  EightFloats best = EightFloats{} + kFar;
  EightInts which = {};
  EightInts index = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int n = 0; n < job.count; n += kRowNodes) {
    EightFloats squares;
    squares_from(job, n, point, squares);
    const EightInts is_nearer = squares < best;
    best = is_nearer ? squares : best;
    which = is_nearer ? index : which;
    index += kRowNodes;
  }
  int found = which[0];
  square = best[0];
  for (int lane = 1; lane < kRowNodes; ++lane) {
    found = best[lane] < square ? which[lane] : found;
    square = lesser(best[lane], square);
  }
  return found;
}

/// Keeps the feet that some point of the block may be nearest to: those on its side of the plane
/// between them and the foot nearest to its centre, where nothing farther from the centre than
/// `most` is. Bounds are wide enough for the rounding of all. Returns how many.
ARGIL_ROWS int keep_candidates(const LayerJob& job, const float* center, float half, float most) {
  constexpr float kRounding = 4e-6F;
  float square;
  const int pivot = nearest_foot(job, center, square);
  if (square > most * most * (1.0F + kRounding)) return 0;
  int kept = 0;
  for (int n = 0; n < job.count; n += kRowNodes) {
    EightFloats squares;
    squares_from(job, n, center, squares);
    EightFloats across = {};
    for (int axis = 0; axis < 3; ++axis) {
      EightFloats off;
      load_eight(job.foot[axis] + n, off);
      off -= job.foot[axis][pivot];
      across += off < 0.0F ? -off : off;
    }
    const EightInts is_candidate =
        (squares - square <= (2.0F * half) * across + kRounding * squares) &
        (squares <= most * most * (1.0F + kRounding));
    unsigned bits = lane_bits(is_candidate);
    while (bits != 0) {
      const int from = n + __builtin_ctz(bits);
      bits &= bits - 1;
      for (int axis = 0; axis < 3; ++axis) job.kept[axis][kept] = job.foot[axis][from];
      job.which[kept++] = from;
    }
  }
  return kept;
}

/// The nearest of the kept feet for 32 nodes, two planes of the block.
ARGIL_ROWS void nearest_of_kept(const LayerJob& job, int kept, int plane, EightFloats* squares,
                                EightInts* which) {
  constexpr float kFar = 1e37F;
  const EightFloats across = {0, 0, 0, 0, 1, 1, 1, 1};
  const EightFloats along = {0, 1, 2, 3, 0, 1, 2, 3};
  const EightFloats y = job.first[1] + job.step * across;
  const EightFloats z = job.first[2] + job.step * along;
  const float two = 2.0F * job.step;
  const float x[2] = {job.first[0] + static_cast<float>(plane) * job.step,
                      job.first[0] + static_cast<float>(plane + 1) * job.step};
  for (int n = 0; n < 4; ++n) {
    squares[n] = EightFloats{} + kFar;
    which[n] = EightInts{};
  }
  for (int n = 0; n < kept; ++n) {
    const EightFloats off_z = z - job.kept[2][n];
    const EightFloats off_low = y - job.kept[1][n];
    const EightFloats off_high = off_low + two;
    const EightFloats square_z = off_z * off_z;
    const EightFloats beside[2] = {off_low * off_low + square_z, off_high * off_high + square_z};
    for (int i = 0; i < 2; ++i) {
      const float off_x = x[i] - job.kept[0][n];
      for (int j = 0; j < 2; ++j) {
        const EightFloats square = beside[j] + off_x * off_x;
        const EightInts is_nearer = square < squares[2 * i + j];
        squares[2 * i + j] = is_nearer ? square : squares[2 * i + j];
        which[2 * i + j] = is_nearer ? EightInts{} + job.which[n] : which[2 * i + j];
      }
    }
  }
}

/// Square roots, lane by lane, of 0 where less.
ARGIL_ROWS void roots(const EightFloats& squares, EightFloats& out) {
  const EightFloats positive = squares > 0.0F ? squares : EightFloats{};
#if defined(__AVX2__)
  out = __builtin_ia32_sqrtps256(positive);
#else
  for (int lane = 0; lane < kRowNodes; ++lane) out[lane] = __builtin_sqrtf(positive[lane]);
#endif
}

/// What eight nodes take from one of a job's arrays.
ARGIL_ROWS void gather_eight(const float* from, const EightInts& which, EightFloats& out) {
  float lanes[kRowNodes];
  for (int lane = 0; lane < kRowNodes; ++lane) lanes[lane] = from[which[lane]];
  load_eight(lanes, out);
}

/// The patches around the feet of eight nodes.
struct Patches {
  EightFloats height;  ///< of the nodes above the layer's tangents
  EightFloats bend;
};

ARGIL_ROWS void patches_of(const LayerJob& job, const EightFloats* nodes, const EightInts& which,
                           Patches& out) {
  EightFloats height = {};
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats foot;
    EightFloats normal;
    gather_eight(job.foot[axis], which, foot);
    gather_eight(job.normal[axis], which, normal);
    height += (nodes[axis] - foot) * normal;
  }
  out.height = height;
  gather_eight(job.bend, which, out.bend);
}

/// How far nodes are from the surface by the bent patches around their feet. Where the patch holds
/// the nearest point that is the distance from a ball which touches it, written without the loss of
/// digits where the ball is large; else the distance from the patch's rim. How far the nearest
/// point is from the foot is told on the layer: seen from a node above a ridge all of it is within
/// reach.
ARGIL_ROWS void distances_by(const LayerJob& job, const Patches& patches,
                             const EightFloats& squares, EightFloats& out) {
  const EightFloats none = {};
  const EightFloats& height = patches.height;
  const EightFloats& bend = patches.bend;
  const EightFloats aside2 = squares - height * height > 0.0F ? squares - height * height : none;
  const EightFloats bent = 2.0F * height + bend * (height * height + aside2);
  EightFloats root;  // from the ball's centre, by its radius
  roots(1.0F + bend * bent, root);
  const EightFloats ball = bent / (1.0F + root);
  const float patch = job.patch;
  const EightInts is_held =
      (aside2 <= patch * patch * (root * root)) & (1.0F + bend * height > 0.0F);
  EightFloats aside;
  roots(aside2, aside);
  const EightFloats over = aside - patch;
  const EightFloats fallen = height + 0.5F * patch * patch * bend;
  EightFloats rim;
  roots(fallen * fallen + over * over, rim);
  const EightFloats found = is_held ? ball : (fallen < 0.0F ? fallen : rim);
  out = job.layer + found;
}

/// As lower_to_layer, for eight nodes in two rows.
ARGIL_ROWS void lower_eight(const LayerJob& job, int first, const EightFloats& squares,
                            const EightInts& which, float* bound, float* distance) {
  EightFloats way;
  roots(squares, way);
  way += job.layer;
  EightFloats known;
  load_eight(bound + first, known);
  const EightInts is_shorter = way < known;
  if (lane_bits(is_shorter) == 0) return;
  const EightFloats across = {0, 0, 0, 0, 1, 1, 1, 1};
  const EightFloats along = {0, 1, 2, 3, 0, 1, 2, 3};
  const float row = static_cast<float>(first >> 2 & 3);
  const EightFloats nodes[3] = {
      EightFloats{} + (job.first[0] + static_cast<float>(first >> 4) * job.step),
      job.first[1] + job.step * (row + across), job.first[2] + job.step * along};
  Patches patches;
  patches_of(job, nodes, which, patches);
  EightFloats found;
  distances_by(job, patches, squares, found);
  EightFloats former;
  load_eight(distance + first, former);
  known = is_shorter ? way : known;
  former = is_shorter ? found : former;
  __builtin_memcpy(bound + first, &known, sizeof known);
  __builtin_memcpy(distance + first, &former, sizeof former);
}

void lower_to_layer(const LayerJob& job, float* bound, float* distance) noexcept {
  constexpr float kDiagonal = 1.7320509F;
  const float half = 0.5F * static_cast<float>(LayerJob::kSide - 1) * job.step;
  const float center[3] = {job.first[0] + half, job.first[1] + half, job.first[2] + half};
  float most = 0.0F;
  for (int n = 0; n < LayerJob::kNodes; ++n) most = greater(most, bound[n]);
  if (most <= job.layer) return;
  const int kept = keep_candidates(job, center, half, most - job.layer + kDiagonal * half);
  if (kept == 0) return;
  for (int plane = 0; plane < LayerJob::kSide; plane += 2) {
    EightFloats squares[4];
    EightInts which[4];
    nearest_of_kept(job, kept, plane, squares, which);
    for (int part = 0; part < 4; ++part) {
      lower_eight(job, 16 * plane + kRowNodes * part, squares[part], which[part], bound, distance);
    }
  }
}
