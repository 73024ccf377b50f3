// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/hand_model.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "math/unit.h"

namespace argil::haptics {

HandModel hand_model(Hand hand) noexcept {
  switch (hand) {
    case Hand::push:
      return {"push", 0.0, 3.0, 100.0, true};
    case Hand::light:
      return {"light", 0.1, 3.0, 100.0, false};
    case Hand::arm:
      return {"arm", 0.554, 6.45, 135.0, false};
    case Hand::firm:
      return {"firm", 0.3, 20.0, 600.0, false};
    case Hand::none:
      break;
  }
  return {};
}

HandPlan::HandPlan(std::vector<HandKey> keys) : keys_(std::move(keys)) {
  assert(!keys_.empty());
  assert(std::is_sorted(keys_.begin(), keys_.end(),
                        [](const HandKey& a, const HandKey& b) { return a.time_s < b.time_s; }));
  assert(std::all_of(keys_.begin(), keys_.end(),
                     [](const HandKey& key) { return is_in_reach(key.place_mm); }));
  assert(std::all_of(keys_.begin(), keys_.end(),
                     [](const HandKey& key) { return is_unit(key.direction); }));
}

HandIntent HandPlan::at(double time_s) noexcept {
  const auto next = std::upper_bound(keys_.begin(), keys_.end(), time_s,
                                     [](double t, const HandKey& key) { return t < key.time_s; });
  const HandKey& from = next == keys_.begin() ? keys_.front() : *(next - 1);
  HandIntent intent{from.place_mm, {}, from.press_n, from.direction, from.holds, from.is_active};
  if (next == keys_.begin() || next == keys_.end()) return intent;
  const double span_s = next->time_s - from.time_s;
  if (span_s <= 0.0) return intent;
  const double fraction = (time_s - from.time_s) / span_s;
  assert(fraction >= 0.0 && fraction <= 1.0);
  const Vec3 path = next->place_mm - from.place_mm;
  intent.place_mm += fraction * path;
  intent.velocity_mm_per_s = path / span_s;
  intent.press_n += fraction * (next->press_n - from.press_n);
  intent.direction = normalized((1.0 - fraction) * from.direction + fraction * next->direction);
  return intent;
}

}  // namespace argil::haptics
