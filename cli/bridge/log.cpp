// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the bridge as CSV, its last two seconds in figures, and its picture.
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <ostream>
#include <sstream>

#include "bridge/bridge.h"
#include "common/gnuplot.h"

namespace argil::cli::bridge {
namespace {

namespace fs = std::filesystem;
using haptics::BridgeRow;

constexpr double kWindowS = 2.0;

/// The shortest text that reads back as the same number.
template <class Number>
void append(std::string& line, Number value) {
  std::array<char, 32> text{};
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  if (!line.empty()) line += ',';
  line.append(text.data(), static_cast<std::size_t>(end - text.data()));
}

void append(std::string& line, const Vec3& v) {
  append(line, v.x);
  append(line, v.y);
  append(line, v.z);
}

/// As gnuplot reads a file's name: what it may hold, a quote is said twice.
std::string gnuplot_quoted(const std::string& name) {
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? "''" : std::string(1, c);
  return text + "'";
}

/// Lines before the numbers.
int head_lines(const fs::path& log) { return std::ifstream(log).peek() == '#' ? 2 : 1; }

std::string log_script(const fs::path& log, const std::string& title) {
  std::ostringstream text;
  text << "set terminal svg noenhanced size 1100,820 font 'DejaVu Sans,12' background rgb 'white'\n"
       << "set output 'run.svg'\nset datafile separator ','\n"
       << "log = " << gnuplot_quoted(fs::absolute(log).string()) << "\n"
       << "head = " << head_lines(log) << "\n"
       << "set grid lc rgb '#e4e4e4'\nset key top right opaque\nset lmargin 10\nset rmargin 3\n"
       << "set multiplot layout 3,1 title \"" << title << "\"\n"
       << "set ylabel 'y / mm'\n"
       << "plot log using 2:4 skip head with lines lw 1.6 lc rgb '#0072b2' title 'handle', "
       << "'' using 2:($16 > 0 ? $21 : NaN) skip head with lines lw 1.2 lc rgb '#d55e00' title "
          "'proxy'\n"
       << "set ylabel 'force / N'\n"
       << "plot for [i=0:2] log using 2:(column(9 + i)) skip head with lines lw 1.4 title "
          "'force '.word('x y z', i + 1)\n"
       << "set ylabel 'share, contact'\nset yrange [-0.1:1.1]\nset xlabel 'time / s'\n"
       << "plot log using 2:14 skip head with lines lw 1.6 lc rgb '#009e73' title 'share felt', "
       << "'' using 2:16 skip head with lines lw 1 lc rgb '#808080' title 'contact'\n"
       << "unset multiplot\n";
  return text.str();
}

}  // namespace

void write_log_header(std::ostream& stream, const Json& scene) {
  if (!scene.is_null()) stream << "# " << scene.dump() << '\n';
  stream << "tick,time_s,x_mm,y_mm,z_mm,vx_mm_per_s,vy_mm_per_s,vz_mm_per_s,force_x_n,force_y_n,"
            "force_z_n,buttons,faults,share,age_s,contact,plane,stop,echo_time_s,"
            "proxy_x_mm,proxy_y_mm,proxy_z_mm,proxy_vx_mm_per_s,proxy_vy_mm_per_s,"
            "proxy_vz_mm_per_s,plane_x_mm,plane_y_mm,plane_z_mm,normal_x,normal_y,normal_z,"
            "direct_x_n,direct_y_n,direct_z_n,distance_mm,felt_x_mm,felt_y_mm,felt_z_mm\n";
}

void write_log_row(std::ostream& stream, const BridgeRow& row) {
  std::string line;
  append(line, row.tick.number);
  append(line, row.tick.time_s);
  append(line, row.tick.position_mm);
  append(line, row.tick.velocity_mm_per_s);
  append(line, row.tick.force_n);
  append(line, row.tick.buttons);
  append(line, row.tick.faults);
  append(line, row.share);
  // -1 until something was heard: not every reader of CSV takes inf.
  append(line, std::isfinite(row.age_s) ? row.age_s : -1.0);
  const std::uint32_t flags = row.has_proxy ? row.proxy.header.flags : 0;
  for (const auto flag : {haptics::kBridgeContact, haptics::kBridgePlane, haptics::kBridgeStop}) {
    append(line, static_cast<int>((flags & flag) != 0));
  }
  append(line, 1e-9 * static_cast<double>(row.proxy.echo_time_ns));
  for (const Vec3& v :
       {row.proxy.position_mm, row.proxy.velocity_mm_per_s, row.proxy.plane_point_mm,
        row.proxy.plane_normal, row.proxy.direct_force_n}) {
    append(line, v);
  }
  append(line, row.proxy.distance_mm);
  append(line, row.tick.felt_mm);
  stream << line << '\n';
}

BridgeWindow::BridgeWindow(double period_s)
    : most_rows_(static_cast<std::size_t>(std::lround(kWindowS / period_s))) {
  assert(period_s > 0.0 && most_rows_ > 0);
}

void BridgeWindow::add(const BridgeRow& row) {
  most_force_n_ = std::max(most_force_n_, length(row.tick.force_n));
  rows_.push_back(row);
  // The start, with its ramp and its tap, is not what a hold is judged by.
  if (rows_.size() > most_rows_) rows_.pop_front();
}

BridgeWindow::Summary BridgeWindow::summary() const {
  Summary found;
  found.most_force_n = most_force_n_;
  if (rows_.empty()) return found;
  const auto count = static_cast<double>(rows_.size());
  bool has_force = false;
  for (const BridgeRow& row : rows_) {
    found.force_mean_n += row.tick.force_n / count;
    if ((row.proxy.header.flags & haptics::kBridgePlane) != 0) {
      found.depth_mm +=
          dot(row.proxy.plane_normal, row.proxy.plane_point_mm - row.tick.position_mm) / count;
    }
    const bool had_force = has_force;
    has_force = row.tick.force_n != Vec3{};
    // Counted where the force ends: a run that ends in contact has not lost it.
    if (had_force && !has_force) ++found.contact_breaks;
  }
  double square = 0.0;
  for (const BridgeRow& row : rows_) {
    const double off = length(row.tick.force_n - found.force_mean_n);
    found.force_deviation_n = std::max(found.force_deviation_n, off);
    square += off * off / count;
  }
  found.force_rms_n = std::sqrt(square);
  return found;
}

Result<void> draw_log(const fs::path& picture, const fs::path& log, const std::string& title) {
  return draw_plot(picture, log_script(log, title));
}

}  // namespace argil::cli::bridge
