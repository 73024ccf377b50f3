// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace argil::evaluation {

// What the charts of several panels are put together from: gnuplot scripts that carry their data.

/// A file that gnuplot makes a picture of.
struct Script {
  std::string name;     ///< "force_accuracy.gp"
  std::string picture;  ///< "force_accuracy.svg"
  std::string text;
};

/// Size in pixels, title and a line below it.
struct Sheet {
  const char* name;  ///< "stability_wall"
  int width;
  int height;
  std::string title;
  std::string subtitle;
};
std::string sheet_head(const Sheet& sheet);
Script finished(const Sheet& sheet, const std::string& text);

/// Where panels stand: fractions of the sheet, from its left and its bottom.
struct PanelGrid {
  std::size_t columns = 1;
  std::size_t rows = 1;
  double left = 0.07;
  double right = 0.98;
  double top = 0.84;
  double bottom = 0.09;
  double gap_x = 0.02;
  double gap_y = 0.1;
};
/// Margins of panel `i`, counted by rows and less than columns x rows, and its title.
std::string panel_head(const PanelGrid& grid, std::size_t i, const std::string& title);

/// One plot command, line by line, each with the block of its data.
class PlotLines {
 public:
  /// `points`: "x y" lines; nothing is added when empty. No `title`: not in the key.
  void add(const std::string& points, const std::string& style, const std::string& title = {});
  std::string text() const { return blocks_ + plots_ + "\n"; }

 private:
  std::string blocks_;
  std::string plots_;
  int count_ = 0;
};

/// A legend in a strip of its own across the sheet: gnuplot fits a key's columns to its panel.
class KeyStrip {
 public:
  /// `top`: where the strip ends, as a fraction of the sheet.
  KeyStrip(double top, int columns) : top_(top), columns_(columns) {}
  void add(const std::string& style, const std::string& title);
  std::string text() const;

 private:
  double top_;
  int columns_;
  std::string plots_;
};

/// Places along a logarithmic axis: `first` and on, each the one before times `factor` (> 1), up to
/// `last`.
std::vector<double> grown_by(double factor, double first, double last);

/// "x y" as a line.
std::string point_text(double x, double y);

/// The points of the rows that `keep` picks, in their order.
template <class Row, class Keep, class X, class Y>
std::string points_of(const std::vector<Row>& rows, const Keep& keep, const X& x, const Y& y) {
  std::string points;
  for (const Row& row : rows) {
    if (keep(row)) points += point_text(x(row), y(row));
  }
  return points;
}

/// How a line that says what was asked for looks.
inline constexpr const char* kAskedStyle = "lines lw 1.5 dt 2 lc rgb '#b00000'";

}  // namespace argil::evaluation
