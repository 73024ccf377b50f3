// SPDX-License-Identifier: GPL-3.0-or-later
// The cubes of a drawn surface as primitives of one user geometry of Embree. A ray is brought to
// the border of them in double and goes on in floats from there, so that an eye far away costs no
// accuracy.
#include "argil/engine/surface_picker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <string>
#include <unordered_map>
#include <vector>

#include "distance/embree.h"
#include "raycast/checked_ray.h"
#include "surface/block_cube.h"
#include "surface/display_access.h"

namespace argil {
namespace {

/// Of no surface.
constexpr std::uint64_t kUnknownEdition = std::numeric_limits<std::uint64_t>::max();

Error no_memory() {
  return {ErrorKind::memory,
          "no memory left to pick on the drawn surface; ask for larger voxel_pixels or more levels "
          "in coarser"};
}

/// A ray on its way through the cubes.
struct CubeQuery : RayContext {
  RayJob job;
  BlockHit hit;
};

Vec3 corner_of(const std::array<float, 3>& p) noexcept {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Whether bounds that a box is within might be smaller without it.
bool reaches_out(const CubeBox& box, const Box3& bounds) noexcept {
  for (std::size_t a = 0; a < 3; ++a) {
    if (static_cast<double>(box.low[a]) <= bounds.min[a]) return true;
    if (static_cast<double>(box.high[a]) >= bounds.max[a]) return true;
  }
  return false;
}

/// Where a ray enters a box, 0 where it begins inside.
std::optional<double> entry_of(const Box3& box, const Vec3& origin, const Vec3& direction) {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) {
      if (origin[a] < box.min[a] || origin[a] > box.max[a]) return std::nullopt;
      continue;
    }
    const double low = (box.min[a] - origin[a]) / direction[a];
    const double high = (box.max[a] - origin[a]) / direction[a];
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  if (first > last) return std::nullopt;
  return first;
}

/// `direction` of unit length.
RayJob ray_job(const Vec3& origin, const Vec3& direction) {
  constexpr float kLeast = 1e-18F;  // of a component, so that its inverse does not overflow
  RayJob job{};
  std::array<float, 3> d;
  for (std::size_t a = 0; a < 3; ++a) {
    d[a] = static_cast<float>(direction[a]);
    job.origin[a] = static_cast<float>(origin[a]);
    job.inverse[a] = 1.0F / (std::abs(d[a]) < kLeast ? std::copysign(kLeast, d[a]) : d[a]);
  }
  std::size_t most = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    if (std::abs(d[a]) > std::abs(d[most])) most = a;
  }
  std::size_t x = (most + 1) % 3;
  std::size_t y = (most + 2) % 3;
  if (d[most] < 0.0F) std::swap(x, y);
  const std::array<std::size_t, 3> axes{x, y, most};
  for (std::size_t i = 0; i < 3; ++i) job.axis[i] = static_cast<int>(axes[i]);
  job.shear[0] = d[x] / d[most];
  job.shear[1] = d[y] / d[most];
  job.per_step = 1.0 / static_cast<double>(d[most]);
  return job;
}

RTCRayHit ray_hit(const RayJob& job, const Vec3& direction) {
  RTCRayHit query{};
  query.ray.org_x = job.origin[0];
  query.ray.org_y = job.origin[1];
  query.ray.org_z = job.origin[2];
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct SurfacePicker::State {
  // Later ones refer to earlier ones.
  DeviceHandle device{nullptr, &rtcReleaseDevice};
  SceneHandle scene{nullptr, &rtcReleaseScene};
  GeometryHandle geometry{nullptr, &rtcReleaseGeometry};
  std::unordered_map<LeafKey, std::unique_ptr<BlockCube>, LeafKeyHash> by_key;
  std::vector<BlockCube*> cubes;  // as Embree numbers them
  BlockCube* newest = nullptr;    // that was asked for
  std::size_t empty_cubes = 0;    // of them
  bool is_stale = false;          // a cube came since the last commit
  RayScratch scratch;
  Box3 bounds_mm;                 // of the cubes that are not empty, or larger
  bool are_bounds_stale = false;  // perhaps larger
  double voxel_mm = 0.0;
  std::uint64_t edition = kUnknownEdition;  // of the surface, that the cubes are of
  std::int64_t blocks = 0;
  std::int64_t commits = 0;

  bool make_scene();
  void take_all(const DisplaySurface& surface);
  void take_changes(const DisplaySurface& surface);
  BlockCube* cube_of(const LeafKey& key);
  void put(const DisplaySurface& surface, const BlockId& id);
  void erase(const BlockId& id);
  void drop_empty_cubes();
  void commit();
  void find_bounds();
  BlockHit first_hit(const Vec3& origin, const Vec3& direction);

  static void on_bounds(const RTCBoundsFunctionArguments* arguments);
  static void on_intersect(const RTCIntersectFunctionNArguments* arguments);
};

/// False: no memory.
bool SurfacePicker::State::make_scene() {
  if (geometry) return true;
  // A tree over some thousand cubes is built faster by one thread than by waking others.
  device.reset(rtcNewDevice("threads=1"));
  if (!device) return false;
  scene.reset(rtcNewScene(device.get()));
  if (!scene) return false;
  rtcSetSceneFlags(scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
  if (!geometry) return false;
  rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_LOW);
  rtcSetGeometryUserData(geometry.get(), this);
  rtcSetGeometryBoundsFunction(geometry.get(), on_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), on_intersect);
  rtcAttachGeometry(scene.get(), geometry.get());
  return true;
}

void SurfacePicker::State::take_all(const DisplaySurface& surface) {
  by_key.clear();
  cubes.clear();
  newest = nullptr;
  blocks = 0;
  empty_cubes = 0;
  is_stale = are_bounds_stale = true;
  voxel_mm = DisplayAccess::voxel_mm(surface);
  for (const BlockId& id : surface.blocks()) put(surface, id);
}

void SurfacePicker::State::take_changes(const DisplaySurface& surface) {
  for (const BlockId& id : surface.gone()) erase(id);
  for (const BlockId& id : surface.changed()) put(surface, id);
}

/// Null where there is none. Blocks that are asked for one after the other lie together.
BlockCube* SurfacePicker::State::cube_of(const LeafKey& key) {
  if (newest != nullptr && newest->key() == key) return newest;
  const auto found = by_key.find(key);
  if (found == by_key.end()) return nullptr;
  return newest = found->second.get();
}

void SurfacePicker::State::put(const DisplaySurface& surface, const BlockId& id) {
  const LeafKey key = BlockCube::key_of(id);
  BlockCube* cube = cube_of(key);
  if (cube == nullptr) {
    cube = (by_key[key] = std::make_unique<BlockCube>(key, voxel_mm)).get();
    cubes.push_back(cube);
    newest = cube;
    ++empty_cubes;
    is_stale = true;
  }
  if (cube->refresh(id)) return;
  if (cube->is_empty()) {
    --empty_cubes;
    bounds_mm.include(corner_of(cube->box().low));
    bounds_mm.include(corner_of(cube->box().high));
  }
  cube->insert(id, DisplayAccess::block(surface, id));
  ++blocks;
}

void SurfacePicker::State::erase(const BlockId& id) {
  BlockCube* const cube = cube_of(BlockCube::key_of(id));
  if (cube == nullptr || !cube->erase(id)) return;
  --blocks;
  if (!cube->is_empty()) return;
  ++empty_cubes;
  are_bounds_stale = are_bounds_stale || reaches_out(cube->box(), bounds_mm);
}

/// A stroke empties cubes and fills them again: they are dropped when the tree is built for another
/// reason, or when they are many.
void SurfacePicker::State::drop_empty_cubes() {
  std::erase_if(cubes, [](const BlockCube* cube) { return cube->is_empty(); });
  std::erase_if(by_key, [](const auto& entry) { return entry.second->is_empty(); });
  newest = nullptr;
  empty_cubes = 0;
}

/// Throws bad_alloc when Embree has no memory for its tree.
void SurfacePicker::State::commit() {
  assert(cubes.size() == by_key.size());
  if (empty_cubes > 16 + cubes.size() / 4) is_stale = true;
  if (!is_stale) return;
  drop_empty_cubes();
  if (!cubes.empty()) {
    if (!make_scene()) throw std::bad_alloc();
    rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(cubes.size()));
    rtcCommitGeometry(geometry.get());
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    ++commits;
  }
  is_stale = false;
}

/// Where a ray begins shows in the last bits of its answer, so that empty cubes may not count,
/// which are there or not.
void SurfacePicker::State::find_bounds() {
  if (!are_bounds_stale) return;
  bounds_mm = {};
  for (const BlockCube* cube : cubes) {
    if (cube->is_empty()) continue;
    bounds_mm.include(corner_of(cube->box().low));
    bounds_mm.include(corner_of(cube->box().high));
  }
  are_bounds_stale = false;
}

void SurfacePicker::State::on_bounds(const RTCBoundsFunctionArguments* arguments) {
  const State& state = *static_cast<const State*>(arguments->geometryUserPtr);
  const CubeBox box = state.cubes[arguments->primID]->box();
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = box.low[0];
  bounds.lower_y = box.low[1];
  bounds.lower_z = box.low[2];
  bounds.upper_x = box.high[0];
  bounds.upper_y = box.high[1];
  bounds.upper_z = box.high[2];
}

void SurfacePicker::State::on_intersect(const RTCIntersectFunctionNArguments* arguments) {
  assert(arguments->N == 1);
  if (arguments->valid[0] == 0) return;
  State& state = *static_cast<State*>(arguments->geometryUserPtr);
  CubeQuery& query = *static_cast<CubeQuery*>(arguments->context);
  assert(arguments->primID < state.cubes.size());
  if (!state.cubes[arguments->primID]->meet(query.job, state.scratch, query.hit)) {
    return answer_miss(*arguments);
  }
  // No nearer than the hit, so that cubes are still looked at in which another is as near.
  const float along =
      std::nextafter(static_cast<float>(query.hit.along), std::numeric_limits<float>::infinity());
  answer_hit(*arguments, std::min(along, asked_ray(*arguments).ray.tfar));
}

/// An infinite `along` where nothing is hit.
BlockHit SurfacePicker::State::first_hit(const Vec3& origin, const Vec3& direction) {
  assert(!is_stale && !are_bounds_stale);
  if (blocks == 0) return {};
  const auto start = entry_of(bounds_mm, origin, direction);
  if (!start) return {};
  CubeQuery query;
  query.job = ray_job(origin + *start * direction, direction);
  RTCRayHit traced = ray_hit(query.job, direction);
  trace_closest(scene.get(), traced, query);
  query.hit.along += *start;
  return query.hit;
}

SurfacePicker::SurfacePicker() : state_(std::make_unique<State>()) {}
SurfacePicker::SurfacePicker(SurfacePicker&&) noexcept = default;
SurfacePicker& SurfacePicker::operator=(SurfacePicker&&) noexcept = default;
SurfacePicker::~SurfacePicker() = default;

Result<void> SurfacePicker::update(const DisplaySurface& surface) {
  const DisplayEdition edition = DisplayAccess::edition(surface);
  if (state_->edition == edition.now) return {};
  try {
    // Cubes of another voxel would keep their places.
    const bool follows =
        state_->edition == edition.before && state_->voxel_mm == DisplayAccess::voxel_mm(surface);
    state_->edition = kUnknownEdition;
    if (follows) {
      state_->take_changes(surface);
    } else {
      state_->take_all(surface);
    }
    state_->edition = edition.now;
  } catch (const std::bad_alloc&) {
    state_ = std::make_unique<State>();
    return no_memory();
  }
  return {};
}

Result<std::optional<Pick>> SurfacePicker::pick(const DisplaySurface& surface, const Ray& ray) {
  if (auto updated = update(surface); !updated) return updated.error();
  if (state_->voxel_mm == 0.0) return std::optional<Pick>();  // of no clay yet
  if (auto valid = validate_ray(ray, state_->voxel_mm); !valid) return valid.error();
  try {
    state_->commit();
    state_->find_bounds();
  } catch (const std::bad_alloc&) {
    state_ = std::make_unique<State>();
    return no_memory();
  }
  const Vec3 direction = unit_direction(ray);
  const BlockHit hit = state_->first_hit(ray.origin_mm, direction);
  if (hit.has_failed) return no_memory();
  if (std::isinf(hit.along)) return std::optional<Pick>();
  Pick pick;
  pick.distance_mm = hit.along;
  pick.point_mm = ray.origin_mm + hit.along * direction;
  pick.level = hit.block.level;
  pick.normal = hit.normal == Vec3{} ? -direction : hit.normal;
  assert(is_finite(pick.point_mm));
  return std::optional(pick);
}

SurfacePickerStats SurfacePicker::stats() const noexcept {
  SurfacePickerStats stats;
  stats.cubes = static_cast<std::int64_t>(state_->cubes.size() - state_->empty_cubes);
  stats.empty_cubes = static_cast<std::int64_t>(state_->empty_cubes);
  stats.blocks = state_->blocks;
  stats.commits = state_->commits;
  for (const BlockCube* cube : state_->cubes) stats.bytes += cube->bytes();
  return stats;
}

}  // namespace argil
