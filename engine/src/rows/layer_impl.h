// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of WindowTiles and MovedLevel. Included by rows_impl.h.

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

#if defined(__AVX2__)
/// For eight bits the lanes of those that are set, in order, and then any.
struct LaneOrders {
  unsigned char lane[256][kRowNodes];
  constexpr LaneOrders() : lane() {
    for (unsigned bits = 0; bits < 256; ++bits) {
      unsigned count = 0;
      for (unsigned n = 0; n < kRowNodes; ++n) {
        if ((bits >> n & 1U) != 0) lane[bits][count++] = static_cast<unsigned char>(n);
      }
    }
  }
};
constexpr LaneOrders kLaneOrders;

ARGIL_ROWS void order_of(unsigned bits, EightInts& out) {
  using EightBytes = unsigned char __attribute__((vector_size(8)));
  EightBytes order;
  __builtin_memcpy(&order, kLaneOrders.lane[bits], sizeof order);
  out = __builtin_convertvector(order, EightInts);
}
#endif

/// Writes the lanes whose bits are set one after the other; up to eight numbers at `to` change.
ARGIL_ROWS void put_lanes(const EightFloats& lanes, unsigned bits, float* to) {
#if defined(__AVX2__)
  EightInts order;
  order_of(bits, order);
  const EightFloats packed = __builtin_ia32_permvarsf256(lanes, order);
  __builtin_memcpy(to, &packed, sizeof packed);
#else
  float all[kRowNodes];
  __builtin_memcpy(all, &lanes, sizeof all);
  for (; bits != 0; bits &= bits - 1) *to++ = all[__builtin_ctz(bits)];
#endif
}

/// Writes the numbers of those lanes, the first of which is `first`.
ARGIL_ROWS void put_numbers(int first, unsigned bits, int* to) {
#if defined(__AVX2__)
  EightInts order;
  order_of(bits, order);
  order += first;
  __builtin_memcpy(to, &order, sizeof order);
#else
  for (; bits != 0; bits &= bits - 1) *to++ = first + __builtin_ctz(bits);
#endif
}

/// A foot's number in a job, from those of its cluster and in it.
ARGIL_ROWS int number_of(int cluster, int n) { return cluster * LayerPoints::kMost + n; }

/// The places of eight feet along an axis, the first `n`.
ARGIL_ROWS void places_of(const LayerCluster& cluster, int axis, int n, EightFloats& out) {
  load_eight(cluster.values + axis * cluster.stride + n, out);
  out += cluster.offset[axis];
}

/// Squares of the distances of eight feet from a point.
ARGIL_ROWS void squares_from(const LayerCluster& cluster, int n, const float* point,
                             EightFloats& out) {
  EightFloats x;
  EightFloats y;
  EightFloats z;
  places_of(cluster, 0, n, x);
  places_of(cluster, 1, n, y);
  places_of(cluster, 2, n, z);
  x -= point[0];
  y -= point[1];
  z -= point[2];
  out = x * x + y * y + z * z;
}

/// What `which` has in the lane of the least of some squares, where that is below `square`, which
/// it then becomes; or else `found`.
ARGIL_ROWS int least_lane(const EightFloats& squares, const EightInts& which, int found,
                          float& square) {
  for (int lane = 0; lane < kRowNodes; ++lane) {
    found = squares[lane] < square ? which[lane] : found;
    square = lesser(squares[lane], square);
  }
  return found;
}

/// The block of a job as a cube around its centre.
struct BlockCube {
  float center[3];
  float half;
};

/// For each cluster the square of how near its points may be to the block's centre. Returns the one
/// of which some point is certainly the nearest that far, negative when none is certain.
ARGIL_ROWS int measure_nearness(const LayerJob& job, const float* center) {
  constexpr float kInfinity = __builtin_inff();
  EightFloats best = EightFloats{} + kInfinity;
  EightInts which = EightInts{} - 1;
  EightInts index = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int n = 0; n < job.clusters; n += kRowNodes) {
    EightFloats farthest;
    load_eight(job.unsure + n, farthest);
    EightFloats nearest = {};
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      EightFloats below;
      EightFloats above;
      load_eight(job.low[axis] + n, below);
      load_eight(job.high[axis] + n, above);
      below -= center[axis];
      above -= center[axis];
      EightFloats off = below < -above ? -above : below;
      off = off < 0.0F ? EightFloats{} : off;
      nearest += off * off;
      const EightFloats most = -below < above ? above : -below;
      farthest += most * most;
    }
    __builtin_memcpy(job.nearness + n, &nearest, sizeof nearest);
    const EightInts is_nearer = farthest < best;
    best = is_nearer ? farthest : best;
    which = is_nearer ? index : which;
    index += kRowNodes;
  }
  float square = kInfinity;
  return least_lane(best, which, -1, square);
}

/// A foot of a cluster nearer to a point than `square`, or else `found`.
ARGIL_ROWS int nearest_in(const LayerJob& job, int cluster, const float* point, int found,
                          float& square) {
  EightFloats best = EightFloats{} + square;
  EightInts which = EightInts{} + found;
  EightInts index = EightInts{0, 1, 2, 3, 4, 5, 6, 7} + number_of(cluster, 0);
  const LayerCluster& of = job.cluster[cluster];
  for (int n = 0; n < of.count; n += kRowNodes) {
    EightFloats squares;
    squares_from(of, n, point, squares);
    const EightInts is_nearer = squares < best;
    best = is_nearer ? squares : best;
    which = is_nearer ? index : which;
    index += kRowNodes;
  }
  return least_lane(best, which, found, square);
}

/// A foot nearest to the block's centre, and the square of its distance; negative when there is
/// none within reach. Of clusters that measure_nearness() has measured.
ARGIL_ROWS int nearest_foot(const LayerJob& job, int likely, const float* center, float& square) {
  int found = -1;
  if (likely >= 0) found = nearest_in(job, likely, center, found, square);
  for (int n = 0; n < job.clusters; n += kRowNodes) {
    EightFloats nearness;
    load_eight(job.nearness + n, nearness);
    unsigned bits = lane_bits(nearness < square);
    while (bits != 0) {
      const int cluster = n + __builtin_ctz(bits);
      bits &= bits - 1;
      if (cluster != likely) found = nearest_in(job, cluster, center, found, square);
    }
  }
  return found;
}

/// As LayerJob::enough has it.
constexpr int kEnough = -1;
/// Half a cube's diagonal, by half its side.
constexpr float kDiagonal = 1.7320509F;
/// What rounding may do to sums of squares, by their terms.
constexpr float kRoundedSquares = 4e-6F;

/// Bits of eight clusters, the first `n`, in which some point may be nearer to a node of the block
/// than `pivot`, a point `square` from its centre. Along each axis the difference of the squares is
/// least where a point lies half a side from the centre.
ARGIL_ROWS unsigned candidate_clusters(const LayerJob& job, int n, const BlockCube& block,
                                       const float* pivot, float square) {
  EightFloats least = {};
  EightFloats terms = {};
  const float side = 2.0F * block.half;
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats low;
    EightFloats high;
    load_eight(job.low[axis] + n, low);
    load_eight(job.high[axis] + n, high);
    const float center = block.center[axis];
    EightFloats upper = EightFloats{} + (center + block.half);
    upper = upper < low ? low : upper;
    upper = high < upper ? high : upper;
    EightFloats lower = EightFloats{} + (center - block.half);
    lower = lower < low ? low : lower;
    lower = high < lower ? high : lower;
    const EightFloats upper_square = (upper - center) * (upper - center);
    const EightFloats lower_square = (lower - center) * (lower - center);
    const EightFloats upper_across = side * (upper - pivot[axis]);
    const EightFloats lower_across = side * (pivot[axis] - lower);
    const EightFloats of_upper = upper_square - upper_across;
    const EightFloats of_lower = lower_square - lower_across;
    least += of_upper < of_lower ? of_upper : of_lower;
    terms += upper_square + lower_square + (upper_across < 0.0F ? -upper_across : upper_across) +
             (lower_across < 0.0F ? -lower_across : lower_across);
  }
  return lane_bits(least - square <= kRoundedSquares * (terms + square));
}

/// Keeps those of eight feet of a cluster, the first `n`, that candidate_clusters() means. No more
/// were kept than looked at, so that what is written beyond them has room.
ARGIL_ROWS int keep_of_eight(const LayerJob& job, int cluster, int n, const BlockCube& block,
                             const float* pivot, float square, float most, int kept) {
  EightFloats places[3];
  EightFloats squares = {};
  EightFloats across = {};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    places_of(job.cluster[cluster], axis, n, places[axis]);
    const EightFloats from_center = places[axis] - block.center[axis];
    squares += from_center * from_center;
    const EightFloats off = places[axis] - pivot[axis];
    across += off < 0.0F ? -off : off;
  }
  const EightInts is_candidate =
      (squares - square <= (2.0F * block.half) * across + kRoundedSquares * squares) &
      (squares <= most * most * (1.0F + kRoundedSquares));
  const unsigned bits = lane_bits(is_candidate);
  if (bits == 0) return kept;
  for (int axis = 0; axis < 3; ++axis) put_lanes(places[axis], bits, job.kept[axis] + kept);
  put_numbers(number_of(cluster, n), bits, job.which + kept);
  return kept + __builtin_popcount(bits);
}

/// Keeps the feet that some point of the block may be nearest to: those on its side of the plane
/// between them and the foot nearest to its centre, where nothing farther from the centre than
/// `most` is. Bounds are wide enough for the rounding of all. Returns how many, or kEnough.
ARGIL_ROWS int keep_candidates(const LayerJob& job, const BlockCube& block, float most) {
  const int likely = measure_nearness(job, block.center);
  float square = most * most * (1.0F + kRoundedSquares);
  const int nearest = nearest_foot(job, likely, block.center, square);
  if (nearest < 0) return 0;
  const float spare = job.enough - job.layer - kDiagonal * block.half;
  if (spare > 0.0F && square < spare * spare) return kEnough;
  const LayerCluster& of = job.cluster[nearest / LayerPoints::kMost];
  float pivot[3];
  for (int axis = 0; axis < 3; ++axis) {
    pivot[axis] = of.values[axis * of.stride + nearest % LayerPoints::kMost] + of.offset[axis];
  }
  int kept = 0;
  for (int n = 0; n < job.clusters; n += kRowNodes) {
    unsigned bits = candidate_clusters(job, n, block, pivot, square);
    while (bits != 0) {
      const int cluster = n + __builtin_ctz(bits);
      bits &= bits - 1;
      for (int foot = 0; foot < job.cluster[cluster].count; foot += kRowNodes) {
        kept = keep_of_eight(job, cluster, foot, block, pivot, square, most, kept);
      }
    }
  }
  return kept;
}

/// Fills the last eight of the kept feet up.
ARGIL_ROWS void fill_kept(const LayerJob& job, int kept) {
  constexpr float kNowhere = 1e15F;
  for (int n = kept; n % kRowNodes != 0; ++n) {
    for (int axis = 0; axis < 3; ++axis) job.kept[axis][n] = kNowhere;
  }
}

ARGIL_ROWS void squares_of_kept(const LayerJob& job, int n, const float* point, EightFloats& out) {
  out = EightFloats{};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats off;
    load_eight(job.kept[axis] + n, off);
    off -= point[axis];
    out += off * off;
  }
}

/// As keep_candidates, of the kept feet for two planes of the block: their indices in order.
/// Returns how many.
ARGIL_ROWS int choose_for_planes(const LayerJob& job, int kept, const float* center,
                                 const float* half) {
  constexpr float kFar = 1e37F;
  EightFloats best = EightFloats{} + kFar;
  EightInts which = {};
  EightInts index = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int n = 0; n < kept; n += kRowNodes) {
    EightFloats squares;
    squares_of_kept(job, n, center, squares);
    const EightInts is_nearer = squares < best;
    best = is_nearer ? squares : best;
    which = is_nearer ? index : which;
    index += kRowNodes;
  }
  float square = kFar;
  const int pivot = least_lane(best, which, 0, square);
  int chosen = 0;
  for (int n = 0; n < kept; n += kRowNodes) {
    EightFloats squares;
    squares_of_kept(job, n, center, squares);
    EightFloats across = {};
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      EightFloats off;
      load_eight(job.kept[axis] + n, off);
      off -= job.kept[axis][pivot];
      across += (2.0F * half[axis]) * (off < 0.0F ? -off : off);
    }
    const unsigned bits = lane_bits(squares - square <= across + kRoundedSquares * squares);
    put_numbers(n, bits, job.chosen + chosen);
    chosen += __builtin_popcount(bits);
  }
  return chosen;
}

/// The nearest of the chosen feet for 32 nodes, two planes of the block.
ARGIL_ROWS void nearest_of_chosen(const LayerJob& job, int chosen, int plane, EightFloats* squares,
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
  for (int at = 0; at < chosen; ++at) {
    const int n = job.chosen[at];
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

/// The patches around the feet of eight nodes.
struct Patches {
  EightFloats height;  ///< of the nodes above the layer's tangents
  EightFloats bend;
};

ARGIL_ROWS void patches_of(const LayerJob& job, const EightFloats* nodes, const EightInts& which,
                           Patches& out) {
  float lanes[LayerPoints::kFields][kRowNodes];
  for (int lane = 0; lane < kRowNodes; ++lane) {
    const LayerCluster& cluster = job.cluster[which[lane] / LayerPoints::kMost];
    *job.labels |= cluster.label;
    const float* from = cluster.values + which[lane] % LayerPoints::kMost;
    for (int axis = 0; axis < 3; ++axis) {
      lanes[axis][lane] = from[axis * cluster.stride] + cluster.offset[axis];
    }
    for (int field = 3; field < LayerPoints::kFields; ++field) {
      lanes[field][lane] = from[field * cluster.stride];
    }
  }
  EightFloats height = {};
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats foot;
    EightFloats normal;
    load_eight(lanes[axis], foot);
    load_eight(lanes[3 + axis], normal);
    height += (nodes[axis] - foot) * normal;
  }
  out.height = height;
  load_eight(lanes[6], out.bend);
}

/// What bent patches around feet tell eight nodes.
struct PatchTold {
  EightFloats ball;    ///< from a ball that touches the patch
  EightFloats fallen;  ///< above the patch's rim
  EightFloats over;    ///< beyond it, along the tangent
  EightInts is_held;   ///< the patch holds the nearest point: the ball counts
};

ARGIL_ROWS void ask_patches(const LayerJob& job, const Patches& patches, const EightFloats& squares,
                            PatchTold& told) {
  const EightFloats none = {};
  const EightFloats& height = patches.height;
  const EightFloats& bend = patches.bend;
  const EightFloats aside2 = squares - height * height > 0.0F ? squares - height * height : none;
  const EightFloats bent = 2.0F * height + bend * (height * height + aside2);
  EightFloats root;  // from the ball's centre, by its radius
  roots(1.0F + bend * bent, root);
  told.ball = bent / (1.0F + root);
  const float patch = job.patch;
  told.is_held = (aside2 <= patch * patch * (root * root)) & (1.0F + bend * height > 0.0F);
  EightFloats aside;
  roots(aside2, aside);
  told.over = aside - patch;
  told.fallen = height + 0.5F * patch * patch * bend;
}

/// How far nodes are from the surface by the bent patches around their feet. Where the patch holds
/// the nearest point that is the distance from a ball which touches it, written without the loss of
/// digits where the ball is large; else the distance from the patch's rim. How far the nearest
/// point is from the foot is told on the layer: seen from a node above a ridge all of it is within
/// reach.
ARGIL_ROWS void distances_by(const LayerJob& job, const PatchTold& told, EightFloats& out) {
  EightFloats rim;
  roots(told.fallen * told.fallen + told.over * told.over, rim);
  const EightFloats beyond = told.fallen < 0.0F ? told.fallen : rim;
  out = job.layer + (told.is_held ? told.ball : beyond);
}

/// The same where the patch lies on the surface, below the foot: smaller than that on the layer
/// where the clay bulges, all of it one point where the layer bends around a sharp edge. `way`
/// leads to the point there; where the patch holds the nearest point it is what the patch tells. A
/// patch that looks the other way, as on the far side of a thin part, holds none: seen from behind,
/// its rim is the nearest.
ARGIL_ROWS void surface_distances_by(const LayerJob& job, const Patches& patches,
                                     const EightFloats& squares, const PatchTold& told,
                                     EightFloats& way, EightFloats& out) {
  const EightFloats shrunk = 1.0F - patches.bend * job.layer;
  const EightFloats size = job.patch * (shrunk > 0.0F ? shrunk : EightFloats{});
  const EightFloats above = patches.height + job.layer + 0.5F * job.patch * size * patches.bend;
  const EightFloats over = told.over + job.patch - size;
  const EightFloats ball = told.ball + job.layer;
  roots(above * above + over * over, out);
  roots(squares + job.layer * (2.0F * patches.height + job.layer), way);
  const EightInts is_held = told.is_held & (ball >= 0.0F);
  out = is_held ? ball : out;
  way = is_held ? ball : way;
}

/// The places of eight nodes of the block, the first `first`, in two rows.
ARGIL_ROWS void places_in_block(const LayerJob& job, int first, EightFloats* nodes) {
  const EightFloats across = {0, 0, 0, 0, 1, 1, 1, 1};
  const EightFloats along = {0, 1, 2, 3, 0, 1, 2, 3};
  const float row = static_cast<float>(first >> 2 & 3);
  nodes[0] = EightFloats{} + (job.first[0] + static_cast<float>(first >> 4) * job.step);
  nodes[1] = job.first[1] + job.step * (row + across);
  nodes[2] = job.first[2] + job.step * along;
}

/// As lower_to_layer, for eight nodes in two rows.
ARGIL_ROWS void lower_eight(const LayerJob& job, int first, const EightFloats& squares,
                            const EightInts& which, float* bound, float* distance) {
  EightFloats known;
  load_eight(bound + first, known);
  EightFloats way;
  roots(squares, way);
  way += job.layer;
  if (!job.by_surface && lane_bits(way < known) == 0) return;
  EightFloats nodes[3];
  places_in_block(job, first, nodes);
  Patches patches;
  patches_of(job, nodes, which, patches);
  PatchTold told;
  ask_patches(job, patches, squares, told);
  EightFloats found;
  if (job.by_surface) {
    surface_distances_by(job, patches, squares, told, way, found);
  } else {
    distances_by(job, told, found);
  }
  const EightInts is_shorter = way < known;
  if (lane_bits(is_shorter) == 0) return;
  EightFloats former;
  load_eight(distance + first, former);
  known = is_shorter ? way : known;
  former = is_shorter ? found : former;
  __builtin_memcpy(bound + first, &known, sizeof known);
  __builtin_memcpy(distance + first, &former, sizeof former);
}

void lower_to_layer(const LayerJob& job, float* bound, float* distance) noexcept {
  BlockCube block;
  block.half = 0.5F * static_cast<float>(LayerJob::kSide - 1) * job.step;
  for (int axis = 0; axis < 3; ++axis) block.center[axis] = job.first[axis] + block.half;
  float most = 0.0F;
  for (int n = 0; n < LayerJob::kNodes; ++n) most = greater(most, bound[n]);
  most += job.by_surface ? job.layer : -job.layer;
  if (most <= 0.0F) return;
  const int kept = keep_candidates(job, block, most + kDiagonal * block.half);
  if (kept == kEnough) {
    for (int n = 0; n < LayerJob::kNodes; ++n) bound[n] = distance[n] = 0.0F;
  }
  if (kept <= 0) return;
  fill_kept(job, kept);
  const float half[3] = {0.5F * job.step, block.half, block.half};
  for (int plane = 0; plane < LayerJob::kSide; plane += 2) {
    const float center[3] = {job.first[0] + (static_cast<float>(plane) + 0.5F) * job.step,
                             block.center[1], block.center[2]};
    const int chosen = choose_for_planes(job, kept, center, half);
    EightFloats squares[4];
    EightInts which[4];
    nearest_of_chosen(job, chosen, plane, squares, which);
    for (int part = 0; part < 4; ++part) {
      lower_eight(job, 16 * plane + kRowNodes * part, squares[part], which[part], bound, distance);
    }
  }
}
