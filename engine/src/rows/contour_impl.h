// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of the surface's vertices and quadrilaterals. Included by rows_impl.h.

/// Of a code of a cut edge.
ARGIL_ROWS int axis_of(unsigned code) { return static_cast<int>(code >> 24 & 3U); }
ARGIL_ROWS int low_of(unsigned code, int axis) {
  return static_cast<int>(code >> (16 - 8 * axis) & 0xffU);
}

constexpr int kLanes = CutJob::kLanes;
using FourFloats = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));

/// Four floats, each so far after its own place.
ARGIL_ROWS void load_each(const float* const* at, int offset, FourFloats& out) {
  out = FourFloats{at[0][offset], at[1][offset], at[2][offset], at[3][offset]};
}
ARGIL_ROWS void load_across(const float* const* at, int stride, FourDoubles& out) {
  FourFloats low;
  FourFloats high;
  load_each(at, -stride, low);
  load_each(at, stride, high);
  out = __builtin_convertvector(high - low, FourDoubles);
}

/// Where the field passes zero, as a fraction of each edge.
ARGIL_ROWS void find_cuts(const float* const* low, const float* const* high, double clamp,
                          FourDoubles& t) {
  FourFloats at_low;
  FourFloats at_high;
  load_each(low, 0, at_low);
  load_each(high, 0, at_high);
  const FourDoubles from = __builtin_convertvector(at_low, FourDoubles);
  const FourDoubles cut = from / (from - __builtin_convertvector(at_high, FourDoubles));
  for (int k = 0; k < kLanes; ++k) {
    const double most = 1.0 - clamp;
    t[k] = cut[k] > clamp ? (cut[k] < most ? cut[k] : most) : clamp;
  }
}

ARGIL_ROWS std::uint64_t key_of(const CutJob& job, std::uint64_t code) {
  const std::uint64_t edge = job.key + ((code >> 16 & 0xff) << 45) + ((code >> 8 & 0xff) << 26) +
                             ((code & 0xff) << 7) + ((code >> 24 & 3) << 5);
  return (code & CutJob::kIsShared) != 0 ? edge : ~0ULL;
}

/// Returns how many of the vertices have no normal, and appends them to `flat`.
int place_cuts(const CutJob& job, const unsigned* __restrict codes, int count,
               const CutVertices& out, unsigned short* __restrict flat) noexcept {
  const int stride[3] = {job.plane, job.row, 1};
  int flats = 0;
  for (int first = 0; first < count; first += kLanes) {
    const unsigned* const code = codes + first;
    const float* low[kLanes];
    const float* high[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      low[k] = job.dense + low_of(code[k], 0) * job.plane + low_of(code[k], 1) * job.row +
               low_of(code[k], 2);
      high[k] = low[k] + stride[axis_of(code[k])];
    }
    FourDoubles t;
    find_cuts(low, high, job.clamp, t);
    FourDoubles normal[3];
    for (int axis = 0; axis < 3; ++axis) {
      FourDoubles after;
      load_across(low, stride[axis], normal[axis]);
      load_across(high, stride[axis], after);
      normal[axis] = normal[axis] + t * (after - normal[axis]);
    }
    const FourDoubles square =
        normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    FourDoubles length;
    for (int k = 0; k < kLanes; ++k) length[k] = __builtin_sqrt(square[k]);
    const FourDoubles scale = 1.0 / length;
    for (int axis = 0; axis < 3; ++axis) {
      const FourDoubles unit = normal[axis] * scale;
      for (int k = 0; k < kLanes; ++k) {
        const double along = axis_of(code[k]) == axis ? t[k] : 0.0;
        const double node = static_cast<double>(job.node[axis] + low_of(code[k], axis));
        out.position[3 * (first + k) + axis] = (node + along) * job.voxel;
        out.normal[3 * (first + k) + axis] = unit[k];
      }
    }
    for (int k = 0; k < kLanes; ++k) {
      out.key[first + k] = key_of(job, code[k]);
      flat[flats] = static_cast<unsigned short>(first + k);
      flats += (first + k < count) & !(square[k] > 0.0) ? 1 : 0;
    }
  }
  return flats;
}

/// Points of four quadrilaterals, a lane each.
struct FourPoints {
  FourDoubles x, y, z;
};

ARGIL_ROWS void subtract(const FourPoints& a, const FourPoints& b, FourPoints& out) {
  out.x = a.x - b.x;
  out.y = a.y - b.y;
  out.z = a.z - b.z;
}
ARGIL_ROWS void square_of(const FourPoints& a, FourDoubles& out) {
  out = a.x * a.x + a.y * a.y + a.z * a.z;
}

/// As shapes() of surface/contour_loop.cpp.
ARGIL_ROWS void find_shapes(const FourPoints& a, const FourPoints& b, const FourPoints& c,
                            FourDoubles& out) {
  FourPoints u;
  FourPoints v;
  FourPoints w;
  subtract(b, a, u);
  subtract(c, a, v);
  subtract(v, u, w);
  const FourPoints n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  FourDoubles uu;
  FourDoubles vv;
  FourDoubles ww;
  FourDoubles nn;
  square_of(u, uu);
  square_of(v, vv);
  square_of(w, ww);
  square_of(n, nn);
  const FourDoubles sides = uu + vv + ww;
  out = nn / (sides * sides);
}

void choose_diagonals(const double* position, const Quadrilateral* quads, int count,
                      unsigned char* is_even) noexcept {
  for (int first = 0; first < count; first += 4) {
    FourPoints p[4] = {};
    for (int corner = 0; corner < 4; ++corner) {
      for (int lane = 0; lane < 4; ++lane) {
        const int quad = first + lane < count ? first + lane : first;
        const double* const at = position + 3 * quads[quad].vertex[corner];
        p[corner].x[lane] = at[0];
        p[corner].y[lane] = at[1];
        p[corner].z[lane] = at[2];
      }
    }
    FourDoubles shape[4];
    find_shapes(p[0], p[1], p[2], shape[0]);
    find_shapes(p[0], p[2], p[3], shape[1]);
    find_shapes(p[1], p[2], p[3], shape[2]);
    find_shapes(p[1], p[3], p[0], shape[3]);
    for (int lane = 0; lane < 4 && first + lane < count; ++lane) {
      const double even = shape[1][lane] < shape[0][lane] ? shape[1][lane] : shape[0][lane];
      const double odd = shape[3][lane] < shape[2][lane] ? shape[3][lane] : shape[2][lane];
      is_even[first + lane] = even >= odd ? 1 : 0;
    }
  }
}
