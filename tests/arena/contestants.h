// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "argil/core/triangle_mesh.h"

namespace argil::arena {

/// What a program made of a broken mesh.
struct Attempt {
  std::optional<TriangleMesh> mesh;  ///< none where it wrote none
  int status = 0;                    ///< exit status
  /// It says where something is wrong: a place in its answer or in what it complains of.
  bool names_a_place = false;
  bool crashed = false;  ///< ended by a signal
  bool hung = false;     ///< killed for taking too long
  double wall_s = 0.0;
  double cpu_s = 0.0;
  std::string said;  ///< its last line, where it ended with another status than 0
};

/// How long a run may take, in CPU time: a busy machine takes nothing from it.
inline constexpr double kPatienceS = 31.0;

/// A program that repairs meshes.
struct Contestant {
  const char* name;
  const char* program;  ///< that must be on the PATH; "" for our own
  /// `broken`: a PLY. The folder is its own and empty but for that.
  Attempt (*run)(const std::filesystem::path& folder, const std::filesystem::path& broken);
};

/// argil, admesh, blender, prusaslicer, cgal.
std::span<const Contestant> contestants();

/// The subcommand that CGAL's pipeline runs as, in a child of this program.
inline constexpr const char* kCgalCommand = "cgal-repair";
int run_cgal_repair(const std::filesystem::path& broken, const std::filesystem::path& repaired);

}  // namespace argil::arena
