// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "argil/core/result.h"

#include "mesh_format/gltf_document.h"
#include "mesh_format/gltf_matrix.h"

namespace argil::io {

/// A node of a scene, and where it is.
struct PlacedNode {
  std::size_t node = 0;
  GltfMatrix placement{};  ///< from the node to what `whole` leads to
};

/// The nodes of the scene that the file shows, or of its first, parents before children. A file
/// without scenes shows all its nodes.
/// Errors  bad_input: a node under two others, or nested more than 64 deep. Throws Json::exception
///         where the JSON is not as it should be.
Result<std::vector<PlacedNode>> placed_nodes(const GltfDocument& document, const GltfMatrix& whole);

/// The matrices by which a skin's joints move vertices as the scene stands in the file: where each
/// joint is, times its inverse bind matrix.
/// Errors  bad_input for a joint that is not in the scene, or too few matrices. Throws as above.
Result<std::vector<GltfMatrix>> joint_matrices(
    GltfDocument& document, std::size_t skin,
    const std::unordered_map<std::size_t, GltfMatrix>& placement_of);

}  // namespace argil::io
