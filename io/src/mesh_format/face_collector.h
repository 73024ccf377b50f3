// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// Collects faces that name vertices by number before it is known how many vertices there are.
class FaceCollector {
 public:
  /// Longer polygons are refused: no program makes them, and some that they break are useful.
  static constexpr std::size_t kMostCorners = 100'000;

  /// Adds a polygon of at least three corners, counted from 0; `position` (a line or a byte) comes
  /// back from `highest_position`. Returns what is wrong with it and the remedy, empty where
  /// nothing is.
  std::string add(const std::vector<std::int64_t>& corners, std::uint64_t position);

  /// The same of a triangle. False, and nothing is added, where add() has something to say.
  bool add_triangle(const std::array<std::int64_t, 3>& corners, std::uint64_t position);

  /// The highest vertex any face names and where that was first; -1 without faces.
  std::int64_t highest() const noexcept { return highest_; }
  std::uint64_t highest_position() const noexcept { return highest_position_; }

  /// Faces of three and four corners in their order, those of four as two triangles that do not
  /// overlap; then the others, each as `triangulated` gives it, or as a fan where that gives
  /// nothing. Needs   highest() to be the number of one of `positions`.
  std::vector<Triangle> take(std::span<const Vec3> positions);

 private:
  void add_fan(std::span<const std::uint32_t> corners);
  void add_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions);
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> quads_;      ///< the first triangle of each
  std::vector<std::uint32_t> corners_;  ///< of polygons with five and more, one after the other
  std::vector<std::size_t> ends_;       ///< of each of them in `corners_`
  std::int64_t highest_ = -1;
  std::uint64_t highest_position_ = 0;
};

/// What is wrong with a vertex at `p` mm, and the remedy: a coordinate `of` something is not finite
/// or lies beyond kMaxReachMm. Empty where nothing is.
std::string position_problem(const Vec3& p, const std::string& of = "");

/// "has no triangles" for `name`.
Error no_triangles(const std::string& name);

}  // namespace argil::io
