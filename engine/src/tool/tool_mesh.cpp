// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as a tool's shape: its distance on a lattice, read trilinearly, and beyond the lattice
// bounded by the nearest point of it.
#include "argil/engine/tool_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>

#include <tbb/parallel_for.h>

#include "field/trilinear.h"
#include "import/import_field.h"

namespace argil {
namespace {

/// Nodes around the mesh, so that what is near it is exact.
constexpr int kMargin = 8;

Error open_mesh() {
  return {ErrorKind::bad_input,
          "the tool's mesh is open; close its holes first (argil import and export do)"};
}

/// Distances of one row along z. Two nodes lie on one side when no surface fits between them: only
/// where one does, the winding number is asked.
void sample_row(const ImportSampler& sampler, const Vec3& first, double spacing, float* row,
                std::size_t count) {
  assert(is_finite(first) && spacing > 0.0);
  std::uint32_t hint = kNoTriangle;
  double before = 0.0;
  bool inside = false;
  for (std::size_t z = 0; z < count; ++z) {
    const Vec3 at{first.x, first.y, first.z + spacing * static_cast<double>(z)};
    const auto closest =
        sampler.distance().closest(at, std::numeric_limits<double>::infinity(), hint);
    hint = closest.triangle;
    if (z == 0 || before + closest.distance <= spacing * (1.0 + 1e-9)) inside = sampler.inside(at);
    before = closest.distance;
    row[z] = static_cast<float>(inside ? -closest.distance : closest.distance);
  }
}

}  // namespace

Result<std::shared_ptr<const ToolMesh>> ToolMesh::make(const TriangleMesh& mesh) {
  Box3 bounds;
  for (const Vec3& p : mesh.positions) bounds.include(p);
  const Vec3 size = bounds.size();
  const double extent = std::max({size.x, size.y, size.z});
  ClayOptions options;
  options.voxel_mm = extent > 0.0 && std::isfinite(extent) ? extent / kResolution : 1.0;
  try {
    const auto input = prepare_import(mesh, options);
    if (!input) return input.error();
    if (!input.value().closed) return open_mesh();
    std::shared_ptr<ToolMesh> made(new ToolMesh);
    made->mesh_ = {mesh.positions, {}, mesh.triangles};
    made->spacing_ = options.voxel_mm;
    made->half_ = input.value().bounds.size() * 0.5;
    for (std::size_t a = 0; a < 3; ++a) {
      const double cells = std::ceil(made->half_[a] / made->spacing_) + kMargin;
      made->low_[a] = -cells * made->spacing_;
      made->count_[a] = 2 * static_cast<std::size_t>(cells) + 1;
    }
    const auto [nx, ny, nz] = made->count_;
    made->value_.resize(nx * ny * nz);
    ImportSampler sampler(input.value());
    sampler.build_trees();
    tbb::parallel_for(std::size_t{0}, nx * ny, [&](std::size_t row) {
      const Vec3 first =
          made->low_ + Vec3{made->spacing_ * static_cast<double>(row / made->count_[1]),
                            made->spacing_ * static_cast<double>(row % made->count_[1]), 0.0};
      const std::size_t count = made->count_[2];
      sample_row(sampler, first, made->spacing_, &made->value_[row * count], count);
    });
    return std::shared_ptr<const ToolMesh>(std::move(made));
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, "not enough memory for the tool's mesh; use a simpler one"};
  }
}

double ToolMesh::distance(const Vec3& point_mm, const Vec3& radii_mm) const noexcept {
  assert(value_.size() == count_[0] * count_[1] * count_[2]);
  double scale = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    if (half_[a] > 0.0) scale = std::min(scale, radii_mm[a] / half_[a]);
  }
  const Vec3 point = point_mm / scale;
  // Beyond the lattice its nearest point and the distance to that bound the distance.
  std::array<std::size_t, 3> low{};
  Vec3 fraction;
  double beyond = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double last = static_cast<double>(count_[a] - 1);
    const double at = (point[a] - low_[a]) / spacing_;
    const double nearest = std::clamp(at, 0.0, last);
    beyond += (at - nearest) * (at - nearest);
    low[a] = std::min(static_cast<std::size_t>(nearest), count_[a] - 2);
    fraction[a] = nearest - static_cast<double>(low[a]);
  }
  const double sum = trilinear(value_, count_, low, fraction);
  return scale * (sum + spacing_ * std::sqrt(beyond));
}

}  // namespace argil
