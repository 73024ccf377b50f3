// SPDX-License-Identifier: GPL-3.0-or-later
// The finest level in waves: the leaves near triangles first, then around walls inside overlapping
// parts, then along the membrane that closes gaps, until no wave adds a leaf.
#include "import/import_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

namespace argil {
namespace {

constexpr std::size_t kLeavesPerReport = 2048;

Error interrupted() { return {ErrorKind::interrupted, "the import was interrupted"}; }

/// Samples the leaves, telling `progress` from this thread in between.
Result<std::vector<ImportLeaf>> sample_all(const ImportSampler& sampler,
                                           const std::vector<Coord>& origins, AskWalls ask,
                                           std::string_view stage, const Progress& progress) {
  assert(are_sorted_origins(origins));
  std::vector<ImportLeaf> leaves(origins.size());
  for (std::size_t begin = 0; begin < origins.size(); begin += kLeavesPerReport) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (progress && !progress(stage, done)) return interrupted();
    const std::size_t end = std::min(origins.size(), begin + kLeavesPerReport);
    tbb::parallel_for(begin, end,
                      [&](std::size_t i) { leaves[i] = sample_leaf(sampler, origins[i], ask); });
  }
  return leaves;
}

Result<void> add_leaves(const ImportSampler& sampler, const std::vector<Coord>& origins,
                        AskWalls ask, std::string_view stage, const Progress& progress,
                        ImportField& field) {
  auto leaves = sample_all(sampler, origins, ask, stage, progress);
  if (!leaves) return leaves.error();
  field.merge(origins, std::move(leaves).value());
  return {};
}

/// Follows the membrane from the open edges, wave by wave, until the field holds all of it.
Result<void> follow_membrane(const ImportSampler& sampler, const Progress& progress,
                             std::uint64_t limit_bytes, ImportField& field) {
  while (true) {
    const std::vector<Coord> beside = leaves_beside_membrane(sampler, field);
    if (beside.empty()) return {};
    if ((field.origins.size() + beside.size()) * kBytesPerLeaf > limit_bytes) {
      return Error{ErrorKind::memory,
                   "closing the gaps of the mesh takes more memory than is free (" +
                       std::to_string(limit_bytes / 1000000) +
                       " MB); close its holes first, or choose larger voxels"};
    }
    if (auto ok = add_leaves(sampler, beside, AskWalls::suspicious, "gaps", progress, field); !ok) {
      return ok;
    }
  }
}

bool has_wall(const ImportLeaf& leaf) { return leaf.wall; }

/// Asks every node of the leaves around a wall, and on from those where one was found.
Result<void> follow_walls(const ImportSampler& sampler, const Progress& progress,
                          ImportField& field) {
  std::vector<Coord> asked;
  std::vector<Coord> met;
  for (std::size_t i = 0; i < field.origins.size(); ++i) {
    if (has_wall(field.leaves[i])) met.push_back(field.origins[i]);
  }
  while (!met.empty()) {
    std::vector<Coord> ask = widened(met);
    std::erase_if(ask, [&](const Coord& origin) {
      return field.find(origin) < 0 || std::binary_search(asked.begin(), asked.end(), origin);
    });
    auto leaves = sample_all(sampler, ask, AskWalls::all, "overlaps", progress);
    if (!leaves) return leaves.error();
    met.clear();
    for (std::size_t i = 0; i < ask.size(); ++i) {
      if (has_wall(leaves.value()[i])) met.push_back(ask[i]);
    }
    std::vector<Coord> both;
    std::set_union(asked.begin(), asked.end(), ask.begin(), ask.end(), std::back_inserter(both));
    asked = std::move(both);
    field.merge(ask, std::move(leaves).value());
  }
  return {};
}

/// Leaves without a node in the band say nothing that a tile does not say.
VdbGrid::Ptr grid_of(const ImportSampler& sampler, ImportField& field) {
  assert(field.origins.size() == field.leaves.size());
  const float band = static_cast<float>(sampler.band());
  tbb::parallel_for(std::size_t{0}, field.leaves.size(), [&](std::size_t i) {
    VdbLeaf& leaf = *field.leaves[i].leaf;
    const float* values = leaf.buffer().data();
    for (int n = 0; n < kLeafNodes; ++n) {
      if (std::abs(values[n]) < band) leaf.setValueOn(static_cast<openvdb::Index>(n));
    }
  });
  auto grid = VdbGrid::create(band);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(sampler.voxel()));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface_0");
  for (ImportLeaf& made : field.leaves) {
    if (!made.leaf->isEmpty()) grid->tree().addLeaf(made.leaf.release());
    made.leaf.reset();
  }
  // Tiles only: the leaves tell their sides themselves.
  openvdb::tools::signedFloodFill(grid->tree(), true, 1, 1);
  return grid;
}

/// Else there is no solid.
bool any_inside(const ImportField& field) {
  return std::any_of(field.leaves.begin(), field.leaves.end(), [](const ImportLeaf& leaf) {
    const float* values = leaf.leaf->buffer().data();
    return std::any_of(values, values + kLeafNodes, [](float value) { return value < 0.0F; });
  });
}

Error no_volume(double voxel_mm) {
  std::string size = std::to_string(voxel_mm);
  size.erase(size.find_last_not_of('0') + 1);
  return {
      ErrorKind::bad_input,
      "the mesh encloses no volume that voxels of " + size +
          " mm can hold (flat, too thin, or its triangles face inward); import a solid, turn its "
          "triangles outward or choose smaller voxels"};
}

}  // namespace

Result<FinestLevel> build_finest_level(const ImportInput& input, const Progress& progress,
                                       std::uint64_t limit_bytes) {
  openvdb::initialize();
  if (progress && !progress("trees", 0.0)) return interrupted();
  const ImportSampler sampler(input);
  FinestLevel out;
  ImportField field;
  const std::vector<Coord> origins = leaves_near_triangles(sampler);
  if (auto ok = add_leaves(sampler, origins, AskWalls::suspicious, "distance", progress, field);
      !ok) {
    return ok.error();
  }
  out.walls = std::any_of(field.leaves.begin(), field.leaves.end(), has_wall);
  if (auto ok = follow_walls(sampler, progress, field); !ok) return ok.error();
  if (!input.closed) {
    if (auto ok = follow_membrane(sampler, progress, limit_bytes, field); !ok) return ok.error();
  }
  if (!any_inside(field)) return no_volume(input.voxel_mm);
  if (!input.closed || out.walls) {
    if (progress && !progress("redistance", 0.0)) return interrupted();
    solve_doubtful(sampler, field);
  }
  for (const ImportLeaf& leaf : field.leaves) out.bridged_nodes += leaf.bridged;
  out.grid = grid_of(sampler, field);
  return out;
}

}  // namespace argil
