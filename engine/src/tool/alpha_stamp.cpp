// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/alpha_stamp.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "tool/emboss_size.h"
#include "tool/turns.h"

namespace argil {
namespace {

/// Before and behind its plane a stamp is whole so far, in radii.
constexpr double kWholeDepth = 0.6;
constexpr double kMostDepth = kEmbossDepth;
/// Of the cosine between the form's normal and the stamp's.
constexpr double kWholeFacing = 0.4;
constexpr double kLeastFacing = 0.1;

double smooth_step(double t) noexcept {
  const double held = std::clamp(t, 0.0, 1.0);
  return held * held * (3.0 - 2.0 * held);
}

/// Sides in units of the larger one.
struct Proportions {
  double wide = 1.0;
  double high = 1.0;
};

Proportions proportions(const AlphaImage* image) noexcept {
  if (image == nullptr) return {};
  const double most = std::max(image->width(), image->height());
  return {image->width() / most, image->height() / most};
}

/// Quarter turns exactly, so that they repeat an image to the bit.
SineCosine of_degrees(double degrees) noexcept {
  constexpr std::array<SineCosine, 4> kQuarters{
      SineCosine{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}};
  const double quarters = degrees / 90.0;
  if (quarters != std::floor(quarters)) return of_turns(degrees / 360.0);
  return kQuarters[static_cast<std::size_t>(static_cast<int>(quarters) & 3)];
}

double fraction(double value) noexcept { return value - std::floor(value); }

}  // namespace

AlphaStamp::AlphaStamp(const PosedTool& tool, const Vec3& normal, const Vec3& right,
                       double voxel_mm)
    : tool_(tool),
      image_(tool.tool().alpha),
      is_tiled_(image_ != nullptr && tool.tool().alpha_mode == AlphaMode::tiled),
      normal_(normal),
      height_mm_(tool.strength() * emboss_ratio(tool.tool()) * tool.smallest_radius_mm()),
      mid_level_(tool.tool().mid_level) {
  assert(std::abs(length(normal) - 1.0) < 1e-6);
  const Tool& as_set = tool.tool();
  const Vec3 across = normalized(right - dot(normal, right) * normal);
  const Vec3 along = (tool.dab().is_mirrored ? -1.0 : 1.0) * cross(normal, across);
  const auto [sine, cosine] = of_degrees(as_set.angle_deg);
  right_ = cosine * across + sine * along;
  up_ = cosine * along - sine * across;
  const Proportions sides = proportions(image_.get());
  const Proportions tip = is_tiled_ ? Proportions{} : sides;
  half_right_mm_ = tip.wide * tool.radii_mm().x;
  half_up_mm_ = tip.high * tool.radii_mm().y;
  rim_mm_ = as_set.tip_roundness * std::min(half_right_mm_, half_up_mm_);
  if (image_ == nullptr) return;
  const double sized = tool.smallest_radius_mm() / smallest_radius(as_set);
  const double pixel = emboss_pixel_mm(as_set) * (is_tiled_ ? 1.0 : sized);
  layer_ = image_->layer_of(voxel_mm / pixel);
  cosine_ = cosine;
  sine_ = sine;
  tile_right_mm_ = sides.wide * emboss_tile_mm(as_set);
  tile_up_mm_ = sides.high * emboss_tile_mm(as_set);
}

AlphaStamp::Place AlphaStamp::place_of(const Vec3& foot_mm) const noexcept {
  const Dab& dab = tool_.dab();
  Vec3 from = foot_mm - dab.at.position_mm;
  if (is_tiled_) {  // from the nearest place of its path
    const Vec3 path = dab.from.position_mm - dab.at.position_mm;
    const double square = dot(path, path);
    if (square > 0.0) from -= std::clamp(dot(from, path) / square, 0.0, 1.0) * path;
  }
  return {dot(from, right_), dot(from, up_), dot(from, normal_)};
}

/// How much of the image counts: 1 within the rim.
double AlphaStamp::weight(const Place& place, const Vec3& up) const noexcept {
  // Most of a stroke's stamps are elsewhere.
  if (std::abs(place.right) >= half_right_mm_ || std::abs(place.up) >= half_up_mm_) return 0.0;
  const double facing =
      smooth_step((dot(up, normal_) - kLeastFacing) / (kWholeFacing - kLeastFacing));
  if (facing <= 0.0) return 0.0;
  const double depth = std::abs(place.above) / tool_.radii_mm().z;
  Vec3 q{0.0, 0.0, std::max(0.0, depth - kWholeDepth) / (kMostDepth - kWholeDepth)};
  if (is_tiled_) {
    const double x = place.right / half_right_mm_;
    const double y = place.up / half_up_mm_;
    const double rim = tool_.tool().tip_roundness;
    q.x = std::max(0.0, std::sqrt(x * x + y * y) - (1.0 - rim)) / rim;
  } else {
    q.x = std::max(0.0, std::abs(place.right) - (half_right_mm_ - rim_mm_)) / rim_mm_;
    q.y = std::max(0.0, std::abs(place.up) - (half_up_mm_ - rim_mm_)) / rim_mm_;
  }
  const double rest = std::max(0.0, 1.0 - dot(q, q));
  return facing * rest * rest;
}

double AlphaStamp::tiled_grey(const Vec3& foot_mm, const Vec3& up) const noexcept {
  const Vec3 at = unturned(tool_.dab(), foot_mm);
  const Vec3 facing = unturned(tool_.dab(), up);
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Nothing where it faces the axis at more than 63 degrees; one axis at least is within 55.
    const double within = std::max(0.0, facing[axis] * facing[axis] - 0.2);
    if (within <= 0.0) continue;
    // As seen from outside with z up, or y where z points at who looks.
    const double side = facing[axis] < 0.0 ? -1.0 : 1.0;
    const double u = side * (axis == 0 ? at.y : axis == 1 ? -at.x : at.x);
    const double v = axis == 2 ? at.y : at.z;
    const double right = cosine_ * u + sine_ * v;
    const double above = cosine_ * v - sine_ * u;
    sum += within * within *
           image_->at(layer_, fraction(right / tile_right_mm_), fraction(-above / tile_up_mm_),
                      AlphaImage::Beyond::repeat);
    weights += within * within;
  }
  return sum / weights;
}

double AlphaStamp::grey(const Vec3& foot_mm, const Place& place, const Vec3& up) const noexcept {
  if (image_ == nullptr) return 1.0;
  if (is_tiled_) return tiled_grey(foot_mm, up);
  return image_->at(layer_, 0.5 + 0.5 * place.right / half_right_mm_,
                    0.5 - 0.5 * place.up / half_up_mm_, AlphaImage::Beyond::edge);
}

double AlphaStamp::height_mm(const Vec3& foot_mm, const Vec3& up) const noexcept {
  const Place place = place_of(foot_mm);
  const double counts = weight(place, up);
  if (counts <= 0.0) return 0.0;
  return counts * height_mm_ * (grey(foot_mm, place, up) - mid_level_);
}

HeightRange AlphaStamp::heights_mm(const Vec3& foot_mm, const Vec3& up,
                                   double radius_mm) const noexcept {
  const Place place = place_of(foot_mm);
  if (std::abs(place.above) - radius_mm > kMostDepth * tool_.radii_mm().z) return {};
  if (std::abs(place.right) - radius_mm > half_right_mm_) return {};
  if (std::abs(place.up) - radius_mm > half_up_mm_) return {};
  AlphaImage::Range range{1.0, 1.0};
  if (is_tiled_) {
    range = image_->range();
  } else if (image_ != nullptr) {
    const double x = 0.5 + 0.5 * place.right / half_right_mm_;
    const double y = 0.5 - 0.5 * place.up / half_up_mm_;
    const double wide = 0.5 * radius_mm / half_right_mm_;
    const double high = 0.5 * radius_mm / half_up_mm_;
    range = image_->range(layer_, x - wide, y - high, x + wide, y + high);
  }
  const double least = height_mm_ * (range.least - mid_level_);
  const double most = height_mm_ * (range.most - mid_level_);
  HeightRange heights{std::min(least, most), std::max(least, most)};
  // Where all of that is within the rim and faces the stamp, nothing is lower.
  constexpr double kSurelyFacing = 0.8;
  const bool is_whole = !is_tiled_ && dot(up, normal_) > kSurelyFacing &&
                        std::abs(place.right) + radius_mm < half_right_mm_ - rim_mm_ &&
                        std::abs(place.up) + radius_mm < half_up_mm_ - rim_mm_ &&
                        std::abs(place.above) + radius_mm < kWholeDepth * tool_.radii_mm().z;
  if (!is_whole) heights = {std::min(0.0, heights.least), std::max(0.0, heights.most)};
  return heights;
}

}  // namespace argil
