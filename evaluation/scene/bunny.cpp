// SPDX-License-Identifier: GPL-3.0-or-later
// A real mesh: the Stanford bunny among the shared models.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>

#include "argil/engine/surface.h"
#include "argil/engine/window.h"

#include "scene/model.h"
#include "scene/scene.h"

namespace argil::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr double kSizeMm = 80.0;
/// Spacing of the exact distances away from the surface, where the clay itself does not say.
constexpr double kSpacingMm = 2.0 * kVoxelMm;
/// How far outside the tools feel anything: the default skin, and a little.
constexpr double kOutsideMm = 9.0;

/// Trilinear in the window; outside it the tools feel nothing.
double value_in(const FieldWindowView& window, const Vec3& point) {
  const Vec3 at = (point - window.origin_mm) / window.voxel_mm;
  std::array<int, 3> cell{};
  Vec3 fraction;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(at[a] >= 0.0 && at[a] < window.nodes[a] - 1)) return kOutsideMm;
    cell[a] = static_cast<int>(at[a]);
    fraction[a] = at[a] - cell[a];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner >> 2, j = (corner >> 1) & 1, k = corner & 1;
    const double weight = (i == 1 ? fraction.x : 1.0 - fraction.x) *
                          (j == 1 ? fraction.y : 1.0 - fraction.y) *
                          (k == 1 ? fraction.z : 1.0 - fraction.z);
    sum += weight * static_cast<double>(window.at(cell[0] + i, cell[1] + j, cell[2] + k));
  }
  return sum;
}

/// Near the surface the finest voxels themselves, else between exact distances.
double distance_to(const Clay& clay, const FieldWindowView& exact, const Vec3& point) {
  // One voxel inside the band: interpolation at its very edge would mix in clamped values.
  constexpr double kNearMm = (kHalfWidthVoxels - 1) * kVoxelMm;
  const double coarse = value_in(exact, point);
  if (std::abs(coarse) > kNearMm) return coarse;
  const double fine = clay.distance_at(point);
  return std::abs(fine) < kNearMm ? fine : coarse;
}

/// A random point of the clay's surface, each triangle as likely as any.
SurfacePoint on_surface(const TriangleMesh& surface, const Distance& distance, Random& random) {
  assert(!surface.triangles.empty());
  const auto count = static_cast<double>(surface.triangles.size());
  const auto index = static_cast<std::size_t>(random.between(0.0, count));
  const Triangle& t = surface.triangles[std::min(index, surface.triangles.size() - 1)];
  const Vec3 sum = surface.positions[t[0]] + surface.positions[t[1]] + surface.positions[t[2]];
  const Vec3 point = sum / 3.0;
  return {point, direction(distance, point, kVoxelMm)};
}

Result<Scene> make_bunny(const fs::path& file) {
  auto imported = import_model(file, kSizeMm, kVoxelMm);
  if (!imported) return imported.error();
  const auto clay = std::make_shared<Clay>(std::move(imported).value());
  const WindowRequest request{{}, kSpacingMm, 0.5 * kSizeMm + kOutsideMm, kOutsideMm};
  auto read = read_window(*clay, request, Extension::exact);
  if (!read) return read.error();
  const auto exact = std::make_shared<const FieldWindow>(std::move(read).value());
  const auto surface = std::make_shared<const TriangleMesh>(extract_surface(*clay));
  const Distance distance = [clay, exact](const Vec3& p) {
    return distance_to(*clay, exact->view, p);
  };
  return Scene{clay, distance, 0.5 * kVoxelMm,
               [surface, distance](Random& random, double /*radius_mm*/) {
                 return on_surface(*surface, distance, random);
               }};
}

}  // namespace

std::optional<SceneRecipe> bunny_scene(std::string& missing) {
  const fs::path file = model_file("stanford-bunny.obj");
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) {
    return SceneRecipe{"bunny", Group::sharp, false, false,
                       [file](double /*radius_mm*/) { return make_bunny(file); }};
  }
  missing = missing_model("bunny", file);
  return std::nullopt;
}

}  // namespace argil::evaluation
