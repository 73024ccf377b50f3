// SPDX-License-Identifier: GPL-3.0-or-later
#include "operation/outline_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argil {
namespace {

double distance_to(const OutlineEdge& edge, double x, double y) {
  const double ux = edge.b[0] - edge.a[0];
  const double uy = edge.b[1] - edge.a[1];
  const double vx = x - edge.a[0];
  const double vy = y - edge.a[1];
  const double square = ux * ux + uy * uy;
  const double t = square > 0.0 ? std::clamp((vx * ux + vy * uy) / square, 0.0, 1.0) : 0.0;
  const double dx = vx - t * ux;
  const double dy = vy - t * uy;
  return std::sqrt(dx * dx + dy * dy);
}

/// Half open, so that a corner on the line counts once.
bool is_met_to_the_right(const OutlineEdge& edge, double x, double y) {
  if ((edge.a[1] > y) == (edge.b[1] > y)) return false;
  if (edge.is_beyond) return true;
  const double t = (y - edge.a[1]) / (edge.b[1] - edge.a[1]);
  return edge.a[0] + t * (edge.b[0] - edge.a[0]) > x;
}

PictureBox box_of(const OutlineEdge& edge) {
  const auto [low_x, high_x] = std::minmax(edge.a[0], edge.b[0]);
  const auto [low_y, high_y] = std::minmax(edge.a[1], edge.b[1]);
  return {low_x, high_x, low_y, high_y};
}

/// Collects what matters to a box.
class PartPruner {
 public:
  explicit PartPruner(const PictureBox& box) : box_(box) {}

  void add(const OutlineEdge& edge) {
    const PictureBox own = box_of(edge);
    // Above and below nothing is met, as the ends of a chain say too.
    if (edge.is_beyond || own.x0 > box_.x1 || own.y0 > box_.y1 || own.y1 < box_.y0) {
      if (has_chain_ && chain_.b == edge.a) {
        chain_.b = edge.b;
        return;
      }
      end_chain();
      chain_ = {edge.a, edge.b, true};
      has_chain_ = true;
    } else if (own.x1 >= box_.x0) {
      end_chain();
      kept_.push_back(edge);
    }
  }
  LoopPart take() {
    end_chain();
    return std::move(kept_);
  }

 private:
  void end_chain() {
    const PictureBox own = box_of(chain_);
    const bool is_met = own.y0 < own.y1 && own.y0 <= box_.y1 && own.y1 >= box_.y0;
    if (has_chain_ && is_met) kept_.push_back(chain_);
    has_chain_ = false;
  }

  PictureBox box_;
  LoopPart kept_;
  OutlineEdge chain_;
  bool has_chain_ = false;
};

}  // namespace

LoopParts parts_of(const std::vector<std::vector<PicturePoint>>& loops) {
  LoopParts parts;
  for (const auto& loop : loops) {
    LoopPart& part = parts.emplace_back();
    for (std::size_t n = 0; n < loop.size(); ++n) {
      part.push_back({loop[n], loop[(n + 1) % loop.size()]});
    }
  }
  return parts;
}

PictureBox box_of(const LoopParts& parts) {
  constexpr double kFar = 2.0 * kMostPicture;
  PictureBox all{kFar, -kFar, kFar, -kFar};
  for (const LoopPart& part : parts) {
    for (const OutlineEdge& edge : part) {
      const PictureBox own = box_of(edge);
      all = {std::min(all.x0, own.x0), std::max(all.x1, own.x1), std::min(all.y0, own.y0),
             std::max(all.y1, own.y1)};
    }
  }
  return all;
}

LoopParts parts_in(const LoopParts& parts, const PictureBox& box) {
  LoopParts kept;
  for (const LoopPart& part : parts) {
    PartPruner pruner(box);
    for (const OutlineEdge& edge : part) pruner.add(edge);
    LoopPart own = pruner.take();
    if (!own.empty()) kept.push_back(std::move(own));
  }
  return kept;
}

bool has_border(const LoopParts& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const LoopPart& part) {
    return std::any_of(part.begin(), part.end(),
                       [](const OutlineEdge& edge) { return !edge.is_beyond; });
  });
}

double depth_within(const LoopParts& parts, double x, double y) {
  constexpr double kFar = 4.0 * kMostPicture;
  double depth = -kFar;
  for (const LoopPart& part : parts) {
    bool is_inside = false;
    double nearest = kFar;
    for (const OutlineEdge& edge : part) {
      is_inside ^= is_met_to_the_right(edge, x, y);
      if (!edge.is_beyond) nearest = std::min(nearest, distance_to(edge, x, y));
    }
    depth = std::max(depth, is_inside ? nearest : -nearest);
  }
  return depth;
}

}  // namespace argil
