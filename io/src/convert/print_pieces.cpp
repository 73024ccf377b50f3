// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that fit a bed: cut by planes along the bed's axes, joined by loose plugs, so that every
// cut face is flat and can lie on the bed.
#include "convert/print_pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "argil/engine/clay_copy.h"
#include "argil/mesh/print_orientation.h"

namespace argil::io {
namespace {

constexpr int kSides = 48;
constexpr double kHalfLengthRadii = 2.0;

/// Along z about the origin: rings of radius and height, from below, closed at both ends.
TriangleMesh turned_solid(const std::vector<std::pair<double, double>>& rings) {
  TriangleMesh mesh;
  const auto sides = static_cast<std::uint32_t>(kSides);
  for (const auto& [radius, z] : rings) {
    for (int s = 0; s < kSides; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / kSides;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  const auto count = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t next = (s + 1) % sides;
    for (std::uint32_t r = 0; r + 1 < count; ++r) {
      const std::uint32_t low = r * sides;
      const std::uint32_t high = low + sides;
      mesh.triangles.push_back({low + s, low + next, high + next});
      mesh.triangles.push_back({low + s, high + next, high + s});
    }
    if (s == 0 || next == 0) continue;
    const std::uint32_t top = (count - 1) * sides;
    mesh.triangles.push_back({0, next, s});
    mesh.triangles.push_back({top, top + s, top + next});
  }
  return mesh;
}

/// The hole for a plug: its flat sides touch the circle, so that a round plug has the tolerance all
/// around.
TriangleMesh hole_for(double plug_radius_mm, double tolerance_mm) {
  const double radius = (plug_radius_mm + tolerance_mm) / std::cos(std::numbers::pi / kSides);
  const double half = kHalfLengthRadii * plug_radius_mm + tolerance_mm;
  return turned_solid({{radius, -half}, {radius, half}});
}

void append(TriangleMesh& all, const TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const Triangle& t : mesh.triangles) {
    all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

/// What is made along z, along another axis instead.
Vec3 from_z(const Vec3& p, std::size_t axis) noexcept {
  assert(axis < 3);
  if (axis == 0) return {p.z, p.x, p.y};
  return axis == 1 ? Vec3{p.y, p.z, p.x} : p;
}

/// Where plugs of one radius have room in one cut between two pieces.
class Joint {
 public:
  Joint(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid,
        const std::array<int, 3>& cell, std::size_t axis)
      : clay_(clay), frame_(frame), box_(grid.cell(cell)), cell_(cell), axis_(axis) {}

  /// Whether the pieces meet here at all.
  bool is_solid() const { return is_solid_; }
  /// Two places far apart, one, or none.
  std::vector<Plug> plugs(double radius, double tolerance);

 private:
  bool has_room(const Vec3& at, double radius, double tolerance) const;
  bool is_in_clay(const Vec3& on_bed) const {
    return clay_.distance_at(frame_.to_clay(on_bed)) < 0.0;
  }
  Plug plug(const Vec3& at) const { return {at, axis_, cell_}; }

  const Clay& clay_;
  const PrintFrame& frame_;
  Box3 box_;
  std::array<int, 3> cell_;
  std::size_t axis_;
  bool is_solid_ = false;
};

/// Solid around the hole, as thick as the plug's radius, at both its ends and in the middle.
bool Joint::has_room(const Vec3& at, double radius, double tolerance) const {
  constexpr int kAround = 16;
  const double half = (kHalfLengthRadii + 1.0) * radius + tolerance;
  const double wide = 2.0 * radius + tolerance;
  for (const double along : {0.0, -half, half, -0.5 * half, 0.5 * half}) {
    if (!is_in_clay(at + from_z({0.0, 0.0, along}, axis_))) return false;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const Vec3 beside{wide * std::cos(angle), wide * std::sin(angle), along};
      if (!is_in_clay(at + from_z(beside, axis_))) return false;
    }
  }
  return true;
}

std::vector<Plug> Joint::plugs(double radius, double tolerance) {
  const std::size_t u = (axis_ + 1) % 3;
  const std::size_t v = (axis_ + 2) % 3;
  // Clear of the cuts across this one.
  const double border = 2.0 * radius + tolerance;
  const double step = std::max(0.5 * radius, std::max(box_.size()[u], box_.size()[v]) / 150.0);
  std::vector<Vec3> places;
  for (double x = box_.min[u] + 0.5 * step; x < box_.max[u]; x += step) {
    for (double y = box_.min[v] + 0.5 * step; y < box_.max[v]; y += step) {
      Vec3 at;
      at[axis_] = box_.max[axis_];
      at[u] = x;
      at[v] = y;
      if (!is_in_clay(at)) continue;
      is_solid_ = true;
      const bool is_clear = x > box_.min[u] + border && x < box_.max[u] - border &&
                            y > box_.min[v] + border && y < box_.max[v] - border;
      if (is_clear && has_room(at, radius, tolerance)) places.push_back(at);
    }
  }
  if (places.empty()) return {};
  Vec3 middle;
  for (const Vec3& p : places) middle += p;
  middle *= 1.0 / static_cast<double>(places.size());
  const auto farthest_from = [&](const Vec3& from) {
    return *std::max_element(places.begin(), places.end(), [&](const Vec3& a, const Vec3& b) {
      return length(a - from) < length(b - from);
    });
  };
  const Vec3 one = farthest_from(middle);
  const Vec3 other = farthest_from(one);
  if (length(other - one) >= 4.0 * radius) return {plug(one), plug(other)};
  return {plug(*std::min_element(places.begin(), places.end(), [&](const Vec3& a, const Vec3& b) {
    return length(a - middle) < length(b - middle);
  }))};
}

/// Calls use(cell) for every cell, the lowest first.
template <class Use>
void for_each_cell(const PieceGrid& grid, const Use& use) {
  for (int k = 0; k < grid.counts[2]; ++k) {
    for (int j = 0; j < grid.counts[1]; ++j) {
      for (int i = 0; i < grid.counts[0]; ++i) use(std::array<int, 3>{i, j, k});
    }
  }
}

PlugPlan plan_with(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid, double radius,
                   double tolerance) {
  PlugPlan plan;
  plan.radius_mm = radius;
  for_each_cell(grid, [&](const std::array<int, 3>& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] + 1 == grid.counts[axis]) continue;
      Joint joint(clay, frame, grid, cell, axis);
      const std::vector<Plug> plugs = joint.plugs(radius, tolerance);
      if (joint.is_solid() && plugs.empty()) ++plan.joints_without;
      plan.plugs.insert(plan.plugs.end(), plugs.begin(), plugs.end());
    }
  });
  return plan;
}

/// The planes that part a cell from its neighbours, in the clay's frame.
std::vector<Cut> cuts_of(const PrintFrame& frame, const PieceGrid& grid,
                         const std::array<int, 3>& at) {
  const Box3 box = grid.cell(at);
  std::vector<Cut> cuts;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 normal;
    normal[axis] = 1.0;
    const Vec3 in_clay = frame.direction_to_clay(normal);
    if (at[axis] > 0) cuts.push_back({frame.to_clay(box.min), in_clay, true});
    if (at[axis] + 1 < grid.counts[axis]) cuts.push_back({frame.to_clay(box.max), in_clay, false});
  }
  return cuts;
}

/// The holes of all plugs of a cell.
TriangleMesh holes_of(const PlugPlan& plan, const std::array<int, 3>& at, double tolerance) {
  const TriangleMesh hole = hole_for(plan.radius_mm, tolerance);
  TriangleMesh holes;
  for (const Plug& plug : plan.plugs) {
    std::array<int, 3> next = plug.cell;
    ++next[plug.axis];
    if (plug.cell != at && next != at) continue;
    TriangleMesh placed = hole;
    for (Vec3& p : placed.positions) p = from_z(p, plug.axis) + plug.middle_mm;
    append(holes, placed);
  }
  return holes;
}

bool fits(const Vec3& size, const Vec3& bed) noexcept {
  return size.z <= bed.z &&
         ((size.x <= bed.x && size.y <= bed.y) || (size.x <= bed.y && size.y <= bed.x));
}

}  // namespace

Box3 PieceGrid::cell(const std::array<int, 3>& at) const noexcept {
  Box3 part = box;
  for (std::size_t a = 0; a < 3; ++a) {
    const double side = box.size()[a] / counts[a];
    part.min[a] = box.min[a] + side * at[a];
    part.max[a] = at[a] + 1 == counts[a] ? box.max[a] : box.min[a] + side * (at[a] + 1);
  }
  return part;
}

PieceGrid pieces_for(const Box3& box, const Vec3& bed_mm) noexcept {
  assert(bed_mm.x > 0.0 && bed_mm.y > 0.0 && bed_mm.z > 0.0);
  const auto count = [](double size, double room) {
    return std::max(1, static_cast<int>(std::ceil(size / room)));
  };
  const Vec3 size = box.size();
  PieceGrid straight{{count(size.x, bed_mm.x), count(size.y, bed_mm.y), count(size.z, bed_mm.z)},
                     box};
  // Turned by a quarter about z, as check_print allows.
  PieceGrid turned{{count(size.x, bed_mm.y), count(size.y, bed_mm.x), count(size.z, bed_mm.z)},
                   box};
  const auto pieces = [](const PieceGrid& g) { return g.counts[0] * g.counts[1]; };
  return pieces(turned) < pieces(straight) ? turned : straight;
}

PlugPlan plugs_for(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid,
                   double tolerance_mm) {
  PlugPlan best;
  for (const double radius : {4.0, 3.0, 2.0, 1.5, 1.0}) {
    PlugPlan plan = plan_with(clay, frame, grid, radius, tolerance_mm);
    const bool is_better = best.radius_mm == 0.0 || plan.joints_without < best.joints_without;
    if (is_better) best = std::move(plan);
    if (best.joints_without == 0) break;
  }
  return best;
}

Result<TriangleMesh> cut_piece(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid,
                               const std::array<int, 3>& at, const PlugPlan& plan,
                               double tolerance_mm, const Pace& pace) {
  Clay piece = copy_of(clay);
  for (const Cut& cut : cuts_of(frame, grid, at)) {
    const auto done = piece.apply(cut, answering(pace.part(0.0, 0.5)));
    if (!done) return done.error();
  }
  TriangleMesh holes = holes_of(plan, at, tolerance_mm);
  if (!holes.triangles.empty()) {
    Combine with;
    with.kind = CombineKind::subtract;
    with.mesh = std::make_shared<const TriangleMesh>(frame.to_clay(std::move(holes)));
    const auto done = piece.apply(with, answering(pace.part(0.5, 1.0)));
    if (!done) return done.error();
  }
  return surface_on_bed(piece, frame);
}

TriangleMesh laid_on_cut(TriangleMesh piece, const PieceGrid& grid, const std::array<int, 3>& at,
                         const Vec3& bed_mm) {
  // What was cut from below already lies on its cut.
  if (at[2] > 0) return piece;
  // Of one cut from above only, the base lies below, flat too.
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (grid.counts[axis] == 1) continue;
    Vec3 up;
    up[axis] = at[axis] > 0 ? 1.0 : -1.0;
    TriangleMesh laid = piece;
    const Quat turn = mesh::turn_up(up);
    for (Vec3& p : laid.positions) p = rotate(turn, p);
    if (fits(bounds(laid).size(), bed_mm)) return laid;
  }
  return piece;
}

TriangleMesh plugs_to_print(const PlugPlan& plan) {
  assert(plan.radius_mm > 0.0);
  const double r = plan.radius_mm;
  const double bevel = 0.2 * r;
  const double high = 2.0 * kHalfLengthRadii * r;
  const TriangleMesh plug =
      turned_solid({{r - bevel, 0.0}, {r, bevel}, {r, high - bevel}, {r - bevel, high}});
  TriangleMesh all;
  const int in_row = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(plan.plugs.size()))));
  for (std::size_t i = 0; i < plan.plugs.size(); ++i) {
    TriangleMesh placed = plug;
    const double apart = 2.0 * r + 3.0;
    const Vec3 at{apart * static_cast<double>(static_cast<int>(i) % in_row),
                  apart * static_cast<double>(static_cast<int>(i) / in_row), 0.0};
    for (Vec3& p : placed.positions) p += at;
    append(all, placed);
  }
  return all;
}

}  // namespace argil::io
