// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh must be to be imported, and what importing it takes. Coordinates are moved to the
// mesh's middle, since the ray tree works in floats, which are finest there.
#include "import/import_input.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "field/bad_input.h"
#include "import/machine_memory.h"

namespace argil {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

Result<void> check_triangles(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    return bad_input("the mesh has no triangles; import a mesh with a surface");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.positions.size()) {
        return bad_input("triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                         " of " + std::to_string(mesh.positions.size()) + "; repair the mesh");
      }
      if (!is_finite(mesh.positions[v])) {
        return bad_input("vertex " + std::to_string(v) +
                         " has a coordinate that is no finite number; repair the mesh");
      }
    }
  }
  return {};
}

Box3 used_bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  }
  return box;
}

/// Neither too small for its voxels nor beyond what nodes can address.
Result<void> check_extent(const Box3& box, double voxel) {
  const Vec3 size = box.size();
  const double extent = std::max({size.x, size.y, size.z});
  if (extent < 2.0 * voxel) {
    return bad_input("the mesh is " + number(extent) + " mm across, less than two voxels of " +
                     number(voxel) + " mm; scale it with --size-mm, or choose a smaller voxel");
  }
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  if (reach > kMaxReachMm) {
    return bad_input("the mesh is " + number(extent) + " mm across and reaches " + number(reach) +
                     " mm from the origin, and at most " + number(kMaxReachMm) +
                     " are possible; scale it with --size-mm, or move it");
  }
  const double limit = voxel * (kMaxNode - 64);
  if (reach > limit) {
    return bad_input("the mesh is " + number(extent) + " mm across and reaches " + number(reach) +
                     " mm from the origin, beyond the " + number(limit) + " mm that voxels of " +
                     number(voxel) +
                     " mm can address; scale it with --size-mm, or choose a larger"
                     " voxel");
  }
  return {};
}

/// Positions of equal value get one index, the lowest; so that an edge is one edge.
std::vector<std::uint32_t> welded_indices(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const Vec3& p = positions[i];
    const Vec3& q = positions[j];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z != q.z ? p.z < q.z : i < j;
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> welded(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

/// Whether the soup is closed: each edge is run along as often one way as the other.
bool every_edge_cancels(const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> there;
  std::vector<std::uint64_t> back;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = t[i];
      const std::uint64_t to = t[(i + 1) % 3];
      (from < to ? there : back).push_back(std::min(from, to) << 32 | std::max(from, to));
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back;
}

bool has_area(const ImportInput& input, const Triangle& t) {
  const Vec3& a = input.positions[t[0]];
  const Vec3 twice = cross(input.positions[t[1]] - a, input.positions[t[2]] - a);
  return dot(twice, twice) > 0.0;
}

// Measured on the shared models (docs/import.md): leaves over area, bytes over leaf.
constexpr double kLeavesPerArea = 2.8;        // times area / (8 voxels)^2
constexpr double kCoarserLevels = 4.0 / 3.0;  // areas in voxels fall by 4 per level
constexpr double kSurfaceBytes = 150.0;       // triangles and vertices of the surface per voxel^2
constexpr double kBytesPerTriangle = 450.0;   // the two trees over the input
constexpr double kOpenFraction = 2.0;         // a membrane may be as large as what is given

}  // namespace

Result<ImportInput> prepare_import(const TriangleMesh& mesh_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  if (auto ok = check_triangles(mesh_mm); !ok) return ok.error();
  const Box3 box = used_bounds(mesh_mm);
  if (auto ok = check_extent(box, options.voxel_mm); !ok) return ok.error();
  ImportInput input;
  input.center = box.center();
  input.voxel_mm = options.voxel_mm;
  input.bounds = {box.min - input.center, box.max - input.center};
  const std::vector<std::uint32_t> welded = welded_indices(mesh_mm.positions);
  input.positions.reserve(mesh_mm.positions.size());
  for (const Vec3& p : mesh_mm.positions) {  // what no triangle uses may be anything: put it away
    input.positions.push_back(is_finite(p) ? p - input.center : Vec3{});
  }
  input.triangles.reserve(mesh_mm.triangles.size());
  for (const Triangle& t : mesh_mm.triangles) {
    input.triangles.push_back({welded[t[0]], welded[t[1]], welded[t[2]]});
  }
  // Asked of all triangles: one without area still carries its neighbours' edges.
  input.closed = every_edge_cancels(input.triangles);
  std::erase_if(input.triangles, [&](const Triangle& t) { return !has_area(input, t); });
  if (input.triangles.empty()) {
    return bad_input("no triangle of the mesh has any area; import a mesh with a surface");
  }
  input.area_mm2 = surface_area({input.positions, {}, input.triangles});
  return input;
}

std::uint64_t estimated_bytes(const ImportInput& input, double voxel_mm) {
  assert(voxel_mm > 0.0 && input.area_mm2 >= 0.0);
  const double area = input.area_mm2 / (voxel_mm * voxel_mm) * (input.closed ? 1.0 : kOpenFraction);
  const Vec3 size = input.bounds.size();
  double box_leaves = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box_leaves *= size[axis] / (8.0 * voxel_mm) + 3.0;
  }
  const double leaves = std::min(kLeavesPerArea * area / 64.0, box_leaves);
  return static_cast<std::uint64_t>(std::min(
      1e19, leaves * static_cast<double>(kBytesPerLeaf) * kCoarserLevels + area * kSurfaceBytes +
                static_cast<double>(input.triangles.size()) * kBytesPerTriangle));
}

Result<void> check_memory(const ImportInput& input, std::uint64_t limit_bytes) {
  assert(input.voxel_mm > 0.0);
  const std::uint64_t limit = limit_bytes != 0 ? limit_bytes : available_bytes() / 10 * 9;
  const std::uint64_t need = estimated_bytes(input, input.voxel_mm);
  if (need <= limit) return {};
  double fits = input.voxel_mm;
  while (estimated_bytes(input, fits) > limit && fits < 1e6 * input.voxel_mm) fits *= 1.02;
  const double step = std::pow(10.0, std::floor(std::log10(fits)) - 1.0);
  fits = std::ceil(fits / step) * step;  // two digits, rounded to what certainly fits
  return Error{ErrorKind::memory,
               "voxels of " + number(input.voxel_mm) + " mm need about " +
                   number(static_cast<double>(need) / 1e9) + " GB for this mesh and " +
                   number(static_cast<double>(limit) / 1e9) + " GB are free; choose voxels of " +
                   number(fits) + " mm or larger"};
}

}  // namespace argil
