// SPDX-License-Identifier: GPL-3.0-or-later
// What is felt of the windows' cells when the tool slides over flat clay.
#include "stability/cogging.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>

#include "argil/haptics/analysis/slide_judgement.h"
#include "argil/haptics/force/closed_force.h"
#include "argil/haptics/force/lattice_force.h"

#include "stability/clay.h"
#include "stability/flat_clay.h"

namespace argil::evaluation {
namespace {

constexpr double kCoggingPathMm = 20.0;
constexpr double kTiltDeg = 20.0;
/// The first window has come.
constexpr double kCoggingWaitS = 0.1;
/// A hand has settled on the clay: near the limit the swing of the tap takes 2 s to die away.
constexpr double kSettledS = 3.0;
/// The jerk of setting off has died away.
constexpr double kCoggingUnderWayS = 0.1;

/// The surface's own axes.
struct Frame {
  Vec3 normal;
  Vec3 path;  ///< along x as far as the surface allows
  Vec3 aside;
};

Frame frame_of(const CoggingRow& row) {
  Frame frame;
  frame.normal = leaning_normal(row.tilt_deg * std::numbers::pi / 180.0);
  const Vec3 x{1.0, 0.0, 0.0};
  frame.path = normalized(x - dot(x, frame.normal) * frame.normal);
  frame.aside = cross(frame.normal, frame.path);
  assert(std::abs(length(frame.aside) - 1.0) < 1e-9);
  return frame;
}

haptics::ForceMaterial cogging_material(const CoggingRow& row) {
  haptics::ForceMaterial material;
  material.exponent = row.exponent;
  material.skin_mm = row.skin_mm;
  if (!row.has_drag) material.viscosity_force_n = 0.0;
  return material;
}

double rest_mm(const CoggingRow& row) {
  return ClayPlane(row.radius_mm, cogging_material(row)).height_mm(kPressN);
}

Result<std::unique_ptr<FlatClay>> clay_for(const CoggingRow& row) {
  FlatClayOptions options{row.radius_mm, cogging_material(row)};
  options.tilt_rad = row.tilt_deg * std::numbers::pi / 180.0;
  options.path_mm = kCoggingPathMm;
  return FlatClay::make(options);
}

/// What is left of one series after its line, peak to peak.
double ripple(const std::vector<double>& values) {
  std::vector<Vec3> series;
  series.reserve(values.size());
  // By the same judge as holds, which takes a linear drift out.
  for (const double value : values) series.push_back({value, 0.0, 0.0});
  return haptics::judge_hold(series, series, kPeriodS).position_pp_mm;
}

/// Twice the amplitude at one frequency.
double wave_pp(const std::vector<double>& values, double mean, double frequency_hz) {
  assert(!values.empty() && frequency_hz < 0.5 / kPeriodS);  // what the samples can show
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double angle = 2.0 * std::numbers::pi * frequency_hz * kPeriodS * static_cast<double>(n);
    even += (values[n] - mean) * std::cos(angle);
    odd += (values[n] - mean) * std::sin(angle);
  }
  return 4.0 * std::hypot(even, odd) / static_cast<double>(values.size());
}

void judge_ripple(CoggingRow& row, const Frame& frame, std::span<const Vec3> forces) {
  std::array<std::vector<double>, 3> parts;
  for (const Vec3& force : forces) {
    parts[0].push_back(dot(force, frame.normal));
    parts[1].push_back(dot(force, frame.path));
    parts[2].push_back(dot(force, frame.aside));
  }
  assert(!forces.empty());
  double mean = 0.0;
  for (const double value : parts[0]) mean += value / static_cast<double>(forces.size());
  row.mean_force_n = mean;
  row.normal_pp = ripple(parts[0]) / mean;
  row.sideways_pp = std::max(ripple(parts[1]), ripple(parts[2])) / mean;
  row.at_cells_pp = wave_pp(parts[0], mean, row.cells_per_s) / mean;
  const double ripple_pp = row.hand ? row.at_cells_pp : std::max(row.normal_pp, row.sideways_pp);
  // The steepest slope of a sine of that swing and of one cell's length.
  row.cogging_n_per_m = std::numbers::pi * ripple_pp * mean / (1e-3 * row.cell_mm);
}

/// The tool is led along the surface at the depth of 3 N, so that all that changes is the cells'.
void slide_prescribed(CoggingRow& row, const Frame& frame, FlatClay& clay) {
  haptics::HandleState tool;
  const Vec3 begin = rest_mm(row) * frame.normal - (0.5 * kCoggingPathMm) * frame.path;
  const double slide_s = kCoggingPathMm / row.speed_mm_per_s;
  const auto ticks = static_cast<int>(std::lround((kCoggingWaitS + slide_s) / kPeriodS));
  std::vector<Vec3> forces;
  for (int n = 0; n < ticks; ++n) {
    tool.time_s = n * kPeriodS;
    const double under_way_s = std::max(0.0, tool.time_s - kCoggingWaitS);
    tool.position_mm = begin + (row.speed_mm_per_s * under_way_s) * frame.path;
    tool.velocity_mm_per_s = row.speed_mm_per_s * frame.path;
    clay.scene().begin_tick(tool);
    if (tool.time_s >= kCoggingWaitS) forces.push_back(clay.scene().force_at(tool).force_n);
    clay.scene().end_tick(tool);
    clay.step(tool.time_s);
  }
  judge_ripple(row, frame, forces);
}

haptics::HoldTest hand_test(const CoggingRow& row, const Frame& frame) {
  haptics::HoldTest test;
  test.device = falcon(false, 1);
  test.hand = haptics::hand_model(*row.hand);
  test.servo = haptics::bare_servo(kPeriodS);
  test.servo.velocity_lag_s = haptics::VelocityFilter::kUsualLagS;
  const Vec3 begin = rest_mm(row) * frame.normal - (0.5 * kCoggingPathMm) * frame.path;
  test.plan = haptics::press_plan(begin, -frame.normal, kPressN);
  for (haptics::HandKey& key : test.plan) key.time_s += kCoggingWaitS;
  haptics::HandKey key = test.plan.back();
  key.time_s = kSettledS;
  test.plan.push_back(key);
  key.time_s += kCoggingPathMm / row.speed_mm_per_s;
  key.place_mm += kCoggingPathMm * frame.path;
  test.plan.push_back(key);
  test.settle_s = kSettledS + kCoggingUnderWayS;
  test.watch_s = key.time_s - test.settle_s;
  return test;
}

/// The same clay in closed form, contact alone.
class PlaneScene final : public haptics::ForceScene {
 public:
  PlaneScene(const CoggingRow& row, const Vec3& normal)
      : normal_(normal), material_(cogging_material(row)) {
    tool_.radii_mm = {row.radius_mm, row.radius_mm, row.radius_mm};
  }
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override {
    haptics::ForceTool tool = tool_;
    tool.position_mm = handle.position_mm;
    haptics::SceneForce felt;
    felt.force_n = haptics::plane_force(normal_, 0.0, tool, material_).contact_n;
    return felt;
  }

 private:
  Vec3 normal_;
  haptics::ForceMaterial material_;
  haptics::ForceTool tool_;
};

/// Judges a slide by hand into `found`; its ripple into `row`.
void judge_hand(CoggingRow& row, const Frame& frame, const haptics::HoldTest& test,
                const haptics::HoldTestResult& run, haptics::HoldJudgement& found) {
  const auto from = static_cast<std::size_t>(std::lround(test.settle_s / kPeriodS));
  const auto forces = std::span<const Vec3>(run.held_force_n).subspan(from);
  const auto positions = std::span<const Vec3>(run.true_position_mm).subspan(from);
  found = haptics::judge_slide(positions, forces, frame.path, kPeriodS).worst;
  judge_ripple(row, frame, forces);
}

void slide_by_hand(CoggingRow& row, const Frame& frame, FlatClay& clay) {
  const haptics::HoldTest test = hand_test(row, frame);
  PlaneScene plane(row, frame.normal);
  judge_hand(row, frame, test, haptics::run_hold_test(plane, test), row.closed);
  row.closed_normal_pp = row.normal_pp;
  judge_hand(row, frame, test, haptics::run_hold_test(clay.scene(), test, &clay), row.found);
}

void measure_cogging_row(CoggingRow& row) {
  const Frame frame = frame_of(row);
  haptics::ForceTool tool;
  tool.radii_mm = {row.radius_mm, row.radius_mm, row.radius_mm};
  row.cell_mm = haptics::choose_lattice(tool).voxel_mm;
  const Vec3& path = frame.path;
  // Planes of nodes are met most often along the axis that the path follows most.
  row.cells_per_s = row.speed_mm_per_s *
                    std::max({std::abs(path.x), std::abs(path.y), std::abs(path.z)}) / row.cell_mm;
  auto made = clay_for(row);
  if (!made) {
    row.worked = made.error();
    return;
  }
  if (row.hand) {
    slide_by_hand(row, frame, *made.value());
  } else {
    slide_prescribed(row, frame, *made.value());
  }
  row.worked = made.value()->worked();
}

/// The program's own clay, and a thin and steep one.
struct Matter {
  double exponent;
  double skin_mm;
};
constexpr std::array kMatters{Matter{2.0, 8.0}, Matter{4.0, 1.0}};

CoggingRow row_of(double radius_mm, const Matter& matter, double tilt_deg, double speed_mm_per_s) {
  CoggingRow row;
  row.radius_mm = radius_mm;
  row.exponent = matter.exponent;
  row.skin_mm = matter.skin_mm;
  row.tilt_deg = tilt_deg;
  row.speed_mm_per_s = speed_mm_per_s;
  return row;
}

/// Led along the surface; slow only where the cells show most.
void add_prescribed(double radius_mm, bool quick, std::vector<CoggingRow>& rows) {
  for (const Matter& matter : kMatters) {
    for (const double tilt : {0.0, kTiltDeg}) {
      const bool shows_most = tilt > 0.0 && matter.exponent == 4.0;
      if (shows_most && !quick) rows.push_back(row_of(radius_mm, matter, tilt, 10.0));
      rows.push_back(row_of(radius_mm, matter, tilt, 50.0));
    }
  }
}

/// In a hand where the cells show most.
void add_in_hand(double radius_mm, bool quick, std::vector<CoggingRow>& rows) {
  for (const haptics::Hand hand : kHands) {
    if (radius_mm == 4.0 || (quick && (hand != haptics::Hand::push || radius_mm > 2.0))) continue;
    for (const bool has_drag : {false, true}) {
      CoggingRow& row = rows.emplace_back(row_of(radius_mm, kMatters[1], kTiltDeg, 50.0));
      row.hand = hand;
      row.has_drag = has_drag;
    }
  }
}

std::vector<CoggingRow> all_cogging_rows(bool quick) {
  const std::vector<double> radii =
      quick ? std::vector{2.0, 16.0} : std::vector{1.0, 2.0, 4.0, 16.0};
  std::vector<CoggingRow> rows;
  for (const double radius : radii) {
    add_prescribed(radius, quick, rows);
    add_in_hand(radius, quick, rows);
  }
  return rows;
}

}  // namespace

Result<std::vector<CoggingRow>> measure_cogging(bool quick, const Progress& progress, double from,
                                                double to) {
  std::vector<CoggingRow> rows = all_cogging_rows(quick);
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (CoggingRow& row : rows) work.emplace_back([&row] { measure_cogging_row(row); });
  if (auto done = run_all(work, progress, "sliding through cells", from, to); !done) {
    return done.error();
  }
  for (const CoggingRow& row : rows) {
    if (!row.worked) return row.worked.error();
  }
  return rows;
}

std::string cogging_csv(const std::vector<CoggingRow>& rows) {
  std::ostringstream text;
  text
      << "# A ball that slides 20 mm over flat clay served in windows, without a coupling; ripple "
         "of the force peak to peak in % of it; cogging = pi pp F / h in N/m, and what theory "
         "C.4's smooth kernels of 8 and 16 nodes would give\n"
         "radius_mm,exponent,skin_mm,tilt_deg,speed_mm_per_s,hand,drag,cell_mm,cells_per_s,force_n,"
         "normal_pp_pct,sideways_pp_pct,at_cells_pp_pct,cogging,theory_8,theory_16,verdict,"
         "position_pp_mm,closed_form,closed_form_normal_pp_pct\n";
  text.precision(3);
  for (const CoggingRow& row : rows) {
    const double per_ripple = 1e3 * std::numbers::pi * row.mean_force_n / row.cell_mm;
    text << row.radius_mm << ',' << row.exponent << ',' << row.skin_mm << ',' << row.tilt_deg << ','
         << row.speed_mm_per_s << ',' << (row.hand ? haptics::hand_model(*row.hand).name : "none")
         << ',' << (row.has_drag ? "yes" : "no") << ',' << row.cell_mm << ',' << row.cells_per_s
         << ',' << row.mean_force_n << ',' << 100.0 * row.normal_pp << ','
         << 100.0 * row.sideways_pp << ',' << 100.0 * row.at_cells_pp << ',' << row.cogging_n_per_m
         << ',' << per_ripple * kTheorySmooth8 << ',' << per_ripple * kTheorySmooth16 << ',';
    if (row.hand) {
      text << haptics::verdict_name(row.found.verdict) << ',' << row.found.position_pp_mm << ','
           << haptics::verdict_name(row.closed.verdict) << ',' << 100.0 * row.closed_normal_pp;
    } else {
      text << ",,,";
    }
    text << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
