// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/exchange_meter.h"

#include <algorithm>

namespace argil::evaluation {
namespace {

/// What sums of floats leave between two windows of one clay.
constexpr double kNoStepN = 1e-6;

}  // namespace

void ExchangeMeter::begin_tick(const haptics::HandleState& handle) noexcept {
  scene_.begin_tick(handle);
  if (!has_tool_ || tool_.time_s < from_s_) return;
  put_in_mj_ += std::max(0.0, scene_.energy_at(tool_) - energy_mj_);
  const double step_n = length(scene_.force_at(tool_).force_n - force_n_);
  if (step_n > kNoStepN) steps_.push_back({handle.time_s, step_n});
}

haptics::SceneForce ExchangeMeter::force_at(const haptics::HandleState& handle) const noexcept {
  return scene_.force_at(handle);
}

void ExchangeMeter::end_tick(const haptics::HandleState& tool) noexcept {
  // What the tool cuts in this tick takes away what it has moved into: that is no exchange.
  scene_.end_tick(tool);
  has_tool_ = true;
  tool_ = tool;
  if (tool.time_s < from_s_) return;
  const haptics::SceneForce felt = scene_.force_at(tool);
  force_n_ = felt.force_n;
  energy_mj_ = scene_.energy_at(tool);
  if ((felt.faults & haptics::kSceneOutsideWindow) != 0) ++outside_;
}

void ExchangeMeter::forget_motion() noexcept {
  has_tool_ = false;
  scene_.forget_motion();
}

haptics::WindowStamp ExchangeMeter::window_stamp() const noexcept {
  haptics::WindowStamp stamp = scene_.window_stamp();
  if (!tells_lateness_) stamp.lateness_s = 0.0;
  return stamp;
}

std::vector<double> ExchangeMeter::steps_since(double since_s) const {
  std::vector<double> steps;
  for (const Step& step : steps_) {
    if (step.time_s >= since_s) steps.push_back(step.force_n);
  }
  return steps;
}

}  // namespace argil::evaluation
