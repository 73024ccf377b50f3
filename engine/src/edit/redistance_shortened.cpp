// SPDX-License-Identifier: GPL-3.0-or-later
// Beyond the ends of what an offset shrank, values run along the medial axis of what was there
// before and rise too slowly; from there they reach the nodes beside. Those are solved again, from
// all others, which stay (edit/short_nodes.h). Coarse levels first: what a level ends at is told by
// the next coarser one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "edit/distance_sweeps.h"
#include "edit/redistance.h"
#include "edit/short_nodes.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// What was there was never too long, and where it is right it is more exact than what is solved:
/// a solution counts where it is farther by more than it is off.
constexpr float kLeastGain = 1.02F;
constexpr float kLeastGainVoxels = 0.03F;

/// Whether a solution is so much farther than what was there. The band cuts it short.
bool is_gain(const LevelEdit& edit, float before, float solved) noexcept {
  const float from = std::abs(before);
  const float to = std::abs(solved);
  if (to - from < kLeastGainVoxels * static_cast<float>(edit.voxel_mm())) return false;
  return to >= edit.band_mm() || to > kLeastGain * from;
}

/// Puts the nodes to the end of the band, so that distances come to them from the others alone.
void clear_short(LevelEdit& edit, const ShortNodes& nodes, LeafEdit& leaf) {
  float* now = leaf.write();
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    if ((nodes.rows[n / kLeafSide] >> n % kLeafSide & 1) == 0) continue;
    now[n] = std::copysign(edit.band_mm(), now[n]);
  }
}

/// Takes back what was solved but gained too little.
void keep_gains(const LevelEdit& edit, LeafEdit& leaf) {
  float* now = leaf.write();
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    if (!is_gain(edit, leaf.before()[n], now[n])) now[n] = leaf.before()[n];
  }
}

/// False: asked to stop.
bool solve_short(LevelEdit& edit, const std::vector<ShortNodes>& nodes,
                 const std::function<bool()>& goes_on) {
  std::vector<SweptLeaf> swept(nodes.size());
  for_each_leaf(nodes.size(), [&](std::size_t n) {
    swept[n] = {edit.find(nodes[n].origin), nodes[n].rows, {}};
    clear_short(edit, nodes[n], *swept[n].leaf);
  });
  if (!sweep_distances(edit, swept, goes_on)) return false;
  for_each_leaf(swept.size(), [&](std::size_t n) { keep_gains(edit, *swept[n].leaf); });
  edit.mark_changes();
  return true;
}

}  // namespace

bool redistance_shortened(LevelStack& stack, bool is_outside, const Progress& progress) {
  EditMemory memory;
  EditTarget target{stack, memory, 0.0, [](const LeafChange&, const float*, float) {},
                    std::numeric_limits<std::int64_t>::max()};
  for (int level = stack.top(); level >= 0; --level) {
    const double done = static_cast<double>(stack.top() - level) / stack.count();
    const auto goes_on = [&] { return !progress || progress("redistance", done); };
    if (!goes_on()) return false;
    const std::vector<ShortNodes> nodes = find_short_nodes(stack, level, is_outside);
    if (nodes.empty()) continue;
    Edit edit(target);
    for (const ShortNodes& leaf : nodes) edit.want(level, leaf.origin);
    edit.load();
    if (!solve_short(edit.level(level), nodes, goes_on)) return false;
    edit.commit();
  }
  return true;
}

}  // namespace argil
