// SPDX-License-Identifier: GPL-3.0-or-later
// A block that changes costs a pointer and its leaf's box; the box becomes that of its vertices
// when a ray first meets it, so that only what is looked at is measured.
#include "surface/block_cube.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>

namespace argil {
namespace {

/// No smaller than `value`.
float float_above(double value) noexcept {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) >= value
             ? near
             : std::nextafter(near, std::numeric_limits<float>::infinity());
}

Vec3 normal_of(const DisplayVertex& vertex) noexcept {
  const auto& n = vertex.normal;
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// Whether a triangle counts rather than the hit that there is.
bool comes_before(double along, const BlockId& block, const BlockHit& hit) noexcept {
  return along < hit.along || (along == hit.along && block < hit.block);
}

}  // namespace

bool RayScratch::reserve(std::size_t vertices) noexcept {
  if (vertices <= sides_.size()) return true;
  try {
    x_.resize(vertices);
    y_.resize(vertices);
    sides_.resize(vertices);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

LeafKey BlockCube::key_of(const BlockId& block) noexcept {
  constexpr int kSide = kLeaves * kLeafSide;
  const Coord origin(block.origin[0], block.origin[1], block.origin[2]);
  return {block.level, origin & ~(kSide - 1)};
}

BlockCube::BlockCube(const LeafKey& key, double voxel_mm) : key_(key), slot_of_{} {
  assert(key.level >= 0 && key.level < 63 && voxel_mm > 0.0);
  voxel_mm_ = voxel_mm * static_cast<double>(std::int64_t{1} << key.level);
  widen_mm_ = static_cast<float>(kWidenVoxels * voxel_mm_);
}

CubeBox BlockCube::box() const noexcept {
  CubeBox box;
  for (std::size_t a = 0; a < 3; ++a) {
    const int node = key_.origin[static_cast<int>(a)];
    box.low[a] = static_cast<float>(voxel_mm_ * (node - kAround)) - widen_mm_;
    box.high[a] =
        static_cast<float>(voxel_mm_ * (node + kLeaves * kLeafSide + kAround)) + widen_mm_;
  }
  return box;
}

std::size_t BlockCube::place_of(const BlockId& id) noexcept {
  const auto at = [&](std::size_t axis) {
    return static_cast<std::size_t>(id.origin[axis] / kLeafSide & (kLeaves - 1));
  };
  return at(0) * kLeaves * kLeaves + at(1) * kLeaves + at(2);
}

bool BlockCube::refresh(const BlockId& id) noexcept {
  assert(key_of(id) == key_);
  const std::uint16_t known = slot_of_[place_of(id)];
  if (known == 0) return false;
  loosen(known - std::size_t{1});
  return true;
}

void BlockCube::insert(const BlockId& id, const DrawnBlock& block) {
  std::uint16_t& known = slot_of_[place_of(id)];
  assert(key_of(id) == key_ && known == 0 && !block.triangles.empty());
  if (slots_.size() == boxes_.size() * EightBoxes::kCount) boxes_.emplace_back();
  slots_.push_back({id, &block, true});
  known = static_cast<std::uint16_t>(slots_.size());
  loosen(slots_.size() - 1);
}

/// The box of the leaf and what its vertices may lie beside it: what the block is now is looked at
/// when a ray comes.
void BlockCube::loosen(std::size_t slot) noexcept {
  slots_[slot].is_loose = true;
  std::array<float, 3> low;
  std::array<float, 3> high;
  for (std::size_t a = 0; a < 3; ++a) {
    const int node = slots_[slot].id.origin[a];
    low[a] = static_cast<float>(voxel_mm_ * (node - kAround));
    high[a] = static_cast<float>(voxel_mm_ * (node + kLeafSide + kAround));
  }
  set_box(slot, low, high);
}

bool BlockCube::erase(const BlockId& id) noexcept {
  assert(key_of(id) == key_);
  std::uint16_t& known = slot_of_[place_of(id)];
  if (known == 0) return false;
  const std::size_t slot = known - std::size_t{1};
  const std::size_t last = slots_.size() - 1;
  if (slot != last) {
    slots_[slot] = slots_[last];
    slot_of_[place_of(slots_[slot].id)] = known;
    const EightBoxes& from = boxes_[last / EightBoxes::kCount];
    EightBoxes& to = boxes_[slot / EightBoxes::kCount];
    for (std::size_t a = 0; a < 3; ++a) {
      to.low[a][slot % EightBoxes::kCount] = from.low[a][last % EightBoxes::kCount];
      to.high[a][slot % EightBoxes::kCount] = from.high[a][last % EightBoxes::kCount];
    }
  }
  known = 0;
  slots_.pop_back();
  return true;
}

std::int64_t BlockCube::bytes() const noexcept {
  return static_cast<std::int64_t>(sizeof(BlockCube) + slots_.capacity() * sizeof(Slot) +
                                   boxes_.capacity() * sizeof(EightBoxes));
}

void BlockCube::set_box(std::size_t slot, const std::array<float, 3>& low,
                        const std::array<float, 3>& high) noexcept {
  EightBoxes& eight = boxes_[slot / EightBoxes::kCount];
  for (std::size_t a = 0; a < 3; ++a) {
    eight.low[a][slot % EightBoxes::kCount] = low[a] - widen_mm_;
    eight.high[a][slot % EightBoxes::kCount] = high[a] + widen_mm_;
  }
}

void BlockCube::tighten(std::size_t slot) noexcept {
  const std::vector<DisplayVertex>& vertices = slots_[slot].block->vertices;
  assert(!vertices.empty());
  std::array<float, 3> low = vertices.front().position_mm;
  std::array<float, 3> high = low;
  for (const DisplayVertex& vertex : vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], vertex.position_mm[a]);
      high[a] = std::max(high[a], vertex.position_mm[a]);
    }
  }
  slots_[slot].is_loose = false;
  set_box(slot, low, high);
}

/// Of the boxes entered. Says whether any was loose.
bool BlockCube::tighten(const Entries& entries, int count) noexcept {
  bool any = false;
  for (int i = 0; i < count; ++i) {
    const auto slot = static_cast<std::size_t>(entries[static_cast<std::size_t>(i)].box);
    if (!slots_[slot].is_loose) continue;
    tighten(slot);
    any = true;
  }
  return any;
}

bool BlockCube::meet(const RayJob& ray, RayScratch& scratch, BlockHit& hit) noexcept {
  Entries entries;
  const RowLoops& loops = row_loops();
  const auto enter = [&] {
    return loops.enter_boxes(ray, boxes_.data(), count(), float_above(hit.along), entries.data());
  };
  int entered = enter();
  if (tighten(entries, entered)) entered = enter();
  std::sort(entries.begin(), entries.begin() + entered,
            [](const BoxEntry& a, const BoxEntry& b) { return a.along < b.along; });
  bool is_nearer = false;
  for (int i = 0; i < entered; ++i) {
    const BoxEntry& entry = entries[static_cast<std::size_t>(i)];
    if (static_cast<double>(entry.along) > hit.along) break;
    is_nearer |= meet(slots_[static_cast<std::size_t>(entry.box)], ray, scratch, hit);
  }
  return is_nearer;
}

bool BlockCube::meet(const Slot& slot, const RayJob& ray, RayScratch& scratch,
                     BlockHit& hit) const noexcept {
  static_assert(sizeof(DisplayVertex) == TrianglesJob::kVertexFloats * sizeof(float));
  static_assert(sizeof(Triangle) == 3 * sizeof(unsigned));
  const DrawnBlock& block = *slot.block;
  if (!scratch.reserve(block.vertices.size())) {
    hit.has_failed = true;
    return false;
  }
  const TrianglesJob job{block.vertices.front().position_mm.data(),
                         static_cast<int>(block.vertices.size()),
                         block.triangles.front().data(),
                         static_cast<int>(block.triangles.size()),
                         scratch.x(),
                         scratch.y(),
                         scratch.sides()};
  TriangleHit met{std::numeric_limits<double>::infinity(), {}, -1};
  row_loops().meet_triangles(ray, job, met);
  if (met.triangle < 0 || !comes_before(met.along, slot.id, hit)) return false;
  Vec3 normal;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t vertex = block.triangles[static_cast<std::size_t>(met.triangle)][c];
    normal += met.weight[c] * normal_of(block.vertices[vertex]);
  }
  hit = {met.along, slot.id, met.triangle, normalized(normal), hit.has_failed};
  return true;
}

}  // namespace argil
