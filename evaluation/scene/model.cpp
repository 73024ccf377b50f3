// SPDX-License-Identifier: GPL-3.0-or-later
// Models that do not come with the sources: charts that need them say so and go on.
#include "scene/model.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "argil/engine/import.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

namespace argil::evaluation {

namespace fs = std::filesystem;

fs::path model_file(const std::string& name) {
  const char* given =
      std::getenv("ARGIL_SHARED");  // NOLINT(concurrency-mt-unsafe): no thread sets it
  return fs::path(given != nullptr ? given : "") / "models" / name;
}

std::string missing_model(const std::string& piece, const fs::path& file) {
  return piece + ": no '" + file.string() + "'; set ARGIL_SHARED to the folder that holds models/";
}

Result<TriangleMesh> read_model(const fs::path& file, double size_mm) {
  assert(size_mm > 0.0);
  auto mesh = io::read_mesh(file);
  if (!mesh) return mesh.error();
  auto closed = mesh::close_mesh(mesh.value());
  if (!closed) return closed.error();
  TriangleMesh piece = std::move(closed.value().mesh);
  const Box3 extent = bounds(piece);
  const Vec3 size = extent.size();
  const double scale = size_mm / std::max({size.x, size.y, size.z});
  for (Vec3& p : piece.positions) p = scale * (p - extent.center());
  return piece;
}

Result<Clay> import_model(const fs::path& file, double size_mm, double voxel_mm) {
  auto piece = read_model(file, size_mm);
  if (!piece) return piece.error();
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  auto imported = import_mesh(piece.value(), options);
  if (!imported) return imported.error();
  return std::move(imported.value().clay);
}

}  // namespace argil::evaluation
