// SPDX-License-Identifier: GPL-3.0-or-later
// Gnuplot scripts that carry their data, so that a chart can be drawn again without measuring.
#include "chart/sheet.h"

#include <cassert>

#include "common/output.h"

namespace argil::evaluation {

std::string sheet_head(const Sheet& sheet) {
  assert(sheet.title.find('\'') == std::string::npos);  // both stand between single quotes
  assert(sheet.subtitle.find('\'') == std::string::npos);
  const std::string name = sheet.name;
  return "# Made by 'argil chart " + name.substr(0, name.find('_')) +
         "'; run gnuplot on it in its folder.\n"
         "set encoding utf8\nset terminal svg noenhanced size " +
         std::to_string(sheet.width) + "," + std::to_string(sheet.height) +
         " font 'DejaVu Sans,12' background rgb 'white'\nset output '" + sheet.name +
         ".svg'\nset grid lc rgb '#e4e4e4' lw 1\nset border 3 lc rgb '#808080'\n"
         "set tics nomirror textcolor rgb '#404040'\nset format x '%g'\nset format y '%g'\n"
         "set multiplot\nset label 1 '" +
         sheet.title + "' at screen 0.03,0.965 font ',16'\nset label 2 '" + sheet.subtitle +
         "' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'\n";
}

Script finished(const Sheet& sheet, const std::string& text) {
  const std::string name = sheet.name;
  return {name + ".gp", name + ".svg", sheet_head(sheet) + text + "unset multiplot\n"};
}

std::string panel_head(const PanelGrid& grid, std::size_t i, const std::string& title) {
  assert(i < grid.columns * grid.rows);
  const auto real = [](std::size_t n) { return static_cast<double>(n); };
  const double width =
      (grid.right - grid.left - grid.gap_x * real(grid.columns - 1)) / real(grid.columns);
  const double height =
      (grid.top - grid.bottom - grid.gap_y * real(grid.rows - 1)) / real(grid.rows);
  const double left = grid.left + real(i % grid.columns) * (width + grid.gap_x);
  const double top = grid.top - real(i / grid.columns) * (height + grid.gap_y);
  // The sheet's own labels are drawn with the first panel; later ones would draw them again.
  std::string text = i == 1 ? "unset label 1\nunset label 2\n" : "";
  text += "set lmargin at screen " + cli::number(left) + "\nset rmargin at screen " +
          cli::number(left + width) + "\nset tmargin at screen " + cli::number(top) +
          "\nset bmargin at screen " + cli::number(top - height) + "\n";
  return text + "set title '" + title + "' font ',13' offset 0,-0.5\n";
}

void PlotLines::add(const std::string& points, const std::string& style, const std::string& title) {
  if (points.empty()) return;
  // A data block of gnuplot. One plot command names all of them: a second would begin a new plot.
  const std::string name = "$d" + std::to_string(count_++);
  blocks_.append(name).append(" << EOD\n").append(points).append("EOD\n");
  plots_ += (count_ == 1 ? "plot " : ", ") + name + " with " + style +
            (title.empty() ? " notitle" : " title '" + title + "'");
}

void KeyStrip::add(const std::string& style, const std::string& title) {
  // NaN draws nothing, and still has its entry in the key.
  plots_ += (plots_.empty() ? "plot [0:1][0:1] NaN with " : ", NaN with ") + style + " title '" +
            title + "'";
}

std::string KeyStrip::text() const {
  return "unset label 1\nunset label 2\nunset logscale\nunset border\nunset tics\nunset xlabel\n"
         "unset ylabel\nunset title\nset lmargin at screen 0.03\nset rmargin at screen 0.98\n"
         "set tmargin at screen " +
         cli::number(top_) + "\nset bmargin at screen 0\nset key center top horizontal maxcols " +
         std::to_string(columns_) + " Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'\n" +
         plots_ + "\n";
}

std::vector<double> grown_by(double factor, double first, double last) {
  std::vector<double> values;
  double value = first;
  while (value <= last) {
    values.push_back(value);
    value *= factor;
  }
  return values;
}

std::string point_text(double x, double y) { return cli::number(x) + " " + cli::number(y) + "\n"; }

}  // namespace argil::evaluation
