// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/openvdb_mesh.h"

#include <openvdb/tools/VolumeToMesh.h>

#include "chart/machine.h"
#include "level_stack.h"
#include "output.h"

namespace argil::cli::chart {

OpenvdbMesh openvdb_mesh(const Clay& clay) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  OpenvdbMesh mesh;
  const Stopwatch wall;
  const double before = process_cpu_us();
  openvdb::tools::volumeToMesh(clay.levels().grid(0), points, triangles, quads);
  mesh.cpu_us = process_cpu_us() - before;
  mesh.wall_us = 1e6 * wall.seconds();
  mesh.triangles = static_cast<std::int64_t>(triangles.size() + 2 * quads.size());
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points) {
    mesh.positions.push_back(
        {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())});
  }
  return mesh;
}

}  // namespace argil::cli::chart
