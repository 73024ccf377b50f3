// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "argil/core/vec3.h"

#include "field/leaf_change.h"
#include "field/level_reader.h"
#include "window/layer_feet.h"
#include "window/window_error.h"

namespace argil {

/// The nodes of a leaf that a change is about.
NodeBox changed_nodes_of(const LeafChange& change) noexcept;

/// Some feet of a level that came, went or moved, with where they were and are, in mm.
struct FeetChange {
  int level = 0;
  Box3 feet;
  Box3 surface;  ///< below them
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
    bool was_asked;   ///< for the last window, too
  };

  /// Its layers; null when it has none. Valid until the next note(), trim() or clear(), or until it
  /// is asked for as another kind. When they are found anew and were asked for before, what became
  /// different is added to what take_changes() gives.
  const LeafLayers* layers(LevelReader& reader, const Asked& asked);

  /// Of the nodes of a leaf, as leaf_error() has it.
  ErrorSum error(LevelReader& reader, int level, const Coord& origin);

  /// The clay has changed.
  void note(const std::vector<LeafChange>& changes);

  /// What was found to be different since the last call.
  std::vector<FeetChange> take_changes() { return std::exchange(changes_, {}); }

  /// Forgets leaves of a level outside these nodes, when they have become many.
  void trim(int level, const NodeBox& nodes);

  void clear();

 private:
  struct Entry {
    std::unique_ptr<LeafLayers> layers;  ///< null where both are empty
    bool is_average = false;
    bool is_found = false;
    bool is_stale = false;
    int coarsest = 0;  ///< the coarsest level that was read for it
    std::optional<ErrorSum> error;
  };
  using Level = std::unordered_map<Coord, Entry>;

  Level& level(int level);
  void find(LevelReader& reader, const Asked& asked, Entry& entry);
  void note_at(int level, const NodeBox& changed);
  void note_at_coarser(int level, const NodeBox& changed);
  void note_at_finer(int level, const NodeBox& changed);

  std::vector<Level> levels_;
  std::vector<FeetChange> changes_;
};

}  // namespace argil
