// SPDX-License-Identifier: GPL-3.0-or-later
// Which level an action works at, which images are applied together, and what follows each dab.
#include "action/dab.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "action/action.h"
#include "edit/redistance.h"

namespace argil {
namespace {

/// Images that meet, directly or by others, are applied at once: one after the other they would not
/// leave a mirror image. `bounds_mm`: of each; returns them by number.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<Box3>& bounds_mm,
                                                double margin_mm) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t image = 0; image < bounds_mm.size(); ++image) {
    std::vector<std::size_t> group;
    for (auto other = groups.begin(); other != groups.end();) {
      const bool joins = std::any_of(other->begin(), other->end(), [&](std::size_t member) {
        return bounds_mm[member].meets(bounds_mm[image], margin_mm);
      });
      if (!joins) {
        ++other;
        continue;
      }
      group.insert(group.end(), other->begin(), other->end());
      other = groups.erase(other);
    }
    group.push_back(image);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// How one dab of each kind is applied.
class DabOfKind {
 public:
  /// `posed`: of each dab its images.
  DabOfKind(EditTarget& target, std::vector<PosedTool> posed, std::size_t images)
      : target_(target), images_(std::move(posed)), count_(images) {}

  void operator()(ActionFunction<ActionKind::stamped>* stamp) const {
    std::vector<Box3> bounds(count_);
    for (std::size_t n = 0; n < images_.size(); ++n) {
      bounds[n % count_].include(images_[n].bounds_mm().min);
      bounds[n % count_].include(images_[n].bounds_mm().max);
    }
    for (const auto& group : groups_of(bounds, margin_mm())) {
      for_each_path(
          group,
          [this](const PosedTool& tool) {
            return level_of_shape(target_.stack, tool.tool(), tool.shrunk_radius_mm());
          },
          [&](std::span<const ToolPath> paths, int level) { stamp(target_, paths, level); });
    }
  }

  void operator()(ActionFunction<ActionKind::profiled>* lay) const {
    assert(target_.stroke_step != nullptr);
    const StrokeStart start(target_.stack, *target_.stroke_step);
    for (std::size_t image = 0; image < count_; ++image) {
      for_each_path(
          {image},
          [this](const PosedTool& tool) {
            return level_of_tool(target_.stack, tool.smallest_radius_mm());
          },
          [&](std::span<const ToolPath> paths, int level) {
            lay(target_, start, paths.front(), level);
          });
    }
  }

  void operator()(ActionFunction<ActionKind::local>* work) {
    assert(images_.size() == count_);
    const LevelStack& stack = target_.stack;
    const int level = level_of_tool(stack, first().smallest_radius_mm());
    std::vector<Box3> reached;
    for (const PosedTool& image : images_) reached.push_back(image.bounds_mm());
    for (const auto& group : groups_of(reached, margin_mm())) {
      std::vector<PosedTool> images;
      for (const std::size_t n : group) images.push_back(images_[n]);
      work(target_, images, level);
    }
    flush_queue(target_, reached);
  }

  void operator()(ActionFunction<ActionKind::painted>* paint) const { paint(target_, images_); }

  void operator()(ActionFunction<ActionKind::anchored>*) const {
    assert(false);  // apply_path has them
  }

 private:
  const PosedTool& first() const { return images_.front(); }
  /// Calls apply(paths, level) for the joined dabs of some images, a path each, in pieces of one
  /// level: where pressure changes the size, all of a long path is not to be as fine as its thin
  /// end.
  template <class LevelOf, class Apply>
  void for_each_path(const std::vector<std::size_t>& images, const LevelOf& level_of,
                     const Apply& apply) const {
    std::vector<ToolPath> paths(images.size());
    int level = 0;
    for (std::size_t first = 0; first < images_.size(); first += count_) {
      const int wanted = level_of(images_[first]);
      if (wanted != level && !paths.front().empty()) {
        apply(paths, level);
        for (ToolPath& path : paths) path.clear();
      }
      level = wanted;
      for (std::size_t n = 0; n < images.size(); ++n) {
        paths[n].push_back(images_[first + images[n]]);
      }
    }
    apply(paths, level);
  }
  /// Two images meet where redistancing after one would read what the other changed, on the
  /// coarsest level that either is solved on.
  double margin_mm() const {
    return 2.0 * (kReach + 1) * target_.stack.voxel_mm(target_.stack.top());
  }

  EditTarget& target_;
  std::vector<PosedTool> images_;
  std::size_t count_;  ///< of one dab
};

/// A profile also where only the path's begin has pressure: it runs out there.
bool has_effect(const PosedTool& tool) {
  if (tool.smallest_radius_mm() <= 0.0) return false;
  if (tool.strength() != 0.0) return true;
  const Dab begin{tool.dab().from, tool.dab().from};
  return is_profiled(tool.tool().action) && PosedTool(tool.tool(), begin).strength() != 0.0;
}

}  // namespace

void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> dabs,
               std::size_t images) {
  assert(images > 0 && dabs.size() >= images && dabs.size() % images == 0);
  assert(!is_anchored(tool.action));
  std::vector<PosedTool> posed;
  for (std::size_t first = 0; first < dabs.size(); first += images) {
    // Images differ in pose only: what the first says of strength and size holds for all.
    if (!has_effect(PosedTool(tool, dabs[first]))) continue;
    for (const Dab& dab : dabs.subspan(first, images)) posed.emplace_back(tool, dab);
  }
  if (posed.empty()) return;
  std::visit(DabOfKind(target, std::move(posed), images), function_of(tool.action));
}

void apply_path(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                std::size_t images) {
  assert(is_anchored(tool.action) && images > 0 && path.size() % images == 0);
  const AnyActionFunction function = function_of(tool.action);
  const auto* anchored = std::get_if<ActionFunction<ActionKind::anchored>*>(&function);
  assert(anchored != nullptr);
  (*anchored)(target, tool, path, images);
}

}  // namespace argil
