// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush/form_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "brush/dab_plan.h"
#include "edit/redistance.h"
#include "field/parallel.h"

namespace argil {
namespace {

constexpr double kLeastRise = 0.3;  ///< what rises less is not near the form

double room_of(const Box3& box) {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

}  // namespace

DabBoxes boxes_around(std::span<const PosedTool> dabs, std::size_t images) {
  constexpr std::size_t kNone = ~std::size_t{0};
  DabBoxes found;
  std::vector<std::size_t> last(images, kNone);  // of each image its last box
  for (std::size_t n = 0; n < dabs.size(); ++n) {
    const Box3& box = dabs[n].bounds_mm();
    std::size_t& at = last[n % images];
    if (at != kNone) {
      Box3 both = found.boxes_mm[at];
      both.include(box.min);
      both.include(box.max);
      if (room_of(both) <= room_of(found.boxes_mm[at]) + room_of(box)) {
        found.boxes_mm[at] = both;
        found.box_of.push_back(at);
        continue;
      }
    }
    at = found.boxes_mm.size();
    found.boxes_mm.push_back(box);
    found.box_of.push_back(at);
  }
  return found;
}

FormField::FormField(const LevelStack& stack, std::span<const PosedTool> dabs, std::size_t images,
                     double least_band_mm) {
  assert(!dabs.empty());
  // Three nodes for what is read beside the bounds, two for differences, four that averaging
  // leaves.
  constexpr int kMargin = 9;
  const int tool_level = level_of_tool(stack, smallest_radius(dabs.front().tool()));
  int level = std::min(tool_level + 1, stack.top());
  while (level < stack.top() && static_cast<double>(stack.band_mm(level)) < least_band_mm) ++level;
  const double voxel = stack.voxel_mm(level);
  band_mm_ = static_cast<double>(stack.band_mm(level));
  DabBoxes found = boxes_around(dabs, images);
  field_of_ = std::move(found.box_of);
  fields_.resize(found.boxes_mm.size());
  for_each_leaf(fields_.size(), [&](std::size_t n) {
    const Vec3 low = found.boxes_mm[n].min / voxel;
    const Vec3 high = found.boxes_mm[n].max / voxel;
    const openvdb::CoordBBox box(
        Coord::floor(openvdb::Vec3d(low.x, low.y, low.z)).offsetBy(-kMargin),
        Coord::ceil(openvdb::Vec3d(high.x, high.y, high.z)).offsetBy(kMargin));
    fields_[n] = local_field(stack, level, box);
    average_twice(fields_[n]);
    average_twice(fields_[n]);
  });
}

FormField::Place FormField::at(std::size_t dab, const Vec3& point_mm) const {
  const LocalField& field = fields_[field_of_[dab]];
  const Vec3 nodes = point_mm / field.voxel_mm;
  Place place{value(field, nodes) / band_mm_, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 step;
    step[a] = 1.0;
    place.rise[a] =
        (value(field, nodes + step) - value(field, nodes - step)) / (2.0 * field.voxel_mm);
  }
  return place;
}

Vec3 FormField::foot_mm(std::size_t dab, const Vec3& point_mm, int steps) const {
  Vec3 foot = point_mm;
  for (int step = 0; step < steps; ++step) {
    const Place place = at(dab, foot);
    const double square = dot(place.rise, place.rise);
    if (square < kLeastRise * kLeastRise) break;
    foot -= (place.bands * band_mm_ / square) * place.rise;
  }
  return foot;
}

FormField::Foot FormField::foot(std::size_t dab, const Vec3& point_mm) const {
  const LocalField& field = fields_[field_of_[dab]];
  const Place place = at(dab, point_mm);
  Foot foot{place.bands, point_mm, {}};
  const double rise = length(place.rise);
  if (rise < kLeastRise) return foot;
  foot.up = place.rise / rise;
  // As a distance rises: by what it is nearer to the form, for at the rim of the band it is flat.
  foot.point_mm -= (place.bands * band_mm_) * foot.up;
  for (int step = 0; step < 2; ++step) {
    foot.point_mm -= value(field, foot.point_mm / field.voxel_mm) * foot.up;
  }
  return foot;
}

/// Trilinear; beyond the field as at its rim.
double FormField::value(const LocalField& field, const Vec3& nodes) const {
  const Coord dim = field.box.dim();
  const Coord& first = field.box.min();
  std::size_t low[3];
  double part[3];
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    const double last = dim[axis] - 1.0;
    const double at = std::clamp(nodes[a] - first[axis], 0.0, last);
    const double floor = std::min(std::floor(at), last - 1.0);
    low[a] = static_cast<std::size_t>(floor);
    part[a] = at - floor;
  }
  const auto rows = static_cast<std::size_t>(dim.z());
  const std::size_t plane = static_cast<std::size_t>(dim.y()) * rows;
  const float* at = field.value.data() + low[0] * plane + low[1] * rows + low[2];
  const auto along_z = [&](const float* row) {
    return static_cast<double>(row[0]) * (1.0 - part[2]) + static_cast<double>(row[1]) * part[2];
  };
  const auto along_y = [&](const float* row) {
    return along_z(row) * (1.0 - part[1]) + along_z(row + rows) * part[1];
  };
  return along_y(at) * (1.0 - part[0]) + along_y(at + plane) * part[0];
}

}  // namespace argil
