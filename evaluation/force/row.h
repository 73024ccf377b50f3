// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "common/window_times.h"

namespace argil::evaluation {

/// What was measured of one method, not yet reduced. Errors are relative to max(|F|, 0.05 f_c0).
struct Tally {
  std::vector<double> error;
  std::vector<double> shallow_error;  ///< those at the least depth
  std::vector<double> direction_deg;  ///< only where |F| > 0.05 f_c0
  std::vector<double> torque;         ///< relative to the same and the largest radius
  std::vector<double> ripple_rms;     ///< one a slide, relative to its mean force
  std::vector<double> ripple_pp;
  std::vector<double> opposed;     ///< all pushes without their directions over the same as errors
  std::vector<double> bound_held;  ///< 1 where the error was within what the method says, else 0
  // Of what the servo does, where it takes the centre: its errors, those of the sum there, times.
  std::vector<double> centre_error;
  std::vector<double> centre_lod_error;
  std::vector<double> centre_us;
  std::vector<double> cpu_us;
  cli::WindowTimes windows;  ///< that the method reads, of balls of some radii
  double samples = 0.0;      ///< nodes or points of the last query

  void append(const Tally& other);
};

/// One line of force.csv.
struct ForceRow {
  std::string scene;
  std::string group;
  std::string tool;
  int radius_voxels = 0;
  double radius_mm = 0.0;
  std::string method;
  std::string series;
  std::string law;
  double exponent = 0.0;
  Tally tally;
};

/// The value below which this fraction (above 0, at most 1) of them lies, by nearest rank; NaN, an
/// empty field, when there are none.
double quantile(std::vector<double> values, double fraction);

/// NaN, as above, when there are none.
double mean(const std::vector<double>& values);

/// The rows that have errors with everything but scene and method pooled, and "all smooth" and "all
/// sharp" besides (radius and exponent 0 there).
std::vector<ForceRow> pooled_by_scene(const std::vector<ForceRow>& rows);
/// Pooled over scenes and exponents: a row for every tool, radius and method.
std::vector<ForceRow> pooled_by_radius(const std::vector<ForceRow>& rows);

/// CSV text: a comment that names machine, seed and hash, a header, the rows.
/// `hash` is xxh64 over every column but the times.
std::string csv_text(const std::vector<ForceRow>& rows, const std::string& machine,
                     unsigned long seed, std::string& hash);

}  // namespace argil::evaluation
