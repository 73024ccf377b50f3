// SPDX-License-Identifier: GPL-3.0-or-later
// A mask by an outline in a picture. Notation: points of the picture are x, y as PicturePoint; a
// leaf is one of the mask, of 8^3 nodes. Blocks of leaves are halved, and each keeps what of the
// outline matters to its box in the picture (outline_parts.h).
#include "argil/engine/mask_outline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/engine/clay.h"
#include "argil/engine/field_sampler.h"

#include "clay/clay_access.h"
#include "edit/edit.h"
#include "field/bad_input.h"
#include "field/mask.h"
#include "field/mask_reach.h"
#include "field/parallel.h"
#include "operation/outline_parts.h"
#include "operation/solid.h"

namespace argil {
namespace {

constexpr double kFadeCosine = 0.1;  // of the surface's normal with the line of sight
constexpr int kBlockLeaves = 4;      // along the side of a block that is halved no more

double largest_part(const Quat& q) {
  return std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
}

/// A point as the picture shows it.
struct Seen {
  double x = 0.0;
  double y = 0.0;
  double mm_per_unit = 1.0;  ///< what a unit of the picture spans there
  bool is_before_eye = true;
};

/// Unit; also of what is so short or long that no double holds its square.
Quat unit_of(const Quat& q) {
  const double largest = largest_part(q);
  if (largest > 1e-100 && largest < 1e100) return normalized(q);
  return normalized(Quat{q.w / largest, q.x / largest, q.y / largest, q.z / largest});
}

class OutlineView {
 public:
  explicit OutlineView(const ViewFrame& view)
      : eye_(view.eye_mm),
        right_(rotate(unit_of(view.orientation), {1.0, 0.0, 0.0})),
        up_(rotate(unit_of(view.orientation), {0.0, 1.0, 0.0})),
        back_(rotate(unit_of(view.orientation), {0.0, 0.0, 1.0})),
        is_parallel_(view.is_parallel) {}

  Seen seen(const Vec3& p) const {
    const Vec3 from = p - eye_;
    if (is_parallel_) return {dot(from, right_), dot(from, up_), 1.0, true};
    const double depth = -dot(from, back_);
    if (!(depth > 0.0)) return {0.0, 0.0, 1.0, false};
    return {dot(from, right_) / depth, dot(from, up_) / depth, depth, true};
  }

  /// From a point to the viewer, unit.
  Vec3 to_eye(const Vec3& p) const { return is_parallel_ ? back_ : normalized(eye_ - p); }

  /// Whether all points within `radius_mm` of one lie behind the eye.
  bool is_behind(const Vec3& middle, double radius_mm) const {
    return !is_parallel_ && dot(middle - eye_, back_) > radius_mm;
  }

  /// How far, in the picture, points within `radius_mm` of one may lie from it; negative where some
  /// may lie behind the eye. `nearest_mm` becomes the least of their mm_per_unit.
  double reach(const Seen& middle, double radius_mm, double& nearest_mm) const {
    nearest_mm = 1.0;
    if (is_parallel_) return radius_mm;
    nearest_mm = middle.mm_per_unit - radius_mm;
    if (!middle.is_before_eye || nearest_mm < 0.01 * radius_mm) return -1.0;
    const double slant = std::sqrt(1.0 + middle.x * middle.x + middle.y * middle.y);
    return radius_mm * slant / nearest_mm;
  }

 private:
  Vec3 eye_, right_, up_, back_;
  bool is_parallel_;
};

/// What becomes of a leaf of the mask.
struct LeafResult {
  std::unique_ptr<LeafValues> values;  ///< node by node
  float value = 0.0F;                  ///< without them, of all
  bool is_changed = false;
};

/// Leaves of a slab, and what of the outline can matter to them.
struct OutlineBlock {
  Coord origin;
  int columns = 0;  ///< leaves along y
  int rows = 0;     ///< along z
  std::shared_ptr<const LoopParts> parts;
};

/// One of its leaves.
struct OutlineLeaf {
  Coord origin;
  std::shared_ptr<const LoopParts> parts;
};

class OutlinePainter {
 public:
  OutlinePainter(const Clay& clay, const Mask& before, const MaskOutline& outline)
      : clay_(clay),
        stack_(levels_of(clay)),
        before_(before),
        view_(outline.view),
        all_(std::make_shared<const LoopParts>(parts_of(outline.loops))),
        all_box_(box_of(*all_)),
        frees_(outline.frees),
        front_only_(outline.front_only) {}

  /// The leaves of a slab that may change.
  std::vector<OutlineLeaf> leaves_of(const Coord& origin, int columns, int rows) const {
    std::vector<OutlineLeaf> leaves;
    add_block({origin, columns, rows, all_}, leaves);
    return leaves;
  }
  LeafResult leaf(const OutlineLeaf& at) const;

 private:
  void add_block(OutlineBlock block, std::vector<OutlineLeaf>& leaves) const;
  /// A ball around leaves.
  struct Ball {
    Vec3 middle;
    double radius_mm = 0.0;
  };
  Ball ball_around(const Coord& origin, int columns, int rows) const;
  /// What of `parts` matters to points of the ball; all where some lie behind the eye, of which
  /// `is_seen` tells.
  LoopParts parts_at(const LoopParts& parts, const Ball& ball, bool& is_seen) const;
  /// Whether they all lie outside.
  bool is_outside(const LoopParts& parts, const Ball& ball) const {
    const Seen at = view_.seen(ball.middle);
    return !has_border(parts) && depth_within(parts, at.x, at.y) < 0.0;
  }
  /// 0 outside to 1 within, over a node's spacing.
  double cover(const LoopParts& parts, const Vec3& p) const {
    const Seen at = view_.seen(p);
    if (!at.is_before_eye) return 0.0;
    const double margin = before_.voxel_mm() / at.mm_per_unit;
    if (at.x < all_box_.x0 - margin || at.x > all_box_.x1 + margin) return 0.0;
    if (at.y < all_box_.y0 - margin || at.y > all_box_.y1 + margin) return 0.0;
    const double depth_mm = at.mm_per_unit * depth_within(parts, at.x, at.y);
    return std::clamp(0.5 + depth_mm / before_.voxel_mm(), 0.0, 1.0);
  }
  float painted(float was, double covered) const {
    const auto by = static_cast<float>(covered);
    return frees_ ? std::min(was, 1.0F - by) : std::max(was, by);
  }
  /// How much of a point's surface looks at the eye.
  double facing(FieldSampler& field, const Vec3& p) const {
    const Vec3 normal = normalized(field.value(p).gradient);
    return std::clamp(dot(normal, view_.to_eye(p)) / kFadeCosine, 0.0, 1.0);
  }
  void paint_nodes(const Coord& origin, const LoopParts& parts, LeafResult& out) const;

  const Clay& clay_;
  const LevelStack& stack_;
  const Mask& before_;
  OutlineView view_;
  std::shared_ptr<const LoopParts> all_;
  PictureBox all_box_;
  bool frees_;
  bool front_only_;
};

OutlinePainter::Ball OutlinePainter::ball_around(const Coord& origin, int columns, int rows) const {
  const double voxel = before_.voxel_mm();
  const Vec3 half =
      0.5 * voxel * Vec3{kLeafSide - 1.0, kLeafSide * columns - 1.0, kLeafSide * rows - 1.0};
  return {node_mm(origin, voxel) + half, length(half)};
}

LoopParts OutlinePainter::parts_at(const LoopParts& parts, const Ball& ball, bool& is_seen) const {
  const Seen at = view_.seen(ball.middle);
  double nearest_mm = 1.0;
  const double reach = view_.reach(at, ball.radius_mm, nearest_mm);
  is_seen = reach >= 0.0;
  if (!is_seen) return parts;
  const double most = reach + before_.voxel_mm() / nearest_mm;
  return parts_in(parts, {at.x - most, at.x + most, at.y - most, at.y + most});
}

void OutlinePainter::add_block(OutlineBlock block, std::vector<OutlineLeaf>& leaves) const {
  const Ball ball = ball_around(block.origin, block.columns, block.rows);
  if (view_.is_behind(ball.middle, ball.radius_mm)) return;
  bool is_seen = false;
  LoopParts parts = parts_at(*block.parts, ball, is_seen);
  if (is_seen && is_outside(parts, ball)) return;
  if (is_seen) block.parts = std::make_shared<const LoopParts>(std::move(parts));
  if (std::max(block.columns, block.rows) > kBlockLeaves) {
    OutlineBlock other = block;
    if (block.columns > block.rows) {
      block.columns /= 2;
      other.columns -= block.columns;
      other.origin.y() += kLeafSide * block.columns;
    } else {
      block.rows /= 2;
      other.rows -= block.rows;
      other.origin.z() += kLeafSide * block.rows;
    }
    add_block(std::move(block), leaves);
    add_block(std::move(other), leaves);
    return;
  }
  for (int column = 0; column < block.columns; ++column) {
    for (int row = 0; row < block.rows; ++row) {
      leaves.push_back(
          {block.origin.offsetBy(0, kLeafSide * column, kLeafSide * row), block.parts});
    }
  }
}

void OutlinePainter::paint_nodes(const Coord& origin, const LoopParts& parts,
                                 LeafResult& out) const {
  FieldSampler field(clay_);
  const float* was = before_.leaf(origin);
  const float constant = before_.constant(origin);
  out.values = std::make_unique<LeafValues>();
  for (int n = 0; n < kLeafNodes; ++n) {
    const auto at = static_cast<std::size_t>(n);
    const Vec3 p = node_mm(origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7), before_.voxel_mm());
    const float former = was != nullptr ? was[n] : constant;
    double covered = cover(parts, p);
    if (front_only_ && covered > 0.0) covered *= facing(field, p);
    (*out.values)[at] = painted(former, covered);
    out.is_changed = out.is_changed || (*out.values)[at] != former;
  }
}

/// Where no border passes, and away from the surface, one value does for all nodes.
LeafResult OutlinePainter::leaf(const OutlineLeaf& at) const {
  LeafResult out;
  const Coord& origin = at.origin;
  const bool is_near = is_near_surface(stack_, origin);
  if (!is_near) {
    const Coord center = origin.offsetBy(kLeafSide / 2);
    const bool is_air = stack_.node_value(0, center << 1) > 0.0F;
    if (is_air || front_only_) return out;
  }
  const Ball ball = ball_around(origin, 1, 1);
  if (view_.is_behind(ball.middle, ball.radius_mm)) return out;
  bool is_seen = false;
  const LoopParts parts = parts_at(*at.parts, ball, is_seen);
  if (is_seen && is_outside(parts, ball)) return out;
  const bool is_uniform = is_seen && !has_border(parts) && !front_only_;
  if (before_.leaf(origin) == nullptr && (is_uniform || !is_near)) {
    const float former = before_.constant(origin);
    out.value = painted(former, is_uniform ? 1.0 : cover(parts, ball.middle));
    out.is_changed = out.value != former;
    return out;
  }
  paint_nodes(origin, parts, out);
  return out;
}

/// The leaves of the mask that the clay, its inside and what is near it may take.
openvdb::CoordBBox nodes_to_mask(const Clay& clay, double voxel_mm) {
  Box3 box = clay.bounds_mm();
  const double margin = kLeafSide * voxel_mm;
  box.min -= Vec3{margin, margin, margin};
  box.max += Vec3{margin, margin, margin};
  return nodes_covering(box, voxel_mm);
}

/// Slab by slab, so that no more than a slab waits beside the mask.
std::shared_ptr<Mask> outlined(const Clay& clay, const MaskOutline& outline,
                               const LevelStack& stack, std::int64_t free_bytes, const Pace& pace) {
  const Mask nothing(kMaskVoxels * stack.voxel_mm(0), 0.0F);
  const Mask& before = stack.mask() != nullptr ? *stack.mask() : nothing;
  if (before.bytes() > free_bytes) throw OverLimit(before.bytes());
  std::shared_ptr<Mask> mask = before.copy();
  const OutlinePainter painter(clay, before, outline);
  const openvdb::CoordBBox nodes = nodes_to_mask(clay, before.voxel_mm());
  const Coord low = leaf_origin(nodes.min());
  const Coord high = leaf_origin(nodes.max());
  const int columns = (high.y() - low.y()) / kLeafSide + 1;
  const int rows = (high.z() - low.z()) / kLeafSide + 1;
  for (int x = low.x(); x <= high.x(); x += kLeafSide) {
    pace.at(static_cast<double>(x - low.x()) / std::max(1, high.x() - low.x()));
    const auto leaves = painter.leaves_of(Coord(x, low.y(), low.z()), columns, rows);
    std::vector<LeafResult> results(leaves.size());
    for_each_leaf(leaves.size(), [&](std::size_t n) { results[n] = painter.leaf(leaves[n]); });
    for (std::size_t n = 0; n < leaves.size(); ++n) {
      if (!results[n].is_changed) continue;
      if (results[n].values != nullptr) {
        mask->put(leaves[n].origin, *results[n].values);
      } else {
        mask->put(leaves[n].origin, results[n].value);
      }
    }
    if (mask->bytes() > free_bytes) throw OverLimit(mask->bytes());
  }
  return mask->is_nothing() ? nullptr : mask;
}

std::string ordinal_of(std::size_t loop) { return "loop " + std::to_string(loop + 1); }

}  // namespace

Result<void> validate_outline(const MaskOutline& outline) {
  if (!is_in_reach(outline.view.eye_mm)) {
    return bad_input("eye_mm of the outline is out of reach; no coordinate may be beyond " +
                     number_text(kMaxReachMm) + " mm");
  }
  const Quat& q = outline.view.orientation;
  const bool is_finite =
      std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  if (!(is_finite && largest_part(q) > 0.0)) {
    return bad_input(
        "orientation of the outline has no direction; give a quaternion of any length but zero");
  }
  if (outline.loops.empty()) return bad_input("the outline has no loop; give one at least");
  std::size_t points = 0;
  for (std::size_t n = 0; n < outline.loops.size(); ++n) {
    const auto& loop = outline.loops[n];
    points += loop.size();
    if (loop.size() < 3) {
      return bad_input(ordinal_of(n) + " of the outline has " + std::to_string(loop.size()) +
                       " points; must be at least 3");
    }
    for (const PicturePoint& p : loop) {
      const bool is_good = std::abs(p[0]) <= kMostPicture && std::abs(p[1]) <= kMostPicture;
      if (is_good) continue;
      return bad_input(ordinal_of(n) + " of the outline has a point (" + number_text(p[0]) + ", " +
                       number_text(p[1]) + "); must be numbers from -1e6 to 1e6");
    }
  }
  if (points <= MaskOutline::kMostPoints) return {};
  return bad_input("the outline has " + std::to_string(points) + " points; must be at most " +
                   std::to_string(MaskOutline::kMostPoints));
}

Result<void> mask_within(Clay& clay, const MaskOutline& outline, const Progress& progress) {
  if (auto valid = validate_outline(outline); !valid) return valid;
  return no_throw("the mask", [&] {
    const Pace pace(progress, "mask");
    return ClayAccess::change_mask(clay, [&](const LevelStack& stack, std::int64_t free_bytes) {
      return outlined(clay, outline, stack, free_bytes, pace);
    });
  });
}

}  // namespace argil
