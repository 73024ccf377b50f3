// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/spsc_ring.h"
#include "argil/core/vec3.h"

namespace argil {

/// What the servo tells the clay's thread some hundred times a second: where the tool is, whether
/// it works the clay, and which window the next forces need. Trivially copyable.
struct ToolSample {
  std::uint64_t index = 0;  ///< 1, 2, 3 ...; a gap where the ring was full
  double time_s = 0.0;      ///< the servo's clock; not decreasing
  Vec3 position_mm;         ///< of the tool's centre, in the clay's frame
  Quat orientation;         ///< unit length
  double pressure = 0.0;    ///< 0 to 1; multiplies the tool's strength
  bool is_active = false;   ///< the tool works: from the first such sample to the last is a stroke

  // The window that is wanted, as WindowRequest has it; centred on position_mm.
  double voxel_mm = 0.0;
  double reach_mm = 0.0;
  double depth_mm = 0.0;
};

/// Servo to clay: in order, nothing waits; samples are dropped and counted when it is full.
using ToolSampleRing = SpscRing<ToolSample>;

}  // namespace argil
