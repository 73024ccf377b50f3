// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of LeafTriangle. Included by rows_impl.h after layer_impl.h.
//
// Notation: eight nodes are a row along z, or a cube of 2^3. Within the plane of a triangle a node
// is 0 from it where it has passed no side's line, else as far as from the nearest side.

/// Eight nodes: where the first lies in the leaf, and the others from it.
struct EightNodes {
  float x;
  float y;
  float z;
  EightFloats dx;
  EightFloats dy;
  EightFloats dz;
};

ARGIL_ROWS void values_in_row(const LatticeFunction& f, const EightNodes& at, EightFloats& out) {
  out = (f.first + at.x * f.along[0] + at.y * f.along[1]) + at.dz * f.along[2];
}
ARGIL_ROWS void values_in_cube(const LatticeFunction& f, const EightNodes& at, EightFloats& out) {
  out = (f.first + at.x * f.along[0] + at.y * f.along[1] + at.z * f.along[2]) +
        (at.dx * f.along[0] + at.dy * f.along[1] + at.dz * f.along[2]);
}

/// Lowers the squares of eight nodes, whose values `read` finds.
template <class Read>
ARGIL_ROWS void lower_eight_to(const LeafTriangle& triangle, const Read& read, EightFloats& best) {
  EightFloats height;
  read(triangle.height, height);
  const EightFloats above = height * height;
  if (lane_bits(above < best) == 0) return;
  EightFloats beyond[3];
  EightFloats out = {};
#pragma GCC unroll 3
  for (int side = 0; side < 3; ++side) {
    read(triangle.beyond[side], beyond[side]);
    out = out < beyond[side] ? beyond[side] : out;
  }
  if (lane_bits(above + out * out < best) == 0) return;
  EightFloats within = EightFloats{} + 1e30F;
#pragma GCC unroll 3
  for (int side = 0; side < 3; ++side) {
    EightFloats along;
    read(triangle.along[side], along);
    const EightFloats before = triangle.from[side] - along;
    const EightFloats after = along - triangle.to[side];
    EightFloats over = before < after ? after : before;
    over = over > 0.0F ? over : EightFloats{};
    const EightFloats square = beyond[side] * beyond[side] + over * over;
    within = square < within ? square : within;
  }
  const EightFloats square = above + (out > 0.0F ? within : EightFloats{});
  best = square < best ? square : best;
}

void lower_to_triangles(const LeafTriangle* triangles, int count, float* squares) noexcept {
  EightNodes at = {0, 0, 0, {}, {}, {0, 1, 2, 3, 4, 5, 6, 7}};
  for (int n = 0; n < count; ++n) {
    const LeafTriangle& triangle = triangles[n];
    for (int x = triangle.first[0]; x <= triangle.last[0]; ++x) {
      for (int y = triangle.first[1]; y <= triangle.last[1]; ++y) {
        at.x = static_cast<float>(x);
        at.y = static_cast<float>(y);
        float* const row = squares + kRowNodes * (kRowNodes * x + y);
        EightFloats best;
        load_eight(row, best);
        lower_eight_to(
            triangle,
            [&](const LatticeFunction& f, EightFloats& out)
                __attribute__((always_inline)) { values_in_row(f, at, out); },
            best);
        __builtin_memcpy(row, &best, sizeof best);
      }
    }
  }
}

void lower_cube(const LeafTriangle* triangles, const int* chosen, int count, const int* first,
                float* squares) noexcept {
  const EightNodes at = {static_cast<float>(first[0]), static_cast<float>(first[1]),
                         static_cast<float>(first[2]), {0, 0, 0, 0, 1, 1, 1, 1},
                         {0, 0, 1, 1, 0, 0, 1, 1},     {0, 1, 0, 1, 0, 1, 0, 1}};
  float* const low = squares + kRowNodes * (kRowNodes * first[0] + first[1]) + first[2];
  float* const rows[4] = {low, low + kRowNodes, low + kRowNodes * kRowNodes,
                          low + kRowNodes * (kRowNodes + 1)};
  EightFloats best = {rows[0][0], rows[0][1], rows[1][0], rows[1][1],
                      rows[2][0], rows[2][1], rows[3][0], rows[3][1]};
  for (int n = 0; n < count; ++n) {
    lower_eight_to(
        triangles[chosen[n]],
        [&](const LatticeFunction& f, EightFloats& out)
            __attribute__((always_inline)) { values_in_cube(f, at, out); },
        best);
  }
  for (int row = 0; row < 4; ++row) {
    rows[row][0] = best[2 * row];
    rows[row][1] = best[2 * row + 1];
  }
}

/// How far eight balls' middles are from the cube's, squared, and along each axis.
ARGIL_ROWS void offsets_of_balls(const BallsJob& job, int n, EightFloats* off,
                                 EightFloats& square) {
  square = EightFloats{};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    load_eight(job.at[axis] + n, off[axis]);
    off[axis] -= job.middle[axis];
    square += off[axis] * off[axis];
  }
}

/// A ball is left out where all of it is farther than all of the pivot's, by a margin for rounding,
/// from each node of the cube: the difference of squares of distances from two middles is linear.
int choose_balls(const BallsJob& job, int* chosen) noexcept {
  constexpr float kFarAway = 1e30F;
  constexpr float kDiagonalOfHalf = 1.7320509F;
  constexpr float kRounding = 1e-4F;
  EightFloats best = EightFloats{} + kFarAway;
  EightInts which = {};
  EightInts index = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int n = 0; n < job.count; n += kRowNodes) {
    EightFloats off[3];
    EightFloats square;
    offsets_of_balls(job, n, off, square);
    const EightInts is_nearer = square < best;
    best = is_nearer ? square : best;
    which = is_nearer ? index : which;
    index += kRowNodes;
  }
  float pivot_square = kFarAway;
  const int pivot = least_lane(best, which, 0, pivot_square);
  const float corner = kDiagonalOfHalf * job.half;
  const float farthest = __builtin_sqrtf(pivot_square) + corner;
  const float reach = job.reach + corner;
  const float pivot_off[3] = {job.at[0][pivot] - job.middle[0], job.at[1][pivot] - job.middle[1],
                              job.at[2][pivot] - job.middle[2]};
  int count = 0;
  for (int n = 0; n < job.count; n += kRowNodes) {
    EightFloats off[3];
    EightFloats square;
    offsets_of_balls(job, n, off, square);
    EightFloats across = {};
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      const EightFloats apart = off[axis] - pivot_off[axis];
      across += apart < 0.0F ? -apart : apart;
    }
    EightFloats radius;
    load_eight(job.radius + n, radius);
    const EightFloats both = radius + job.radius[pivot];
    const EightFloats most = pivot_square + (2.0F * job.half) * across +
                             both * (2.0F * farthest + both) + kRounding * (1.0F + square);
    const EightFloats within = reach + radius;
    unsigned bits = lane_bits((square <= most) & (square <= within * within));
    while (bits != 0) {
      chosen[count++] = n + __builtin_ctz(bits);
      bits &= bits - 1;
    }
  }
  return count;
}

void sign_distances(const float* squares, const unsigned char* inside, float voxel, float band,
                    float least, float* out) noexcept {
  const EightInts bit = {1, 2, 4, 8, 16, 32, 64, 128};
  for (int row = 0; row < kLeafRows; ++row) {
    EightFloats square;
    load_eight(squares + kRowNodes * row, square);
    EightFloats distance;
    roots(square, distance);
    const EightInts is_on = distance < least;
    distance *= voxel;
    distance = distance < band ? distance : EightFloats{} + band;
    distance = is_on ? EightFloats{} : distance;
    const EightInts is_inside = ((bit & static_cast<int>(inside[row])) != 0) & ~is_on;
    distance = is_inside ? -distance : distance;
    __builtin_memcpy(out + kRowNodes * row, &distance, sizeof distance);
  }
}
