// SPDX-License-Identifier: GPL-3.0-or-later
// Included once by each lattice_sums_SET.cpp, which defines ARGIL_LANES_SET, the namespace, and
// ARGIL_LANES_REGISTER, the bytes of a register. No standard header may be included: see
// lattice_sums.h.
//
// Notation: all lengths are in voxels of the window. Node (i, j, k) is r from the tool's centre
// along the window's axes, and q = axes r along the tool's. A row is all k of one (i, j); it is cut
// into blocks of eight nodes, and two blocks fill the sixteen lanes. Weight and slope are the
// kernel and its gradient at q, law and rate the tabulated law and its derivative at the stored
// distance. Even and odd lanes are kept apart as two lattices whose difference tells the error.
//
// No step may depend on the width of a register: sums are made lane by lane and added up at the end
// in one order, so that all instruction sets give the same bits.
#if ARGIL_LANES_REGISTER == 64
#include <immintrin.h>
#endif

#include "force/lattice_sums.h"

namespace argil::haptics::ARGIL_LANES_SET {
namespace {

constexpr int kRegister = ARGIL_LANES_REGISTER;
#include "force/lattice_lanes.h"

/// The kernel at sixteen nodes: weight, and its gradient in the tool's frame.
struct KernelLanes {
  Lanes weight;
  Lanes slope[3];
};

/// Eight nodes in a row; the sum runs over two of these at a time.
struct Block {
  int at;      ///< of lane 0 in the window's memory
  float q[3];  ///< of lane 0
  int low;     ///< lanes to visit, inclusive
  int high;
};
constexpr int kBlockNodes = kLanes / 2;

/// t^4 with t = 1 - (|q| / reach)^2.
struct BallKernel {
  Lanes inverse_square;

  explicit BallKernel(const LatticeJob& job)
      : inverse_square(spread(static_cast<float>(1.0 / (job.reach[0] * job.reach[0])))) {}
  __attribute__((always_inline)) KernelLanes at(const Lanes q[3], const Lanes& visited) const {
    KernelLanes k;
    const Lanes square = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) * inverse_square;
    const Lanes t = greater_of(spread(1.0F) - square, spread(0.0F)) * visited;
    const Lanes cube = t * t * t;
    k.weight = cube * t;
    const Lanes scale = cube * (inverse_square * spread(-8.0F));
    for (int a = 0; a < 3; ++a) k.slope[a] = scale * q[a];
    return k;
  }
  static constexpr bool kTurned = false;  ///< its frame is that of the nodes
};

/// t^4 with t = 1 - sum of (q / reach)^2.
struct EllipsoidKernel {
  Lanes inverse_square[3];

  explicit EllipsoidKernel(const LatticeJob& job) {
    for (int a = 0; a < 3; ++a) {
      inverse_square[a] = spread(static_cast<float>(1.0 / (job.reach[a] * job.reach[a])));
    }
  }
  __attribute__((always_inline)) KernelLanes at(const Lanes q[3], const Lanes& visited) const {
    KernelLanes k;
    Lanes scaled[3];
    for (int a = 0; a < 3; ++a) scaled[a] = q[a] * inverse_square[a];
    const Lanes square = q[0] * scaled[0] + q[1] * scaled[1] + q[2] * scaled[2];
    const Lanes t = greater_of(spread(1.0F) - square, spread(0.0F)) * visited;
    const Lanes cube = t * t * t;
    k.weight = cube * t;
    const Lanes scale = cube * spread(-8.0F);
    for (int a = 0; a < 3; ++a) k.slope[a] = scale * scaled[a];
    return k;
  }
  static constexpr bool kTurned = true;
};

/// The product over the axes of t^3 with t = 1 - (q / reach)^2.
struct BoxKernel {
  Lanes inverse_square[3];

  explicit BoxKernel(const LatticeJob& job) {
    for (int a = 0; a < 3; ++a) {
      inverse_square[a] = spread(static_cast<float>(1.0 / (job.reach[a] * job.reach[a])));
    }
  }
  __attribute__((always_inline)) KernelLanes at(const Lanes q[3], const Lanes& visited) const {
    KernelLanes k;
    Lanes square[3];
    Lanes t[3];
    for (int a = 0; a < 3; ++a) {
      t[a] = greater_of(spread(1.0F) - q[a] * q[a] * inverse_square[a], spread(0.0F));
      square[a] = t[a] * t[a];
    }
    t[0] = t[0] * visited;
    square[0] = square[0] * visited;
    const Lanes yz = square[1] * square[2];
    const Lanes common = square[0] * yz * spread(-6.0F);  // t^2 of all three
    const Lanes txy = t[0] * t[1];
    k.weight = square[0] * yz * txy * t[2];
    k.slope[0] = common * (t[1] * t[2]) * inverse_square[0] * q[0];
    k.slope[1] = common * (t[0] * t[2]) * inverse_square[1] * q[1];
    k.slope[2] = common * txy * inverse_square[2] * q[2];
    return k;
  }
  static constexpr bool kTurned = true;
};

/// t^4 with t = 1 - (distance to the axis / reach)^2.
struct CapsuleKernel {
  Lanes inverse_square;
  Lanes segment;

  explicit CapsuleKernel(const LatticeJob& job)
      : inverse_square(spread(static_cast<float>(1.0 / (job.reach[0] * job.reach[0])))),
        segment(spread(static_cast<float>(job.segment))) {}
  __attribute__((always_inline)) KernelLanes at(const Lanes q[3], const Lanes& visited) const {
    KernelLanes k;
    const Lanes along = q[2] - lesser_of(greater_of(q[2], spread(0.0F) - segment), segment);
    const Lanes square = (q[0] * q[0] + q[1] * q[1] + along * along) * inverse_square;
    const Lanes t = greater_of(spread(1.0F) - square, spread(0.0F)) * visited;
    const Lanes cube = t * t * t;
    k.weight = cube * t;
    const Lanes scale = cube * spread(-8.0F) * inverse_square;
    k.slope[0] = scale * q[0];
    k.slope[1] = scale * q[1];
    k.slope[2] = scale * along;
    return k;
  }
  static constexpr bool kTurned = true;
};

/// The law at sixteen distances and its derivative by the distance in voxels of the table.
struct LawLanes {
  Lanes value;
  Lanes rate;
};

template <bool kBlanch>
ARGIL_LANES LawLanes law_at(const LatticeJob& job, const Lanes& phi) {
  // Below the table its first segment, a straight line, goes on; above it the last one, zero.
  const Lanes x = (phi - spread(job.law_low)) * spread(job.law_per_mm);
  const Lanes inside = lesser_of(greater_of(x, spread(0.0F)), spread(kLawSegments - 1));
  const IntLanes segment = truncated(inside);
  const Lanes s = lesser_of(x - as_floats(segment), spread(1.0F));
  const Lanes c1 = look_up(job.law + 1 * kLawSegments, segment);
  const Lanes c2 = look_up(job.law + 2 * kLawSegments, segment);
  const Lanes c3 = look_up(job.law + 3 * kLawSegments, segment);
  LawLanes law;
  law.value = ((c3 * s + c2) * s + c1) * s + look_up(job.law, segment);
  if constexpr (kBlanch) {
    law.rate = (spread(3.0F) * c3 * s + spread(2.0F) * c2) * s + c1;
  } else {
    law.rate = spread(6.0F) * c3 * s + spread(2.0F) * c2;
  }
  return law;
}

/// At the ends of the window's memory: what lies beyond reads as 0.
struct EndBlock {
  float value[kBlockNodes];
};
__attribute__((noinline)) void copy_end(const LatticeJob& job, std::ptrdiff_t at, EndBlock& end) {
  for (int lane = 0; lane < kBlockNodes; ++lane) {
    const bool held = at + lane >= 0 && at + lane < job.count;
    end.value[lane] = held ? job.values[at + lane] : 0.0F;
  }
}
ARGIL_LANES const float* block_values(const LatticeJob& job, std::ptrdiff_t at, EndBlock& end) {
  if (__builtin_expect(at >= 0 && at + kBlockNodes <= job.count, 1)) return job.values + at;
  copy_end(job, at, end);
  return end.value;
}

/// Values of the window at two blocks, `shift` nodes further on in memory.
ARGIL_LANES Lanes window_values(const LatticeJob& job, const Block pair[2], std::ptrdiff_t shift) {
  EndBlock first;
  EndBlock second;
  return load_pair(block_values(job, pair[0].at + shift, first),
                   block_values(job, pair[1].at + shift, second));
}

/// 1 in the lanes a block visits, else 0.
ARGIL_LANES Lanes visited_lanes(const Block pair[2]) {
  constexpr float kStep[3 * kBlockNodes] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1,
                                            1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
  const float* middle = kStep + kBlockNodes;
  const Lanes from = load_pair(middle - pair[0].low, middle - pair[1].low);
  const Lanes to =
      load_pair(middle + kBlockNodes - 1 - pair[0].high, middle + kBlockNodes - 1 - pair[1].high);
  return from * to;
}

struct Accumulators {
  Lanes law;
  Lanes law_rate;
  Lanes force[3];
  Lanes torque[3];
  Lanes drag;
  Lanes drag_first[3];
  Lanes drag_second[6];
};

ARGIL_LANES void add_drag(const LatticeJob& job, const Lanes& weight, const Lanes& phi,
                          const Lanes q[3], Accumulators& sums) {
  const Lanes u = greater_of(spread(1.0F) - phi * spread(job.skin_inverse), spread(0.0F));
  const Lanes drag = weight * u;
  const Lanes along[3] = {drag * q[0], drag * q[1], drag * q[2]};
  sums.drag += drag;
  for (int a = 0; a < 3; ++a) {
    sums.drag_first[a] += along[a];
    sums.drag_second[a] += along[a] * q[a];
  }
  sums.drag_second[3] += along[1] * q[2];
  sums.drag_second[4] += along[2] * q[0];
  sums.drag_second[5] += along[0] * q[1];
}

/// Adds the vector `push` and its moment about the tool's centre.
template <bool kTorque>
ARGIL_LANES void add_push(const Lanes push[3], const Lanes arm[3], Accumulators& sums) {
  for (int a = 0; a < 3; ++a) sums.force[a] += push[a];
  if constexpr (kTorque) {
    sums.torque[0] += arm[1] * push[2] - arm[2] * push[1];
    sums.torque[1] += arm[2] * push[0] - arm[0] * push[2];
    sums.torque[2] += arm[0] * push[1] - arm[1] * push[0];
  }
}

/// Unit gradients by central differences, in the tool's frame; the blocks have neighbours on all
/// sides. Zero where the field is flat: a plateau, or the crest of a medial axis.
template <bool kTurned>
ARGIL_LANES void unit_gradient(const LatticeJob& job, const Block pair[2], Lanes out[3]) {
  const std::ptrdiff_t stride[3] = {static_cast<std::ptrdiff_t>(job.nodes[1]) * job.nodes[2],
                                    job.nodes[2], 1};
  const Lanes scale = spread(0.5F * job.voxel_inverse);
  Lanes along[3];
  for (int a = 0; a < 3; ++a) {
    along[a] = (window_values(job, pair, stride[a]) - window_values(job, pair, -stride[a])) * scale;
  }
  constexpr float kLeastGradient = 1e-3F;
  const Lanes length = square_root(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
  const Lanes steep = length - spread(kLeastGradient);
  const Lanes inverse =
      where_positive(steep, spread(1.0F) / greater_of(length, spread(kLeastGradient)));
  for (int a = 0; a < 3; ++a) along[a] = along[a] * inverse;
  for (int a = 0; a < 3; ++a) {
    out[a] = along[a];
    if constexpr (kTurned) {
      out[a] = spread(static_cast<float>(job.axes[a][0])) * along[0] +
               spread(static_cast<float>(job.axes[a][1])) * along[1] +
               spread(static_cast<float>(job.axes[a][2])) * along[2];
    }
  }
}

template <class Kernel, bool kBlanch>
ARGIL_LANES void add_pair(const LatticeJob& job, const Kernel& kernel, const Lanes step[3],
                          const Block pair[2], Accumulators& sums) {
  Lanes q[3];
  for (int a = 0; a < 3; ++a) q[a] = spread_pair(pair[0].q[a], pair[1].q[a]) + step[a];
  const KernelLanes at = kernel.at(q, visited_lanes(pair));
  const Lanes phi = window_values(job, pair, 0);
  LawLanes law = law_at<kBlanch>(job, phi);
  law.value = law.value - spread(job.law_offset);
  const Lanes weighted = at.weight * law.value;
  sums.law += weighted;
  sums.law_rate += at.weight * law.rate;
  Lanes push[3];
  if constexpr (kBlanch) {
    unit_gradient<Kernel::kTurned>(job, pair, push);
    for (int a = 0; a < 3; ++a) push[a] = push[a] * weighted;
  } else {
    for (int a = 0; a < 3; ++a) push[a] = at.slope[a] * law.value;
  }
  add_push<kBlanch || Kernel::kTurned>(push, q, sums);
  add_drag(job, at.weight, phi, q, sums);
}

/// Sums blocks two at a time; `count` is even.
template <class Kernel, bool kBlanch>
void sum_blocks(const LatticeJob& job, const Block* blocks, int count, Accumulators& sums) {
  const Kernel kernel(job);
  constexpr float kCount[kBlockNodes] = {0, 1, 2, 3, 4, 5, 6, 7};
  Lanes step[3];
  for (int a = 0; a < 3; ++a) {
    step[a] = load_pair(kCount, kCount) * spread(static_cast<float>(job.axes[a][2]));
  }
  Accumulators held = sums;  // in registers while the loop runs
  for (int n = 0; n < count; n += 2) {
    add_pair<Kernel, kBlanch>(job, kernel, step, blocks + n, held);
  }
  sums = held;
}

void hand_over(const Accumulators& from, LatticeSums& sums) {
  sums.law = sum_of(from.law, 0, 1);
  sums.law_rate = sum_of(from.law_rate, 0, 1);
  for (int a = 0; a < 3; ++a) {
    sums.force_even[a] = sum_of(from.force[a], 0, 2);
    sums.force_odd[a] = sum_of(from.force[a], 1, 2);
    sums.torque[a] = sum_of(from.torque[a], 0, 1);
    sums.drag_first[a] = sum_of(from.drag_first[a], 0, 1);
  }
  sums.drag = sum_of(from.drag, 0, 1);
  for (int a = 0; a < 6; ++a) sums.drag_second[a] = sum_of(from.drag_second[a], 0, 1);
}

/// Sixteen rows side by side, j to j + 15 of one i: q of their nodes 0, and which nodes of them lie
/// under the kernel (none where high < low).
struct RowLanes {
  Lanes q[3];
  Lanes low;
  Lanes high;
};

/// Where the lines meet the ellipsoid of the reach.
ARGIL_LANES void shorten_round(const LatticeJob& job, RowLanes& rows) {
  double along = 0.0;
  float per_reach[3];
  Lanes b = spread(0.0F);
  Lanes c = spread(-1.0F);
  for (int a = 0; a < 3; ++a) {
    const double inverse = 1.0 / (job.reach[a] * job.reach[a]);
    along += job.axes[a][2] * job.axes[a][2] * inverse;
    per_reach[a] = static_cast<float>(inverse);
    b += rows.q[a] * spread(static_cast<float>(job.axes[a][2] * inverse));
    c += rows.q[a] * rows.q[a] * spread(per_reach[a]);
  }
  const Lanes discriminant = b * b - spread(static_cast<float>(along)) * c;
  const Lanes root = square_root(greater_of(discriminant, spread(0.0F)));
  const Lanes per_along = spread(static_cast<float>(1.0 / along));
  const Lanes none = where_positive(spread(0.0F) - discriminant, spread(1e6F));
  rows.low = greater_of((spread(0.0F) - b - root) * per_along, rows.low) + none;
  rows.high = lesser_of((root - b) * per_along, rows.high);
}

/// Where the lines meet the box of the reach.
ARGIL_LANES void shorten_box(const LatticeJob& job, RowLanes& rows) {
  for (int a = 0; a < 3; ++a) {
    const double step = job.axes[a][2];
    const Lanes reach = spread(static_cast<float>(job.reach[a]));
    if (__builtin_fabs(step) < 1e-6) {  // along the faces: all of a row or nothing
      const Lanes beyond = greater_of(rows.q[a] - reach, spread(0.0F) - rows.q[a] - reach);
      rows.low += where_positive(beyond, spread(1e6F));
      continue;
    }
    const Lanes per_step = spread(static_cast<float>(1.0 / step));
    const Lanes one = (spread(0.0F) - reach - rows.q[a]) * per_step;
    const Lanes two = (reach - rows.q[a]) * per_step;
    rows.low = greater_of(lesser_of(one, two), rows.low);
    rows.high = lesser_of(greater_of(one, two), rows.high);
  }
}

/// Rows j to j + 15 of plane i.
ARGIL_LANES RowLanes rows_at(const LatticeJob& job, bool round, int i, int j) {
  constexpr float kCount[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const Lanes lane = load_pair(kCount, kCount + kBlockNodes);
  const double r[3] = {i - job.center[0], j - job.center[1], -job.center[2]};
  RowLanes rows;
  for (int a = 0; a < 3; ++a) {
    const double* axis = job.axes[a];
    rows.q[a] = spread(static_cast<float>(axis[0] * r[0] + axis[1] * r[1] + axis[2] * r[2])) +
                spread(static_cast<float>(axis[1])) * lane;
  }
  rows.low = spread(static_cast<float>(job.low[2]));
  rows.high = spread(static_cast<float>(job.high[2]));
  if (round) {
    shorten_round(job, rows);
  } else {
    shorten_box(job, rows);
  }
  return rows;
}

/// Cuts the rows under the kernel into blocks and sums them, a bounded number at a time.
template <class Kernel, bool kBlanch>
class RowSum {
 public:
  explicit RowSum(const LatticeJob& job) : job_(job) {
    for (int a = 0; a < 3; ++a) step_[a] = static_cast<float>(job.axes[a][2]);
  }

  /// Rows j to j_high, at most sixteen, of plane i.
  void add_rows(int i, int j, int j_high, const RowLanes& rows) {
    for (int lane = 0; lane < kLanes && j + lane <= j_high; ++lane) {
      const auto at = [lane](const Lanes& a) {
        return a.part[lane / kPartLanes][lane % kPartLanes];
      };
      const float low = __builtin_ceilf(at(rows.low));
      const float high = __builtin_floorf(at(rows.high));
      if (!(low <= high)) continue;
      const float q[3] = {at(rows.q[0]), at(rows.q[1]), at(rows.q[2])};
      add_row(i, j + lane, q, static_cast<int>(low), static_cast<int>(high));
    }
  }

  void flush() {
    if (count_ % 2 == 1) {
      blocks_[count_] = blocks_[count_ - 1];
      blocks_[count_++].high = -1;  // visits nothing
    }
    sum_blocks<Kernel, kBlanch>(job_, blocks_, count_, sums_);
    count_ = 0;
  }

  const Accumulators& sums() const { return sums_; }
  int samples() const { return samples_; }

 private:
  /// Nodes low to high of row (i, j), whose node 0 is at q. Blocks start where i + j + k is even,
  /// so that lanes know the parity of their nodes.
  void add_row(int i, int j, const float q[3], int low, int high) {
    const int row = (i * job_.nodes[1] + j) * job_.nodes[2];
    samples_ += high - low + 1;
    for (int k = low - ((i + j + low) & 1); k <= high; k += kBlockNodes) {
      if (count_ == kMostBlocks) flush();
      Block& block = blocks_[count_++];
      block.at = row + k;
      for (int a = 0; a < 3; ++a) block.q[a] = q[a] + step_[a] * static_cast<float>(k);
      block.low = low > k ? low - k : 0;
      block.high = high - k < kBlockNodes ? high - k : kBlockNodes - 1;
    }
  }

  static constexpr int kMostBlocks = 512;
  const LatticeJob& job_;
  float step_[3];
  int count_ = 0;
  int samples_ = 0;
  Block blocks_[kMostBlocks];
  Accumulators sums_{};
};

template <class Kernel, bool kBlanch>
void sum_rows(const LatticeJob& job, bool round, LatticeSums& sums) {
  RowSum<Kernel, kBlanch> total(job);
  for (int i = job.low[0]; i <= job.high[0]; ++i) {
    for (int j = job.low[1]; j <= job.high[1]; j += kLanes) {
      total.add_rows(i, j, job.high[1], rows_at(job, round, i, j));
    }
  }
  total.flush();
  hand_over(total.sums(), sums);
  sums.samples = total.samples();
}

template <class Kernel>
void sum_law(const LatticeJob& job, bool round, LatticeSums& sums) {
  if (job.blanch) {
    sum_rows<Kernel, true>(job, round, sums);
  } else {
    sum_rows<Kernel, false>(job, round, sums);
  }
}

}  // namespace

void sum_lattice(const LatticeJob& job, LatticeSums& sums) noexcept {
  switch (job.shape) {
    case SumShape::ball:
      return sum_law<BallKernel>(job, true, sums);
    case SumShape::ellipsoid:
      return sum_law<EllipsoidKernel>(job, true, sums);
    case SumShape::box:
      return sum_law<BoxKernel>(job, false, sums);
    case SumShape::capsule:
      return sum_law<CapsuleKernel>(job, false, sums);
  }
}

}  // namespace argil::haptics::ARGIL_LANES_SET
