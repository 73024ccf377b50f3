// SPDX-License-Identifier: GPL-3.0-or-later
// A clay as one level set of its finest voxel, for other programs: unlike a project it has the
// whole surface at one level.
#include "argil/io/volume_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/storage.h"
#include "argil/io/safe_file.h"

#include "vdb/grid_archive.h"
#include "vdb/vdb_tree.h"

namespace argil::io {
namespace {

using Origins = std::vector<NodeCoord>;
using LeafValues = std::array<float, storage::kLeafNodes>;

constexpr int kHalfWidth = 3;              // OpenVDB's own: what its tools expect of a level set
constexpr std::int64_t kLeafBytes = 2500;  // with what the tree above takes

Vec3 point_mm(const NodeCoord& node, double voxel_mm) noexcept {
  return {voxel_mm * node[0], voxel_mm * node[1], voxel_mm * node[2]};
}

/// Calls `work(sampler, n)` for n below `count` on several threads.
template <class Work>
void for_each_sampled(const Clay& clay, std::size_t count, const Work& work) {
  constexpr std::size_t kGrain = 16;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      FieldSampler sampler(clay);
                      for (std::size_t n = range.begin(); n < range.end(); ++n) work(sampler, n);
                    });
}

class Volume {
 public:
  Volume(const std::filesystem::path& file, const Clay& clay, const Progress& progress)
      : file_(file),
        clay_(clay),
        stored_(clay),
        progress_(progress),
        voxel_mm_(stored_.voxel_mm(0)),
        band_(static_cast<float>(kHalfWidth * voxel_mm_)),
        grid_(VdbGrid::create(band_)) {
    grid_->setTransform(openvdb::math::Transform::createLinearTransform(voxel_mm_));
    grid_->setGridClass(openvdb::GRID_LEVEL_SET);
    grid_->setName("surface");
    grid_->setCreator("Argil");
    grid_->insertMeta("argil_units", openvdb::StringMetadata("mm"));
    grid_->insertMeta("argil_hash", openvdb::StringMetadata(hash_text(clay.hash())));
  }

  Result<VolumeReport> run();

 private:
  Result<void> go_on(double fraction) const {
    if (!progress_ || progress_("field", fraction)) return {};
    return Error{ErrorKind::interrupted,
                 "interrupted while exporting '" + file_.string() + "'; it is as it was before"};
  }
  Result<Origins> finest_leaves() const;
  Origins near_surface(int level, const Origins& origins) const;
  Result<void> fill(const Origins& origins);
  void take_leaf(FieldSampler& sampler, const NodeCoord& origin, LeafValues& out) const;
  void add_leaf(const NodeCoord& origin, const LeafValues& values);

  const std::filesystem::path& file_;
  const Clay& clay_;
  StoredClay stored_;
  const Progress& progress_;
  double voxel_mm_;
  float band_;
  VdbGrid::Ptr grid_;
};

/// Those that have a leaf or may hold a node within the band.
Origins Volume::near_surface(int level, const Origins& origins) const {
  constexpr double kHalfDiagonal = 0.8661;  // of a cube of side 1, rounded up
  constexpr double kSteepest = 2.0;         // what the field may rise by in 1 mm (docs/field.md)
  const double side = storage::kLeafSide * stored_.voxel_mm(level);
  const double reach = kSteepest * kHalfDiagonal * side + double{band_};
  assert(level >= 0 && level < stored_.level_count());
  std::vector<char> is_near(origins.size(), 0);
  for_each_sampled(clay_, origins.size(), [&](FieldSampler& sampler, std::size_t n) {
    const Vec3 low = point_mm(origins[n], stored_.voxel_mm(level));
    const Vec3 middle = low + 0.5 * Vec3{side, side, side};
    is_near[n] = stored_.leaf(level, origins[n]) != nullptr ||
                 std::abs(sampler.distance_mm(middle)) <= reach;
  });
  Origins kept;
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (is_near[n] != 0) kept.push_back(origins[n]);
  }
  return kept;
}

/// From the coarsest level down, since that covers the whole surface.
Result<Origins> Volume::finest_leaves() const {
  const std::int64_t most = clay_.use().free_bytes / kLeafBytes;
  const int top = stored_.level_count() - 1;
  Origins origins = stored_.leaf_origins(top);
  for (int level = top - 1; level >= 0; --level) {
    if (Result<void> on = go_on(0.0); !on) return on.error();
    Origins finer;
    finer.reserve(8 * origins.size());
    for (const auto& [x, y, z] : origins) {
      for (int i = 0; i < 8; ++i) {
        finer.push_back({2 * x + (i >> 2) * storage::kLeafSide,
                         2 * y + (i >> 1 & 1) * storage::kLeafSide,
                         2 * z + (i & 1) * storage::kLeafSide});
      }
    }
    origins = near_surface(level, finer);
    if (static_cast<std::int64_t>(origins.size()) <= most) continue;
    return Error{ErrorKind::memory,
                 "the whole surface at the finest voxel, " + std::to_string(voxel_mm_) +
                     " mm, takes more than the " + std::to_string(most * kLeafBytes >> 20) +
                     " MB that are free; make the voxels larger (argil edit --voxel-mm) or export "
                     "a mesh"};
  }
  return origins;
}

void Volume::take_leaf(FieldSampler& sampler, const NodeCoord& origin, LeafValues& out) const {
  if (const float* values = stored_.leaf(0, origin)) {
    std::memcpy(out.data(), values, sizeof out);
  } else {
    for (int n = 0; n < storage::kLeafNodes; ++n) {
      const NodeCoord node{origin[0] + (n >> 6), origin[1] + (n >> 3 & 7), origin[2] + (n & 7)};
      out[static_cast<std::size_t>(n)] =
          static_cast<float>(sampler.distance_mm(point_mm(node, voxel_mm_)));
    }
  }
  assert(band_ > 0.0F);
  // OpenVDB's level sets hold no value beyond their background.
  for (float& value : out) value = std::clamp(value, -band_, band_);
}

/// Leaves without a node in the band are left to the tiles.
void Volume::add_leaf(const NodeCoord& origin, const LeafValues& values) {
  const auto in_band = [&](float value) { return std::abs(value) < band_; };
  if (std::none_of(values.begin(), values.end(), in_band)) return;
  VdbLeaf* const leaf = grid_->tree().touchLeaf(coord_of(origin));
  for (openvdb::Index n = 0; n < storage::kLeafNodes; ++n) {
    if (in_band(values[n])) {
      leaf->setValueOn(n, values[n]);
    } else {
      leaf->setValueOff(n, values[n]);
    }
  }
}

Result<void> Volume::fill(const Origins& origins) {
  constexpr std::size_t kBatch = 4096;
  std::vector<LeafValues> batch(std::min(kBatch, origins.size()));
  for (std::size_t begin = 0; begin < origins.size(); begin += kBatch) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (Result<void> on = go_on(done); !on) return on;
    const std::size_t count = std::min(kBatch, origins.size() - begin);
    for_each_sampled(clay_, count, [&](FieldSampler& sampler, std::size_t n) {
      take_leaf(sampler, origins[begin + n], batch[n]);
    });
    for (std::size_t n = 0; n < count; ++n) add_leaf(origins[begin + n], batch[n]);
  }
  // Gives the tiles without leaves the sign of what surrounds them.
  openvdb::tools::signedFloodFill(grid_->tree());
  return go_on(1.0);
}

Result<VolumeReport> Volume::run() {
  const Result<Origins> leaves = finest_leaves();
  if (!leaves) return leaves.error();
  if (Result<void> filled = fill(leaves.value()); !filled) return filled.error();
  if (grid_->tree().leafCount() == 0) {
    return Error{ErrorKind::bad_input,
                 "there is no clay to export to '" + file_.string() + "'; add some first"};
  }
  const Result<void> written =
      replace_file(file_, [&](const std::filesystem::path& temporary) -> Result<void> {
        return write_grid(temporary, grid_);
      });
  if (!written) return written.error();
  VolumeReport report;
  report.voxel_mm = voxel_mm_;
  report.active_voxels = static_cast<std::int64_t>(grid_->activeVoxelCount());
  report.leaves = static_cast<std::int64_t>(grid_->tree().leafCount());
  report.bytes = static_cast<std::int64_t>(grid_->memUsage());
  return report;
}

}  // namespace

Result<VolumeReport> export_volume(const std::filesystem::path& file, const Clay& clay,
                                   const Progress& progress) {
  return no_throw(file.string(), [&] { return Volume(file, clay, progress).run(); });
}

}  // namespace argil::io
