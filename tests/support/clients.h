// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::test {

/// Whether a program of that name is found on the PATH.
bool has_program(const std::string& name);

/// What a run of a program left behind.
struct ProgramRun {
  int status = -1;     ///< exit status; -1 when it was killed or did not start
  std::string output;  ///< stdout and stderr
};
ProgramRun run_program(const std::vector<std::string>& words);

/// What admesh finds to fix in an STL, one line each as it prints them; empty when nothing.
std::vector<std::string> admesh_complaints(const std::filesystem::path& stl);

/// What `prusa-slicer --info` says about a mesh file, over all objects in it.
struct SlicerInfo {
  Vec3 size_mm;  ///< of one object; of several, 2.9 gives each about its own middle
  int objects = 0;
  std::int64_t facets = 0;
  int parts = 0;  ///< shells
  double volume_mm3 = 0.0;
  /// Not manifold, or a line about open edges or anything it repaired; empty when all is well.
  std::vector<std::string> complaints;
};
SlicerInfo slicer_info(const std::filesystem::path& mesh);

/// The size of all objects of a mesh file as they stand in PrusaSlicer; zero when it took none.
Vec3 slicer_size_mm(const std::filesystem::path& mesh);

/// Slices a mesh with the default printer, in the middle of a bed of 500 x 500 mm. Its error,
/// warning and repair lines, or that it made no G-code; empty when all went well.
std::vector<std::string> slicing_complaints(const std::filesystem::path& mesh);

/// Where Khronos' glTF validator, an npm package, is when it is installed.
std::filesystem::path gltf_validator();

/// Its errors and warnings about a GLB.
std::vector<std::string> gltf_complaints(const std::filesystem::path& glb);

}  // namespace argil::test

/// Skips the test, naming the program, when it is not installed.
#define ARGIL_CLIENT_OR_SKIP(program)       \
  if (!::argil::test::has_program(program)) \
  GTEST_SKIP() << "client " << (program) << " is not installed; ./tests/run.sh installs it"
