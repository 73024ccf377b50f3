// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// A point where a mesh is not as it shall be, and how wide what is wrong there may reach.
struct BadPoint {
  Vec3 at_mm;
  double size_mm = 0.0;
};

/// Balls around bad points, to be asked which vertices lie in one.
class Balls {
 public:
  Balls(std::vector<BadPoint> points, double widen_mm) : centres_(std::move(points)) {
    for (BadPoint& p : centres_) widest_ = std::max(widest_, p.size_mm += widen_mm);
    std::sort(centres_.begin(), centres_.end(),
              [](const BadPoint& a, const BadPoint& b) { return a.at_mm.x < b.at_mm.x; });
  }
  bool hold(const Vec3& point) const {
    assert(is_finite(point));
    const auto before = [](const BadPoint& p, double x) { return p.at_mm.x < x; };
    auto p = std::lower_bound(centres_.begin(), centres_.end(), point.x - widest_, before);
    for (; p != centres_.end() && p->at_mm.x <= point.x + widest_; ++p) {
      const Vec3 offset = point - p->at_mm;
      if (dot(offset, offset) <= p->size_mm * p->size_mm) return true;
    }
    return false;
  }

 private:
  std::vector<BadPoint> centres_;  ///< by x
  double widest_ = 0.0;
};

}  // namespace argil::mesh
