// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace argil::arena {
namespace {

struct Cell {
  int runs = 0;
  int right = 0;
  int silent = 0;
};

template <class... Values>
std::string line(const char* format, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return std::string(text) + "\n";
}

/// From orange by white to blue, which all eyes tell apart.
std::string color_of(double share) {
  const auto mix = [&](int low, int middle, int high) {
    const double part = 2.0 * share;
    return static_cast<int>(std::lround(part < 1.0 ? low + part * (middle - low)
                                                   : middle + (part - 1.0) * (high - middle)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", mix(0xe6, 0xf7, 0x56), mix(0x9f, 0xf5, 0xa4),
                mix(0x45, 0xee, 0xd4));
  return text;
}

std::string shown(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  static const std::map<std::string, std::string> kNames{
      {"argil", "Argil"}, {"blender", "Blender"}, {"prusaslicer", "PrusaSlicer"}, {"cgal", "CGAL"}};
  const auto found = kNames.find(name);
  return found == kNames.end() ? name : found->second;
}

/// In the middle at (x, y), one cell wide and high.
std::string drawn_cell(int x, int y, const Cell& cell) {
  const double share = cell.runs == 0 ? 0.0 : static_cast<double>(cell.right) / cell.runs;
  std::string text = line(
      "set object rectangle center %d,%d size 0.94,0.86 fc rgb '%s' fs solid border lc rgb '%s'", x,
      y, color_of(share).c_str(), color_of(share).c_str());
  text += line("set label '%.0f' at %d,%d center font ',12'", 100.0 * share, x, y);
  if (cell.silent > 0) {
    text += line("set label '%d silent' at %g,%d right font ',8' textcolor rgb '#7a2020'",
                 cell.silent, x + 0.44, y);
  }
  return text;
}

}  // namespace

std::string picture_script(const std::vector<Row>& rows, const std::string& name) {
  std::vector<std::string> kinds;
  std::vector<std::string> programs;
  std::map<std::pair<std::string, std::string>, Cell> cells;
  const auto add = [](std::vector<std::string>& names, const std::string& one) {
    if (std::find(names.begin(), names.end(), one) == names.end()) names.push_back(one);
  };
  for (const Row& row : rows) {
    add(kinds, row.kind);
    add(programs, row.contestant);
    for (const std::string& kind : {row.kind, std::string("all")}) {
      Cell& cell = cells[{kind, row.contestant}];
      ++cell.runs;
      cell.right += row.is_right() ? 1 : 0;
      cell.silent += row.is_silent() ? 1 : 0;
    }
  }
  std::sort(kinds.begin(), kinds.end());
  kinds.emplace_back("all");
  const auto height = static_cast<int>(kinds.size());
  const auto width = static_cast<int>(programs.size());
  std::string text =
      "# Made by argil_arena; run gnuplot on it in its folder.\n"
      "set encoding utf8\n";
  text +=
      line("set terminal svg noenhanced size 900,%d font 'DejaVu Sans,12' background rgb 'white'",
           130 + 27 * height);
  text += line("set output '%s.svg'", name.c_str());
  text += "unset border\nunset tics\nunset key\n";
  text += line("set lmargin at screen 0.2\nset rmargin at screen 0.985");
  text += line("set tmargin at screen %g\nset bmargin at screen 0.01",
               1.0 - 118.0 / (130 + 27 * height));
  text += line("set xrange [0.5:%g]\nset yrange [%g:0.5]", width + 0.5, height + 0.5);
  text += line("set label 'Repaired: valid, and still what it was' at screen 0.02,%g font ',16'",
               1.0 - 28.0 / (130 + 27 * height));
  text += line(
      "set label 'Percent of the meshes of each kind of damage. Silent: ended well and said "
      "nothing, "
      "but lost or invented' at screen 0.02,%g font ',11' textcolor rgb '#606060'",
      1.0 - 54.0 / (130 + 27 * height));
  text += line(
      "set label 'more than 0.5 %% of the size, 1 %% of the volume, or a part.' at screen 0.02,%g "
      "font "
      "',11' textcolor rgb '#606060'",
      1.0 - 72.0 / (130 + 27 * height));
  for (int x = 0; x < width; ++x) {
    const std::string& program = programs[static_cast<std::size_t>(x)];
    text += line("set label '%s' at %d,0.2 center font ',13'", shown(program).c_str(), x + 1);
    for (int y = 0; y < height; ++y) {
      text += drawn_cell(x + 1, y + 1, cells[{kinds[static_cast<std::size_t>(y)], program}]);
    }
  }
  for (int y = 0; y < height; ++y) {
    text += line("set label '%s' at 0.45,%d right font ',12'",
                 shown(kinds[static_cast<std::size_t>(y)]).c_str(), y + 1);
  }
  return text + "plot NaN notitle\n";
}

}  // namespace argil::arena
