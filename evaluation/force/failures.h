// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace argil::evaluation {

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

/// Where the definition of the volume force fails, one panel each (docs/forces.md): a field that
/// saturates, a thin sheet, unit gradients on averaged rough matter, a sharp ball on the lattice,
/// work on a closed loop. About two seconds.
std::vector<Panel> force_failures();

}  // namespace argil::evaluation
