// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the force chart: their fields, their pooling over tools and scenes, and the CSV
// with its hash.
#include "force/row.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <span>

#include "argil/core/hash.h"

#include "common/output.h"

namespace argil::evaluation {
namespace {

const char* const kResultColumns =
    "scene,group,tool,radius_voxels,radius_mm,method,series,law,exponent,samples,queries,"
    "error_p50_pct,error_p95_pct,shallow_error_p95_pct,direction_p99_deg,torque_p95_pct,"
    "ripple_rms_p95_pct,ripple_pp_max_pct,bound_held_pct,opposed_p95,centre_pct,centre_error_p95_"
    "pct,centre_lod_error_p95_pct";
const char* const kTimeColumns =
    "cpu_p50_us,cpu_p99_us,cpu_max_us,centre_p50_us,window_fresh_us,window_moved_us,window_after_"
    "dab_us";

/// Four digits: above the noise of float sums, so that the hash holds for every instruction set.
std::string csv_field(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// How often the servo takes the centre.
double centre_pct(const ForceRow& row) {
  const Tally& t = row.tally;
  if (row.method != "servo" || t.error.empty()) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * static_cast<double>(t.centre_error.size()) / static_cast<double>(t.error.size());
}

std::string result_fields(const ForceRow& row) {
  const Tally& t = row.tally;
  std::string text = row.scene + "," + row.group + "," + row.tool + "," +
                     std::to_string(row.radius_voxels) + "," + csv_field(row.radius_mm) + "," +
                     row.method + "," + row.series + "," + row.law + "," + csv_field(row.exponent) +
                     "," + csv_field(t.samples) + "," + std::to_string(t.error.size());
  for (const double value :
       {100.0 * quantile(t.error, 0.5), 100.0 * quantile(t.error, 0.95),
        100.0 * quantile(t.shallow_error, 0.95), quantile(t.direction_deg, 0.99),
        100.0 * quantile(t.torque, 0.95), 100.0 * quantile(t.ripple_rms, 0.95),
        100.0 * quantile(t.ripple_pp, 1.0), 100.0 * mean(t.bound_held), quantile(t.opposed, 0.95),
        centre_pct(row), 100.0 * quantile(t.centre_error, 0.95),
        100.0 * quantile(t.centre_lod_error, 0.95)}) {
    text += ',';
    text += csv_field(value);
  }
  return text;
}

std::string time_fields(const ForceRow& row) {
  const std::vector<double>& cpu = row.tally.cpu_us;
  std::string text = csv_field(quantile(cpu, 0.5)) + "," + csv_field(quantile(cpu, 0.99)) + "," +
                     csv_field(quantile(cpu, 1.0)) + "," +
                     csv_field(quantile(row.tally.centre_us, 0.5));
  const cli::WindowTimes& windows = row.tally.windows;
  for (const auto* ms : {&windows.fresh, &windows.moved, &windows.after_dab}) {
    text += ',';
    text += csv_field(1e3 * quantile(*ms, 0.5));
  }
  return text;
}

/// Rows with the same key pooled into one, in the order in which the keys first come.
std::vector<ForceRow> pooled(const std::vector<ForceRow>& rows,
                             const std::function<ForceRow(const ForceRow&)>& head) {
  std::map<std::string, std::size_t> known;
  std::vector<ForceRow> result;
  for (const ForceRow& row : rows) {
    ForceRow first = head(row);
    const std::string key = first.scene + "," + first.tool + "," +
                            std::to_string(first.radius_voxels) + "," + first.method;
    const auto [at, is_new] = known.try_emplace(key, result.size());
    if (is_new) result.push_back(std::move(first));
    result[at->second].tally.append(row.tally);
  }
  return result;
}

ForceRow head_of(const ForceRow& row) {
  ForceRow head = row;
  head.tally = {};
  head.exponent = 0.0;
  return head;
}

ForceRow over_tools(const ForceRow& row, const std::string& scene) {
  ForceRow head = head_of(row);
  head.scene = scene;
  head.tool = "all";
  head.radius_voxels = 0;
  head.radius_mm = 0.0;
  return head;
}

}  // namespace

void Tally::append(const Tally& other) {
  const auto join = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  join(error, other.error);
  join(shallow_error, other.shallow_error);
  join(direction_deg, other.direction_deg);
  join(torque, other.torque);
  join(ripple_rms, other.ripple_rms);
  join(ripple_pp, other.ripple_pp);
  join(opposed, other.opposed);
  join(bound_held, other.bound_held);
  join(centre_error, other.centre_error);
  join(centre_lod_error, other.centre_lod_error);
  join(centre_us, other.centre_us);
  join(cpu_us, other.cpu_us);
  windows.append(other.windows);
  // The most expensive query is the one that a servo must have time for.
  samples = std::max(samples, other.samples);
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : sum / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double fraction) {
  assert(fraction > 0.0 && fraction <= 1.0);
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto count = static_cast<double>(values.size());
  // The nearest rank: a value that was measured, not one between two.
  const double rank = std::ceil(fraction * count) - 1.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<ForceRow> pooled_by_scene(const std::vector<ForceRow>& rows) {
  std::vector<ForceRow> judged;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(judged),
               [](const ForceRow& row) { return !row.tally.error.empty(); });
  std::vector<ForceRow> result =
      pooled(judged, [](const ForceRow& row) { return over_tools(row, row.scene); });
  for (ForceRow& row :
       pooled(judged, [](const ForceRow& row) { return over_tools(row, "all " + row.group); })) {
    result.push_back(std::move(row));
  }
  return result;
}

std::vector<ForceRow> pooled_by_radius(const std::vector<ForceRow>& rows) {
  return pooled(rows, [](const ForceRow& row) {
    ForceRow head = head_of(row);
    head.scene = head.group = "all";
    return head;
  });
}

std::string csv_text(const std::vector<ForceRow>& rows, const std::string& machine,
                     unsigned long seed, std::string& hash) {
  Hash64 digest;
  std::string lines;
  for (const ForceRow& row : rows) {
    const std::string results = result_fields(row);
    digest.update(std::as_bytes(std::span(results)));
    lines += results + "," + time_fields(row) + "\n";
  }
  hash = cli::hex(digest.digest());
  return "# " + machine + "; seed " + std::to_string(seed) + "; hash " + hash +
         " over all columns but the times\n" + kResultColumns + "," + kTimeColumns + "\n" + lines;
}

}  // namespace argil::evaluation
