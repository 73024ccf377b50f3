// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/winding_number.h"
#include "argil/engine/mesh_distance.h"

#include "field/level_stack.h"
#include "field/vdb.h"
#include "import/column_winding.h"
#include "import/import_input.h"
#include "import/lattice_winding.h"

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
  NodeMask suspicious;       ///< nodes that ask_walls() is to look at
  bool doubtful = false;     ///< an unknown node lies within the band
  bool wall = false;         ///< a wall was met
  std::int64_t bridged = 0;  ///< nodes with w between 1/4 and 3/4
};

/// The input with what questions about it are put to: winding numbers of nodes at once, and after
/// build_trees() those of any place and the nearest triangles, which few nodes need.
class ImportSampler {
 public:
  /// Keeps a reference to `input`.
  explicit ImportSampler(const ImportInput& input);

  const ImportInput& input() const noexcept { return input_; }
  double voxel() const noexcept { return input_.voxel_mm; }
  double band() const noexcept { return kHalfWidthVoxels * input_.voxel_mm; }

  /// The position of a node relative to the input's centre. Rounds as the positions of the input
  /// did, so that a node on a triangle's plane stays on it.
  Vec3 position(const Coord& node) const noexcept {
    const double h = input_.voxel_mm;
    return Vec3{node.x() * h, node.y() * h, node.z() * h} - input_.center;
  }
  /// Of the input and the cones that close it.
  const LatticeWinding& lattice() const noexcept { return *lattice_; }
  /// What the open edges contribute to w, which is the winding number of the closed mesh less this.
  double open_fraction(const Vec3& point) const noexcept { return cones_->at(point); }
  /// Whether the nodes of a leaf are clear of open edges: w is within 1/4 of a whole number.
  bool is_clear(const Coord& origin) const noexcept;
  /// Whether there are so many that most_change knows nothing.
  bool has_many_gaps() const noexcept { return cones_ && rims_.empty(); }
  /// By how much `open_fraction` may differ within a ball from that of its middle; infinite where
  /// the cones pass, across which it jumps.
  double most_change(const Vec3& center, double radius) const noexcept;

  /// Makes what is asked for below. To be called by one thread, once or more often.
  void build_trees();
  const MeshDistance& distance() const noexcept {
    assert(distance_);
    return *distance_;
  }
  double winding(const Vec3& point) const noexcept {
    assert(columns_);
    return columns_->at(point) - (cones_ ? cones_->at(point) : 0.0);
  }
  bool inside(const Vec3& point) const noexcept { return winding(point) > 0.5; }

 private:
  const ImportInput& input_;
  std::optional<LatticeWinding> lattice_;
  std::vector<Vec3> apexes_;               ///< of open input, behind its own positions
  std::vector<Triangle> cone_triangles_;   ///< which close it
  std::optional<WindingNumber> cones_;     ///< of these
  std::vector<std::array<Vec3, 2>> rims_;  ///< its open edges; none where they are too many to sum
  std::optional<MeshDistance> distance_;
  std::optional<ColumnWinding> columns_;
};

/// A leaf from the squares of its nodes' distances to the triangles, in voxels. Its suspicious
/// nodes are those that a triangle comes near to without a change of side around them.
ImportLeaf signed_leaf(const ImportSampler& sampler, const Coord& origin, const float* squares);

/// A leaf of open input that no triangle comes near to.
ImportLeaf leaf_of_gap(const ImportSampler& sampler, const Coord& origin);

/// Looks at the suspicious nodes of a leaf, after which none is left, and at its unknown ones: the
/// distance of those whose nearest triangle is a wall becomes unknown. Wants trees.
void ask_walls(const ImportSampler& sampler, const Coord& origin, ImportLeaf& leaf);

/// Makes all nodes suspicious that are known.
void suspect_all(ImportLeaf& leaf);

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
