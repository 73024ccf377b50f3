// SPDX-License-Identifier: GPL-3.0-or-later
// Carves a groove into a ball and writes its surface, using only the installed package.
#include <cstdio>
#include <utility>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"

namespace {

argil::Stroke groove() {
  argil::Stroke stroke;
  stroke.tool.action = argil::Action::carve;
  stroke.tool.radii_mm = {2.0, 2.0, 2.0};
  stroke.samples.resize(2);
  stroke.samples[0].position_mm = {-6.0, 0.0, 10.0};
  stroke.samples[1].position_mm = {6.0, 0.0, 10.0};
  stroke.samples[1].time_s = 1.0;
  return stroke;
}

int complain(const argil::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  argil::ClayOptions options;
  options.voxel_mm = 0.5;
  auto made = argil::Clay::ball(10.0, options);
  if (!made) return complain(made.error());
  argil::Clay clay = std::move(made).value();
  const double whole_mm3 = argil::signed_volume(argil::extract_surface(clay));

  const auto carved = clay.apply(groove());
  if (!carved) return complain(carved.error());
  const argil::TriangleMesh mesh = argil::extract_surface(clay);
  const double left_mm3 = argil::signed_volume(mesh);

  if (argc > 1) {
    const auto written = argil::io::write_mesh(argv[1], mesh);
    if (!written) return complain(written.error());
  }
  std::printf("triangles %zu\nvolume_mm3 %.3f of %.3f\n", mesh.triangles.size(), left_mm3,
              whole_mm3);
  return !mesh.triangles.empty() && left_mm3 < whole_mm3 ? 0 : 1;
}
