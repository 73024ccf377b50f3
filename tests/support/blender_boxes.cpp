// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/blender_boxes.h"

#include <sstream>

#include <gtest/gtest.h>

#include "argil/engine/surface.h"

#include "support/clients.h"

namespace argil::test {

std::map<std::string, Box3> blender_boxes(const std::filesystem::path& project) {
  const ProgramRun run = run_program({"blender", "-b", "--factory-startup", "-noaudio", "--python",
                                      "tests/support/blender_boxes.py", "--", project.string()});
  std::map<std::string, Box3> boxes;
  std::istringstream lines(run.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.rfind(": ");
    if (end == std::string::npos || line.find("/surface_") == std::string::npos) continue;
    std::istringstream numbers(line.substr(end + 2));
    Box3 box;
    numbers >> box.min.x >> box.min.y >> box.min.z >> box.max.x >> box.max.y >> box.max.z;
    if (numbers) boxes[line.substr(0, end)] = box;
  }
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_FALSE(boxes.empty()) << run.output;
  return boxes;
}

Box3 placed_surface(const Sculpture& sculpture, std::size_t piece) {
  const Placement& placement = sculpture.look(piece).placement;
  Box3 box;
  for (const Vec3& point : extract_surface(sculpture.clay(piece)).positions)
    box.include(placed(placement, point));
  return box;
}

}  // namespace argil::test
