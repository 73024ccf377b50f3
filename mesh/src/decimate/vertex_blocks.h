// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// Vertices that lie together, ascending.
using VertexBlock = std::vector<std::uint32_t>;

/// Cuts `vertices`, numbers of positions, into blocks of at most `most`, by planes across the
/// longest side of what is to be cut, with `fraction` of it before the plane: other fractions put
/// the planes elsewhere.
///
/// Shapes       most >= 1; fraction within (0, 1). No vertices are no blocks.
/// Determinism  same blocks for any number of threads.
std::vector<VertexBlock> vertex_blocks(const std::vector<Vec3>& positions,
                                       std::vector<std::uint32_t> vertices, std::size_t most,
                                       double fraction);

}  // namespace argil::mesh
