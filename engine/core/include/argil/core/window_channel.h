// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/surface_detail.h"
#include "argil/core/triple_buffer.h"
#include "argil/core/vec3.h"

namespace argil {

/// Most nodes of a window that the servo reads: 1 MiB of floats. Four slots fit into the
/// third-level cache of any machine of interest, the part under a tool into the first or second.
inline constexpr std::size_t kWindowCapacity = std::size_t{64} * 64 * 64;

/// A cube of this half side, in voxels, has at most 64 nodes a side wherever its centre lies: it
/// begins at the last node before and ends at the first one behind. WindowPublisher::publish
/// refuses more.
inline constexpr double kMostWindowReachVoxels = 31.0;
static_assert((2 * 31 + 2) * (2 * 31 + 2) * (2 * 31 + 2) <= kWindowCapacity);

/// A window on its way from the clay's thread to the servo's. All memory is there from the start,
/// 1 MiB for each slot: filling and reading one never allocates.
///
/// Threads  the one that has the slot, as TripleBuffer says.
struct WindowSlot {
  /// 0 as long as nothing was published; then 1, 2, 3 without a gap.
  std::uint64_t sequence = 0;
  /// window_checksum of the view: tells a torn window from a whole one. The servo does not spend
  /// its time on it; the tests of servo and clay together do (ServoRealtime).
  std::uint64_t checksum = 0;

  // Place, spacing, shape and error, each as FieldWindowView has it.
  Vec3 origin_mm;
  double voxel_mm = 0.0;
  std::array<int, 3> nodes{};
  int level = 0;
  double distance_error_mm = 0.0;

  // What the window answers, so that the servo knows how old it is. Not under the checksum, which
  // is for the field: they are a label and not read by a force.
  /// Index of the newest ToolSample taken into account; 0: none.
  std::uint64_t answers = 0;
  /// That sample's time_s, on the servo's clock.
  double time_s = 0.0;

  /// What the window is too coarse for, where it was asked for. Not under the checksum either.
  SurfaceDetail detail;

  /// Filled in part: the first nodes[0] * nodes[1] * nodes[2] values, which must fit.
  std::vector<float> distance_mm = std::vector<float>(kWindowCapacity);

  /// The window; all its `nodes` are 0 while `sequence` is 0.
  FieldWindowView view() const noexcept {
    const std::size_t count = static_cast<std::size_t>(nodes[0]) *
                              static_cast<std::size_t>(nodes[1]) *
                              static_cast<std::size_t>(nodes[2]);
    return {origin_mm, voxel_mm,         nodes, std::span(distance_mm).first(count),
            level,     distance_error_mm};
  }
};

/// Clay to servo: the newest window, older ones are skipped. Writer: the clay's thread. The servo
/// holds two, since it goes over from one to the next in some milliseconds (ServoForce).
using WindowChannel = TripleBuffer<WindowSlot, 2>;

/// Tells whether two windows have the same field.
///
/// Returns      xxh64 over place, spacing, error, sides, level and values, as they lie in memory.
/// Threads      Realtime: does not allocate.
/// Cost         about 15 us for 40^3 nodes.
/// Source       Hash64.
std::uint64_t window_checksum(const FieldWindowView& view) noexcept;

}  // namespace argil
