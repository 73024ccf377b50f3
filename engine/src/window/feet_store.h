// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "argil/core/vec3.h"

#include "feet/layer_feet.h"
#include "field/leaf_change.h"
#include "field/level_reader.h"
#include "window/window_error.h"

namespace argil {

/// The nodes of a leaf that a change is about.
NodeBox changed_nodes_of(const LeafChange& change) noexcept;

/// Feet of a cluster that came or went; one that moved did both. Boxes in mm, empty for none.
struct FeetChange {
  int level = 0;
  std::uint64_t label = 0;  ///< the cluster's
  Box3 gone;                ///< around those that went
  Box3 came;                ///< around those that came
  Box3 surface;             ///< around the points of the surface below these
};

/// What windows know of the leaves around a tool, found when it is first asked for and kept until
/// the clay changes there. For one thread.
class FeetStore {
 public:
  /// A leaf of a level, stored there or not.
  struct Asked {
    int level;
    Coord origin;
    bool is_average;  ///< as find_layers() has it
  };

  /// Its layers; null when it has none. Valid until the next note(), trim() or clear(), or until it
  /// is asked for as another kind.
  const LeafLayers* layers(LevelReader& reader, const Asked& asked);

  /// Of the nodes of a leaf, as leaf_error() has it.
  ErrorSum error(LevelReader& reader, int level, const Coord& origin);

  /// The clay has changed: what is known of leaves there may no longer hold.
  void note(const std::vector<LeafChange>& changes);

  /// Finds the layers anew that may no longer hold, of a level's leaves with these origins / 8;
  /// returns what became different.
  std::vector<FeetChange> refresh(LevelReader& reader, int level, const NodeBox& leaves);

  /// Forgets leaves of a level outside these nodes, when they have become many.
  void trim(int level, const NodeBox& nodes);

  void clear() { levels_.clear(); }

 private:
  struct Entry {
    std::unique_ptr<LeafLayers> layers;  ///< null where both are empty
    bool is_average = false;
    bool is_found = false;
    bool is_stale = false;
    int coarsest = 0;  ///< the coarsest level that was read for it
    std::optional<ErrorSum> error;
  };
  struct Level {
    std::unordered_map<Coord, Entry> entries;
    std::vector<Coord> stale;  ///< origins
  };

  struct ChangedNodes {
    int level;
    NodeBox nodes;
  };

  Level& level(int level);
  static void find(LevelReader& reader, const Asked& asked, Entry& entry);
  static void forget(Level& level, const Coord& origin, Entry& entry);
  void note_at(int level, const NodeBox& changed);
  void note_at_coarser(int level, const NodeBox& changed);
  void note_at_finer(int finer, const std::vector<ChangedNodes>& changed);

  std::vector<Level> levels_;
};

}  // namespace argil
