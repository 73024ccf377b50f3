// SPDX-License-Identifier: GPL-3.0-or-later
// Matter moves along the normal of the form, as it was when the stroke began, by the height that
// the images have where the normal meets the form: detail that was there goes up and down with it.
// All dabs are done at once, since what the first left is no form for the others.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/form_field.h"
#include "brush/local_plane.h"
#include "brush/masked_displacement.h"
#include "brush/motion.h"
#include "field/parallel.h"
#include "tool/alpha_stamp.h"
#include "tool/emboss_size.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

// ---- Where the images lie ----------------------------------------------------------------------

/// A dab in its place, and where the image's right side may point: the first of these that does not
/// lie along the normal.
struct PlacedDab {
  PosedTool tool;
  std::array<Vec3, 3> rights;
};

/// A place without a path: what is set there stands for itself.
Dab at_rest(Dab dab) {
  dab.from = dab.at;
  return dab;
}

/// The tool's own axes x and y of the dab that this one is an image of, as its image has them.
std::array<Vec3, 2> axes_of(const Dab& dab, const Dab& original) {
  const Quat& orientation = original.at.orientation;
  return {turned(dab, rotate(orientation, Vec3{1.0, 0.0, 0.0})),
          turned(dab, rotate(orientation, Vec3{0.0, 1.0, 0.0}))};
}

/// The way that the stroke leads at a dab; from the first one on to the next.
Vec3 way_at(std::span<const Dab> path, std::size_t images, std::size_t dab) {
  if (dab >= images) return path[dab].at.position_mm - path[dab].from.position_mm;
  if (dab + images >= path.size()) return {};
  return path[dab + images].at.position_mm - path[dab].at.position_mm;
}

/// One image, from where the stroke began to where it is now, which is its radius.
std::vector<PlacedDab> anchored_dabs(const LevelStack& stack, Tool tool, std::span<const Dab> path,
                                     std::size_t images) {
  const std::size_t last = path.size() - images;
  std::vector<PlacedDab> placed;
  const double dragged = length(path[last].at.position_mm - path[0].at.position_mm);
  if (last > 0) {
    constexpr double kMostVoxels = 128.0;  // as of any tool (clay_stroke.cpp)
    const double radius =
        std::clamp(dragged, stack.voxel_mm(0), kMostVoxels * stack.voxel_mm(stack.top()));
    tool.shape = Shape::ball;
    tool.radii_mm = {radius, radius, radius};
    tool.pressure_to_size = 0.0;  // the hand says it
  }
  for (std::size_t n = 0; n < images; ++n) {
    Dab dab = at_rest(path[n]);
    dab.from.pressure = dab.at.pressure = path[last + n].at.pressure;
    const auto [x, y] = axes_of(path[n], path[0]);
    placed.push_back(
        {PosedTool(tool, dab), {path[last + n].at.position_mm - path[n].at.position_mm, x, y}});
  }
  return placed;
}

/// In groups of `images`; without those that have no strength or size.
std::vector<PlacedDab> placed_dabs(const LevelStack& stack, const Tool& tool,
                                   std::span<const Dab> path, std::size_t images) {
  std::vector<PlacedDab> placed;
  if (tool.alpha_mode == AlphaMode::anchored && !path.empty()) {
    placed = anchored_dabs(stack, tool, path, images);
  } else {
    const bool is_placed = tool.alpha_mode == AlphaMode::space;
    for (std::size_t n = 0; n < path.size(); ++n) {
      const auto [x, y] = axes_of(path[n], path[n - n % images]);
      const Vec3 way = is_placed && tool.use_rake ? way_at(path, images, n) : Vec3{};
      placed.push_back({PosedTool(tool, is_placed ? at_rest(path[n]) : path[n]), {way, x, y}});
    }
  }
  std::erase_if(placed, [](const PlacedDab& dab) {
    return dab.tool.strength() == 0.0 || dab.tool.smallest_radius_mm() <= 0.0;
  });
  return placed;
}

/// The level that the pixels of all dabs, and the fall of their rims, need.
int level_of(const LevelStack& stack, const std::vector<PlacedDab>& dabs) {
  constexpr double kVoxelsOfTool = 8.0;  // what level_of_tool makes of a radius
  double detail = 0.0;
  for (const PlacedDab& dab : dabs) {
    const Tool& tool = dab.tool.tool();
    const double sized = dab.tool.smallest_radius_mm() / smallest_radius(tool);
    const double pixel = kVoxelsOfTool * std::min(emboss_pixel_mm(tool), 0.25 * tool.tip_roundness *
                                                                             smallest_radius(tool));
    const double here = sized * std::min(pixel, smallest_radius(tool));
    detail = detail == 0.0 ? here : std::min(detail, here);
  }
  return level_of_tool(stack, detail);
}

/// Nothing where there is no surface under the tool.
std::optional<AlphaStamp> stamp_of(const LevelStack& stack, const PlacedDab& dab, int level) {
  const double radius = dab.tool.smallest_radius_mm();
  const int plane_level = level_of_tool(stack, radius);
  const Vec3& at = dab.tool.dab().at.position_mm;
  const double reach = largest_radius(dab.tool.tool());
  Box3 box;
  box.include(at - Vec3{reach, reach, reach});
  box.include(at + Vec3{reach, reach, reach});
  CoordBBox nodes = nodes_in(box, stack.voxel_mm(plane_level));
  nodes.expand(1);
  const auto plane = plane_under(local_field(stack, plane_level, nodes), dab.tool);
  if (!plane) return std::nullopt;
  for (const Vec3& right : dab.rights) {
    const double along = dot(plane->normal, right);
    const double square = dot(right, right);
    if (square - along * along <= 1e-4 * square) continue;
    return AlphaStamp(dab.tool, plane->normal, right, stack.voxel_mm(level));
  }
  return std::nullopt;  // its axes x and y are unit and across each other: one was taken
}

// ---- How matter moves --------------------------------------------------------------------------

/// What several heights make: neither heights nor hollows add up.
class Together {
 public:
  void add(double height_mm) noexcept {
    raised_ = std::max(raised_, height_mm);
    sunk_ = std::min(sunk_, height_mm);
    const double height = count_++ == 0 ? height_mm : 0.0;
    only_ += height;
  }
  double height_mm() const noexcept { return count_ == 1 ? only_ : raised_ + sunk_; }

 private:
  double raised_ = 0.0;
  double sunk_ = 0.0;
  double only_ = 0.0;
  int count_ = 0;
};

using Near = std::vector<std::size_t>;

class Embossed final : public Motion {
 public:
  /// `stamps` of `dabs`, nothing where there is no surface under them.
  Embossed(const LevelStack& stack, const std::vector<PosedTool>& dabs,
           const std::vector<std::optional<AlphaStamp>>& stamps, std::size_t images, double most_mm)
      : dabs_(dabs),
        stamps_(stamps),
        images_(images),
        form_(stack, dabs, images, kBandOfHeight * most_mm),
        displacement_(stack.mask(), bounds_of(dabs)),
        most_mm_(most_mm) {}

  Vec3 source(const Vec3& point_mm) const override {
    return source_among(near({point_mm, point_mm}), point_mm);
  }

  void sources(const Coord& origin, double voxel_mm, PointBlock& out) const override {
    stay(out);
    const Box3 leaf = box_of(origin, voxel_mm);
    const Near stamps = near(leaf);
    if (stamps.empty()) return;
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      const Vec3 here = node_mm(node_of(origin, n), voxel_mm);
      const Vec3 from = source_among(stamps, here);
      if (from == here) continue;
      const Vec3 voxels = (from - leaf.min) / voxel_mm;
      out.x[n] = static_cast<float>(voxels.x);
      out.y[n] = static_cast<float>(voxels.y);
      out.z[n] = static_cast<float>(voxels.z);
      out.is_asked[n / kRowNodes] = true;
    }
  }

  /// Close enough: the normal is straight.
  Vec3 image(const Vec3& point_mm) const override {
    return point_mm + push(near({point_mm, point_mm}), point_mm);
  }

  CoordBBox source_nodes(const Coord& origin, double voxel_mm) const override {
    return moved_nodes(origin, voxel_mm, -1.0);
  }
  CoordBBox image_nodes(const Coord& origin, double voxel_mm) const override {
    return moved_nodes(origin, voxel_mm, 1.0);
  }

  std::vector<Box3> regions_mm() const override { return boxes_around(dabs_, images_).boxes_mm; }

 private:
  /// The form's band, in heights of the stamps: so far it tells where matter belongs.
  static constexpr double kBandOfHeight = 2.5;
  /// Matter so far from the form, in bands, moves whole, and so far not at all.
  static constexpr double kWholeBands = 0.6;
  static constexpr double kMostBands = 0.95;

  static Box3 box_of(const Coord& origin, double voxel_mm) {
    const double side = (kLeafSide - 1) * voxel_mm;
    const Vec3 low = node_mm(origin, voxel_mm);
    return {low, low + Vec3{side, side, side}};
  }

  /// The stamps that may move something within a box.
  Near near(const Box3& box_mm) const {
    Near found;
    for (std::size_t n = 0; n < dabs_.size(); ++n) {
      if (stamps_[n] && dabs_[n].bounds_mm().meets(box_mm)) found.push_back(n);
    }
    return found;
  }

  static double near_form(double bands) noexcept {
    const double t =
        std::clamp((kMostBands - std::abs(bands)) / (kMostBands - kWholeBands), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  }

  Vec3 source_among(const Near& stamps, const Vec3& point_mm) const {
    const Vec3 by = push(stamps, point_mm);
    if (by == Vec3{}) return point_mm;
    return displacement_.is_free() ? point_mm - by : displacement_.along(point_mm, -by);
  }

  /// What brought the matter here: along the normal of the form, from below or above this point.
  Vec3 push(const Near& stamps, const Vec3& point_mm) const {
    const auto within = std::find_if(stamps.begin(), stamps.end(), [&](std::size_t n) {
      return dabs_[n].bounds_mm().meets({point_mm, point_mm});
    });
    if (within == stamps.end()) return {};
    const FormField::Foot foot = form_.foot(*within, point_mm);
    const double counts = near_form(foot.bands);
    if (counts <= 0.0 || foot.up == Vec3{}) return {};
    Together together;
    for (const std::size_t n : stamps) {
      together.add(stamps_[n]->height_mm(foot.point_mm, foot.up));
    }
    return (counts * together.height_mm()) * foot.up;
  }

  /// Where the nodes of a leaf go, or come from (`side` -1), by all heights that there may be.
  CoordBBox moved_nodes(const Coord& origin, double voxel_mm, double side) const {
    const Box3 leaf = box_of(origin, voxel_mm);
    const Near stamps = near(leaf);
    if (stamps.empty()) return CoordBBox(origin, origin.offsetBy(kLeafSide - 1));
    const Vec3 middle = 0.5 * (leaf.min + leaf.max);
    const double half = 0.5 * length(leaf.size());
    const auto [bands, foot, up] = form_.foot(stamps.front(), middle);
    Box3 moved = leaf;
    // Where the form does not tell, next to nothing moves unless the leaf reaches closer to it.
    const bool is_far = half < (kMostBands - kWholeBands) * form_.band_mm();
    double margin = is_far ? 0.0 : most_mm_;
    if (up != Vec3{} && std::abs(bands) < kMostBands) {
      const HeightRange heights = heights_near(stamps, foot, up, kWider * half);
      moved = {};
      for (const double height : {heights.least, heights.most}) {
        moved.include(leaf.min + (side * height) * up);
        moved.include(leaf.max + (side * height) * up);
      }
      const double far = std::max(std::abs(heights.least), std::abs(heights.most));
      margin = far * std::min(1.0, half / dabs_[stamps.front()].smallest_radius_mm());
    }
    CoordBBox nodes = nodes_in(moved, voxel_mm);
    nodes.expand(2 + static_cast<int>(margin / voxel_mm));
    return nodes;
  }

  /// The form under a leaf is wider than the leaf where it is bent.
  static constexpr double kWider = 1.5;

  HeightRange heights_near(const Near& stamps, const Vec3& foot, const Vec3& up,
                           double radius_mm) const {
    Together least;
    Together most;
    for (const std::size_t n : stamps) {
      const HeightRange heights = stamps_[n]->heights_mm(foot, up, radius_mm);
      least.add(heights.least);
      most.add(heights.most);
    }
    return {least.height_mm(), most.height_mm()};
  }

  const std::vector<PosedTool>& dabs_;
  const std::vector<std::optional<AlphaStamp>>& stamps_;
  std::size_t images_;
  FormField form_;
  MaskedDisplacement displacement_;
  double most_mm_;
};

}  // namespace

void actions::emboss(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                     std::size_t images) {
  const LevelStack& stack = target.stack;
  const std::vector<PlacedDab> placed = placed_dabs(stack, tool, path, images);
  if (placed.empty()) return;
  const int level = level_of(stack, placed);
  std::vector<std::optional<AlphaStamp>> stamps(placed.size());
  for_each_leaf(placed.size(),
                [&](std::size_t n) { stamps[n] = stamp_of(stack, placed[n], level); });
  std::vector<PosedTool> dabs;
  double most_mm = 0.0;
  for (const PlacedDab& dab : placed) {
    const PosedTool& posed = dab.tool;
    dabs.push_back(posed);
    most_mm = std::max(most_mm, std::abs(posed.strength()) * emboss_ratio(posed.tool()) *
                                    posed.smallest_radius_mm());
  }
  if (std::none_of(stamps.begin(), stamps.end(), [](const auto& is) { return is.has_value(); })) {
    return;
  }
  EditTarget at_once = target;
  at_once.redistance_queue = nullptr;
  move_matter(at_once, Embossed(stack, dabs, stamps, images, most_mm), level);
}

}  // namespace argil
