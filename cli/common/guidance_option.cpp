// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/guidance_option.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "argil/io/path_file.h"

#include "common/output.h"

namespace argil::cli {
namespace {

constexpr double kMostGuideNPerM = 500.0;
constexpr double kMostGuideN = 8.0;
static_assert(io::kMostPathPoints <= haptics::GuidanceOptions::kMostPoints);

/// Their place is that of GuidanceKind.
constexpr std::array kGuideNames{"none", "direct", "indirect", "hybrid"};
/// As section 4.3 of the Falcon report abbreviates two of them.
constexpr std::array kGuideShort{"none", "dha", "iha", "hybrid"};

void read_kind(const std::string& text, std::size_t& kind) {
  for (const auto& names : {kGuideNames, kGuideShort}) {
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) continue;
    kind = static_cast<std::size_t>(found - names.begin());
    return;
  }
  throw CLI::ValidationError("--guide is '" + text +
                             "'; must be one of none, direct, indirect, hybrid");
}

/// A number that had another name before.
struct RenamedNumber {
  std::string name;
  std::string former;
  std::string help;
  double GuidanceChoice::*target = nullptr;
  Range range;
};

void add_renamed(CLI::App& command, const RenamedNumber& number, GuidanceChoice& choice) {
  const auto read = [number, &choice](const std::string& text) {
    choice.*number.target = parse_number(number.name, text, number.range);
    choice.tuned_by = number.name;
  };
  command.add_option_function<std::string>(number.name + "," + number.former, read, number.help)
      ->type_name("NUMBER");
}

}  // namespace

void add_guidance_options(CLI::App& command, GuidanceChoice& choice) {
  command
      .add_option_function<std::string>(
          "--guide,--guidance",
          [&choice](const std::string& text) { read_kind(text, choice.kind); },
          "along a path: drawn to it (direct), pushed off it, to be resisted (indirect), or "
          "between "
          "the two by how well it is followed (hybrid); default none")
      ->type_name("none|direct|indirect|hybrid");
  add_file(command, "--path", choice.path, {".csv", ".txt", ".xyz", ".jsonl"},
           "that path: lines of x y z in mm, or the first stroke of a script (.jsonl)");
  add_renamed(command,
              {"--guide-stiffness",
               "--guidance-stiffness",
               "of the guidance in N/m; default 60",
               &GuidanceChoice::stiffness_n_per_m,
               {0.0, kMostGuideNPerM, true}},
              choice);
  add_renamed(command,
              {"--guide-force",
               "--guidance-force",
               "its most, in N; default 1.5",
               &GuidanceChoice::most_force_n,
               {0.0, kMostGuideN, true}},
              choice);
}

void check_guide(const GuidanceChoice& choice, bool can_draw) {
  const bool has_kind = choice.kind != 0;
  if (!has_kind && !choice.path.empty()) {
    throw CLI::ValidationError(
        "--path needs --guide direct, indirect or hybrid, which says how it is felt");
  }
  if (!has_kind && !choice.tuned_by.empty()) {
    throw CLI::ValidationError(choice.tuned_by +
                               " needs --guide direct, indirect or hybrid, which it is of");
  }
  if (has_kind && choice.path.empty() && !can_draw) {
    throw CLI::ValidationError(
        "--guide needs --path FILE, lines of x y z in mm or a script of strokes");
  }
}

std::string softened_words(double asked_n_per_m, double used_n_per_m) {
  if (used_n_per_m >= asked_n_per_m) return "";
  return "; " + number(used_n_per_m) + " N/m and not " + number(asked_n_per_m) +
         ", which rate, delay and filter do not allow";
}

Result<haptics::GuidanceOptions> guidance_of(const GuidanceChoice& choice) {
  haptics::GuidanceOptions guidance;
  guidance.kind = static_cast<haptics::GuidanceKind>(choice.kind);
  guidance.stiffness_n_per_m = choice.stiffness_n_per_m;
  guidance.most_force_n = choice.most_force_n;
  if (choice.path.empty()) return guidance;  // none, or drawn later
  if (auto there = check_input(choice.path); !there) return there.error();
  auto path = io::read_path(choice.path);
  if (!path) return path.error();
  guidance.path_mm = std::move(path).value();
  if (auto good = haptics::check_guidance(guidance); !good) return good.error();
  return guidance;
}

}  // namespace argil::cli
