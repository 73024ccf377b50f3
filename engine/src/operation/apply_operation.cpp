// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to a clay as a whole: one undo step, or nothing at all.
#include <algorithm>
#include <exception>
#include <new>
#include <sstream>

#include "argil/engine/clay.h"
#include "argil/engine/operation.h"

#include "clay/clay_state.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "field/mask.h"
#include "operation/combine.h"
#include "operation/prepared_operation.h"

namespace argil {
namespace {

/// Redistances and prunes, again while leaves go: one that went may lay bare coarser nodes that it
/// decided, and that are no distance on their own.
Result<void> clean_up(EditTarget& target, const UndoStep& step, const Progress& progress) {
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds; ++round) {
    LeafList touched = keys_of(step);
    if (!redistance_until_in_bounds(target, touched, progress)) return operation_interrupted();
    if (!prune(target, touched)) break;
  }
  return {};
}

/// Combines step by step, then cleans up. What it wrote stays when it fails: take it back.
Result<void> run_steps(EditTarget& target, const PreparedOperation& prepared, const UndoStep& step,
                       const Progress& progress) {
  for (const CombineStep& next : prepared.steps) {
    switch (combine(target, *next.solid, next.kind, progress)) {
      case Combined::empty:
        return bad_operation(prepared.if_empty);
      case Combined::interrupted:
        return operation_interrupted();
      case Combined::done:
        break;
    }
  }
  return clean_up(target, step, progress);
}

/// New levels get the mask of those they replace.
void carry_mask(const LevelStack& from, LevelStack& to) {
  if (from.mask() == nullptr) return;
  const double voxel = kMaskVoxels * to.voxel_mm(0);
  const bool fits = voxel == from.mask()->voxel_mm();
  to.exchange_mask(fits ? from.mask()->copy() : resampled(*from.mask(), voxel));
  to.drop_mask_of_nothing();
}

std::int64_t count_leaves(const LevelStack& stack) {
  std::int64_t count = 0;
  for (int level = 0; level < stack.count(); ++level) {
    count += static_cast<std::int64_t>(stack.grid(level).tree().leafCount());
  }
  return count;
}

}  // namespace

Error bad_operation(std::string message) { return {ErrorKind::bad_input, std::move(message)}; }

Error operation_interrupted() {
  return {ErrorKind::interrupted, "interrupted; the clay is as it was"};
}

std::string digits(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string digits(const Vec3& v) {
  std::ostringstream text;
  text << "(" << v.x << ", " << v.y << ", " << v.z << ")";
  return text.str();
}

double longest_side_mm(const Clay& clay) {
  const Vec3 size = clay.bounds_mm().size();
  return std::max({size.x, size.y, size.z});
}

Result<OperationReport> Clay::apply(const Operation& operation, const Progress& progress) {
  State& state = *state_;
  const ChangingCall call(state.user);
  if (state.open) return stroke_is_open();
  try {
    auto prepared =
        std::visit([&](const auto& chosen) { return prepare(*this, chosen, progress); }, operation);
    if (!prepared) return prepared.error();
    if (!prepared.value().levels) {
      const auto changed = state.run([&](EditTarget& target, const UndoStep& step) {
        return run_steps(target, prepared.value(), step, progress);
      });
      if (!changed) return changed.error();
      return OperationReport{changed.value(), false};
    }
    LevelStack& levels = *prepared.value().levels->levels;
    carry_mask(*state.levels, levels);
    const OperationReport report{count_leaves(levels), true};
    state.history.make_room();
    state.push_undo(state.replace_levels(std::move(*prepared.value().levels)));
    return report;
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "apply the operation");
  } catch (const std::exception& fault) {
    return Error{ErrorKind::internal, std::string("the operation failed inside a library: ") +
                                          fault.what() + "; please report it with the clay"};
  }
}

}  // namespace argil
