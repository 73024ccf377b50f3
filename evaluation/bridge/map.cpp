// SPDX-License-Identifier: GPL-3.0-or-later
// Rate x stiffness x delay for the three laws of the bridge, with an arm and the stand-in
// simulator.
#include "bridge/map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <sstream>

#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/bridge_world.h"

#include "chart/sheet.h"
#include "common/output.h"
#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {
namespace {

using haptics::BridgeLaw;
using haptics::Verdict;

/// Half a second of waiting and three in which the swing of the tap dies away; then the
/// hold is watched.
constexpr double kMapSettleS = 3.5;
constexpr double kMapWatchS = 1.0;
constexpr std::array kLaws{BridgeLaw::direct, BridgeLaw::indirect, BridgeLaw::plane};
constexpr std::array kDelaysMs{0.0, 5.0, 20.0};
/// From a simulator that barely moves to one as fast as the servo.
constexpr double kLeastMapRateHz = 20.0;
constexpr double kMostMapRateHz = 1000.0;
constexpr double kLeastStiffness = 100.0;
constexpr double kMostStiffness = 12000.0;

/// What the device alone allows: b of the nominal Falcon.
double rule_n_per_m(BridgeLaw law, double rate_hz) {
  // k T < 2 b: J. E. Colgate, J. M. Brown, "Factors affecting the Z-width of a haptic display",
  // 1994.
  return 2.0 * haptics::FalconModel().damping_n_s_per_m /
         haptics::bridge_period_s(law, kPeriodS, rate_hz);
}

void measure_bridge_row(BridgeMapRow& row) {
  assert(row.rate_hz > 0.0 && row.delay_ms >= 0.0);
  haptics::BridgeWorldOptions world_options;
  world_options.rate_hz = row.rate_hz;
  world_options.delay_s = 1e-3 * row.delay_ms;
  haptics::BridgeWorld world(world_options);
  haptics::BridgeTerms terms;
  terms.law = row.law;
  terms.spring.stiffness_n_per_m = row.stiffness_n_per_m;
  // Also where k T < 2 b is broken: the map is to show what happens there.
  terms.is_forced = true;
  haptics::BridgeSession session(world, terms);
  haptics::BridgeScene scene(session, {});
  haptics::BridgeDriver driver(session, world, [](const haptics::BridgeRow&) {});
  haptics::HoldTest test;
  test.device = falcon(false, 1);
  test.hand = haptics::hand_model(haptics::Hand::arm);
  test.servo = haptics::bridge_servo(kPeriodS);
  test.plan = haptics::press_plan({}, {0.0, -1.0, 0.0}, kPressN);
  // The hand waits until the bridge has ramped in.
  for (haptics::HandKey& key : test.plan) key.time_s += 0.5;
  test.settle_s = kMapSettleS;
  test.watch_s = kMapWatchS;
  row.found = haptics::run_hold_test(scene, test, &driver).judgement;
}

/// Every rate and stiffness of one panel.
void add_bridge_rows(BridgeLaw law, double delay_ms, bool quick, std::vector<BridgeMapRow>& rows) {
  for (const double rate_hz : spread(kLeastMapRateHz, kMostMapRateHz, quick ? 4 : 12)) {
    for (const double stiffness : spread(kLeastStiffness, kMostStiffness, quick ? 4 : 14)) {
      rows.push_back({law, rate_hz, delay_ms, stiffness, {}});
    }
  }
}

/// A verdict's boxes, on logarithmic axes.
std::string boxes(const std::vector<BridgeMapRow>& rows,
                  const std::function<bool(const BridgeMapRow&)>& is_shown, double half_x,
                  double half_y) {
  std::string text;
  for (const BridgeMapRow& row : rows) {
    if (!is_shown(row)) continue;
    const double x = std::log10(row.rate_hz);
    const double y = std::log10(row.stiffness_n_per_m);
    text += cli::number(x) + " " + cli::number(y) + " " + cli::number(x - half_x) + " " +
            cli::number(x + half_x) + " " + cli::number(y - half_y) + " " +
            cli::number(y + half_y) + "\n";
  }
  return text;
}

struct BridgeLook {
  Verdict verdict;
  const char* style;
  const char* title;
};
constexpr std::array kBridgeLooks{
    BridgeLook{Verdict::quiet, "fs solid noborder lc rgb '#9ad0ae'", "quiet"},
    BridgeLook{Verdict::buzz, "fs solid noborder lc rgb '#f6c667'", "buzz"},
    BridgeLook{Verdict::limit_cycle, "fs solid noborder lc rgb '#d9694a'", "limit cycle"}};
constexpr const char* kRule = "lines lw 2.5 lc rgb '#000000'";

/// Half the step on the axis; all values lie a constant ratio apart.
double half_log_step(const std::vector<double>& values) {
  assert(values.size() > 1 && values[0] > 0.0);
  return 0.5 * std::log10(values[1] / values[0]);
}

/// The values of one axis that occur, rising.
std::vector<double> values_of(const std::vector<BridgeMapRow>& rows, double BridgeMapRow::*member) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const BridgeMapRow& row : rows) values.push_back(row.*member);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string bridge_panel(const std::vector<BridgeMapRow>& rows, BridgeLaw law, double delay_ms) {
  const double half_x = half_log_step(values_of(rows, &BridgeMapRow::rate_hz));
  const double half_y = half_log_step(values_of(rows, &BridgeMapRow::stiffness_n_per_m));
  PlotLines lines;
  for (const BridgeLook& look : kBridgeLooks) {
    const auto is_shown = [&](const BridgeMapRow& row) {
      return row.law == law && row.delay_ms == delay_ms && row.found.verdict == look.verdict;
    };
    lines.add(boxes(rows, is_shown, half_x, half_y), std::string("boxxyerror ") + look.style);
  }
  std::string rule;
  for (const double rate_hz : {kLeastMapRateHz, kMostMapRateHz}) {
    rule += point_text(std::log10(rate_hz), std::log10(rule_n_per_m(law, rate_hz)));
  }
  lines.add(rule, kRule);
  return lines.text();
}

}  // namespace

Result<std::vector<BridgeMapRow>> measure_bridge_map(bool quick, const Progress& progress) {
  std::vector<BridgeMapRow> rows;
  for (const BridgeLaw law : kLaws) {
    for (const double delay_ms : kDelaysMs) add_bridge_rows(law, delay_ms, quick, rows);
  }
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (BridgeMapRow& row : rows) work.emplace_back([&row] { measure_bridge_row(row); });
  if (auto done = run_all(work, progress, "bridge", 0.0, 1.0); !done) return done.error();
  return rows;
}

std::string bridge_map_csv(const std::vector<BridgeMapRow>& rows) {
  std::ostringstream text;
  text << "# A hold of 3 N by the arm through argil bridge; servo 1 kHz, one tick of delay in the "
          "device\n"
          "law,rate_hz,delay_ms,k_n_per_m,rule_n_per_m,verdict,position_pp_mm,force_pp_n\n";
  text.precision(4);
  for (const BridgeMapRow& row : rows) {
    text << haptics::bridge_law_name(row.law) << ',' << row.rate_hz << ',' << row.delay_ms << ','
         << std::lround(row.stiffness_n_per_m) << ','
         << std::lround(rule_n_per_m(row.law, row.rate_hz)) << ','
         << haptics::verdict_name(row.found.verdict) << ',' << row.found.position_pp_mm << ','
         << row.found.force_pp_n << '\n';
  }
  return text.str();
}

Script bridge_map_script(const std::vector<BridgeMapRow>& rows) {
  const Sheet sheet{
      "bridge", 1180, 960, "Rate, stiffness and delay of a simulator that is felt",
      "Hold of 3 N by the arm, servo 1 kHz, one tick of delay, a floor. Delay: of the "
      "simulator, beyond the tick that a datagram takes."};
  const PanelGrid grid{3, 3, 0.085, 0.985, 0.865, 0.125, 0.025, 0.075};
  std::string text =
      "unset key\nunset grid\nset xrange [1.23:3.07]\nset yrange [1.92:4.16]\n"
      "set xtics ('20' 1.301,'60' 1.778,'200' 2.301,'1000' 3)\n";
  for (std::size_t i = 0; i < kLaws.size() * kDelaysMs.size(); ++i) {
    const BridgeLaw law = kLaws[i % kLaws.size()];
    const double delay_ms = kDelaysMs[i / kLaws.size()];
    text += panel_head(
        grid, i,
        std::string(haptics::bridge_law_name(law)) + ", delay " + cli::number(delay_ms) + " ms");
    text += i % 3 == 0 ? "set ylabel 'k [N/m]'\nset ytics ('100' 2,'300' 2.477,"
                         "'1500' 3.176,'3000' 3.477,'10000' 4)\n"
                       : "unset ylabel\nset ytics ('' 2,'' 2.477,'' 3.176,'' 3.477,'' 4)\n";
    text += i < 6 ? "unset xlabel\n" : "set xlabel 'rate of the simulator [Hz]'\n";
    text += bridge_panel(rows, law, delay_ms);
  }
  KeyStrip key(0.05, 4);
  for (const BridgeLook& look : kBridgeLooks)
    key.add(std::string("boxes ") + look.style, look.title);
  key.add(kRule, "k = 2b/T of the device alone");
  return finished(sheet, text + key.text());
}

}  // namespace argil::evaluation
