// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/feel_options.h"

#include <algorithm>
#include <string>

namespace argil::cli {
namespace {

using haptics::ForceMix;
using haptics::ModeBlend;
using haptics::PositionFilterOptions;

/// CONTACT,DRAG of one mode.
void read_weights(const std::string& option, const std::string& text, double& contact,
                  double& drag) {
  const std::size_t comma = std::min(text.find(','), text.size());
  contact = parse_number("CONTACT of " + option + " CONTACT,DRAG", text.substr(0, comma),
                         {ForceMix::kLeastContact, ForceMix::kMost});
  drag = parse_number("DRAG of " + option + " CONTACT,DRAG",
                      text.substr(std::min(comma + 1, text.size())), {0.0, ForceMix::kMost});
}

CLI::Option* add_weights(CLI::App& command, const std::string& name, double& contact, double& drag,
                         const std::string& help) {
  return command
      .add_option_function<std::string>(
          name,
          [name, &contact, &drag](const std::string& text) {
            read_weights(name, text, contact, drag);
          },
          help)
      ->type_name("CONTACT,DRAG");
}

}  // namespace

std::optional<PositionFilterOptions> FeelChoice::filter() const {
  if (filter_gain == 0.0) return std::nullopt;
  return PositionFilterOptions{filter_gain, filter_lambda_mm};
}

haptics::DampingKind FeelChoice::damping_kind() const {
  return damping == 0 ? haptics::DampingKind::fixed : haptics::DampingKind::adaptive;
}

bool FeelChoice::has_usual_mix() const {
  return mix == ForceMix() && mix_ramp_s == ModeBlend::kUsualRampS;
}

bool FeelChoice::is_in_range() const {
  // Also the lambda of a filter that is off: it is one of the options.
  const double gain = filter_gain == 0.0 ? 1.0 : filter_gain;
  return damping <= 1 && haptics::validate(PositionFilterOptions{gain, filter_lambda_mm}).ok() &&
         haptics::validate(mix).ok() && mix_ramp_s >= 0.0 && mix_ramp_s <= ModeBlend::kMostRampS;
}

void add_filter_options(CLI::App& command, FeelChoice& choice) {
  CLI::Option* filter = add_number(
      command, "--filter", choice.filter_gain, {PositionFilterOptions::kLeastGain, 1.0},
      "filter positions by eq. 6-8 of INRIA report 5090, with this tau for 1 ms; default none");
  add_number(command, "--filter-lambda", choice.filter_lambda_mm,
             {0.0, PositionFilterOptions::kMostLambdaMm, true}, "its lambda in mm; default 0.3")
      ->needs(filter);
}

void add_damping_option(CLI::App& command, FeelChoice& choice) {
  add_choice(command, "--damping", choice.damping, {"fixed", "adaptive"},
             "of a contact: what it has, or more of it while the handle swings there (3.4.2, "
             "3.4.3); default fixed");
}

void add_mix_options(CLI::App& command, FeelChoice& choice, CLI::Option* clay) {
  CLI::Option* const options[] = {
      add_weights(command, "--mix-passive", choice.mix.contact_passive,
                  choice.mix.viscosity_passive,
                  "alpha and beta of eq. 3, touching the clay; default 1,0.3"),
      add_weights(command, "--mix-active", choice.mix.contact_active, choice.mix.viscosity_active,
                  "alpha and beta of eq. 4, working it; default 0.3,1"),
      add_number(command, "--mix-ramp", choice.mix_ramp_s, {0.0, ModeBlend::kMostRampS},
                 "how long p of eq. 5 takes from 0 to 1, in s; default 0.1")};
  if (clay == nullptr) return;
  for (CLI::Option* option : options) option->needs(clay);
}

void check_feel(const FeelChoice& choice) {
  const auto good = haptics::validate(choice.mix);
  if (good) return;
  throw CLI::ValidationError("--mix-passive and --mix-active: " + good.error().message);
}

}  // namespace argil::cli
