// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/measure_error.h"

#include <cassert>

#include "argil/core/no_throw.h"

#include "compare/field_error.h"
#include "compare/field_to_mesh.h"
#include "compare/mesh_to_field.h"

namespace argil::io {

mesh::MeshError field_error(const TriangleMesh& mesh, ExtractedSurface& surface, const Pace& pace) {
  assert(!mesh.triangles.empty() && !surface.mesh().triangles.empty());
  mesh::MeshError error;
  // An extracted surface was not fitted to samples; of a decimated one, other points than those of
  // the fit are measured.
  const int least_splits = mesh.triangles == surface.mesh().triangles ? 2 : 5;
  error.mesh_to_field =
      MeshToField(mesh, surface.clay(), least_splits).measure(pace.part(0.0, 0.4));
  error.field_to_mesh = FieldToMesh(mesh, surface).measure(pace.part(0.4, 1.0));
  return error;
}

Result<mesh::MeshError> measure_error(const TriangleMesh& mesh, const TriangleMesh& surface,
                                      const Clay& clay, const TriangleMesh& left_out,
                                      const Progress& progress) {
  return no_throw("measuring the error", [&]() -> Result<mesh::MeshError> {
    if (mesh.triangles.empty() || surface.triangles.empty()) {
      return Error{ErrorKind::bad_input, "there are no triangles to measure; give a mesh"};
    }
    ExtractedSurface extracted(surface, clay, left_out);
    return field_error(mesh, extracted, Pace(progress, "measure"));
  });
}

}  // namespace argil::io
