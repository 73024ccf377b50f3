// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/feel_options.h"

#include <algorithm>
#include <array>
#include <string>

#include "common/output.h"

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

/// A message in the words of the options instead of the library's.
std::string in_options(std::string message) {
  constexpr std::array<std::array<const char*, 2>, 6> kWords{
      {{"contact_passive", "CONTACT of --mix-passive"},
       {"viscosity_passive", "DRAG of --mix-passive"},
       {"contact_active", "CONTACT of --mix-active"},
       {"viscosity_active", "DRAG of --mix-active"},
       {"lambda_mm", "--filter-lambda"},
       {"gain", "--filter"}}};
  for (const auto& [ours, theirs] : kWords) {
    const std::string word = ours;
    for (std::size_t at = message.find(word); at != std::string::npos;
         at = message.find(word, at + std::string(theirs).size())) {
      message.replace(at, word.size(), theirs);
    }
  }
  return message;
}

}  // namespace

std::optional<PositionFilterOptions> FeelChoice::filter() const {
  if (filter_gain == 0.0) return std::nullopt;
  return PositionFilterOptions{filter_gain, filter_lambda_mm};
}

haptics::DampingKind FeelChoice::damping_kind() const {
  return damping == 0 ? haptics::DampingKind::fixed : haptics::DampingKind::adaptive;
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

Result<void> check_feel_ranges(const FeelChoice& choice) {
  // Also the lambda of a filter that is off: it is one of the options.
  const double gain = choice.filter_gain == 0.0 ? 1.0 : choice.filter_gain;
  const PositionFilterOptions filter{gain, choice.filter_lambda_mm};
  if (auto good = haptics::validate(filter); !good) {
    return Error{ErrorKind::bad_input, in_options(good.error().message)};
  }
  if (auto good = haptics::validate(choice.mix); !good) {
    return Error{ErrorKind::bad_input, in_options(good.error().message)};
  }
  if (choice.mix_ramp_s >= 0.0 && choice.mix_ramp_s <= ModeBlend::kMostRampS) return {};
  return Error{ErrorKind::bad_input, "--mix-ramp is " + number(choice.mix_ramp_s) +
                                         "; must be 0 to " + number(ModeBlend::kMostRampS)};
}

void check_feel(const FeelChoice& choice) {
  const auto good = haptics::validate(choice.mix);
  if (!good) throw CLI::ValidationError(in_options(good.error().message));
}

}  // namespace argil::cli
