// SPDX-License-Identifier: GPL-3.0-or-later
// Equations (3) to (8) of Blanch et al. 2004 through the rig: what a window with a device feels and
// shows, against the equations as they are printed.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/rig/rig.h"

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"
#include "support/scratch.h"

namespace argil::haptics {
namespace {

constexpr double kRadiusMm = 30.0;

/// Stands for the clay's thread: answers samples with windows of a ball that stays as it is.
class StillBall {
 public:
  explicit StillBall(HapticRig& rig)
      : rig_(rig), publisher_(rig.channel()), thread_([this] { run(); }) {}
  ~StillBall() {
    stop_ = true;
    thread_.join();
  }

 private:
  void run() {
    while (!stop_) {
      ToolSample sample;
      bool has_sample = false;
      while (rig_.ring().pop(sample)) has_sample = true;
      if (has_sample) {
        publisher_.publish(fields::ball(kRadiusMm), fields::ball_tool(4.0, sample.position_mm), 4.0,
                           sample.index, sample.time_s);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  HapticRig& rig_;
  fields::AnalyticPublisher publisher_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Waits for that tick; false when it does not come within many seconds, whatever the machine does.
bool has_ticked(HapticRig& rig, std::uint64_t ticks) {
  for (int n = 0; n < 30'000; ++n) {
    if (rig.look().tick.number >= ticks) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// A hand that shakes: the tool, which is seen, is at the filtered place, and that is near.
TEST(HapticRigFeel, ShowsTheToolAtTheFilteredPlaceAndNeverFartherThanLambda) {
  HapticRig rig;
  RigOptions options;
  options.scene = "workspace";  // nothing to feel
  options.position_filter = PositionFilterOptions{0.1, 2.0};
  ASSERT_TRUE(rig.start(options).ok());
  double widest_mm = 0.0;
  int looked = 0;
  // On a busy machine ticks come late, and the filter, which goes by time, is nearer: shaken
  // longer.
  for (std::uint64_t until = 20; until < 1500 || (widest_mm <= 0.5 && until < 30'000);
       until += 20) {
    rig.lead({{until % 40 == 0 ? 20.0 : -20.0, 0.0, 5.0}});
    ASSERT_TRUE(has_ticked(rig, until));
    const RigSnapshot& seen = rig.look();
    const double gap_mm = length(seen.tool_mm - seen.tick.position_mm);
    EXPECT_LT(gap_mm, options.position_filter->lambda_mm);
    EXPECT_LE(length(seen.tool_mm - seen.tick.felt_mm), 1e-12);
    widest_mm = std::max(widest_mm, gap_mm);
    ++looked;
  }
  EXPECT_GT(looked, 50);
  EXPECT_GT(widest_mm, 0.5) << "it filters";
  options.position_filter.reset();
  ASSERT_TRUE(rig.start(options).ok());
  ASSERT_TRUE(has_ticked(rig, 50));
  EXPECT_EQ(rig.look().tool_mm, rig.look().tick.position_mm);
}

/// Eq. 6 to 8 with the ticks that a recording has.
struct PrintedFilter {
  PositionFilterOptions options;
  bool has_start = false;
  Vec3 damped;
  double bound_mm = 0.0;  ///< of eq. 12, with the factor that it lacks

  Vec3 operator()(const Vec3& real, double elapsed_s) {
    if (!has_start) damped = real;
    has_start = true;
    const double tau = 1.0 - std::pow(1.0 - options.gain, 1e3 * elapsed_s);
    const Vec3 delta = real - damped;
    damped += tau * delta;
    bound_mm = (1.0 - tau) * options.lambda_mm;
    const double confidence = 1.0 / (length(delta) / options.lambda_mm + 1.0);
    return confidence * damped + (1.0 - confidence) * real;
  }
};

TEST(HapticRigFeel, Equation6to8IsWhatTheSceneIsFeltBy) {
  HapticRig rig;
  RigOptions options;
  options.scene = "sphere";
  options.start_mm = {0.0, 55.0, 0.0};
  options.coupling = CouplingKind::direct;
  options.position_filter = PositionFilterOptions{0.3, 0.5};
  ASSERT_TRUE(rig.start(options).ok());
  const test::ScratchFolder folder;
  ASSERT_TRUE(rig.start_recording(folder / "run.csv", "filtered").ok());
  for (std::uint64_t until = 40; until < 1200; until += 40) {
    rig.lead({{until % 80 == 0 ? 10.0 : -10.0, 49.0, 0.0}});
    ASSERT_TRUE(has_ticked(rig, until));
  }
  ASSERT_TRUE(rig.stop_recording().ok());
  ASSERT_TRUE(rig.stop().ok());
  const auto recording = read_recording(folder / "run.csv");
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  const std::vector<ServoTick>& ticks = recording.value().ticks;
  PrintedFilter printed{*options.position_filter, false, {}, 0.0};
  int compared = 0;
  int since_start = 0;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    double elapsed_s = ticks[n].time_s - ticks[n - 1].time_s;
    ++since_start;
    if ((ticks[n].faults & kClockJumped) != 0) {  // the servo has begun anew
      printed.has_start = false;
      elapsed_s = options.period_s;
    }
    const Vec3 filtered = printed(ticks[n].position_mm, elapsed_s);
    // The recording began later than the filter, which forgets 0.3 of what it knew with each tick.
    if (since_start < 150) continue;
    EXPECT_LE(length(ticks[n].proxy_mm - filtered), 1e-9) << n;
    EXPECT_LE(length(ticks[n].proxy_mm - ticks[n].position_mm), printed.bound_mm) << n;
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

/// Ticks of a handle that is held still in the clay, its button pressed for a part of them.
void write_still(const std::filesystem::path& file, std::uint64_t ticks, std::uint64_t press,
                 std::uint64_t release) {
  Recording recording{"still", {}};
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    ServoTick tick;
    tick.number = n;
    tick.time_s = 1e-3 * static_cast<double>(n);
    tick.is_ready = true;
    tick.position_mm = {0.0, -2.0, 0.0};
    tick.buttons = n >= press && n < release ? 1U : 0U;
    recording.ticks.push_back(tick);
  }
  ASSERT_TRUE(write_recording(file, recording).ok());
}

/// What the rig gave in each tick of such a run.
std::vector<ServoTick> felt_still(const ForceMix& mix, double ramp_s) {
  constexpr std::uint64_t kTicks = 2400;
  HapticRig rig;
  const StillBall clay(rig);
  const test::ScratchFolder folder;
  write_still(folder / "still.csv", kTicks, 1400, 2200);
  RigOptions options;
  options.device = RigDevice::replay;
  options.replay_file = folder / "still.csv";
  options.coupling = CouplingKind::direct;
  options.placement.offset_mm = {0.0, kRadiusMm + 4.0, 0.0};
  options.mix = mix;
  options.mix_ramp_s = ramp_s;
  const auto started = rig.start(options);
  EXPECT_TRUE(started.ok()) << (started ? "" : started.error().message);
  EXPECT_TRUE(rig.start_recording(folder / "run.csv", "felt").ok());
  EXPECT_TRUE(has_ticked(rig, kTicks));
  EXPECT_TRUE(rig.stop_recording().ok());
  const auto recording = read_recording(folder / "run.csv");
  EXPECT_TRUE(recording.ok());
  return recording ? recording.value().ticks : std::vector<ServoTick>();
}

/// The first tick in which the button is pressed.
std::vector<ServoTick>::const_iterator first_pressed(const std::vector<ServoTick>& ticks) {
  return std::find_if(ticks.begin(), ticks.end(),
                      [](const ServoTick& tick) { return tick.buttons != 0; });
}

TEST(HapticRigFeel, Equation3to5ChangesTheWeightOfTheContactOverTheRampThatWasChosen) {
  const ForceMix mix{0.8, 0.2, 0.2, 1.0};
  constexpr double kRampS = 0.3;
  const std::vector<ServoTick> ticks = felt_still(mix, kRampS);
  const auto pressed = first_pressed(ticks);
  ASSERT_TRUE(pressed != ticks.end() && pressed != ticks.begin());
  const ServoTick& before = *(pressed - 1);
  ASSERT_GT(before.wanted_n.y, 0.3);
  const double contact_n = before.wanted_n.y / mix.contact_passive;  // eq. 3, at rest
  int compared = 0;
  for (auto tick = pressed; tick != ticks.end() && tick->buttons != 0; ++tick) {
    if ((tick->faults & (kClockJumped | kWindowStale)) != 0) break;  // of a machine under load
    const double p = std::min(1.0, (tick->time_s - before.time_s) / kRampS);
    const double printed =
        mix.contact_passive + p * (mix.contact_active - mix.contact_passive);  // eq. 5
    EXPECT_NEAR(tick->wanted_n.y, printed * contact_n, 1e-6) << p;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(HapticRigFeel, Equation3WeighsTheContactThatIsTouched) {
  const auto held_n = [](double weight) {
    ForceMix mix;
    mix.contact_passive = weight;
    const std::vector<ServoTick> ticks = felt_still(mix, ModeBlend::kUsualRampS);
    const auto pressed = first_pressed(ticks);
    return pressed == ticks.end() || pressed == ticks.begin() ? 0.0 : (pressed - 1)->wanted_n.y;
  };
  const double whole_n = held_n(1.0);
  EXPECT_GT(whole_n, 0.3);
  EXPECT_NEAR(held_n(0.5), 0.5 * whole_n, 1e-6);
}

TEST(HapticRigFeelOptions, RefusesWhatIsOutOfRangeAndNamesIt) {
  const auto refusal = [](const RigOptions& options) {
    const auto checked = check_rig(options);
    EXPECT_FALSE(checked.ok());
    return checked ? std::string() : checked.error().message;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  RigOptions options;
  options.position_filter = PositionFilterOptions{0.2, 10.5};
  EXPECT_TRUE(has(refusal(options), "lambda_mm is 10.5; must be greater than 0 and at most 10"));
  options.position_filter = PositionFilterOptions{0.0, 0.3};
  EXPECT_TRUE(has(refusal(options), "gain is 0; must be 0.001 to 1"));
  options.scene = "sphere";
  EXPECT_TRUE(has(refusal(options), "gain is 0"));
  options = {};
  options.mix.contact_active = 0.0;
  EXPECT_TRUE(has(refusal(options), "contact_active is 0; must be 0.01 to 2"));
  options.mix = {0.5, 0.3, 0.8, 1.0};
  EXPECT_TRUE(has(refusal(options), "contact_passive must be greater than contact_active"));
  options = {};
  options.mix_ramp_s = 2.5;
  EXPECT_TRUE(has(refusal(options), "mix ramp is 2.5 s; must be 0 to 2 s"));
  options.mix_ramp_s = std::nan("");
  EXPECT_TRUE(has(refusal(options), "mix ramp is nan"));
}

/// The lag of the filter is delay, and the weight of the contact is stiffness.
TEST(HapticRigFeelOptions, CouplesDirectlyOnlyWhatFilterAndWeightLeaveSteady) {
  RigOptions options;
  options.coupling = CouplingKind::direct;
  const double limit = most_direct_stiffness_n_per_m(options);
  EXPECT_TRUE(check_rig(options).ok());
  options.mix.contact_passive = 2.0;
  EXPECT_FALSE(check_rig(options).ok());
  options.mix = {};
  options.position_filter = PositionFilterOptions{0.2, 0.3};
  EXPECT_NEAR(most_direct_stiffness_n_per_m(options), limit * 1.5 / 5.5, 1e-9);
  const auto refused = check_rig(options);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("filter no positions"), std::string::npos);
  options.coupling = CouplingKind::indirect;
  EXPECT_TRUE(check_rig(options).ok());
}

}  // namespace
}  // namespace argil::haptics
