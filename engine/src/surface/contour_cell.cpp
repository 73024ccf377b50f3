// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of a cell as polygons (contour_cell.h has the notation), and the loops in which the
// surface cuts them. A loop is found by following each cut to the one after it on the next polygon.
#include "surface/contour_cell.h"

#include <cassert>
#include <utility>

namespace argil {

namespace {

constexpr std::uint16_t kNoCut = 0xffff;

Coord step_along(const Coord& from, int axis, int step) {
  Coord to = from;
  to[axis] += step;
  return to;
}

}  // namespace

int ContourCell::id(const Coord& p) const noexcept {
  assert(p.x() >= 0 && p.x() < side() && p.y() >= 0 && p.y() < side() && p.z() >= 0 &&
         p.z() < side());
  return (p.x() * side() + p.y()) * side() + p.z();
}

Coord ContourCell::position(int node) const noexcept {
  const int n = side();
  return {node / (n * n), node / n % n, node % n};
}

std::span<const std::uint16_t> ContourCell::polygon(std::size_t index) const noexcept {
  assert(index < polygon_ends_.size());
  const std::size_t first = index == 0 ? 0 : polygon_ends_[index - 1];
  return std::span(polygon_nodes_).subspan(first, polygon_ends_[index] - first);
}

void ContourCell::build(const Refinement& refinement, const Coord& cell, int depth) {
  assert(depth >= 0 && depth <= kMaxDepth);
  refinement_ = &refinement;
  cell_ = cell;
  for (const std::uint16_t node : nodes_) known_[node] = 0;
  clear_cuts();
  nodes_.clear();
  polygon_nodes_.clear();
  polygon_ends_.clear();
  if (depth != depth_) {
    depth_ = depth;
    const auto count = static_cast<std::size_t>(side() * side() * side());
    known_.assign(count, 0);
    inside_.assign(count, 0);
    cut_of_.assign(3 * count, kNoCut);
  }
  if (depth > 0) look_around();
  for (int axis = 0; axis < 3; ++axis) {
    add_face(axis, 0, 0, Coord(0));
    add_face(axis, 1, 0, step_along(Coord(0), axis, 1 << depth));
  }
  refinement_ = nullptr;  // it need not outlive this call
}

void ContourCell::look_around() {
  std::size_t at = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        around_[at++] = refinement_->refined(0, cell_.offsetBy(i, j, k));
      }
    }
  }
}

// Whether the cell of depth `depth` with lattice coordinate `low` at its low corner is refined.
bool ContourCell::refined(int depth, const Coord& low) const {
  const int shift = depth_ - depth;
  if (depth == 0) {
    const Coord at = low >> shift;
    return around_[static_cast<std::size_t>(((at.x() + 1) * 3 + at.y() + 1) * 3 + at.z() + 1)];
  }
  return refinement_->refined(depth, (cell_ << depth) + (low >> shift));
}

bool ContourCell::edge_split(int depth, const Coord& low, int axis) const {
  if (depth >= depth_) return false;
  const int step = 1 << (depth_ - depth);
  const int b = (axis + 1) % 3;
  const int c = (axis + 2) % 3;
  for (int i = -1; i <= 0; ++i) {
    for (int j = -1; j <= 0; ++j) {
      if (refined(depth, step_along(step_along(low, b, i * step), c, j * step))) return true;
    }
  }
  return false;
}

void ContourCell::add_face(int axis, int high, int depth, const Coord& low) {
  const int size = 1 << (depth_ - depth);
  const Coord across = step_along(low, axis, high ? 0 : -size);
  if (depth >= depth_ || !refined(depth, across)) {
    add_polygon(axis, high, depth, low);
    return;
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Coord child = step_along(low, (axis + 1) % 3, i * size / 2);
      add_face(axis, high, depth + 1, step_along(child, (axis + 2) % 3, j * size / 2));
    }
  }
}

void ContourCell::add_polygon(int axis, int high, int depth, const Coord& low) {
  const int size = 1 << (depth_ - depth);
  int b = (axis + 1) % 3;
  int c = (axis + 2) % 3;
  if (!high) std::swap(b, c);  // seen from the other side, so that it stays counter-clockwise
  add_side(low, b, size, depth);
  add_side(step_along(low, b, size), c, size, depth);
  add_side(step_along(step_along(low, b, size), c, size), b, -size, depth);
  add_side(step_along(low, c, size), c, -size, depth);
  polygon_ends_.push_back(static_cast<std::uint32_t>(polygon_nodes_.size()));
}

// The nodes of one side from `from` on, without its last.
void ContourCell::add_side(const Coord& from, int axis, int step, int depth) {
  const Coord low = step > 0 ? from : step_along(from, axis, step);
  if (!edge_split(depth, low, axis)) {
    add_node(from);
    return;
  }
  add_side(from, axis, step / 2, depth + 1);
  add_side(step_along(from, axis, step / 2), axis, step / 2, depth + 1);
}

void ContourCell::add_node(const Coord& position) {
  const auto node = static_cast<std::uint16_t>(id(position));
  polygon_nodes_.push_back(node);
  if (known_[node]) return;
  known_[node] = 1;
  nodes_.push_back(node);
}

std::size_t ContourCell::edge_slot(int a, int b) const noexcept {
  assert(a != b);
  const int low = a < b ? a : b;
  const int distance = a < b ? b - a : a - b;
  const int n = side();
  const int axis = distance >= n * n ? 0 : (distance >= n ? 1 : 2);
  return static_cast<std::size_t>(low * 3 + axis);
}

std::uint16_t ContourCell::make_cut(int a, int b) {
  const std::size_t slot = edge_slot(a, b);
  if (cut_of_[slot] != kNoCut) return cut_of_[slot];
  ContourCut cut;
  cut.low = static_cast<std::uint16_t>(a < b ? a : b);
  cut.high = static_cast<std::uint16_t>(a < b ? b : a);
  cut.axis = static_cast<std::uint8_t>(slot % 3);
  cut.next = kNoCut;
  const Coord low = position(cut.low);
  const Coord high = position(cut.high);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] == 0) cut.planes = static_cast<std::uint8_t>(cut.planes | 1U << (2 * axis));
    if (low[axis] == side() - 1) {
      cut.planes = static_cast<std::uint8_t>(cut.planes | 2U << (2 * axis));
    }
  }
  cut_of_[slot] = static_cast<std::uint16_t>(cuts_.size());
  cuts_.push_back(cut);
  return cut_of_[slot];
}

void ContourCell::clear_cuts() {
  for (const ContourCut& cut : cuts_) cut_of_[edge_slot(cut.low, cut.high)] = kNoCut;
  cuts_.clear();
}

// Cuts off every run of inside nodes: from the cut where the boundary enters it to the cut where
// it leaves. That direction keeps the outside on the front of the loop.
void ContourCell::link_polygon(std::span<const std::uint16_t> nodes) {
  std::uint16_t entered = kNoCut;
  std::uint16_t first_leave = kNoCut;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int a = nodes[i];
    const int b = nodes[i + 1 < nodes.size() ? i + 1 : 0];
    if (inside(a) == inside(b)) continue;
    const std::uint16_t cut = make_cut(a, b);
    if (inside(b)) {
      entered = cut;
    } else if (entered == kNoCut) {
      first_leave = cut;
    } else {
      cuts_[entered].next = cut;
      entered = kNoCut;
    }
  }
  if (entered != kNoCut) cuts_[entered].next = first_leave;
}

void ContourCell::collect_loops() {
  loop_cuts_.clear();
  loop_lengths_.clear();
  pairs_.clear();
  visited_.assign(cuts_.size(), 0);
  for (std::uint16_t start = 0; start < cuts_.size(); ++start) {
    if (visited_[start]) continue;
    const std::size_t first = loop_cuts_.size();
    for (std::uint16_t cut = start; !visited_[cut]; cut = cuts_[cut].next) {
      visited_[cut] = 1;
      loop_cuts_.push_back(cut);
      assert(cuts_[cut].next != kNoCut);
    }
    const std::size_t length = loop_cuts_.size() - first;
    if (length > 2) {
      loop_lengths_.push_back(static_cast<std::uint16_t>(length));
    } else {
      loop_cuts_.resize(first);
      pairs_.push_back(start);
    }
  }
}

void ContourCell::trace() {
  clear_cuts();
  for (std::size_t i = 0; i < polygon_count(); ++i) link_polygon(polygon(i));
  collect_loops();
}

void ContourCell::drop_lone_hanging_nodes() {
  for (const std::uint16_t first : pairs_) {
    ContourCut a = cuts_[first];
    ContourCut b = cuts_[a.next];
    if (b.low < a.low) std::swap(a, b);
    const bool rest = inside(a.low);
    const int step = id(step_along(Coord(0), a.axis, 1));
    for (int node = a.high; node <= b.low; node += step) set_inside(node, rest);
  }
  trace();
}

}  // namespace argil
