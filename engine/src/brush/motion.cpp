// SPDX-License-Identifier: GPL-3.0-or-later
// Backward advection: a node asks where its matter came from and takes the value there. Sources
// that lie close together are read from a dense copy, others straight from the stack.
#include "brush/motion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "brush/dab_plan.h"
#include "brush/local_field.h"
#include "edit/redistance.h"
#include "field/parallel.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

/// Sources farther apart than this are read one by one: about 1 MB.
constexpr double kMostGathered = 64.0 * 64.0 * 64.0;

/// The node at or below a point along each axis.
Coord node_below(const Vec3& point_mm, double voxel_mm) {
  return {static_cast<int>(std::floor(point_mm.x / voxel_mm)),
          static_cast<int>(std::floor(point_mm.y / voxel_mm)),
          static_cast<int>(std::floor(point_mm.z / voxel_mm))};
}

/// Leaves of a finer level go with their matter: to all leaves that the images of 27 of a leaf's
/// nodes span.
void want_images(Edit& edit, const Motion& motion, int level, double voxel, const Coord& origin) {
  CoordBBox box;
  for (int i = 0; i < 27; ++i) {
    const Coord node = origin.offsetBy(4 * (i / 9), 4 * (i / 3 % 3), 4 * (i % 3));
    box.expand(node_below(motion.image(node_mm(node, voxel)), voxel));
  }
  box.expand(4);
  for_each_leaf_origin(box, [&](const Coord& at) { edit.want(level, at); });
}

/// What the regions reach on all levels, and where the finer leaves among them go.
void plan(Edit& edit, const LevelStack& stack, const Motion& motion, int tool_level) {
  const std::vector<Box3> regions = motion.regions_mm();
  for (const Box3& region : regions) {
    want_reached(edit, stack, region, tool_level, [](int, const Coord&) { return true; });
  }
  for (int level = 0; level < tool_level; ++level) {
    std::vector<Coord> moved;
    for (const Box3& region : regions) {
      const std::vector<Coord> leaves =
          leaves_in(stack, level, reached_nodes(region, stack.voxel_mm(level)));
      moved.insert(moved.end(), leaves.begin(), leaves.end());
    }
    std::sort(moved.begin(), moved.end());
    moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
    for (const Coord& origin : moved) {
      want_images(edit, motion, level, stack.voxel_mm(level), origin);
    }
  }
  edit.load();
}

/// Sources are found first, since their spread decides how they are read; nodes that are their own
/// source keep their bits.
void move_leaf(const LevelStack& stack, int level, const Motion& motion, LeafEdit& leaf) {
  const double voxel = stack.voxel_mm(level);
  const float band = stack.band_mm(level);
  std::array<Vec3, kLeafNodes> source;
  Box3 sources;
  bool is_moved = false;
  for (int n = 0; n < kLeafNodes; ++n) {
    const Vec3 here = node_mm(leaf.origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7), voxel);
    Vec3& from = source[static_cast<std::size_t>(n)];
    from = motion.source(here);
    is_moved = is_moved || from != here;
    assert(is_finite(from));
    sources.include(from);
  }
  if (!is_moved) return;
  const Vec3 span = sources.size() / voxel;
  const bool gathers = (span.x + 6) * (span.y + 6) * (span.z + 6) < kMostGathered;
  LocalField field;
  if (gathers) {
    const CoordBBox box(node_below(sources.min, voxel).offsetBy(-1),
                        node_below(sources.max, voxel).offsetBy(3));
    field = local_field(stack, level, box);
  }
  float* now = leaf.write();
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const int m = static_cast<int>(n);
    const Vec3 here = node_mm(leaf.origin.offsetBy(m >> 6, (m >> 3) & 7, m & 7), voxel);
    if (source[n] == here) continue;
    const float value = gathers ? field.cubic_at(source[n]) : cubic_sample(stack, level, source[n]);
    now[n] = std::clamp(value, -band, band);
  }
}

}  // namespace

void move_matter(EditTarget& target, const Motion& motion, int tool_level) {
  assert(target.stack.is_level(tool_level));
  Edit edit(target);
  plan(edit, target.stack, motion, tool_level);
  for (int level = 0; level <= tool_level; ++level) {
    std::vector<LeafEdit>& leaves = edit.level(level).leaves();
    for_each_leaf(leaves.size(),
                  [&](std::size_t n) { move_leaf(target.stack, level, motion, leaves[n]); });
  }
  solve_stamped(edit);
  edit.drop_empty();
  edit.commit();
}

}  // namespace argil
