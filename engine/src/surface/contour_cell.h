// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/level_stack.h"

namespace argil {

// Notation: a cell of some level is looked at on its own lattice of (2^depth + 1)^3 nodes; lattice
// coordinate 0 is the cell's low corner, 2^depth its high one, and a node's id is its index with x
// slowest. "Depth d" means d levels finer than the cell. A face is a polygon, or four faces one
// depth further down where the cell across it is refined; a side of a polygon is one edge, or two
// where any of the four cells about it is refined. Both are functions of the face or the edge
// alone, so that all cells around it see the same polygons: that is the whole of the method.

/// Answers whether a cell is replaced by eight finer ones.
class Refinement {
 public:
  Refinement() = default;
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;
  virtual ~Refinement() = default;
  /// Whether cell `cell`, `depth` levels finer than the block's and counted from the block's low
  /// corner in cells of its own size, is refined once more.
  virtual bool refined(int depth, const Coord& cell) const = 0;
};

/// Where the surface crosses one undivided lattice edge of a cell.
struct ContourCut {
  std::uint16_t low = 0;   ///< id of the edge's node with the smaller coordinate
  std::uint16_t high = 0;  ///< id of its other node
  std::uint16_t next = 0;  ///< the cut that follows in its loop
  std::uint8_t axis = 0;
  std::uint8_t planes = 0;  ///< bit 2*axis + side for every face plane of the cell it lies in
};

/// The polygons around one cell, and the loops in which the surface cuts them. Scratch to be used
/// again and again: it allocates only while it grows. Not for several threads at once.
class ContourCell {
 public:
  static constexpr int kMaxDepth = 4;  ///< splits further down are ignored: 17^3 nodes

  /// Finds the polygons of the cell whose coordinates in the block are `cell`.
  void build(const Refinement& refinement, const Coord& cell, int depth);

  int depth() const noexcept { return depth_; }
  /// Ids of all nodes of polygons, each once; the eight corners are among them.
  std::span<const std::uint16_t> nodes() const noexcept { return nodes_; }
  Coord position(int node) const noexcept;
  bool inside(int node) const noexcept { return inside_[static_cast<std::size_t>(node)] != 0; }
  void set_inside(int node, bool inside) noexcept {
    inside_[static_cast<std::size_t>(node)] = inside ? 1 : 0;
  }

  /// Finds cuts and loops for the present insides. A loop of two cuts is the trace of hanging nodes
  /// alone on their edge: it bounds nothing, so it is left out (the cells around it pair up).
  void trace();
  std::span<const ContourCut> cuts() const noexcept { return cuts_; }
  /// The cuts of all loops, one loop after the other, and the length of each.
  std::span<const std::uint16_t> loop_cuts() const noexcept { return loop_cuts_; }
  std::span<const std::uint16_t> loop_lengths() const noexcept { return loop_lengths_; }

  /// Gives the hanging nodes between the two cuts of every loop of two the side of the rest of
  /// their edge, and traces again. What other cells see does not change.
  void drop_lone_hanging_nodes();

  /// The polygons, their nodes counter-clockwise seen from outside the cell.
  std::size_t polygon_count() const noexcept { return polygon_ends_.size(); }
  std::span<const std::uint16_t> polygon(std::size_t index) const noexcept;

 private:
  int side() const noexcept { return (1 << depth_) + 1; }
  int id(const Coord& position) const noexcept;
  void look_around();
  bool refined(int depth, const Coord& low) const;
  bool edge_split(int depth, const Coord& low, int axis) const;
  void add_face(int axis, int high, int depth, const Coord& low);
  void add_polygon(int axis, int high, int depth, const Coord& low);
  void add_side(const Coord& from, int axis, int step, int depth);
  void add_node(const Coord& position);
  std::size_t edge_slot(int a, int b) const noexcept;
  std::uint16_t make_cut(int a, int b);
  void link_polygon(std::span<const std::uint16_t> nodes);
  void collect_loops();
  void clear_cuts();

  const Refinement* refinement_ = nullptr;
  Coord cell_;
  std::array<bool, 27> around_{};  // which of the cells of its own size around it are refined
  int depth_ = -1;
  std::vector<std::uint16_t> nodes_;
  std::vector<std::uint16_t> polygon_nodes_;
  std::vector<std::uint32_t> polygon_ends_;
  std::vector<std::uint8_t> known_;    // per node: already in nodes_
  std::vector<std::uint8_t> inside_;   // per node
  std::vector<std::uint16_t> cut_of_;  // per axis and low node
  std::vector<ContourCut> cuts_;
  std::vector<std::uint16_t> loop_cuts_;
  std::vector<std::uint16_t> loop_lengths_;
  std::vector<std::uint16_t> pairs_;   // first cuts of loops of two
  std::vector<std::uint8_t> visited_;  // per cut
};

}  // namespace argil
