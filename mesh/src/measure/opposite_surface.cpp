// SPDX-License-Identifier: GPL-3.0-or-later
// Embree finds the candidates in floats about the middle of the mesh, with a margin for its
// rounding; what they say is computed in double, and the least of it counts, so that the order of
// the search, which is not the same twice, shows nowhere.
#include "measure/opposite_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>

#include "argil/core/closest_on_triangle.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// The cosine of 60 degrees, and a little less, so that rounding leaves out none of just that.
constexpr double kOpposite = 0.5 - 1e-6;

/// What touches a ball at the very place where it touches the surface is in it, too.
constexpr double kTouching = 1.0 + 1e-6;

struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const noexcept { rtcReleaseGeometry(geometry); }
};

}  // namespace

/// The smallest of the balls that touch `place` and a piece that lies opposite and in a ball about
/// `middle`, as far as what is nearest to that tells.
struct OppositeSurface::Smallest {
  const OppositeSurface& surface;
  Vec3 place;
  Vec3 way;
  Vec3 middle;
  double within2;            ///< the square of how near pieces must be
  double radius = kNothing;  ///< of the smallest ball

  void offer(std::uint32_t piece) noexcept {
    if (surface.facing(piece, way) != Facing::opposite) return;
    const auto& [a, b, c] = surface.pieces_.corners(piece);
    const Vec3 point = closest_on_triangle(middle, a, b, c);
    const double near2 = dot(point - middle, point - middle);
    if (near2 > within2) return;
    const Vec3 apart = point - place;
    const double along = dot(apart, way);
    if (!(along > 0.0)) return;
    radius = std::min(radius, dot(apart, apart) / (2.0 * along));
  }
};

/// Where a ray ends.
struct OppositeSurface::RayEnd : RayContext {
  RayEnd(const OppositeSurface& of, const Vec3& along) : surface(of), way(along) {}
  const OppositeSurface& surface;
  const Vec3& way;
  bool counts = false;  ///< false: the hit ends the ray
  float least = std::numeric_limits<float>::infinity();
  float least_opposite = std::numeric_limits<float>::infinity();
};

OppositeSurface::OppositeSurface(const MeshPieces& pieces, Through through)
    : pieces_(pieces),
      sign_(through == Through::solid ? 1.0 : -1.0),
      center_(used_bounds(pieces.mesh()).center()),
      device_(rtcNewDevice(nullptr)) {
  rounding_ = length(used_bounds(pieces.mesh()).size()) * 0x1p-20;
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

/// The vertices of the mesh for its whole triangles, then three for each piece.
void OppositeSurface::fill(RTCGeometry geometry) const {
  const TriangleMesh& mesh = pieces_.mesh();
  const std::size_t whole = pieces_.whole_count();
  const std::size_t own = mesh.positions.size();
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), own + 3 * (pieces_.count() - whole)));
  auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), pieces_.count()));
  if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
  const auto put = [&](std::size_t vertex, const Vec3& at) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Relative to the centre, so that the seven digits of a float all describe the piece.
      vertices[3 * vertex + k] = static_cast<float>(at[k] - center_[k]);
    }
  };
  for (std::size_t i = 0; i < own; ++i) put(i, mesh.positions[i]);
  for (std::size_t n = 0; n < pieces_.count(); ++n) {
    const Corners corners = pieces_.corners(n);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = own + 3 * (n - whole) + k;  // of a piece
      if (n >= whole) put(vertex, corners[k]);
      indices[3 * n + k] =
          n < whole ? mesh.triangles[pieces_.triangle(n)][k] : static_cast<unsigned>(vertex);
    }
  }
}

OppositeSurface::Facing OppositeSurface::facing(std::uint32_t piece,
                                                const Vec3& way) const noexcept {
  assert(piece < pieces_.count());
  const Vec3 normal = area_normal(corners_of(pieces_.mesh(), pieces_.triangle(piece)));
  const double along = sign_ * dot(normal, way);
  if (!(along > 0.0)) return Facing::entry;
  const bool is_opposite = along * along >= kOpposite * kOpposite * dot(normal, normal);
  return is_opposite ? Facing::opposite : Facing::end;
}

bool OppositeSurface::on_triangle(RTCPointQueryFunctionArguments* arguments) {
  static_cast<Smallest*>(arguments->userPtr)->offer(arguments->primID);
  return false;  // the search goes on as it is
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

void OppositeSurface::ask(const Vec3& point, Smallest& smallest) const {
  RTCPointQuery ball = ball_around(point, std::sqrt(smallest.within2));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &ball, &context, on_triangle, &smallest);
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
    if (asked.is_found) return false;
    const unsigned piece = arguments->primID;
    if (asked.surface.facing(piece, asked.way) != Facing::opposite) return false;
    const auto& [a, b, c] = asked.surface.pieces_.corners(piece);
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
  // To a thousandth: in a round rod all sides are nearly as near.
  constexpr double kTouches = 1.0 - 1e-3;
  const Vec3 middle = place + radius * way;
  const double within = kTouches * radius;
  Smallest smallest{*this, place, way, middle, within * within};
  ask(middle, smallest);
  if (smallest.radius >= radius) return std::nullopt;
  return smallest.radius;
}

/// A ball as wide as the ray is long, or a little wider, grows until something opposite is in it,
/// and shrinks until nothing is. To begin with the widest would take long where much of the mesh is
/// in it.
double OppositeSurface::ball_mm(const Vec3& place, const Vec3& way, double most_mm) const {
  assert(is_finite(place) && most_mm > 0.0);
  const double most = 0.5 * most_mm;
  if (!comes_near(place + most * way, kTouching * most, way)) return most_mm;
  constexpr double kBeyondRay = 0.55;
  const Ray along = ray(place, way);
  double radius = std::clamp(kBeyondRay * along.end_mm, most / 64.0, most);
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
  // What is so near that it touches every ball.
  return std::min(2.0 * radius, along.opposite_mm);
}

/// Triangles that face the ray, its own among them, are entries, not ends.
void OppositeSurface::on_hit(const RTCFilterFunctionNArguments* arguments) {
  assert(arguments->N == 1 && arguments->context != nullptr);
  RayEnd& end = *static_cast<RayEnd*>(arguments->context);
  const Facing facing = end.surface.facing(RTCHitN_primID(arguments->hit, 1, 0), end.way);
  if (facing != Facing::entry) {
    if (!end.counts) return;
    const float along = RTCRayN_tfar(arguments->ray, 1, 0);
    end.least = std::min(end.least, along);
    if (facing == Facing::opposite) end.least_opposite = std::min(end.least_opposite, along);
  }
  arguments->valid[0] = 0;
}

/// What counts is the least distance of all triangles that end the ray. The first that Embree finds
/// may be farther than another by its last bits, since a box is left out that begins behind it;
/// therefore the ray is traced again to a little beyond, and no hit ends it.
OppositeSurface::Ray OppositeSurface::ray(const Vec3& place, const Vec3& way) const {
  const Vec3 start = place - center_;
  RTCRayHit hit{};
  hit.ray.org_x = static_cast<float>(start.x);
  hit.ray.org_y = static_cast<float>(start.y);
  hit.ray.org_z = static_cast<float>(start.z);
  hit.ray.dir_x = static_cast<float>(way.x);
  hit.ray.dir_y = static_cast<float>(way.y);
  hit.ray.dir_z = static_cast<float>(way.z);
  hit.ray.mask = 0xffffffff;
  hit.ray.tfar = std::numeric_limits<float>::infinity();
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  assert(std::isfinite(hit.ray.org_x));
  RayEnd end(*this, way);
  RTCRayHit again = hit;
  trace_closest(scene_.get(), hit, end);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {kNothing, kNothing};
  end.least = hit.ray.tfar;
  end.counts = true;
  // Beyond what rounding in Embree can make of a distance.
  constexpr float kBeyond = 1.0F + 0x1p-10F;
  again.ray.tfar = hit.ray.tfar * kBeyond;
  trace_closest(scene_.get(), again, end);
  return {double{end.least}, double{end.least_opposite}};
}

}  // namespace argil::mesh
