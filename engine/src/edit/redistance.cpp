// SPDX-License-Identifier: GPL-3.0-or-later
// The changed leaves are grouped into chunks of 6^3 leaves. Each chunk is copied with a margin of
// twice the reach into a dense block, solved there by fast marching and written back to its own
// leaves only. All chunks read the state before, so neither their order nor threads can show.
//
// Seeds are the nodes next to the surface. Where the field is smooth a seed is its value over its
// gradient, else the distance to the plane through the cuts of its lattice edges.
#include "edit/redistance.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "field/fast_march.h"
#include "field/leaf_change.h"
#include "field/mask.h"
#include "field/parallel.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

/// No seed is nearer to the surface than this fraction of a voxel, so that its sign is safe.
constexpr float kLeastSeed = 1e-4F;

/// A dense copy of part of a level on which `redistance` works.
struct Work {
  CoordBBox box;
  MarchBlock block;
  std::vector<std::uint8_t> changed;     ///< differs from before the edit, or is of a marked leaf
  std::vector<std::uint8_t> dirty;       ///< within reach of those: may be solved
  std::vector<std::uint8_t> restricted;  ///< set by the finer level: a seed as it stands

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(block.n[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(block.n[2]) +
           static_cast<std::size_t>(k);
  }
};

/// Calls visit(leaf, offset in leaf, index in block) for every node of the box that is of the edit.
template <class Edit, class Visit>
void for_each_edited_node(Edit& edit, const Work& work, Visit&& visit) {
  for_each_leaf_origin(work.box, [&](const Coord& origin) {
    auto* leaf = edit.find(origin);
    if (leaf == nullptr) return;
    const Coord lo = Coord::maxComponent(origin, work.box.min());
    const Coord hi = Coord::minComponent(origin.offsetBy(kLeafSide - 1), work.box.max());
    for (int x = lo.x(); x <= hi.x(); ++x) {
      for (int y = lo.y(); y <= hi.y(); ++y) {
        const Coord at = Coord(x, y, lo.z()) - work.box.min();
        std::size_t n = work.index(at.x(), at.y(), at.z());
        auto offset = static_cast<std::size_t>(leaf_offset(Coord(x, y, lo.z())));
        for (int z = lo.z(); z <= hi.z(); ++z) visit(*leaf, offset++, n++);
      }
    }
  });
}

/// Spreads non-zero bytes `reach` nodes along one axis.
void dilate_axis(std::vector<std::uint8_t>& mask, const std::array<int, 3>& n, std::size_t axis,
                 int reach) {
  assert(mask.size() == static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                            static_cast<std::size_t>(n[2]));
  std::array<std::size_t, 3> stride{static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]),
                                    static_cast<std::size_t>(n[2]), 1};
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const int count = n[axis];
  std::vector<std::uint8_t> line(static_cast<std::size_t>(count));
  for (int a = 0; a < n[u]; ++a) {
    for (int b = 0; b < n[v]; ++b) {
      const std::size_t start =
          static_cast<std::size_t>(a) * stride[u] + static_cast<std::size_t>(b) * stride[v];
      int last = -1 - 2 * reach;  // position of the last mark seen
      for (int i = 0; i < count; ++i) {
        if (mask[start + static_cast<std::size_t>(i) * stride[axis]] != 0) last = i;
        line[static_cast<std::size_t>(i)] = i - last <= reach;
      }
      last = count + 2 * reach;
      for (int i = count - 1; i >= 0; --i) {
        std::uint8_t& here = mask[start + static_cast<std::size_t>(i) * stride[axis]];
        if (here != 0) last = i;
        here = line[static_cast<std::size_t>(i)] != 0 || last - i <= reach;
      }
    }
  }
}

/// The changed nodes of a leaf, or all of a marked one.
CoordBBox changed_box(const LeafEdit& leaf) {
  if (leaf.marked) return {leaf.origin, leaf.origin.offsetBy(kLeafSide - 1)};
  CoordBBox box;
  for (int row = 0; row < kLeafNodes / kLeafSide; ++row) {
    const unsigned bits = leaf.changed_nodes[static_cast<std::size_t>(row)];
    if (bits == 0) continue;
    const Coord first = leaf.origin.offsetBy(row / kLeafSide, row % kLeafSide, 0);
    box.expand(first.offsetBy(0, 0, std::countr_zero(bits)));
    box.expand(first.offsetBy(0, 0, std::bit_width(bits) - 1));
  }
  return box;
}

/// What solving the chunk takes: the nodes that may be solved, as far as they are within reach
/// of it, and two more for the differences across.
CoordBBox work_box(const LevelEdit& edit, const CoordBBox& chunk) {
  CoordBBox around = chunk;
  around.expand(2 * kReach);
  CoordBBox changed;
  for_each_leaf_origin(around, [&](const Coord& origin) {
    const LeafEdit* leaf = edit.find(origin);
    if (leaf != nullptr && (leaf->changed || leaf->marked)) changed.expand(changed_box(*leaf));
  });
  changed.expand(kReach + 2);
  changed.intersect(around);
  return changed;
}

/// What of the box is changed, and so dirty.
Work gather_work(const LevelEdit& edit, const CoordBBox& box) {
  Work work;
  work.box = box;
  const Coord dim = work.box.dim();
  work.block.n = {dim.x(), dim.y(), dim.z()};
  work.block.voxel = static_cast<float>(edit.voxel_mm());
  edit.gather_now(work.box, work.block.value);
  work.changed.assign(work.block.value.size(), 0);
  work.restricted.assign(work.block.value.size(), 0);
  for_each_edited_node(edit, work, [&](const LeafEdit& leaf, std::size_t offset, std::size_t n) {
    work.restricted[n] = leaf.restricted[offset];
    work.changed[n] = leaf.marked || leaf.now()[offset] != leaf.before()[offset];
  });
  work.dirty = work.changed;
  return work;
}

bool inside(float value) { return value < 0.0F; }

/// Whether an edge of the node has an end that changed: else it is cut where it was.
bool is_cut_anew(const Work& work, std::size_t n, int i, int j, int k) {
  if (work.changed[n] != 0) return true;
  const std::array<int, 3> position{i, j, k};
  const std::array<std::size_t, 3> stride{
      static_cast<std::size_t>(work.block.n[1]) * static_cast<std::size_t>(work.block.n[2]),
      static_cast<std::size_t>(work.block.n[2]), 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (position[axis] > 0 && work.changed[n - stride[axis]] != 0) return true;
    if (position[axis] + 1 < work.block.n[axis] && work.changed[n + stride[axis]] != 0) return true;
  }
  return false;
}

/// The distance of node `n` of the block to the surface, from the cuts on the lattice edges to its
/// six neighbours; signed like the node. Zero when no neighbour has the other sign.
float cut_distance(const MarchBlock& block, std::size_t n, int i, int j, int k) {
  assert(i >= 0 && i < block.n[0] && j >= 0 && j < block.n[1] && k >= 0 && k < block.n[2]);
  const float here = block.value[n];
  const std::array<int, 3> position{i, j, k};
  const std::array<std::size_t, 3> stride{
      static_cast<std::size_t>(block.n[1]) * static_cast<std::size_t>(block.n[2]),
      static_cast<std::size_t>(block.n[2]), 1};
  float inverse_square = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float nearest = 2.0F;  // in voxels; 2 stands for none
    const auto look = [&](float there) {
      if (inside(here) == inside(there)) return;
      const float span = std::abs(here) + std::abs(there);
      const float cut = span > 0.0F ? std::abs(here) / span : 0.0F;
      nearest = std::min(nearest, std::max(cut, kLeastSeed));
    };
    if (position[axis] > 0) look(block.value[n - stride[axis]]);
    if (position[axis] + 1 < block.n[axis]) look(block.value[n + stride[axis]]);
    if (nearest < 2.0F) inverse_square += 1.0F / (nearest * nearest);
  }
  if (inverse_square == 0.0F) return 0.0F;
  const float distance = block.voxel / std::sqrt(inverse_square);
  return inside(here) ? -distance : distance;
}

/// The distance of a node of a block from its own value and gradient, where the field around it is
/// smooth: off by the change of the gradient along one voxel, and not by how the lattice lies to
/// the surface as cut_distance() is, which leaves ripples of h^2 / 2R. Zero where it is not smooth.
float smooth_distance(const Work& work, std::size_t n, int i, int j, int k) {
  constexpr float kMostBend = 0.25F;  // of the gradient along a voxel: a ball of four voxels
  const MarchBlock& block = work.block;
  const float here = block.value[n];
  const std::array<int, 3> position{i, j, k};
  const std::array<std::size_t, 3> stride{work.index(1, 0, 0), work.index(0, 1, 0), 1};
  float rise_square = 0.0F;
  float bend = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (position[axis] == 0 || position[axis] + 1 == block.n[axis]) return 0.0F;
    const float low = block.value[n - stride[axis]];
    const float high = block.value[n + stride[axis]];
    const float rise = 0.5F * (high - low);
    rise_square += rise * rise;
    bend = std::max(bend, std::abs(low + high - 2.0F * here));
  }
  const float rise = std::sqrt(rise_square);
  if (!(rise > 0.0F) || bend > kMostBend * rise) return 0.0F;
  const float distance = std::max(std::abs(here) / rise, kLeastSeed) * block.voxel;
  return inside(here) ? -distance : distance;
}

/// What becomes of a dirty node: kept as a seed, normalised as a seed, or solved.
void choose_state(const Work& work, std::size_t n, int i, int j, int k, Seeds seeds, float& value,
                  std::uint8_t& state) {
  state = MarchBlock::kFixed;
  if (work.dirty[n] == 0 || work.restricted[n] != 0) return;
  const float cut = cut_distance(work.block, n, i, j, k);
  if (cut == 0.0F) {
    state = MarchBlock::kUnknown;
  } else if ((seeds == Seeds::normalise && is_cut_anew(work, n, i, j, k)) ||
             std::abs(value) > 2.0F * std::abs(cut) || std::abs(cut) > 2.0F * std::abs(value)) {
    const float smooth = smooth_distance(work, n, i, j, k);
    value = smooth != 0.0F ? smooth : cut;
  }
}

/// States and seeds of all nodes from the values as they are, then one march.
void solve(Work& work, Seeds seeds, float band) {
  assert(work.dirty.size() == work.block.value.size());
  assert(work.restricted.size() == work.block.value.size());
  MarchBlock& block = work.block;
  std::vector<float> value = block.value;  // cuts are taken from the values as they were
  block.state.assign(value.size(), MarchBlock::kFixed);
  std::size_t n = 0;
  for (int i = 0; i < block.n[0]; ++i) {
    for (int j = 0; j < block.n[1]; ++j) {
      for (int k = 0; k < block.n[2]; ++k, ++n) {
        choose_state(work, n, i, j, k, seeds, value[n], block.state[n]);
      }
    }
  }
  block.value = std::move(value);
  fast_march(block, band);
}

/// Keeps the solved values of the chunk's own nodes aside, so that other chunks still read the
/// state before. Chunks end at leaf borders: no two of them meet in a leaf.
void keep_solved(LevelEdit& edit, const CoordBBox& chunk, const Work& work) {
  for_each_edited_node(edit, work, [&](LeafEdit& leaf, std::size_t offset, std::size_t n) {
    if (work.dirty[n] == 0 || !chunk.isInside(leaf.origin)) return;
    assert(chunk.isInside(leaf.origin.offsetBy(kLeafSide - 1)));
    if (!leaf.solved) {
      leaf.solved = std::make_unique_for_overwrite<LeafValues>();
      std::copy_n(leaf.now(), kLeafNodes, leaf.solved->begin());
    }
    (*leaf.solved)[offset] = work.block.value[n];
  });
}

/// Only now are the solved values the leaves' own.
void take_solved(LevelEdit& edit) {
  for (LeafEdit& leaf : edit.leaves()) {
    if (!leaf.solved) continue;
    leaf.write_all(*leaf.solved);
    leaf.solved.reset();
  }
  edit.mark_changes();
}

/// Leaf-aligned boxes of at most kChunkSide nodes that cover every leaf that redistancing can
/// reach.
std::vector<CoordBBox> edited_chunks(const LevelEdit& edit) {
  constexpr int kEditedChunkLeaves = 6;
  const auto floor_to_chunk = [](int leaf) {
    return (leaf >= 0 ? leaf / kEditedChunkLeaves
                      : -((-leaf + kEditedChunkLeaves - 1) / kEditedChunkLeaves));
  };
  std::map<Coord, CoordBBox> chunks;
  for (const LeafEdit& leaf : edit.leaves()) {
    if (!leaf.changed && !leaf.marked) continue;
    CoordBBox reached(leaf.origin, leaf.origin.offsetBy(kLeafSide - 1));
    reached.expand(kReach);
    for_each_leaf_origin(reached, [&](const Coord& origin) {
      if (edit.find(origin) == nullptr) return;
      const Coord index = origin >> 3;
      const Coord key(floor_to_chunk(index.x()), floor_to_chunk(index.y()),
                      floor_to_chunk(index.z()));
      chunks[key].expand(CoordBBox(origin, origin.offsetBy(kLeafSide - 1)));
    });
  }
  std::vector<CoordBBox> boxes;
  boxes.reserve(chunks.size());
  for (const auto& [key, box] : chunks) boxes.push_back(box);
  return boxes;
}

/// Whether a node is masked whole: it must not move.
bool is_masked(const LevelEdit& edit, const Coord& node) {
  const Mask* mask = edit.stack().mask();
  return mask != nullptr && mask->at(node_mm(node, edit.voxel_mm())) >= 1.0;
}

}  // namespace

void redistance(LevelEdit& edit, Seeds seeds) {
  edit.mark_changes();
  const std::vector<CoordBBox> chunks = edited_chunks(edit);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const CoordBBox box = work_box(edit, chunks[c]);
    if (box.empty()) return;
    Work work = gather_work(edit, box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      dilate_axis(work.dirty, work.block.n, axis, kReach);
    }
    solve(work, seeds, edit.band_mm());
    keep_solved(edit, chunks[c], work);
  });
  take_solved(edit);
}

void redistance_marked(LevelEdit& edit) {
  constexpr int kHalo = 2;  // of differences across
  std::vector<LeafEdit>& leaves = edit.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    if (!leaves[n].marked) return;
    const CoordBBox own(leaves[n].origin, leaves[n].origin.offsetBy(kLeafSide - 1));
    CoordBBox box = own;
    box.expand(kHalo);
    Work work = gather_work(edit, box);
    std::size_t at = 0;
    for (auto node = box.begin(); node; ++node, ++at) {
      if (!own.isInside(*node) || is_masked(edit, *node)) work.dirty[at] = 0;
    }
    solve(work, Seeds::normalise, edit.band_mm());
    keep_solved(edit, own, work);
  });
  take_solved(edit);
}

CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm) {
  assert(is_finite(bounds_mm.min) && is_finite(bounds_mm.max));  // else they have no nodes
  const Vec3 lo = bounds_mm.min / voxel_mm;
  const Vec3 hi = bounds_mm.max / voxel_mm;
  CoordBBox box(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  box.expand(kReach + 1);
  return box;
}

}  // namespace argil
