// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawn_block.h"

#include <cstring>

namespace argil {
namespace {

std::array<float, 3> rounded(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

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
  trace = from.trace;
  const ContourMesh& mesh = from.mesh;
  const bool moved = rewrite(vertices, mesh.positions.size(), [&](std::size_t i) {
    return DisplayVertex{rounded(mesh.positions[i]), rounded(mesh.normals[i])};
  });
  const bool rewired =
      rewrite(triangles, mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i]; });
  return moved || rewired;
}

DisplayBlock DrawnBlock::shown_as(const BlockId& id, double voxel_mm) const {
  DisplayBlock block{vertices, triangles, {}};
  const double voxel = voxel_mm * static_cast<double>(std::int64_t{1} << id.level);
  // Rounded as vertices are, so that none is outside by the rounding.
  const auto at = [&](int node) { return static_cast<double>(static_cast<float>(node * voxel)); };
  const auto& p = id.place;
  block.bounds_mm.include({at(p[0]), at(p[1]), at(p[2])});
  block.bounds_mm.include({at(p[0] + kLeafSide), at(p[1] + kLeafSide), at(p[2] + kLeafSide)});
  return block;
}

}  // namespace argil
