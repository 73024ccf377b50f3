// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/window.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>
#include <string>

#include "exact_distance.h"
#include "level_block.h"

namespace argil {
namespace {

constexpr int kMostNodes = 512;
/// The finest window: a thousand times finer than level 0 has no use, and much beyond it node
/// coordinates would overflow.
constexpr int kFinestLevel = -10;

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

Error bad_input(std::string message) { return {ErrorKind::bad_input, std::move(message)}; }

double voxel_of_any(const LevelStack& stack, int level) noexcept {
  return level >= 0 ? stack.voxel_mm(level) : std::ldexp(stack.voxel_mm(0), level);
}

std::optional<Error> check(const LevelStack& stack, int level, const Vec3& center_mm,
                           double reach_mm, double depth_mm) {
  if (level > stack.top() || level < kFinestLevel) {
    return bad_input("window level " + std::to_string(level) + " is not one of the clay's; use " +
                     std::to_string(kFinestLevel) + " to " + std::to_string(stack.top()));
  }
  if (!is_finite(center_mm) || !(reach_mm > 0.0) || !(depth_mm >= 0.0)) {
    return bad_input("window reach " + text(reach_mm) + " mm and depth " + text(depth_mm) +
                     " mm must be finite and not negative, and its centre finite");
  }
  const double farthest =
      std::max({std::abs(center_mm.x), std::abs(center_mm.y), std::abs(center_mm.z)});
  if ((farthest + reach_mm) / stack.voxel_mm(0) > kMaxNode) {
    return bad_input("a window " + text(farthest) +
                     " mm from the origin lies beyond where clay can be; move the tool nearer");
  }
  const double own_side = 2.0 * reach_mm / voxel_of_any(stack, level) + 2.0;
  const double side =
      std::max(own_side, largest_side(stack, std::max(level, 0), reach_mm, depth_mm));
  if (!(side <= kMostNodes)) {
    return bad_input("a window reaching " + text(reach_mm) + " mm and " + text(depth_mm) +
                     " mm deep takes " + text(std::ceil(side)) + " nodes a side at level " +
                     std::to_string(level) + ", more than " + std::to_string(kMostNodes) +
                     "; use a coarser level or a smaller tool");
  }
  return std::nullopt;
}

FieldWindow window_for(const NodeBox& box, double voxel, int level) {
  FieldWindow window;
  window.view.level = level;
  window.view.voxel_mm = voxel;
  window.view.nodes = box.sides();
  window.view.origin_mm =
      voxel * Vec3{static_cast<double>(box.low.x()), static_cast<double>(box.low.y()),
                   static_cast<double>(box.low.z())};
  return window;
}

/// Fills a window with value(node) in its own order.
template <class Value>
FieldWindow fill(const NodeBox& box, double voxel, int level, const Value& value) {
  FieldWindow window = window_for(box, voxel, level);
  const auto n = box.sides();
  window.storage.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                         static_cast<std::size_t>(n[2]));
  for_each_node(box, [&](const Coord& node) { window.storage.push_back(value(node)); });
  window.view.distance_mm = window.storage;
  return window;
}

FieldWindow exact_window(const Clay& clay, int level, const NodeBox& box, double voxel) {
  const LevelBlock block = exact_block(clay, level, box);
  return fill(box, voxel, level,
              [&](const Coord& node) { return block.nodes.value[block.index(node)]; });
}

/// Levels finer than the finest are interpolated from its block.
FieldWindow marched_window(const LevelStack& stack, int level, const NodeBox& box, double voxel,
                           double depth_mm) {
  const int shift = std::max(-level, 0);
  const NodeBox stored{box.low >> shift, shift == 0 ? box.high : (box.high >> shift).offsetBy(1)};
  const LevelBlock block = extended_block(stack, level + shift, stored, depth_mm);
  const double scale = std::ldexp(1.0, -shift);
  return fill(box, voxel, level, [&](const Coord& node) {
    if (shift == 0) return block.nodes.value[block.index(node)];
    return block.value_at({node.x() * scale, node.y() * scale, node.z() * scale});
  });
}

FieldWindow read_checked(const Clay& clay, int level, const Vec3& center_mm, double reach_mm,
                         double depth_mm, Extension extension) {
  const double voxel = voxel_of_any(clay.levels(), level);
  const NodeBox box = covering_nodes(center_mm, reach_mm, voxel);
  if (extension == Extension::exact) return exact_window(clay, level, box, voxel);
  return marched_window(clay.levels(), level, box, voxel, depth_mm);
}

}  // namespace

Result<FieldWindow> read_window(const Clay& clay, int level, const Vec3& center_mm, double reach_mm,
                                double depth_mm, Extension extension) {
  try {
    if (auto error = check(clay.levels(), level, center_mm, reach_mm, depth_mm)) return *error;
    return read_checked(clay, level, center_mm, reach_mm, depth_mm, extension);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, "a window reaching " + text(reach_mm) + " mm at level " +
                                        std::to_string(level) +
                                        " does not fit into memory; use a coarser level"};
  }
}

}  // namespace argil
