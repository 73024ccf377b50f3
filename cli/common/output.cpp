// SPDX-License-Identifier: GPL-3.0-or-later
// What a command prints: JSON, text, progress, and the status that says how it ended.
#include "common/output.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <utility>

#include <unistd.h>

#include "argil/haptics/servo/safety_gate.h"
#include "argil/io/safe_file.h"

namespace argil::cli {
namespace {

constexpr int kBarWidth = 32;
bool g_bar_shown = false;  // only the main thread draws

template <class... Args>
std::string formatted(const char* format, Args... args) {
  std::array<char, 256> text{};
  [[maybe_unused]] const int length = std::snprintf(text.data(), text.size(), format, args...);
  assert(length >= 0 && static_cast<std::size_t>(length) < text.size());  // else it was cut off
  return text.data();
}

/// How long the rest may take, by what was done since the fraction last went back; "" while that
/// says little.
class Remaining {
 public:
  std::string text(double part) {
    if (part < before_ || before_ < 0.0) {
      begin_ = std::chrono::steady_clock::now();
      begin_part_ = part;
    }
    before_ = part;
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - begin_;
    const double done = part - begin_part_;
    // Before, the estimate would jump.
    if (past.count() < 2.0 || done < 0.02) return "";
    const double left = past.count() * (1.0 - part) / done;
    if (left < 1.0) return "";
    return left < 90.0 ? formatted("  about %.0f s left", left)
                       : formatted("  about %.0f min left", left / 60.0);
  }

 private:
  std::chrono::steady_clock::time_point begin_;
  double begin_part_ = 0.0;
  double before_ = -1.0;
};

void draw_bar(std::string_view stage, double fraction) {
  static Remaining remaining;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(std::lround(part * kBarWidth));
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kBarWidth, '.');
  std::fprintf(stderr, "\r\033[K%-24.*s [%s] %3.0f %%%s", static_cast<int>(stage.size()),
               stage.data(), bar.c_str(), 100.0 * part, remaining.text(part).c_str());
  std::fflush(stderr);
  g_bar_shown = true;
}

/// Kinds of problem with how often each is listed, in the order they come.
std::string problems_text(const mesh::MeshVerdict& verdict) {
  constexpr std::size_t kShownPerKind = 3;
  std::string text;
  std::string kind;
  std::size_t shown = 0;
  for (const mesh::MeshProblem& problem : verdict.problems) {
    shown = problem.kind == kind ? shown + 1 : 1;
    kind = problem.kind;
    if (shown > kShownPerKind) continue;
    const Vec3& p = problem.at_mm;
    text += formatted("  %s at (%.6g, %.6g, %.6g) mm, size %.4g mm\n", kind.c_str(), p.x, p.y, p.z,
                      problem.size_mm);
  }
  return text;
}

}  // namespace

int status_of(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::bad_input:
      return 3;
    case ErrorKind::device:
      return 4;
    case ErrorKind::interrupted:
      // 128 and the signal, as shells report it.
      return io::ending_signal() == SIGTERM ? 128 + SIGTERM : 128 + SIGINT;
    case ErrorKind::memory:
    case ErrorKind::disk:
    case ErrorKind::internal:
      break;
  }
  return 5;
}

std::string kind_name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::bad_input:
      return "bad_input";
    case ErrorKind::device:
      return "device";
    case ErrorKind::memory:
      return "memory";
    case ErrorKind::disk:
      return "disk";
    case ErrorKind::interrupted:
      return "interrupted";
    case ErrorKind::internal:
      break;
  }
  return "internal";
}

Json error_json(const std::string& kind, const std::string& message, int status) {
  assert(!kind.empty() && status != 0);
  Json json;
  json["error"] = {{"kind", kind}, {"message", message}, {"status", status}};
  return json;
}

Error named(const std::filesystem::path& file, Error error) {
  const bool is_of_file = error.kind != ErrorKind::disk && error.kind != ErrorKind::interrupted;
  if (is_of_file && error.message.find(file.string()) == std::string::npos) {
    error.message.insert(0, file.string().insert(0, 1, '\'') + "': ");
  }
  return error;
}

Json to_json(const Vec3& v) {
  return Json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0});  // adding 0 turns -0 into 0
}

Json to_json(const std::vector<LevelStats>& levels) {
  Json json = Json::array();
  for (const LevelStats& level : levels) {
    json.push_back({{"level", level.level},
                    {"voxel_mm", level.voxel_mm},
                    {"active_voxels", level.active_voxels},
                    {"leaves", level.leaves},
                    {"bytes", level.bytes}});
  }
  return json;
}

Json to_json(const mesh::MeshVerdict& verdict) {
  Json json;
  json["printable"] = verdict.printable;
  json["closed"] = verdict.closed;
  json["manifold"] = verdict.manifold;
  json["outward"] = verdict.outward;
  json["boundary_edges"] = verdict.boundary_edges;
  json["misoriented_edges"] = verdict.misoriented_edges;
  json["nonmanifold_edges"] = verdict.nonmanifold_edges;
  json["nonmanifold_vertices"] = verdict.nonmanifold_vertices;
  json["self_intersections"] = verdict.self_intersections;
  json["degenerate"] = verdict.degenerate;
  json["duplicate"] = verdict.duplicate;
  json["components"] = verdict.components;
  json["euler"] = verdict.euler;
  json["volume_mm3"] = verdict.volume_mm3;
  json["area_mm2"] = verdict.area_mm2;
  json["min_wall_mm"] = verdict.min_wall_mm < 0.0 ? Json() : Json(verdict.min_wall_mm);
  json["min_gap_mm"] = verdict.min_gap_mm < 0.0 ? Json() : Json(verdict.min_gap_mm);
  json["cavities"] = verdict.cavities;
  json["crumbs"] = verdict.small_components;
  json["overhang_mm2"] = verdict.overhang_mm2;
  json["size_mm"] = to_json(verdict.size_mm);
  json["problems"] = Json::array();
  for (const mesh::MeshProblem& problem : verdict.problems) {
    json["problems"].push_back(
        {{"kind", problem.kind}, {"at_mm", to_json(problem.at_mm)}, {"size_mm", problem.size_mm}});
  }
  return json;
}

Json faults_json(std::uint32_t faults) {
  Json json = Json::array();
  for (unsigned bit = 0; bit < 32; ++bit) {
    const std::uint32_t one = faults & (1U << bit);
    // That a clay's first window takes its time, and that a run ends, is no fault.
    if (one != 0 && one != haptics::kStopping && one != haptics::kWaiting) {
      json.push_back(haptics::fault_text(one));
    }
  }
  return json;
}

Json percentiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto rank = [&](double fraction) {
    if (values.empty()) return 0.0;
    // The nearest rank: a value that was measured.
    const double nth = std::ceil(fraction * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(1.0, nth)) - 1];
  };
  return {{"p50", rank(0.50)}, {"p99", rank(0.99)}, {"max", rank(1.0)}};
}

Json age_json(const haptics::Histogram& ages) {
  Json json;
  json["p50"] = 1e-3 * ages.quantile_us(0.5);
  json["p99"] = 1e-3 * ages.quantile_us(0.99);
  json["max"] = 1e-3 * ages.max_us();
  return json;
}

std::string hex(std::uint64_t hash) {
  return formatted("%016llx", static_cast<unsigned long long>(hash));
}

std::string number(double value) { return formatted("%.6g", value); }

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::ptrdiff_t first = value < 0 ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > first; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

std::string levels_text(const std::vector<LevelStats>& levels) {
  constexpr double kMegabyte = 1e6;
  std::string text = "level   voxel mm  active voxels     leaves        MB\n";
  for (const LevelStats& level : levels) {
    text += formatted("%5d %10.4g %14s %10s %9.2f\n", level.level, level.voxel_mm,
                      grouped(level.active_voxels).c_str(), grouped(level.leaves).c_str(),
                      static_cast<double>(level.bytes) / kMegabyte);
  }
  return text;
}

std::string verdict_text(const mesh::MeshVerdict& v) {
  std::string text = v.printable ? "printable: yes\n" : "printable: no\n";
  const auto count = [&](std::int64_t n, const char* what) {
    if (n > 0) text += "  " + grouped(n) + " " + what + "\n";
  };
  count(v.boundary_edges, "open edges");
  count(v.nonmanifold_edges, "edges shared by more than two triangles");
  count(v.misoriented_edges, "edges of triangles that face opposite ways");
  count(v.nonmanifold_vertices, "vertices where surfaces only touch");
  count(v.self_intersections, v.self_intersections < mesh::kMostCrossings
                                  ? "pairs of triangles that cross"
                                  : "pairs of triangles at least that cross");
  count(v.degenerate, "triangles without area");
  count(v.duplicate, "triangles given twice");
  if (v.closed && !v.outward) text += "  parts that face the wrong way, or lie in one another\n";
  text += "parts " + grouped(v.components) + ", euler " + std::to_string(v.euler) + ", volume " +
          number(v.volume_mm3) + " mm3, area " + number(v.area_mm2) + " mm2\n";
  text += "size " + number(v.size_mm.x) + " x " + number(v.size_mm.y) + " x " +
          number(v.size_mm.z) + " mm";
  if (v.cavities > 0) text += ", closed cavities " + grouped(v.cavities);
  if (v.small_components > 0) text += ", crumbs " + grouped(v.small_components);
  text += "\n";
  if (v.overhang_mm2 > 0.0) {
    text += "overhangs " + number(v.overhang_mm2) + " mm2: supports needed\n";
  }
  if (std::isfinite(v.min_wall_mm) && v.min_wall_mm >= 0.0) {
    text += "thinnest wall " + number(v.min_wall_mm) + " mm\n";
  }
  if (std::isfinite(v.min_gap_mm) && v.min_gap_mm >= 0.0) {
    text += "narrowest gap " + number(v.min_gap_mm) + " mm\n";
  }
  return text + problems_text(v);
}

Progress terminal_progress(bool quiet) {
  // In a log a bar would be a line for each step.
  const bool draws = !quiet && ::isatty(STDERR_FILENO) == 1;
  return [draws](std::string_view stage, double fraction) {
    if (draws) draw_bar(stage, fraction);
    return !io::interrupted();
  };
}

void finish_progress() {
  if (!g_bar_shown) return;
  std::fputs("\r\033[K", stderr);
  g_bar_shown = false;
}

void note_refusal(const std::string& refusal, bool quiet) {
  static bool is_noted = false;  // only the main thread says it
  if (refusal.empty() || quiet || std::exchange(is_noted, true)) return;
  finish_progress();
  std::fprintf(stderr, "argil: note: %s\n", refusal.c_str());
}

Result<void> check_interrupt() {
  if (!io::interrupted()) return {};
  return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
}

}  // namespace argil::cli
