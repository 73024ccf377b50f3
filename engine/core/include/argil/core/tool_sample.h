// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/spsc_ring.h"
#include "argil/core/vec3.h"

namespace argil {

/// What the servo tells the clay's thread some hundred times a second: where the tool is, whether
/// it works the clay, and which window the next forces need. Trivially copyable, so that the ring
/// between them copies it without a lock or an allocation.
///
/// Ranges are those of StrokeSample and WindowRequest, which the clay's thread makes of it: what is
/// out of them is an error of ClayWorker::step, not of the servo.
struct ToolSample {
  /// 1, 2, 3 ...; a gap where the ring was full. WindowSlot::answers names it.
  std::uint64_t index = 0;
  /// The servo's clock, in seconds from wherever it began; not decreasing within a stroke.
  double time_s = 0.0;
  /// The tool's centre, in the clay's frame; no coordinate beyond kMaxReachMm.
  Vec3 position_mm;
  /// Of unit length.
  Quat orientation;
  /// 0 to 1; multiplies the tool's strength.
  double pressure = 0.0;
  /// The tool works: from the first such sample to the last is a stroke.
  bool is_active = false;

  // The window that is wanted, as WindowRequest has it; centred on position_mm.
  /// Spacing of its nodes; usually a quarter of the tool's radius.
  double voxel_mm = 0.0;
  /// What it covers to every side of the centre; at most kMostWindowReachVoxels * voxel_mm.
  double reach_mm = 0.0;
  /// How far from the surface, to either side, the distance must be known.
  double depth_mm = 0.0;
  /// With the detail of the surface that the window is too coarse for (SurfaceDetail).
  bool wants_detail = false;
};

/// Servo to clay: in order, nothing waits; samples are dropped and counted when it is full.
using ToolSampleRing = SpscRing<ToolSample>;

}  // namespace argil
