// SPDX-License-Identifier: GPL-3.0-or-later
// The strategies of section 3.6.4 of the Falcon report, as the lab's scenes have them.
#include "normals/strategy.h"

#include <span>
#include <utility>

#include "argil/haptics/scene/scene_sine.h"
#include "argil/haptics/scene/sine_network.h"

namespace argil::evaluation {
namespace {

using haptics::SineDirection;
using haptics::SineNetwork;
using haptics::SineOptions;
using haptics::SineScene;

constexpr double kWaveMm = 50.0;

SineOptions waves_with(SineDirection direction) {
  SineOptions options;
  options.direction = direction;
  options.offset_mm = 0.0;
  options.frequency_x_per_m = options.frequency_y_per_m = 1e3 / kWaveMm;
  options.amplitude_mm = SineNetwork::kAmplitude * kWaveMm;
  return options;
}

/// The height straight above and a direction there; the distance is that to the plane through it.
class SceneStrategy final : public NormalStrategy {
 public:
  SceneStrategy(const char* family, double setting, const SineOptions& options)
      : NormalStrategy(family, setting), scene_(options) {}

  Answer at(const Vec3& place) const noexcept override {
    const SineScene::Surface found = scene_.surface_at(place.x, place.y);
    return {(place.z - found.height_mm) * found.direction.z, found.direction};
  }
  std::size_t bytes() const noexcept override { return scene_.table_bytes(); }

 private:
  SineScene scene_;
};

/// The analytic normal, at the foot of the perpendicular on the tangent plane instead of straight
/// above, as often as the setting says.
class SteppingStrategy final : public NormalStrategy {
 public:
  explicit SteppingStrategy(int steps)
      : NormalStrategy(kAnalytic, steps),
        scene_(waves_with(SineDirection::unit_normal)),
        steps_(steps) {}

  Answer at(const Vec3& place) const noexcept override {
    Answer answer = from(place, place.x, place.y);
    for (int n = 0; n < steps_; ++n) {
      const Vec3 foot = place - answer.distance_mm * answer.normal;
      answer = from(place, foot.x, foot.y);
    }
    return answer;
  }

 private:
  Answer from(const Vec3& place, double x, double y) const noexcept {
    const SineScene::Surface found = scene_.surface_at(x, y);
    return {dot(place - Vec3{x, y, found.height_mm}, found.direction), found.direction};
  }

  SineScene scene_;
  int steps_;
};

class NetworkStrategy final : public NormalStrategy {
 public:
  NetworkStrategy() : NormalStrategy(kNetwork, 0.0), network_(kWaveMm) {}

  Answer at(const Vec3& place) const noexcept override {
    const SineNetwork::Answer found = network_.at(place);
    return {found.distance_mm, normalized(found.gradient)};
  }
  std::size_t bytes() const noexcept override { return SineNetwork::bytes(); }

 private:
  SineNetwork network_;
};

using Strategies = std::vector<std::unique_ptr<NormalStrategy>>;

void add_tables(const char* family, SineDirection direction, std::span<const double> spacings,
                Strategies& all) {
  for (const double spacing : spacings) {
    SineOptions options = waves_with(direction);
    options.table_spacing_mm = spacing;
    all.push_back(std::make_unique<SceneStrategy>(family, spacing, options));
  }
}

void add_differences(const char* family, SineDirection direction, std::span<const double> steps,
                     Strategies& all) {
  for (const double step : steps) {
    SineOptions options = waves_with(direction);
    options.difference_step_mm = step;
    all.push_back(std::make_unique<SceneStrategy>(family, step, options));
  }
}

}  // namespace

WavePoint wave_point(double x_mm, double y_mm) {
  static const SineScene scene(waves_with(SineDirection::unit_normal));
  return {{x_mm, y_mm, scene.height_mm(x_mm, y_mm)}, scene.direction_at(x_mm, y_mm)};
}

std::vector<std::unique_ptr<NormalStrategy>> normal_strategies(bool quick) {
  const std::vector<double> spacings =
      quick ? std::vector{0.5, 1.0, 2.0} : std::vector{0.2, 0.5, 1.0, 2.0, 4.0, 8.0};
  const std::vector<double> steps =
      quick ? std::vector{1e-6, 0.1, 1.0}
            : std::vector{1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 4.0};
  Strategies all;
  all.push_back(std::make_unique<SceneStrategy>(kUpwards, 0.0, waves_with(SineDirection::z_only)));
  for (int count = 0; count <= 4; ++count) all.push_back(std::make_unique<SteppingStrategy>(count));
  add_tables(kNearest, SineDirection::table_nearest, spacings, all);
  add_tables(kBilinear, SineDirection::table_bilinear, spacings, all);
  add_differences(kAhead, SineDirection::differences_ahead, steps, all);
  add_differences(kCentral, SineDirection::differences_central, steps, all);
  all.push_back(std::make_unique<NetworkStrategy>());
  return all;
}

}  // namespace argil::evaluation
