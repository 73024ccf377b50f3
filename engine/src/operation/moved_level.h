// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "argil/engine/clay.h"
#include "argil/engine/operation.h"

#include "feet/feet_tree.h"
#include "field/level_reader.h"
#include "field/resample.h"
#include "rows/rows.h"

namespace argil {

/// A clay, grown by an offset and placed.
struct PlacedClay {
  const Clay& clay;
  Placement placement;
  double offset_mm = 0.0;
};

/// Whether a placement neither turns nor moves.
inline bool stays_in_place(const Placement& placement) noexcept {
  const Quat& q = placement.orientation;
  return placement.position_mm == Vec3{} && q.x == 0.0 && q.y == 0.0 && q.z == 0.0;
}

/// The distance to a placed clay's surface, less an offset, at the nodes of one level of another
/// clay: near the surface what the clay says, beyond by way of the nearest feet.
///
/// Accuracy     MovedLevel.*; docs/operations.md, "Accuracy".
/// Determinism  what a leaf gets depends on nothing else that was asked
///              (OperationDeterminism.SameHashForAnyThreads).
/// Threads      any.
/// Cost         20 to 60 us a leaf.
/// Source       as windows: docs/forces.md, "Windows".
class MovedLevel {
 public:
  /// Which feet a level of these voxels asks.
  static FeetWanted wanted(const PlacedClay& source, double voxel_mm);
  /// `feet` those that are wanted.
  MovedLevel(const PlacedClay& source, double voxel_mm, SidesOfFeet feet);
  MovedLevel(const MovedLevel&) = delete;
  MovedLevel& operator=(const MovedLevel&) = delete;

  /// False when no node of the leaf lies within the band. Else `detail` tells whether the source
  /// may hold detail there that only levels as fine as this one, or finer, can hold.
  bool fill(const Coord& origin, LeafValues& out, bool& detail) const;

 private:
  struct Scratch {
    explicit Scratch(const LevelStack& stack) : reader(stack) {}
    LevelReader reader;
    std::array<FeetTree::Found, 2> found;
    LeafValues near;
    std::vector<float> around;
    PointBlock places;
    ResampleScratch resample;
  };
  enum class Reach { beyond, all_nearer, some };

  Reach look(std::size_t side, const Coord& origin, FeetTree::Found& found) const;
  Vec3 taken_back(const Vec3& mm) const noexcept;
  bool is_near_enough(int level) const noexcept;
  std::optional<int> stored_level(const Coord& origin, LevelReader& reader) const;
  void read_near(const Coord& origin, int level, Scratch& scratch) const;
  NodeBox place_nodes(const Coord& origin, int level, PointBlock& places) const;
  float least_mm(std::size_t side) const noexcept;
  unsigned asking_blocks(std::size_t side, double voxel, const LeafValues& near) const;
  void ask(std::size_t side, double voxel, Scratch& scratch, LeafValues& distance) const;
  void ask_block(std::size_t side, FeetTree::Found& found, const std::array<int, 3>& low,
                 std::array<float, LayerJob::kNodes>& told) const;
  void join(double voxel, const LeafValues& near, const std::array<LeafValues, 2>& told,
            LeafValues& out) const;

  const LevelStack& stack_;
  Placement placement_;
  double offset_mm_;
  double voxel_mm_;
  int near_level_;  ///< the finest of the source that is read, or asked for feet
  bool is_in_place_;
  openvdb::CoordBBox stored_;       ///< the nodes of the source's coarsest level
  float limit_mm_;                  ///< nodes farther from the surface are out of the band
  std::array<bool, 2> is_asked_{};  ///< whether nodes of that side can be within it
  std::array<FeetTree, 2> trees_;
  mutable tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace argil
