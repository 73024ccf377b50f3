// SPDX-License-Identifier: GPL-3.0-or-later
// Feels a plane of clay with a ball, using only the installed argil::haptics.
#include <cstdio>
#include <vector>

#include "argil/haptics/force/tool_force.h"

int main() {
  constexpr int kSide = 33;
  constexpr double kVoxelMm = 0.25;
  std::vector<float> distance_mm;
  for (int i = 0; i < kSide * kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      distance_mm.push_back(static_cast<float>((k - kSide / 2) * kVoxelMm));
    }
  }
  argil::FieldWindowView window;
  const double corner = -(kSide / 2) * kVoxelMm;
  window.origin_mm = {corner, corner, corner};
  window.voxel_mm = kVoxelMm;
  window.nodes = {kSide, kSide, kSide};
  window.distance_mm = distance_mm;

  const argil::haptics::ForceTool tool;  // a ball of 1 mm, its centre on the surface
  const argil::haptics::ForceResult felt = argil::haptics::volume_force(
      window, tool, argil::haptics::ForceMaterial{}, argil::haptics::ForceLaw::energy);
  std::printf("force_n %.6f %.6f %.6f\n", felt.contact_n.x, felt.contact_n.y, felt.contact_n.z);
  return felt.contact_n.z > 0.0 && !felt.outside_window ? 0 : 1;  // clay below pushes up
}
