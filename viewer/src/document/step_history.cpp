// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/step_history.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <iterator>
#include <variant>

#include "document/tool_info.h"

namespace argil::viewer {
namespace {

std::string with_mm(const char* what, double mm) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %.3g mm", what, mm);
  return text;
}

/// The words for each kind of step; a title is the action's own (kActionInfos).
struct NameOf {
  bool is_stamp = false;

  std::string operator()(const Stroke& stroke) const {
    const Tool& tool = stroke.tool;
    std::string what = is_stamp ? "Stamp" : info_of(tool.action).title;
    if (tool.strength < 0.0) what += " (inverted)";
    return with_mm((what + ",").c_str(), largest_radius(tool));
  }
  std::string operator()(io::HistoryStep step) const {
    return step == io::HistoryStep::undo ? "Undo" : "Redo";
  }
  /// Nothing is made an Operation to fit here: one without words of its own does not compile.
  std::string operator()(const std::same_as<Operation> auto& operation) const {
    return std::visit(*this, operation);
  }
  std::string operator()(const Offset& offset) const {
    return with_mm("Offset,", offset.distance_mm);
  }
  std::string operator()(const Hollow& hollow) const {
    return with_mm("Hollow, wall", hollow.wall_mm);
  }
  std::string operator()(const Cut&) const { return "Cut"; }
  std::string operator()(const Combine& combine) const {
    return combine.kind == CombineKind::unite      ? "Union"
           : combine.kind == CombineKind::subtract ? "Difference"
                                                   : "Intersection";
  }
  std::string operator()(const Resample& resample) const {
    return with_mm("Resample,", resample.voxel_mm);
  }
  std::string operator()(const std::same_as<PieceEdit> auto& edit) const {
    return std::visit(*this, edit);
  }
  std::string operator()(const SelectPiece& select) const { return select.name + " selected"; }
  std::string operator()(const AddPiece& add) const { return add.look.name + " added"; }
  std::string operator()(const CopyPiece& copy) const { return copy.name + " duplicated"; }
  std::string operator()(const RemovePiece& remove) const { return remove.name + " removed"; }
  std::string operator()(const ChangePiece& change) const {
    return change.name + (change.new_name     ? " renamed"
                          : change.placement  ? " moved"
                          : change.is_visible ? (*change.is_visible ? " shown" : " hidden")
                          : change.is_locked  ? (*change.is_locked ? " locked" : " unlocked")
                                              : " coloured");
  }
  std::string operator()(const PlacePieces& place) const {
    const std::size_t count = place.places.size();
    return (count == 1 ? place.places.front().name : std::to_string(count) + " pieces") + " moved";
  }
  std::string operator()(const ScalePiece& scale) const {
    char text[32];
    std::snprintf(text, sizeof text, " scaled to %.4g %%", 100.0 * scale.factor);
    return scale.name + text;
  }
  std::string operator()(const SplitPiece& split) const { return split.name + " split"; }
  std::string operator()(const MergePiece& merge) const {
    const char* what = merge.kind == CombineKind::unite      ? "merged with "
                       : merge.kind == CombineKind::subtract ? "minus "
                                                             : "cut to ";
    return merge.name + " " + what + merge.other;
  }
  std::string operator()(MaskEdit edit) const {
    switch (edit) {
      case MaskEdit::clear:
        return "Mask cleared";
      case MaskEdit::invert:
        return "Mask inverted";
      case MaskEdit::blur:
        return "Mask blurred";
      case MaskEdit::sharpen:
        return "Mask sharpened";
      case MaskEdit::fill:
        break;
    }
    return "Mask filled";
  }
  std::string operator()(const std::same_as<MaskFilter> auto& filter) const {
    return std::visit(*this, filter);
  }
  std::string operator()(const MaskGrow& grow) const {
    const char* what = grow.by_mm < 0.0 ? "Mask shrunk by" : "Mask grown by";
    return with_mm(what, std::abs(grow.by_mm));
  }
  std::string operator()(const MaskCavity& cavity) const {
    return with_mm(cavity.is_inverted ? "All but cavities masked," : "Cavities masked,",
                   cavity.radius_mm);
  }
  std::string operator()(const MaskOutline& outline) const {
    return outline.frees ? "Unmasked within" : "Masked within";
  }
};

}  // namespace

void StepHistory::record(const io::ScriptStep& step, bool is_stamp) {
  if (const auto* move = std::get_if<io::HistoryStep>(&step)) {
    const bool is_undo = *move == io::HistoryStep::undo;
    if (is_undo ? done_ > 0 : done_ < steps_.size()) {
      is_undo ? --done_ : ++done_;
    } else {
      // Where the list does not reach, the clay does: a step of before it was begun.
      state_here() = ++last_state_;
    }
    return;
  }
  // Which piece is at hand is no change of the work.
  const auto* edit = std::get_if<PieceEdit>(&step);
  if (edit != nullptr && std::holds_alternative<SelectPiece>(*edit)) return;
  assert(done_ <= steps_.size() && steps_.size() == names_.size());
  // What was taken back is gone once something else is done.
  steps_.resize(done_);
  names_.resize(done_);
  states_.resize(done_);
  steps_.push_back(step);
  names_.push_back(name_of_step(step, is_stamp));
  states_.push_back(++last_state_);
  ++done_;
}

void StepHistory::keep(std::size_t undo_depth, std::size_t redo_depth) {
  assert(done_ <= steps_.size());
  const std::size_t kept = std::min(steps_.size(), done_ + redo_depth);
  // The oldest go first, as in the clay.
  const std::size_t gone = done_ - std::min(done_, undo_depth);
  if (gone > 0) first_state_ = states_[gone - 1];
  const auto keep_of = [&](auto& list) {
    list.resize(kept);
    list.erase(list.begin(), std::next(list.begin(), static_cast<std::ptrdiff_t>(gone)));
  };
  keep_of(steps_);
  keep_of(names_);
  keep_of(states_);
  done_ -= gone;
  assert(done_ <= steps_.size() && steps_.size() == names_.size());
}

std::string name_of_step(const io::ScriptStep& step, bool is_stamp) {
  return std::visit(NameOf{is_stamp}, step);
}

}  // namespace argil::viewer
