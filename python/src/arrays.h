// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/vec3.h"

#include "binding.h"
#include "errors.h"

namespace argil::python {

/// Rows of doubles as NumPy keeps them: read in place where they are contiguous doubles, else
/// copied once.
using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

static_assert(sizeof(Vec3) == 3 * sizeof(double));

inline std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t n = 0; n < array.ndim(); ++n) {
    text += (n == 0 ? "" : ", ") + std::to_string(array.shape(n));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// Throws unless `rows` is (any number, `columns`).
inline void check_columns(const char* name, const Rows& rows, py::ssize_t columns) {
  if (rows.ndim() == 2 && rows.shape(1) == columns) return;
  raise_bad_input(std::string(name) + " has the shape " + shape_text(rows) + "; give one of (n, " +
                  std::to_string(columns) + ")");
}

/// An (n, 3) array as points, in place. Valid as long as the array.
inline std::span<const Vec3> points_of(const char* name, const Rows& rows) {
  check_columns(name, rows, 3);
  return {reinterpret_cast<const Vec3*>(rows.data()), static_cast<std::size_t>(rows.shape(0))};
}

/// Throws where a point is not finite, with its place.
inline void check_finite(const char* name, std::span<const Vec3> points) {
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!is_finite(points[n])) {
      raise_bad_input(std::string(name) + "[" + std::to_string(n) +
                      "] is not finite; take such rows out");
    }
  }
}

/// A new (n, 3) array, and its rows to be written.
inline std::pair<py::array_t<double>, std::span<Vec3>> new_points(std::size_t count) {
  py::array_t<double> array({static_cast<py::ssize_t>(count), py::ssize_t{3}});
  return {array, std::span<Vec3>(reinterpret_cast<Vec3*>(array.mutable_data()), count)};
}

/// A new array of one number for each.
template <class T>
std::pair<py::array_t<T>, std::span<T>> new_numbers(std::size_t count) {
  py::array_t<T> array(static_cast<py::ssize_t>(count));
  return {array, std::span<T>(array.mutable_data(), count)};
}

/// Memory of an object of Python as an array that cannot be written and keeps the object alive.
template <class T>
py::array_t<T> view_of(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array_t<T> array(std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

}  // namespace argil::python
