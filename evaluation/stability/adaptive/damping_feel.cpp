// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive damping in other contacts, through a coupling, and in what a hand does at will.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

#include "argil/haptics/scene/scene_sine.h"
#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_wall.h"

#include "stability/adaptive/damping.h"

namespace argil::evaluation {
namespace {

using haptics::DampingKind;
using haptics::HandKey;
using MadeScene = std::unique_ptr<haptics::ForceScene>;

constexpr Vec3 kPressDown{0.0, -1.0, 0.0};
constexpr Vec3 kPressBack{0.0, 0.0, -1.0};

/// What is held, where the handle rests there without a coupling, and through which servo.
struct DampedContact {
  std::string name;
  std::function<MadeScene()> make;
  Vec3 rest_mm;
  Vec3 direction = kPressDown;
  std::function<void(HoldCase&)> change = [](HoldCase&) {};
};

DampedContact wall_contact(const std::string& name, haptics::WallKind kind, double value,
                           double rest_mm) {
  haptics::WallOptions options;
  options.kind = kind;
  options.offset_mm = 0.0;
  options.damping_n_s_per_m = 0.0;
  options.power_damping_n_per_mps_to_m = 0.0;
  if (kind == haptics::WallKind::rigid) options.rigid_force_n = value;
  if (kind == haptics::WallKind::linear) options.stiffness_n_per_m = value;
  if (kind == haptics::WallKind::nonlinear) options.power_stiffness_n_per_m_to_n = value;
  return {name,
          [options] { return std::make_unique<haptics::WallScene>(options); },
          {0.0, rest_mm, 0.0}};
}

DampedContact linear_contact(const std::string& name, double k, double period_s, double spring,
                             bool is_governed) {
  HoldCase held;
  held.servo.period_s = period_s;
  held.servo.coupling.stiffness_n_per_m = spring;
  held.servo.governor.is_on = is_governed;
  held.device = falcon(false, 1);
  DampedContact contact = wall_contact(name, haptics::WallKind::linear, k, wall_rest_mm(held, k));
  contact.change = [servo = held.servo](HoldCase& changed) {
    const DampingKind kind = changed.servo.damping.kind;
    changed.servo = servo;
    changed.servo.damping.kind = kind;
  };
  return contact;
}

/// In the middle of a wave's valley, which is as stiff as the spring.
DampedContact sine_contact(double k) {
  haptics::SineOptions options;
  options.offset_mm = 0.0;
  options.stiffness_n_per_m = k;
  const double valley_mm = -250.0 / options.frequency_x_per_m;
  return {"sine " + std::to_string(std::lround(k)),
          [options] { return std::make_unique<haptics::SineScene>(options); },
          {valley_mm, 0.0, -options.amplitude_mm - 1e3 * kPressN / k},
          kPressBack};
}

std::vector<DampedContact> all_contacts() {
  using haptics::WallKind;
  const auto depth_mm = [](double k) { return -1e3 * std::sqrt(kPressN / k); };
  std::vector<DampedContact> contacts{
      wall_contact("rigid 20 N", WallKind::rigid, 20.0, 0.0),
      wall_contact("linear 8000", WallKind::linear, 8000.0, -1e3 * kPressN / 8000.0),
      wall_contact("nonlinear 1e6", WallKind::nonlinear, 1e6, depth_mm(1e6)),
      wall_contact("nonlinear 1e7", WallKind::nonlinear, 1e7, depth_mm(1e7)),
      {"spring 6000",
       [] {
         return std::make_unique<haptics::SpringScene>(haptics::SpringOptions{{}, 6000.0, 0.0});
       },
       {0.0, -1e3 * kPressN / 6000.0, 0.0}},
      sine_contact(6000.0),
      linear_contact("coupling 1500 not governed 2 ms", 60000.0, 2e-3, 1500.0, false),
      linear_contact("coupling 1500 not governed 5 ms", 8000.0, 5e-3, 1500.0, false),
      linear_contact("coupling 10000 not governed", 60000.0, 1e-3, 10000.0, false),
      linear_contact("default", 60000.0, 1e-3, 1500.0, true)};
  return contacts;
}

void measure_contact(DampedContactRow& row, const DampedContact& contact) {
  HoldCase held = damped_case(row.hand, false, row.damper, kPeriodS);
  contact.change(held);
  haptics::HoldTest test = hold_test(held, 0.0);
  test.plan = haptics::press_plan(contact.rest_mm, contact.direction, kPressN);
  for (HandKey& key : test.plan) key.time_s += held.servo.safety.ramp_in_s;
  const MadeScene scene = contact.make();
  const haptics::HoldTestResult run = haptics::run_hold_test(*scene, test);
  row.found = run.judgement;
  for (const haptics::ServoTick& tick : run.ticks) {
    row.most_added_n_s_per_m = std::max(row.most_added_n_s_per_m, tick.added_damping_n_s_per_m);
  }
}

// What a hand does at will: on a wall, or on waves, of 2000 N/m.

constexpr double kFeltStiffness = 2000.0;
constexpr double kMotionS = 4.0;
constexpr double kKeyS = 0.005;

/// Where the hand means to be and how hard it presses, by the time.
struct DampedMotion {
  std::string name;
  bool is_on_waves = false;
  std::function<HandKey(double time_s)> at;
};

double sine_of(double time_s, double hz) { return std::sin(2.0 * std::numbers::pi * hz * time_s); }

/// To and fro over 60 mm at a speed.
double to_and_fro_mm(double time_s, double mm_per_s) {
  constexpr double kHalfMm = 30.0;
  const double way = std::fmod(mm_per_s * time_s, 4.0 * kHalfMm);
  return way < 2.0 * kHalfMm ? way - kHalfMm : 3.0 * kHalfMm - way;
}

HandKey key_at(const Vec3& place_mm, double press_n, const Vec3& direction) {
  HandKey key;
  key.place_mm = place_mm;
  key.press_n = press_n;
  key.direction = direction;
  return key;
}

DampedMotion waving(double hz) {
  return {"free " + std::to_string(std::lround(hz)) + " Hz", false, [hz](double t) {
            return key_at({0.0, 30.0 + 15.0 * sine_of(t, hz), 0.0}, 0.0, kPressDown);
          }};
}
DampedMotion tapping(double hz) {
  return {"tap " + std::to_string(std::lround(hz)) + " Hz", false, [hz](double t) {
            return key_at({0.0, 15.0 * sine_of(t, hz), 0.0}, 0.0, kPressDown);
          }};
}
/// Presses on, now more and now less.
DampedMotion kneading(double hz) {
  return {"knead " + std::to_string(std::lround(hz)) + " Hz", false,
          [hz](double t) { return key_at({}, 3.0 + 2.0 * sine_of(t, hz), kPressDown); }};
}
DampedMotion sliding_at(double mm_per_s) {
  return {"slide " + std::to_string(std::lround(mm_per_s)) + " mm/s", false, [mm_per_s](double t) {
            return key_at({to_and_fro_mm(t, mm_per_s), 0.0, 0.0}, 3.0, kPressDown);
          }};
}
DampedMotion over_waves(double mm_per_s) {
  return {"waves " + std::to_string(std::lround(mm_per_s)) + " mm/s", true, [mm_per_s](double t) {
            return key_at({to_and_fro_mm(t, mm_per_s), 0.0, 0.0}, 3.0, kPressBack);
          }};
}

std::vector<DampedMotion> all_motions() {
  return {waving(3.0),       tapping(2.0),     tapping(4.0),     tapping(6.0),
          kneading(2.0),     kneading(5.0),    kneading(8.0),    sliding_at(50.0),
          sliding_at(200.0), over_waves(50.0), over_waves(200.0)};
}

MadeScene motion_scene(const DampedMotion& motion, const Damper& damper) {
  if (!motion.is_on_waves) {
    return MadeScene(new haptics::WallScene(linear_wall(kFeltStiffness, damper.damping_n_s_per_m)));
  }
  haptics::SineOptions options;
  options.offset_mm = 0.0;
  options.stiffness_n_per_m = kFeltStiffness;
  options.damping_n_s_per_m = damper.damping_n_s_per_m;
  return std::make_unique<haptics::SineScene>(options);
}

void measure_motion(DampedMotionRow& row, const DampedMotion& motion) {
  const HoldCase held = damped_case(row.hand, false, row.damper, kPeriodS);
  haptics::HoldTest test = hold_test(held, 0.0);
  test.plan.clear();
  double t = 0.0;
  while (t <= kMotionS) {
    HandKey key = motion.at(t);
    key.time_s = t;
    test.plan.push_back(key);
    t += kKeyS;
  }
  test.settle_s = 0.0;
  test.watch_s = kMotionS;
  const MadeScene scene = motion_scene(motion, row.damper);
  const haptics::HoldTestResult run = haptics::run_hold_test(*scene, test);
  const auto ticks = static_cast<double>(run.ticks.size());
  assert(ticks > 0.0);
  for (std::size_t n = 0; n < run.ticks.size(); ++n) {
    const Vec3& force_n = run.held_force_n[n];
    if (n + 1 < run.ticks.size()) {
      row.taken_mj -= dot(force_n, run.true_position_mm[n + 1] - run.true_position_mm[n]);
    }
    row.mean_force_n += length(force_n) / ticks;
    row.most_force_n = std::max(row.most_force_n, length(force_n));
    const double added = run.ticks[n].added_damping_n_s_per_m;
    row.mean_added_n_s_per_m += added / ticks;
    row.most_added_n_s_per_m = std::max(row.most_added_n_s_per_m, added);
  }
}

}  // namespace

Result<std::vector<DampedContactRow>> measure_damped_contacts(const Progress& progress, double from,
                                                              double to) {
  const std::vector<DampedContact> contacts = all_contacts();
  std::vector<DampedContactRow> rows;
  for (const DampedContact& contact : contacts) {
    for (const DampingKind kind : {DampingKind::fixed, DampingKind::adaptive}) {
      for (const haptics::Hand hand : kHands) {
        rows.push_back({contact.name, hand, {kind, 0.0}, {}, 0.0});
      }
    }
  }
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const DampedContact& contact = contacts[n / (2 * kHands.size())];
    work.emplace_back([&row = rows[n], &contact] { measure_contact(row, contact); });
  }
  if (auto done = run_all(work, progress, "adaptive damping, contacts", from, to); !done) {
    return done.error();
  }
  return rows;
}

Result<std::vector<DampedMotionRow>> measure_damped_motions(const Progress& progress, double from,
                                                            double to) {
  const std::vector<DampedMotion> motions = all_motions();
  std::vector<DampedMotionRow> rows;
  std::vector<std::function<void()>> work;
  for (const DampedMotion& motion : motions) {
    for (const haptics::Hand hand :
         {haptics::Hand::light, haptics::Hand::arm, haptics::Hand::firm}) {
      for (const Damper& damper :
           {Damper{DampingKind::fixed, 0.0}, Damper{DampingKind::fixed, 10.0},
            Damper{DampingKind::fixed, kBoundDamping}, Damper{DampingKind::adaptive, 0.0}}) {
        DampedMotionRow& row = rows.emplace_back();
        row.motion = motion.name;
        row.hand = hand;
        row.damper = damper;
      }
    }
  }
  work.reserve(rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const DampedMotion& motion = motions[n * motions.size() / rows.size()];
    work.emplace_back([&row = rows[n], &motion] { measure_motion(row, motion); });
  }
  if (auto done = run_all(work, progress, "adaptive damping, motions", from, to); !done) {
    return done.error();
  }
  return rows;
}

std::string damped_contact_csv(const std::vector<DampedContactRow>& rows) {
  std::ostringstream text;
  text << "# A hold of 3 N in other contacts, c = 0, 1 kHz unless stated, one tick of delay\n"
          "contact,hand,damping,verdict,position_pp_mm,force_pp_n,added_most_n_s_per_m\n";
  text.precision(4);
  for (const DampedContactRow& row : rows) {
    text << row.contact << ',' << haptics::hand_model(row.hand).name << ','
         << damping_name(row.damper.kind) << ',' << haptics::verdict_name(row.found.verdict) << ','
         << row.found.position_pp_mm << ',' << row.found.force_pp_n << ','
         << row.most_added_n_s_per_m << '\n';
  }
  return text.str();
}

std::string damped_motion_csv(const std::vector<DampedMotionRow>& rows) {
  std::ostringstream text;
  text << "# Four seconds of what a hand does at will at a wall, or at waves, of 2000 N/m; energy "
          "that the servo took from the hand\n"
          "motion,hand,damping,c_n_s_per_m,taken_mj,mean_force_n,most_force_n,"
          "added_mean_n_s_per_m,added_most_n_s_per_m\n";
  text.precision(4);
  for (const DampedMotionRow& row : rows) {
    text << row.motion << ',' << haptics::hand_model(row.hand).name << ','
         << damping_name(row.damper.kind) << ',' << row.damper.damping_n_s_per_m << ','
         << row.taken_mj << ',' << row.mean_force_n << ',' << row.most_force_n << ','
         << row.mean_added_n_s_per_m << ',' << row.most_added_n_s_per_m << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
