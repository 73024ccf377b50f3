// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/level_reader.h"
#include "rows/rows.h"

namespace argil {

/// The layers |phi| = kLayerVoxels voxels on both sides of the surface: far enough from it that
/// kinks are rounded off, near enough that the band knows the gradient there.
inline constexpr double kLayerVoxels = 1.75;
/// How far around its foot a bent patch is believed, in voxels from one foot to the next.
inline constexpr double kPatchVoxels = 0.75;
/// Nodes nearer to the surface are told by the level itself, in its voxels; nodes farther than
/// kOfFeetVoxels by feet; those between by a mix.
inline constexpr double kOfLevelVoxels = kLayerVoxels - 0.7;
inline constexpr double kOfFeetVoxels = kLayerVoxels + 0.35;

/// The smallest box around some points, inverted and infinite while there are none.
struct PointBox {
  std::array<float, 3> low;
  std::array<float, 3> high;

  PointBox() noexcept;
  void include(const ClusterBoxes& boxes, std::size_t cluster) noexcept;
};

/// The points of one layer at the nodes of a leaf, in eight clusters of 4^3 nodes. Points are in mm
/// from the leaf's origin.
struct LayerFeet {
  /// Of a point, by name of the arrays.
  enum Field { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kBend, kFields };
  static_assert(kFields == LayerPoints::kFields);

  std::vector<float> values;  ///< an array of count() for each field
  /// Where each cluster begins, and all end: multiples of kRowNodes, filled up with points that are
  /// nowhere.
  std::array<int, ClusterBoxes::kClusters + 1> first{};
  ClusterBoxes feet{};     ///< around the points themselves; set where values are not empty
  ClusterBoxes surface{};  ///< around the points of the surface below them
  PointBox all_feet;       ///< around those of all clusters
  PointBox all_surface;

  int count() const noexcept { return first.back(); }
  bool is_empty() const noexcept { return values.empty(); }
  const float* field(int which) const noexcept { return values.data() + which * count(); }
};

/// One of 64 bits for a cluster of a leaf, which others may have, too.
std::uint64_t label_of(int level, const Coord& origin, std::size_t side,
                       std::size_t cluster) noexcept;

/// Of one leaf: outside and inside.
using LeafLayers = std::array<LayerFeet, 2>;

/// A point that is farther than any.
inline constexpr float kNowhere = 1e15F;

/// A leaf's nodes and those beside its faces, from its origin less (1, 1, 1), z fastest; edges and
/// corners are not set.
using LeafAndFaces = std::array<float, 1000>;

/// Reads them of a leaf of `level`. Faces of leaves that the level does not store are the bound of
/// the band: it ends there, or is so flat that coarser levels describe it.
LevelReader::Reading read_with_faces(LevelReader& reader, int level, const Coord& origin,
                                     LeafAndFaces& values);

/// The points of both layers near the nodes of a leaf. A node whose cube the layer crosses gives
/// one: its projection along the gradient, with the layer's normal and mean curvature there.
/// `is_average`: the layer is moved back by what averaging moved it, for levels that stand in for a
/// finer one. A side that is not `wanted` stays empty.
/// Cost     25 to 45 ns for each point.
LeafLayers find_layers(const LeafAndFaces& values, double voxel_mm, bool is_average,
                       const std::array<bool, 2>& wanted = {true, true});

}  // namespace argil
