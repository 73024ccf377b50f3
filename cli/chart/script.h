// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace argil::cli::chart {

/// A file that gnuplot makes a picture of.
struct Script {
  std::string name;     ///< "force_accuracy.gp"
  std::string picture;  ///< "force_accuracy.svg"
  std::string text;
};

}  // namespace argil::cli::chart
