// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/volume_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/io/safe_file.h"

#include "field_sampler.h"
#include "hash_text.h"
#include "level_stack.h"
#include "no_throw.h"
#include "vdb.h"
#include "vdb_write.h"

namespace argil::io {
namespace {

using Places = std::vector<Coord>;
using Values = std::array<float, kLeafNodes>;

constexpr int kHalfWidth = 3;              // OpenVDB's own: what its tools expect of a level set
constexpr std::int64_t kLeafBytes = 2500;  // with what the tree above takes

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
        stack_(clay.levels()),
        progress_(progress),
        voxel_mm_(stack_.voxel_mm(0)),
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
  Result<Places> finest_places() const;
  Places near_surface(int level, const Places& places) const;
  Result<void> fill(const Places& places);
  void take_leaf(FieldSampler& sampler, const Coord& place, Values& out) const;
  void add_leaf(const Coord& place, const Values& values);

  const std::filesystem::path& file_;
  const Clay& clay_;
  const LevelStack& stack_;
  const Progress& progress_;
  double voxel_mm_;
  float band_;
  VdbGrid::Ptr grid_;
};

/// Those that have a leaf or may hold a node within the band.
Places Volume::near_surface(int level, const Places& places) const {
  constexpr double kHalfDiagonal = 0.8661;  // of a cube of side 1, rounded up
  constexpr double kSteepest = 2.0;         // what the field may rise by in 1 mm (docs/field.md)
  const double side = kLeafSide * stack_.voxel_mm(level);
  const double reach = kSteepest * kHalfDiagonal * side + double{band_};
  std::vector<char> is_near(places.size(), 0);
  for_each_sampled(clay_, places.size(), [&](FieldSampler& sampler, std::size_t n) {
    const Vec3 low = place_mm(places[n], stack_.voxel_mm(level));
    const Vec3 middle = low + 0.5 * Vec3{side, side, side};
    is_near[n] =
        stack_.has_leaf(level, places[n]) || std::abs(sampler.distance_mm(middle)) <= reach;
  });
  Places kept;
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (is_near[n] != 0) kept.push_back(places[n]);
  }
  return kept;
}

/// From the coarsest level down, since that covers the whole surface.
Result<Places> Volume::finest_places() const {
  const std::int64_t most = clay_.use().free_bytes / kLeafBytes;
  Places places = stack_.sorted_places(stack_.top());
  for (int level = stack_.top() - 1; level >= 0; --level) {
    if (Result<void> on = go_on(0.0); !on) return on.error();
    Places finer;
    finer.reserve(8 * places.size());
    for (const Coord& place : places) {
      for (int i = 0; i < 8; ++i) {
        finer.push_back(
            (place << 1)
                .offsetBy((i >> 2) * kLeafSide, (i >> 1 & 1) * kLeafSide, (i & 1) * kLeafSide));
      }
    }
    places = near_surface(level, finer);
    if (static_cast<std::int64_t>(places.size()) <= most) continue;
    return Error{ErrorKind::memory,
                 "the whole surface at the finest voxel, " + std::to_string(voxel_mm_) +
                     " mm, takes more than the " + std::to_string(most * kLeafBytes >> 20) +
                     " MB that are free; make the voxels larger (argil edit --voxel-mm) or export "
                     "a mesh"};
  }
  return places;
}

void Volume::take_leaf(FieldSampler& sampler, const Coord& place, Values& out) const {
  if (const VdbLeaf* leaf = stack_.leaf(0, place)) {
    std::memcpy(out.data(), leaf->buffer().data(), sizeof out);
  } else {
    for (int n = 0; n < kLeafNodes; ++n) {
      const Coord node = place.offsetBy(n >> 6, n >> 3 & 7, n & 7);
      out[static_cast<std::size_t>(n)] =
          static_cast<float>(sampler.distance_mm(argil::place_mm(node, voxel_mm_)));
    }
  }
  for (float& value : out) value = std::clamp(value, -band_, band_);
}

/// Leaves without a node in the band are left to the tiles.
void Volume::add_leaf(const Coord& place, const Values& values) {
  const auto in_band = [&](float value) { return std::abs(value) < band_; };
  if (std::none_of(values.begin(), values.end(), in_band)) return;
  VdbLeaf* const leaf = grid_->tree().touchLeaf(place);
  for (openvdb::Index n = 0; n < kLeafNodes; ++n) {
    if (in_band(values[n])) {
      leaf->setValueOn(n, values[n]);
    } else {
      leaf->setValueOff(n, values[n]);
    }
  }
}

Result<void> Volume::fill(const Places& places) {
  constexpr std::size_t kBatch = 4096;
  std::vector<Values> batch(std::min(kBatch, places.size()));
  for (std::size_t begin = 0; begin < places.size(); begin += kBatch) {
    const double done = static_cast<double>(begin) / static_cast<double>(places.size());
    if (Result<void> on = go_on(done); !on) return on;
    const std::size_t count = std::min(kBatch, places.size() - begin);
    for_each_sampled(clay_, count, [&](FieldSampler& sampler, std::size_t n) {
      take_leaf(sampler, places[begin + n], batch[n]);
    });
    for (std::size_t n = 0; n < count; ++n) add_leaf(places[begin + n], batch[n]);
  }
  openvdb::tools::signedFloodFill(grid_->tree());
  return go_on(1.0);
}

Result<VolumeReport> Volume::run() {
  const Result<Places> places = finest_places();
  if (!places) return places.error();
  if (Result<void> filled = fill(places.value()); !filled) return filled.error();
  if (grid_->tree().leafCount() == 0) {
    return Error{ErrorKind::bad_input,
                 "there is no clay to export to '" + file_.string() + "'; add some first"};
  }
  const Result<void> written =
      replace_file(file_, [&](const std::filesystem::path& temporary) -> Result<void> {
        return write_vdb(temporary, {grid_}, {});
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
