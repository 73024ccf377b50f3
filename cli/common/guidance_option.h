// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/haptics/servo/guidance.h"

#include "common/options.h"

namespace argil::cli {

/// What the command line says of guidance.
struct GuidanceChoice {
  std::size_t kind = 0;  ///< of GuidanceKind
  std::filesystem::path path;
  double stiffness_n_per_m = haptics::GuidanceOptions().stiffness_n_per_m;
  double most_force_n = haptics::GuidanceOptions().most_force_n;
};

/// --guide, --path, --guide-stiffness and --guide-force. The names --guidance, --guidance-stiffness
/// and --guidance-force, and the words dha and iha for direct and indirect, mean the same.
void add_guidance_options(CLI::App& command, GuidanceChoice& choice);

/// With the path read, in the frame that its file has; none where none was asked for.
///
/// Errors  bad_input where only one of --guide and --path was given; as io::read_path.
Result<haptics::GuidanceOptions> guidance_of(const GuidanceChoice& choice);

}  // namespace argil::cli
