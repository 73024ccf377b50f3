// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_sine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "scene/contact.h"

namespace argil::haptics {

SineScene::SineScene(const SineOptions& options)
    : options_(options),
      wave_x_per_mm_(2.0 * std::numbers::pi * options.frequency_x_per_m / kMmPerM),
      wave_y_per_mm_(2.0 * std::numbers::pi * options.frequency_y_per_m / kMmPerM) {
  assert(options.amplitude_mm >= 0.0 && options.stiffness_n_per_m >= 0.0 &&
         options.damping_n_s_per_m >= 0.0 && options.difference_step_mm > 0.0);
  if (options.direction == SineDirection::table_nearest ||
      options.direction == SineDirection::table_bilinear) {
    make_table();
  }
}

void SineScene::make_table() {
  const double half = options_.table_half_width_mm;
  const double spacing = options_.table_spacing_mm;
  assert(spacing > 0.0 && half >= spacing);
  // Rounded up, so that the square is covered; a tiny slack keeps 80 / 0.1 at 800.
  table_side_ = 2 * static_cast<int>(std::ceil(half / spacing - 1e-9)) + 1;
  table_.reserve(static_cast<std::size_t>(table_side_) * static_cast<std::size_t>(table_side_));
  const int middle = table_side_ / 2;
  for (int row = 0; row < table_side_; ++row) {
    for (int column = 0; column < table_side_; ++column) {
      table_.push_back(
          normalized(normal_at((column - middle) * spacing, (row - middle) * spacing)));
    }
  }
}

double SineScene::height_mm(double x_mm, double y_mm) const noexcept {
  return options_.offset_mm +
         options_.amplitude_mm * std::sin(wave_x_per_mm_ * x_mm) * std::cos(wave_y_per_mm_ * y_mm);
}

Vec3 SineScene::normal_at(double x_mm, double y_mm) const noexcept {
  return height_and_normal(x_mm, y_mm).direction;
}

/// Each sine comes with its cosine from one call (sincos), which costs as much as one of them.
SineScene::Surface SineScene::height_and_normal(double x_mm, double y_mm) const noexcept {
  const double sin_x = std::sin(wave_x_per_mm_ * x_mm);
  const double cos_x = std::cos(wave_x_per_mm_ * x_mm);
  const double sin_y = std::sin(wave_y_per_mm_ * y_mm);
  const double cos_y = std::cos(wave_y_per_mm_ * y_mm);
  const double slope_x = options_.amplitude_mm * wave_x_per_mm_ * cos_x * cos_y;
  const double slope_y = -options_.amplitude_mm * wave_y_per_mm_ * sin_x * sin_y;
  return {options_.offset_mm + options_.amplitude_mm * sin_x * cos_y, {-slope_x, -slope_y, 1.0}};
}

const Vec3& SineScene::table(int column, int row) const noexcept {
  assert(column >= 0 && column < table_side_ && row >= 0 && row < table_side_);
  return table_[static_cast<std::size_t>(row) * static_cast<std::size_t>(table_side_) +
                static_cast<std::size_t>(column)];
}

Vec3 SineScene::nearest(double column, double row) const noexcept {
  return table(static_cast<int>(std::lround(column)), static_cast<int>(std::lround(row)));
}

Vec3 SineScene::bilinear(double column, double row) const noexcept {
  const int left = std::min(static_cast<int>(column), table_side_ - 2);
  const int low = std::min(static_cast<int>(row), table_side_ - 2);
  const double s = column - left;
  const double t = row - low;
  const Vec3 below = (1.0 - s) * table(left, low) + s * table(left + 1, low);
  const Vec3 above = (1.0 - s) * table(left, low + 1) + s * table(left + 1, low + 1);
  return normalized((1.0 - t) * below + t * above);
}

Vec3 SineScene::from_table(double x_mm, double y_mm) const noexcept {
  const double last = table_side_ - 1;
  const double column = x_mm / options_.table_spacing_mm + 0.5 * last;
  const double row = y_mm / options_.table_spacing_mm + 0.5 * last;
  if (!(column >= 0.0 && column <= last && row >= 0.0 && row <= last)) {
    return normalized(normal_at(x_mm, y_mm));
  }
  return options_.direction == SineDirection::table_nearest ? nearest(column, row)
                                                            : bilinear(column, row);
}

Vec3 SineScene::from_differences(double x_mm, double y_mm, double here_mm) const noexcept {
  const double step = options_.difference_step_mm;
  double rise_x = 0.0;
  double rise_y = 0.0;
  if (options_.direction == SineDirection::differences_central) {
    const double half = 0.5 * step;
    rise_x = height_mm(x_mm + half, y_mm) - height_mm(x_mm - half, y_mm);
    rise_y = height_mm(x_mm, y_mm + half) - height_mm(x_mm, y_mm - half);
  } else {
    rise_x = height_mm(x_mm + step, y_mm) - here_mm;
    rise_y = height_mm(x_mm, y_mm + step) - here_mm;
  }
  return normalized(Vec3{-rise_x / step, -rise_y / step, 1.0});
}

SineScene::Surface SineScene::surface_at(double x_mm, double y_mm) const noexcept {
  switch (options_.direction) {
    case SineDirection::z_only:
      return {height_mm(x_mm, y_mm), {0.0, 0.0, 1.0}};
    case SineDirection::unit_normal: {
      const Surface found = height_and_normal(x_mm, y_mm);
      return {found.height_mm, normalized(found.direction)};
    }
    case SineDirection::gradient:
      return height_and_normal(x_mm, y_mm);
    case SineDirection::table_nearest:
    case SineDirection::table_bilinear:
      return {height_mm(x_mm, y_mm), from_table(x_mm, y_mm)};
    case SineDirection::differences_ahead:
    case SineDirection::differences_central:
      break;
  }
  const double here_mm = height_mm(x_mm, y_mm);
  return {here_mm, from_differences(x_mm, y_mm, here_mm)};
}

Vec3 SineScene::direction_at(double x_mm, double y_mm) const noexcept {
  return surface_at(x_mm, y_mm).direction;
}

SceneForce SineScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const Vec3& p = at.position_mm;
  const Surface surface = surface_at(p.x, p.y);
  const double depth = surface.height_mm - p.z;
  SceneForce felt;
  if (!(depth > 0.0)) {
    return felt;
  }
  const SpringDamper law{options_.stiffness_n_per_m, options_.damping_n_s_per_m};
  const Vec3& direction = surface.direction;
  // Along the unit normal the depth falls by |N| a millimetre, and N = (unit normal) / n_z.
  if (options_.direction == SineDirection::gradient) {
    felt.force_n = push_n(law, depth, dot(at.velocity_mm_per_s, direction)) * direction;
    felt.stiffness_n_per_m = law.stiffness_n_per_m * dot(direction, direction);
  } else {
    felt.force_n = push_n(law, depth, at.velocity_mm_per_s.z) * direction;
    felt.stiffness_n_per_m = law.stiffness_n_per_m / direction.z;
  }
  return felt;
}

}  // namespace argil::haptics
