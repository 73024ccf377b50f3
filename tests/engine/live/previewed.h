// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes with large tools on a ball, and their previews.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "argil/engine/preview.h"

#include "support/bumpy_clay.h"
#include "support/stroke_maker.h"

namespace argil::test {

/// Its finest level is everywhere.
inline constexpr double kPreviewBallMm = 7.0;
inline constexpr double kPreviewVoxelMm = 0.1;
inline Clay fine_ball() {
  auto made = bumpy_ball(kPreviewBallMm, kPreviewVoxelMm);
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

/// For a tool of 4 mm, 40 voxels, the preview is of level 1 with half as many voxels as usual.
inline constexpr double kPreviewToolMm = 4.0;
inline constexpr double kPreviewToolVoxels = 32.0;
inline constexpr int kPreviewSamples = 10;
inline Stroke large_stroke(Action action, int most_samples = kPreviewSamples) {
  Stroke stroke;
  // What is anchored moves all its way with each dab.
  const int samples = std::min(most_samples, is_anchored(action) ? 4 : kPreviewSamples);
  stroke.tool.action = action;
  stroke.tool.radii_mm = {kPreviewToolMm, kPreviewToolMm, kPreviewToolMm};
  stroke.tool.pressure_to_strength = 0.3;
  const double away = action == Action::carve ? kPreviewBallMm + 2.0 : kPreviewBallMm;
  for (int i = 0; i < samples; ++i) {
    const double turn = 0.12 * i;
    StrokeSample sample;
    sample.time_s = 0.01 * i;
    sample.position_mm = {away * std::cos(turn), away * std::sin(turn), 0.2 * i};
    sample.pressure = 0.6 + 0.04 * i;
    stroke.samples.push_back(sample);
  }
  return stroke;
}

/// What is drawn of a clay; of most of these tests, nothing.
inline DisplaySurface drawn_of(const Clay& clay) {
  DisplaySurface surface;
  EXPECT_TRUE(surface.update(clay).ok());
  return surface;
}
inline const DisplaySurface& not_drawn() {
  static const DisplaySurface nothing;
  return nothing;
}

inline Result<std::optional<Preview>> begin_preview(const Clay& clay, const Tool& tool,
                                                    const StrokeStyle& style = {},
                                                    double tool_voxels = kPreviewToolVoxels) {
  return Preview::begin(clay, not_drawn(), tool, style, tool_voxels);
}

inline Preview preview_of(const Clay& clay, const Stroke& stroke,
                          const DisplaySurface& shown = not_drawn()) {
  auto made = Preview::begin(clay, shown, stroke.tool, stroke, kPreviewToolVoxels);
  EXPECT_TRUE(made.ok());
  EXPECT_TRUE(made.value().has_value());
  return std::move(*made.value());
}

/// The preview after all of a stroke.
inline Preview previewed(const Clay& clay, const Stroke& stroke) {
  Preview preview = preview_of(clay, stroke);
  EXPECT_TRUE(preview.extend(stroke.samples).ok());
  EXPECT_TRUE(preview.end().ok());
  EXPECT_TRUE(preview.update_surface().ok());
  return preview;
}

inline double voxel_of(const Preview& preview) { return preview.clay().options().voxel_mm; }

}  // namespace argil::test
