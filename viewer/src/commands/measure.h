// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

#include "document/measure_pick.h"
#include "picture/renderer.h"

namespace argil::viewer {

enum class MeasureKind { distance, angle, thickness };

/// How many points of the clay have to be pointed at.
constexpr std::size_t picks_of(MeasureKind kind) noexcept {
  return kind == MeasureKind::distance ? 2 : kind == MeasureKind::angle ? 3 : 1;
}

/// "Distance", as panels have it; "distance", as programs read it.
const char* name_of(MeasureKind kind) noexcept;
std::string word_of(MeasureKind kind);

/// What was measured: of an angle three points, its corner in the middle; of a thickness the point
/// that was pointed at and the one across.
struct Measurement {
  std::int64_t number = 0;  ///< 1, 2, ... in the order in which they were made
  MeasureKind kind = MeasureKind::distance;
  std::vector<MeasurePoint> points;
  std::array<bool, 3> are_seen{true, true, true};  ///< no clay lies before them
  std::array<bool, 3> are_kept{true, true, true};  ///< the clay still lies there as it was picked
};

/// A point of a measurement.
struct MeasureEnd {
  std::int64_t number = 0;  ///< of the measurement
  std::size_t point = 0;
  friend bool operator==(const MeasureEnd&, const MeasureEnd&) = default;
};

/// What the window remembers of measuring.
struct MeasureChoice {
  std::optional<MeasureKind> tool;  ///< nothing: the brush works
  bool has_marks = true;            ///< they are drawn
  std::vector<Measurement> list;    ///< oldest first
  std::int64_t last_number = 0;
  std::vector<MeasurePoint> begun;      ///< points of the next one
  std::vector<MeasurePoint> hover;      ///< under the pointer; of a thickness also the one across
  std::optional<std::int64_t> chosen;   ///< the one that Delete removes
  std::optional<MeasureEnd> under;      ///< the pointer, or held
  std::optional<SeenHalf> seen;         ///< what the slice of the last frame left
  const SlicePicture* slice = nullptr;  ///< that slice, where one is shown; the window keeps it
  std::int64_t listed = 0;              ///< the newest to which the list was scrolled
};

/// In mm; of an angle in degrees, 0 to 180 (0 where two of its points are one).
double measured(MeasureKind kind, std::span<const Vec3> places);
/// "12.34 mm", "45.0°"; lengths below a millimetre with three digits.
std::string measured_text(MeasureKind kind, double value);

/// Whether all its points still lie on the clay as they were picked.
bool is_current(const Measurement& measurement) noexcept;

/// The one with this number; null where it is gone.
Measurement* find_measurement(MeasureChoice& choice, std::int64_t number);

/// Chooses a tool, or leaves it where it is the one that is chosen; what was begun is given up.
void choose_measure(MeasureKind kind, MeasureChoice& choice);
void leave_measuring(MeasureChoice& choice);
void remove_measurement(std::int64_t number, MeasureChoice& choice);
void clear_measurements(MeasureChoice& choice);

/// What the left button does next: "Left: the first point".
const char* next_pick(const MeasureChoice& choice);

}  // namespace argil::viewer
