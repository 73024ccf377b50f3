// SPDX-License-Identifier: GPL-3.0-or-later
// Every leaf is checked by itself, in parallel; findings are merged so that the first in order is
// named whatever the threads did.
#include "clay/validate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "argil/engine/clay.h"

#include "edit/edit.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "edit/restriction.h"
#include "field/mask.h"
#include "field/nesting.h"
#include "field/prolongation.h"

namespace argil {
namespace {

/// Where the finer level does not surround a coarse node, dropping a leaf may have turned an
/// average into a single value: that may differ by a whole fine voxel at a crease.
constexpr float kInjectionTolerance = 1.0F;

/// A leaf that differs by less than this fraction of the tolerance should have been pruned. Half,
/// so that rounding and edits next door do not count.
constexpr double kIdleFraction = 0.5;

struct Finding {
  std::int64_t count = 0;
  int level = 0;
  Coord where;
};

/// Violations by kind; the first node in sorted order is kept, whatever the thread count.
class Findings {
 public:
  void add(const std::string& kind, int level, const Coord& where) {
    Finding& f = found_[kind];
    if (f.count == 0 || std::make_pair(level, where) < std::make_pair(f.level, f.where)) {
      f.level = level;
      f.where = where;
    }
    ++f.count;
  }
  void merge(const Findings& other) {
    for (const auto& [kind, theirs] : other.found_) {
      add(kind, theirs.level, theirs.where);
      found_[kind].count += theirs.count - 1;
    }
  }
  std::int64_t count() const {
    std::int64_t all = 0;
    for (const auto& entry : found_) all += entry.second.count;
    return all;
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> out;
    for (const auto& [kind, f] : found_) {
      std::ostringstream line;
      line << kind << ": " << f.count << ", first at level " << f.level << " node (" << f.where.x()
           << ", " << f.where.y() << ", " << f.where.z() << ")";
      out.push_back(line.str());
    }
    return out;
  }

 private:
  std::map<std::string, Finding> found_;
};

/// Finite, within the band, active exactly where the band is not reached, and not without any band.
void check_values(const LevelStack& stack, int level, const VdbLeaf& leaf, Findings& out) {
  const float band = stack.band_mm(level);
  for (openvdb::Index n = 0; n < kLeafNodes; ++n) {
    const float v = leaf.buffer().data()[n];
    if (!(std::abs(v) <= band))
      out.add("value beyond the band or not a number", level, leaf.origin());
    const bool active = std::abs(v) < band;
    if (active != leaf.isValueOn(n)) out.add("active mask wrong", level, leaf.origin());
  }
  if (is_empty(stack, level, leaf.origin())) {
    out.add("leaf without a band", level, leaf.origin());
  }
}

void check_nesting(const LevelStack& stack, int level, const Coord& origin, Findings& out) {
  const auto fault = nesting_fault(stack, level, origin);
  if (!fault) return;
  const bool alone = fault->kind == NestingFault::Kind::no_parent;
  out.add(alone ? "leaf without a parent" : "neighbours differ by more than one level", level,
          origin);
}

/// Where the finer level decides a node, the coarser one holds the restriction, within a tolerance:
/// what was refined and not edited since is not restricted again.
void check_restriction(const LevelStack& stack, int level, const Coord& origin, Findings& out) {
  if (level == 0) return;
  StackSource source(stack, level - 1);
  const FineLeaves around = fine_leaves(source, origin);
  if (!around.any_present) return;
  Restricted restricted;
  restrict_leaf(around, stack.band_mm(level - 1), restricted);
  const auto fine_voxel = static_cast<float>(stack.voxel_mm(level - 1));
  const float* values = stack.leaf(level, origin)->buffer().data();
  for (int n = 0; n < kLeafNodes; ++n) {
    const auto row = static_cast<std::size_t>(n >> 3);
    if ((restricted.decided[row] >> (n & 7) & 1) == 0) continue;
    const bool averaged = (restricted.averaged[row] >> (n & 7) & 1) != 0;
    const float allowed = averaged ? kRestrictionTolerance : kInjectionTolerance;
    const float expected = restricted.value[static_cast<std::size_t>(n)];
    if (!(std::abs(values[n] - expected) <= allowed * fine_voxel)) {
      out.add("coarse value is not the restriction", level,
              origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7));
    }
  }
}

/// A leaf that neither a finer leaf requires nor the coarsening criterion keeps should be gone.
void check_need(const LevelStack& stack, int level, const Coord& origin, double tolerance_mm,
                Findings& out) {
  if (level == stack.top()) return;
  if (level > 0 && required_by_finer(origin, [&](const Coord& fine) {
        return stack.has_leaf(level - 1, fine);
      })) {
    return;
  }
  const float* values = stack.leaf(level, origin)->buffer().data();
  CoarseningCriterion rule = coarsening_criterion(stack, level, kIdleFraction * tolerance_mm);
  rule.outer_mm *= static_cast<float>(kIdleFraction);
  const bool is_needed =
      coarser_misses(values, coarse_nodes(stack, level + 1, origin), rule) ||
      any_corner(origin, [&](const Coord& node) {
        return node_misses(stack.sample(level, node), stack.sample_above(level, node), rule);
      });
  if (!is_needed) {
    out.add("leaf that nothing needs", level, origin);
  }
}

/// A leaf's border nodes and the constant tile beyond them must lie on the same side.
void check_tiles(const LevelStack& stack, const VdbLeaf& leaf, Findings& out) {
  const int top = stack.top();
  for (int n = 0; n < kLeafNodes; ++n) {
    const Coord node = leaf.origin().offsetBy(n >> 6, (n >> 3) & 7, n & 7);
    const bool side = leaf.buffer().data()[n] < 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      for (int step = -1; step <= 1; step += 2) {
        Coord beyond = node;
        beyond[axis] += step;
        if (stack.has_leaf(top, beyond)) continue;
        if ((stack.grid(top).tree().getValue(beyond) < 0.0F) != side) {
          out.add("surface between a leaf and a constant tile", top, node);
        }
      }
    }
  }
}

void check_leaf(const LevelStack& stack, int level, const Coord& origin, double tolerance_mm,
                Findings& out) {
  const VdbLeaf& leaf = *stack.leaf(level, origin);
  check_values(stack, level, leaf, out);
  check_nesting(stack, level, origin, out);
  check_restriction(stack, level, origin, out);
  check_need(stack, level, origin, tolerance_mm, out);
  Coord where;
  if (out_of_gradient_bounds(stack, level, origin, &where))
    out.add("gradient outside [0.5, 2]", level, where);
  if (level == stack.top()) check_tiles(stack, leaf, out);
}

Findings check_leaves(const LevelStack& stack, const LeafList& leaves, double tolerance_mm) {
  tbb::enumerable_thread_specific<Findings> found;
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const auto& [level, origin] = leaves[n];
    if (!stack.has_leaf(level, origin)) return;
    check_leaf(stack, level, origin, tolerance_mm, found.local());
  });
  Findings all;
  for (const Findings& part : found) all.merge(part);
  return all;
}

/// A mask keeps nothing that its constant says as well.
void check_mask(const Mask& mask, const LevelStack& stack, Findings& out) {
  if (mask.is_nothing()) out.add("mask that holds nothing", 0, Coord(0));
  if (fault_of_mask(mask.grid(), kMaskVoxels * stack.voxel_mm(0)) != nullptr) {
    out.add("mask beyond 0 to 1 or on another lattice", 0, Coord(0));
  }
  for (const Coord& origin : mask.sorted_origins()) {
    const float* values = mask.leaf(origin);
    const bool is_needed = values == nullptr ? mask.constant(origin) != mask.elsewhere()
                                             : std::any_of(values, values + kLeafNodes,
                                                           [&](float v) { return v != values[0]; });
    if (!is_needed) out.add("place of the mask that one value stands for", 0, origin);
  }
}

}  // namespace

std::int64_t count_faults(const LevelStack& stack, const LeafList& leaves, double tolerance_mm) {
  return check_leaves(stack, leaves, tolerance_mm).count();
}

std::vector<std::string> Clay::validate() const {
  const LevelStack& stack = levels();
  Findings all =
      check_leaves(stack, all_leaves(stack), options().tolerance_voxels * options().voxel_mm);
  if (stack.mask() != nullptr) check_mask(*stack.mask(), stack, all);
  return all.lines();
}

}  // namespace argil
