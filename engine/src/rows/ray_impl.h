// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of a ray through boxes and through the triangles of a block. Included by rows_impl.h.
//
// S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2 (2013). Ours
// differs: every vertex is sheared once instead of once for each of its triangles; a triangle that
// lies on one side of the ray along either axis is told by the signs of its corners, so that few
// are tested; and those in double, where the products of floats are exact and so are the signs.

int enter_boxes(const RayJob& ray, const EightBoxes* boxes, int count, float far,
                BoxEntry* out) noexcept {
  int found = 0;
  for (int first = 0; first < count; first += EightBoxes::kCount) {
    const EightBoxes& eight = boxes[first / EightBoxes::kCount];
    float enter[EightBoxes::kCount];
    float leave[EightBoxes::kCount];
    for (int k = 0; k < EightBoxes::kCount; ++k) {
      enter[k] = 0.0F;
      leave[k] = far;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const float origin = ray.origin[axis];
      const float inverse = ray.inverse[axis];
      for (int k = 0; k < EightBoxes::kCount; ++k) {
        const float low = (eight.low[axis][k] - origin) * inverse;
        const float high = (eight.high[axis][k] - origin) * inverse;
        enter[k] = greater(enter[k], lesser(low, high));
        leave[k] = lesser(leave[k], greater(low, high));
      }
    }
    const int here = count - first < EightBoxes::kCount ? count - first : EightBoxes::kCount;
    for (int k = 0; k < here; ++k) {
      out[found].along = enter[k];
      out[found].box = first + k;
      found += enter[k] <= leave[k] ? 1 : 0;
    }
  }
  return found;
}

/// Where each vertex lies beside the ray, and on which sides: bits for x > 0, x < 0, y > 0, y < 0.
ARGIL_ROWS void shear_vertices(const RayJob& ray, const TrianglesJob& job) {
  const float* __restrict from = job.vertices;
  float* __restrict x = job.x;
  float* __restrict y = job.y;
  unsigned char* __restrict sides = job.sides;
  const int ax = ray.axis[0];
  const int ay = ray.axis[1];
  const int az = ray.axis[2];
  for (int i = 0; i < job.vertex_count; ++i) {
    const float* at = from + TrianglesJob::kVertexFloats * i;
    const float ahead = at[az] - ray.origin[az];
    x[i] = (at[ax] - ray.origin[ax]) - ray.shear[0] * ahead;
    y[i] = (at[ay] - ray.origin[ay]) - ray.shear[1] * ahead;
  }
  for (int i = 0; i < job.vertex_count; ++i) {
    const int right = x[i] > 0.0F ? 1 : 0;
    const int left = x[i] < 0.0F ? 2 : 0;
    const int above = y[i] > 0.0F ? 4 : 0;
    const int below = y[i] < 0.0F ? 8 : 0;
    sides[i] = static_cast<unsigned char>(right | left | above | below);
  }
}

/// The product of one's x and the other's y less the reverse: its sign is exact, and that of the
/// edge's other triangle is the opposite.
ARGIL_ROWS double turn(const TrianglesJob& job, unsigned a, unsigned b) {
  const double ax = job.x[a];
  const double ay = job.y[a];
  const double bx = job.x[b];
  const double by = job.y[b];
  return ax * by - ay * bx;
}

/// How far on the ray a vertex lies, as counted along the axis it runs along most.
ARGIL_ROWS double vertex_along(const RayJob& ray, const TrianglesJob& job, unsigned vertex) {
  const float* at = job.vertices + TrianglesJob::kVertexFloats * vertex;
  const int az = ray.axis[2];
  return (static_cast<double>(at[az]) - static_cast<double>(ray.origin[az])) * ray.per_step;
}

/// Takes a triangle for the hit when it faces the ray, lies ahead and nearer.
ARGIL_ROWS void meet_triangle(const RayJob& ray, const TrianglesJob& job, int which,
                              TriangleHit& hit) {
  const unsigned* t = job.triangles + 3 * which;
  const double weights[3] = {turn(job, t[2], t[1]), turn(job, t[0], t[2]), turn(job, t[1], t[0])};
  if (weights[0] < 0.0 || weights[1] < 0.0 || weights[2] < 0.0) return;
  const double all = weights[0] + weights[1] + weights[2];
  if (!(all > 0.0)) return;  // seen from its edge: the triangles beside it answer
  double along = 0.0;
  for (int c = 0; c < 3; ++c) along += weights[c] / all * vertex_along(ray, job, t[c]);
  if (along < 0.0 || along >= hit.along) return;
  hit.along = along;
  for (int c = 0; c < 3; ++c) hit.weight[c] = weights[c] / all;
  hit.triangle = which;
}

void meet_triangles(const RayJob& ray, const TrianglesJob& job, TriangleHit& hit) noexcept {
  shear_vertices(ray, job);
  for (int n = 0; n < job.triangle_count; ++n) {
    const unsigned* t = job.triangles + 3 * n;
    const int on_one_side = job.sides[t[0]] & job.sides[t[1]] & job.sides[t[2]];
    if (on_one_side == 0) meet_triangle(ray, job, n, hit);
  }
}
