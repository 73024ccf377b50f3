// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "argil/engine/stroke.h"

namespace argil::bench {

/// How far a tool's centre lies above the surface, in its radii: it digs in, or builds up, by half
/// its radius.
inline double height_of(Action action) {
  if (action == Action::carve) return 0.5;
  return action == Action::add ? -0.5 : 0.0;
}

/// The positions of a stroke's dabs: one sample for each dab of a tool, wandering over a ball from
/// below `up`.
inline std::vector<StrokeSample> wandering_samples(Vec3 up, const Tool& tool, double spacing,
                                                   double ball_mm, int dabs) {
  const double radius = smallest_radius(tool);
  const double away = ball_mm + height_of(tool.action) * radius;
  // A little more than the spacing, so that rounding never leaves a sample without its dab.
  const double step = 2.0 * std::asin(1.0001 * spacing * radius / (2.0 * away));
  up = normalized(up);
  Vec3 ahead = normalized(cross(up, Vec3{0.36, 0.48, 0.8}));
  std::vector<StrokeSample> samples(static_cast<std::size_t>(dabs));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time_s = 0.01 * static_cast<double>(i);
    samples[i].position_mm = away * up;
    const Vec3 there = up * std::cos(step) + ahead * std::sin(step);
    ahead = ahead * std::cos(step) - up * std::sin(step);
    up = normalized(there);
    const double bend = 0.1 * std::sin(0.3 * static_cast<double>(i));
    ahead = normalized(ahead * std::cos(bend) + cross(up, ahead) * std::sin(bend));
  }
  return samples;
}

}  // namespace argil::bench
