// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

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
  std::string tuned_by;  ///< the last option that gave one of the two numbers; "" none did
};

/// --guide, --path, --guide-stiffness and --guide-force. The names --guidance, --guidance-stiffness
/// and --guidance-force, and the words dha and iha for direct and indirect, mean the same.
void add_guidance_options(CLI::App& command, GuidanceChoice& choice);

/// What the options must be together, once all are read: none without --guide, and a path, but
/// where one can be drawn. Throws CLI::ValidationError.
void check_guide(const GuidanceChoice& choice, bool can_draw = false);

/// With the path read, in the frame that its file has; none where none was asked for.
///
/// Errors  as io::read_path.
Result<haptics::GuidanceOptions> guidance_of(const GuidanceChoice& choice);

/// "; 28 N/m and not 500, which ..." where less stiffness was used than was asked for; else "".
std::string softened_words(double asked_n_per_m, double used_n_per_m);

}  // namespace argil::cli
