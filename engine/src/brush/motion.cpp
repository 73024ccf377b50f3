// SPDX-License-Identifier: GPL-3.0-or-later
// Backward advection: a node asks where its matter came from and takes the value there. Sources
// that lie close together are read from a dense copy, others straight from the stack.
#include "brush/motion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "brush/dab_plan.h"
#include "brush/local_field.h"
#include "edit/filled_around.h"
#include "edit/redistance.h"
#include "field/parallel.h"
#include "field/prolongation.h"

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

/// The nodes that 27 of a leaf's, spread over it, are taken to, and four around.
template <class Where>
CoordBBox spanned_nodes(const Coord& origin, double voxel, const Where& where) {
  CoordBBox box;
  for (int i = 0; i < 27; ++i) {
    const Coord node = origin.offsetBy(4 * (i / 9), 4 * (i / 3 % 3), 4 * (i % 3));
    box.expand(node_below(where(node_mm(node, voxel)), voxel));
  }
  box.expand(4);
  return box;
}

/// Leaves of a finer level go with their matter.
void want_images(Edit& edit, const Motion& motion, int level, double voxel, const Coord& origin) {
  for_each_leaf_origin(motion.image_nodes(origin, voxel),
                       [&](const Coord& at) { edit.want(level, at); });
}

/// Whether a leaf is stored, or something within the band of its level may come to it. On the
/// coarsest level all count: one far from the surface may change sides.
bool may_come(const LevelStack& stack, const Motion& motion, int level, const Coord& origin) {
  if (level == stack.top() || stack.has_leaf(level, origin)) return true;
  bool comes = false;
  for_each_leaf_origin(motion.source_nodes(origin, stack.voxel_mm(level)),
                       [&](const Coord& at) { comes = comes || may_have_band(stack, level, at); });
  return comes;
}

/// What the regions reach on all levels, and where the finer leaves among them go.
void plan(Edit& edit, const LevelStack& stack, const Motion& motion, int tool_level) {
  const std::vector<Box3> regions = motion.regions_mm();
  for (const Box3& region : regions) {
    want_reached(edit, stack, region, tool_level, [&](int level, const Coord& origin) {
      return may_come(stack, motion, level, origin);
    });
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

/// The nodes between which the points lie that are asked for, and what Catmull-Rom reads around.
CoordBBox nodes_around(const Coord& origin, const PointBlock& points) {
  // One more above, since a point that is counted from the box's corner may be rounded up.
  const auto range = [&](const float* at) {
    std::array<float, kRowNodes> least;  // of each place along a row
    std::array<float, kRowNodes> most;
    least.fill(std::numeric_limits<float>::max());
    most.fill(std::numeric_limits<float>::lowest());
    for (std::size_t row = 0; row < kLeafRows; ++row) {
      if (!points.is_asked[row]) continue;
      const float* first = at + row * kRowNodes;
      for (std::size_t k = 0; k < kRowNodes; ++k) {
        least[k] = first[k] < least[k] ? first[k] : least[k];
        most[k] = first[k] > most[k] ? first[k] : most[k];
      }
    }
    return std::pair{
        static_cast<int>(std::floor(*std::min_element(least.begin(), least.end()))) - 1,
        static_cast<int>(std::floor(*std::max_element(most.begin(), most.end()))) + 3};
  };
  const auto [low_x, high_x] = range(points.x);
  const auto [low_y, high_y] = range(points.y);
  const auto [low_z, high_z] = range(points.z);
  return {origin.offsetBy(low_x, low_y, low_z), origin.offsetBy(high_x, high_y, high_z)};
}

/// Moves the leaves of one level. Values are read as they were before the edit.
class LevelMove {
 public:
  /// `is_solved`: the level is solved anew afterwards. `takes_sides`: only nodes that come to lie
  /// on the other side of the surface get a value.
  LevelMove(const LevelEdit& level, const Motion& motion, bool is_solved, bool takes_sides)
      : level_(level),
        motion_(motion),
        is_solved_(is_solved),
        takes_sides_(takes_sides),
        filled_(level, origins_of(level), FilledAround::Reach::around) {}

  /// Sources are found first, since their spread decides how they are read; nodes that are their
  /// own source keep their bits.
  void apply(LeafEdit& leaf) const {
    PointBlock source;
    motion_.sources(leaf.origin, level_.voxel_mm(), source);
    if (std::none_of(source.is_asked, source.is_asked + kLeafRows, [](bool is) { return is; })) {
      return;
    }
    const CoordBBox box = nodes_around(leaf.origin, source);
    const Vec3 span{1.0 * box.dim().x(), 1.0 * box.dim().y(), 1.0 * box.dim().z()};
    LeafValues now;
    std::copy_n(leaf.before(), kLeafNodes, now.begin());
    if (span.x * span.y * span.z < kMostGathered) {
      read_near(box, leaf.origin, source, now);
    } else {
      read_far(leaf.origin, source, now);
    }
    if (is_solved_) {
      clamp_to(level_.band_mm(), now);
    } else {
      trim(now);
    }
    if (takes_sides_) keep_sides(leaf.before(), now);
    leaf.write_all(now);
  }

 private:
  static std::vector<Coord> origins_of(const LevelEdit& level) {
    std::vector<Coord> origins;
    for (const LeafEdit& leaf : level.leaves()) origins.push_back(leaf.origin);
    return origins;
  }

  static void keep_sides(const float* before, LeafValues& now) {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if ((now[n] < 0.0F) == (before[n] < 0.0F)) now[n] = before[n];
    }
  }

  /// Beside the band's rim, where values end in a plateau, Catmull-Rom dips below it: what is
  /// nearly as far as the band is wide lies beyond it, else leaves come about that hold nothing.
  void trim(LeafValues& now) const {
    constexpr float kRimVoxels = 0.1F;
    const float band = level_.band_mm();
    const float rim = band - kRimVoxels * static_cast<float>(level_.voxel_mm());
    for (float& value : now) {
      value = value >= rim ? band : (value <= -rim ? -band : value);
    }
  }

  void read_near(const CoordBBox& box, const Coord& origin, const PointBlock& source,
                 LeafValues& now) const {
    std::vector<float> field(static_cast<std::size_t>(box.volume()));
    LevelEdit::Reader leaves(level_);
    FilledAround::Reader filled(filled_);
    for_each_leaf_origin(box, [&](const Coord& at) {
      LeafValues own;
      const float* values = leaves.filled_before(at);
      if (values == nullptr) values = filled.values(at);
      if (values == nullptr) {
        prolong_leaf(level_.stack(), level_.level(), at, own);
        values = own.data();
      }
      copy_into_box(at, values, box, field);
    });
    const Coord first = origin - box.min();
    const FieldJob job{field.data(),
                       {box.dim().x(), box.dim().y(), box.dim().z()},
                       {static_cast<float>(first.x()), static_cast<float>(first.y()),
                        static_cast<float>(first.z())},
                       1.0F};
    row_loops().read_cubic(job, source, now.data());
  }

  /// Node by node, straight from the stack.
  void read_far(const Coord& origin, const PointBlock& source, LeafValues& now) const {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (!source.is_asked[n / kRowNodes]) continue;
      const Vec3 here = node_mm(node_of(origin, n), level_.voxel_mm());
      const Vec3 from = motion_.source(here);
      if (from != here) now[n] = cubic_sample(level_.stack(), level_.level(), from);
    }
  }

  const LevelEdit& level_;
  const Motion& motion_;
  bool is_solved_;
  bool takes_sides_;
  FilledAround filled_;
};

}  // namespace

CoordBBox Motion::source_nodes(const Coord& origin, double voxel_mm) const {
  return spanned_nodes(origin, voxel_mm, [this](const Vec3& point) { return source(point); });
}

CoordBBox Motion::image_nodes(const Coord& origin, double voxel_mm) const {
  return spanned_nodes(origin, voxel_mm, [this](const Vec3& point) { return image(point); });
}

void Motion::stay(PointBlock& out) {
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Coord node = node_of({}, n);
    out.x[n] = static_cast<float>(node.x());
    out.y[n] = static_cast<float>(node.y());
    out.z[n] = static_cast<float>(node.z());
  }
  std::fill_n(out.is_asked, kLeafRows, false);
}

void Motion::sources(const Coord& origin, double voxel_mm, PointBlock& out) const {
  std::fill_n(out.is_asked, kLeafRows, false);
  const Vec3 first = node_mm(origin, voxel_mm);
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Vec3 here = node_mm(node_of(origin, n), voxel_mm);
    const Vec3 from = source(here);
    assert(is_finite(from));
    const Vec3 voxels = (from - first) / voxel_mm;
    const bool is_own = from == here;
    out.x[n] = is_own ? static_cast<float>(n / 64) : static_cast<float>(voxels.x);
    out.y[n] = is_own ? static_cast<float>(n / 8 % 8) : static_cast<float>(voxels.y);
    out.z[n] = is_own ? static_cast<float>(n % 8) : static_cast<float>(voxels.z);
    out.is_asked[n / kRowNodes] |= !is_own;
  }
}

void move_matter(EditTarget& target, const Motion& motion, int tool_level) {
  assert(target.stack.is_level(tool_level));
  Edit edit(target);
  plan(edit, target.stack, motion, tool_level);
  // Coarser levels get the restriction, but matter that is moved by more than the finer band would
  // leave a ghost of itself there, where no finer leaf is any more.
  for (int level = 0; level < edit.count(); ++level) {
    std::vector<LeafEdit>& leaves = edit.level(level).leaves();
    const bool is_solved = target.redistance_queue == nullptr;
    const LevelMove move(edit.level(level), motion, is_solved, level > tool_level);
    for_each_leaf(leaves.size(), [&](std::size_t n) { move.apply(leaves[n]); });
  }
  if (target.redistance_queue != nullptr) return commit_carried(target, edit);
  solve_stamped(edit);
  edit.drop_empty();
  edit.commit();
}

}  // namespace argil
