// SPDX-License-Identifier: GPL-3.0-or-later
// What the trials of a study say: a table of all, medians and quartiles, and a picture of them.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string_view>
#include <utility>

#include "common/gnuplot.h"
#include "common/hand_option.h"
#include "common/output.h"
#include "lab/trial.h"
#include "lab/trial_spread.h"

namespace argil::cli::lab {
namespace {

std::string hand_of(const TrialOptions& options, const Trial& trial) {
  return options.is_falcon ? "person" : haptics::hand_model(kHands[trial.hand]).name;
}

/// A measure of a trial by the name that CSV, JSON and pictures share.
struct TrialMeasure {
  const char* name;
  double TrialResult::*value;
};
constexpr TrialMeasure kTrialMeasures[] = {
    {"time_s", &TrialResult::time_s},     {"error_mm", &TrialResult::error_mm},
    {"effort_n", &TrialResult::effort_n}, {"worked_mj", &TrialResult::worked_mj},
    {"aid_n", &TrialResult::aid_n},       {"aid_mj", &TrialResult::aid_mj}};

Json spread_json(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Json json;
  json["least"] = values.front();
  json["q1"] = quantile_of(values, 0.25);
  json["median"] = quantile_of(values, 0.5);
  json["q3"] = quantile_of(values, 0.75);
  json["most"] = values.back();
  return json;
}

Json group_json(const std::string& hand, const std::vector<const TrialResult*>& group) {
  assert(!group.empty());
  Json json;
  json["task"] = trial_task_name(group.front()->trial.task);
  json["condition"] = group.front()->trial.condition;
  json["hand"] = hand;
  json["trials"] = group.size();
  json["started"] = std::count_if(group.begin(), group.end(),
                                  [](const TrialResult* result) { return result->has_started; });
  json["done"] = std::count_if(group.begin(), group.end(),
                               [](const TrialResult* result) { return result->is_done; });
  for (const TrialMeasure& measure : kTrialMeasures) {
    std::vector<double> values;
    for (const TrialResult* result : group) {
      if (result->has_started) values.push_back(result->*measure.value);
    }
    if (!values.empty()) json[measure.name] = spread_json(std::move(values));
  }
  return json;
}

/// The result in the same place under another condition; null where there is none that started.
const TrialResult* partner_of(const TrialResult& result, const std::string& condition,
                              const std::vector<TrialResult>& results) {
  for (const TrialResult& other : results) {
    const bool is_partner = other.trial.task == result.trial.task &&
                            other.trial.condition == condition &&
                            other.trial.place == result.trial.place;
    if (is_partner && other.has_started) return &other;
  }
  return nullptr;
}

/// By how much a condition differs from another in the same places, by all hands.
Json pairs_json(const TrialOptions& options, TrialTask task, const std::string& condition,
                const std::string& than, const std::vector<TrialResult>& results) {
  Json json;
  json["task"] = trial_task_name(task);
  json["condition"] = condition;
  json["than"] = than;
  for (const TrialMeasure& measure : kTrialMeasures) {
    std::vector<std::vector<double>> differences(kHands.size());
    std::size_t pairs = 0;
    std::size_t less = 0;
    for (const TrialResult& result : results) {
      if (result.trial.task != task || result.trial.condition != condition) continue;
      const TrialResult* other = partner_of(result, than, results);
      if (!result.has_started || other == nullptr) continue;
      const double difference = result.*measure.value - other->*measure.value;
      differences[result.trial.hand].push_back(difference);
      ++pairs;
      less += difference < 0.0 ? 1 : 0;
    }
    json["pairs"] = pairs;
    if (pairs == 0) break;
    const auto found = median_interval(differences, static_cast<std::uint64_t>(options.seed));
    json[measure.name] = {
        {"median", found.median}, {"low", found.low}, {"high", found.high}, {"less", less}};
  }
  return json;
}

/// Each condition of a task against its first.
Json all_pairs_json(const TrialOptions& options, const std::vector<TrialResult>& results) {
  Json pairs = Json::array();
  for (std::size_t task = 0; task < kTrialTasks.size(); ++task) {
    const auto conditions = trial_conditions(static_cast<TrialTask>(task));
    for (std::size_t n = 1; n < conditions.size(); ++n) {
      Json json = pairs_json(options, static_cast<TrialTask>(task), conditions[n],
                             conditions.front(), results);
      if (json["pairs"] != 0) pairs.push_back(std::move(json));
    }
  }
  return pairs;
}

/// What is drawn of which task.
struct TrialPanel {
  const char* task;
  const char* measure;
  const char* title;
  const char* unit;
};
constexpr TrialPanel kTrialPanels[] = {
    {"dock", "time_s", "Dock: time", "s"},
    {"groove", "error_mm", "Groove: off its middle", "mm rms"},
    {"bump", "error_mm", "Bump, blindfolded: off it", "mm"},
    {"path", "error_mm", "Path on clay: off it", "mm rms"},
    {"path", "aid_n", "Path on clay: force of guidance", "N mean"},
    {"path", "aid_mj", "Path on clay: work against guidance", "mJ"}};

constexpr std::array kTrialColors{"#c0392b", "#e67e22", "#1b6ca8", "#2e8b57", "#555555"};

std::vector<std::string> hands_in(const Json& rows) {
  std::vector<std::string> hands;
  for (const Json& row : rows) {
    const std::string hand = row["hand"];
    if (hand == "all" || std::find(hands.begin(), hands.end(), hand) != hands.end()) continue;
    hands.push_back(hand);
  }
  return hands;
}

/// The boxes of all hands, and a point for each hand's median beside its neighbour's.
std::string panel_script(const TrialPanel& panel, const Json& rows, std::size_t number) {
  constexpr double kHeadroom = 1.2;  // for the key
  std::ostringstream boxes;
  std::ostringstream ticks;
  const std::vector<std::string> hands = hands_in(rows);
  std::vector<std::ostringstream> points(hands.size());
  std::vector<std::string> conditions;
  double most = 1e-3;  // nothing is drawn to a scale of nothing
  for (const Json& row : rows) {
    if (row["task"] != panel.task || row["started"] == 0) continue;
    const std::string condition = row["condition"];
    if (std::find(conditions.begin(), conditions.end(), condition) == conditions.end()) {
      ticks << (conditions.empty() ? "" : ", ") << "'" << condition << "' " << conditions.size();
      conditions.push_back(condition);
    }
    const std::size_t at = conditions.size() - 1;
    const Json& spread = row[panel.measure];
    most = std::max(most, spread["most"].get<double>());
    if (row["hand"] == "all") {
      boxes << at;
      for (const char* each : {"q1", "least", "most", "q3", "median"}) {
        boxes << ' ' << spread[each].get<double>();
      }
      boxes << '\n';
      continue;
    }
    const auto hand = static_cast<std::size_t>(
        std::find(hands.begin(), hands.end(), row["hand"].get<std::string>()) - hands.begin());
    const double beside =
        0.12 * (static_cast<double>(hand) - 0.5 * (static_cast<double>(hands.size()) - 1.0));
    points[hand] << static_cast<double>(at) + beside << ' ' << spread["median"].get<double>()
                 << '\n';
  }
  if (conditions.empty()) return "";
  const std::string name = "$b" + std::to_string(number);
  std::ostringstream text;
  text << name << " << EOD\n" << boxes.str() << "EOD\n";
  for (std::size_t n = 0; n < hands.size(); ++n) {
    text << "$p" << number << "_" << n << " << EOD\n" << points[n].str() << "EOD\n";
  }
  text << "set title '" << panel.title << "'\nset ylabel '" << panel.unit << "'\nset xtics ("
       << ticks.str() << ")\nset xrange [-0.7:" << static_cast<double>(conditions.size()) - 0.3
       << "]\nset yrange [0:" << kHeadroom * most << "]\nplot " << name
       << " using 1:2:3:4:5 with candlesticks lc '#7f8c8d' lw 1.2 notitle whiskerbars 0.4, " << name
       << " using 1:6:6:6:6 with candlesticks lc '#222222' lw 2.5 notitle";
  for (std::size_t n = 0; n < hands.size(); ++n) {
    text << ", $p" << number << "_" << n << " with points pt 7 ps 0.7 lc '"
         << kTrialColors[n % kTrialColors.size()] << "' title '" << hands[n] << "'";
  }
  text << "\n";
  return text.str();
}

/// "1.2 (1 to 1.4) mm".
std::string spread_text(const Json& spread, const char* low, const char* high, const char* unit) {
  char words[80];
  std::snprintf(words, sizeof words, "%.3g (%.3g to %.3g) %s", spread["median"].get<double>(),
                spread[low].get<double>(), spread[high].get<double>(), unit);
  return words;
}

std::string row_text(const Json& row) {
  std::ostringstream text;
  text << "  " << row["task"].get<std::string>() << ", " << row["condition"].get<std::string>()
       << ": " << row["done"] << " of " << row["trials"] << " done";
  if (row["started"] != row["trials"]) {
    text << ", " << row["trials"].get<int>() - row["started"].get<int>()
         << " never begun and left out";
  }
  if (row["started"] == 0) return text.str() + "\n";
  const auto spread = [&row](const char* measure, const char* unit) {
    return spread_text(row[measure], "q1", "q3", unit);
  };
  text << "; time " << spread("time_s", "s") << ", error " << spread("error_mm", "mm") << ", force "
       << spread("effort_n", "N") << ", work " << spread("worked_mj", "mJ") << ", of guidance "
       << spread("aid_n", "N") << ", " << spread("aid_mj", "mJ") << "\n";
  return text.str();
}

std::string pair_text(const Json& pair) {
  std::ostringstream text;
  text << "  " << pair["task"].get<std::string>() << ", " << pair["condition"].get<std::string>()
       << " less " << pair["than"].get<std::string>() << ", " << pair["pairs"] << " pairs";
  const auto difference = [&](const char* name, const char* measure, const char* unit) {
    text << "; " << name << " " << spread_text(pair[measure], "low", "high", unit) << ", less in "
         << pair[measure]["less"];
  };
  difference("time", "time_s", "s");
  difference("error", "error_mm", "mm");
  text << "\n";
  return text.str();
}

}  // namespace

std::string trial_csv(const TrialOptions& options, const std::vector<TrialResult>& results) {
  std::ostringstream text;
  text << "order,task,condition,hand,repeat,started,done,time_s,error_mm,effort_n,worked_mj,aid_n,"
          "aid_mj\n";
  std::size_t order = 0;
  for (const TrialResult& result : results) {
    text << ++order << ',' << trial_task_name(result.trial.task) << ',' << result.trial.condition
         << ',' << hand_of(options, result.trial) << ',' << result.trial.repeat << ','
         << (result.has_started ? 1 : 0) << ',' << (result.is_done ? 1 : 0);
    for (const TrialMeasure& measure : kTrialMeasures) {
      char number[32] = ",";  // nothing was measured
      if (result.has_started) {
        std::snprintf(number, sizeof number, ",%.6g", result.*measure.value);
      }
      text << number;
    }
    text << '\n';
  }
  return text.str();
}

namespace {

/// Of a task under a condition, by one hand, by "all" of them or by a "person".
std::vector<const TrialResult*> results_of(const TrialOptions& options,
                                           const std::vector<TrialResult>& results,
                                           std::string_view task, std::string_view condition,
                                           const std::string& hand) {
  std::vector<const TrialResult*> group;
  for (const TrialResult& result : results) {
    const bool is_in = task == trial_task_name(result.trial.task) &&
                       result.trial.condition == condition &&
                       (hand == "all" || hand == hand_of(options, result.trial));
    if (is_in) group.push_back(&result);
  }
  return group;
}

}  // namespace

Json trial_json(const TrialOptions& options, const std::vector<TrialResult>& results) {
  Json json;
  json["seed"] = options.seed;
  json["trials"] = results.size();
  json["rows"] = Json::array();
  // In the order of the tasks and not in that of the study.
  std::vector<std::string> hands{"all"};
  for (const auto hand : kHands) hands.emplace_back(haptics::hand_model(hand).name);
  hands.emplace_back("person");
  for (const char* task : kTrialTasks) {
    for (const char* condition : {"free", "force", "none", "direct", "indirect", "hybrid"}) {
      for (const std::string& hand : hands) {
        const auto group = results_of(options, results, task, condition, hand);
        if (!group.empty()) json["rows"].push_back(group_json(hand, group));
      }
    }
  }
  json["pairs"] = all_pairs_json(options, results);
  return json;
}

std::string trial_text(const Json& json) {
  std::ostringstream text;
  text << json["trials"] << " trials, order by seed " << json["seed"]
       << "; medians of all hands (quartiles)\n";
  for (const Json& row : json["rows"]) {
    if (row["hand"] == "all") text << row_text(row);
  }
  if (!json["pairs"].empty()) {
    text << "in the same places, medians of the differences (where they lie, 95 %):\n";
  }
  for (const Json& pair : json["pairs"]) text << pair_text(pair);
  return text.str();
}

Result<void> draw_trials(const std::filesystem::path& picture, const Json& json) {
  std::string panels;
  std::size_t count = 0;
  for (const TrialPanel& panel : kTrialPanels) {
    std::string script = panel_script(panel, json["rows"], count);
    if (script.empty()) continue;
    panels += script;
    ++count;
  }
  assert(count > 0);
  const std::size_t columns = std::min<std::size_t>(count, 3);
  const std::size_t rows = (count + columns - 1) / columns;
  std::ostringstream text;
  text << "set terminal svg size " << 370 * columns << "," << 330 * rows + 40
       << " font 'Helvetica,13' background 'white'\nset output 'trial.svg'\n"
       << "set grid ytics lc '#dddddd'\nset boxwidth 0.55\nset style fill solid 0.25 border\n"
       << "set key top right horizontal maxrows 1 samplen 0.2 width 1 font ',9'\n"
       << "set multiplot layout " << rows << "," << columns << " title '"
       << json["trials"].get<std::size_t>()
       << " trials: boxes from quartile to quartile, whiskers to the ends, points the medians of "
          "each hand'\n"
       << panels << "unset multiplot\n";
  return draw_plot(picture, text.str());
}

}  // namespace argil::cli::lab
