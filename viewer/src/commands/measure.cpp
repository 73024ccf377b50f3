// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/measure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace argil::viewer {
const char* name_of(MeasureKind kind) noexcept {
  switch (kind) {
    case MeasureKind::distance:
      return "Distance";
    case MeasureKind::angle:
      return "Angle";
    case MeasureKind::thickness:
      break;
  }
  return "Thickness";
}

std::string word_of(MeasureKind kind) {
  std::string word = name_of(kind);
  word.front() = static_cast<char>(word.front() - 'A' + 'a');
  return word;
}

double measured(MeasureKind kind, std::span<const Vec3> places) {
  if (kind != MeasureKind::angle) {
    assert(places.size() == 2);
    return length(places[1] - places[0]);
  }
  assert(places.size() == 3);
  const Vec3 one = places[0] - places[1];
  const Vec3 other = places[2] - places[1];
  return 180.0 / std::numbers::pi * std::atan2(length(cross(one, other)), dot(one, other));
}

std::string measured_text(MeasureKind kind, double value) {
  char text[48];
  const char* format = kind == MeasureKind::angle ? "%.1f\u00b0"
                       : value < 1.0              ? "%.3f mm"
                                                  : "%.2f mm";
  std::snprintf(text, sizeof text, format, value);
  return text;
}

bool is_current(const Measurement& measurement) noexcept {
  const auto& kept = measurement.are_kept;
  return std::all_of(kept.begin(),
                     kept.begin() + static_cast<std::ptrdiff_t>(measurement.points.size()),
                     [](bool is) { return is; });
}

Measurement* find_measurement(MeasureChoice& choice, std::int64_t number) {
  const auto found =
      std::find_if(choice.list.begin(), choice.list.end(),
                   [number](const Measurement& each) { return each.number == number; });
  return found == choice.list.end() ? nullptr : &*found;
}

void choose_measure(MeasureKind kind, MeasureChoice& choice) {
  const bool was_chosen = choice.tool == kind;
  leave_measuring(choice);
  if (was_chosen) return;
  choice.tool = kind;
  choice.has_marks = true;
}

void leave_measuring(MeasureChoice& choice) {
  choice.tool.reset();
  choice.begun.clear();
  choice.hover.clear();
  choice.under.reset();
  choice.chosen.reset();
}

void remove_measurement(std::int64_t number, MeasureChoice& choice) {
  std::erase_if(choice.list, [number](const Measurement& each) { return each.number == number; });
  if (choice.chosen == number) choice.chosen.reset();
  if (choice.under && choice.under->number == number) choice.under.reset();
}

void clear_measurements(MeasureChoice& choice) {
  choice.list.clear();
  choice.begun.clear();
  choice.hover.clear();
  choice.chosen.reset();
  choice.under.reset();
}

const char* next_pick(const MeasureChoice& choice) {
  assert(choice.tool && choice.begun.size() < picks_of(*choice.tool));
  if (choice.under && choice.begun.empty()) return "Left: drag this end, or begin there";
  if (*choice.tool == MeasureKind::thickness) return "Left: how thick it is there";
  const bool is_angle = *choice.tool == MeasureKind::angle;
  switch (choice.begun.size()) {
    case 0:
      return "Left: the first point";
    case 1:
      return is_angle ? "Left: the corner" : "Left: the second point";
    default:
      return "Left: the third point";
  }
}

}  // namespace argil::viewer
