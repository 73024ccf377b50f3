// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/clay_check.h"

#include <utility>

#include "argil/engine/surface.h"

#include "field_wall.h"
#include "mesh_crumbs.h"
#include "mesh_judge.h"
#include "mesh_mend.h"
#include "mesh_write.h"
#include "no_throw.h"

namespace argil::io {
namespace {

Result<ClayVerdict> checked(const Clay& clay, const Printer& printer, const Pace& pace) {
  pace.part("surface", 0.0, 0.1).at(0.0);
  TriangleMesh surface = extract_surface(clay);
  surface.normals.clear();
  ClayVerdict found;
  found.removed_crumbs = drop_crumbs(surface, clay.options().voxel_mm).count;
  if (surface.triangles.empty()) {
    return Error{ErrorKind::bad_input, "there is no clay to check; add some first"};
  }
  found.mesh = rounded_to_float(std::move(surface));
  const auto walls = [&](const TriangleMesh& mesh) { return field_thickness_mm(mesh, clay); };
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    found.verdict = judge_mesh(found.mesh, printer, 0, walls, pace.part("check", 0.1, 1.0));
    const bool folded = found.verdict.degenerate + found.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds || collapse_folded(found.mesh) == 0) return found;
  }
}

}  // namespace

Result<ClayVerdict> check_clay(const Clay& clay, const Printer& printer, const Progress& progress) {
  return no_throw("the clay", [&] { return checked(clay, printer, Pace(progress, "check")); });
}

}  // namespace argil::io
