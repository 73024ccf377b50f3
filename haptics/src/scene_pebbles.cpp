// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_pebbles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "contact.h"

namespace argil::haptics {
namespace {

/// The place of a coordinate on a line of `count` spheres: its nearest sphere and the neighbours.
struct Reach {
  int first = 0;
  int last = -1;
};

Reach reach_on_line(double from_middle_mm, int count, double spacing_mm) noexcept {
  const double place = from_middle_mm / spacing_mm + 0.5 * (count - 1);
  // A place that is off the line by more than a neighbour, or no number, has none.
  if (!(place > -1.5 && place < count + 0.5)) {
    return {};
  }
  const int nearest = static_cast<int>(std::lround(place));
  return {std::max(nearest - 1, 0), std::min(nearest + 1, count - 1)};
}

/// What touching spheres do together: the sum of their forces and, along it, of their stiffness.
class Touching {
 public:
  void add(const SceneForce& one, const Vec3& normal) noexcept {
    force_n_ += one.force_n;
    normals_[count_++] = normal;
  }

  SceneForce total(double stiffness_n_per_m) const noexcept {
    const Vec3 along = normalized(force_n_);
    double share = 0.0;
    for (std::size_t n = 0; n < count_; ++n) {
      const double cosine = dot(normals_[n], along);
      share += cosine * cosine;
    }
    SceneForce felt;
    felt.force_n = force_n_;
    felt.stiffness_n_per_m = share * stiffness_n_per_m;
    return felt;
  }

 private:
  Vec3 force_n_;
  std::array<Vec3, PebblesScene::kMostCandidates> normals_;
  std::size_t count_ = 0;
};

}  // namespace

PebblesScene::PebblesScene(const PebblesOptions& options) noexcept : options_(options) {
  assert(options.columns >= 1 && options.rows >= 1);
  assert(options.radius_mm > 0.0 && options.radius_mm <= 1.5 * options.spacing_mm);
}

PebblesScene::Block PebblesScene::block_at(const Vec3& position_mm) const noexcept {
  const Vec3 from_middle = position_mm - options_.center_mm;
  if (!(std::abs(from_middle.z) < options_.radius_mm)) {
    return {};
  }
  const Reach columns = reach_on_line(from_middle.x, options_.columns, options_.spacing_mm);
  const Reach rows = reach_on_line(from_middle.y, options_.rows, options_.spacing_mm);
  return {columns.first, columns.last, rows.first, rows.last};
}

int PebblesScene::candidates_at(const Vec3& position_mm) const noexcept {
  const Block block = block_at(bounded(position_mm));
  return std::max(block.last_column - block.first_column + 1, 0) *
         std::max(block.last_row - block.first_row + 1, 0);
}

Vec3 PebblesScene::sphere_center_mm(int column, int row) const noexcept {
  return options_.center_mm + Vec3{(column - 0.5 * (options_.columns - 1)) * options_.spacing_mm,
                                   (row - 0.5 * (options_.rows - 1)) * options_.spacing_mm, 0.0};
}

SceneForce PebblesScene::force_at(const HandleState& place) const noexcept {
  const HandleState at = bounded(place);
  const SpringDamper law{options_.stiffness_n_per_m, options_.damping_n_s_per_m};
  const Block block = block_at(at.position_mm);
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
