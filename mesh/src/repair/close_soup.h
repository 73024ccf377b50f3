// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/close.h"

namespace argil::mesh {

/// close_mesh, and with `joins_rims` rims of different parts that run beside each other all round
/// are closed by a band from one to the other (loops_beside) instead of a lid on each. Throws
/// std::bad_alloc, and Interrupted where `pace` says so.
Result<ClosedMesh> close_soup(const TriangleMesh& mesh, bool joins_rims, const Pace& pace);

}  // namespace argil::mesh
