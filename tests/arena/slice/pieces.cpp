// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/slice/pieces.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <utility>

#include "argil/mesh/rounding.h"

#include "arena/solids.h"
#include "arena/surgery.h"
#include "arena/truth.h"
#include "support/shapes.h"

namespace argil::arena {
namespace {

std::string with_size(const char* what, double size) {
  char text[64];
  std::snprintf(text, sizeof text, "%s_%.2f", what, size);
  return text;
}

/// A box that stands at a point.
TriangleMesh standing_box(const Vec3& size, const Vec3& at) {
  return test::box_mesh(size, at + Vec3{0, 0, 0.5 * size.z});
}

/// Moves vertices with z above `from` by a function of the vertex.
template <class Move>
TriangleMesh moved_above(TriangleMesh mesh, double from, const Move& move) {
  for (Vec3& p : mesh.positions) {
    if (p.z > from) p = move(p);
  }
  return mesh;
}

/// A round pin that narrows from one radius to another.
TriangleMesh frustum(double bottom, double top, double height, const Vec3& at) {
  constexpr std::uint32_t kSides = 32;
  TriangleMesh mesh;
  for (const auto& [radius, z] : {std::pair{bottom, 0.0}, std::pair{top, height}}) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      mesh.positions.push_back(at + Vec3{radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t next = (i + 1) % kSides;
    mesh.triangles.push_back({i, next, kSides + next});
    mesh.triangles.push_back({i, kSides + next, kSides + i});
    if (i == 0 || i + 1 == kSides) continue;
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({kSides, kSides + i, kSides + i + 1});
  }
  return mesh;
}

/// A pipe standing up: its wall `wall` thick.
TriangleMesh pipe(double radius, double wall, double height) {
  constexpr std::uint32_t kSides = 48;
  TriangleMesh mesh;
  for (const double r : {radius, radius - wall}) {
    for (const double z : {0.0, height}) {
      for (std::uint32_t i = 0; i < kSides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSides;
        mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), z});
      }
    }
  }
  const auto band = [&](std::uint32_t lower, std::uint32_t upper) {  // rings, seen from outside
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t next = (i + 1) % kSides;
      mesh.triangles.push_back({lower * kSides + i, lower * kSides + next, upper * kSides + next});
      mesh.triangles.push_back({lower * kSides + i, upper * kSides + next, upper * kSides + i});
    }
  };
  band(0, 1);
  band(1, 3);
  band(3, 2);
  band(2, 0);
  return mesh;
}

/// Two legs and a plate over them, in one.
TriangleMesh table_top(double thick) {
  const std::vector<std::pair<double, double>> outline{
      {-8, 0}, {-5, 0}, {-5, 4}, {5, 4}, {5, 0}, {8, 0}, {8, 4 + thick}, {-8, 4 + thick}};
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double y : {-4.0, 4.0}) {
    for (const auto& [x, z] : outline) mesh.positions.push_back({x, y, z});
  }
  for (const auto& [a, b, c] :
       std::vector<Triangle>{{0, 1, 2}, {0, 2, 7}, {2, 3, 7}, {3, 6, 7}, {3, 4, 5}, {3, 5, 6}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({count + a, count + c, count + b});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({next, i, count + i});
    mesh.triangles.push_back({next, count + i, count + next});
  }
  return mesh;
}

class Pieces {
 public:
  void add(const std::string& name, TriangleMesh mesh) {
    pieces_.push_back({name, mesh::rounded_to_float(std::move(mesh))});
  }

  void add_walls() {
    for (const double t : {0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.8, 1.0}) {
      add(with_size("wall", t), standing_box({12, t, 8}, {}));
    }
    // A roof with a flat ridge.
    for (const double t : {0.1, 0.2, 0.3, 0.4, 0.5, 0.8}) {
      TriangleMesh roof = moved_above(standing_box({12, 6, 6}, {}), 3.0, [&](const Vec3& p) {
        return Vec3{p.x, p.y > 0.0 ? 0.5 * t : -0.5 * t, p.z + 4.0};
      });
      add(with_size("ridge", t), std::move(roof));
    }
    for (const double t : {0.1, 0.2, 0.4, 0.6, 0.8, 1.2}) {
      TriangleMesh taper = moved_above(standing_box({12, 4, 10}, {}), 1.0, [&](const Vec3& p) {
        return Vec3{p.x, p.y * t / 4.0, p.z};
      });
      add(with_size("taper", t), std::move(taper));
    }
  }

  void add_pins() {
    for (const double d : {0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5}) {
      add(with_size("pin", d), frustum(0.5 * d, 0.5 * d, 8.0, {}));
    }
    for (const double d : {0.1, 0.4, 0.8}) {
      add(with_size("needle", d), frustum(3.0, 0.5 * d, 10.0, {}));
    }
  }

  void add_gaps() {
    for (const double g : {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6}) {
      TriangleMesh two = standing_box({6, 6, 6}, {-3.0 - 0.5 * g, 0, 0});
      append(two, standing_box({6, 6, 6}, {3.0 + 0.5 * g, 0, 0}));
      add(with_size("gap", g), std::move(two));
    }
  }

  void add_floors() {
    for (const double t : {0.05, 0.1, 0.15, 0.2, 0.3, 0.4}) {
      add(with_size("bridge", t), table_top(t));
    }
    for (const double t : {0.2, 0.4, 0.6, 0.8, 1.2}) add(with_size("tube", t), pipe(6.0, t, 6.0));
  }

  void add_sound() {
    add("sound_box", standing_box({10, 8, 6}, {}));
    add("sound_ball", test::ball_mesh(6.0, 4, {0, 0, 6}));
    add("sound_ring", test::torus_mesh(7.0, 2.5, 64, 32));
    add("sound_cone", frustum(6.0, 2.0, 9.0, {}));
    for (const Solid& solid : sound_solids(12'000, [](const std::string&) {})) {
      if (solid.name != "lettere" && solid.name != "lettero" && solid.name != "pipe" &&
          solid.name != "fandisk" && solid.name != "pebble") {
        continue;
      }
      const Vec3 center = bounds(solid.mesh).center();
      // The wedge of the fandisk is thin.
      add((solid.name == "fandisk" ? "wedge_" : "sound_") + solid.name,
          placed(solid.mesh, {}, 20.0 / largest_side(solid.mesh), -1.0 * center));
    }
  }

  std::vector<PrintPiece> all() && { return std::move(pieces_); }

 private:
  std::vector<PrintPiece> pieces_;
};

}  // namespace

std::vector<PrintPiece> print_pieces() {
  Pieces pieces;
  pieces.add_walls();
  pieces.add_pins();
  pieces.add_gaps();
  pieces.add_floors();
  pieces.add_sound();
  return std::move(pieces).all();
}

}  // namespace argil::arena
