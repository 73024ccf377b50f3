// SPDX-License-Identifier: GPL-3.0-or-later
// A fixed set of points in the tool instead of a lattice in the clay: quadrature by shells in the
// ball and rings on the sphere.
#include "force/stencil.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include "force/law.h"

namespace argil::evaluation {
namespace {

using haptics::ForceMaterial;
using haptics::ForceTool;

struct Weighted {
  double at;
  double weight;
};

// Gauss's rules for r^2 (1 - r^2)^4 on 0 to 1 in powers of r^2, and Gauss-Legendre's for -1 to 1,
// weights summing to 1.
constexpr std::array kShells3{Weighted{0.287434978746633, 0.444135337687308},
                              Weighted{0.554010074114281, 0.478555810743656},
                              Weighted{0.781315538545606, 0.077308851569038}};
constexpr std::array kShells4{
    Weighted{0.241261054373291, 0.293700889388685}, Weighted{0.469640571639374, 0.479974851947425},
    Weighted{0.673079358374704, 0.205645107083779}, Weighted{0.841543233852443, 0.020679151580112}};
constexpr std::array kShells6{
    Weighted{0.183327555531788, 0.143913060022055}, Weighted{0.360779990437900, 0.348146196461655},
    Weighted{0.526679097384059, 0.324138728192158}, Weighted{0.675743317170226, 0.149811550540849},
    Weighted{0.803315764466990, 0.031930359917652}, Weighted{0.905830585571076, 0.002060104865632}};
constexpr std::array kHeights6{Weighted{-0.932469514203152, 0.085662246189585},
                               Weighted{-0.661209386466265, 0.180380786524069},
                               Weighted{-0.238619186083197, 0.233956967286346},
                               Weighted{0.238619186083197, 0.233956967286346},
                               Weighted{0.661209386466265, 0.180380786524069},
                               Weighted{0.932469514203152, 0.085662246189585}};
constexpr std::array kHeights8{Weighted{-0.960289856497536, 0.050614268145188},
                               Weighted{-0.796666477413627, 0.111190517226687},
                               Weighted{-0.525532409916329, 0.156853322938944},
                               Weighted{-0.183434642495650, 0.181341891689181},
                               Weighted{0.183434642495650, 0.181341891689181},
                               Weighted{0.525532409916329, 0.156853322938944},
                               Weighted{0.796666477413627, 0.111190517226687},
                               Weighted{0.960289856497536, 0.050614268145188}};

void add_shells(std::span<const Weighted> shells, const Vec3& direction, double weight,
                std::vector<StencilPoint>& points) {
  for (const Weighted& shell : shells)
    points.push_back({shell.at * direction, shell.weight * weight});
}

std::vector<StencilPoint> gauss_product(std::span<const Weighted> shells,
                                        std::span<const Weighted> heights) {
  const std::size_t turns = 2 * heights.size();
  std::vector<StencilPoint> points;
  for (const Weighted& height : heights) {
    // The product rule of the sphere: Gauss-Legendre over heights, equal steps round each ring.
    const double ring = std::sqrt(1.0 - height.at * height.at);
    for (std::size_t i = 0; i < turns; ++i) {
      const double turn =
          2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(turns);
      add_shells(shells, {ring * std::cos(turn), ring * std::sin(turn), height.at},
                 height.weight / static_cast<double>(turns), points);
    }
  }
  return points;
}

/// The 12 corners and the 20 middles of the faces of an icosahedron, exact to degree 9.
std::vector<StencilPoint> icosahedral() {
  constexpr double kGolden = std::numbers::phi;
  constexpr double kCorner = 25.0 / 840.0;
  constexpr double kFace = 27.0 / 840.0;
  std::vector<StencilPoint> points;
  for (int sign = 0; sign < 8; ++sign) {
    const double a = (sign & 1) != 0 ? 1.0 : -1.0;
    const double b = (sign & 2) != 0 ? 1.0 : -1.0;
    const double c = (sign & 4) != 0 ? 1.0 : -1.0;
    add_shells(kShells3, normalized(Vec3{a, b, c}), kFace, points);
    if (sign >= 4) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {  // cyclic shifts of (0, 1, phi), (0, phi, 1/phi)
      Vec3 corner;
      Vec3 face;
      corner[(axis + 1) % 3] = a;
      corner[(axis + 2) % 3] = b * kGolden;
      face[(axis + 1) % 3] = a * kGolden;
      face[(axis + 2) % 3] = b / kGolden;
      add_shells(kShells3, normalized(corner), kCorner, points);
      add_shells(kShells3, normalized(face), kFace, points);
    }
  }
  return points;
}

/// The eight nodes around a point and where it lies between them.
struct Cell {
  std::array<double, 8> value;  ///< x slowest
  Vec3 fraction;
};

/// Trilinear distance and its gradient in cells.
double trilinear(const Cell& cell, Vec3& gradient) {
  const auto& v = cell.value;
  const Vec3& s = cell.fraction;
  const auto between = [](double a, double b, double t) { return a + t * (b - a); };
  const std::array<double, 4> along_z{between(v[0], v[1], s.z), between(v[2], v[3], s.z),
                                      between(v[4], v[5], s.z), between(v[6], v[7], s.z)};
  const double low = between(along_z[0], along_z[1], s.y);
  const double high = between(along_z[2], along_z[3], s.y);
  // The exact derivative of the interpolation, so that distance and normal fit each other.
  gradient.x = high - low;
  gradient.y = between(along_z[1] - along_z[0], along_z[3] - along_z[2], s.x);
  gradient.z =
      between(between(v[1] - v[0], v[3] - v[2], s.y), between(v[5] - v[4], v[7] - v[6], s.y), s.x);
  return between(low, high, s.x);
}

/// Sums over the points; `cell_at(at_mm, cell)` is false outside.
template <class CellAt>
Wrench sum_points(const std::vector<StencilPoint>& points, const ForceTool& tool,
                  const ForceMaterial& material, const CellAt& cell_at) {
  assert(material.skin_mm > 0.0);
  const Law law(material);
  std::array<Vec3, 3> axes;  // of the support, in the world's frame
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 unit;
    unit[a] = haptics::kKernelSupport * tool.radii_mm[a];
    axes[a] = rotate(tool.orientation, unit);
  }
  Wrench sum;
  Cell cell;
  for (const StencilPoint& point : points) {
    const Vec3 r = point.q.x * axes[0] + point.q.y * axes[1] + point.q.z * axes[2];
    if (!cell_at(tool.position_mm + r, cell)) continue;
    Vec3 gradient;
    const double u = 1.0 - trilinear(cell, gradient) / material.skin_mm;
    if (u <= 0.0) continue;
    const Vec3 push = (point.weight * law.pressure(u)) * normalized(gradient);
    sum.force_n += push;
    sum.torque_nmm += cross(r, push);
  }
  sum.force_n *= material.surface_force_n;
  sum.torque_nmm *= material.surface_force_n;
  return sum;
}

}  // namespace

std::vector<StencilPoint> stencil_points(int count) {
  assert(count == 96 || count == 288 || count == 768);
  if (count == 96) return icosahedral();
  if (count == 288) return gauss_product(kShells4, kHeights6);
  return gauss_product(kShells6, kHeights8);
}

Wrench stencil_force(const std::vector<StencilPoint>& points, const FieldWindowView& window,
                     const ForceTool& tool, const ForceMaterial& material) {
  assert(window.distance_mm.size() == window.index(window.nodes[0], 0, 0));
  const double per_mm = 1.0 / window.voxel_mm;
  const auto row = static_cast<std::ptrdiff_t>(window.nodes[2]);
  const auto layer = row * window.nodes[1];
  return sum_points(points, tool, material, [&](const Vec3& at_mm, Cell& cell) {
    std::array<int, 3> low{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double at = (at_mm[a] - window.origin_mm[a]) * per_mm;
      if (!(at >= 0.0 && at < window.nodes[a] - 1)) return false;
      low[a] = static_cast<int>(at);
      cell.fraction[a] = at - low[a];
    }
    const float* v = window.distance_mm.data() + window.index(low[0], low[1], low[2]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::ptrdiff_t to = ((corner & 4) != 0 ? layer : 0) + ((corner & 2) != 0 ? row : 0) +
                                ((corner & 1) != 0 ? 1 : 0);
      cell.value[corner] = static_cast<double>(v[to]);
    }
    return true;
  });
}

Wrench stencil_force(const std::vector<StencilPoint>& points, const Distance& distance,
                     double voxel_mm, const ForceTool& tool, const ForceMaterial& material) {
  assert(voxel_mm > 0.0);
  return sum_points(points, tool, material, [&](const Vec3& at_mm, Cell& cell) {
    Vec3 low;
    for (std::size_t a = 0; a < 3; ++a) {
      const double at = at_mm[a] / voxel_mm;
      low[a] = std::floor(at);
      cell.fraction[a] = at - low[a];
    }
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Vec3 step{(corner & 4) != 0 ? 1.0 : 0.0, (corner & 2) != 0 ? 1.0 : 0.0,
                      (corner & 1) != 0 ? 1.0 : 0.0};
      cell.value[corner] = distance(voxel_mm * (low + step));
    }
    return true;
  });
}

}  // namespace argil::evaluation
