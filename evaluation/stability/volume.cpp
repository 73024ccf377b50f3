// SPDX-License-Identifier: GPL-3.0-or-later
// The volume force in the closed loop: tool radius, skin, exponent, hand.
#include "stability/volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "stability/clay.h"

namespace argil::evaluation {
namespace {

constexpr double kSlowPeriodS = 5e-3;  // where larger tools reach the limit too

HoldCase volume_case(haptics::Hand hand, bool is_default) {
  HoldCase held;
  held.hand = hand;
  held.device = falcon(false, 1);
  held.servo = is_default ? haptics::ServoOptions() : haptics::bare_servo(kPeriodS);
  return held;
}

void measure_volume_case(VolumeRow& row) {
  haptics::ForceMaterial material;
  material.exponent = row.exponent;
  material.skin_mm = row.skin_mm;
  ClayPlane clay(row.radius_mm, material);
  const double rest_mm = clay.height_mm(kPressN);
  row.rest_slope_n_per_m = clay.slope_n_per_m(rest_mm);
  row.surface_slope_n_per_m = clay.slope_n_per_m(0.0);
  row.point_slope_n_per_m = ClayPlane(0.0, material).slope_n_per_m(0.0);
  assert(row.skin_mm > 0.0);
  const HoldCase held = volume_case(row.hand, row.is_default);
  row.found = hold(clay, held, rest_mm - coupling_give_mm(held));
}

double volume_rest_slope_n_per_m(const VolumeLimit& limit, double point_slope_n_per_m) {
  const ClayPlane clay(limit.radius_mm, material_of(limit.exponent, point_slope_n_per_m));
  return clay.slope_n_per_m(clay.height_mm(kPressN));
}

void measure_volume_case(VolumeLimit& limit, const StiffnessGrid& grid) {
  const HoldCase held{limit.hand, falcon(limit.is_frictionless, 1),
                      haptics::bare_servo(limit.period_s)};
  const double guess = formula_n_per_m(held, 0.0);
  limit.found = first_failures(grid, guess, 4, [&](double n_per_m) {
    ClayPlane clay(limit.radius_mm, material_of(limit.exponent, n_per_m));
    return hold(clay, held, clay.height_mm(kPressN)).verdict;
  });
  // The same search at a linear wall, whose limit the slopes are compared with.
  limit.linear = first_failures(grid, guess, 4,
                                [&](double n_per_m) { return hold_wall(held, n_per_m).verdict; });
  const int last = grid.count() - 1;
  // One step of the grid below the first that is not quiet.
  const int quiet =
      limit.found.not_quiet ? std::max(0, grid.nearest(*limit.found.not_quiet) - 1) : last;
  limit.quiet_skin_mm = material_of(limit.exponent, grid.at(quiet)).skin_mm;
  limit.quiet_slope_n_per_m = volume_rest_slope_n_per_m(limit, grid.at(quiet));
  if (limit.found.cycle)
    limit.cycle_slope_n_per_m = volume_rest_slope_n_per_m(limit, *limit.found.cycle);
  // A ball averages over its size: however thin the skin, it feels no steeper slope.
  limit.most_slope_n_per_m = volume_rest_slope_n_per_m(limit, grid.at(last));
}

void add_volume_rows(const std::vector<double>& radii, const std::vector<double>& skins,
                     double exponent, haptics::Hand hand, std::vector<VolumeRow>& rows) {
  for (const double radius : radii) {
    for (const bool is_default : {false, true}) {
      for (const double skin : skins) {
        rows.push_back({radius, skin, exponent, hand, is_default, {}, 0.0, 0.0, 0.0});
      }
    }
  }
}

void add_volume_limits(const std::vector<double>& radii, double exponent, haptics::Hand hand,
                       std::vector<VolumeLimit>& limits) {
  for (const bool is_frictionless : {false, true}) {
    for (const double period_s : {kPeriodS, kSlowPeriodS}) {
      for (const double radius : radii) {
        VolumeLimit& limit = limits.emplace_back();
        limit.radius_mm = radius;
        limit.exponent = exponent;
        limit.hand = hand;
        limit.period_s = period_s;
        limit.is_frictionless = is_frictionless;
      }
    }
  }
}

VolumeResult volume_cases(bool quick) {
  std::vector<double> radii{0.0, 1.0, 2.0, 4.0, 8.0, 16.0};
  std::vector<double> skins{1.0, 2.0, 4.0, 8.0, 16.0};
  if (quick) {
    radii = {0.0, 2.0, 8.0};
    skins = {1.0, 4.0, 16.0};
  }
  std::vector<double> limit_radii = radii;
  if (!quick) limit_radii.insert(limit_radii.begin() + 1, {0.25, 0.5});
  VolumeResult result;
  for (const double exponent : {2.0, 4.0}) {
    for (const haptics::Hand hand : kHands) {
      add_volume_rows(radii, skins, exponent, hand, result.rows);
      add_volume_limits(limit_radii, exponent, hand, result.limits);
    }
  }
  return result;
}

}  // namespace

Result<VolumeResult> measure_volume(bool quick, const Progress& progress, double from, double to) {
  VolumeResult result = volume_cases(quick);
  const StiffnessGrid grid(quick ? 1.2 : 1.1);
  std::vector<std::function<void()>> work;
  for (VolumeRow& row : result.rows) work.emplace_back([&row] { measure_volume_case(row); });
  for (VolumeLimit& limit : result.limits) {
    work.emplace_back([&limit, &grid] { measure_volume_case(limit, grid); });
  }
  if (auto done = run_all(work, progress, "pressing into clay", from, to); !done) {
    return done.error();
  }
  return result;
}

std::string volume_csv(const std::vector<VolumeRow>& rows) {
  std::ostringstream text;
  text
      << "# A ball held at flat clay with 3 N (radius 0: the point law), 1 kHz, one tick of delay, "
         "nominal device; slopes of the force in N/m\n"
         "exponent,radius_mm,skin_mm,hand,servo,verdict,position_pp_mm,force_pp_n,slope_at_rest,"
         "slope_at_surface,slope_of_point_law\n";
  text.precision(4);
  for (const VolumeRow& row : rows) {
    text << row.exponent << ',' << row.radius_mm << ',' << row.skin_mm << ','
         << haptics::hand_model(row.hand).name << ',' << (row.is_default ? "default" : "direct")
         << ',' << haptics::verdict_name(row.found.verdict) << ',' << row.found.position_pp_mm
         << ',' << row.found.force_pp_n << ',' << std::lround(row.rest_slope_n_per_m) << ','
         << std::lround(row.surface_slope_n_per_m) << ',' << std::round(row.point_slope_n_per_m)
         << '\n';
  }
  return text.str();
}

std::string volume_limit_csv(const std::vector<VolumeLimit>& limits) {
  std::ostringstream text;
  text << "# How thin the skin may be without a coupling; slopes in N/m where the tool feels 3 N\n"
          "device,period_ms,exponent,radius_mm,hand,smallest_quiet_skin_mm,slope_there,then,"
          "slope_at_limit_cycle,slope_of_thinnest_skin,linear_wall_not_quiet,"
          "linear_wall_limit_cycle\n";
  for (const VolumeLimit& limit : limits) {
    std::ostringstream skin;
    skin.precision(3);
    skin << (limit.found.not_quiet ? "" : "<= ") << limit.quiet_skin_mm;
    text << (limit.is_frictionless ? "frictionless" : "nominal") << ',' << 1e3 * limit.period_s
         << ',' << limit.exponent << ',' << limit.radius_mm << ','
         << haptics::hand_model(limit.hand).name << ',' << skin.str() << ','
         << std::lround(limit.quiet_slope_n_per_m) << ','
         << haptics::verdict_name(limit.found.verdict) << ',';
    if (limit.found.cycle) text << std::lround(limit.cycle_slope_n_per_m);
    text << ',' << std::lround(limit.most_slope_n_per_m) << ','
         << stiffness_text(limit.linear.not_quiet) << ',' << stiffness_text(limit.linear.cycle)
         << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
