// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "brush/dab_plan.h"
#include "brush/leaf_feet.h"
#include "brush/pull.h"

namespace argil {

/// How far the distance grows at a point on the surface, in mm (negative: matter is put on).
class MoveLaw {
 public:
  MoveLaw() = default;
  virtual ~MoveLaw() = default;
  MoveLaw(const MoveLaw&) = delete;
  MoveLaw& operator=(const MoveLaw&) = delete;

  /// Puts the feet of a leaf where pulls, mask and moves are to be read; `near`: the images that
  /// may pull there. Asked by several threads.
  virtual void shift_feet(std::span<const std::size_t> /*near*/, LeafFeet& /*feet*/) const {}

  /// What one image does at the feet it pulls; 0 where the pull is 0. Asked by several threads.
  virtual void moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const = 0;

  /// How strongly an image, `tool`, pulls at the feet in rows that have a band, and at which rows
  /// it pulls at all. Asked by several threads.
  virtual void pull(std::size_t /*image*/, const PosedTool& tool, PullLaw law,
                    LeafFeet& feet) const {
    row_loops().pull(pull_job(tool, law, feet.origin_mm, feet.voxel_mm), feet.rows);
  }

  /// The farthest that it moves anything, in mm, where that is known without asking.
  virtual std::optional<double> farthest_mm() const { return {}; }

 protected:
  /// Calls visit(node) for the nodes of all rows that are pulled.
  template <class Visit>
  static void for_each_pulled(const LeafFeet& feet, const Visit& visit) {
    for (std::size_t row = 0; row < kLeafRows; ++row) {
      if (!feet.rows.at.is_asked[row]) continue;
      for (std::size_t n = row * kRowNodes; n < (row + 1) * kRowNodes; ++n) visit(n);
    }
  }

  /// Sets pulls to `pull_of(foot_mm)` in rows that have a band, point by point.
  template <class PullOf>
  static void set_pulls(LeafFeet& feet, const PullOf& pull_of) {
    for (std::size_t row = 0; row < kLeafRows; ++row) {
      feet.rows.at.is_asked[row] = false;
      if (!feet.rows.has_band[row]) continue;
      for (std::size_t n = row * kRowNodes; n < (row + 1) * kRowNodes; ++n) {
        feet.rows.pull[n] = static_cast<float>(pull_of(feet.point_mm(n)));
        feet.rows.at.is_asked[row] |= feet.rows.pull[n] > 0.0F;
      }
    }
  }
};

/// Moves against the pull by the same length everywhere: `mm` where it is 1.
class EvenLaw final : public MoveLaw {
 public:
  explicit EvenLaw(double mm) : mm_(static_cast<float>(mm)) {}
  void moves(std::size_t, const LeafFeet& feet, LeafMoves& out) const override {
    for_each_pulled(feet, [&](std::size_t n) { out.mm[n] = -mm_ * feet.rows.pull[n]; });
  }
  /// Where pulls are at most 1.
  std::optional<double> farthest_mm() const override { return std::abs(static_cast<double>(mm_)); }

 private:
  float mm_;
};

/// Moves the surface of a level along its normals: every node within the band changes by what the
/// law says of the point of the surface that is nearest to it, at most kVoxelsPerStep, so that a
/// distance stays one but for the square of the step. Returns the farthest, in mm, that a node
/// would have moved without that limit.
///
/// Accuracy  points and pulls in single precision: 1e-5 voxels.
/// Source    extension velocities (Adalsteinsson, Sethian 1999), by the closest point instead of a
///           march: nothing is solved.
float displace(LevelEdit& level, DabImages images, const MoveLaw& law,
               PullLaw pull = PullLaw::falloff);

/// One of the steps that a displacement is done in.
struct DisplaceStep {
  int at = 0;
  int count = 1;

  /// The fraction of what is left that it covers, so that all steps go equally far and together
  /// cover `part` of the whole, 0 to 1.
  float part_of(float part) const noexcept {
    return part / (static_cast<float>(count) - static_cast<float>(at) * part);
  }
};

/// Displaces all levels in as many steps as the displacement needs, at most kMostSteps: what is
/// left is moved by the next dabs. `law_of(edit, step)` makes the law of a step from the clay as it
/// stands.
inline constexpr int kMostSteps = 8;
using LawMaker = std::function<std::unique_ptr<MoveLaw>(Edit& edit, DisplaceStep step)>;
void displace_in_steps(EditTarget& target, DabImages images, int tool_level,
                       const LawMaker& law_of);

}  // namespace argil
