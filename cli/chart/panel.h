// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace argil::cli::chart {

/// A line of a chart.
struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

/// One pair of axes with its lines.
struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
};

}  // namespace argil::cli::chart
