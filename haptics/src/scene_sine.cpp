// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_sine.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "contact.h"

namespace argil::haptics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// `value` in [0, period).
double wrapped(double value, double period) noexcept {
  return value - period * std::floor(value / period);
}

}  // namespace

SineScene::SineScene(const SineOptions& options)
    : options_(options),
      omega_x_per_mm_(kTurn * kMPerMm * options.frequency_x_per_m),
      omega_y_per_mm_(kTurn * kMPerMm * options.frequency_y_per_m),
      period_x_mm_(kTurn / omega_x_per_mm_),
      period_y_mm_(kTurn / omega_y_per_mm_) {
  if (options.normal != SineNormal::table_nearest && options.normal != SineNormal::table_bilinear) {
    return;
  }
  count_x_ = std::lround(std::ceil(period_x_mm_ / options.table_step_mm));
  count_y_ = std::lround(std::ceil(period_y_mm_ / options.table_step_mm));
  table_.reserve(static_cast<std::size_t>(count_x_ * count_y_));
  for (long i = 0; i < count_x_; ++i) {
    for (long j = 0; j < count_y_; ++j) {
      const double x = period_x_mm_ * static_cast<double>(i) / static_cast<double>(count_x_);
      const double y = period_y_mm_ * static_cast<double>(j) / static_cast<double>(count_y_);
      table_.push_back(normalized(slope_normal(x, y)));
    }
  }
}

double SineScene::height_mm(double x_mm, double y_mm) const noexcept {
  return options_.offset_mm + options_.amplitude_mm * std::sin(omega_x_per_mm_ * x_mm) *
                                  std::cos(omega_y_per_mm_ * y_mm);
}

Vec3 SineScene::slope_normal(double x_mm, double y_mm) const noexcept {
  const double a = options_.amplitude_mm;
  const double px = omega_x_per_mm_ * x_mm;
  const double py = omega_y_per_mm_ * y_mm;
  return {-a * omega_x_per_mm_ * std::cos(px) * std::cos(py),  // eq. 3.20
          a * omega_y_per_mm_ * std::sin(px) * std::sin(py),   // eq. 3.21
          1.0};
}

const Vec3& SineScene::node(long i, long j) const noexcept {
  return table_[static_cast<std::size_t>((i % count_x_) * count_y_ + j % count_y_)];
}

Vec3 SineScene::table_normal(double x_mm, double y_mm, bool bilinear) const noexcept {
  const double u = wrapped(x_mm, period_x_mm_) / period_x_mm_ * static_cast<double>(count_x_);
  const double v = wrapped(y_mm, period_y_mm_) / period_y_mm_ * static_cast<double>(count_y_);
  if (!bilinear) return node(std::lround(u), std::lround(v));
  const long i = static_cast<long>(u);
  const long j = static_cast<long>(v);
  const double s = u - static_cast<double>(i);
  const double t = v - static_cast<double>(j);
  return normalized((1.0 - s) * ((1.0 - t) * node(i, j) + t * node(i, j + 1)) +
                    s * ((1.0 - t) * node(i + 1, j) + t * node(i + 1, j + 1)));
}

Vec3 SineScene::push_direction(double x_mm, double y_mm) const noexcept {
  switch (options_.normal) {
    case SineNormal::z_only:
      return {0.0, 0.0, 1.0};
    case SineNormal::unit:
      return normalized(slope_normal(x_mm, y_mm));
    case SineNormal::gradient:
      return slope_normal(x_mm, y_mm);
    case SineNormal::table_nearest:
    case SineNormal::table_bilinear:
      break;
  }
  return table_normal(x_mm, y_mm, options_.normal == SineNormal::table_bilinear);
}

SceneForce SineScene::force_at(const HandleState& place) const noexcept {
  const Vec3& p = place.position_mm;
  if (!is_finite(p)) return {};
  const double depth_mm = height_mm(p.x, p.y) - p.z;
  if (depth_mm <= 0.0) return {};
  const double push_n = kMPerMm * (options_.stiffness_n_per_m * depth_mm -
                                   options_.damping_n_s_per_m * place.velocity_mm_per_s.z);
  SceneForce felt;
  felt.force_n = std::max(push_n, 0.0) * push_direction(p.x, p.y);
  felt.stiffness_n_per_m = options_.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
