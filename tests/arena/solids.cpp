// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/solids.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>

#include "argil/io/mesh_file.h"
#include "argil/mesh/check.h"
#include "argil/mesh/close.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/polygon_triangles.h"
#include "argil/mesh/rounding.h"

#include "rivals/decimators.h"
#include "support/built.h"
#include "support/models.h"
#include "support/shapes.h"

namespace argil::arena {
namespace {

constexpr double kPi = std::numbers::pi;

/// A closed polygon of (x, y), counter-clockwise, raised to `height`; a hole is joined to its rim
/// by a cut that is gone along twice.
TriangleMesh extruded(const std::vector<std::vector<Vec3>>& rims, const std::vector<Vec3>& polygon,
                      double height) {
  TriangleMesh mesh;
  for (const Triangle& t : mesh::triangulated(polygon)) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t v : t) mesh.positions.push_back(polygon[v] + Vec3{0, 0, height});
    mesh.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) mesh.positions.push_back(polygon[v]);
    mesh.triangles.push_back({first + 3, first + 5, first + 4});
  }
  for (const std::vector<Vec3>& rim : rims) {
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const Vec3& a = rim[i];
      const Vec3& b = rim[(i + 1) % rim.size()];
      const Vec3 up{0, 0, height};
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), {a, b, b + up, a + up});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh::welded(mesh);
}

TriangleMesh letter_e() {
  const std::vector<Vec3> rim{{0, 0, 0},   {50, 0, 0},  {50, 12, 0}, {14, 12, 0},
                              {14, 34, 0}, {42, 34, 0}, {42, 46, 0}, {14, 46, 0},
                              {14, 68, 0}, {50, 68, 0}, {50, 80, 0}, {0, 80, 0}};
  return extruded({rim}, rim, 10.0);
}

TriangleMesh letter_o() {
  constexpr int kSteps = 40;
  std::vector<Vec3> outer;
  std::vector<Vec3> inner;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * kPi * i / kSteps;
    outer.push_back({30.0 * std::cos(angle), 40.0 * std::sin(angle), 0});
    inner.push_back({18.0 * std::cos(angle), -26.0 * std::sin(angle), 0});
  }
  std::vector<Vec3> polygon = outer;
  polygon.push_back(outer.front());
  polygon.insert(polygon.end(), inner.begin(), inner.end());
  polygon.push_back(inner.front());
  return extruded({outer, inner}, polygon, 10.0);
}

/// Every triangle in four.
TriangleMesh split_in_four(const TriangleMesh& mesh) {
  TriangleMesh finer;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.positions[a];
    const Vec3& q = mesh.positions[b];
    const Vec3& r = mesh.positions[c];
    const Vec3 pq = 0.5 * (p + q);
    const Vec3 qr = 0.5 * (q + r);
    const Vec3 rp = 0.5 * (r + p);
    for (const auto& corners : {std::array{p, pq, rp}, std::array{pq, q, qr}, std::array{rp, qr, r},
                                std::array{pq, qr, rp}}) {
      const auto first = static_cast<std::uint32_t>(finer.positions.size());
      finer.positions.insert(finer.positions.end(), corners.begin(), corners.end());
      finer.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return mesh::welded(finer);
}

TriangleMesh fine_box() {
  TriangleMesh mesh = test::box_mesh({60, 40, 25});
  for (int i = 0; i < 4; ++i) mesh = split_in_four(mesh);
  return mesh;
}

TriangleMesh bent_pipe() {
  const Curve curve = [](double t) {
    const double angle = 1.5 * kPi * t;
    return Vec3{40.0 * std::cos(angle), 40.0 * std::sin(angle), 30.0 * t * t};
  };
  return tube_piece(curve, 9.0, 120, 28, 0, 120);
}

Solid rounded(std::string name, const TriangleMesh& mesh) {
  return {std::move(name), mesh::rounded_to_float(mesh)};
}

std::optional<Solid> from_file(const std::filesystem::path& file, std::size_t most,
                               const std::function<void(const std::string&)>& said) {
  auto read = io::read_mesh(file);
  if (!read) {
    said(read.error().message);
    return std::nullopt;
  }
  TriangleMesh mesh = mesh::welded(read.value());
  if (auto closed = mesh::close_mesh(mesh); closed) mesh = std::move(closed.value().mesh);
  if (mesh.triangles.size() > most) {
    auto fewer = evaluation::cgal_decimated(mesh, static_cast<std::int64_t>(most));
    if (!fewer) {
      said(file.filename().string() + ": CGAL makes it no smaller");
      return std::nullopt;
    }
    mesh = std::move(*fewer);
  }
  std::string name = file.stem().string();
  return rounded(name == "stanford-bunny" ? "bunny" : name, mesh);
}

}  // namespace

TriangleMesh tube_piece(const Curve& curve, double radius, int rings, int segments, int first,
                        int last) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(segments);
  for (int i = first; i <= last; ++i) {
    const double t = static_cast<double>(i) / rings;
    const Vec3 along = normalized(curve(t + 1e-5) - curve(t - 1e-5));
    const Vec3 side = normalized(cross(along, {0, 0, 1}));
    const Vec3 up = cross(side, along);
    for (int s = 0; s < segments; ++s) {
      const double angle = 2.0 * kPi * s / segments;
      mesh.positions.push_back(curve(t) + radius * (std::cos(angle) * side + std::sin(angle) * up));
    }
  }
  const auto steps = static_cast<std::uint32_t>(last - first);
  for (std::uint32_t i = 0; i < steps; ++i) {
    for (std::uint32_t s = 0; s < count; ++s) {
      const std::uint32_t a = i * count + s;
      const std::uint32_t b = i * count + (s + 1) % count;
      mesh.triangles.push_back({a, b + count, b});
      mesh.triangles.push_back({a, a + count, b + count});
    }
  }
  const std::uint32_t end = steps * count;
  for (std::uint32_t s = 1; s + 1 < count; ++s) {
    mesh.triangles.push_back({0, s, s + 1});
    mesh.triangles.push_back({end, end + s + 1, end + s});
  }
  return mesh;
}

TriangleMesh tube_along(const Curve& curve, double radius, int rings, int segments) {
  TriangleMesh mesh = tube_piece(curve, radius, rings, segments, 0, rings);
  const auto count = static_cast<std::uint32_t>(segments);
  mesh.triangles.resize(2 * static_cast<std::size_t>(segments) * static_cast<std::size_t>(rings));
  const std::uint32_t end = static_cast<std::uint32_t>(rings) * count;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = v >= end ? v - end : v;
  }
  mesh.positions.resize(end);
  return mesh;
}

Solid thin_solid(int variant, double thickness) {
  constexpr int kSteps = 48;
  static constexpr const char* kNames[] = {"plate", "arch", "bowl", "wave", "strip", "fold"};
  const auto shape = [&](double u, double v) -> std::pair<Vec3, Vec3> {  // place and normal
    const double x = 100.0 * (u - 0.5);
    const double y = 70.0 * (v - 0.5);
    switch (variant % 6) {
      case 0:
        return {{x, y, 0}, {0, 0, 1}};
      case 1: {
        const double a = kPi * (u - 0.5) * 0.9;
        return {{50 * std::sin(a), y, 50 * std::cos(a)}, {std::sin(a), 0, std::cos(a)}};
      }
      case 2: {
        const double a = x / 60.0;
        const double b = y / 60.0;
        const Vec3 n = normalized(Vec3{std::sin(a), std::sin(b), std::cos(a) * std::cos(b)});
        return {60.0 * n, n};
      }
      case 3: {
        const double k = 2.0 * kPi / 50.0;
        return {{x, y, 6 * std::sin(k * x)}, normalized(Vec3{-6 * k * std::cos(k * x), 0, 1})};
      }
      case 4:
        return {{x, 0.1 * y, 0}, {0, 0, 1}};
      default:
        return {{x, y, std::abs(x)}, {0, 0, 1}};
    }
  };
  TriangleMesh mesh;
  constexpr std::uint32_t kRow = kSteps + 1;
  for (int side = 0; side < 2; ++side) {
    for (int j = 0; j <= kSteps; ++j) {
      for (int i = 0; i <= kSteps; ++i) {
        const auto [at, normal] = shape(1.0 * i / kSteps, 1.0 * j / kSteps);
        mesh.positions.push_back(at + (side == 0 ? 0.5 : -0.5) * thickness * normal);
      }
    }
  }
  const std::uint32_t below = kRow * kRow;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t j = 0; j < kSteps; ++j) {
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t a = j * kRow + i;
      quad(a, a + 1, a + kRow + 1, a + kRow);
      quad(below + a, below + a + kRow, below + a + kRow + 1, below + a + 1);
    }
    const std::uint32_t left = j * kRow;
    const std::uint32_t right = left + kSteps;
    quad(left, left + kRow, below + left + kRow, below + left);
    quad(right, below + right, below + right + kRow, right + kRow);
    const std::uint32_t front = j;
    const std::uint32_t back = kSteps * kRow + j;
    quad(front, below + front, below + front + 1, front + 1);
    quad(back, back + 1, below + back + 1, below + back);
  }
  return rounded(kNames[variant % 6], mesh);
}

std::vector<Solid> simple_solids() {
  return {rounded("box", test::box_mesh({60, 40, 25})),
          rounded("finebox", fine_box()),
          rounded("ball", test::ball_mesh(30.0, 4)),
          rounded("torus", test::torus_mesh(30.0, 10.0, 64, 32)),
          rounded("pipe", bent_pipe()),
          rounded("lettere", letter_e()),
          rounded("lettero", letter_o())};
}

std::vector<Solid> sound_solids(std::size_t most_triangles,
                                const std::function<void(const std::string&)>& said) {
  std::vector<Solid> solids = simple_solids();
  const std::filesystem::path pebble =
      std::filesystem::path(test::source_folder()) / "examples/pebble.ply";
  if (auto solid = from_file(pebble, most_triangles, said)) solids.push_back(std::move(*solid));
  for (const char* name :
       {"spot.obj", "cow.obj", "fandisk.obj", "rocker-arm.obj", "stanford-bunny.obj"}) {
    const auto file = test::find_model(name);
    if (!file) {
      said(test::missing_model(name));
      continue;
    }
    if (auto solid = from_file(*file, most_triangles, said)) solids.push_back(std::move(*solid));
  }
  std::erase_if(solids, [&](const Solid& solid) {
    if (mesh::check_mesh(solid.mesh).printable) return false;
    said(solid.name + " is not sound itself and left out");
    return true;
  });
  return solids;
}

}  // namespace argil::arena
