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
constexpr TrialMeasure kTrialMeasures[] = {{"time_s", &TrialResult::time_s},
                                           {"error_mm", &TrialResult::error_mm},
                                           {"effort_n", &TrialResult::effort_n},
                                           {"worked_mj", &TrialResult::worked_mj}};

/// Between the two values nearest to it in order, linearly.
double quantile_of(const std::vector<double>& sorted, double part) {
  assert(!sorted.empty() && part >= 0.0 && part <= 1.0);
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

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
  json["done"] = std::count_if(group.begin(), group.end(),
                               [](const TrialResult* result) { return result->is_done; });
  for (const TrialMeasure& measure : kTrialMeasures) {
    std::vector<double> values;
    for (const TrialResult* result : group) values.push_back(result->*measure.value);
    json[measure.name] = spread_json(std::move(values));
  }
  return json;
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
    {"path", "effort_n", "Path on clay: force on the hand", "N mean"},
    {"path", "worked_mj", "Path on clay: work of the hand", "mJ"}};

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
    if (row["task"] != panel.task) continue;
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

}  // namespace

std::string trial_csv(const TrialOptions& options, const std::vector<TrialResult>& results) {
  std::ostringstream text;
  text << "order,task,condition,hand,repeat,done,time_s,error_mm,effort_n,worked_mj\n";
  std::size_t order = 0;
  for (const TrialResult& result : results) {
    text << ++order << ',' << trial_task_name(result.trial.task) << ',' << result.trial.condition
         << ',' << hand_of(options, result.trial) << ',' << result.trial.repeat << ','
         << (result.is_done ? 1 : 0);
    for (const TrialMeasure& measure : kTrialMeasures) {
      char number[32];
      std::snprintf(number, sizeof number, ",%.6g", result.*measure.value);
      text << number;
    }
    text << '\n';
  }
  return text.str();
}

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
        std::vector<const TrialResult*> group;
        for (const TrialResult& result : results) {
          const bool is_in = std::string_view(task) == trial_task_name(result.trial.task) &&
                             result.trial.condition == condition &&
                             (hand == "all" || hand == hand_of(options, result.trial));
          if (is_in) group.push_back(&result);
        }
        if (!group.empty()) json["rows"].push_back(group_json(hand, group));
      }
    }
  }
  return json;
}

std::string trial_text(const Json& json) {
  std::ostringstream text;
  text << json["trials"] << " trials, order by seed " << json["seed"]
       << "; medians of all hands (quartiles)\n";
  const auto spread = [](const Json& row, const char* measure) {
    char words[64];
    std::snprintf(words, sizeof words, "%.3g (%.3g to %.3g)", row[measure]["median"].get<double>(),
                  row[measure]["q1"].get<double>(), row[measure]["q3"].get<double>());
    return std::string(words);
  };
  for (const Json& row : json["rows"]) {
    if (row["hand"] != "all") continue;
    text << "  " << row["task"].get<std::string>() << ", " << row["condition"].get<std::string>()
         << ": " << row["done"] << " of " << row["trials"] << " done; time "
         << spread(row, "time_s") << " s, error " << spread(row, "error_mm") << " mm, force "
         << spread(row, "effort_n") << " N, work " << spread(row, "worked_mj") << " mJ\n";
  }
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
