// SPDX-License-Identifier: GPL-3.0-or-later
// A mask by an outline in a picture. Notation: points of the picture are x, y as PicturePoint; a
// leaf is one of the mask, of 8^3 nodes. A leaf's box in the picture tells which edges of the
// outline can matter to its nodes: those that come near, and those that a line to the right meets.
#include "argil/engine/mask_outline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <string>
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
#include "operation/solid.h"

namespace argil {
namespace {

constexpr double kFadeCosine = 0.1;   // of the surface's normal with the line of sight
constexpr double kMostPicture = 1e6;  // no point lies farther from the picture's middle

/// A point as the picture shows it.
struct Seen {
  double x = 0.0;
  double y = 0.0;
  double mm_per_unit = 1.0;  ///< what a unit of the picture spans there
  bool is_before_eye = true;
};

class OutlineView {
 public:
  explicit OutlineView(const ViewFrame& view)
      : eye_(view.eye_mm),
        right_(rotate(normalized(view.orientation), {1.0, 0.0, 0.0})),
        up_(rotate(normalized(view.orientation), {0.0, 1.0, 0.0})),
        back_(rotate(normalized(view.orientation), {0.0, 0.0, 1.0})),
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

struct OutlineEdge {
  PicturePoint a{};
  PicturePoint b{};
};

/// Those of one loop that can matter within a box of the picture.
struct LoopPart {
  std::vector<OutlineEdge> near;   ///< come into the box
  std::vector<OutlineEdge> right;  ///< may be met by a line from it to the right
};

struct PictureBox {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;
};

double distance_to(const OutlineEdge& edge, double x, double y) {
  const double ux = edge.b[0] - edge.a[0];
  const double uy = edge.b[1] - edge.a[1];
  const double vx = x - edge.a[0];
  const double vy = y - edge.a[1];
  const double square = ux * ux + uy * uy;
  const double t = square > 0.0 ? std::clamp((vx * ux + vy * uy) / square, 0.0, 1.0) : 0.0;
  const double dx = vx - t * ux;
  const double dy = vy - t * uy;
  return std::sqrt(dx * dx + dy * dy);
}

/// Half open, so that a corner on the line counts once.
bool is_met_to_the_right(const OutlineEdge& edge, double x, double y) {
  if ((edge.a[1] > y) == (edge.b[1] > y)) return false;
  const double t = (y - edge.a[1]) / (edge.b[1] - edge.a[1]);
  return edge.a[0] + t * (edge.b[0] - edge.a[0]) > x;
}

class OutlineShape {
 public:
  explicit OutlineShape(const std::vector<std::vector<PicturePoint>>& loops) {
    for (const auto& loop : loops) {
      auto& edges = loops_.emplace_back();
      for (std::size_t n = 0; n < loop.size(); ++n) {
        edges.push_back({loop[n], loop[(n + 1) % loop.size()]});
      }
    }
  }

  std::vector<LoopPart> parts_in(const PictureBox& box) const {
    std::vector<LoopPart> parts(loops_.size());
    for (std::size_t n = 0; n < loops_.size(); ++n) {
      for (const OutlineEdge& edge : loops_[n]) {
        const auto [low_x, high_x] = std::minmax(edge.a[0], edge.b[0]);
        const auto [low_y, high_y] = std::minmax(edge.a[1], edge.b[1]);
        if (high_x < box.x0 || high_y < box.y0 || low_y > box.y1) continue;
        parts[n].right.push_back(edge);
        if (low_x <= box.x1) parts[n].near.push_back(edge);
      }
    }
    return parts;
  }

  std::vector<LoopPart> all() const {
    constexpr double kAll = 2.0 * kMostPicture;
    return parts_in({-kAll, kAll, -kAll, kAll});
  }

 private:
  std::vector<std::vector<OutlineEdge>> loops_;
};

/// Whether any edge comes into the box: else all points in it are on one side.
bool has_border(const std::vector<LoopPart>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [](const LoopPart& part) { return !part.near.empty(); });
}

/// How deep a point of the box lies within one of the loops, as far as an edge is near; outside it
/// is negative.
double depth_within(const std::vector<LoopPart>& parts, double x, double y) {
  constexpr double kFar = 4.0 * kMostPicture;
  double depth = -kFar;
  for (const LoopPart& part : parts) {
    bool is_inside = false;
    for (const OutlineEdge& edge : part.right) is_inside ^= is_met_to_the_right(edge, x, y);
    double nearest = kFar;
    for (const OutlineEdge& edge : part.near) nearest = std::min(nearest, distance_to(edge, x, y));
    depth = std::max(depth, is_inside ? nearest : -nearest);
  }
  return depth;
}

/// What becomes of a leaf of the mask.
struct LeafResult {
  std::unique_ptr<LeafValues> values;  ///< node by node
  float value = 0.0F;                  ///< without them, of all
  bool is_changed = false;
};

class OutlinePainter {
 public:
  OutlinePainter(const Clay& clay, const Mask& before, const MaskOutline& outline)
      : clay_(clay),
        stack_(levels_of(clay)),
        before_(before),
        view_(outline.view),
        shape_(outline.loops),
        frees_(outline.frees),
        front_only_(outline.front_only) {}

  LeafResult leaf(const Coord& origin) const;

 private:
  /// 0 outside to 1 within, over a node's spacing.
  double cover(const std::vector<LoopPart>& parts, const Vec3& p) const {
    const Seen at = view_.seen(p);
    if (!at.is_before_eye) return 0.0;
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
  void paint_nodes(const Coord& origin, const std::vector<LoopPart>& parts, LeafResult& out) const;

  const Clay& clay_;
  const LevelStack& stack_;
  const Mask& before_;
  OutlineView view_;
  OutlineShape shape_;
  bool frees_;
  bool front_only_;
};

void OutlinePainter::paint_nodes(const Coord& origin, const std::vector<LoopPart>& parts,
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
LeafResult OutlinePainter::leaf(const Coord& origin) const {
  LeafResult out;
  const double voxel = before_.voxel_mm();
  const double half = 0.5 * (kLeafSide - 1) * voxel;
  const Vec3 middle = node_mm(origin, voxel) + Vec3{half, half, half};
  const Seen at = view_.seen(middle);
  double nearest_mm = 1.0;
  const double reach = view_.reach(at, half * std::sqrt(3.0), nearest_mm);
  std::vector<LoopPart> parts;
  if (reach < 0.0) {
    parts = shape_.all();
  } else {
    const double most = reach + voxel / nearest_mm;
    parts = shape_.parts_in({at.x - most, at.x + most, at.y - most, at.y + most});
    if (!has_border(parts) && depth_within(parts, at.x, at.y) < 0.0) return out;
  }
  const bool is_near = is_near_surface(stack_, origin);
  const float* was = before_.leaf(origin);
  if (!is_near) {
    const Coord center = origin.offsetBy(kLeafSide / 2);
    const bool is_air = stack_.node_value(0, center << 1) > 0.0F;
    if (is_air || front_only_) return out;
  }
  const bool is_uniform = reach >= 0.0 && !has_border(parts) && !front_only_;
  if (was == nullptr && (is_uniform || !is_near)) {
    const float former = before_.constant(origin);
    out.value = painted(former, is_uniform ? 1.0 : cover(parts, middle));
    out.is_changed = out.value != former;
    return out;
  }
  paint_nodes(origin, parts, out);
  return out;
}

/// The leaves of the mask that the clay, its inside and what is near it may take.
openvdb::CoordBBox leaves_of(const Clay& clay, double voxel_mm) {
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
  const openvdb::CoordBBox nodes = leaves_of(clay, before.voxel_mm());
  const int first = nodes.min().x() & ~(kLeafSide - 1);
  for (int x = first; x <= nodes.max().x(); x += kLeafSide) {
    pace.at(static_cast<double>(x - first) / std::max(1, nodes.max().x() - first));
    std::vector<Coord> origins;
    const openvdb::CoordBBox slab(Coord(x, nodes.min().y(), nodes.min().z()),
                                  Coord(x, nodes.max().y(), nodes.max().z()));
    for_each_leaf_origin(slab, [&](const Coord& origin) { origins.push_back(origin); });
    std::vector<LeafResult> results(origins.size());
    for_each_leaf(origins.size(), [&](std::size_t n) { results[n] = painter.leaf(origins[n]); });
    for (std::size_t n = 0; n < origins.size(); ++n) {
      if (!results[n].is_changed) continue;
      if (results[n].values != nullptr) {
        mask->put(origins[n], *results[n].values);
      } else {
        mask->put(origins[n], results[n].value);
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
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (!(std::isfinite(square) && square > 0.0)) {
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
