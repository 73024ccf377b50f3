// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/late.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>
#include <memory>
#include <sstream>

#include "stability/grid.h"

namespace argil::evaluation {
namespace {

/// The laws of the tools and springs, each made once.
class Laws {
 public:
  const HeightLaw& of(const LateTool& tool) {
    auto& law = laws_[{tool.radius_mm, tool.skin_mm, tool.spring_n_per_m}];
    if (!law) law = std::make_unique<HeightLaw>(tool);
    return *law;
  }

 private:
  std::map<std::array<double, 3>, std::unique_ptr<HeightLaw>> laws_;
};

LateTool spring_of(double n_per_m) {
  LateTool tool{"spring", 0.0, 0.0, 0.0};
  tool.spring_n_per_m = n_per_m;
  return tool;
}

std::vector<LateAction> late_actions() {
  return {LateAction::touch, LateAction::slide, LateAction::carve, LateAction::add,
          LateAction::smooth};
}

/// What is compared for an action, and no more where it would be the same: carving and touching,
/// nothing rises that an account would pay for. On real clay only what its servo can be told to do.
std::vector<LateRemedy> remedies_of(LateAction action, bool is_direct, LateWay way) {
  using enum LateRemedy;
  const bool is_plane = way == LateWay::simulation;
  std::vector<LateRemedy> remedies{account};
  switch (action) {
    case LateAction::touch:
      return remedies;
    case LateAction::slide:
      return is_plane ? std::vector{at_once, account, reaching} : std::vector{reaching};
    case LateAction::carve:
      if (is_plane) remedies.insert(remedies.begin(), at_once);
      remedies.push_back(stamped);
      if (!is_direct) remedies.push_back(governed);
      return remedies;
    case LateAction::add:
    case LateAction::smooth:
      break;
  }
  return is_plane ? std::vector{at_once, blended, account} : std::vector{blended, account};
}

LateRow row_of(LateWay way, const LateCase& what, Laws& laws) {
  LateRow row;
  row.way = way;
  row.what = what;
  haptics::CarvingLoop loop = carving_loop(what, laws.of(what.tool));
  row.stiffness_n_per_m = loop.stiffness_n_per_m;
  row.lateness_s = lateness_s(what, way == LateWay::clay ? kClayDabS : kPlaneDabS);
  if (what.action == LateAction::carve) row.equation = haptics::first_chatter(loop);
  return row;
}

/// All hands, and remedies, of one action of one tool.
void add_late_rows(LateWay way, LateCase what, Laws& laws, std::vector<LateRow>& rows) {
  for (const haptics::Hand hand : kHands) {
    for (const LateRemedy remedy : remedies_of(what.action, what.is_direct, way)) {
      what.hand = hand;
      what.remedy = remedy;
      rows.push_back(row_of(way, what, laws));
    }
  }
}

/// One tool and action on clay as a height, by age and period. Carved without a coupling too: that
/// is what the equation is about.
void add_plane_action(const LateTool& tool, LateAction action, bool quick, Laws& laws,
                      std::vector<LateRow>& rows) {
  const std::vector<double> ages =
      quick ? std::vector{0.05} : std::vector{0.0, 0.005, 0.01, 0.02, 0.05, 0.1};
  const std::vector<double> periods =
      quick ? std::vector{0.005, 0.05} : std::vector{0.005, 0.01, 0.02, 0.05};
  for (const bool is_direct : {false, true}) {
    if (is_direct && action != LateAction::carve) continue;
    for (const double age_s : ages) {
      for (const double period_s : periods) {
        LateCase what;
        what.action = action;
        what.tool = tool;
        what.is_direct = is_direct;
        what.late = {age_s, period_s};
        add_late_rows(LateWay::simulation, what, laws, rows);
      }
    }
  }
}

/// The hard clay is between the others; carved and added to, which is where they differ.
void add_plane_rows(bool quick, Laws& laws, std::vector<LateRow>& rows) {
  for (const LateAction action : late_actions()) {
    add_plane_action(kFineTool, action, quick, laws, rows);
    if (!quick) add_plane_action(kUsualTool, action, quick, laws, rows);
  }
  if (quick) return;
  add_plane_action(kHardTool, LateAction::carve, quick, laws, rows);
  add_plane_action(kHardTool, LateAction::add, quick, laws, rows);
}

/// One tool on real clay, carved without a coupling too: that is what the equation is about.
void add_clay_tool(const LateTool& tool, const std::vector<Lateness>& lates, bool quick, Laws& laws,
                   std::vector<LateRow>& rows) {
  for (const LateAction action : late_actions()) {
    if (quick && action != LateAction::carve && action != LateAction::add) continue;
    for (const Lateness& late : lates) {
      LateCase what;
      what.action = action;
      what.tool = tool;
      what.late = late;
      add_late_rows(LateWay::clay, what, laws, rows);
      what.is_direct = true;
      if (!quick && action == LateAction::carve) add_late_rows(LateWay::clay, what, laws, rows);
    }
  }
}

void add_clay_rows(bool quick, Laws& laws, std::vector<LateRow>& rows) {
  if (quick) return add_clay_tool(kFineTool, {{0.05, 0.05}}, quick, laws, rows);
  add_clay_tool(kFineTool, {{0.005, 0.005}, {0.02, 0.02}, {0.05, 0.05}, {0.1, 0.05}}, quick, laws,
                rows);
  add_clay_tool(kUsualTool, {{0.005, 0.005}, {0.05, 0.05}}, quick, laws, rows);
}

/// Springs are felt at once, without friction, as the equation has it.
LateCase spring_case(double n_per_m, haptics::Hand hand, bool is_direct, const Lateness& late) {
  LateCase what{LateAction::carve, spring_of(n_per_m), hand, is_direct, LateRemedy::at_once, late};
  return what;
}

void add_spring(double n_per_m, haptics::Hand hand, double period_s, bool quick, Laws& laws,
                std::vector<LateRow>& rows) {
  for (const double age_s : late_ages_s(quick)) {
    rows.push_back(
        row_of(LateWay::simulation, spring_case(n_per_m, hand, true, {age_s, period_s}), laws));
  }
}

void add_spring_rows(bool quick, Laws& laws, std::vector<LateRow>& rows) {
  const std::vector<double> periods =
      quick ? std::vector{0.005, 0.02} : std::vector{0.005, 0.02, 0.05};
  for (const haptics::Hand hand : kHands) {
    for (const double period_s : periods) {
      for (const double n_per_m : late_spring_stiffnesses(quick)) {
        add_spring(n_per_m, hand, period_s, quick, laws, rows);
      }
    }
  }
}

/// With a window every tick: of rarer ones the force is a sawtooth, which is a buzz without a
/// cycle.
std::vector<LateLimit> all_late_limits() {
  std::vector<LateLimit> limits;
  for (const bool is_direct : {true, false}) {
    for (const haptics::Hand hand : kHands) {
      for (const double n_per_m : {300.0, 600.0, 1200.0, 2400.0}) {
        limits.push_back({n_per_m, kPeriodS, hand, is_direct, {}, 0.0, {}, 0.0});
      }
    }
  }
  return limits;
}

/// Ages rise by 4 % from 2 ms until the spring cycles: four steps at a time, then the last of them
/// one by one.
void measure_late_limit(LateLimit& limit, const HeightLaw& law) {
  constexpr int kStride = 4;
  const std::vector<double> ages = spread(2e-3, 0.3, 129);
  LateCase what =
      spring_case(limit.stiffness_n_per_m, limit.hand, limit.is_direct, {0.0, limit.period_s});
  if (const auto found = haptics::first_chatter(carving_loop(what, law))) {
    limit.equation_s = found->lateness_s - lateness_s(what, kPlaneDabS);
    limit.equation_hz = found->frequency_hz;
  }
  // Near the limit a stiff spring has grown to a swing of the force, and not yet of the handle.
  const auto cycles = [&](std::size_t i) {
    what.late.age_s = ages[i];
    const LateFound found = run_on_plane(what, law);
    limit.simulated_hz = found.frequency_hz;
    return found.verdict != haptics::Verdict::quiet;
  };
  std::size_t last = 0;
  while (last < ages.size() && !cycles(last)) last += kStride;
  if (last >= ages.size()) return;
  std::size_t first = last < kStride ? 0 : last - kStride + 1;
  while (first < last && !cycles(first)) ++first;
  limit.simulated_s = ages[first];
}

void measure_late_row(LateRow& row, const HeightLaw& law) {
  row.found = row.way == LateWay::clay ? run_on_clay(row.what, law) : run_on_plane(row.what, law);
}

/// What ticks and windows say of the clay being there at all.
const char* late_window_text(const LateFound& found) {
  constexpr std::uint32_t kLost =
      haptics::kWindowStale | haptics::kClayStopped | haptics::kForceNotFinite;
  return (found.faults & kLost) == 0 ? "kept" : "lost";
}

/// A number that is nothing but rounding is none.
double shown(double value) { return std::abs(value) < 5e-4 ? 0.0 : value; }

void write_late_row(const LateRow& row, std::ostream& text) {
  const LateCase& what = row.what;
  const LateFound& found = row.found;
  text << late_way_name(row.way) << ',' << late_action_name(what.action) << ',' << what.tool.name
       << ',' << std::lround(row.stiffness_n_per_m) << ',' << haptics::hand_model(what.hand).name
       << ',' << (what.is_direct ? "direct" : "default") << ',' << late_remedy_name(what.remedy)
       << ',' << 1e3 * what.late.age_s << ',' << 1e3 * what.late.period_s << ','
       << 1e3 * row.lateness_s << ',';
  if (row.equation) text << std::round(1e4 * row.equation->lateness_s) / 10.0;
  text << ',';
  if (what.action == LateAction::carve) {
    const bool cycles = row.equation && row.lateness_s >= row.equation->lateness_s;
    text << (cycles ? "limit_cycle" : "quiet");
  }
  text << ',' << haptics::verdict_name(found.verdict) << ',' << shown(found.swing_mm) << ','
       << found.frequency_hz << ',' << shown(found.force_pp_n) << ',' << shown(found.mean_n) << ','
       << shown(found.exchange_mw) << ',' << shown(found.given_mj) << ',' << found.allowed_mj << ','
       << shown(found.step_p99_n) << ',' << shown(found.step_most_n) << ',' << found.outside_ms
       << ',' << late_window_text(found) << '\n';
}

constexpr const char* kLateColumns =
    "way,action,tool,k_n_per_m,hand,servo,remedy,age_ms,period_ms,"
    "tau_ms,equation_tau_ms,equation,verdict,swing_mm,frequency_hz,force_pp_n,mean_n,exchange_mw,"
    "given_mj,allowed_mj,step_p99_n,step_max_n,outside_ms,window\n";

std::string rows_text(const char* head, const std::vector<LateRow>& rows) {
  std::ostringstream text;
  text << head << kLateColumns << std::setprecision(3);
  for (const LateRow& row : rows) write_late_row(row, text);
  return text.str();
}

}  // namespace

const char* late_way_name(LateWay way) { return way == LateWay::clay ? "clay" : "simulation"; }

std::vector<double> late_spring_stiffnesses(bool quick) {
  if (quick) return {150.0, 300.0, 600.0, 1200.0, 2400.0};
  return {150.0, 212.0, 300.0, 424.0, 600.0, 849.0, 1200.0, 1697.0, 2400.0};
}

std::vector<double> late_ages_s(bool quick) {
  if (quick) return {0.0, 0.025, 0.05, 0.075, 0.1};
  std::vector<double> ages;
  for (int ms = 0; ms <= 100; ms += 10) ages.push_back(1e-3 * ms);
  return ages;
}

Result<LateResult> measure_late(bool quick, const Progress& progress, double from, double to) {
  LateResult result;
  Laws laws;
  add_spring_rows(quick, laws, result.springs);
  result.limits = all_late_limits();
  add_plane_rows(quick, laws, result.rows);
  add_clay_rows(quick, laws, result.rows);
  // What is short comes first, so that whoever interrupts it at once need not wait.
  std::vector<std::function<void()>> work;
  for (LateRow& row : result.springs) {
    work.emplace_back([&row, &law = laws.of(row.what.tool)] { measure_late_row(row, law); });
  }
  for (LateLimit& limit : result.limits) {
    const HeightLaw& law = laws.of(spring_of(limit.stiffness_n_per_m));
    work.emplace_back([&limit, &law] { measure_late_limit(limit, law); });
  }
  for (LateRow& row : result.rows) {
    work.emplace_back([&row, &law = laws.of(row.what.tool)] { measure_late_row(row, law); });
  }
  if (auto done = run_all(work, progress, "feeling clay late", from, to); !done) {
    return done.error();
  }
  for (const LateRow& row : result.rows) {
    if (!row.found.worked) return row.found.worked.error();
  }
  return result;
}

std::string late_csv(const std::vector<LateRow>& rows) {
  return rows_text(
      "# A stroke of 2 s on flat clay that is felt late, 1 kHz, one tick of delay, nominal device; "
      "k: slope of the felt force at 3 N of the material; tau: from the tool's motion to the force "
      "that knows what it did; equation: of carving; tools: default R 4 mm, skin 8 mm, e 2; hard R "
      "4 mm, skin 1 mm, e 4; fine R 1 mm, skin 1 mm, e 4\n",
      rows);
}

std::string late_spring_csv(const std::vector<LateRow>& rows) {
  return rows_text(
      "# The same with a spring that is carved in place of clay, felt at once, without friction\n",
      rows);
}

std::string late_limit_csv(const std::vector<LateLimit>& limits) {
  std::ostringstream text;
  text << "# First age at which a spring that is carved cycles (empty: none up to 300 ms), felt at "
          "once, without friction; ages rise by 4 %\n"
          "k_n_per_m,period_ms,hand,servo,equation_age_ms,simulated_age_ms,ratio,equation_hz,"
          "simulated_hz\n"
       << std::setprecision(3);
  for (const LateLimit& limit : limits) {
    const auto age = [&text](const std::optional<double>& seconds) {
      if (seconds) text << 1e3 * *seconds;
      text << ',';
    };
    text << limit.stiffness_n_per_m << ',' << 1e3 * limit.period_s << ','
         << haptics::hand_model(limit.hand).name << ',' << (limit.is_direct ? "direct" : "default")
         << ',';
    age(limit.equation_s);
    age(limit.simulated_s);
    if (limit.equation_s && limit.simulated_s) text << *limit.simulated_s / *limit.equation_s;
    text << ',';
    if (limit.equation_s) text << limit.equation_hz;
    text << ',';
    if (limit.simulated_s) text << limit.simulated_hz;
    text << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
