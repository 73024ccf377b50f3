// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of a surface: its error against time and detail.
#include <array>
#include <functional>

#include "common/output.h"
#include "surface/rows.h"

namespace argil::evaluation {
namespace {

/// Colours that the colour-blind can tell apart.
struct MesherLook {
  Mesher mesher;
  const char* title;
  const char* style;
};
constexpr std::array kMesherLooks{MesherLook{Mesher::argil, "Argil, finest voxels everywhere",
                                             "linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072b2'"},
                                  MesherLook{Mesher::openvdb, "OpenVDB volumeToMesh",
                                             "linespoints pt 5 ps 0.8 lw 2 lc rgb '#e69f00'"},
                                  MesherLook{Mesher::blender, "Blender voxel remesh",
                                             "linespoints pt 11 ps 0.9 lw 2 lc rgb '#cc79a7'"},
                                  MesherLook{Mesher::adaptive, "Argil, the clay as it is kept",
                                             "linespoints pt 9 ps 0.9 lw 2 lc rgb '#009e73'"}};
constexpr const char* kRms = "linespoints pt 6 ps 0.6 lw 1.2 dt 2 lc rgb '#0072b2'";
constexpr const char* kRmsOpenvdb = "linespoints pt 4 ps 0.6 lw 1.2 dt 2 lc rgb '#e69f00'";
constexpr const char* kRmsBlender = "linespoints pt 10 ps 0.6 lw 1.2 dt 2 lc rgb '#cc79a7'";
constexpr const char* kFree = "linespoints pt 2 ps 0.7 lw 1.2 dt 3 lc rgb '#0072b2'";

using SurfaceValue = std::function<double(const SurfaceRow&)>;

std::string surface_curve(const std::vector<SurfaceRow>& rows, const char* scene, Mesher mesher,
                          const SurfaceValue& x, const SurfaceValue& y) {
  const auto of_scene = [&](const SurfaceRow& row) {
    return row.scene == scene && row.mesher == mesher;
  };
  return points_of(rows, of_scene, x, y);
}

double detail(const SurfaceRow& row) { return row.detail; }

std::string asked_line(const std::vector<SurfaceRow>& rows, const char* scene, double y) {
  return surface_curve(rows, scene, Mesher::argil, detail, [=](const SurfaceRow&) { return y; });
}

std::string time_panel(const std::vector<SurfaceRow>& rows, const char* scene) {
  PlotLines lines;
  for (const MesherLook& look : kMesherLooks) {
    lines.add(surface_curve(
                  rows, scene, look.mesher, [](const SurfaceRow& r) { return 1e-3 * r.cpu_us; },
                  [](const SurfaceRow& r) { return r.error_of_radius(); }),
              look.style);
  }
  return "set logscale xy\nset xrange [*:*]\nset yrange [*:*]\nset xtics 100\n"
         "set format x '%g'\nset format y '%.0e'\nset xlabel 'CPU time [ms]'\n"
         "set ylabel 'greatest error / R_curv'\n" +
         lines.text();
}

constexpr const char* kDetailAxis =
    "set xlabel 'R/h'\nset xrange [13:315]\nset xtics (16,32,64,128,256)\nset format y '%g'\n";

std::string error_panel(const std::vector<SurfaceRow>& rows, const char* scene) {
  PlotLines lines;
  const SurfaceValue greatest = [](const SurfaceRow& r) { return r.error_max; };
  const SurfaceValue rms = [](const SurfaceRow& r) { return r.error_rms; };
  for (const MesherLook& look : kMesherLooks) {
    lines.add(surface_curve(rows, scene, look.mesher, detail, greatest), look.style);
  }
  lines.add(surface_curve(rows, scene, Mesher::argil, detail, rms), kRms);
  lines.add(surface_curve(rows, scene, Mesher::openvdb, detail, rms), kRmsOpenvdb);
  lines.add(surface_curve(rows, scene, Mesher::blender, detail, rms), kRmsBlender);
  lines.add(surface_curve(rows, scene, Mesher::argil, detail,
                          [](const SurfaceRow& r) { return r.kind_error_max[0]; }),
            kFree);
  lines.add(asked_line(rows, scene, 0.5), kAskedStyle);
  return kDetailAxis + std::string("set ylabel 'error [h²/R_curv]'\n") + lines.text();
}

std::string cost_panel(const std::vector<SurfaceRow>& rows, const char* scene) {
  PlotLines lines;
  for (const MesherLook& look : kMesherLooks) {
    lines.add(surface_curve(rows, scene, look.mesher, detail,
                            [](const SurfaceRow& r) { return r.cpu_us_per_vertex(); }),
              look.style);
  }
  lines.add(asked_line(rows, scene, 0.6), kAskedStyle);
  return kDetailAxis + std::string("set yrange [0.05:100]\nset ylabel 'CPU time [µs / vertex]'\n") +
         lines.text();
}

std::string surface_legend() {
  KeyStrip key(0.125, 3);
  for (const MesherLook& look : kMesherLooks) key.add(look.style, look.title);
  key.add(kAskedStyle, "asked: 0.5 h²/R, 0.6 µs");
  key.add(kRms, "Argil, rms");
  key.add(kRmsOpenvdb, "OpenVDB, rms");
  key.add(kRmsBlender, "Blender, rms");
  key.add(kFree, "Argil, greatest on edges");
  return key.text();
}

}  // namespace

Script surface_script(const std::vector<SurfaceRow>& rows) {
  const Sheet sheet{
      "surface", 1280, 900, "The surface: error of its vertices against time",
      "Whole extraction, normals and welding included (OpenVDB makes no normals; of Blender "
      "the operator alone); R/h = 16 to 256; CPU time of all threads."};
  PanelGrid grid{3, 2, 0.075, 0.985, 0.87, 0.205, 0.075, 0.125};
  std::string text = "unset key\n";
  std::size_t at = 0;
  for (const char* scene : {"ball", "torus"}) {
    const std::string name = scene;
    text += panel_head(grid, at++, name + ": error against time") + time_panel(rows, scene);
    text += panel_head(grid, at++, name + ": error in h²/R_curv") + error_panel(rows, scene);
    text += panel_head(grid, at++, name + ": cost of a vertex") + cost_panel(rows, scene);
  }
  return finished(sheet, text + surface_legend());
}

}  // namespace argil::evaluation
