// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "argil/core/window_channel.h"
#include "argil/haptics/force/lattice_force.h"

#include "haptics/force/fields.h"

namespace argil::haptics::fields {

/// Publishes a window of an analytic field as the clay's thread publishes one of clay.
class AnalyticPublisher {
 public:
  explicit AnalyticPublisher(WindowChannel& channel) : channel_(channel) {}

  /// Comes with every window.
  SurfaceDetail detail;

  void publish(const Distance& field, const ForceTool& tool, double margin_mm = 4.0,
               std::uint64_t answers = 0, double time_s = 0.0) {
    const Lattice lattice = choose_lattice(tool);
    const Window window = sampled(field, tool.position_mm,
                                  window_reach_mm(tool, lattice, margin_mm), lattice.voxel_mm);
    WindowSlot& slot = channel_.write_slot();
    slot.origin_mm = window.view.origin_mm;
    slot.voxel_mm = window.view.voxel_mm;
    slot.nodes = window.view.nodes;
    std::copy(window.values.begin(), window.values.end(), slot.distance_mm.begin());
    slot.sequence = ++sequence_;
    slot.detail = detail;
    slot.answers = answers;
    slot.time_s = time_s;
    slot.checksum = window_checksum(slot.view());
    channel_.publish();
  }

 private:
  WindowChannel& channel_;
  std::uint64_t sequence_ = 0;
};

}  // namespace argil::haptics::fields
