// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a mesh for an import: brings it to its size and closes it, or refuses it while it is open.
#include "argil/io/prepared_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "argil/engine/import_estimate.h"
#include "argil/mesh/compact.h"

namespace argil::io {
namespace {

// A piece smaller or larger than these is a mistake about units, not something to hold.
constexpr double kSmallestSideMm = 0.01;
constexpr double kLargestSideMm = 10'000.0;

double largest_side(const TriangleMesh& mesh) {
  const Vec3 size = bounds(mesh).size();
  return std::max({size.x, size.y, size.z});
}

/// About its middle. Its area vectors sum to nothing where it is closed, or all but closed.
std::optional<double> enclosed_volume(const TriangleMesh& mesh) {
  constexpr double kMostOpen = 1e-3;  // of the area
  // Relative to the centre: far from the origin the terms would cancel and lose their digits.
  const Vec3 middle = bounds(mesh).center();
  Vec3 twice_area;
  double size = 0.0;
  double volume = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.positions[i] - middle;
    const Vec3 b = mesh.positions[j] - middle;
    const Vec3 c = mesh.positions[k] - middle;
    const Vec3 twice = cross(b - a, c - a);
    twice_area += twice;
    size += length(twice);
    volume += dot(a, cross(b, c)) / 6.0;
  }
  if (length(twice_area) > kMostOpen * size) return std::nullopt;
  return std::abs(volume);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string file_in_quotes(const std::filesystem::path& file) {
  return std::string(1, '\'').append(file.string()).append("'");
}

/// Scales about the origin of the file, so that what lay on a plane of symmetry stays on it.
Result<void> bring_to_size(const std::filesystem::path& file, double size_mm,
                           PreparedMesh& prepared) {
  assert(size_mm >= 0.0);
  const double side = largest_side(prepared.given);
  if (size_mm > 0.0 && side > 0.0) prepared.scale = size_mm / side;
  for (Vec3& p : prepared.given.positions) p *= prepared.scale;
  const double scaled = side * prepared.scale;
  if (scaled >= kSmallestSideMm && scaled <= kLargestSideMm) return {};
  return Error{ErrorKind::bad_input,
               file_in_quotes(file) + " is " + number(scaled) + " mm across; must be " +
                   number(kSmallestSideMm) + " to " + number(kLargestSideMm) +
                   " mm: give its largest side with argil import --size-mm, or its "
                   "unit with --unit"};
}

}  // namespace

Result<PreparedMesh> read_prepared_mesh(const std::filesystem::path& file,
                                        const MeshPreparation& wanted) {
  auto read = read_framed_mesh(file, wanted.frame);
  if (!read) return read.error();
  PreparedMesh prepared;
  prepared.given = std::move(read.value().mesh);
  prepared.frame = read.value().frame;
  assert(is_in_reach(mesh::used_bounds(prepared.given).min) &&
         is_in_reach(mesh::used_bounds(prepared.given).max));
  if (auto sized = bring_to_size(file, wanted.size_mm, prepared); !sized) return sized.error();
  prepared.given_volume_mm3 = enclosed_volume(prepared.given);
  auto closed = mesh::close_mesh(prepared.given);
  if (!closed) return closed.error();
  const mesh::CloseReport& report = closed.value().report;
  if (!wanted.repairs && report.boundary_edges > 0) {
    return Error{ErrorKind::bad_input, file_in_quotes(file) + " has " +
                                           std::to_string(report.boundary_edges) +
                                           " open edges; let --repair auto close it"};
  }
  if (wanted.repairs) {
    prepared.closing = report;
    prepared.mesh = std::move(closed.value().mesh);
  } else {
    prepared.mesh = prepared.given;
  }
  prepared.largest_side_mm = largest_side(prepared.mesh);
  return prepared;
}

bool is_likely_to_fit(const PreparedMesh& prepared, double voxel_mm) {
  const bool is_repaired = prepared.closing.parts > 0;  // else open ones were refused
  return is_import_likely_to_fit(prepared.mesh, prepared.closing.closed || !is_repaired, voxel_mm);
}

}  // namespace argil::io
