// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <optional>
#include <vector>

#include "argil/core/vec3.h"

#include "field/level_stack.h"
#include "field/upsample.h"

namespace argil {

/// The smallest box of nodes that covers a box in mm.
openvdb::CoordBBox nodes_covering(const Box3& box_mm, double voxel_mm);

/// Where a leaf lies with respect to a solid.
enum class Side {
  outside,  ///< every node is outside, at least as far as was asked
  inside,   ///< every node is inside, at least as far
  near,     ///< neither is known
};

/// A solid on the lattices of a clay, ready to be combined with it. Thread-safe.
class Solid {
 public:
  virtual ~Solid() = default;
  /// `reach_mm`: at least the band of the level.
  virtual Side side_of(int level, const Coord& origin, double reach_mm) const = 0;
  /// Signed distance at the 8^3 nodes, clamped to the band of the level.
  virtual void fill(int level, const Coord& origin, LeafValues& out) const = 0;
  /// The same at one node.
  virtual float at(int level, const Coord& node) const = 0;
  /// The same at the nodes of the level `coarser` that span a leaf of the next finer one.
  virtual CoarseNodes coarse(int coarser, const Coord& origin) const;
  /// At one node, beyond the band too, as far as is known.
  virtual float beyond_band(int level, const Coord& node) const = 0;
  /// Sorted leaves of a level that must be looked at, since the coarser levels may not tell what
  /// the solid does there.
  virtual std::vector<Coord> detailed_origins(int level) const = 0;
  /// The nodes of the coarsest level that hold it with its band; none when it has no end.
  virtual std::optional<openvdb::CoordBBox> top_nodes() const { return std::nullopt; }
};

/// The half space behind a plane.
class PlaneSolid final : public Solid {
 public:
  /// `normal` of unit length, pointing out of the solid. Refers to `lattice`.
  PlaneSolid(const LevelStack& lattice, const Vec3& point_mm, const Vec3& normal)
      : lattice_(lattice), point_(point_mm), normal_(normal) {
    assert(is_finite(point_mm) && is_finite(normal));
  }
  Side side_of(int level, const Coord& origin, double reach_mm) const override;
  void fill(int level, const Coord& origin, LeafValues& out) const override;
  float at(int level, const Coord& node) const override;
  float beyond_band(int level, const Coord& node) const override;
  std::vector<Coord> detailed_origins(int) const override { return {}; }

 private:
  double distance(const Vec3& p) const noexcept { return dot(p - point_, normal_); }
  const LevelStack& lattice_;
  Vec3 point_;
  Vec3 normal_;
};

/// A round rod with flat ends.
struct Rod {
  Vec3 from_mm;
  Vec3 axis;  ///< unit
  double length_mm = 0.0;
  double radius_mm = 0.0;
};

class RodSolid final : public Solid {
 public:
  RodSolid(const LevelStack& lattice, const Rod& rod, double tolerance_mm);
  Side side_of(int level, const Coord& origin, double reach_mm) const override;
  void fill(int level, const Coord& origin, LeafValues& out) const override;
  float at(int level, const Coord& node) const override;
  float beyond_band(int level, const Coord& node) const override;
  std::vector<Coord> detailed_origins(int level) const override;

 private:
  double distance(const Vec3& p) const noexcept;
  const LevelStack& lattice_;
  Rod rod_;
  int level_ = 0;  ///< the coarsest level that holds its roundness
};

/// Levels of the same lattice as a clay whose coarsest level is `top`: as many, or more.
class StackSolid final : public Solid {
 public:
  StackSolid(const LevelStack& stack, int top) : stack_(stack), top_(top) {
    assert(top >= 0 && top <= stack.top());
  }
  Side side_of(int level, const Coord& origin, double reach_mm) const override;
  void fill(int level, const Coord& origin, LeafValues& out) const override;
  float at(int level, const Coord& node) const override;
  CoarseNodes coarse(int coarser, const Coord& origin) const override;
  float beyond_band(int level, const Coord& node) const override;
  std::vector<Coord> detailed_origins(int level) const override {
    return stack_.sorted_origins(level);
  }
  std::optional<openvdb::CoordBBox> top_nodes() const override;

 private:
  const LevelStack& stack_;
  int top_;
};

}  // namespace argil
