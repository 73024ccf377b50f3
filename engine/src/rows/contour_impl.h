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
ARGIL_ROWS void load_doubles(const float* const* at, const int* offset, FourDoubles& out) {
  const FourFloats loaded{at[0][offset[0]], at[1][offset[1]], at[2][offset[2]], at[3][offset[3]]};
  out = __builtin_convertvector(loaded, FourDoubles);
}
/// The field about a node of each of four edges, along the three axes.
struct NodeFields {
  FourDoubles across[3];  ///< differences over two voxels: the gradient
  FourDoubles square;     ///< of its length
  bool is_smooth[kLanes];
};

ARGIL_ROWS bool is_little(double value, double most) { return value < most && value > -most; }

ARGIL_ROWS void load_about(const float* const* at, const int* stride, double voxel,
                           NodeFields& out) {
  const double most_bend = CutJob::kMostBend * voxel;
  FourFloats value;
  load_each(at, 0, value);
  FourDoubles bend[3];
  for (int axis = 0; axis < 3; ++axis) {
    FourFloats before;
    FourFloats after;
    load_each(at, -stride[axis], before);
    load_each(at, stride[axis], after);
    out.across[axis] = __builtin_convertvector(after - before, FourDoubles);
    bend[axis] = __builtin_convertvector((before - value) + (after - value), FourDoubles);
  }
  out.square =
      out.across[0] * out.across[0] + out.across[1] * out.across[1] + out.across[2] * out.across[2];
  const double of_distance = 4.0 * voxel * voxel;  // differences reach over two voxels
  for (int k = 0; k < kLanes; ++k) {
    out.is_smooth[k] = is_little(bend[0][k], most_bend) && is_little(bend[1][k], most_bend) &&
                       is_little(bend[2][k], most_bend) &&
                       out.square[k] > CutJob::kLeastSlope * of_distance &&
                       out.square[k] < CutJob::kMostSlope * of_distance;
  }
}

/// The field along four edges from their low ends, t = 0, to their high ones, t = 1: the cubic
/// through both and the nodes before and behind, at t: low + t (rise + (t - 1) (bend + (t - 0.5)
/// twist)).
struct EdgeFields {
  FourDoubles low, rise, bend, twist;
  FourDoubles bend_low, bend_high;  ///< second differences at the ends
};

ARGIL_ROWS void load_edges(const float* const* at, const int* along, EdgeFields& out) {
  const int none[kLanes] = {};
  int before[kLanes];
  int behind[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    before[k] = -along[k];
    behind[k] = 2 * along[k];
  }
  FourDoubles previous;
  FourDoubles high;
  FourDoubles next;
  load_doubles(at, before, previous);
  load_doubles(at, none, out.low);
  load_doubles(at, along, high);
  load_doubles(at, behind, next);
  out.rise = high - out.low;
  out.bend_low = previous - out.low + out.rise;
  out.bend_high = next - high - out.rise;
  out.bend = 0.25 * (out.bend_low + out.bend_high);
  out.twist = (out.bend_high - out.bend_low) / 6.0;
}

ARGIL_ROWS void value_at(const EdgeFields& edge, const FourDoubles& t, FourDoubles& out) {
  out = edge.low + t * (edge.rise + (t - 1.0) * (edge.bend + (t - 0.5) * edge.twist));
}
ARGIL_ROWS void slope_at(const EdgeFields& edge, const FourDoubles& t, FourDoubles& out) {
  out = edge.rise + (2.0 * t - 1.0) * (edge.bend + (t - 0.5) * edge.twist) +
        t * (t - 1.0) * edge.twist;
}

/// Edges along which the field is smooth, so that the cubic says where it passes zero.
ARGIL_ROWS void find_smooth(const EdgeFields& edge, const NodeFields& low, const NodeFields& high,
                            double voxel, bool* is_smooth) {
  const double most_bend = CutJob::kMostBend * voxel;
  const double most_change = CutJob::kMostChange * voxel;
  constexpr double kLeast = CutJob::kLeastCosine * CutJob::kLeastCosine;
  const FourDoubles change = edge.bend_high - edge.bend_low;
  const FourDoubles both = low.across[0] * high.across[0] + low.across[1] * high.across[1] +
                           low.across[2] * high.across[2];
  const FourDoubles squares = low.square * high.square;
  for (int k = 0; k < kLanes; ++k) {
    is_smooth[k] = is_little(edge.bend_low[k], most_bend) &&
                   is_little(edge.bend_high[k], most_bend) && is_little(change[k], most_change) &&
                   both[k] > 0.0 && both[k] * both[k] > kLeast * squares[k];
  }
}

/// Where vertices lie on four edges, and what the field is there.
struct EdgeCuts {
  FourDoubles t;
  FourDoubles rest;
  bool may_move[kLanes];  ///< onto the surface, off the edge
};

/// Where the field passes zero, as a fraction of each edge: where it is smooth that of the cubic,
/// by two steps of Newton from that of the straight line. Kept off the ends: the farther where the
/// nearer end is smooth, so that all vertices about a node leave their edges or none.
ARGIL_ROWS void find_cuts(const EdgeFields& edge, const NodeFields& low, const NodeFields& high,
                          const CutJob& job, const unsigned* code, EdgeCuts& out) {
  bool is_smooth[kLanes];
  find_smooth(edge, low, high, job.voxel, is_smooth);
  const FourDoubles straight = edge.low / -edge.rise;
  FourDoubles curved = straight;
  for (int step = 0; step < 2; ++step) {
    FourDoubles value;
    FourDoubles slope;
    value_at(edge, curved, value);
    slope_at(edge, curved, slope);
    curved = curved - value / slope;
  }
  out.t = straight;
  for (int k = 0; k < kLanes; ++k) {
    const double cut = is_smooth[k] ? curved[k] : straight[k];
    const bool is_low = cut < 0.5;
    const unsigned stays = is_low ? CutJob::kLowStays : CutJob::kHighStays;
    out.may_move[k] = (is_low ? low : high).is_smooth[k] && (code[k] & stays) == 0;
    const double margin = out.may_move[k] ? job.moved_margin : job.margin;
    const double most = 1.0 - margin;
    out.t[k] = cut > margin ? (cut < most ? cut : most) : margin;
  }
  value_at(edge, out.t, out.rest);
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
    int along[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      low[k] = job.dense + low_of(code[k], 0) * job.plane + low_of(code[k], 1) * job.row +
               low_of(code[k], 2);
      along[k] = stride[axis_of(code[k])];
      high[k] = low[k] + along[k];
    }
    NodeFields at_low;
    NodeFields at_high;
    load_about(low, stride, job.voxel, at_low);
    load_about(high, stride, job.voxel, at_high);
    EdgeFields edge;
    load_edges(low, along, edge);
    EdgeCuts cuts;
    find_cuts(edge, at_low, at_high, job, code, cuts);
    FourDoubles normal[3];
    for (int axis = 0; axis < 3; ++axis) {
      normal[axis] = at_low.across[axis] + cuts.t * (at_high.across[axis] - at_low.across[axis]);
    }
    const FourDoubles square =
        normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    FourDoubles length;
    for (int k = 0; k < kLanes; ++k) length[k] = __builtin_sqrt(square[k]);
    const FourDoubles scale = 1.0 / length;
    // In voxels, along the unit normal; the gradient reaches over two of them.
    const FourDoubles to_surface = -2.0 * cuts.rest * scale;
    FourDoubles step;
    for (int k = 0; k < kLanes; ++k) {
      const double most = CutJob::kMostStep;
      const double near = to_surface[k] > -most ? to_surface[k] : -most;
      step[k] = cuts.may_move[k] ? (near < most ? near : most) : 0.0;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const FourDoubles unit = normal[axis] * scale;
      for (int k = 0; k < kLanes; ++k) {
        const double on_edge = axis_of(code[k]) == axis ? cuts.t[k] : 0.0;
        const double aside = cuts.may_move[k] ? step[k] * unit[k] : 0.0;
        const double node = static_cast<double>(job.node[axis] + low_of(code[k], axis));
        out.position[3 * (first + k) + axis] = (node + on_edge + aside) * job.voxel;
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
