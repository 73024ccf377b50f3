// SPDX-License-Identifier: GPL-3.0-or-later
// Embree finds the candidates in floats about the middle of the mesh, with a margin for its
// rounding; what they say is computed in double, and of what is equally near the smaller ball wins,
// so that the order of the search, which is not the same twice, shows nowhere.
#include "measure/opposite_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>

#include "argil/core/closest_on_triangle.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// The cosine of 60 degrees, and a little less, so that rounding leaves out none of just that.
constexpr double kOpposite = 0.5 - 1e-6;

struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const noexcept { rtcReleaseGeometry(geometry); }
};

}  // namespace

/// The triangle that lies opposite and is nearest to the middle of a ball that touches `place`.
struct OppositeSurface::Nearest {
  const OppositeSurface& surface;
  Vec3 place;
  Vec3 way;
  Vec3 middle;
  double within2;            ///< the square of how near it must be
  double radius = kNothing;  ///< of the ball through `place` and it

  bool is_found() const noexcept { return radius < kNothing; }

  void offer(std::uint32_t triangle) noexcept {
    if (!surface.is_opposite(triangle, way)) return;
    const auto& [a, b, c] = corners_of(surface.mesh_, triangle);
    const Vec3 point = closest_on_triangle(middle, a, b, c);
    const double near2 = dot(point - middle, point - middle);
    if (near2 > within2) return;
    const Vec3 apart = point - place;
    const double along = dot(apart, way);
    if (!(along > 0.0)) return;
    const double through = dot(apart, apart) / (2.0 * along);
    radius = near2 < within2 ? through : std::min(radius, through);
    within2 = near2;
  }
};

/// Where a ray ends.
struct OppositeSurface::RayEnd : RayContext {
  RayEnd(const OppositeSurface& of, const Vec3& along) : surface(of), way(along) {}
  const OppositeSurface& surface;
  const Vec3& way;
  bool counts = false;  ///< false: the hit ends the ray
  float least = std::numeric_limits<float>::infinity();
};

OppositeSurface::OppositeSurface(const TriangleMesh& mesh, Through through)
    : mesh_(mesh),
      sign_(through == Through::solid ? 1.0 : -1.0),
      center_(bounds(mesh).center()),
      device_(rtcNewDevice(nullptr)) {
  rounding_ = length(bounds(mesh).size()) * 0x1p-20;
  if (!device_) throw std::bad_alloc();
  scene_.reset(rtcNewScene(device_.get()));
  if (!scene_) throw std::bad_alloc();
  // Without it a ray may slip through along the edge between two triangles.
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  const std::unique_ptr<RTCGeometryTy, ReleaseGeometry> geometry(
      rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  if (!geometry) throw std::bad_alloc();
  fill(geometry.get());
  rtcSetGeometryIntersectFilterFunction(geometry.get(), on_hit);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

void OppositeSurface::fill(RTCGeometry geometry) const {
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

double OppositeSurface::facing(std::uint32_t triangle, const Vec3& way) const noexcept {
  assert(triangle < mesh_.triangles.size());
  return sign_ * dot(area_normal(corners_of(mesh_, triangle)), way);
}

bool OppositeSurface::is_opposite(std::uint32_t triangle, const Vec3& way) const noexcept {
  assert(triangle < mesh_.triangles.size());
  const Vec3 normal = area_normal(corners_of(mesh_, triangle));
  const double facing = sign_ * dot(normal, way);
  return facing > 0.0 && facing * facing >= kOpposite * kOpposite * dot(normal, normal);
}

bool OppositeSurface::on_triangle(RTCPointQueryFunctionArguments* arguments) {
  Nearest& nearest = *static_cast<Nearest*>(arguments->userPtr);
  const double before = nearest.within2;
  nearest.offer(arguments->primID);
  if (!(nearest.within2 < before)) return false;
  arguments->query->radius = nearest.surface.safe_radius(std::sqrt(nearest.within2));
  return true;
}

RTCPointQuery OppositeSurface::ball_around(const Vec3& point, double radius_mm) const noexcept {
  const Vec3 at = point - center_;
  RTCPointQuery ball{};
  ball.x = static_cast<float>(at.x);
  ball.y = static_cast<float>(at.y);
  ball.z = static_cast<float>(at.z);
  ball.radius = safe_radius(radius_mm);
  return ball;
}

void OppositeSurface::ask(const Vec3& point, Nearest& nearest) const {
  RTCPointQuery ball = ball_around(point, std::sqrt(nearest.within2));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &ball, &context, on_triangle, &nearest);
}

bool OppositeSurface::comes_near(const Vec3& point, double radius_mm, const Vec3& way) const {
  assert(is_finite(point) && radius_mm >= 0.0);
  struct Any {
    const OppositeSurface& surface;
    const Vec3& point;
    const Vec3& way;
    double radius2;
    bool is_found = false;
  } any{*this, point, way, radius_mm * radius_mm};
  const auto on_any = [](RTCPointQueryFunctionArguments* arguments) {
    Any& asked = *static_cast<Any*>(arguments->userPtr);
    const std::uint32_t triangle = arguments->primID;
    if (asked.is_found || !asked.surface.is_opposite(triangle, asked.way)) return false;
    const auto& [a, b, c] = corners_of(asked.surface.mesh_, triangle);
    const Vec3 apart = closest_on_triangle(asked.point, a, b, c) - asked.point;
    if (dot(apart, apart) > asked.radius2) return false;
    asked.is_found = true;
    arguments->query->radius = 0.0F;  // no more is wanted
    return true;
  };
  RTCPointQuery ball = ball_around(point, radius_mm);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &ball, &context, on_any, &any);
  return any.is_found;
}

std::optional<double> OppositeSurface::ball_within(const Vec3& place, const Vec3& way,
                                                   double radius) const {
  // To a thousandth: in a round rod all sides are nearly as near, and a ball would shrink for long.
  constexpr double kTouches = 1.0 - 1e-3;
  const Vec3 middle = place + radius * way;
  const double within = kTouches * radius;
  Nearest nearest{*this, place, way, middle, within * within};
  ask(middle, nearest);
  if (!nearest.is_found() || nearest.radius >= radius) return std::nullopt;
  return nearest.radius;
}

/// A ball as wide as the ray is long, or a little wider, grows until something opposite is in it,
/// and shrinks until nothing is: what is nearest to its middle is on the next. To begin with the
/// widest would take long where much of the mesh is in it.
double OppositeSurface::ball_mm(const Vec3& place, const Vec3& way, double most_mm) const {
  assert(is_finite(place) && most_mm > 0.0);
  const double most = 0.5 * most_mm;
  if (!comes_near(place + most * way, most, way)) return most_mm;
  constexpr double kBeyondRay = 0.55;
  double radius = std::clamp(kBeyondRay * ray_mm(place, way), most / 64.0, most);
  std::optional<double> smaller = ball_within(place, way, radius);
  while (!smaller && radius < most) {
    radius = std::min(2.0 * radius, most);
    smaller = ball_within(place, way, radius);
  }
  constexpr int kMostSteps = 64;
  for (int step = 0; smaller && step < kMostSteps; ++step) {
    radius = *smaller;
    smaller = ball_within(place, way, radius);
  }
  return 2.0 * radius;
}

/// Triangles that face the ray, its own among them, are entries, not ends.
void OppositeSurface::on_hit(const RTCFilterFunctionNArguments* arguments) {
  assert(arguments->N == 1 && arguments->context != nullptr);
  RayEnd& end = *static_cast<RayEnd*>(arguments->context);
  if (end.surface.facing(RTCHitN_primID(arguments->hit, 1, 0), end.way) > 0.0) {
    if (!end.counts) return;
    end.least = std::min(end.least, RTCRayN_tfar(arguments->ray, 1, 0));
  }
  arguments->valid[0] = 0;
}

/// What counts is the least distance of all triangles that end the ray. The first that Embree finds
/// may be farther than another by its last bits, since a box is left out that begins behind it;
/// therefore the ray is traced again to a little beyond, and no hit ends it.
double OppositeSurface::ray_mm(const Vec3& place, const Vec3& way) const {
  const Vec3 start = place - center_;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x);
  ray.ray.org_y = static_cast<float>(start.y);
  ray.ray.org_z = static_cast<float>(start.z);
  ray.ray.dir_x = static_cast<float>(way.x);
  ray.ray.dir_y = static_cast<float>(way.y);
  ray.ray.dir_z = static_cast<float>(way.z);
  ray.ray.mask = 0xffffffff;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  assert(std::isfinite(ray.ray.org_x));
  RayEnd end(*this, way);
  RTCRayHit again = ray;
  trace_closest(scene_.get(), ray, end);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNothing;
  end.least = ray.ray.tfar;
  end.counts = true;
  // Beyond what rounding in Embree can make of a distance.
  constexpr float kBeyond = 1.0F + 0x1p-10F;
  again.ray.tfar = ray.ray.tfar * kBeyond;
  trace_closest(scene_.get(), again, end);
  return double{end.least};
}

}  // namespace argil::mesh
