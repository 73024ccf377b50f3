// SPDX-License-Identifier: GPL-3.0-or-later
// OpenVDB's volumeToMesh on the finest level.
#include "rivals/openvdb_mesh.h"

#include <openvdb/tools/VolumeToMesh.h>

#include "clay/clay_access.h"
#include "common/machine.h"
#include "common/output.h"
#include "field/level_stack.h"

namespace argil::evaluation {

OpenvdbMesh openvdb_mesh(const Clay& clay) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  OpenvdbMesh mesh;
  const cli::Stopwatch wall;
  const double before = cli::process_cpu_us();
  openvdb::tools::volumeToMesh(levels_of(clay).grid(0), points, triangles, quads);
  mesh.cpu_us = cli::process_cpu_us() - before;
  mesh.wall_us = 1e6 * wall.seconds();
  // It makes quads, of which a printer gets two triangles each.
  for (const openvdb::Vec3I& t : triangles) mesh.triangles.push_back({t.x(), t.y(), t.z()});
  for (const openvdb::Vec4I& q : quads) {
    mesh.triangles.push_back({q.x(), q.y(), q.z()});
    mesh.triangles.push_back({q.x(), q.z(), q.w()});
  }
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points) {
    mesh.positions.push_back(
        {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())});
  }
  return mesh;
}

}  // namespace argil::evaluation
