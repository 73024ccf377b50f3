// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/operation.h"

#include "scene/distance.h"

namespace argil::evaluation {

/// What is worked: a closed mesh with about as many vertices as its surface has in finest voxels
/// (kVoxelMm), and the signed distance of that mesh.
struct WorkedBody {
  std::string name;
  double million = 0.0;  ///< vertices that its surface has on a lattice of finest voxels, about
  std::shared_ptr<const TriangleMesh> mesh;
  Distance distance;  ///< exact, but for the sign within 0.02 voxel of the surface
};

/// The distance of points to the triangles of a mesh, 0 or more; callable from several threads, and
/// fastest on points in the order of some mesh, since the last triangle is a good hint.
Distance distance_to(std::shared_ptr<const TriangleMesh> mesh);

/// A ball with waves 24 voxels long and 1.5 high: smooth and bent everywhere, by radii of 16 voxels
/// and more.
WorkedBody wavy_body(double million);

/// A turned block of sides 1.5 : 1.33 : 1: sharp edges, flat in most places.
WorkedBody block_body(double million);

/// Where its copy is put for a union: moved by 0.7 of its radius, the least half of its bounds, and
/// turned askew.
Placement copy_placement(const WorkedBody& body);

/// The placed mesh.
TriangleMesh placed(const TriangleMesh& mesh, const Placement& placement);

/// The distance of the placed body.
Distance placed(Distance distance, const Placement& placement);

}  // namespace argil::evaluation
