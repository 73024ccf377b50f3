// SPDX-License-Identifier: GPL-3.0-or-later
// How a clay is made symmetric to the bit: shapes when they start, images when their stroke ends.
#include <algorithm>
#include <cassert>
#include <new>
#include <utility>

#include "clay/clay_state.h"
#include "clay/validate.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "symmetry/symmetrise.h"

namespace argil {
namespace {

/// Those that stand for their images.
LeafList representatives(const LatticeSymmetry& symmetry, LeafList leaves) {
  std::erase_if(leaves,
                [&](const auto& leaf) { return !symmetry.is_representative_leaf(leaf.second); });
  return leaves;
}

/// And without repeats.
LeafList sorted(LeafList leaves) {
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

}  // namespace

/// A formula need not be a distance, so that nothing is redistanced here.
void Clay::State::make_symmetric() {
  assert(!open && !history.has_undo());
  UndoStep images;
  EditTarget target = target_into(images);
  const Mirror planes{is_symmetric(target, LatticeSymmetry({true, false, false}, {})),
                      is_symmetric(target, LatticeSymmetry({false, true, false}, {})),
                      is_symmetric(target, LatticeSymmetry({false, false, true}, {}))};
  const LatticeSymmetry symmetry(planes, {});
  if (symmetry.is_none()) return;
  symmetrise_all(target, symmetry);
  prune(target, representatives(symmetry, all_leaves(*levels)));
  symmetrise_all(target, symmetry);
  if (breaks_an_invariant(images)) restore(images);
  changes.clear();
  memory.clear();  // no stroke needs room for all leaves
}

/// Of mirrors and turns together, mirrors alone where the clay was not the same after a turn.
StrokeSymmetry Clay::State::match_images() {
  assert(open && open->images.empty());
  const StrokeStyle& style = open->feeder.style();
  const LatticeSymmetry all(style.mirror, style.radial);
  const LatticeSymmetry mirrors(style.mirror, {});
  if (all.is_none() || open->step.empty()) return StrokeSymmetry::none;
  const StrokeSymmetry made = match_images(all);
  return made == StrokeSymmetry::exact || mirrors.is_none() ? made : match_images(mirrors);
}

/// No symmetry is worth an invariant.
StrokeSymmetry Clay::State::match_images(const LatticeSymmetry& symmetry) {
  const bool was_symmetric = symmetrise_stroke(symmetry);
  UndoStep& images = open->images;
  const bool stands = was_symmetric && !breaks_an_invariant(images);
  if (stands) {
    open->step.merge(images);  // the older state of a leaf that the stroke touched too stays
  } else {
    restore(images);
  }
  images.clear();
  if (stands) return StrokeSymmetry::exact;
  return was_symmetric ? StrokeSymmetry::withheld : StrokeSymmetry::unlike;
}

/// False when it was not symmetric before. Nodes that symmetry gives back to the coarser level may
/// have been all that a leaf was there for; what that changes is made alike in a further round.
bool Clay::State::symmetrise_stroke(const LatticeSymmetry& symmetry) {
  constexpr int kMostRounds = 3;
  LeafList changed;
  EditTarget target = noting(target_into(open->images), changed);
  LeafList touched = keys_of(open->step);
  for (int round = 0;; ++round) {
    changed.clear();
    if (!symmetrise(target, symmetry, open->step, open->images, touched)) return false;
    if (round == kMostRounds) return true;
    touched.insert(touched.end(), changed.begin(), changed.end());
    const LeafList first = representatives(symmetry, sorted(std::move(touched)));
    changed.clear();
    const bool came_or_went = prune(target, first);
    if (redistance_out_of_bounds(target, first).empty() && !came_or_went) return true;
    touched = sorted(changed);
  }
}

/// Whether there are more faults than there were before a step, which stays as it is.
bool Clay::State::breaks_an_invariant(UndoStep& step) {
  const LeafList leaves = leaves_that_see(*levels, keys_of(step));
  const std::int64_t after = count_faults(*levels, leaves, tolerance_mm());
  if (after == 0) return false;
  exchange(step);
  try {
    const std::int64_t before = count_faults(*levels, leaves, tolerance_mm());
    exchange(step);
    return after > before;
  } catch (const std::bad_alloc&) {
    step.clear();  // the levels are as before it already
    throw;
  }
}

}  // namespace argil
