// SPDX-License-Identifier: GPL-3.0-or-later
#include "blender/mesh_files.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "blender/child.h"

namespace argil::evaluation {

namespace fs = std::filesystem;

Result<void> write_mesh_files(const fs::path& name, const TriangleMesh& mesh) {
  std::vector<float> positions;
  positions.reserve(3 * mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    for (std::size_t a = 0; a < 3; ++a) positions.push_back(static_cast<float>(p[a]));
  }
  if (auto done = write_values(name.string() + ".positions", positions); !done) return done;
  return write_values(name.string() + ".triangles", mesh.triangles);
}

std::optional<TriangleMesh> read_mesh_files(const fs::path& name) {
  TriangleMesh mesh;
  const auto coordinates = read_values<float>(name.string() + ".positions");
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    mesh.positions.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  }
  mesh.triangles = read_values<Triangle>(name.string() + ".triangles");
  const auto is_there = [&](std::uint32_t corner) { return corner < mesh.positions.size(); };
  const bool is_whole =
      !mesh.triangles.empty() &&
      std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&](const Triangle& t) { return std::all_of(t.begin(), t.end(), is_there); });
  if (!is_whole) return std::nullopt;
  return mesh;
}

}  // namespace argil::evaluation
