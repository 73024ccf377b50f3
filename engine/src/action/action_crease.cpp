// SPDX-License-Identifier: GPL-3.0-or-later
// A profile is cut into the clay, or laid on it, as a blade would whose section bends with the
// surface: a node's place in the section is how far it lies beside the line and how far from the
// surface as the stroke found it, and there the distance to the profile is known. What pieces of
// the path leave is a union, so neither their order nor their number counts, nothing is
// redistanced and only what is under the tool is looked at.
//
// Notation: the start is the distance to the surface as the stroke found it; beside and up are
// those of ProfilePiece::Place.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "action/action.h"
#include "brush/dab_plan.h"
#include "brush/local_plane.h"
#include "brush/profile_piece.h"
#include "edit/restriction.h"
#include "field/halo.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// Levels finer than the tool's along the line, where the profile is pointed: two would cost as
/// much again as all else.
constexpr int kLineLevels = 1;
/// The point is rounded over so many voxels of the finest of them to either side. Less, and the
/// bottom is a comb; more, and it is dull.
constexpr double kRoundVoxels = 1.06;
/// So far beside the line leaves of these levels are wanted, in their voxels.
constexpr double kBesideLineVoxels = 1.0;
/// Values so near the band say no more than their side.
constexpr float kKnownOfBand = 0.999F;
/// Of a leaf's half diagonal to its half side.
constexpr double kDiagonal = std::numbers::sqrt3;

double half_leaf_mm(const LevelStack& stack, int level) {
  return 0.5 * (kLeafSide - 1) * stack.voxel_mm(level);
}

Vec3 middle_of(const LevelStack& stack, int level, const Coord& origin) {
  const double half = half_leaf_mm(stack, level);
  return node_mm(origin, stack.voxel_mm(level)) + Vec3{half, half, half};
}

// ---- Planning ----------------------------------------------------------------------------------

/// How far the surface was from a leaf's middle, and how inexact that is; from the finest level
/// that still knows, and beyond all bands at least that far.
struct FromStart {
  double distance_mm;
  double margin_mm;
};

FromStart start_at_middle(const LevelStack& stack, const StrokeStart& start, int level,
                          const Coord& origin) {
  assert(is_leaf_origin(origin));
  Coord node = origin.offsetBy(kLeafSide / 2);
  int at = level;
  float value = start.sample(at, node);
  while (at < stack.top() && std::abs(value) >= kKnownOfBand * stack.band_mm(at)) {
    node = coarser(node);
    value = start.sample(++at, node);
  }
  // The node lies beside the middle, and up to a voxel from where it was on finer levels.
  return {static_cast<double>(value), 2.0 * stack.voxel_mm(at)};
}

/// Whether the piece may change a node within the band of a leaf's level.
bool takes_part_in(const LevelStack& stack, const StrokeStart& start, const ProfilePiece& piece,
                   int level, const Coord& origin) {
  const double half = kDiagonal * half_leaf_mm(stack, level);
  if (piece.place_of(middle_of(stack, level, origin)).beside_mm - half > piece.half_width_mm()) {
    return false;
  }
  const auto band = static_cast<double>(stack.band_mm(level));
  const FromStart from = start_at_middle(stack, start, level, origin);
  const double away = std::abs(from.distance_mm);
  if (level == stack.top() && away >= static_cast<double>(kKnownOfBand) * band) return true;
  return away - half - from.margin_mm < band + piece.most_depth_mm();
}

/// Whether the surface passes, after the piece, through a leaf no farther than `beside_mm` beside
/// the line.
bool may_have_surface(const LevelStack& stack, const StrokeStart& start, const ProfilePiece& piece,
                      double beside_mm, int level, const Coord& origin) {
  const double half = kDiagonal * half_leaf_mm(stack, level);
  const ProfilePiece::Place place = piece.place_of(middle_of(stack, level, origin));
  if (place.beside_mm - half > beside_mm) return false;
  const FromStart from = start_at_middle(stack, start, level, origin);
  const double above = piece.side() * from.distance_mm;
  const double near = half + from.margin_mm;
  return above < near && above > -piece.most_depth_mm() - near;
}

/// Plans what one piece of a path changes.
class PiecePlan {
 public:
  PiecePlan(Edit& edit, const LevelStack& stack, const StrokeStart& start,
            const ProfilePiece& piece)
      : edit_(edit), stack_(stack), start_(start), piece_(piece) {}

  /// The tool's level or a coarser one: all that changes.
  void want_all(int level) const {
    want(level, origins_in(reached(level)),
         [&](const Coord& origin) { return takes_part_in(stack_, start_, piece_, level, origin); });
  }

  /// Finer ones: leaves that are there, those that the detail which the stroke found moves to, and
  /// where a border of the mask is sharp.
  void want_detail(int level) const {
    const openvdb::CoordBBox nodes = reached(level);
    std::vector<Coord> origins = leaves_in(stack_, level, nodes);
    std::vector<Coord> beside;
    for (const Coord& origin : origins) {
      if (start_.values(level, origin) == nullptr) continue;
      const openvdb::CoordBBox around(origin.offsetBy(-kLeafSide),
                                      origin.offsetBy(2 * kLeafSide - 1));
      for_each_leaf_origin(around, [&](const Coord& at) {
        if (!stack_.has_leaf(level, at)) beside.push_back(at);
      });
    }
    want(level, beside, [&](const Coord& origin) {
      return may_have_surface(stack_, start_, piece_, piece_.half_width_mm(), level, origin);
    });
    if (stack_.mask() != nullptr) {
      const std::vector<Coord> border = border_origins(stack_, level, nodes);
      origins.insert(origins.end(), border.begin(), border.end());
    }
    want(level, origins,
         [&](const Coord& origin) { return takes_part_in(stack_, start_, piece_, level, origin); });
  }

  /// Where the middle of the profile passes, or next to that.
  void want_line(int level) const {
    const double voxel = stack_.voxel_mm(level);
    const double beside = kBesideLineVoxels * voxel;
    const double up = piece_.most_depth_mm() + 0.25 * piece_.reach_mm();
    const openvdb::CoordBBox nodes = nodes_in(piece_.bounds_mm(beside, up), voxel);
    want(level, origins_in(nodes), [&](const Coord& origin) {
      return may_have_surface(stack_, start_, piece_, beside, level, origin);
    });
  }

 private:
  /// Nodes that may change and are within the band of their level then.
  openvdb::CoordBBox reached(int level) const {
    const double up =
        piece_.reach_mm() + piece_.most_depth_mm() + static_cast<double>(stack_.band_mm(level));
    return nodes_in(piece_.bounds_mm(piece_.half_width_mm(), up), stack_.voxel_mm(level));
  }

  template <class IsWanted>
  void want(int level, const std::vector<Coord>& origins, const IsWanted& is_wanted) const {
    std::vector<std::uint8_t> takes(origins.size());
    for_each_leaf(origins.size(), [&](std::size_t n) { takes[n] = is_wanted(origins[n]); });
    for (std::size_t n = 0; n < origins.size(); ++n) {
      if (takes[n] != 0) edit_.want(level, origins[n]);
    }
  }

  Edit& edit_;
  const LevelStack& stack_;
  const StrokeStart& start_;
  const ProfilePiece& piece_;
};

void plan_piece(Edit& edit, const LevelStack& stack, const StrokeStart& start,
                const ProfilePiece& piece, int tool_level) {
  const PiecePlan plan(edit, stack, start, piece);
  for (int level = stack.top(); level >= 0; --level) {
    if (level >= tool_level) {
      plan.want_all(level);
      continue;
    }
    plan.want_detail(level);
    if (level >= tool_level - kLineLevels) plan.want_line(level);
  }
}

// ---- The start on the leaves of an edit ---------------------------------------------------------

/// The starts of all leaves of an edit, where they are beyond the band of their level taken from
/// the coarser ones: only the coarsest cuts them short.
class Starts {
 public:
  Starts(const LevelStack& stack, const StrokeStart& start, Edit& edit)
      : start_(start), levels_(static_cast<std::size_t>(edit.count())) {
    for (int n = stack.top(); n >= 0; --n) read_level(stack, edit, n);
  }

  /// Null where a leaf is not of the edit.
  const float* values_at(const LevelEdit& level, const Coord& origin) const {
    const LeafEdit* leaf = level.find(origin);
    if (leaf == nullptr) return nullptr;
    const OfLevel& of = levels_[static_cast<std::size_t>(level.level())];
    return of.values[static_cast<std::size_t>(leaf - level.leaves().data())];
  }

  /// Whether the stroke found a leaf of the level there or beside it.
  bool has_found(int level, const Coord& origin) const {
    const openvdb::CoordBBox around(origin.offsetBy(-kLeafSide),
                                    origin.offsetBy(2 * kLeafSide - 1));
    bool found = false;
    for_each_leaf_origin(
        around, [&](const Coord& at) { found = found || start_.values(level, at) != nullptr; });
    return found;
  }

  /// The nodes of a box.
  LocalField read(const LevelEdit& level, const openvdb::CoordBBox& box) const {
    LocalField field{box, level.voxel_mm(), {}};
    field.value.resize(static_cast<std::size_t>(box.volume()));
    for_each_leaf_origin(box, [&](const Coord& origin) {
      LeafValues filled;
      const float* values = values_at(level, origin);
      if (values == nullptr) start_.read(level.level(), origin, filled);
      copy_into_box(origin, values != nullptr ? values : filled.data(), box, field.value);
    });
    return field;
  }

  /// The leaf's and what is beside it; unknown where that is in no leaf of the edit.
  void gather(const LevelEdit& level, const Coord& origin, HaloBlock& block) const {
    static const LeafValues unknown = [] {
      LeafValues values;
      values.fill(std::numeric_limits<float>::quiet_NaN());
      return values;
    }();
    std::array<const float*, kHaloLeaves> around{};
    for_each_halo_leaf(origin, [&](std::size_t n, const Coord& at) {
      const float* values = values_at(level, at);
      around[n] = values != nullptr ? values : unknown.data();
    });
    gather_halo(around, block);
  }

 private:
  struct OfLevel {
    std::vector<const float*> values;                  // in the order of the edit's leaves
    std::vector<std::unique_ptr<LeafValues>> written;  // of those that no level has like this
  };

  void read_level(const LevelStack& stack, Edit& edit, int n) {
    const LevelEdit& level = edit.level(n);
    OfLevel& of = levels_[static_cast<std::size_t>(n)];
    of.values.resize(level.leaves().size());
    of.written.resize(level.leaves().size());
    const float known = kKnownOfBand * level.band_mm();
    for_each_leaf(level.leaves().size(), [&](std::size_t i) {
      const Coord& origin = level.leaves()[i].origin;
      const float* stored = start_.values(n, origin);
      const auto is_cut = [&](float value) { return std::abs(value) >= known; };
      if (stored != nullptr &&
          (n == stack.top() || std::none_of(stored, stored + kLeafNodes, is_cut))) {
        of.values[i] = stored;
        return;
      }
      of.written[i] = std::make_unique<LeafValues>();
      LeafValues& values = *of.written[i];
      of.values[i] = values.data();
      if (n == stack.top()) return start_.read(n, origin, values);
      upsample(coarse_starts(edit.level(n + 1), origin), values);
      if (stored == nullptr) return;
      for (std::size_t k = 0; k < kLeafNodes; ++k) {
        if (!is_cut(stored[k])) values[k] = stored[k];
      }
    });
  }

  CoarseNodes coarse_starts(const LevelEdit& coarser, const Coord& origin) const {
    return gather_coarse(
        origin, [&](const Coord& at) { return values_at(coarser, at); },
        [&](const Coord& node) { return start_.sample(coarser.level(), node); });
  }

  const StrokeStart& start_;
  std::vector<OfLevel> levels_;
};

// ---- One edit -----------------------------------------------------------------------------------

/// The plane is a mean over all that is under the tool: the next coarser level says as much.
std::vector<ProfilePiece> pieces_of(const LevelStack& stack, const StrokeStart& start,
                                    std::span<const PosedTool> path, int tool_level, double side) {
  const int plane_level = std::min(tool_level + 1, stack.top());
  const double voxel = stack.voxel_mm(plane_level);
  const double least_round = kRoundVoxels * stack.voxel_mm(std::max(0, tool_level - kLineLevels));
  std::vector<ProfilePiece> pieces;
  for (const PosedTool& tool : path) {
    openvdb::CoordBBox box = nodes_in(tool.bounds_mm(), voxel);
    box.expand(1);
    const auto plane = plane_under(local_field(start, voxel, plane_level, box), tool);
    if (plane) pieces.emplace_back(tool, *plane, side, least_round);
  }
  return pieces;
}

/// Whether a piece may change some node of a leaf.
bool reaches_leaf(const ProfilePiece& piece, const LevelEdit& level, const Coord& origin,
                  const float* start) {
  const LevelStack& stack = level.stack();
  const double half = kDiagonal * half_leaf_mm(stack, level.level());
  const Vec3 middle = middle_of(stack, level.level(), origin);
  if (piece.place_of(middle).beside_mm - half > piece.half_width_mm()) return false;
  const auto [least, most] = std::minmax_element(start, start + kLeafNodes);
  const float low = piece.side() > 0.0 ? *least : -*most;
  const float high = piece.side() > 0.0 ? *most : -*least;
  const float band = level.band_mm();
  const bool is_cut = level.level() == stack.top() && low <= -kKnownOfBand * band;
  return is_cut || (low < band && high > -band - static_cast<float>(piece.most_depth_mm()));
}

/// A field between its nodes.
double value_between(const LocalField& field, const Vec3& point_mm) {
  const Vec3 at = point_mm / field.voxel_mm;
  const Vec3 low{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
  const Vec3 t = at - low;
  const Coord first =
      Coord(static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z)) -
      field.box.min();
  const Coord dim = field.box.dim();
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Coord node = first.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1);
    const double weight = (corner & 4 ? t.x : 1.0 - t.x) * (corner & 2 ? t.y : 1.0 - t.y) *
                          (corner & 1 ? t.z : 1.0 - t.z);
    const int index = (node.x() * dim.y() + node.y()) * dim.z() + node.z();
    sum += weight * static_cast<double>(field.value[static_cast<std::size_t>(index)]);
  }
  return sum;
}

/// Where the stroke found detail that is finer than the tool, it goes up or down with the surface
/// as it is: the start is read at the place that a node's matter comes from. Only near the surface
/// is the distance to detail what it seems: deeper it leaves crumbs.
void carry_detail(const LevelEdit& level, const Coord& origin, const Starts& starts,
                  const ProfilePiece& piece, const LeafValues& free, HaloBlock& block) {
  const double voxel = level.voxel_mm();
  const Vec3 farthest = piece.side() * piece.most_depth_mm() * piece.normal();
  Box3 box;
  for (const Vec3& end : {node_mm(origin, voxel), node_mm(origin.offsetBy(kLeafSide - 1), voxel)}) {
    box.include(end);
    box.include(end + farthest);
  }
  openvdb::CoordBBox nodes = nodes_in(box, voxel);
  nodes.expand(1);
  const LocalField field = starts.read(level, nodes);
  std::fill(std::begin(block.value), std::end(block.value),
            std::numeric_limits<float>::quiet_NaN());
  LeafValues carried;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Vec3 point = node_mm(node_of(origin, n), voxel);
    const double by = piece.side() * piece.sunk_mm(point) * static_cast<double>(free[n]);
    carried[n] = static_cast<float>(value_between(field, point + by * piece.normal()) - by);
  }
  set_own(carried.data(), block);
}

/// What the pieces leave of one leaf.
void lay_on_leaf(LeafEdit& leaf, const LevelEdit& level, const Starts& starts,
                 std::span<const ProfilePiece> pieces, int tool_level) {
  const LevelStack& stack = level.stack();
  const float* own = starts.values_at(level, leaf.origin);
  assert(own != nullptr);
  const float band = level.band_mm();
  const float known =
      kKnownOfBand * (level.level() == stack.top() ? band : std::numeric_limits<float>::max());
  const bool has_detail =
      level.level() < tool_level && starts.has_found(level.level(), leaf.origin);
  std::optional<HaloBlock> start;
  LeafValues free;
  LeafValues now;
  for (const ProfilePiece& piece : pieces) {
    if (!reaches_leaf(piece, level, leaf.origin, own)) continue;
    if (!start) {
      starts.gather(level, leaf.origin, start.emplace());
      const LeafMask mask(stack.mask(), level.level(), leaf.origin);
      for (std::size_t n = 0; n < kLeafNodes; ++n) {
        free[n] = static_cast<float>(mask.free_fraction(n));
      }
      std::copy_n(leaf.now(), kLeafNodes, now.begin());
    }
    if (has_detail) carry_detail(level, leaf.origin, starts, piece, free, *start);
    row_loops().lay_profile(piece.job_of(leaf.origin, level.voxel_mm(), band, known), *start,
                            free.data(), now.data());
  }
  if (start) leaf.write_all(now);
}

void lay_profiles(EditTarget& target, const StrokeStart& start, const ToolPath& path,
                  int tool_level, double side) {
  assert(!path.empty() && target.stack.is_level(tool_level));
  const LevelStack& stack = target.stack;
  const std::vector<ProfilePiece> pieces = pieces_of(stack, start, path, tool_level, side);
  if (pieces.empty()) return;
  Edit edit(target);
  for (const ProfilePiece& piece : pieces) plan_piece(edit, stack, start, piece, tool_level);
  edit.load();
  const Starts starts(stack, start, edit);
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    std::vector<LeafEdit>& leaves = level.leaves();
    for_each_leaf(leaves.size(), [&](std::size_t i) {
      lay_on_leaf(leaves[i], level, starts, pieces, tool_level);
    });
    level.mark_changes();
    if (n == 0) continue;
    edit.restrict_to(n, RestrictedLeaves::touched);
    level.mark_changes();
  }
  edit.drop_empty();
  edit.commit();
}

/// 1: a positive strength sinks the surface.
double side_of(const Tool& tool, double side) { return tool.strength < 0.0 ? -side : side; }

}  // namespace

void actions::crease(EditTarget& target, const StrokeStart& start, const ToolPath& path,
                     int tool_level) {
  lay_profiles(target, start, path, tool_level, side_of(path.front().tool(), 1.0));
}

void actions::ridge(EditTarget& target, const StrokeStart& start, const ToolPath& path,
                    int tool_level) {
  lay_profiles(target, start, path, tool_level, side_of(path.front().tool(), -1.0));
}

}  // namespace argil
