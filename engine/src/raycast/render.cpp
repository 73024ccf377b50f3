// SPDX-License-Identifier: GPL-3.0-or-later
// One ray through the middle of each pixel finds the surface, a few rays from there the light;
// light is smoothed over pixels of the same surface, and only pixels at edges are sampled again.
#include "argil/engine/render.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <new>
#include <string>
#include <thread>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "field/bad_input.h"
#include "raycast/ray_scene.h"
#include "raycast/shading.h"

namespace argil {
namespace {

constexpr double kFrameMargin = 1.16;  // the frame is this much larger than the object
constexpr double kSameNormal = 0.985;  // cosine below which two neighbouring pixels form an edge

struct Camera {
  Vec3 eye;
  Vec3 right, up, back;  // unit; the camera looks along -back
  double tan_x = 0.0;    // of half the horizontal and vertical field of view
  double tan_y = 0.0;

  /// Unit direction through a point of the picture: x and y from 0 to 1, y from the top.
  Vec3 ray(double x, double y) const {
    return normalized((2.0 * x - 1.0) * tan_x * right + (1.0 - 2.0 * y) * tan_y * up - back);
  }
};

/// Light and surface of every pixel's middle.
struct Film {
  int width = 0;
  int height = 0;
  std::vector<SurfacePoint> points;
  std::vector<Light> lights;

  std::size_t at(int row, int column) const {
    assert(row >= 0 && column >= 0 && column < width);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Whether the work shall go on. Every thread that works asks; only the one that began, which works
/// like the others, hands the question on to `progress`.
class Watch {
 public:
  explicit Watch(const Progress& progress)
      : progress_(progress), beginner_(std::this_thread::get_id()) {}

  bool goes_on(const char* stage, double fraction) {
    constexpr std::chrono::milliseconds kBetweenQuestions{10};
    if (is_stopped()) return false;
    if (!progress_ || std::this_thread::get_id() != beginner_) return true;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return true;
    next_ = now + kBetweenQuestions;
    is_stopped_.store(!progress_(stage, fraction), std::memory_order_relaxed);
    return !is_stopped();
  }
  bool is_stopped() const noexcept { return is_stopped_.load(std::memory_order_relaxed); }

 private:
  const Progress& progress_;
  std::thread::id beginner_;
  std::chrono::steady_clock::time_point next_;  // of the thread that began
  std::atomic<bool> is_stopped_ = false;
};

/// Makes `values` so long, a piece at a time: clearing the gigabytes of a large picture takes
/// seconds.
template <class Value>
void grow(std::vector<Value>& values, std::size_t count, Watch& watch) {
  constexpr std::size_t kPiece = std::size_t{1} << 16U;
  values.reserve(count);
  while (values.size() < count) {
    const double done = static_cast<double>(values.size()) / static_cast<double>(count);
    if (!watch.goes_on("memory", done)) return;
    values.resize(std::min(count, values.size() + kPiece));
  }
}

/// Everything a pixel's colour depends on.
struct Job {
  const RayScene& scene;
  const Studio& studio;
  const Camera& camera;
  const RenderOptions& options;
  double pixel_angle;  // what one pixel spans, as a fraction of the distance
  Vec3 center_mm;      // of the object, and what 1 is in the scene
  double size_mm;
  Watch& watch;
};

Result<void> option_out_of_range(const char* name, const std::string& value, const char* range) {
  return bad_input(std::string("render option '") + name + "' is " + value + "; it must be " +
                   range);
}

Result<void> validate_count(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return {};
  return option_out_of_range(name, std::to_string(value),
                             (std::to_string(least) + " to " + std::to_string(most)).c_str());
}

Result<void> validate_camera(const RenderOptions& options) {
  if (!(options.field_of_view_rad >= 0.05 && options.field_of_view_rad <= 2.0)) {
    return option_out_of_range("field_of_view_rad", number_text(options.field_of_view_rad),
                               "0.05 to 2");
  }
  const std::optional<Box3>& part = options.frame_mm;
  if (part && (part->empty() || !is_finite(part->min) || !is_finite(part->max))) {
    return option_out_of_range("frame_mm", "empty or not finite",
                               "a box whose `min` is not above its `max`");
  }
  const Vec3 side = cross(normalized(options.up), normalized(options.toward));
  if (!is_finite(options.toward) || !is_finite(options.up) || length(side) < 1e-3) {
    return option_out_of_range("toward",
                               number_text(options.toward.x) + "," + number_text(options.toward.y) +
                                   "," + number_text(options.toward.z),
                               "a direction that is not zero and not along 'up'");
  }
  return {};
}

Result<void> validate(const TriangleMesh& mesh, const RenderOptions& options) {
  if (mesh.triangles.empty()) {
    return Error{ErrorKind::bad_input,
                 "the mesh to render has 0 triangles; give one that has a surface"};
  }
  for (const Vec3& p : mesh.positions) {
    if (is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1e15) continue;
    return Error{ErrorKind::bad_input, "the mesh to render has a vertex at (" + number_text(p.x) +
                                           ", " + number_text(p.y) + ", " + number_text(p.z) +
                                           "); coordinates must be finite and below 1e15"};
  }
  if (!options.colors.empty() && options.colors.size() != mesh.triangles.size()) {
    return option_out_of_range("colors", std::to_string(options.colors.size()) + " long",
                               "as long as the mesh has triangles, or empty");
  }
  if (auto size = validate_count("width", options.width, 16, 16384); !size) return size;
  if (auto size = validate_count("height", options.height, 16, 16384); !size) return size;
  if (auto count = validate_count("samples", options.samples, 1, 8); !count) return count;
  return validate_camera(options);
}

/// The largest of depth + coordinate / tangent over all corners: how far back one side of the frame
/// forces the camera.
struct FrameReach {
  double plus = -1e300;
  double minus = -1e300;

  void include(double depth, double coordinate, double tangent) {
    plus = std::max(plus, depth + coordinate / tangent);
    minus = std::max(minus, depth - coordinate / tangent);
  }
  double distance() const { return 0.5 * (plus + minus); }
  double offset(double tangent) const { return 0.5 * tangent * (plus - minus); }
};

/// What the frame has to hold, in the scene's unit: the vertices, or the corners of the box that is
/// asked for.
std::vector<Vec3> framed_points(const TriangleMesh& mesh, const RenderOptions& options,
                                const Box3& bounds_mm) {
  std::vector<Vec3> points;
  if (options.frame_mm) {
    const Box3& box = *options.frame_mm;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{(corner & 1) != 0 ? box.max.x : box.min.x,
                   (corner & 2) != 0 ? box.max.y : box.min.y,
                   (corner & 4) != 0 ? box.max.z : box.min.z};
      points.push_back((p - bounds_mm.center()) / length(bounds_mm.size()));
    }
    return points;
  }
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) points.push_back(mesh.positions[corner]);
  }
  return points;
}

/// The nearest camera along `toward` that has all points in its frame, margin included.
Camera frame(const std::vector<Vec3>& points, const Vec3& center, const RenderOptions& options) {
  Camera camera;
  camera.back = normalized(options.toward);
  camera.right = normalized(cross(options.up, camera.back));
  camera.up = cross(camera.back, camera.right);
  camera.tan_y = std::tan(0.5 * options.field_of_view_rad);
  camera.tan_x = camera.tan_y * options.width / options.height;
  FrameReach across;
  FrameReach along;
  for (const Vec3& point : points) {
    const Vec3 p = point - center;
    const double depth = dot(p, camera.back);
    across.include(depth, dot(p, camera.right), camera.tan_x / kFrameMargin);
    along.include(depth, dot(p, camera.up), camera.tan_y / kFrameMargin);
  }
  camera.eye = center + across.offset(camera.tan_x / kFrameMargin) * camera.right +
               along.offset(camera.tan_y / kFrameMargin) * camera.up +
               std::max(across.distance(), along.distance()) * camera.back;
  return camera;
}

/// Key light over the left shoulder; ground under the object when the camera stands above it.
Studio studio_for(const TriangleMesh& mesh, const RenderOptions& options, const Camera& camera) {
  Studio studio;
  studio.up = normalized(options.up);
  studio.key = normalized(camera.back * 0.62 - camera.right * 0.66 + studio.up * 0.86);
  double lowest = 1e300;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t c : t) lowest = std::min(lowest, dot(mesh.positions[c], studio.up));
  }
  const double size = length(bounds(mesh).size());
  studio.lift = 2e-4 * size;
  studio.ground_height = lowest - 1e-3 * size;
  studio.has_ground =
      dot(camera.eye, studio.up) > studio.ground_height && dot(camera.back, studio.up) > -0.05;
  return studio;
}

/// In tiles, each by one thread; a pixel depends on no other. Leaves pixels out once the watch has
/// stopped.
template <class PerPixel>
void for_pixels(const Job& job, const char* stage, const Film& film, const PerPixel& work) {
  constexpr int kBetweenLooks = 64;  // pixels, of which one takes up to a millisecond
  const double all = static_cast<double>(film.height) * film.width;
  std::atomic<std::int64_t> done = 0;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, film.height, 16, 0, film.width, kBetweenLooks),
                    [&](const tbb::blocked_range2d<int>& range) {
                      const int first = range.cols().begin();
                      const int last = range.cols().end();
                      for (int r = range.rows().begin(); r != range.rows().end(); ++r) {
                        for (int c = first; c < last; c += kBetweenLooks) {
                          const int end = std::min(c + kBetweenLooks, last);
                          const std::int64_t before = done.fetch_add(end - c);
                          if (!job.watch.goes_on(stage, static_cast<double>(before) / all)) return;
                          for (int at = c; at != end; ++at) work(r, at);
                        }
                      }
                    });
}

/// Which sixteenth of the light pattern a pixel uses: an ordered dither, so that neighbours differ
/// as much as they can.
int phase_of(int row, int column) {
  static constexpr int kOrder[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  assert(row >= 0 && column >= 0);
  return kOrder[(row & 3) * 4 + (column & 3)];
}

/// Light is gathered with one sixteenth of the pattern for each pixel, and smoothed afterwards.
Film trace_middles(const Job& job) {
  Film film{job.options.width, job.options.height, {}, {}};
  grow(film.points, film.at(film.height, 0), job.watch);
  grow(film.lights, film.at(film.height, 0), job.watch);
  for_pixels(job, "rays", film, [&](int row, int column) {
    const Vec3 direction = job.camera.ray((column + 0.5) / film.width, (row + 0.5) / film.height);
    SurfacePoint& point = film.points[film.at(row, column)];
    point = trace_camera_ray(job.scene, job.studio, job.camera.eye, direction);
    if (point.seen == Seen::background) return;
    film.lights[film.at(row, column)] =
        gather_light(job.scene, job.studio, point, phase_of(row, column));
  });
  return film;
}

/// How much light found at `other` says about `point`: 0 across an edge, 1 on one plane.
double kinship(const Job& job, const SurfacePoint& point, const SurfacePoint& other) {
  if (point.seen != other.seen) return 0.0;
  if (point.seen == Seen::ground) return 1.0;
  const double off = std::abs(dot(other.position - point.position, point.normal));
  const double allowed = 4.0 * job.pixel_angle * point.distance;
  const double cosine = dot(point.normal, other.normal);
  if (off >= allowed || cosine <= 0.8) return 0.0;
  return (1.0 - off / allowed) * (cosine - 0.8) / 0.2;
}

/// Averages light over 5 x 5 pixels of the same surface; the outer ring counts half, so that each
/// of the sixteen phases counts the same.
Light smoothed_light(const Job& job, const Film& film, int row, int column) {
  const SurfacePoint& point = film.points[film.at(row, column)];
  Light sum;
  double total = 0.0;
  for (int dr = -2; dr <= 2; ++dr) {
    for (int dc = -2; dc <= 2; ++dc) {
      const int r = row + dr;
      const int c = column + dc;
      if (r < 0 || r >= film.height || c < 0 || c >= film.width) continue;
      const double ring = (std::abs(dr) == 2 ? 0.5 : 1.0) * (std::abs(dc) == 2 ? 0.5 : 1.0);
      const double weight = ring * kinship(job, point, film.points[film.at(r, c)]);
      const Light& light = film.lights[film.at(r, c)];
      sum.key += weight * light.key;
      sum.sky += weight * light.sky;
      sum.open += weight * light.open;
      total += weight;
    }
  }
  if (total <= 0.0) return film.lights[film.at(row, column)];
  return {sum.key / total, sum.sky / total, sum.open / total};
}

void smooth_lights(const Job& job, Film& film) {
  std::vector<Light> smooth;
  grow(smooth, film.lights.size(), job.watch);
  for_pixels(job, "light", film, [&](int row, int column) {
    const std::size_t i = film.at(row, column);
    if (film.points[i].seen != Seen::background) smooth[i] = smoothed_light(job, film, row, column);
  });
  film.lights = std::move(smooth);
}

Vec3 color_of(const Job& job, const SurfacePoint& point, const Light& light, double y) {
  const Vec3 behind = backdrop(1.0 - y);
  switch (point.seen) {
    case Seen::background:
      return behind;
    case Seen::ground:
      return shade_ground(job.studio, behind, light);
    case Seen::clay:
      break;
  }
  const Vec3 point_mm = job.size_mm * point.position + job.center_mm;
  const double darkness = job.options.darkness ? job.options.darkness(point_mm) : 0.0;
  const std::vector<Vec3>& colors = job.options.colors;
  assert(colors.empty() || point.triangle < colors.size());
  const Vec3& albedo = colors.empty() ? kClayColor : colors[point.triangle];
  return shade_clay(job.studio, point, light, normalized(job.camera.eye - point.position), albedo,
                    darkness);
}

/// True where one ray through the middle does not tell the pixel's colour.
bool is_edge(const Job& job, const Film& film, int row, int column) {
  const std::vector<Vec3>& colors = job.options.colors;
  const SurfacePoint& point = film.points[film.at(row, column)];
  for (int r = std::max(0, row - 1); r <= std::min(film.height - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(film.width - 1, column + 1); ++c) {
      const SurfacePoint& other = film.points[film.at(r, c)];
      if (other.seen != point.seen) return true;
      if (point.seen != Seen::clay) continue;
      if (dot(point.normal, other.normal) < kSameNormal) return true;
      if (kinship(job, point, other) <= 0.0) return true;
      if (!colors.empty() && colors[point.triangle] != colors[other.triangle]) return true;
    }
  }
  return false;
}

/// Light for a point that was met between pixel middles: from the neighbour that fits best, or
/// gathered there where none does (a thing smaller than a pixel).
Light borrowed_light(const Job& job, const Film& film, int row, int column,
                     const SurfacePoint& point, int phase) {
  double best = 0.0;
  std::size_t from = 0;
  for (int r = std::max(0, row - 1); r <= std::min(film.height - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(film.width - 1, column + 1); ++c) {
      const double fit = kinship(job, point, film.points[film.at(r, c)]);
      if (fit <= best) continue;
      best = fit;
      from = film.at(r, c);
    }
  }
  return best > 0.0 ? film.lights[from] : gather_light(job.scene, job.studio, point, phase);
}

Vec3 edge_color(const Job& job, const Film& film, int row, int column) {
  const int n = job.options.samples;
  Vec3 sum;
  for (int i = 0; i < n * n; ++i) {
    const int across = i % n;
    const int down = i / n;
    const double x = (column + (across + 0.5) / n) / film.width;
    const double y = (row + (down + 0.5) / n) / film.height;
    const SurfacePoint point =
        trace_camera_ray(job.scene, job.studio, job.camera.eye, job.camera.ray(x, y));
    const Light light = point.seen == Seen::background
                            ? Light{}
                            : borrowed_light(job, film, row, column, point, i % 16);
    sum += color_of(job, point, light, y);
  }
  return sum / (n * n);
}

/// Linear light to 8-bit sRGB, highlights rolled off above 0.8. `dither`, -0.5 to 0.5, keeps the
/// backdrop's slow gradient from showing steps.
std::uint8_t encode(double linear, double dither) {
  const double x = linear < 0.8 ? linear : 0.8 + 0.2 * (1.0 - std::exp((0.8 - linear) / 0.2));
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * s + dither, 0.0, 255.0)));
}

Image develop(const Job& job, const Film& film) {
  Image image{film.width, film.height, {}};
  grow(image.rgb, 3 * film.points.size(), job.watch);
  for_pixels(job, "picture", film, [&](int row, int column) {
    const std::size_t i = film.at(row, column);
    const bool split = job.options.samples > 1 && is_edge(job, film, row, column);
    const Vec3 color =
        split ? edge_color(job, film, row, column)
              : color_of(job, film.points[i], film.lights[i], (row + 0.5) / film.height);
    const double dither = (phase_of(row, column) - 7.5) / 16.0;
    for (std::size_t a = 0; a < 3; ++a) image.rgb[3 * i + a] = encode(color[a], dither);
  });
  return image;
}

/// The mesh about the origin with a diagonal of 1, so that the ray tracer's floats serve any size.
Result<TriangleMesh> unit_sized(const TriangleMesh& mesh) {
  TriangleMesh unit = mesh;
  const Box3 box = bounds(mesh);
  const double size = length(box.size());
  if (!(size > 0.0)) {
    return Error{ErrorKind::bad_input,
                 "the mesh to render has all vertices in one point; give one that has a surface"};
  }
  for (Vec3& p : unit.positions) p = (p - box.center()) / size;
  return unit;
}

Result<Image> render_checked(const TriangleMesh& mesh_mm, const RenderOptions& options,
                             const Progress& progress) {
  Watch watch(progress);
  auto unit = unit_sized(mesh_mm);
  if (!unit) return unit.error();
  const TriangleMesh& mesh = unit.value();
  auto scene =
      RayScene::build(mesh, [&](double fraction) { return watch.goes_on("tree", fraction); });
  if (!scene) return scene.error();
  const Box3 box = bounds(mesh_mm);
  const Camera camera = frame(framed_points(mesh, options, box), bounds(mesh).center(), options);
  const Studio studio = studio_for(mesh, options, camera);
  const Job job{scene.value(),
                studio,
                camera,
                options,
                2.0 * camera.tan_y / options.height,
                box.center(),
                length(box.size()),
                watch};
  Film film = trace_middles(job);
  if (!watch.is_stopped()) smooth_lights(job, film);
  Image image;
  if (!watch.is_stopped()) image = develop(job, film);
  if (!watch.is_stopped()) return image;
  return Error{ErrorKind::interrupted, "interrupted; no picture was made"};
}

}  // namespace

Result<Image> render(const TriangleMesh& mesh_mm, const RenderOptions& options,
                     const Progress& progress) {
  if (auto valid = validate(mesh_mm, options); !valid) return valid.error();
  try {
    return render_checked(mesh_mm, options, progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory,
                 "no memory left to render a picture of " + std::to_string(options.width) + " x " +
                     std::to_string(options.height) + " pixels; choose a smaller size"};
  }
}

}  // namespace argil
