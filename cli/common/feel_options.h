// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/servo/adaptive_damping.h"
#include "argil/haptics/servo/position_filter.h"

#include "common/options.h"

namespace argil::cli {

/// What the command line says of eq. 3 to 8 of Blanch et al. 2004, how contact and drag are mixed
/// and positions filtered, and of section 3.4.2 of the Falcon report, how a contact is damped.
struct FeelChoice {
  std::size_t damping = 0;   ///< of haptics::DampingKind
  double filter_gain = 0.0;  ///< 0: no filter
  double filter_lambda_mm = haptics::PositionFilterOptions().lambda_mm;
  haptics::ForceMix mix;
  double mix_ramp_s = haptics::ModeBlend::kUsualRampS;

  bool operator==(const FeelChoice&) const = default;

  /// The filter; none where it was not asked for.
  std::optional<haptics::PositionFilterOptions> filter() const;
  haptics::DampingKind damping_kind() const;
  bool has_usual_mix() const;
  /// Whether all of it is in its range, as check_feel and the options hold it.
  bool is_in_range() const;
};

/// --filter and --filter-lambda.
void add_filter_options(CLI::App& command, FeelChoice& choice);

/// --damping fixed|adaptive.
void add_damping_option(CLI::App& command, FeelChoice& choice);

/// --mix-passive, --mix-active and --mix-ramp, which are of clay: `clay`, when given, is needed.
void add_mix_options(CLI::App& command, FeelChoice& choice, CLI::Option* clay = nullptr);

/// What the options must be together, once all are read. Throws CLI::ValidationError.
void check_feel(const FeelChoice& choice);

}  // namespace argil::cli
