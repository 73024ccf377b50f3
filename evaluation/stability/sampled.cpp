// SPDX-License-Identifier: GPL-3.0-or-later
// The volume force on clay that is served in windows: held, and while it carves.
#include "stability/sampled.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <sstream>

#include "argil/haptics/analysis/slide_judgement.h"

#include "stability/clay.h"
#include "stability/flat_clay.h"

namespace argil::evaluation {
namespace {

constexpr Vec3 kAlong{1.0, 0.0, 0.0};
/// A resting tool is given the same window again and again: not so often as by the program, which
/// would only cost time.
constexpr double kHoldRefreshS = 0.07;

// Carving: down and held for a while, then to and fro, a stroke a second.
constexpr double kFirstWindowS = 0.1;
constexpr double kHeldS = 0.4;
constexpr double kStrokeS = 1.0;
constexpr int kStrokes = 2;
constexpr double kSampledPathMm = 20.0;
/// From the button on: the mix of contact and drag has changed over, and the tool moves.
constexpr double kSampledUnderWayS = 0.2;

HoldCase sampled_case(haptics::Hand hand, ServedServo servo) {
  HoldCase held;
  held.hand = hand;
  held.device = falcon(false, 1);
  if (servo == ServedServo::usual) return held;
  held.servo = haptics::bare_servo(kPeriodS);
  if (servo == ServedServo::direct) held.servo.velocity_lag_s = haptics::VelocityFilter::kUsualLagS;
  return held;
}

haptics::ForceMaterial clay_of(double exponent, double skin_mm, bool has_drag) {
  haptics::ForceMaterial material;
  material.exponent = exponent;
  material.skin_mm = skin_mm;
  if (!has_drag) material.viscosity_force_n = 0.0;
  return material;
}

/// The slope of what the last tick felt, between two heights well within a cell.
double felt_slope(const haptics::ClayScene& scene, double radius_mm, double height_mm) {
  assert(radius_mm > 0.0);
  // A cell is a quarter of the radius.
  const double step_mm = 0.02 * radius_mm;
  haptics::HandleState above;
  haptics::HandleState below;
  above.position_mm.y = height_mm + step_mm;
  below.position_mm.y = height_mm - step_mm;
  return 1e3 * (scene.force_at(below).force_n.y - scene.force_at(above).force_n.y) /
         (2.0 * step_mm);
}

void measure_passive(SampledRow& row) {
  const haptics::ForceMaterial material = clay_of(row.exponent, row.skin_mm, row.has_drag);
  ClayPlane plane(row.radius_mm, material);
  const double rest_mm = plane.height_mm(kPressN);
  row.closed_slope_n_per_m = plane.slope_n_per_m(rest_mm);
  const HoldCase held = sampled_case(row.hand, row.servo);
  const double handle_mm = rest_mm - coupling_give_mm(held);
  row.closed = hold(plane, held, handle_mm).verdict;
  auto made = FlatClay::make({row.radius_mm, material, 0.0, kHoldRefreshS, 0.0});
  if (!made) {
    row.worked = made.error();
    return;
  }
  FlatClay& clay = *made.value();
  row.found = hold(clay.scene(), held, handle_mm, &clay);
  row.felt_slope_n_per_m = felt_slope(clay.scene(), row.radius_mm, rest_mm);
  row.faults = clay.faults();
  row.worked = clay.worked();
}

/// Presses 3 N at rest, then carves to and fro, pressing on with 1 N. The push hand, which nothing
/// would stop, aims 10 mm deep instead: 1 N at the surface, less as it sinks.
haptics::HoldTest carve_test(const HoldCase& held, double rest_mm, double radius_mm) {
  assert(radius_mm > 0.0);
  haptics::HoldTest test;
  test.device = held.device;
  test.hand = haptics::hand_model(held.hand);
  test.servo = held.servo;
  const double from_mm = -0.5 * kSampledPathMm;
  test.plan = haptics::press_plan({from_mm, rest_mm - coupling_give_mm(held), 0.0},
                                  {0.0, -1.0, 0.0}, kPressN);
  const double wait_s = std::max(kFirstWindowS, held.servo.safety.ramp_in_s);
  for (haptics::HandKey& key : test.plan) key.time_s += wait_s;
  haptics::HandKey key = test.plan.back();
  key.is_active = true;
  key.press_n = test.hand.is_push ? 0.0 : 1.0;
  // Deeper than it rests, so that the tool cuts, by half its radius at most.
  key.place_mm.y = rest_mm - std::min(1.0, 0.5 * radius_mm) - (test.hand.is_push ? 10.0 : 0.0);
  const double begin_s = wait_s + kHeldS;
  for (int stroke = 0; stroke <= kStrokes; ++stroke) {
    key.time_s = begin_s + kStrokeS * stroke;
    key.place_mm.x = stroke % 2 == 0 ? from_mm : -from_mm;
    test.plan.push_back(key);
  }
  test.settle_s = begin_s + kSampledUnderWayS;
  test.watch_s = kStrokeS * kStrokes - kSampledUnderWayS;
  return test;
}

void measure_carving(SampledRow& row) {
  const haptics::ForceMaterial material = clay_of(row.exponent, row.skin_mm, row.has_drag);
  const ClayPlane plane(row.radius_mm, material);
  const double rest_mm = plane.height_mm(kPressN);
  row.closed_slope_n_per_m = plane.slope_n_per_m(rest_mm);
  FlatClayOptions options{row.radius_mm, material};
  options.path_mm = kSampledPathMm;
  auto made = FlatClay::make(options);
  if (!made) {
    row.worked = made.error();
    return;
  }
  FlatClay& clay = *made.value();
  const haptics::HoldTest test =
      carve_test(sampled_case(row.hand, row.servo), rest_mm, row.radius_mm);
  const haptics::HoldTestResult run = haptics::run_hold_test(clay.scene(), test, &clay);
  const auto from = static_cast<std::size_t>(std::lround(test.settle_s / kPeriodS));
  const haptics::SlideJudgement judged =
      haptics::judge_slide(std::span<const Vec3>(run.true_position_mm).subspan(from),
                           std::span<const Vec3>(run.held_force_n).subspan(from), kAlong, kPeriodS);
  row.found = judged.worst;
  row.whole = judged.whole;
  row.work_mj = judged.work_mj;
  row.dabs = static_cast<int>(clay.counts().dabs);
  row.faults = clay.faults();
  row.worked = clay.worked();
}

double skin_of(const std::optional<double>& n_per_m, double exponent) {
  return n_per_m ? material_of(exponent, *n_per_m).skin_mm : 0.0;
}

double sampled_rest_slope_n_per_m(const SampledLimit& limit, double skin_mm) {
  if (skin_mm == 0.0) return 0.0;
  const ClayPlane plane(limit.radius_mm, clay_of(limit.exponent, skin_mm, false));
  return plane.slope_n_per_m(plane.height_mm(kPressN));
}

haptics::Verdict judge_served(SampledLimit& limit, const HoldCase& held, double skin_mm) {
  const haptics::ForceMaterial material = clay_of(limit.exponent, skin_mm, limit.has_drag);
  auto made = FlatClay::make({limit.radius_mm, material, 0.0, kHoldRefreshS, 0.0});
  if (!made) {
    limit.worked = made.error();
    return haptics::Verdict::limit_cycle;
  }
  FlatClay& clay = *made.value();
  const double rest_mm = ClayPlane(limit.radius_mm, material).height_mm(kPressN);
  const haptics::Verdict verdict = hold(clay.scene(), held, rest_mm, &clay).verdict;
  if (!clay.worked()) limit.worked = clay.worked();
  return verdict;
}

void measure_sampled_limit(SampledLimit& limit, const StiffnessGrid& grid) {
  const HoldCase held = sampled_case(limit.hand, ServedServo::direct);
  const double guess = formula_n_per_m(held, 0.0);
  const FirstFailures linear = first_failures(
      grid, guess, 4, [&](double n_per_m) { return hold_wall(held, n_per_m).verdict; });
  limit.linear_n_per_m = linear.cycle.value_or(0.0);
  const FirstFailures closed = first_failures(grid, guess, 4, [&](double n_per_m) {
    ClayPlane plane(limit.radius_mm, material_of(limit.exponent, n_per_m));
    return hold(plane, held, plane.height_mm(kPressN)).verdict;
  });
  limit.closed_skin_mm = skin_of(closed.cycle, limit.exponent);
  limit.closed_slope_n_per_m = sampled_rest_slope_n_per_m(limit, limit.closed_skin_mm);
  // From where the closed form cycles: a search on sampled clay is dear.
  const FirstFailures sampled =
      first_failures(grid, closed.cycle.value_or(guess), 2, [&](double n_per_m) {
        return judge_served(limit, held, material_of(limit.exponent, n_per_m).skin_mm);
      });
  limit.sampled_skin_mm = skin_of(sampled.cycle, limit.exponent);
  limit.sampled_slope_n_per_m = sampled_rest_slope_n_per_m(limit, limit.sampled_skin_mm);
}

/// The full chart in the steep exponent with every hand; of the other the least damped and a
/// measured hand.
bool is_wanted(double exponent, haptics::Hand hand, bool quick) {
  const bool is_worst = hand == haptics::Hand::push;
  if (quick) return exponent == 4.0 && (is_worst || hand == haptics::Hand::light);
  return exponent == 4.0 || is_worst || hand == haptics::Hand::arm;
}

/// With drag, direct. Drag only calms a hold, and the milder exponent carves more gently: there
/// the push hand is enough.
bool is_row_measured(const SampledRow& row, bool quick) {
  const bool is_steep = row.exponent == 4.0;
  if (row.is_carving) return is_steep || row.hand == haptics::Hand::push;
  return is_steep && !quick;
}

/// All of one tool on one clay in one hand.
void add_sampled_rows(const SampledRow& usual, bool quick, std::vector<SampledRow>& rows) {
  const bool is_steep = usual.exponent == 4.0;
  for (const bool is_carving : {false, true}) {
    SampledRow row = usual;
    row.is_carving = is_carving;
    if (is_row_measured(row, quick)) rows.push_back(row);
    if (!is_carving) {
      row.has_drag = false;
      rows.push_back(row);
      row.has_drag = true;
    } else if (is_steep && row.skin_mm == 4.0) {
      row.servo = ServedServo::raw;
      rows.push_back(row);
    }
    row.servo = ServedServo::usual;
    if (is_steep && row.skin_mm != 4.0) rows.push_back(row);
  }
}

/// All tools and clays in one hand.
void add_hand(double exponent, haptics::Hand hand, bool quick, std::vector<SampledRow>& rows) {
  const std::vector<double> radii = quick ? std::vector{0.5} : std::vector{0.5, 1.0, 2.0, 16.0};
  const std::vector<double> skins = quick ? std::vector{1.0} : std::vector{1.0, 4.0, 16.0};
  for (const double radius : radii) {
    for (const double skin : skins) {
      SampledRow row;
      row.exponent = exponent;
      row.radius_mm = radius;
      row.skin_mm = skin;
      row.hand = hand;
      add_sampled_rows(row, quick, rows);
    }
  }
}

std::vector<SampledRow> all_sampled_rows(bool quick) {
  std::vector<SampledRow> rows;
  for (const double exponent : {2.0, 4.0}) {
    for (const haptics::Hand hand : kHands) {
      if (is_wanted(exponent, hand, quick)) add_hand(exponent, hand, quick, rows);
    }
  }
  return rows;
}

void add_sampled_limits(double exponent, double radius_mm, haptics::Hand hand, bool quick,
                        std::vector<SampledLimit>& limits) {
  for (const bool has_drag : {false, true}) {
    if (quick && has_drag) continue;
    SampledLimit& limit = limits.emplace_back();
    limit.exponent = exponent;
    limit.radius_mm = radius_mm;
    limit.hand = hand;
    limit.has_drag = has_drag;
  }
}

/// Where the closed form has a limit at all.
std::vector<SampledLimit> all_limits(bool quick) {
  std::vector<SampledLimit> limits;
  for (const double exponent : {2.0, 4.0}) {
    if (quick && exponent == 2.0) continue;
    add_sampled_limits(exponent, 0.5, haptics::Hand::push, quick, limits);
    if (quick) continue;
    add_sampled_limits(exponent, 0.5, haptics::Hand::light, quick, limits);
    add_sampled_limits(exponent, 1.0, haptics::Hand::push, quick, limits);
  }
  return limits;
}

/// What is left of a swing that has died away is rounding.
double visible(double value) { return std::abs(value) < 1e-4 ? 0.0 : value; }

/// Whether the clay was felt all the time.
const char* window_text(std::uint32_t faults) {
  constexpr std::uint32_t kLost = haptics::kWindowStale | haptics::kOutsideWindow |
                                  haptics::kClayStopped | haptics::kForceNotFinite;
  return (faults & kLost) == 0 ? "kept" : "lost";
}

void write_row(const SampledRow& row, std::ostream& text) {
  text << (row.is_carving ? "carving" : "passive") << ',' << row.exponent << ',' << row.radius_mm
       << ',' << row.skin_mm << ',' << haptics::hand_model(row.hand).name << ','
       << served_servo_name(row.servo) << ',' << (row.has_drag ? "yes" : "no") << ','
       << haptics::verdict_name(row.found.verdict) << ',' << visible(row.found.position_pp_mm)
       << ',' << visible(row.found.force_pp_n) << ',' << row.found.frequency_hz << ','
       << std::lround(row.closed_slope_n_per_m) << ',';
  if (row.is_carving) {
    text << ",," << row.whole.position_pp_mm << ',' << row.whole.force_pp_n << ',' << row.work_mj
         << ',' << row.dabs << ',' << window_text(row.faults) << '\n';
    return;
  }
  text << std::lround(row.felt_slope_n_per_m) << ','
       << (row.closed ? haptics::verdict_name(*row.closed) : "") << ",,,,0,"
       << window_text(row.faults) << '\n';
}

}  // namespace

const char* served_servo_name(ServedServo servo) {
  switch (servo) {
    case ServedServo::direct:
      return "direct";
    case ServedServo::raw:
      return "direct_raw";
    case ServedServo::usual:
      break;
  }
  return "default";
}

Result<SampledResult> measure_sampled(bool quick, const Progress& progress, double from,
                                      double to) {
  SampledResult result{all_sampled_rows(quick), all_limits(quick)};
  const StiffnessGrid grid(quick ? 1.2 : 1.1);
  std::vector<std::function<void()>> work;
  for (SampledLimit& limit : result.limits) {
    work.emplace_back([&limit, &grid] { measure_sampled_limit(limit, grid); });
  }
  for (SampledRow& row : result.rows) {
    work.emplace_back([&row] { row.is_carving ? measure_carving(row) : measure_passive(row); });
  }
  if (auto done = run_all(work, progress, "carving sampled clay", from, to); !done) {
    return done.error();
  }
  for (const SampledRow& row : result.rows) {
    if (!row.worked) return row.worked.error();
  }
  for (const SampledLimit& limit : result.limits) {
    if (!limit.worked) return limit.worked.error();
  }
  return result;
}

std::string sampled_csv(const std::vector<SampledRow>& rows) {
  std::ostringstream text;
  text << "# A ball at flat clay of 0.5 mm voxels served in windows, 1 kHz, one tick of delay, "
          "nominal device; passive: held with 3 N; carving: the worst piece across the path; "
          "slopes in N/m\n"
          "state,exponent,radius_mm,skin_mm,hand,servo,drag,verdict,position_pp_mm,force_pp_n,"
          "frequency_hz,slope_at_rest,slope_felt,closed_form,whole_position_pp_mm,"
          "whole_force_pp_n,work_mj,dabs,window\n";
  text.precision(3);
  for (const SampledRow& row : rows) write_row(row, text);
  return text.str();
}

std::string sampled_limit_csv(const std::vector<SampledLimit>& limits) {
  std::ostringstream text;
  text << "# First skin of a grid that is a limit cycle without a coupling, in closed form and on "
          "clay served in windows (empty: none); slopes in N/m where the tool feels 3 N\n"
          "exponent,radius_mm,hand,drag,closed_form_skin_mm,closed_form_slope,sampled_skin_mm,"
          "sampled_slope,linear_wall\n";
  text.precision(3);
  const auto write = [&text](double skin_mm, double slope_n_per_m) {
    if (skin_mm > 0.0) text << skin_mm;
    text << ',';
    if (skin_mm > 0.0) text << std::lround(slope_n_per_m);
    text << ',';
  };
  for (const SampledLimit& limit : limits) {
    text << limit.exponent << ',' << limit.radius_mm << ',' << haptics::hand_model(limit.hand).name
         << ',' << (limit.has_drag ? "yes" : "no") << ',';
    write(limit.closed_skin_mm, limit.closed_slope_n_per_m);
    write(limit.sampled_skin_mm, limit.sampled_slope_n_per_m);
    text << std::lround(limit.linear_n_per_m) << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
