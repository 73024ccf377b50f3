// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the trials of a study: simulated hands on virtual time, or a person at a real Falcon.
#include "lab/trial.h"

#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

#include <unistd.h>

#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "common/hand_option.h"
#include "common/output.h"
#include "lab/tick_relay.h"

namespace argil::cli::lab {
namespace {

using haptics::ServoTick;

constexpr double kTrialTickS = 1e-3;
constexpr std::chrono::milliseconds kTrialLook{10};

haptics::ServoOptions trial_servo() {
  haptics::ServoOptions servo;
  servo.period_s = kTrialTickS;
  return servo;
}

/// Lets a simulated hand see what came of it, steps the clay, and ends the trial.
class TrialObserver final : public haptics::ServoObserver {
 public:
  TrialObserver(haptics::TrackingHand& hand, ServedClay* clay, TrialJudge& judge)
      : hand_(hand), clay_(clay), judge_(judge) {}
  void after_tick(const ServoTick& tick) override {
    hand_.see(tick);
    if (clay_ != nullptr && worked) worked = clay_->after_tick(tick.time_s);
    if (!judge_.take(tick) || !worked) is_over = true;
  }
  std::atomic<bool> is_over = false;
  Result<void> worked;  ///< the clay's first error

 private:
  haptics::TrackingHand& hand_;
  ServedClay* clay_;
  TrialJudge& judge_;
};

Result<TrialResult> run_simulated(const Trial& trial, Clay& clay) {
  const haptics::FalconModel model;
  TrialSetup setup = set_up(trial, clay);
  haptics::TrackingHand hand(setup.plan, setup.hand);
  haptics::SimFalcon device(model, haptics::hand_model(kHands[trial.hand]), hand);
  haptics::Servo servo(device, setup.felt(), trial_servo());
  TrialJudge judge(trial, setup);
  TrialObserver observer(hand, setup.clay.get(), judge);
  haptics::VirtualClock clock;
  haptics::run_servo(servo, clock, 4.0 * kTrialS, observer.is_over, &observer);
  if (!observer.worked) return observer.worked.error();
  return judge.result();
}

/// A servo on a real device, whose ticks the main thread looks at until it has seen enough.
Result<void> feel_until(haptics::Device& device, haptics::ForceScene& scene,
                        const Progress& progress, double part,
                        const std::function<bool(const ServoTick&)>& goes_on) {
  haptics::Servo servo(device, scene, trial_servo());
  TickRelay relay;
  haptics::ServoThread thread(servo, &relay);
  std::vector<ServoTick> ticks;
  for (std::size_t seen = 0;; std::this_thread::sleep_for(kTrialLook)) {
    relay.move_to(ticks);
    for (; seen < ticks.size(); ++seen) {
      if (!goes_on(ticks[seen])) return {};
    }
    if (relay.dropped() > 0) {
      return Error{ErrorKind::internal,
                   "the trial lost ticks and cannot be judged; close other programs"};
    }
    if (auto* falcon = dynamic_cast<haptics::FalconDevice*>(&device)) {
      const haptics::FalconStatus& status = falcon->look();
      if (status.state == haptics::FalconState::fault) return haptics::falcon_error(status.fault);
    }
    if (!progress("trial", part)) {
      return Error{ErrorKind::interrupted, "interrupted"};
    }
  }
}

/// Until the grip's button was pressed and let go.
Result<void> await_button(haptics::Device& device, const Progress& progress, double part) {
  const auto nothing = nothing_to_feel();
  bool was_pressed = false;
  return feel_until(device, *nothing, progress, part, [&](const ServoTick& tick) {
    const bool is_pressed = (tick.buttons & 1U) != 0;
    const bool goes_on = is_pressed || !was_pressed;
    was_pressed = was_pressed || is_pressed;
    return goes_on;
  });
}

/// How far the grip is from where it should be, for a person without a picture.
void show_goal(const TrialSetup& setup, const TrialJudge& judge, const TrialOptions& options,
               const ServoTick& tick) {
  if (options.is_quiet || setup.is_blindfolded || tick.number % 100 != 0) return;
  if (::isatty(STDERR_FILENO) != 1) return;
  const Vec3 go = judge.to_goal_mm();
  std::fprintf(stderr, "\r  go x %+6.1f  y %+6.1f  z %+6.1f mm \033[K", go.x, go.y, go.z);
}

Result<TrialResult> run_person(const TrialOptions& options, const Trial& trial, Clay& clay,
                               haptics::Device& device, const Progress& progress, double part) {
  TrialSetup setup = set_up(trial, clay);
  std::fprintf(stderr, "argil: %s; press the grip's button to begin\n", setup.told.c_str());
  if (auto begun = await_button(device, progress, part); !begun) return begun.error();
  if (setup.clay) {
    if (auto started = setup.clay->start(); !started) return started.error();
  }
  TrialJudge judge(trial, setup);
  const auto felt = feel_until(device, setup.felt(), progress, part, [&](const ServoTick& tick) {
    show_goal(setup, judge, options, tick);
    return judge.take(tick);
  });
  if (setup.clay) {
    if (auto stopped = setup.clay->stop(); felt && !stopped) return stopped.error();
  }
  if (!felt) return felt.error();
  return judge.result();
}

}  // namespace

std::uint64_t mixed(std::uint64_t z) noexcept {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

std::vector<std::string> trial_conditions(TrialTask task) {
  switch (task) {
    case TrialTask::dock:
    case TrialTask::groove:
      return {"free", "force"};
    case TrialTask::bump:
      return {"force"};
    case TrialTask::path:
      break;
  }
  return {"none", "direct", "indirect", "hybrid"};
}

namespace {

/// Those of one task under one condition, by each hand and repeat, behind the others.
void add_trials(const TrialOptions& options, std::size_t task, const std::string& condition,
                std::vector<Trial>& trials) {
  const auto seed = static_cast<std::uint64_t>(options.seed);
  const std::size_t hands = options.is_falcon || options.has_hand ? 1 : kHands.size();
  for (std::size_t hand = 0; hand < hands; ++hand) {
    for (int repeat = 1; repeat <= options.repeats; ++repeat) {
      Trial trial{static_cast<TrialTask>(task), condition, hand, repeat, 0};
      if (options.has_hand) trial.hand = options.hand;
      // One condition is held against another in the same place, by a hand that strays alike.
      // Nothing else is the same, so that there are as many places as there are such pairs.
      trial.place = mixed(mixed(mixed(seed) + 1000U * task + trial.hand) +
                          static_cast<std::uint64_t>(repeat));
      trials.push_back(std::move(trial));
    }
  }
}

}  // namespace

std::vector<Trial> trials_of(const TrialOptions& options) {
  assert(options.repeats >= 1 && options.hand < kHands.size());
  std::vector<Trial> trials;
  for (std::size_t task = 0; task < kTrialTasks.size(); ++task) {
    if (options.task != 0 && options.task != task + 1) continue;
    for (const std::string& condition : trial_conditions(static_cast<TrialTask>(task))) {
      add_trials(options, task, condition, trials);
    }
  }
  // R. Durstenfeld's shuffle, since std::shuffle may differ from library to library.
  auto random = static_cast<std::uint64_t>(options.seed);
  for (std::size_t n = trials.size(); n > 1; --n) {
    random = mixed(random);
    std::swap(trials[n - 1], trials[static_cast<std::size_t>(random % n)]);
  }
  return trials;
}

Result<std::vector<TrialResult>> run_trials(const TrialOptions& options, const KeepTrials& keep,
                                            const Progress& progress) {
  auto clay = trial_clay();
  if (!clay) return clay.error();
  std::unique_ptr<haptics::Device> device;
  if (options.is_falcon) {
    auto opened = open_homed_falcon(options.falcon, options.is_quiet, progress);
    if (!opened) return opened.error();
    device = std::move(opened).value();
  }
  const std::vector<Trial> trials = trials_of(options);
  std::vector<TrialResult> results;
  for (const Trial& trial : trials) {
    const double part = static_cast<double>(results.size()) / static_cast<double>(trials.size());
    if (!progress("trials", part)) {
      return Error{ErrorKind::interrupted, "interrupted"};
    }
    auto result = device ? run_person(options, trial, clay.value(), *device, progress, part)
                         : run_simulated(trial, clay.value());
    if (!result) return result.error();
    results.push_back(std::move(result).value());
    if (auto kept = keep(results); !kept) return kept.error();
  }
  return results;
}

}  // namespace argil::cli::lab
