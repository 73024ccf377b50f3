// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/slice/gcode.h"

#include <cstdlib>
#include <optional>
#include <sstream>

namespace argil::arena {
namespace {

std::optional<double> number_after(const std::string& line, const std::string& letter) {
  const std::size_t at = line.find(letter);
  if (at == std::string::npos) return std::nullopt;
  return std::strtod(line.c_str() + at + letter.size(), nullptr);
}

}  // namespace

std::vector<PrintedLayer> printed_layers(const std::string& gcode) {
  std::vector<PrintedLayer> layers;
  std::istringstream in(gcode);
  Vec3 at;
  double extruded = 0.0;
  double width = 0.0;
  double z = 0.0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(";Z:")) z = number_after(line, ";Z:").value_or(z);
    if (line.starts_with(";WIDTH:")) width = number_after(line, ";WIDTH:").value_or(width);
    if (line.starts_with("G92")) extruded = number_after(line, " E").value_or(extruded);
    if (!line.starts_with("G1 ")) continue;
    const Vec3 to{number_after(line, " X").value_or(at.x), number_after(line, " Y").value_or(at.y),
                  z};
    const double now = number_after(line, " E").value_or(extruded);
    const bool is_move = to.x != at.x || to.y != at.y;
    if (is_move && now > extruded && z > 0.0) {
      if (layers.empty() || layers.back().z_mm != z) layers.push_back({z, {}});
      layers.back().beads.push_back({at, to, width});
    }
    extruded = now;
    at = to;
  }
  return layers;
}

}  // namespace argil::arena
