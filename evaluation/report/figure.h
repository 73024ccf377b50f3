// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "chart/sheet.h"

namespace argil::evaluation {

/// A number that a report prints or implies, beside what a run here gives.
struct ReportNumber {
  std::string name;
  std::string unit;     ///< "" none
  std::string printed;  ///< by the report; "" where it gives none
  double ours = 0.0;
  std::string why;  ///< what the difference comes from; "" where there is none worth telling
};

/// A figure of one of the two reports, made again from a run.
struct ReportFigure {
  std::string title;    ///< with the report's own number for it
  std::string printed;  ///< what the report shows there
  std::string ours;     ///< what the picture here shows, and where it differs
  std::string command;  ///< that gives the same run alone; "" none
  std::vector<ReportNumber> numbers;
  Script script;
};
using ReportFigures = std::vector<ReportFigure>;

/// Adds what another part found, in its order.
inline void append(ReportFigures& figures, ReportFigures more) {
  for (ReportFigure& figure : more) figures.push_back(std::move(figure));
}

}  // namespace argil::evaluation
