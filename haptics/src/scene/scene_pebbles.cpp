// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_pebbles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "scene/contact.h"
#include "scene/pebble_block.h"

namespace argil::haptics {
namespace {

/// The nearest sphere to a coordinate on a line of `count` spheres, and that sphere's neighbours.
struct Reach {
  int first = 0;
  int last = -1;
};

Reach reach_on_line(double from_middle_mm, int count, double spacing_mm) noexcept {
  assert(count >= 1 && spacing_mm > 0.0);
  const double index = from_middle_mm / spacing_mm + 0.5 * (count - 1);
  // Beyond the line's ends by more than a neighbour, and for NaN, there is none.
  if (!(index > -1.5 && index < count + 0.5)) {
    return {};
  }
  const int nearest = static_cast<int>(std::lround(index));
  return {std::max(nearest - 1, 0), std::min(nearest + 1, count - 1)};
}

/// What touching spheres do together: the sum of their forces and, along it, of their stiffness.
class Touching {
 public:
  void add(const SceneForce& one, const Vec3& normal) noexcept {
    assert(count_ < normals_.size());
    force_n_ += one.force_n;
    normals_[count_++] = normal;
  }

  SceneForce total(double stiffness_n_per_m) const noexcept {
    const Vec3 along = normalized(force_n_);
    double springs = 0.0;  // of one sphere each, along the force
    for (std::size_t n = 0; n < count_; ++n) {
      const double cosine = dot(normals_[n], along);
      springs += cosine * cosine;
    }
    SceneForce felt;
    felt.force_n = force_n_;
    felt.stiffness_n_per_m = springs * stiffness_n_per_m;
    return felt;
  }

 private:
  Vec3 force_n_;
  std::array<Vec3, PebblesScene::kMostCandidates> normals_;
  std::size_t count_ = 0;
};

}  // namespace

PebbleBlock pebble_block(const PebblesOptions& options, const Vec3& position_mm) noexcept {
  const Vec3 from_middle = position_mm - options.center_mm;
  if (!(std::abs(from_middle.z) < options.radius_mm)) {
    return {};
  }
  const Reach columns = reach_on_line(from_middle.x, options.columns, options.spacing_mm);
  const Reach rows = reach_on_line(from_middle.y, options.rows, options.spacing_mm);
  return {columns.first, columns.last, rows.first, rows.last};
}

PebblesScene::PebblesScene(const PebblesOptions& options) noexcept : options_(options) {
  assert(options.columns >= 1 && options.rows >= 1);
  assert(options.radius_mm > 0.0 && options.radius_mm <= 1.5 * options.spacing_mm);
  assert(options.stiffness_n_per_m >= 0.0 && options.damping_n_s_per_m >= 0.0);
}

Vec3 PebblesScene::sphere_center_mm(int column, int row) const noexcept {
  return options_.center_mm + Vec3{(column - 0.5 * (options_.columns - 1)) * options_.spacing_mm,
                                   (row - 0.5 * (options_.rows - 1)) * options_.spacing_mm, 0.0};
}

SceneForce PebblesScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const SpringDamper law{options_.stiffness_n_per_m, options_.damping_n_s_per_m};
  const PebbleBlock block = pebble_block(options_, at.position_mm);
  Touching touching;
  for (int row = block.first_row; row <= block.last_row; ++row) {
    for (int column = block.first_column; column <= block.last_column; ++column) {
      const Vec3 out = at.position_mm - sphere_center_mm(column, row);
      const double d = length(out);
      if (d < options_.radius_mm) {
        const Vec3 normal = normalized(out);
        touching.add(contact(law, options_.radius_mm - d, normal, at.velocity_mm_per_s), normal);
      }
    }
  }
  return touching.total(options_.stiffness_n_per_m);
}

}  // namespace argil::haptics
