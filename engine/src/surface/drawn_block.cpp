// SPDX-License-Identifier: GPL-3.0-or-later
// A block is compared with what was drawn before bit by bit, so that a renderer is told only of
// blocks that look different.
#include "surface/drawn_block.h"

#include <cassert>
#include <cstring>

namespace argil {
namespace {

std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// What a coordinate becomes in a vertex. Not inlined: GCC 12 drops the rounding when it joins the
/// conversions of several coordinates (DisplaySurface.KeepsEveryVertexWithinTheBoundsOfItsBlock).
[[gnu::noinline]] double as_drawn(double coordinate_mm) {
  return static_cast<double>(static_cast<float>(coordinate_mm));
}
Vec3 as_drawn(const Vec3& p) { return {as_drawn(p.x), as_drawn(p.y), as_drawn(p.z)}; }

/// Writes item i of `count` as make(i). Says whether that changed any bit. What is far too large is
/// given back.
template <class T, class Make>
bool rewrite(std::vector<T>& items, std::size_t count, const Make& make) {
  bool differs = items.size() != count;
  if (differs && items.capacity() > 2 * count) items = std::vector<T>();
  items.reserve(count);
  items.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const T item = make(i);
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bits count, also those of zeros
    differs = differs || std::memcmp(&item, &items[i], sizeof item) != 0;
    items[i] = item;
  }
  return differs;
}

}  // namespace

bool DrawnBlock::assign(const SurfaceBlock& from) {
  assert(from.mesh.positions.size() == from.mesh.normals.size());
  trace = from.trace;
  const ContourMesh& mesh = from.mesh;
  const bool moved = rewrite(vertices, mesh.positions.size(), [&](std::size_t i) {
    return DisplayVertex{as_floats(mesh.positions[i]), as_floats(mesh.normals[i])};
  });
  const bool rewired =
      rewrite(triangles, mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i]; });
  return moved || rewired;
}

DisplayBlock DrawnBlock::shown_as(const BlockId& id, double voxel_mm) const {
  assert(id.level >= 0 && id.level < 63 && voxel_mm > 0.0);
  DisplayBlock block{vertices, triangles, {}};
  const double voxel = voxel_mm * static_cast<double>(std::int64_t{1} << id.level);
  constexpr double kAround = CutJob::kMostStep;
  for (const double step : {-kAround, kLeafSide + kAround}) {
    // Rounded as vertices are, so that none is outside by the rounding.
    block.bounds_mm.include(as_drawn({voxel * (id.origin[0] + step), voxel * (id.origin[1] + step),
                                      voxel * (id.origin[2] + step)}));
  }
  return block;
}

}  // namespace argil
