// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness of walls by rays: from the middle of each triangle inward to where the solid ends.
//
// All threads build the tree, so that its order, in which a ray meets triangles, is not the same
// twice. It cannot show: what counts is the least distance of all triangles that end the solid. The
// first that Embree finds may be farther than another by its last bits, since a box is left out
// that begins behind it; therefore the ray is traced again to a little beyond, and no hit ends it.
#include "argil/mesh/wall_thickness.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

#include "measure/embree.h"

namespace argil::mesh {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

struct Release {
  void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const noexcept { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

/// The end of the solid along a ray.
struct SolidEnd : RayContext {
  SolidEnd(const TriangleMesh& of, const Vec3& along) : mesh(of), inward(along) {}
  const TriangleMesh& mesh;
  const Vec3& inward;
  bool counts = false;  ///< false: the hit ends the ray
  float least = std::numeric_limits<float>::infinity();
};

/// Embree's filter: triangles that face the ray, its own among them, are entries into the solid,
/// not its end.
void on_hit(const RTCFilterFunctionNArguments* arguments) {
  assert(arguments->N == 1 && arguments->context != nullptr);
  SolidEnd& end = *static_cast<SolidEnd*>(arguments->context);
  const unsigned triangle = RTCHitN_primID(arguments->hit, 1, 0);
  assert(triangle < end.mesh.triangles.size());
  if (dot(area_normal(corners_of(end.mesh, triangle)), end.inward) > 0.0) {
    if (!end.counts) return;
    end.least = std::min(end.least, RTCRayN_tfar(arguments->ray, 1, 0));
  }
  arguments->valid[0] = 0;
}

/// The triangles as Embree sees them: floats about `center`.
class WallScene {
 public:
  explicit WallScene(const TriangleMesh& mesh)
      : mesh_(mesh), center_(bounds(mesh).center()), device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::bad_alloc();
    scene_.reset(rtcNewScene(device_.get()));
    if (!scene_) throw std::bad_alloc();
    // Without it a ray may slip through along the edge between two triangles.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    if (!geometry) throw std::bad_alloc();
    fill(geometry.get());
    rtcSetGeometryIntersectFilterFunction(geometry.get(), on_hit);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
  }

  double thickness(std::size_t triangle) const;

 private:
  void fill(RTCGeometry geometry) {
    auto* const vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh_.positions.size()));
    auto* const indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh_.triangles.size()));
    if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        // Relative to the centre, so that the seven digits of a float all describe the piece.
        vertices[3 * i + k] = static_cast<float>(mesh_.positions[i][k] - center_[k]);
      }
    }
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) indices[3 * i + k] = mesh_.triangles[i][k];
    }
  }

  const TriangleMesh& mesh_;
  Vec3 center_;
  Device device_;
  Scene scene_;
};

double WallScene::thickness(std::size_t triangle) const {
  const Vec3 inward = -normalized(area_normal(corners_of(mesh_, triangle)));
  if (inward == Vec3{}) return kNone;
  const Vec3 start = middle(corners_of(mesh_, triangle)) - center_;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x);
  ray.ray.org_y = static_cast<float>(start.y);
  ray.ray.org_z = static_cast<float>(start.z);
  ray.ray.dir_x = static_cast<float>(inward.x);
  ray.ray.dir_y = static_cast<float>(inward.y);
  ray.ray.dir_z = static_cast<float>(inward.z);
  ray.ray.mask = 0xffffffff;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  assert(std::isfinite(ray.ray.org_x));
  SolidEnd end(mesh_, inward);
  RTCRayHit again = ray;
  trace_closest(scene_.get(), ray, end);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNone;
  end.least = ray.ray.tfar;
  end.counts = true;
  // Beyond what rounding in Embree can make of a distance.
  constexpr float kBeyond = 1.0F + 0x1p-10F;
  again.ray.tfar = ray.ray.tfar * kBeyond;
  trace_closest(scene_.get(), again, end);
  return double{end.least};
}

}  // namespace

std::vector<double> wall_thickness_mm(const TriangleMesh& mesh) {
  std::vector<double> walls(mesh.triangles.size(), kNone);
  if (mesh.triangles.empty()) return walls;
  const WallScene scene(mesh);
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, walls.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t t = range.begin(); t < range.end(); ++t) {
                        walls[t] = scene.thickness(t);
                      }
                    });
  return walls;
}

}  // namespace argil::mesh
