// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh must be to be imported, and what importing it takes. Coordinates are moved to the
// mesh's middle, since the ray tree works in floats, which are finest there.
#include "import/import_input.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
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

std::uint64_t hash_of_place(const Vec3& p) noexcept {
  std::uint64_t hash = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<std::uint64_t>(p[axis] + 0.0);  // -0 is 0
    hash *= 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

/// Positions of equal value get one index, the lowest; so that an edge is one edge. A table of
/// open addresses: sorting a million places takes five times as long.
std::vector<std::uint32_t> welded_indices(const std::vector<Vec3>& positions) {
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
  std::vector<std::uint32_t> slots(mask + 1, kFree);
  std::vector<std::uint32_t> welded(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    welded[i] = i;
    if (!is_finite(positions[i])) continue;  // of no triangle
    std::uint64_t slot = hash_of_place(positions[i]) & mask;
    while (slots[slot] != kFree && positions[slots[slot]] != positions[i]) {
      slot = (slot + 1) & mask;
    }
    if (slots[slot] == kFree) slots[slot] = i;
    welded[i] = slots[slot];
  }
  return welded;
}

/// Whether the soup is closed: each edge is run along as often one way as the other. Edges are
/// counted into lists, one for each lower vertex.
bool every_edge_cancels(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const auto for_each_edge = [&](const auto& visit) {
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = t[i];
        const std::uint32_t to = t[(i + 1) % 3];
        if (from != to) visit(std::min(from, to), std::max(from, to), from < to);
      }
    }
  };
  std::vector<std::uint64_t> first(vertices + 1, 0);
  for_each_edge([&](std::uint32_t low, std::uint32_t, bool) { ++first[low + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  struct Run {
    std::uint32_t high;
    std::int32_t way;
  };
  std::vector<Run> runs(first.back());
  std::vector<std::uint64_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](std::uint32_t low, std::uint32_t high, bool is_upward) {
    runs[next[low]++] = {high, is_upward ? 1 : -1};
  });
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto begin = runs.begin() + static_cast<std::ptrdiff_t>(first[v]);
    const auto end = runs.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
    std::sort(begin, end, [](const Run& a, const Run& b) { return a.high < b.high; });
    for (auto run = begin; run != end;) {
      std::int64_t sum = 0;
      for (const std::uint32_t high = run->high; run != end && run->high == high; ++run) {
        sum += run->way;
      }
      if (sum != 0) return false;
    }
  }
  return true;
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
constexpr double kBytesPerTriangle = 450.0;   // lists and, where asked, a tree of the input
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
  input.closed = every_edge_cancels(input.triangles, input.positions.size());
  const auto flat = std::stable_partition(input.triangles.begin(), input.triangles.end(),
                                          [&](const Triangle& t) { return has_area(input, t); });
  input.flat.assign(flat, input.triangles.end());
  input.triangles.erase(flat, input.triangles.end());
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
  const auto gb = [](std::uint64_t bytes) { return number(1e-9 * static_cast<double>(bytes)); };
  double fits = input.voxel_mm;
  while (estimated_bytes(input, fits) > limit && fits < 1e6 * input.voxel_mm) fits *= 1.02;
  if (const std::uint64_t least = estimated_bytes(input, fits); least > limit) {
    return Error{ErrorKind::memory,
                 "a mesh of " + std::to_string(input.triangles.size()) + " triangles needs about " +
                     gb(least) + " GB whatever its voxels, and " + gb(limit) +
                     " GB are free; import one of fewer triangles, or allow more memory"};
  }
  const double step = std::pow(10.0, std::floor(std::log10(fits)) - 1.0);
  fits = std::ceil(fits / step) * step;  // two digits, rounded to what certainly fits
  return Error{ErrorKind::memory, "voxels of " + number(input.voxel_mm) + " mm need about " +
                                      gb(need) + " GB for this mesh and " + gb(limit) +
                                      " GB are free; choose voxels of " + number(fits) +
                                      " mm or larger"};
}

}  // namespace argil
