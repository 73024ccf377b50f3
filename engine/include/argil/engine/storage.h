// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
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
  std::span<const float> values;  ///< of each slot; of a child 0 in what a clay shows, and not
                                  ///< looked at in what a sink takes

  bool is_lower() const noexcept { return values.size() == storage::kLowerSlots; }
};

/// A leaf where the clay keeps it: valid until the clay changes.
struct LeafView {
  NodeCoord origin{};
  std::array<std::uint64_t, 8> active{};  ///< of its nodes
  const float* values = nullptr;          ///< storage::kLeafNodes of them
};

/// Is shown a level, or a mask, cube by cube.
///
/// Shapes       first the tiles of the root, then every branch before its children, by the order of
///              origins at the root and of slots below it.
/// Errors       none to return; a visitor may throw.
/// Threads      one.
class LevelVisitor {
 public:
  virtual ~LevelVisitor() = default;

  /// A tile of the root: one value for 4096^3 nodes from `origin` on.
  virtual void see_tile(const NodeCoord& origin, float value, bool is_active) = 0;
  /// Of a lower branch with all its leaves, by the order of their slots; of an upper one without.
  virtual void see_branch(const StoredBranch& branch, std::span<const LeafView> leaves) = 0;
};

/// Takes a level, or a mask, cube by cube.
///
/// Shapes       every branch before its children; the leaves last, all at once. Cubes do not
///              overlap, and origins are multiples of their cube's side.
/// Errors       none to return; a sink may throw std::bad_alloc.
/// Threads      one. Leaves may be filled from several, each by one.
class LevelSink {
 public:
  virtual ~LevelSink() = default;

  /// A tile of the root: one value for 4096^3 nodes from `origin` on.
  virtual void add_tile(const NodeCoord& origin, float value, bool is_active) = 0;
  virtual void add_branch(const StoredBranch& branch) = 0;

  /// Returns for each leaf where its storage::kLeafNodes values shall be written. Each lies in a
  /// lower branch that was added, in a slot that is a child.
  virtual std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) = 0;

  /// The values of leaf `n` of those are written: called once for each, by the thread that wrote
  /// them, so that whoever has to look at them does so while they are in its cache.
  virtual void leaf_is_filled(std::size_t n) = 0;
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

  /// Shows a level; nothing is copied. Below the coarsest level, where only leaves count, a tile
  /// has the band's bound with the sign of the coarser levels at its middle, for programs that take
  /// a tile for what it says; and so that it has tiles, an upper branch stands wherever the clay
  /// passes, be it without a child, if that makes no more than 64.
  void show_level(int level, LevelVisitor& to) const;

  /// Origins of the leaves of a level, sorted by x, y and z. Cost  n log n.
  std::vector<NodeCoord> leaf_origins(int level) const;

  /// The storage::kLeafNodes values of the leaf there, or null where the level has none. Valid
  /// until the clay changes.
  const float* leaf(int level, const NodeCoord& origin) const;

  bool has_mask() const noexcept;
  /// What a mask says where it keeps nothing: 0 or 1. Of a clay that has one, as show_mask.
  float mask_elsewhere() const;
  /// Shows the mask: leaves have nodes storage::kMaskVoxels finest voxels apart, with values from
  /// 0, free, to 1.
  void show_mask(LevelVisitor& to) const;

 private:
  const class LevelStack* stack_;  ///< private to the engine
};

/// What keeps stored levels from being a clay.
struct NestingProblem {
  bool lacks_parent = false;  ///< else the parent of a neighbour
  int level = 0;              ///< of the leaf that lacks it in the next coarser level
  NodeCoord origin{};
};

struct BuiltClay {
  Clay clay;
  std::uint64_t hash = 0;  ///< Clay::hash, known already
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

  /// Each level is written once. What is added must not overlap. Each leaf is judged and hashed as
  /// soon as it is filled.
  LevelSink& level(int level);

  /// Likewise the mask, if there is one.
  LevelSink& mask(float elsewhere);

  double voxel_mm(int level) const noexcept;
  float band_mm(int level) const noexcept;

  /// Whether all leaves were filled with values within the level's band, those on its edge
  /// inactive, and are within reach: what edits and queries of a level rely on.
  bool is_sound(int level) const;

  /// Whether the mask holds nothing but numbers from 0 to 1, dense leaves, and tiles of a leaf's
  /// size. True where none was written.
  bool is_mask_sound() const;

  /// Where the levels do not nest. All must be sound. Cost  docs/files.md.
  std::optional<NestingProblem> nesting_problem() const;

  /// The clay, with nothing to undo, and its hash; this is of no further use. Levels and mask must
  /// be sound and nest: only debug builds look again, and edits and queries of a clay that is not
  /// so may fail.
  BuiltClay finish() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
