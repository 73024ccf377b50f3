// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "argil/engine/sculpture.h"

namespace argil::viewer {

/// The signed distance to the union of a sculpture's visible pieces where they stand; of the active
/// one where none is visible. For a slice: as long as the sculpture stays as it is.
class SceneDistance {
 public:
  explicit SceneDistance(const Sculpture& sculpture) {
    for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
      if (sculpture.look(n).is_visible) add(sculpture, n);
    }
    if (pieces_.empty()) add(sculpture, sculpture.active());
  }

  double at(const Vec3& point_mm) const {
    double nearest = std::numeric_limits<double>::max();
    bool is_first = true;
    for (const Seen& piece : pieces_) {
      const Vec3 own = unplaced(piece.placement, point_mm);
      // Most pieces are farther away than the one that was looked at first.
      const bool is_looked_at = std::exchange(is_first, false);
      // Within its box it may reach deeper than the ones before.
      const double beside = distance_to_box(piece.bounds_mm, own);
      if (!is_looked_at && beside > 0.0 && beside >= nearest) continue;
      nearest = std::min(nearest, piece.clay->distance_at(own));
    }
    return nearest;
  }

 private:
  struct Seen {
    const Clay* clay = nullptr;
    Placement placement;
    Box3 bounds_mm;
  };
  void add(const Sculpture& sculpture, std::size_t n) {
    const Clay& clay = sculpture.clay(n);
    pieces_.push_back({&clay, sculpture.look(n).placement, clay.bounds_mm()});
  }
  /// 0 within it.
  static double distance_to_box(const Box3& box, const Vec3& p) noexcept {
    Vec3 beside;
    for (std::size_t a = 0; a < 3; ++a) {
      beside[a] = std::max({box.min[a] - p[a], p[a] - box.max[a], 0.0});
    }
    return length(beside);
  }

  std::vector<Seen> pieces_;
};

}  // namespace argil::viewer
