// SPDX-License-Identifier: GPL-3.0-or-later
// Catmull-Rom keeps what trilinear reading would wear away: moved detail is resampled once, and at
// a node's own position it gets that node's value to the bit.
#include "brush/local_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "field/prolongation.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

/// Weights of the four nodes around a point that lies at `t`, 0 to 1, from the second to the third.
std::array<double, 4> catmull_rom(double t) noexcept {
  assert(t >= 0.0 && t <= 1.0);
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {0.5 * (2.0 * t2 - t - t3), 0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
          0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (t3 - t2)};
}

/// Sums `value(x, y, z)` of the 4^3 nodes from one below `low` under the weights along each axis.
template <class Value>
float cubic_sum(const std::array<std::array<double, 4>, 3>& weight, const Value& value) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (weight[0][i] == 0.0) continue;
    double plane = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (weight[1][j] == 0.0) continue;
      double row = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (weight[2][k] != 0.0) row += weight[2][k] * static_cast<double>(value(i, j, k));
      }
      plane += weight[1][j] * row;
    }
    sum += weight[0][i] * plane;
  }
  return static_cast<float>(sum);
}

/// One pass of (1, 2, 1)/4 along an axis; the ends of each line stay.
void average_axis(std::vector<float>& value, const Coord& dim, std::size_t axis) {
  const std::array<std::size_t, 3> count{static_cast<std::size_t>(dim.x()),
                                         static_cast<std::size_t>(dim.y()),
                                         static_cast<std::size_t>(dim.z())};
  const std::array<std::size_t, 3> stride{count[1] * count[2], count[2], 1};
  assert(value.size() == count[0] * stride[0]);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  for (std::size_t a = 0; a < count[u]; ++a) {
    for (std::size_t b = 0; b < count[v]; ++b) {
      const std::size_t start = a * stride[u] + b * stride[v];
      float previous = value[start];
      for (std::size_t i = 1; i + 1 < count[axis]; ++i) {
        float& here = value[start + i * stride[axis]];
        const float kept = here;
        here = 0.25F * previous + 0.5F * here + 0.25F * value[start + (i + 1) * stride[axis]];
        previous = kept;
      }
    }
  }
}

}  // namespace

void average_twice(LocalField& field) {
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t axis = 0; axis < 3; ++axis) average_axis(field.value, field.box.dim(), axis);
  }
}

void read_at_feet(const LocalField& field, const LeafFeet& feet, const Vec3& offset_mm,
                  LeafMoves& out) {
  const Coord dim = field.box.dim();
  assert(dim.x() >= 2 && dim.y() >= 2 && dim.z() >= 2);
  FieldJob job{field.value.data(), {dim.x(), dim.y(), dim.z()}, {}, 0.0F};
  const Vec3 first = (feet.origin_mm + offset_mm) / field.voxel_mm;
  for (int a = 0; a < 3; ++a) {
    job.first[a] = static_cast<float>(first[static_cast<std::size_t>(a)] - field.box.min()[a]);
  }
  job.scale = static_cast<float>(feet.voxel_mm / field.voxel_mm);
  row_loops().read(job, feet.rows.at, out.mm.data());
}

LocalField local_field(const LevelEdit& level, const Box3& bounds_mm, int margin) {
  LocalField field;
  field.voxel_mm = level.voxel_mm();
  const Vec3 lo = bounds_mm.min / field.voxel_mm;
  const Vec3 hi = bounds_mm.max / field.voxel_mm;
  field.box = CoordBBox(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)).offsetBy(-margin),
                        Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)).offsetBy(margin));
  level.gather_now(field.box, field.value);
  return field;
}

LocalField local_field(const LevelStack& stack, int level, const CoordBBox& box) {
  LocalField field{box, stack.voxel_mm(level), {}};
  field.value.resize(static_cast<std::size_t>(box.volume()));
  for_each_leaf_origin(box, [&](const Coord& origin) {
    LeafValues filled;
    const VdbLeaf* leaf = stack.leaf(level, origin);
    if (leaf == nullptr) prolong_leaf(stack, level, origin, filled);
    const float* values = leaf != nullptr ? values_of(*leaf) : filled.data();
    copy_into_box(origin, values, box, field.value);
  });
  return field;
}

LocalField local_field(const StrokeStart& start, double voxel_mm, int level, const CoordBBox& box) {
  LocalField field{box, voxel_mm, {}};
  field.value.resize(static_cast<std::size_t>(box.volume()));
  for_each_leaf_origin(box, [&](const Coord& origin) {
    LeafValues values;
    start.read(level, origin, values);
    copy_into_box(origin, values.data(), box, field.value);
  });
  return field;
}

/// The same weights as RowLoops::read_cubic, so that both agree where both can be asked.
float cubic_sample(const LevelStack& stack, int level, const Vec3& point_mm) {
  std::array<std::array<double, 4>, 3> weight;
  Coord low;
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = point_mm[a] / stack.voxel_mm(level);
    const double floor = std::floor(x);
    low[static_cast<int>(a)] = static_cast<int>(floor) - 1;
    weight[a] = catmull_rom(x - floor);
  }
  const float band = stack.band_mm(level);
  return cubic_sum(weight, [&](std::size_t i, std::size_t j, std::size_t k) {
    const Coord node = low.offsetBy(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
    return std::clamp(stack.sample(level, node), -band, band);
  });
}

}  // namespace argil
