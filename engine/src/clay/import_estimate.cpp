// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/import_estimate.h"

#include <cassert>

#include "import/import_input.h"
#include "import/machine_memory.h"

namespace argil {

bool is_import_likely_to_fit(const TriangleMesh& mesh_mm, bool is_closed, double voxel_mm) {
  assert(voxel_mm > 0.0);
  ImportInput input;
  input.triangles = mesh_mm.triangles;
  input.area_mm2 = surface_area(mesh_mm);
  for (const Triangle& t : mesh_mm.triangles) {
    for (const std::uint32_t v : t) input.bounds.include(mesh_mm.positions[v]);
  }
  input.closed = is_closed;
  return estimated_bytes(input, voxel_mm) <= available_bytes() / 10 * 9;  // as check_memory
}

}  // namespace argil
