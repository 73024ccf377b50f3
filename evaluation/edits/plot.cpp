// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of edits: above, what a dab costs by how much it covers; below, time against accuracy.
#include "edits/plot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "common/output.h"

namespace argil::evaluation {
namespace {

/// A tool's marks; colours that the colour-blind can tell apart.
struct EditLook {
  Editor editor;
  const char* tool;  ///< "": every other of that editor
  const char* mark;
  const char* title;
};
constexpr std::array kEditLooks{
    EditLook{Editor::argil, "carve", "pt 6 ps 0.9 lc rgb '#0072b2'", "Argil: carve"},
    EditLook{Editor::argil, "inflate", "pt 4 ps 0.8 lc rgb '#56b4e9'", "Argil: inflate"},
    EditLook{Editor::argil, "", "pt 7 ps 0.8 lc rgb '#0072b2'", "Argil: add, and other brushes"},
    EditLook{Editor::plain, "", "pt 5 ps 0.8 lc rgb '#e69f00'", "Blender, the mesh as it is"},
    EditLook{Editor::dyntopo, "", "pt 9 ps 0.9 lc rgb '#009e73'", "Blender, dynamic topology"},
    EditLook{Editor::remesh, "", "pt 13 ps 1.1 lc rgb '#cc79a7'",
             "Blender, voxel remesher after each stroke"}};

const EditLook& look_of(const EditRow& row) {
  const auto is_its = [&](const EditLook& look) {
    return look.editor == row.editor && (*look.tool == '\0' || row.tool == look.tool);
  };
  const auto* found = std::find_if(kEditLooks.begin(), kEditLooks.end(), is_its);
  assert(found != kEditLooks.end());
  return *found;
}

/// Of a stroke, all included.
double stroke_ms_a_dab(const EditRow& row) { return row.times.stroke_wall_ms() / kLongDabs; }
/// What is plotted above. A remesher comes once a stroke, so that each dab has its share.
double dab_ms(const EditRow& row) {
  return row.editor == Editor::remesh ? stroke_ms_a_dab(row) : row.times.dab_wall_ms();
}
double mean_edit_error(const EditRow& row) { return row.error->to_finer.mean_mm / row.voxel_mm; }

/// The least and the greatest number of vertices of the balls.
struct Balls {
  double least = 0.0;
  double most = 0.0;
};
Balls balls_of(const std::vector<EditRow>& rows) {
  Balls balls;
  for (const EditRow& row : rows) {
    balls.least = balls.least == 0.0 ? row.vertices : std::min(balls.least, row.vertices);
    balls.most = std::max(balls.most, row.vertices);
  }
  return balls;
}

std::string time_panel(const std::vector<EditRow>& rows, Brush brush) {
  const Balls balls = balls_of(rows);
  PlotLines lines;
  for (const EditLook& look : kEditLooks) {
    for (const double vertices : std::set{balls.least, balls.most}) {
      const auto keep = [&](const EditRow& row) {
        // Too short to be timed: a logarithm has no place for it.
        return row.brush == brush && row.vertices == vertices && &look_of(row) == &look &&
               dab_ms(row) > 0.0;
      };
      const auto covered = [](const EditRow& row) {
        return static_cast<double>(row.covered_vertices);
      };
      const std::string line = vertices == balls.least ? "lw 2 " : "lw 1 dt 3 ";
      lines.add(points_of(rows, keep, covered, dab_ms), "linespoints " + line + look.mark);
    }
  }
  return lines.text();
}

std::string error_panel(const std::vector<EditRow>& rows, Brush brush) {
  PlotLines lines;
  for (const EditLook& look : kEditLooks) {
    const auto keep = [&](const EditRow& row) {
      return row.brush == brush && row.error && &look_of(row) == &look;
    };
    lines.add(points_of(rows, keep, stroke_ms_a_dab, mean_edit_error),
              std::string("linespoints lw 1 ") + look.mark);
  }
  return lines.text();
}

/// Of one figure over several rows, as "0.1 to 2.3"; "" of none.
class Range {
 public:
  void include(double value) {
    least_ = is_empty_ ? value : std::min(least_, value);
    most_ = is_empty_ ? value : std::max(most_, value);
    is_empty_ = false;
  }
  std::string text() const {
    return is_empty_ ? "" : two_digits(least_) + " to " + two_digits(most_);
  }

 private:
  /// More would differ from run to run.
  static std::string two_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return cli::number(std::strtod(text, nullptr));
  }

  double least_ = 0.0;
  double most_ = 0.0;
  bool is_empty_ = true;
};

/// How many times as long another editor takes as Argil for the same brush, ball and tool's size;
/// or the inverse. Of Argil's tools for drawing it is add.
template <class Keep, class Value>
Range ratios_to_argil(const std::vector<EditRow>& rows, const Keep& keep, const Value& value,
                      bool is_inverse) {
  Range range;
  for (const EditRow& ours : rows) {
    if (ours.editor != Editor::argil || *look_of(ours).tool != '\0') continue;
    for (const EditRow& other : rows) {
      const bool is_same = keep(other) && other.brush == ours.brush &&
                           other.vertices == ours.vertices && other.covered == ours.covered;
      if (!is_same || !(value(other) > 0.0) || !(value(ours) > 0.0)) continue;
      range.include(is_inverse ? value(ours) / value(other) : value(other) / value(ours));
    }
  }
  return range;
}

std::string not_ahead(const std::vector<EditRow>& rows) {
  std::string text = "Argil is not ahead of Blender on a mesh that stays as it is: a dab takes it";
  for (const Brush brush : kBrushes) {
    const auto keep = [&](const EditRow& row) {
      return row.editor == Editor::plain && row.brush == brush;
    };
    const std::string range = ratios_to_argil(rows, keep, dab_ms, true).text();
    if (range.empty()) continue;
    text += std::string(text.back() == 't' ? " " : ", ") + range + " (" + brush_name(brush) + ")";
  }
  return text + " times as long.";
}

std::string ahead(const std::vector<EditRow>& rows) {
  // Smoothing and grabbing do not refine the mesh.
  const auto refines = [](const EditRow& row) {
    return row.editor == Editor::dyntopo && row.brush == Brush::draw;
  };
  const auto remeshes = [](const EditRow& row) { return row.editor == Editor::remesh; };
  return "With dynamic topology Blender takes " +
         ratios_to_argil(rows, refines, dab_ms, false).text() +
         " times as long as Argil for a dab of drawing, with the voxel remesher " +
         ratios_to_argil(rows, remeshes, stroke_ms_a_dab, false).text() +
         " times for a stroke: above 1 Argil is ahead.";
}

std::string errors(const std::vector<EditRow>& rows) {
  std::string text = "Mean errors in voxels:";
  const auto add = [&](const char* name, Editor editor) {
    Range range;
    for (const EditRow& row : rows) {
      if (row.editor == editor && row.error) range.include(mean_edit_error(row));
    }
    if (range.text().empty()) return;
    text += std::string(text.back() == ':' ? " " : "; ") + name + " " + range.text();
  };
  add("Argil", Editor::argil);
  add("Blender on the mesh as it is", Editor::plain);
  add("with dynamic topology", Editor::dyntopo);
  add("with the remesher", Editor::remesh);
  return text + ".";
}

/// Where Argil is ahead and where it is not, as measured, a line each.
std::vector<std::string> caption_of(const std::vector<EditRow>& rows) {
  const auto is_rival = [](const EditRow& row) { return row.editor == Editor::plain; };
  if (std::none_of(rows.begin(), rows.end(), is_rival)) {
    return {"Blender is not here to compare with.", "", errors(rows)};
  }
  return {not_ahead(rows), ahead(rows), errors(rows)};
}

std::string caption_label(int number, const std::string& text, double y) {
  assert(text.find('\'') == std::string::npos);
  return "set label " + std::to_string(number) + " '" + text + "' at screen 0.03," +
         cli::number(y) + " font ',11' textcolor rgb '#606060'\n";
}

std::string count_of(double vertices) {
  return vertices < 1e5 ? cli::number(vertices) : cli::number(1e-6 * vertices) + " million";
}

std::string how_to_read(const std::vector<EditRow>& rows) {
  const Balls balls = balls_of(rows);
  return "Above: a ball of " + count_of(balls.least) + " vertices" +
         (balls.most > balls.least ? ", dotted of " + count_of(balls.most) : "") +
         ". Below: the whole stroke of " + std::to_string(kLongDabs) +
         " dabs, and its distance to the same stroke on edges a quarter as long; down and left is "
         "better.";
}

std::string edits_legend() {
  KeyStrip key(0.1, 3);
  for (const EditLook& look : kEditLooks) {
    key.add(std::string("linespoints lw 1.5 ") + look.mark, look.title);
  }
  return key.text();
}

}  // namespace

Script edits_script(const std::vector<EditRow>& rows) {
  const std::vector<std::string> caption = caption_of(rows);
  const Sheet sheet{"edits", 1280, 920,
                    "Strokes beside Blender: what they cost, and how exact they are", caption[0]};
  const PanelGrid grid{kBrushes.size(), 2, 0.065, 0.985, 0.795, 0.165, 0.055, 0.125};
  std::string text = caption_label(3, caption[1], 0.902) + caption_label(4, caption[2], 0.879) +
                     caption_label(5, how_to_read(rows), 0.856);
  text += "unset key\nset logscale xy\nset format y '%g'\nset yrange [*:*]\n";
  std::size_t at = 0;
  text += "set xlabel 'vertices under a dab'\nset format x '%.0s%c'\nset ylabel 'ms a dab'\n";
  for (const Brush brush : kBrushes) {
    text += panel_head(grid, at, brush_name(brush)) + time_panel(rows, brush);
    if (at++ == 0) text += "unset label 3\nunset label 4\nunset label 5\nunset ylabel\n";
  }
  text +=
      "set xlabel 'ms a dab, the whole stroke'\nset format x '%g'\n"
      "set ylabel 'mean error [voxels]'\n";
  for (const Brush brush : kBrushes) {
    text += panel_head(grid, at++, std::string(brush_name(brush)) + ": time and error") +
            error_panel(rows, brush) + "unset ylabel\n";
  }
  return finished(sheet, text + edits_legend());
}

}  // namespace argil::evaluation
