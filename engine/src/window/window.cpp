// SPDX-License-Identifier: GPL-3.0-or-later
// What a servo reads is one dense block. It is read from the level whose voxels are next below the
// asked spacing, or from two of them blended, and deepened by what their layers say.
#include "argil/engine/window.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <optional>
#include <span>
#include <string>

#include "clay/clay_access.h"
#include "field/bad_input.h"
#include "field/dense_block.h"
#include "window/detail_patch.h"
#include "window/exact_distance.h"
#include "window/window_levels.h"
#include "window/window_tiles.h"

namespace argil {
namespace {

constexpr int kMostNodes = 512;
/// The finest spacing, as a fraction of level 0's: a thousand times finer has no use, and much
/// beyond it node coordinates would overflow.
constexpr double kFinestFraction = 1.0 / 1024.0;

Error no_memory_for(const WindowRequest& request) {
  return {ErrorKind::memory, "a window reaching " + number_text(request.reach_mm) +
                                 " mm with nodes every " + number_text(request.voxel_mm) +
                                 " mm does not fit into memory; use a larger spacing"};
}

LevelChoice choice_for(const LevelStack& stack, const WindowRequest& request) noexcept {
  return choose_level(request.voxel_mm, stack.voxel_mm(0), stack.top());
}

/// Nodes along a side of the largest part of a level, or of the window, that the request takes.
double widest_part(const LevelStack& stack, const WindowRequest& request) {
  double side = 2.0 * request.reach_mm / request.voxel_mm + 2.0;
  const double reach = request.reach_mm + TileFrame::kSide * request.voxel_mm;
  for (const FeetRing& ring : rings_for(stack, choice_for(stack, request), request)) {
    side = std::max(side, 2.0 * (reach + ring.reach_mm) / ring.voxel_mm + 2.0 * kLeafSide);
  }
  return side;
}

/// All that a request may ask for is checked before memory is taken.
std::optional<Error> check(const LevelStack& stack, const WindowRequest& request) {
  const double finest = stack.voxel_mm(0) * kFinestFraction;
  if (!(request.voxel_mm >= finest) || !std::isfinite(request.voxel_mm)) {
    return bad_input("a window spacing of " + number_text(request.voxel_mm) +
                     " mm is out of range for this clay; use " + number_text(finest) +
                     " mm or more");
  }
  if (!is_finite(request.center_mm) || !(request.reach_mm > 0.0) || !(request.depth_mm >= 0.0)) {
    return bad_input("window reach " + number_text(request.reach_mm) + " mm and depth " +
                     number_text(request.depth_mm) +
                     " mm must be finite and not negative, and its centre finite");
  }
  const Vec3& center = request.center_mm;
  const double farthest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  if ((farthest + request.reach_mm) / stack.voxel_mm(0) > kMaxNode) {
    return bad_input("a window " + number_text(farthest) +
                     " mm from the origin lies beyond where clay can be; move the tool nearer");
  }
  const double side = widest_part(stack, request);
  if (!(side <= kMostNodes)) {
    return bad_input("a window reaching " + number_text(request.reach_mm) + " mm and " +
                     number_text(request.depth_mm) + " mm deep takes " +
                     number_text(std::ceil(side)) + " nodes a side at a spacing of " +
                     number_text(request.voxel_mm) + " mm, more than " +
                     std::to_string(kMostNodes) + "; use a larger spacing or a smaller tool");
  }
  return std::nullopt;
}

/// The nodes of a window are multiples of its spacing, wherever its centre lies: windows of a tool
/// that moves share their nodes.
NodeBox window_box(const WindowRequest& request) {
  assert(is_finite(request.center_mm));
  return covering_nodes(request.center_mm, request.reach_mm, request.voxel_mm);
}

std::size_t size_of(const NodeBox& box) noexcept {
  const auto n = box.sides();
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
         static_cast<std::size_t>(n[2]);
}

Vec3 origin_of(const NodeBox& box, double voxel) noexcept {
  return voxel * Vec3{static_cast<double>(box.low.x()), static_cast<double>(box.low.y()),
                      static_cast<double>(box.low.z())};
}

/// Where the window's nodes lie; no values yet.
FieldWindowView view_of(const WindowRequest& request, const NodeBox& box) {
  FieldWindowView view;
  view.voxel_mm = request.voxel_mm;
  view.nodes = box.sides();
  view.origin_mm = origin_of(box, request.voxel_mm);
  return view;
}

void set_place(const WindowRequest& request, const NodeBox& box, FieldWindow& window) {
  window.view = view_of(request, box);
  window.storage.resize(size_of(box));
  window.view.distance_mm = window.storage;
}

FieldWindow read_exact(const Clay& clay, const WindowRequest& request) {
  FieldWindow window;
  const NodeBox box = window_box(request);
  set_place(request, box, window);
  exact_distances(clay, request.voxel_mm, box, window.storage);
  return window;
}

/// Into `window`, whose memory is used again.
void read_layers(const Clay& clay, const WindowRequest& request, WindowTiles& tiles,
                 FieldWindow& window) {
  const NodeBox box = window_box(request);
  set_place(request, box, window);
  window.view.level = choice_for(levels_of(clay), request).finer_level;
  window.view.distance_error_mm = tiles.fill(clay, request, box, window.storage);
}

bool has_same_nodes(const FieldWindowView& a, const FieldWindowView& b) noexcept {
  return a.voxel_mm == b.voxel_mm && a.nodes == b.nodes && a.origin_mm == b.origin_mm;
}

}  // namespace

Result<FieldWindow> read_window(const Clay& clay, const WindowRequest& request,
                                Extension extension) {
  try {
    if (auto error = check(levels_of(clay), request)) return *error;
    if (extension == Extension::exact) return read_exact(clay, request);
    FieldWindow window;
    WindowTiles tiles;
    read_layers(clay, request, tiles, window);
    return window;
  } catch (const std::bad_alloc&) {
    return no_memory_for(request);
  }
}

/// The last window, what it was read for, and what the next one can use of it.
struct WindowPublisher::Kept {
  WindowTiles tiles;
  FieldWindow window;
  double depth_mm = 0.0;
  std::uint64_t clay = 0;
  std::uint64_t revision = 0;
  std::uint64_t checksum = 0;
};

WindowPublisher::WindowPublisher(WindowChannel& channel)
    : channel_(channel), kept_(std::make_unique<Kept>()) {}

WindowPublisher::~WindowPublisher() = default;

/// Unless it is the window that there is.
void WindowPublisher::read(const Clay& clay, const WindowRequest& request) {
  const std::uint64_t of_clay = identity(clay);
  const std::uint64_t at_revision = revision(clay);
  if (kept_->clay == of_clay && kept_->revision == at_revision &&
      kept_->depth_mm == request.depth_mm &&
      has_same_nodes(kept_->window.view, view_of(request, window_box(request)))) {
    return;
  }
  kept_->clay = 0;  // should memory end
  read_layers(clay, request, kept_->tiles, kept_->window);
  kept_->depth_mm = request.depth_mm;
  kept_->clay = of_clay;
  kept_->revision = at_revision;
  kept_->checksum = window_checksum(kept_->window.view);
}

void WindowPublisher::fill(WindowSlot& slot) const {
  const FieldWindowView& view = kept_->window.view;
  assert(view.distance_mm.size() <= slot.distance_mm.size());
  slot.origin_mm = view.origin_mm;
  slot.voxel_mm = view.voxel_mm;
  slot.nodes = view.nodes;
  slot.level = view.level;
  slot.distance_error_mm = view.distance_error_mm;
  std::copy(view.distance_mm.begin(), view.distance_mm.end(), slot.distance_mm.begin());
  slot.checksum = kept_->checksum;
}

Result<void> WindowPublisher::publish(const Clay& clay, const WindowRequest& request,
                                      const WindowAnswer& answer) {
  try {
    if (auto error = check(levels_of(clay), request)) return *error;
    if (const double most = kMostWindowReachVoxels * request.voxel_mm; request.reach_mm > most) {
      return bad_input("a window reaching " + number_text(request.reach_mm) +
                       " mm does not fit the servo's memory; with nodes every " +
                       number_text(request.voxel_mm) + " mm it may reach " + number_text(most) +
                       " mm");
    }
    read(clay, request);
    WindowSlot& slot = channel_.write_slot();
    fill(slot);
    slot.detail = {};
    if (request.wants_detail) {
      slot.detail = read_detail(clay, kept_->window.view, request.center_mm);
    }
    slot.sequence = ++sequence_;
    slot.answers = answer.index;
    slot.time_s = answer.time_s;
    channel_.publish();
    return {};
  } catch (const std::bad_alloc&) {
    return no_memory_for(request);
  }
}

}  // namespace argil
