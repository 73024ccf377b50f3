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

Result<void> go_on(const Progress& progress, std::string_view stage) {
  if (!progress || progress(stage, 0.0)) return {};
  return Error{ErrorKind::interrupted, "interrupted while checking the clay"};
}

Result<ClayVerdict> checked(const Clay& clay, const Printer& printer, const Progress& progress) {
  if (Result<void> on = go_on(progress, "surface"); !on) return on.error();
  TriangleMesh surface = extract_surface(clay);
  surface.normals.clear();
  ClayVerdict found;
  found.removed_crumbs = drop_crumbs(surface, clay.options().voxel_mm);
  if (surface.triangles.empty()) {
    return Error{ErrorKind::bad_input, "there is no clay to check; add some first"};
  }
  found.mesh = rounded_to_float(std::move(surface));
  const auto walls = [&](const TriangleMesh& mesh) { return field_thickness_mm(mesh, clay); };
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    if (Result<void> on = go_on(progress, "check"); !on) return on.error();
    found.verdict = judge_mesh(found.mesh, printer, 0, walls);
    const bool folded = found.verdict.degenerate + found.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds || collapse_folded(found.mesh) == 0) return found;
  }
}

}  // namespace

Result<ClayVerdict> check_clay(const Clay& clay, const Printer& printer, const Progress& progress) {
  return no_throw("the clay", [&] { return checked(clay, printer, progress); });
}

}  // namespace argil::io
