// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// Merges positions whose coordinates have equal bits, -0 counting as 0.
class PointWelder {
 public:
  explicit PointWelder(std::vector<Vec3>& positions) : positions_(positions) {}

  /// The index of `point` in the positions, appended when it is new. At most 2^32 - 1 points.
  std::uint32_t add(const Vec3& point);

 private:
  void grow();
  std::vector<Vec3>& positions_;      ///< must be changed through this only
  std::vector<std::uint32_t> slots_;  ///< open addressing; kFree or an index
};

/// Collects faces that name vertices by number before it is known how many vertices there are.
class FaceCollector {
 public:
  /// Adds a polygon as a fan of triangles. `corners` count from 0; `place` (a line or a byte) comes
  /// back from `missing`. False when a corner does not fit 32 bits.
  bool add(const std::vector<std::int64_t>& corners, std::uint64_t place);

  /// The highest vertex any face names and where that was first; -1 without faces.
  std::int64_t highest() const noexcept { return highest_; }
  std::uint64_t highest_place() const noexcept { return highest_place_; }

  std::vector<Triangle> take() noexcept { return std::move(triangles_); }

 private:
  std::vector<Triangle> triangles_;
  std::int64_t highest_ = -1;
  std::uint64_t highest_place_ = 0;
};

/// "has no triangles" for `name`.
Error no_triangles(const std::string& name);

}  // namespace argil::io
