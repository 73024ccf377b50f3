// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "argil/haptics/analysis/slide_judgement.h"
#include "argil/haptics/servo/recording.h"
#include "argil/haptics/servo/servo_run.h"

#include "lab/lab.h"

namespace argil::cli::lab {

/// How a stroke went: from the button's press to its release.
struct LabStroke {
  haptics::SlideJudgement found;
  /// The most energy that the servo may give in it: what EnergyAccount pays in its time, 1 mJ saved
  /// up and what the device's own damping takes.
  double allowed_mj = 0.0;
  /// Of `found`, or `gives`.
  haptics::Verdict verdict = haptics::Verdict::quiet;
};

/// How a path was followed, by the tool, over the ticks in which a force was given.
struct LabFollowing {
  double error_mm = 0.0;           ///< of the tool from the path, root mean square
  double most_error_mm = 0.0;      ///< the greatest
  double effort_n = 0.0;           ///< of guidance as the device gave it, mean
  double worked_mj = 0.0;          ///< by the hand against it, as the servo counted
  double given_mj = 0.0;           ///< by it to the hand, less what the hand worked
  double stiffness_n_per_m = 0.0;  ///< that guidance had at the end
};

/// Units  path_mm: in the device's frame, at least one point. `account`: after the last tick.
LabFollowing following_of(const std::vector<haptics::ServoTick>& ticks,
                          const std::vector<Vec3>& path_mm, const haptics::GuidanceState& account);

/// What a run of the lab found.
struct LabRun {
  std::vector<haptics::ServoTick> ticks;
  haptics::HoldJudgement judgement;       ///< of the last second
  std::optional<LabStroke> stroke;        ///< the worst of those in which the hand worked the clay
  std::optional<LabFollowing> following;  ///< of a guided run
  Vec3 mean_position_mm;                  ///< over the last second
  bool has_lost_contact = false;          ///< it pressed something, and at the end nothing
  double needed_s = 0.0;                  ///< of an unfinished run: how long it had to be
  double most_given_mj = 0.0;             ///< most energy that the servo had given to the hand
  int delay_ticks = 1;                    ///< of the device that ran
  haptics::ServoRun servo;
  std::string priority;         ///< what a real-time run's threads were refused; "" otherwise
  std::uint64_t dropped = 0;    ///< ticks that were not kept; 0 of a run without an error
  std::uint64_t different = 0;  ///< ticks of a replay whose force differs
  std::uint64_t first_different = 0;
};

/// As the options ask: on virtual time or on the machine's clock; or a recording again, when there
/// is one, with the options that options_of found in it. Hears an interrupt at every moment: until
/// a real device has had its zero words by `progress`, and from then on wherever it is.
Result<LabRun> run_lab(const LabOptions& options, LabScene& scene,
                       const haptics::Recording* recording, const Progress& progress);

/// The options that a replay needs, as one line for a recording, and back.
std::string note_of(const LabOptions& options);
/// Errors  bad_input when the note is not the lab's, or of another scene than `options` names.
Result<LabOptions> options_of(const haptics::Recording& recording, const LabOptions& options);

/// The file of --device replay:FILE; "" for another device.
std::string replay_file(const LabOptions& options);

}  // namespace argil::cli::lab
