// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a run of the lab with gnuplot.
#include <cassert>
#include <sstream>

#include "common/gnuplot.h"
#include "lab/lab.h"

namespace argil::cli::lab {
namespace {

namespace fs = std::filesystem;
using haptics::ServoTick;

constexpr const char* kAxes[] = {"x", "y", "z"};

std::string data_text(const std::vector<ServoTick>& ticks) {
  std::ostringstream text;
  for (const ServoTick& tick : ticks) {
    // Until the device is ready its position means nothing.
    if (!tick.is_ready) continue;
    text << tick.time_s;
    for (const Vec3& v : {tick.position_mm, tick.force_n}) {
      text << ' ' << v.x << ' ' << v.y << ' ' << v.z;
    }
    text << ' ' << length(tick.force_n) << '\n';
  }
  return text.str();
}

std::string lab_plot_head(const LabOptions& options, int height) {
  std::ostringstream text;
  text << "set terminal svg size 1100," << height << " font 'Helvetica,14' background 'white'\n"
       << "set output 'run.svg'\nset grid lc '#dddddd'\nunset key\n"
       << "title = \"" << options.scene << ", " << haptics::hand_model(kHands[options.hand]).name
       << " hand, " << (options.coupling == 0 ? "direct" : "indirect") << ", " << options.rate_hz
       << " Hz, " << options.delay_ticks << " tick" << (options.delay_ticks == 1 ? "" : "s")
       << " of delay"
       << (options.guidance.kind == haptics::GuidanceKind::none
               ? std::string()
               : std::string(", guided: ") + haptics::guidance_name(options.guidance.kind))
       << "\"\n";
  return text.str();
}

std::string over_position(const LabOptions& options, const LabScene& scene) {
  const std::size_t column = scene.axis + 2;
  const std::string axis = kAxes[scene.axis];
  std::ostringstream text;
  text << lab_plot_head(options, 460) << "set multiplot layout 1,2 title title\n"
       << "set xlabel '" << axis << " / mm'\nset ylabel 'force in " << axis << " / N'\n"
       << "plot 'run.dat' using " << column << ":" << column + 3
       << " with dots lc '#1b6ca8', '' using " << column << ":" << column + 3
       << " with lines lw 0.7 lc '#1b6ca8'\n"
       << "set xlabel 'time / s'\nset ylabel '" << axis << " / mm'\n"
       << "plot 'run.dat' using 1:" << column << " with lines lw 1.4 lc '#c0392b'\n"
       << "unset multiplot\n";
  return text.str();
}

std::string over_time(const LabOptions& options, const LabScene& scene) {
  const std::string axis = kAxes[scene.axis];
  std::ostringstream text;
  text << lab_plot_head(options, 420) << "set title title\nset xlabel 'time / s'\nset ylabel '"
       << axis << " / mm'\nset xrange [1.4:3.4]\nplot 'run.dat' using 1:" << scene.axis + 2
       << " with lines lw 1.6 lc '#c0392b'\n";
  return text.str();
}

/// The path that the hand was guided on; of one point a line of no length.
std::string path_block(const std::vector<Vec3>& path_mm, bool is_y_up) {
  assert(!path_mm.empty());
  std::ostringstream text;
  text << "$path << EOD\n";
  for (const Vec3& p : path_mm) {
    const Vec3 drawn = is_y_up ? Vec3{p.z, p.x, p.y} : p;
    text << drawn.x << ' ' << drawn.y << ' ' << drawn.z << '\n';
  }
  text << "EOD\n";
  return text.str();
}

std::string over_object(const LabOptions& options, const LabScene& scene) {
  std::ostringstream text;
  text << lab_plot_head(options, 520) << "set multiplot layout 1,2 title title\n"
       << (scene.is_y_up
               ? "set xlabel 'z / mm'\nset ylabel 'x / mm'\nset zlabel 'y / mm'\nset view "
                 "62,128,1.2\n"
               : "set xlabel 'x / mm'\nset ylabel 'y / mm'\nset zlabel 'z / mm'\nset view 62,38\n")
       << "set view equal xyz\nset xyplane relative 0\n"
       << "set autoscale fix\nset xtics autofreq\nset ytics autofreq\nset ztics autofreq\n"
       << "set tics font ',10'\n";
  const bool has_path = !options.guidance.path_mm.empty();
  if (has_path) text << path_block(guidance_for(options, scene).path_mm, scene.is_y_up);
  if (scene.object.empty()) {
    text << "splot ";
  } else {
    text << "set parametric\nset urange [0:pi]\nset vrange [0:2*pi]\nset isosamples 25,33\n"
         << scene.object << " with lines lw 0.5 lc '#9dbfd8', ";
  }
  if (has_path) text << "$path with lines lw 2 dt 2 lc '#222222', ";
  text << "'run.dat' using " << (scene.is_y_up ? "4:2:3" : "2:3:4")
       << " with lines lw 2 lc '#c0392b'\n"
       << "unset parametric\nset autoscale\nset xtics auto\nset ytics "
          "auto\n"
       << "set xlabel 'time / s'\nset ylabel '|force| / N'\n"
       << "plot 'run.dat' using 1:8 with lines lw 1.2 lc '#1b6ca8'\nunset multiplot\n";
  return text.str();
}

}  // namespace

Result<void> draw_run(const fs::path& picture, const LabOptions& options, const LabScene& scene,
                      const std::vector<ServoTick>& ticks) {
  assert(scene.axis < std::size(kAxes) && options.hand < kHands.size());
  const std::string script =
      scene.figure == Figure::force_over_position  ? over_position(options, scene)
      : scene.figure == Figure::position_over_time ? over_time(options, scene)
                                                   : over_object(options, scene);
  return draw_plot(picture, script, data_text(ticks));
}

}  // namespace argil::cli::lab
