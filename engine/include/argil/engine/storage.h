// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "argil/engine/clay.h"

namespace argil {

// The levels of a clay as plain data, so that files can hold them without knowing how the engine
// keeps them. A level is a tree of sparse cubes:
//
//   leaf           8^3 nodes, a value in mm each, and a bit each that is set within the band
//   lower branch   16^3 slots, each a leaf or one value (a tile) for the 8^3 nodes there
//   upper branch   32^3 slots, each a lower branch or one value for the 128^3 nodes there
//   root           any number of upper branches, and tiles of 4096^3 nodes
//
// A node of level L has integer coordinates and lies at coordinate * h_L. The origin of a cube is
// its lowest node, a multiple of its side. Nodes and slots are numbered x slowest, z fastest; bit n
// of a mask is bit n % 64 of word n / 64. This is the layout of an OpenVDB tree 5-4-3.

using NodeCoord = std::array<std::int32_t, 3>;

namespace storage {
inline constexpr int kLeafSide = 8;
inline constexpr int kLeafNodes = 512;
inline constexpr int kLowerSide = 128;
inline constexpr int kLowerSlots = 4096;
inline constexpr int kUpperSide = 4096;
inline constexpr int kUpperSlots = 32768;
inline constexpr int kMostLevels = 24;  ///< of a clay: from 0.05 mm to 400 m
inline constexpr int kMaskVoxels = 2;   ///< spacing of a mask in finest voxels
}  // namespace storage

/// A leaf without its values, which a LevelSink says where to write.
struct StoredLeaf {
  NodeCoord origin{};
  std::array<std::uint64_t, 8> active{};  ///< of its nodes
};

/// A lower or an upper branch, by the number of its slots. Valid during the call that hands it
/// over: whoever needs it longer copies it.
struct StoredBranch {
  NodeCoord origin{};
  std::span<const std::uint64_t> children;  ///< slots that are a leaf or a lower branch
  std::span<const std::uint64_t> active;    ///< tiles that count as within the band
  std::span<const float> values;            ///< of each slot; that of a child means nothing

  bool is_lower() const noexcept { return values.size() == storage::kLowerSlots; }
};

/// Takes a level, or a mask, cube by cube.
///
/// Shapes       every branch before its children; the leaves last, all at once. Cubes do not
///              overlap, and origins are multiples of their cube's side.
/// Errors       none to return; a sink may throw std::bad_alloc.
/// Threads      one. The values of leaves may be written from several, each leaf by one.
class LevelSink {
 public:
  virtual ~LevelSink() = default;

  /// A tile of the root: one value for 4096^3 nodes from `origin` on.
  virtual void add_tile(const NodeCoord& origin, float value, bool is_active) = 0;
  virtual void add_branch(const StoredBranch& branch) = 0;

  /// Returns for each leaf where its storage::kLeafNodes values shall be written. Each lies in a
  /// lower branch that was added, in a slot that is a child.
  virtual std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) = 0;
};

/// What a clay stores, to be read. Refers to the clay and copies nothing.
///
/// Shapes       level: 0, the finest, to level_count() - 1 (assert).
/// Threads      as Clay, which must stay and not change meanwhile.
class StoredClay {
 public:
  explicit StoredClay(const Clay& clay) noexcept;

  int level_count() const noexcept;
  double voxel_mm(int level) const noexcept;
  /// The value outside the band: kHalfWidthVoxels * h_L.
  float band_mm(int level) const noexcept;

  /// Hands a level to `to`. Cost  a copy of 2 KB for each leaf, spread over TBB.
  void copy_level(int level, LevelSink& to) const;

  /// The value at a node of `level` whatever finer levels say: stored, else interpolated in the
  /// next coarser level that stores it. What a tile of a level below the coarsest says means
  /// nothing; this does.
  float sample(int level, const NodeCoord& node) const;

  /// Origins of the leaves of a level, sorted by x, y and z. Cost  n log n.
  std::vector<NodeCoord> leaf_origins(int level) const;

  /// The storage::kLeafNodes values of the leaf there, or null where the level has none. Valid
  /// until the clay changes.
  const float* leaf(int level, const NodeCoord& origin) const;

  bool has_mask() const noexcept;
  /// What a mask says where it keeps nothing: 0 or 1. Of a clay that has one, as copy_mask.
  float mask_elsewhere() const;
  /// Hands the mask to `to`: leaves have nodes storage::kMaskVoxels finest voxels apart, with
  /// values from 0, free, to 1.
  void copy_mask(LevelSink& to) const;

 private:
  const class LevelStack* stack_;  ///< private to the engine
};

/// What keeps stored levels from being a clay.
struct NestingProblem {
  bool lacks_parent = false;  ///< else the parent of a neighbour
  int level = 0;              ///< of the leaf that lacks it in the next coarser level
  NodeCoord origin{};
};

/// Makes a clay of stored levels. Nothing that is handed over is trusted: first the levels and the
/// mask are written, then each is asked for its faults, and only a builder without any may finish.
///
/// Threads      one; spreads over TBB.
/// Memory       leaves are written where the clay keeps them: no copy is made.
class ClayBuilder {
 public:
  /// `options` that validate_options accepts; `levels` 1 to storage::kMostLevels.
  ClayBuilder(const ClayOptions& options, int levels);
  ~ClayBuilder();
  ClayBuilder(const ClayBuilder&) = delete;
  ClayBuilder& operator=(const ClayBuilder&) = delete;

  /// Each level is written once. What is added must not overlap.
  LevelSink& level(int level);

  /// Likewise the mask, if there is one.
  LevelSink& mask(float elsewhere);

  double voxel_mm(int level) const noexcept;
  float band_mm(int level) const noexcept;

  /// Whether values are within the level's band, those on its edge inactive, and leaves within
  /// reach: what edits and queries of a level rely on. Cost  linear in its nodes.
  bool is_sound(int level) const;

  /// Whether the mask holds nothing but numbers from 0 to 1, dense leaves, and tiles of a leaf's
  /// size. True where none was written.
  bool is_mask_sound() const;

  /// Where the levels do not nest. All must be sound. Cost  about a microsecond a leaf on each
  /// core.
  std::optional<NestingProblem> nesting_problem() const;

  /// The clay, with nothing to undo; this is of no further use. Levels and mask must be sound and
  /// nest: only debug builds look again, and edits and queries of a clay that is not so may fail.
  Clay finish() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
