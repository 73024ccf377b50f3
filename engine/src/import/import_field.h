// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/winding_number.h"
#include "argil/engine/mesh_distance.h"

#include "field/level_stack.h"
#include "field/vdb.h"
#include "import/import_input.h"

namespace argil {

// Notation: w is the generalized winding number; a point is inside where w > 1/2. A wall is a piece
// of the input with inside on both sides (or outside on both): no surface of the solid. The
// membrane is where w passes 1/2 without a triangle: what closes the gaps of open input.

using NodeMask = openvdb::util::NodeMask<3>;

/// One leaf while it is being made. Values are signed; until `solve_doubtful` an unknown node
/// holds an upper bound of its distance.
struct ImportLeaf {
  std::unique_ptr<VdbLeaf> leaf;
  NodeMask unknown;          ///< nodes whose nearest triangle is not known to be the surface
  bool doubtful = false;     ///< an unknown node lies within the band
  bool wall = false;         ///< a wall was met while looking at suspicious nodes only
  std::int64_t bridged = 0;  ///< nodes with w between 1/4 and 3/4
};

/// Which nodes are asked whether their nearest triangle is the surface, and no wall.
enum class AskWalls {
  suspicious,  ///< those that a triangle comes near to without a change of side around them
  all,
};

/// The input with the two trees that questions about it are put to.
class ImportSampler {
 public:
  explicit ImportSampler(const ImportInput& input)
      : input_(input),
        distance_(input.positions, input.triangles),
        winding_(input.positions, input.triangles) {}

  const ImportInput& input() const noexcept { return input_; }
  double voxel() const noexcept { return input_.voxel_mm; }
  double band() const noexcept { return kHalfWidthVoxels * input_.voxel_mm; }
  const MeshDistance& distance() const noexcept { return distance_; }

  /// The position of a node relative to the input's centre. Rounds as the positions of the input
  /// did, so that a node on a triangle's plane stays on it.
  Vec3 position(const Coord& node) const noexcept {
    const double h = input_.voxel_mm;
    return Vec3{node.x() * h, node.y() * h, node.z() * h} - input_.center;
  }
  double winding(const Vec3& point) const noexcept { return winding_.at(point); }
  /// What the open edges contribute to it: `winding` is a whole number less this.
  double open_fraction(const Vec3& point) const noexcept { return winding_.cones_at(point); }
  bool inside(const Vec3& point) const noexcept { return winding_.at(point) > 0.5; }

 private:
  const ImportInput& input_;
  MeshDistance distance_;
  SolidWinding winding_;
};

/// Leaves that may hold a node nearer than the band to a triangle, none missed. Sorted.
std::vector<Coord> leaves_near_triangles(const ImportSampler& sampler);

/// Distance and sign of the nodes of one leaf.
ImportLeaf sample_leaf(const ImportSampler& sampler, const Coord& origin, AskWalls ask);

/// The leaves of the finest level while they are made, found by origin.
struct ImportField {
  std::vector<Coord> origins;  ///< sorted
  std::vector<ImportLeaf> leaves;

  /// Index of the leaf at `origin`, or -1.
  std::ptrdiff_t find(const Coord& origin) const;
  /// Adds leaves, replacing those that are present. `more_origins` sorted.
  void merge(const std::vector<Coord>& more_origins, std::vector<ImportLeaf> more_leaves);
};

/// The given leaves and their 26 neighbours, sorted.
std::vector<Coord> widened(const std::vector<Coord>& origins);

/// The neighbours of those leaves that the membrane passes, as far as they are not present yet:
/// sorted. Empty when the field holds the membrane and its band whole.
std::vector<Coord> leaves_beside_membrane(const ImportSampler& sampler, const ImportField& field);

/// Gives every unknown node its distance to the surface of the solid: beside a crossing from where
/// w passes 1/2 on the lattice edges, beyond by fast marching; never more than its upper bound.
void solve_doubtful(const ImportSampler& sampler, ImportField& field);

/// Distance field of the finest level, values clamped to the band, inside as tiles.
struct FinestLevel {
  VdbGrid::Ptr grid;
  std::int64_t bridged_nodes = 0;
  bool walls = false;
};

/// Errors  interrupted by `progress`; memory when the membrane outgrows `limit_bytes`; bad_input
///         when no node is inside. Throws std::bad_alloc.
Result<FinestLevel> build_finest_level(const ImportInput& input, const Progress& progress,
                                       std::uint64_t limit_bytes);

}  // namespace argil
