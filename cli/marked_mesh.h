// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/check.h"

namespace argil::cli {

// What a verdict found, shown where it is: red where the mesh is broken, magenta around closed
// cavities, orange for thin walls, yellow for overhangs, blue for small components.

/// The color of a mark in linear light, as RenderOptions has it; of none that of clay.
Vec3 mark_color(mesh::Mark mark) noexcept;

/// A picture from the side that shows most of what is marked. Places that would be smaller than a
/// few pixels are marked that large.
/// Errors  as render and io::write_png, which ask `progress`.
Result<void> write_marked_picture(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                                  const mesh::MeshVerdict& verdict, const Progress& progress);

/// The mesh with the color of each vertex: that of the worst triangle around it.
Result<void> write_marked_ply(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                              const mesh::MeshVerdict& verdict);

}  // namespace argil::cli
