// SPDX-License-Identifier: GPL-3.0-or-later
// Points and rays by the array.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <tbb/enumerable_thread_specific.h>

#include "argil/engine/field_sampler.h"
#include "argil/engine/pick.h"

#include "arrays.h"
#include "clay.h"
#include "pieces.h"

namespace argil::python {
namespace {

/// So many points are one piece of work, of a millisecond.
constexpr std::size_t kChunk = 4096;

/// Asks for every point by `ask(sampler, n)`, on all cores, each with a sampler of its own: one for
/// each piece would cost a fifth more.
template <class Ask>
Result<void> for_points(const Clay& clay, std::size_t count, const Progress& progress,
                        const Ask& ask) {
  tbb::enumerable_thread_specific<std::unique_ptr<FieldSampler>> samplers(
      [&clay] { return std::make_unique<FieldSampler>(clay); });
  return in_pieces("distances", count, kChunk, progress, [&](std::size_t begin, std::size_t end) {
    FieldSampler& sampler = *samplers.local();
    for (std::size_t n = begin; n < end; ++n) ask(sampler, n);
  });
}

py::array_t<double> distance(SharedClay& self, const Rows& points_mm) {
  const auto points = points_of("points", points_mm);
  check_finite("points", points);
  const auto [array, values] = new_numbers<double>(points.size());
  self.run([&, out = values](const Clay& clay, const Progress& progress) {
    return for_points(clay, points.size(), progress, [&](FieldSampler& sampler, std::size_t n) {
      out[n] = sampler.distance_mm(points[n]);
    });
  });
  return array;
}

py::tuple gradient(SharedClay& self, const Rows& points_mm) {
  const auto points = points_of("points", points_mm);
  check_finite("points", points);
  const auto [values, numbers] = new_numbers<double>(points.size());
  const auto [slopes, vectors] = new_points(points.size());
  self.run([&, out = numbers, slope = vectors](const Clay& clay, const Progress& progress) {
    return for_points(clay, points.size(), progress, [&](FieldSampler& sampler, std::size_t n) {
      const FieldValue value = sampler.value(points[n]);
      out[n] = value.distance_mm;
      slope[n] = value.gradient;
    });
  });
  return py::make_tuple(values, slopes);
}

py::array_t<double> mask(SharedClay& self, const Rows& points_mm) {
  const auto points = points_of("points", points_mm);
  check_finite("points", points);
  const auto [array, values] = new_numbers<double>(points.size());
  self.run([&, out = values](const Clay& clay, const Progress& progress) {
    return in_pieces("mask", points.size(), kChunk, progress,
                     [&](std::size_t begin, std::size_t end) {
                       for (std::size_t n = begin; n < end; ++n) out[n] = clay.mask_at(points[n]);
                     });
  });
  return array;
}

/// Where the picks go: a row for each ray.
struct PickRows {
  std::span<double> distances;
  std::span<Vec3> points;
  std::span<Vec3> normals;
  std::span<std::int32_t> levels;

  void set(std::size_t n, const std::optional<Pick>& pick) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    distances[n] = pick ? pick->distance_mm : std::numeric_limits<double>::infinity();
    points[n] = pick ? pick->point_mm : Vec3{kNone, kNone, kNone};
    normals[n] = pick ? pick->normal : Vec3{kNone, kNone, kNone};
    levels[n] = pick ? pick->level : -1;
  }
};

/// Every ray by `pick(ray)`; now and then `progress` may stop it.
template <class PickOne>
Result<void> pick_all(std::span<const Vec3> origins, std::span<const Vec3> directions,
                      const PickRows& rows, const Progress& progress, const PickOne& pick_one) {
  constexpr std::size_t kAskEvery = 1024;
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (n % kAskEvery == 0 &&
        !progress("pick", static_cast<double>(n) / static_cast<double>(origins.size()))) {
      return Error{ErrorKind::interrupted, "interrupted"};
    }
    const auto found = pick_one(Ray{origins[n], directions[n]});
    if (!found) {
      return Error{found.error().kind, "ray " + std::to_string(n) + ": " + found.error().message};
    }
    rows.set(n, found.value());
  }
  return {};
}

py::tuple pick(SharedClay& self, const Rows& origins_mm, const Rows& directions, bool is_exact) {
  const auto origins = points_of("origins", origins_mm);
  const auto toward = points_of("directions", directions);
  if (origins.size() != toward.size()) {
    raise_bad_input("there are " + std::to_string(origins.size()) + " origins and " +
                    std::to_string(toward.size()) + " directions; give as many of both");
  }
  const auto [distances, distance_rows] = new_numbers<double>(origins.size());
  const auto [points, point_rows] = new_points(origins.size());
  const auto [normals, normal_rows] = new_points(origins.size());
  const auto [levels, level_rows] = new_numbers<std::int32_t>(origins.size());
  const PickRows rows{distance_rows, point_rows, normal_rows, level_rows};
  if (is_exact) {
    self.run([&](const Clay& clay, const Progress& progress) {
      return pick_all(origins, toward, rows, progress,
                      [&](const Ray& ray) { return argil::pick(clay, ray); });
    });
  } else {
    self.pick([&](const DisplaySurface& surface, SurfacePicker& picker, const Progress& progress) {
      return pick_all(origins, toward, rows, progress,
                      [&](const Ray& ray) { return picker.pick(surface, ray); });
    });
  }
  return py::make_tuple(distances, points, normals, levels);
}

}  // namespace

void add_queries(py::class_<SharedClay, std::shared_ptr<SharedClay>>& clay) {
  clay.def("distance", &distance, py::arg("points"))
      .def("gradient", &gradient, py::arg("points"))
      .def("mask", &mask, py::arg("points"))
      .def("pick", &pick, py::arg("origins"), py::arg("directions"), py::arg("is_exact"));
}

}  // namespace argil::python
