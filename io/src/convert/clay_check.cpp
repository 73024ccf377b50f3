// SPDX-License-Identifier: GPL-3.0-or-later
// Judges a clay by the mesh that an export would write: without small components, rounded to float,
// folds collapsed. Walls are measured in the field, which is more exact than its mesh.
#include "argil/io/clay_check.h"

#include <cassert>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/engine/surface.h"
#include "argil/mesh/check.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/small_components.h"

#include "convert/field_wall.h"
#include "mesh_format/mesh_write.h"

namespace argil::io {
namespace {

Result<ClayVerdict> checked(const Clay& clay, const mesh::Printer& printer, const Pace& pace) {
  pace.part("surface", 0.0, 0.1).at(0.0);
  TriangleMesh surface = extract_surface(clay);
  surface.normals.clear();
  ClayVerdict found;
  found.removed_components = mesh::drop_small_components(surface, clay.options().voxel_mm).count;
  if (surface.triangles.empty()) {
    return Error{ErrorKind::bad_input, "there is no clay to check; add some first"};
  }
  found.mesh = mesh::rounded_to_float(std::move(surface));
  const auto walls = [&](const TriangleMesh& mesh, double asked_mm, const Pace& part) {
    return field_thickness(mesh, clay, asked_mm, part);
  };
  assert(found.mesh.normals.empty());
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    found.verdict = mesh::judge_mesh(found.mesh, printer, 0, walls, pace.part("check", 0.1, 1.0));
    const bool folded = found.verdict.degenerate + found.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds || mesh::collapse_folded(found.mesh) == 0) return found;
  }
}

}  // namespace

Result<ClayVerdict> check_clay(const Clay& clay, const mesh::Printer& printer,
                               const Progress& progress) {
  return no_throw("the clay", [&] { return checked(clay, printer, Pace(progress, "check")); });
}

}  // namespace argil::io
