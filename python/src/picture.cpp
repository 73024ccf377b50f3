// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures without a GPU or display, as pixels and as PNG.
#include "picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/engine/render.h"
#include "argil/io/png.h"

#include "arrays.h"
#include "convert.h"
#include "mesh.h"
#include "work.h"

namespace argil::python {
namespace {

/// Rows from the top, (height, width, 3). `colors`: of each triangle, linear light, or none.
py::array_t<std::uint8_t> render_mesh(const SharedMesh& mesh, int width, int height,
                                      py::handle toward, py::handle up, int samples,
                                      const std::optional<Rows>& colors) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.toward = vec3_of("toward", toward);
  options.up = vec3_of("up", up);
  options.samples = samples;
  if (colors) {
    const auto rows = points_of("colors", *colors);
    check_finite("colors", rows);
    if (rows.size() != mesh.mesh().triangles.size()) {
      raise_bad_input("there are " + std::to_string(rows.size()) + " colors and " +
                      std::to_string(mesh.mesh().triangles.size()) +
                      " triangles; give one for each");
    }
    options.colors.assign(rows.begin(), rows.end());
  }
  const Image image =
      run([&](const Progress& progress) { return render(mesh.mesh(), options, progress); });
  py::array_t<std::uint8_t> pixels({image.height, image.width, 3});
  std::copy(image.rgb.begin(), image.rgb.end(), pixels.mutable_data());
  return pixels;
}

py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style>& pixels) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) {
    raise_bad_input("pixels have the shape " + shape_text(pixels) + "; give (height, width, 3)");
  }
  Image image;
  image.height = static_cast<int>(pixels.shape(0));
  image.width = static_cast<int>(pixels.shape(1));
  image.rgb.assign(pixels.data(), pixels.data() + pixels.size());
  const std::vector<std::byte> packed =
      run([&](const Progress& progress) { return io::pack_png("picture", image, progress); });
  return {reinterpret_cast<const char*>(packed.data()), packed.size()};
}

}  // namespace

void add_pictures(py::module_& module) {
  module.def("render", &render_mesh, py::arg("mesh"), py::arg("width"), py::arg("height"),
             py::arg("toward"), py::arg("up"), py::arg("samples"), py::arg("colors"));
  module.def("png", &png_of, py::arg("pixels"));
}

}  // namespace argil::python
