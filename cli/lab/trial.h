// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/simulation/tracking_hand.h"

#include "common/command.h"
#include "common/falcon_options.h"
#include "common/served_clay.h"

namespace argil::cli::lab {

/// What a hand is asked to do in a trial of the study.
enum class TrialTask {
  dock,    ///< come to a point and stay there; without force, and drawn to it
  groove,  ///< go along the slider's groove; without force, and with it
  bump,    ///< find the click's ball in the groove, blindfolded
  path,    ///< follow a curve on clay; unguided, and guided in the three ways
};
inline constexpr std::array kTrialTasks{"dock", "groove", "bump", "path"};
const char* trial_task_name(TrialTask task) noexcept;

/// So many that the hands together tell halves of what they do apart from chance.
inline constexpr int kUsualRepeats = 10;
/// What a person has the patience for: a quarter of an hour.
inline constexpr int kUsualPersonRepeats = 3;

/// What the command line chose for `argil lab trial`.
struct TrialOptions {
  int seed = 1;
  int repeats = 0;         ///< of each task, condition and hand; 0: kUsualRepeats, or of a person
                           ///< kUsualPersonRepeats
  std::size_t task = 0;    ///< 0 all, else of kTrialTasks, counted from 1
  bool has_hand = false;   ///< only `hand`; else all four
  std::size_t hand = 2;    ///< of kHands
  bool is_falcon = false;  ///< a person at a real one, instead
  FalconChoice falcon;
  bool is_quiet = false;
  std::filesystem::path output;  ///< CSV; "": none
  std::filesystem::path plot;    ///< SVG; "": none
};

/// One trial, before it is run.
struct Trial {
  TrialTask task = TrialTask::dock;
  std::string condition;    ///< "free" or "force"; of paths the name of a GuidanceKind
  std::size_t hand = 0;     ///< of kHands; of a person nothing
  int repeat = 0;           ///< counted from 1
  std::uint64_t place = 0;  ///< seed of where the target is and of how the hand strays: the same of
                            ///< all conditions of a task, hand and repeat, which can be compared,
                            ///< and of no others
};

/// What came of it. A trial that ran out of time counts with what it had come to.
struct TrialResult {
  Trial trial;
  bool has_started =
      false;             ///< else nobody came to its start within 30 s, and nothing was measured
  bool is_done = false;  ///< within kTrialS, and of bump within kBumpMm of it
  double time_s = 0.0;   ///< from the start until it was done
  /// Of dock: from the point, where it was held. Of groove and path: off it, root mean square. Of
  /// bump: from its middle, along the groove.
  double error_mm = 0.0;
  double effort_n = 0.0;   ///< mean of the device's force, the clay's or the groove's with it
  double worked_mj = 0.0;  ///< by the hand against it
  double aid_n = 0.0;      ///< the same of guidance alone
  double aid_mj = 0.0;
};

/// A person or a hand gives up after that.
inline constexpr double kTrialS = 15.0;
/// From the bump's middle: as far as it stands out of its groove.
inline constexpr double kBumpMm = 10.0;

/// SplitMix64's step: seeds that differ by one give numbers that have nothing in common.
std::uint64_t mixed(std::uint64_t seed) noexcept;

/// The first is what the others are held against.
std::vector<std::string> trial_conditions(TrialTask task);

/// All trials in the order in which they are run: shuffled by the seed.
std::vector<Trial> trials_of(const TrialOptions& options);

/// Where the trial is and when it is over: a scene, what a simulated hand does, and how the ticks
/// are judged.
struct TrialSetup {
  std::unique_ptr<haptics::ForceScene> scene;   ///< what is touched; null: the clay's
  std::unique_ptr<ServedClay> clay;             ///< of path
  std::unique_ptr<haptics::ForceScene> guided;  ///< over scene or clay, where there is guidance
  std::vector<haptics::HandKey> plan;
  haptics::TrackingHandOptions hand;
  std::vector<Vec3> goal_mm;  ///< of dock the point; else a line from its start to its end
  Vec3 normal;             ///< of the surface that a line lies on, how deep being no error; 0: none
  double bump_x_mm = 0.0;  ///< of bump
  bool is_blindfolded = false;
  std::string told;  ///< to a person: what to do

  haptics::ForceScene& felt() noexcept {
    return guided ? *guided : clay ? static_cast<haptics::ForceScene&>(clay->scene()) : *scene;
  }
};

/// `clay`: that of all paths, which none works; must outlive the setup.
TrialSetup set_up(const Trial& trial, Clay& clay);
/// The clay of the paths.
Result<Clay> trial_clay();
/// What a person feels between two trials: nothing.
std::unique_ptr<haptics::ForceScene> nothing_to_feel();

/// Judges a trial tick by tick.
class TrialJudge {
 public:
  TrialJudge(const Trial& trial, const TrialSetup& setup) : trial_(trial), setup_(setup) {}

  /// False once it is over: done, or out of time.
  bool take(const haptics::ServoTick& tick);
  TrialResult result() const;
  /// From the tool to where it should be, for who cannot see it.
  Vec3 to_goal_mm() const noexcept { return to_goal_mm_; }

 private:
  bool is_at_end(const haptics::ServoTick& tick);
  void count_force(const haptics::ServoTick& tick);
  void add(const haptics::ServoTick& tick);

  const Trial& trial_;
  const TrialSetup& setup_;
  Vec3 to_goal_mm_;
  bool has_started_ = false;
  double start_s_ = 0.0;
  double now_s_ = 0.0;
  double near_since_s_ = -1.0;
  bool is_over_ = false;
  bool is_done_ = false;
  Vec3 last_mm_;
  Vec3 last_force_n_;
  Vec3 last_aid_n_;
  double error_sum_ = 0.0;  ///< of squares, or of distances while it is held
  double force_sum_ = 0.0;
  double worked_mj_ = 0.0;
  double aid_sum_ = 0.0;
  double aid_worked_mj_ = 0.0;
  std::size_t errors_ = 0;
  std::size_t ticks_ = 0;
};

/// What is done with the trials so far, after each.
using KeepTrials = std::function<Result<void>(const std::vector<TrialResult>&)>;

/// Runs all of them: simulated hands on virtual time, or a person at a real Falcon.
/// Errors  interrupted; device; as Clay::block; of `keep`.
Result<std::vector<TrialResult>> run_trials(const TrialOptions& options, const KeepTrials& keep,
                                            const Progress& progress);

/// The file of -o: a line for each trial, in the order in which they were run.
std::string trial_csv(const TrialOptions& options, const std::vector<TrialResult>& results);
/// Medians and quartiles for each task, condition and hand, and of all hands; and for each
/// condition by how much it differs from the task's first in the same places, with median_interval.
Json trial_json(const TrialOptions& options, const std::vector<TrialResult>& results);
std::string trial_text(const Json& json);
/// Errors  as draw_plot.
Result<void> draw_trials(const std::filesystem::path& picture, const Json& json);

}  // namespace argil::cli::lab
