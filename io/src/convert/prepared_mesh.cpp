// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a mesh for an import: brings it to its size and closes it, or refuses it while it is open.
#include "argil/io/prepared_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include "argil/core/free_name.h"
#include "argil/core/no_throw.h"
#include "argil/engine/import_estimate.h"
#include "argil/engine/sculpture.h"
#include "argil/io/assembly.h"
#include "argil/io/body_parts.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/part_gaps.h"

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

/// The scale that brings a side to the size that is wanted.
/// Errors  bad_input for a size that is a mistake about units.
Result<double> scale_for(const std::filesystem::path& file, double side, double size_mm) {
  assert(size_mm >= 0.0);
  const double scale = size_mm > 0.0 && side > 0.0 ? size_mm / side : 1.0;
  const double scaled = side * scale;
  if (scaled >= kSmallestSideMm && scaled <= kLargestSideMm) return scale;
  return Error{ErrorKind::bad_input,
               file_in_quotes(file) + " is " + number(scaled) + " mm across; must be " +
                   number(kSmallestSideMm) + " to " + number(kLargestSideMm) +
                   " mm: give its largest side with argil import --size-mm, or its "
                   "unit with --unit"};
}

/// Closes `given`, which has its size.
Result<void> close_given(const std::string& name, const MeshPreparation& wanted,
                         PreparedMesh& prepared) {
  assert(is_in_reach(mesh::used_bounds(prepared.given).min) &&
         is_in_reach(mesh::used_bounds(prepared.given).max));
  prepared.given_volume_mm3 = enclosed_volume(prepared.given);
  auto closed = mesh::close_mesh(prepared.given);
  if (!closed) return closed.error();
  const mesh::CloseReport& report = closed.value().report;
  if (!wanted.repairs && report.boundary_edges > 0) {
    return Error{ErrorKind::bad_input, name + " has " + std::to_string(report.boundary_edges) +
                                           " open edges; let --repair auto close it"};
  }
  if (wanted.repairs) {
    prepared.closing = report;
    prepared.mesh = std::move(closed.value().mesh);
  } else {
    prepared.mesh = prepared.given;
  }
  prepared.largest_side_mm = largest_side(prepared.mesh);
  return {};
}

/// About the origin of the file, so that what lay on a plane of symmetry stays on it.
void scale_by(double scale, TriangleMesh& mesh) {
  for (Vec3& p : mesh.positions) p *= scale;
}

/// Names the parts of a file that has several, and numbers their triangles as `joined` does.
void note_parts(const Assembly& assembly, PreparedMesh& prepared) {
  const std::vector<PlacedPart> parts = placed_parts(assembly);
  if (parts.size() < 2) return;
  for (const PlacedPart& part : parts) {
    const auto number = static_cast<std::uint32_t>(prepared.part_names.size());
    const std::size_t triangles = assembly.objects[part.object].mesh.triangles.size();
    prepared.part_of.insert(prepared.part_of.end(), triangles, number);
    prepared.part_names.push_back(part.name);
  }
}

Result<PreparedMesh> prepare(ReadAssembly read, const std::filesystem::path& file,
                             const MeshPreparation& wanted) {
  PreparedMesh prepared;
  prepared.frame = read.frame;
  prepared.notes = std::move(read.notes);
  note_parts(read.assembly, prepared);
  prepared.given = joined(std::move(read.assembly));
  const auto scale = scale_for(file, largest_side(prepared.given), wanted.size_mm);
  if (!scale) return scale.error();
  prepared.scale = scale.value();
  scale_by(prepared.scale, prepared.given);
  if (auto closed = close_given(file_in_quotes(file), wanted, prepared); !closed) {
    return closed.error();
  }
  return prepared;
}

Result<PreparedParts> prepare_parts(ReadAssembly read, const std::filesystem::path& file,
                                    const MeshPreparation& wanted) {
  const Assembly assembly = split_into_bodies(std::move(read.assembly));
  const std::vector<PlacedPart> placed = placed_parts(assembly);
  if (placed.size() > mesh::kMostParts) {
    return Error{ErrorKind::bad_input,
                 file_in_quotes(file) + " has " + std::to_string(placed.size()) +
                     " parts; must be at most " + std::to_string(mesh::kMostParts) +
                     " to keep each in a clay of its own: split it, or import it as one clay"};
  }
  PreparedParts prepared;
  prepared.frame = read.frame;
  prepared.notes = std::move(read.notes);
  Box3 box;
  for (const PlacedPart& part : placed) {
    prepared.names.push_back(part.name);
    PreparedMesh& own = prepared.parts.emplace_back();
    own.given = placed_mesh(assembly.objects[part.object].mesh, part.to_mm);
    for (const Vec3& p : own.given.positions) box.include(p);
  }
  const Vec3 size = box.size();
  const double side = std::max({size.x, size.y, size.z});
  const auto scale = scale_for(file, side, wanted.size_mm);
  if (!scale) return scale.error();
  prepared.largest_side_mm = side * scale.value();
  for (std::size_t p = 0; p < prepared.parts.size(); ++p) {
    PreparedMesh& own = prepared.parts[p];
    const std::string name = "part '" + prepared.names[p] + "'";
    own.scale = scale.value();
    scale_by(own.scale, own.given);
    auto closed = close_given("it", wanted, own);
    if (!closed) return Error{closed.error().kind, name + ": " + closed.error().message};
  }
  return prepared;
}

/// A name that a piece can have and no other has yet.
std::string piece_name(std::string name, std::size_t number, const std::set<std::string>& taken) {
  while (!name.empty() && !validate_look({.name = name})) name.pop_back();
  if (name.empty()) name = "Part " + std::to_string(number);
  return free_name(name, Sculpture::kMostBytesOfAName,
                   [&](const std::string& free) { return taken.contains(free); });
}

}  // namespace

std::vector<std::string> piece_names(const std::vector<std::string>& part_names) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const std::string& part : part_names) {
    names.push_back(piece_name(part, names.size() + 1, taken));
    taken.insert(names.back());
  }
  return names;
}

Result<PreparedMesh> read_prepared_mesh(const std::filesystem::path& file,
                                        const MeshPreparation& wanted) {
  auto read = read_assembly(file, wanted.frame);
  if (!read) return read.error();
  return no_throw(file.string(), [&] { return prepare(std::move(read).value(), file, wanted); });
}

Result<PreparedParts> read_prepared_parts(const std::filesystem::path& file,
                                          const MeshPreparation& wanted) {
  auto read = read_assembly(file, wanted.frame);
  if (!read) return read.error();
  return no_throw(file.string(),
                  [&] { return prepare_parts(std::move(read).value(), file, wanted); });
}

bool is_likely_to_fit(const PreparedMesh& prepared, double voxel_mm) {
  const bool is_repaired = prepared.closing.parts > 0;  // else open ones were refused
  return is_import_likely_to_fit(prepared.mesh, prepared.closing.closed || !is_repaired, voxel_mm);
}

}  // namespace argil::io
