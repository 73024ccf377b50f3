// SPDX-License-Identifier: GPL-3.0-or-later
// The borders of a mask, moved along the surface. Notation: the border is where the mask is a half
// on the surface; feet are points of it, close together. The share is how much of what grows there
// is: the mask, or what is free where it shrinks. Depth is counted along the surface from a foot,
// positive outside of what grows.
//
// Each foot has the profile of the share across the border. From the feet a front runs along the
// nodes beside the surface, each of which takes the foot of a neighbour that is nearest to it (as
// J. Tsitsiklis, "Efficient algorithms for globally optimal trajectories", IEEE Trans. Autom.
// Control 40 (1995), but with feet in the place of differences: their distances are exact where the
// surface is a plane or a ball). The share at a place is then the profile of its foot, moved.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <queue>
#include <tuple>
#include <vector>

#include "clay/clay_access.h"
#include "edit/edit.h"
#include "field/leaf_map.h"
#include "field/parallel.h"
#include "operation/mask_surface.h"

namespace argil {
namespace {

constexpr double kHalfShare = 0.5;
/// The corners of a cell that the surface passes lie within so many nodes' spacings of it.
constexpr double kBesideNodes = 1.8;

/// A point of the border.
struct BorderFoot {
  SurfacePlace place;
  Vec3 outward;                ///< unit, along the surface, to where the share falls
  std::vector<float> inside;   ///< shares 0, 1, 2... nodes into what grows; rising
  std::vector<float> outside;  ///< and out of it; falling
};

/// The share that a profile has at a depth; 0 beyond what was looked at outside.
double share_at(const BorderFoot& foot, double depth_nodes) {
  const std::vector<float>& side = depth_nodes < 0.0 ? foot.inside : foot.outside;
  assert(side.size() >= 2);
  const double at = std::abs(depth_nodes);
  const auto low = static_cast<std::size_t>(at);
  if (low + 1 >= side.size()) {
    return depth_nodes < 0.0 ? static_cast<double>(side.back()) : 0.0;
  }
  const double part = at - static_cast<double>(low);
  return (1.0 - part) * static_cast<double>(side[low]) + part * static_cast<double>(side[low + 1]);
}

/// asin(s) / s for 0 to 1 without the library's: the angle is halved twice, then a series.
double arcsine_ratio(double s) {
  assert(s >= 0.0 && s <= 1.0);
  const auto sine_of_half = [](double sine) {
    return sine / std::sqrt(2.0 * (1.0 + std::sqrt(std::max(0.0, 1.0 - sine * sine))));
  };
  if (s < 1e-6) return 1.0;
  const double q = sine_of_half(sine_of_half(s));
  const double t = q * q;
  const double series =
      1.0 +
      t * (1.0 / 6 + t * (3.0 / 40 + t * (15.0 / 336 + t * (105.0 / 3456 + t * (945.0 / 42240)))));
  return 4.0 * q * series / s;
}

/// The length of the arc between two places that leaves the surface at both ends as steeply as the
/// straight line does.
double arc_between(const SurfacePlace& a, const SurfacePlace& b) {
  const Vec3 way = b.at - a.at;
  const double straight = length(way);
  if (straight == 0.0) return 0.0;
  const double steep = std::abs(dot(b.normal, way) - dot(a.normal, way)) / (2.0 * straight);
  return straight * arcsine_ratio(std::min(1.0, steep));
}

/// A node beside the surface that the front has come to.
struct FrontNode {
  Coord node;
  SurfacePlace place;  ///< of the surface below it
  double arc_mm = 0.0;
  std::uint32_t foot = 0;
  bool is_left = false;  ///< the front has gone on from here
};

constexpr std::uint32_t kNotSeen = 0;    ///< not looked at
constexpr std::uint32_t kNotBeside = 1;  ///< too far from the surface
constexpr std::uint32_t kFirstFrontNode = 2;

using FrontBlock = std::array<std::uint32_t, kLeafNodes>;

class MaskFront {
 public:
  MaskFront(const Clay& clay, const Mask& before, const MaskGrow& grow)
      : clay_(clay),
        before_(before),
        spacing_(before.voxel_mm()),
        by_mm_(std::abs(grow.by_mm)),
        shrinks_(grow.by_mm < 0.0),
        field_(clay) {}

  void find_feet(const std::vector<Coord>& origins, std::int64_t free_bytes, const Pace& pace);
  void run(std::int64_t free_bytes, const Pace& pace);
  /// Whether the front came within a leaf's side of this one.
  bool is_reached(const Coord& origin) const;
  void change(MaskLeaf& leaf) const;

 private:
  double share(const Vec3& p) const {
    const double masked = before_.at(p);
    return shrinks_ ? 1.0 - masked : masked;
  }
  float share_of(const Coord& node) const {
    const float masked = before_.constant(node);
    return shrinks_ ? 1.0F - masked : masked;
  }
  bool may_have_border(const Coord& origin) const;
  void add_feet(const Coord& origin, std::vector<BorderFoot>& out) const;
  std::optional<BorderFoot> foot_near(FieldSampler& field, const Vec3& from) const;
  Vec3 share_slope(const SurfacePlace& place) const;
  void look_across(FieldSampler& field, BorderFoot& foot) const;
  std::vector<float> profile(FieldSampler& field, const BorderFoot& foot, bool outward) const;

  std::uint32_t seen(const Coord& node);
  std::uint32_t known(const Coord& node) const;
  void offer(const Coord& node, std::uint32_t foot);
  bool is_done_at(const FrontNode& at) const;
  double depth_of(double arc_mm, bool is_inside) const {
    return ((is_inside ? -arc_mm : arc_mm) - by_mm_) / spacing_;
  }

  const Clay& clay_;
  const Mask& before_;
  double spacing_;
  double by_mm_;
  bool shrinks_;
  FieldSampler field_;  ///< of the thread that runs the front
  std::vector<BorderFoot> feet_;
  LeafMap<std::uint32_t> block_at_;  ///< one more than the place in blocks_
  std::vector<FrontBlock> blocks_;
  std::vector<FrontNode> nodes_;

  /// The nearest first; among equals the one seen first.
  using Waiting = std::pair<double, std::uint32_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> front_;
};

// ---- the border --------------------------------------------------------------------------------

/// Not where this leaf and those that its edges lead to have one value.
bool MaskFront::may_have_border(const Coord& origin) const {
  const float here = before_.constant(origin);
  bool is_uniform = true;
  for_each_leaf_origin({origin, origin.offsetBy(kLeafSide)}, [&](const Coord& near) {
    is_uniform = is_uniform && before_.leaf(near) == nullptr && before_.constant(near) == here;
  });
  return !is_uniform;
}

/// Of the mask as it is interpolated, over a node's spacing.
Vec3 MaskFront::share_slope(const SurfacePlace& place) const {
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = 0.5 * spacing_;
    slope[axis] = (share(place.at + step) - share(place.at - step)) / spacing_;
  }
  return slope - dot(slope, place.normal) * place.normal;
}

/// Along the surface to where the share is a half.
std::optional<BorderFoot> MaskFront::foot_near(FieldSampler& field, const Vec3& from) const {
  constexpr int kMostSteps = 8;
  constexpr double kMostNodes = 3.0;
  auto place = surface_near(field, from, 0.1 * spacing_);
  for (int step = 0; place && step < kMostSteps; ++step) {
    const double missing = kHalfShare - share(place->at);
    const Vec3 slope = share_slope(*place);
    const double steep = length(slope);
    if (steep * spacing_ < 1e-3 || length(place->at - from) > kMostNodes * spacing_) return {};
    if (std::abs(missing) < 0.01) return BorderFoot{*place, -1.0 / steep * slope, {}, {}};
    const double way = std::clamp(missing / steep, -0.5 * spacing_, 0.5 * spacing_);
    place = surface_near(field, place->at + (way / steep) * slope, 0.1 * spacing_);
  }
  return std::nullopt;
}

/// From each edge between nodes beside the surface on which the share passes a half.
void MaskFront::add_feet(const Coord& origin, std::vector<BorderFoot>& out) const {
  FieldSampler field(clay_);
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Coord node = node_of(origin, n);
    const auto here = static_cast<double>(share_of(node));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Coord next = node;
      next[static_cast<int>(axis)] += 1;
      const auto there = static_cast<double>(share_of(next));
      if ((here >= kHalfShare) == (there >= kHalfShare)) continue;
      Vec3 from = node_mm(node, spacing_);
      from[axis] += spacing_ * (kHalfShare - here) / (there - here);
      if (std::abs(field.distance_mm(from)) > spacing_) continue;
      if (auto foot = foot_near(field, from)) out.push_back(std::move(*foot));
    }
  }
}

/// Walks along the surface; a share that falls inward, or rises outward, is passed over.
std::vector<float> MaskFront::profile(FieldSampler& field, const BorderFoot& foot,
                                      bool outward) const {
  constexpr std::size_t kMostBorderNodes = 256;
  const auto grown = static_cast<std::size_t>(std::ceil(by_mm_ / spacing_));
  const std::size_t most = kMostBorderNodes + (outward ? 0 : grown);
  const float end = outward ? 0.0F : 1.0F;
  std::vector<float> shares{static_cast<float>(kHalfShare)};
  SurfacePlace at = foot.place;
  Vec3 along = outward ? foot.outward : -foot.outward;
  while (shares.size() < most && shares.back() != end) {
    const auto next = surface_near(field, at.at + spacing_ * along, 0.1 * spacing_);
    if (!next) break;
    at = *next;
    along = normalized(along - dot(along, at.normal) * at.normal);
    const auto here = static_cast<float>(share(at.at));
    shares.push_back(outward ? std::min(shares.back(), here) : std::max(shares.back(), here));
  }
  shares.push_back(shares.back());
  return shares;
}

void MaskFront::look_across(FieldSampler& field, BorderFoot& foot) const {
  foot.inside = profile(field, foot, false);
  foot.outside = profile(field, foot, true);
}

void MaskFront::find_feet(const std::vector<Coord>& origins, std::int64_t free_bytes,
                          const Pace& pace) {
  std::vector<Coord> with_border;
  for (const Coord& origin : origins) {
    if (may_have_border(origin)) with_border.push_back(origin);
  }
  pace.at(0.2);
  std::vector<std::vector<BorderFoot>> found(with_border.size());
  for_each_leaf(found.size(), [&](std::size_t n) { add_feet(with_border[n], found[n]); });
  for (auto& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(feet_));
  }
  // With profiles of usual length: as many floats as the way has nodes, and a soft border's.
  constexpr double kBorderNodes = 64.0;
  const double profile_bytes = sizeof(float) * (by_mm_ / spacing_ + kBorderNodes);
  const double bytes = static_cast<double>(feet_.size()) * (sizeof(BorderFoot) + profile_bytes);
  if (bytes > static_cast<double>(free_bytes)) throw OverLimit(static_cast<std::int64_t>(bytes));
  pace.at(0.6);
  for_each_leaf(feet_.size(), [&](std::size_t n) {
    FieldSampler field(clay_);
    look_across(field, feet_[n]);
  });
}

// ---- the front ---------------------------------------------------------------------------------

/// The node's place in nodes_ plus kFirstFrontNode, or kNotBeside.
std::uint32_t MaskFront::seen(const Coord& node) {
  std::uint32_t& block = block_at_.at(leaf_origin(node));
  if (block == 0) {
    blocks_.emplace_back();
    blocks_.back().fill(kNotSeen);
    block = static_cast<std::uint32_t>(blocks_.size());
  }
  std::uint32_t& at = blocks_[block - 1][static_cast<std::size_t>(leaf_offset(node))];
  if (at != kNotSeen) return at;
  at = kNotBeside;
  const Vec3 p = node_mm(node, spacing_);
  if (std::abs(field_.distance_mm(p)) > kBesideNodes * spacing_) return at;
  if (const auto place = surface_near(field_, p, 0.1 * spacing_)) {
    at = kFirstFrontNode + static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({node, *place, std::numeric_limits<double>::infinity(), 0, false});
  }
  return at;
}

std::uint32_t MaskFront::known(const Coord& node) const {
  const std::uint32_t block = block_at_.get(node);
  if (block == 0) return kNotSeen;
  return blocks_[block - 1][static_cast<std::size_t>(leaf_offset(node))];
}

void MaskFront::offer(const Coord& node, std::uint32_t foot) {
  const std::uint32_t found = seen(node);
  if (found < kFirstFrontNode) return;
  FrontNode& at = nodes_[found - kFirstFrontNode];
  if (at.is_left) return;
  const double arc = arc_between(feet_[foot].place, at.place);
  if (arc >= at.arc_mm) return;
  at.arc_mm = arc;
  at.foot = foot;
  front_.emplace(arc, found - kFirstFrontNode);
}

/// Beyond here nothing can change: the share is as high as it becomes, or what grows ends before.
bool MaskFront::is_done_at(const FrontNode& at) const {
  const double here = share(at.place.at);
  const double depth = depth_of(at.arc_mm, here >= kHalfShare);
  const BorderFoot& foot = feet_[at.foot];
  if (depth >= 0.0) return share_at(foot, depth) <= 0.0;
  return here >= kHalfShare && here >= static_cast<double>(foot.inside.back());
}

void MaskFront::run(std::int64_t free_bytes, const Pace& pace) {
  for (std::uint32_t n = 0; n < feet_.size(); ++n) {
    const Vec3 at = feet_[n].place.at / spacing_;
    const Coord low = Coord::floor(openvdb::Vec3d(at.x, at.y, at.z));
    for (int corner = 0; corner < 8; ++corner) {
      offer(low.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1), n);
    }
  }
  constexpr std::int64_t kStride = 1 << 14;
  for (std::int64_t done = 0; !front_.empty(); ++done) {
    if (done % kStride == 0) {
      const auto bytes = static_cast<std::int64_t>(blocks_.size() * sizeof(FrontBlock) +
                                                   nodes_.size() * sizeof(FrontNode));
      if (bytes > free_bytes) throw OverLimit(bytes);
      pace.at(0.0);
    }
    const std::uint32_t n = front_.top().second;
    front_.pop();
    if (nodes_[n].is_left) continue;
    nodes_[n].is_left = true;
    if (is_done_at(nodes_[n])) continue;
    const FrontNode from = nodes_[n];
    for (int near = 0; near < 27; ++near) {
      offer(from.node.offsetBy(near / 9 - 1, near / 3 % 3 - 1, near % 3 - 1), from.foot);
    }
  }
}

// ---- the mask after it -------------------------------------------------------------------------

/// A node up to 24 voxels from the surface lies above a place at most two leaves away.
bool MaskFront::is_reached(const Coord& origin) const {
  bool is_reached = false;
  openvdb::CoordBBox around(origin, origin);
  around.expand(2 * kLeafSide);
  for_each_leaf_origin(
      around, [&](const Coord& near) { is_reached = is_reached || block_at_.get(near) != 0; });
  return is_reached;
}

/// Each node takes the nearest of the feet that the corners of the cell below it have.
void MaskFront::change(MaskLeaf& leaf) const {
  FieldSampler field(clay_);
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Coord node = node_of(leaf.origin, n);
    const auto was = static_cast<double>(share_of(node));
    double now = was;
    if (const auto place = surface_near(field, node_mm(node, spacing_), 0.1 * spacing_)) {
      const Vec3 at = place->at / spacing_;
      const Coord low = Coord::floor(openvdb::Vec3d(at.x, at.y, at.z));
      const BorderFoot* nearest = nullptr;
      double arc_mm = std::numeric_limits<double>::infinity();
      for (int corner = 0; corner < 8; ++corner) {
        const std::uint32_t found = known(low.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1));
        if (found < kFirstFrontNode) continue;
        const FrontNode& beside = nodes_[found - kFirstFrontNode];
        if (beside.arc_mm == std::numeric_limits<double>::infinity()) continue;
        const BorderFoot& foot = feet_[beside.foot];
        const double arc = arc_between(foot.place, *place);
        if (arc >= arc_mm) continue;
        arc_mm = arc;
        nearest = &foot;
      }
      if (nearest != nullptr) {
        const bool is_inside = share(place->at) >= kHalfShare;
        now = std::max(was, share_at(*nearest, depth_of(arc_mm, is_inside)));
      }
    }
    const auto value = static_cast<float>(shrinks_ ? 1.0 - now : now);
    leaf.values[n] = value;
    leaf.is_changed = leaf.is_changed || now != was;
  }
}

}  // namespace

std::shared_ptr<Mask> grown_mask(const Clay& clay, const Mask& before, const MaskGrow& grow,
                                 std::int64_t free_bytes, const Pace& pace) {
  if (before.bytes() > free_bytes) throw OverLimit(before.bytes());
  std::shared_ptr<Mask> mask = before.copy();
  std::vector<Coord> origins = mask_leaves_near_surface(levels_of(clay));
  MaskFront front(clay, before, grow);
  front.find_feet(origins, free_bytes, pace.part(0.0, 0.3));
  front.run(free_bytes, pace.part(0.3, 0.5));
  origins.erase(std::remove_if(origins.begin(), origins.end(),
                               [&](const Coord& origin) { return !front.is_reached(origin); }),
                origins.end());
  change_mask_leaves(origins, *mask, free_bytes, pace.part(0.5, 1.0),
                     [&](MaskLeaf& leaf) { front.change(leaf); });
  return mask->is_nothing() ? nullptr : mask;
}

}  // namespace argil
