// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"

#include "edit/edit.h"
#include "rows/rows.h"

namespace argil {

/// Where matter goes: a smooth map of space onto itself that is the identity outside its regions.
class Motion {
 public:
  virtual ~Motion() = default;

  /// Where the matter came from that is now at a point.
  virtual Vec3 source(const Vec3& point_mm) const = 0;

  /// The same of the nodes of a leaf, in single precision; asked for are the rows of which some
  /// node is not its own source. Asked by several threads.
  virtual void sources(const Coord& origin, double voxel_mm, PointBlock& out) const;

  /// Where the matter of a point goes; enough to plan by, to a hundredth of its displacement.
  virtual Vec3 image(const Vec3& point_mm) const = 0;

  /// Nodes that hold the sources of those of a leaf, and nodes that hold what it is the source of:
  /// what is planned by. Here told by 27 places spread over it; a motion that changes faster than
  /// that tells itself. Asked by several threads.
  virtual openvdb::CoordBBox source_nodes(const Coord& origin, double voxel_mm) const;
  virtual openvdb::CoordBBox image_nodes(const Coord& origin, double voxel_mm) const;

  /// Boxes that hold all points that are not their own source.
  virtual std::vector<Box3> regions_mm() const = 0;

 protected:
  /// Every node its own source, no row asked for.
  static void stay(PointBlock& out);
};

/// The point that `y - push(y)` takes to `point`, for a push that changes by less than half of what
/// y does.
template <class Push>
Vec3 pushed_forward(const Vec3& point, const Push& push) {
  Vec3 y = point;
  for (int i = 0; i < 6; ++i) {
    const Vec3 next = point + push(y);
    if (length(next - y) <= 1e-3 * length(next - point)) return next;
    y = next;
  }
  return y;
}

/// Moves all matter at once: every node takes the value at its source (Catmull-Rom), leaves of
/// finer levels go where their matter goes, then all levels are redistanced: at once where the
/// target has no queue, else as commit_carried() says. Matter that is not moved keeps its bits but
/// for the distances of nodes near matter that is.
///
/// Source  semi-Lagrangian advection; ours takes the whole path at once, so that detail is
///         resampled once, however long it is.
void move_matter(EditTarget& target, const Motion& motion, int tool_level);

}  // namespace argil
