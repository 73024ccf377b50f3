// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::evaluation {

/// A way to the distance and the normal of the lab's usual waves, whose middle is z = 0.
class NormalStrategy {
 public:
  NormalStrategy(std::string family, double setting)
      : family_(std::move(family)), setting_(setting) {}
  virtual ~NormalStrategy() = default;
  NormalStrategy(const NormalStrategy&) = delete;
  NormalStrategy& operator=(const NormalStrategy&) = delete;

  struct Answer {
    double distance_mm = 0.0;  ///< negative inside
    Vec3 normal;               ///< of unit length
  };
  virtual Answer at(const Vec3& place_mm) const noexcept = 0;
  /// Of what it looks up.
  virtual std::size_t bytes() const noexcept { return 0; }

  const std::string& family() const noexcept { return family_; }
  /// Spacing of a table or step of differences in mm; steps towards the nearest point; else 0.
  double setting() const noexcept { return setting_; }

 private:
  std::string family_;
  double setting_;
};

// Names of families, as the table has them.
inline constexpr const char* kUpwards = "z";
inline constexpr const char* kAnalytic = "analytic";
inline constexpr const char* kNearest = "table_nearest";
inline constexpr const char* kBilinear = "table_bilinear";
inline constexpr const char* kAhead = "differences_ahead";
inline constexpr const char* kCentral = "differences_central";
inline constexpr const char* kNetwork = "network";

/// All that are compared, those of one family together and their settings ascending.
std::vector<std::unique_ptr<NormalStrategy>> normal_strategies(bool quick);

/// A point of the surface.
struct WavePoint {
  Vec3 place_mm;
  Vec3 normal;
};
WavePoint wave_point(double x_mm, double y_mm);

}  // namespace argil::evaluation
